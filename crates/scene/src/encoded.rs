//! A scene as the bytes of GPU buffers, one per name of scene data that is read.

use std::fmt;
use std::ops::Range;

use crate::part::Part;
use crate::scene::Scene;
use crate::scene_data::{Buffers, Encoder, SceneData};

/// The bytes of each name of scene data that is read.
pub struct Encoded {
    /// In the order in which the scene's data were registered.
    pub items: Vec<(&'static str, Vec<u8>)>,
    encoders: Vec<Running>,
    time: f64,
    aspect: f64,
}

/// Data whose names follow one another among the items.
struct Running {
    data: SceneData,
    encoder: Box<dyn Encoder>,
    items: Range<usize>,
}

impl Encoded {
    pub(crate) fn of(scene: &Scene, time: f64, aspect: f64, reads: &dyn Fn(&str) -> bool) -> Encoded {
        let mut encoded = Encoded { items: Vec::new(), encoders: Vec::new(), time, aspect };
        for data in scene.extensions().data().filter(|data| data.names().any(reads)) {
            let first = encoded.items.len();
            encoded.items.extend(data.names().map(|name| (name, Vec::new())));
            let (encoder, items) = ((data.start)(scene), first..encoded.items.len());
            encoded.encoders.push(Running { data: data.clone(), encoder, items });
        }
        encoded.encode(scene, |_| true);
        encoded
    }

    /// The bytes of a name; empty where it is not read or does not exist.
    pub fn bytes(&self, name: &str) -> &[u8] {
        self.items.iter().find(|item| item.0 == name).map_or(&[], |item| &item.1)
    }

    /// Brings the bytes to another time and aspect of the same scene and gives the names whose bytes may have changed:
    /// only what is made from something that changed is made anew.
    pub fn update(&mut self, scene: &Scene, time: f64, aspect: f64) -> Vec<&'static str> {
        let (later, wider) = (time != self.time, aspect != self.aspect);
        (self.time, self.aspect) = (time, aspect);
        self.encode(scene, |data| (later && data.varies(scene)) || (wider && data.is_made_from(Part::Aspect)))
    }

    /// Encodes some of the data anew, and gives their names.
    fn encode(&mut self, scene: &Scene, is_due: impl Fn(&SceneData) -> bool) -> Vec<&'static str> {
        let due = self.encoders.iter_mut().filter(|running| is_due(&running.data));
        let mut due = due.peekable();
        if due.peek().is_none() {
            return Vec::new();
        }
        let moment = scene.moment(self.time, self.aspect);
        let mut changed = Vec::new();
        for Running { data, encoder, items } in due {
            encoder.encode(&moment, &mut Buffers(&mut self.items[items.clone()]));
            changed.extend(data.names());
        }
        changed
    }
}

impl fmt::Debug for Encoded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes = self.items.iter().map(|(name, bytes)| (name, bytes.len()));
        f.debug_map().entries(sizes).finish()
    }
}
