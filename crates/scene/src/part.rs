//! What scene data are made from, and which of it changes with the time.

use crate::field::Holder;
use crate::model::{Camera, Instance, Light, LightKind, Placement};
use crate::scene::Scene;

/// A part of a scene that scene data are made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Where the camera stands and looks.
    Camera,
    /// Width over height of the picture.
    Aspect,
    /// Position, direction and intensity of the lights. How many there are, and of what kind, is the same at all times.
    Lights,
    /// Where the vertices are.
    Geometry,
    /// Which way round triangles run: it changes where a transform mirrors at some times and not at others.
    Winding,
    /// Materials and textures, and which object has which.
    Materials,
    /// The medium.
    Medium,
    /// The background.
    Background,
    /// A field that a plugin brings, of this name, wherever one stands: see [`crate::SceneField::part`].
    Field(Holder, &'static str),
}

impl Scene {
    /// Whether a part of this scene differs between some two times.
    pub fn varies(&self, part: Part) -> bool {
        match part {
            Part::Camera => self.camera_moves(),
            Part::Lights => self.lights.iter().any(|light| self.light_varies(light)),
            Part::Geometry => self.instances.iter().any(|instance| self.instance_moves(instance)),
            Part::Winding => self.instances.iter().any(|instance| self.instance_flips(instance)),
            Part::Field(holder, name) => self.field_varies(holder, name),
            Part::Aspect | Part::Materials | Part::Medium | Part::Background => false,
        }
    }

    fn camera_moves(&self) -> bool {
        match &self.camera {
            Camera::LookAt { position, look_at, .. } => position.varies() || look_at.varies(),
            Camera::Node { object, node, .. } => self.node_moves(*object, Some(*node)),
        }
    }

    fn light_varies(&self, light: &Light) -> bool {
        let moves = match (&light.placement, light.kind) {
            (Placement::World { position, .. }, LightKind::Point) => position.varies(),
            (Placement::World { direction, .. }, LightKind::Directional) => direction.varies(),
            (Placement::World { position, direction }, LightKind::Spot { .. }) => {
                position.varies() || direction.varies()
            }
            (Placement::Node { object, node }, _) => self.node_moves(*object, Some(*node)),
        };
        moves || light.intensity.varies()
    }

    /// The node that carries an instance, where it moves within its object.
    pub(crate) fn moving_node(&self, instance: &Instance) -> Option<usize> {
        instance.node.filter(|node| self.objects[instance.object].nodes[*node].moves)
    }

    /// Whether an instance's transform differs between some two times.
    pub fn instance_moves(&self, instance: &Instance) -> bool {
        self.node_moves(instance.object, instance.node)
    }

    /// Whether an instance may turn inside out over time.
    pub(crate) fn instance_flips(&self, instance: &Instance) -> bool {
        let nodes = &self.objects[instance.object].nodes;
        instance.node.is_some_and(|n| nodes[n].may_flip)
    }

    fn node_moves(&self, object: usize, node: Option<usize>) -> bool {
        let object = &self.objects[object];
        object.translation.varies() || node.is_some_and(|n| object.nodes[n].moves)
    }
}
