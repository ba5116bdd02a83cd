//! A scene at one time, in double precision.

use glam::{DAffine3, DVec3};

use crate::model::{Camera, LightKind, NodeTransform, Object, Placement};
use crate::scene::Scene;

/// Everything that depends on the time.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Where the picture is taken from.
    pub camera: View,
    /// In the order of the scene's lights.
    pub lights: Vec<FrameLight>,
    /// world ← mesh, one per instance.
    pub transforms: Vec<DAffine3>,
}

/// A camera: position and an orthonormal right-handed frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Metres.
    pub position: DVec3,
    /// Metres along the view axis; closer than this nothing is drawn.
    pub nearest: f64,
    /// Unit vector to the right of the image.
    pub right: DVec3,
    /// Unit vector to the top of the image.
    pub up: DVec3,
    /// Unit vector into the image.
    pub forward: DVec3,
    /// Whole angle, radians.
    pub vertical_fov: f64,
}

/// A light at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameLight {
    /// Kind and what only that kind has.
    pub kind: LightKind,
    /// Metres.
    pub position: DVec3,
    /// Unit vector, the way the light travels.
    pub direction: DVec3,
    /// W/sr or, of a directional light, W/m².
    pub intensity: DVec3,
    /// Metres.
    pub radius: f64,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box of one point.
    pub fn point(point: DVec3) -> Bounds {
        Bounds { min: point, max: point }
    }

    /// The box with one more point in it.
    #[must_use]
    pub fn with(self, point: DVec3) -> Bounds {
        Bounds { min: self.min.min(point), max: self.max.max(point) }
    }
}

impl Frame {
    /// In world space.
    pub(crate) fn of(scene: &Scene, time: f64) -> Frame {
        let objects: Vec<Placed> = scene.objects.iter().map(|object| Placed::of(object, time)).collect();
        let transforms = scene.instances.iter().map(|i| match i.node {
            Some(node) => objects[i.object].nodes[node],
            None => objects[i.object].root,
        });
        let lights = scene.lights.iter().map(|light| {
            let (position, direction) = match &light.placement {
                Placement::World { position, direction } => (position.at(time), direction.at(time)),
                Placement::Node { object, node } => looking(&objects[*object].nodes[*node]),
            };
            let direction = direction.try_normalize().unwrap_or(DVec3::NEG_Z);
            let intensity = light.intensity.at(time);
            FrameLight { kind: light.kind, position, direction, intensity, radius: light.radius }
        });
        Frame { camera: view(scene, &objects, time), lights: lights.collect(), transforms: transforms.collect() }
    }

    /// From the eye to the closest light or object that does not stand right there, m: how fine positions matter.
    pub(crate) fn nearest_distance(&self) -> f64 {
        let lights =
            self.lights.iter().filter(|light| light.kind != LightKind::Directional).map(|light| light.position);
        let places = lights.chain(self.transforms.iter().map(|transform| transform.translation));
        let distances = places.map(|place| place.distance(self.camera.position));
        distances.filter(|&distance| distance > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The same as seen from another origin, world, m.
    pub(crate) fn seen_from(mut self, origin: DVec3) -> Frame {
        self.camera.position -= origin;
        self.lights.iter_mut().for_each(|light| light.position -= origin);
        self.transforms.iter_mut().for_each(|transform| transform.translation -= origin);
        self
    }
}

/// An object and its nodes: world ← object, world ← node.
struct Placed {
    root: DAffine3,
    nodes: Vec<DAffine3>,
}

impl Placed {
    fn of(object: &Object, time: f64) -> Placed {
        let root = object.world_from_object(time);
        let mut nodes: Vec<DAffine3> = Vec::with_capacity(object.nodes.len());
        for node in object.nodes.iter() {
            let parent = node.parent.map_or(root, |p| nodes[p]);
            let local = match &node.transform {
                NodeTransform::Fixed(transform) => *transform,
                NodeTransform::Moving(motion) => motion.at(time),
            };
            nodes.push(parent * local);
        }
        Placed { root, nodes }
    }
}

/// Where a node is, and its −z.
fn looking(world_from_node: &DAffine3) -> (DVec3, DVec3) {
    (world_from_node.translation, world_from_node.transform_vector3(DVec3::NEG_Z))
}

fn view(scene: &Scene, objects: &[Placed], time: f64) -> View {
    let (position, forward, up, vertical_fov) = match &scene.camera {
        Camera::LookAt { position, look_at, up, vertical_fov } => {
            let position = position.at(time);
            (position, look_at.at(time) - position, *up, *vertical_fov)
        }
        Camera::Node { object, node, vertical_fov } => {
            let world_from_node = &objects[*object].nodes[*node];
            let (position, forward) = looking(world_from_node);
            (position, forward, world_from_node.transform_vector3(DVec3::Y), *vertical_fov)
        }
    };
    // The decoder refuses cameras without a view; a glTF node can still be scaled to nothing.
    let forward = forward.try_normalize().unwrap_or(DVec3::NEG_Z);
    let right = forward.cross(up.normalize_or(DVec3::Y)).try_normalize();
    let right = right.unwrap_or_else(|| forward.any_orthonormal_vector());
    View { position, nearest: scene.nearest, right, up: right.cross(forward), forward, vertical_fov }
}
