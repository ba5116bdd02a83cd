//! Scene data: buffers that passes read by name, worked out on the CPU from the scene of a frame.
//!
//! The core's own stand in `core_data.rs`; a plugin brings others in the same way. Each says what it is made from, so
//! that a new frame costs only what changed, and how it is laid out, so that every shader that reads it is held against
//! the Rust struct that fills it.

use std::fmt;
use std::sync::Arc;

use bytemuck::bytes_of;

use crate::layout::{Header, Layout, Shape};
use crate::moment::Moment;
use crate::part::Part;
use crate::scene::Scene;

/// One or several buffers of scene data that are made together.
#[derive(Clone)]
pub struct SceneData {
    /// Their names, and how each is laid out.
    pub(crate) items: Vec<(&'static str, Shape)>,
    /// All that they are made from.
    pub(crate) from: Vec<Part>,
    pub(crate) start: Arc<StartEncoder>,
}

/// Makes the encoder for a scene.
type StartEncoder = dyn Fn(&Scene) -> Box<dyn Encoder> + Send + Sync;

/// Makes scene data, frame after frame.
pub trait Encoder: Send {
    /// Brings the data to a moment of the scene that the encoder was made for. They are empty before the first, and
    /// afterwards what it made of them before.
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>);
}

/// The buffers of one [`SceneData`], by name.
pub struct Buffers<'a>(pub(crate) &'a mut [(&'static str, Vec<u8>)]);

impl Buffers<'_> {
    /// The bytes of a name.
    ///
    /// # Panics
    /// Where the name is not among those that the encoder was registered with, which is a mistake of its author.
    pub fn bytes(&mut self, name: &str) -> &mut Vec<u8> {
        let names: Vec<&str> = self.0.iter().map(|item| item.0).collect();
        match names.iter().position(|known| *known == name) {
            Some(index) => &mut self.0[index].1,
            None => panic!("the encoder of the scene data {names:?} makes no `{name}`"),
        }
    }

    /// Puts a list of elements under a name.
    ///
    /// # Panics
    /// As [`Buffers::bytes`].
    pub fn set_list<T: Layout>(&mut self, name: &str, elements: impl IntoIterator<Item = T>) {
        *self.bytes(name) = list(elements);
    }
}

impl SceneData {
    /// One struct, for `var<uniform> name: T`.
    pub fn record<T: Layout>(
        name: &'static str,
        from: &[Part],
        make: impl Fn(&Moment<'_>) -> T + Send + Sync + 'static,
    ) -> SceneData {
        Self::bytes((name, Shape::record::<T>()), from, move |moment| bytes_of(&make(moment)).to_vec())
    }

    /// A count and elements, for `var<storage, read> name: …` of a struct `count`, padding to 16 bytes,
    /// `items: array<T>`. Where it has no elements one of zeros stands there.
    pub fn list<T: Layout>(
        name: &'static str,
        from: &[Part],
        make: impl Fn(&Moment<'_>) -> Vec<T> + Send + Sync + 'static,
    ) -> SceneData {
        Self::bytes((name, Shape::list::<T>()), from, move |moment| list(make(moment)))
    }

    /// Bytes of any shape, which are made anew for each moment.
    pub fn bytes(
        item: (&'static str, Shape),
        from: &[Part],
        make: impl Fn(&Moment<'_>) -> Vec<u8> + Send + Sync + 'static,
    ) -> SceneData {
        let make = Arc::new(make);
        Self::kept(vec![item], from, move |_| Box::new(Anew { name: item.0, make: make.clone() }))
    }

    /// Several names that are made together, or data that are made from what was kept of the frame before. `start` makes
    /// the encoder for a scene.
    pub fn kept(
        items: Vec<(&'static str, Shape)>,
        from: &[Part],
        start: impl Fn(&Scene) -> Box<dyn Encoder> + Send + Sync + 'static,
    ) -> SceneData {
        SceneData { items, from: from.to_vec(), start: Arc::new(start) }
    }

    /// What passes read it by.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.items.iter().map(|item| item.0)
    }

    /// Whether a part of the scene counts for what it holds.
    pub fn is_made_from(&self, part: Part) -> bool {
        self.from.contains(&part)
    }

    /// Whether it differs between some two times of a scene.
    pub(crate) fn varies(&self, scene: &Scene) -> bool {
        self.from.iter().any(|part| scene.varies(*part))
    }
}

impl fmt::Debug for SceneData {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SceneData").field("items", &self.items).field("from", &self.from).finish_non_exhaustive()
    }
}

/// Scene data of one name that remember nothing.
struct Anew<F> {
    name: &'static str,
    make: Arc<F>,
}

impl<F: Fn(&Moment<'_>) -> Vec<u8> + Send + Sync> Encoder for Anew<F> {
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>) {
        *data.bytes(self.name) = (self.make)(moment);
    }
}

/// The bytes of a list: header and elements; one zeroed element where there is none.
pub fn list<T: Layout>(elements: impl IntoIterator<Item = T>) -> Vec<u8> {
    let mut bytes = vec![0; size_of::<Header>()];
    let mut count = 0u32;
    for element in elements {
        bytes.extend_from_slice(bytes_of(&element));
        count += 1;
    }
    if count == 0 {
        bytes.extend_from_slice(bytes_of(&T::zeroed()));
    }
    bytes[..4].copy_from_slice(&count.to_le_bytes());
    bytes
}
