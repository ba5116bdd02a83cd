//! A scene at one time: what scene data are made of.

use glam::{DVec3, Vec3};
use tyndall_shaders::scene::Caster;

use crate::frame::Frame;
use crate::geometry::world_triangles;
use crate::scene::Scene;

/// A scene at one time, for a picture of one shape.
pub struct Moment<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Seconds.
    pub time: f64,
    /// Width over height of the picture.
    pub aspect: f64,
    /// What depends on the time, from the scene's origin.
    pub frame: Frame,
}

impl Moment<'_> {
    /// The vertices of all instances one after another, from the scene's origin, m, rounded to single precision as passes read them.
    pub fn positions(&self) -> impl Iterator<Item = DVec3> {
        let instances = self.scene.instances.iter().zip(&self.frame.transforms);
        instances.flat_map(|(instance, transform)| {
            let world = |position: &Vec3| transform.transform_point3(position.as_dvec3()).as_vec3().as_dvec3();
            instance.mesh.positions.iter().map(world)
        })
    }

    /// Corners of all triangles as indices into [`Moment::positions`], with the index of their instance;
    /// counter-clockwise seen from outside.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 4]> {
        world_triangles(self.scene, &self.frame)
    }

    /// The triangles of all objects that cast shadows, from the scene's origin, m.
    pub fn casters(&self) -> Vec<Caster> {
        self.scene.casters(&self.frame)
    }
}

impl Scene {
    /// The scene at a time, for pictures of this width over height.
    pub fn moment(&self, time: f64, aspect: f64) -> Moment<'_> {
        Moment { scene: self, time, aspect, frame: self.at(time) }
    }
}
