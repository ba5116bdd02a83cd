//! A scene at one time as the twins of shaders take it.

use glam::DVec3;
use tyndall_shaders::scene as twin;

use crate::frame::{Frame, FrameLight, View};
use crate::model::LightKind;
use crate::scene::Scene;

impl Scene {
    /// What [`Scene::encode`] gives shaders, in double precision, for the twins of shaders; of surfaces the shadows alone.
    pub fn twin(&self, time: f64, aspect: f64) -> twin::Scene {
        let frame = self.at(time);
        twin::Scene {
            camera: camera(&frame.camera, aspect),
            medium: self.medium.unwrap_or(twin::Medium {
                extinction: DVec3::ZERO,
                albedo: DVec3::ONE,
                phase: twin::Phase::Isotropic,
            }),
            height_fog: self.height_fog,
            ambient: self.ambient,
            background: self.background,
            lights: frame.lights.iter().map(light).collect(),
            casters: self.casters(&frame),
        }
    }

    /// The triangles of all objects that cast shadows, in world space.
    pub(crate) fn casters(&self, frame: &Frame) -> Vec<twin::Triangle> {
        let instances = self.instances.iter().zip(&frame.transforms).filter(|(instance, _)| instance.casts_shadow);
        let triangles = instances.flat_map(|(instance, transform)| {
            let corner = |index: u32| transform.transform_point3(instance.mesh.positions[index as usize].as_dvec3());
            instance.mesh.triangles.iter().map(move |triangle| triangle.map(corner))
        });
        triangles.collect()
    }
}

fn camera(view: &View, aspect: f64) -> twin::Camera {
    let tangent = (view.vertical_fov / 2.0).tan();
    let (right, up) = (view.right * tangent * aspect, view.up * tangent);
    twin::Camera { position: view.position, right, up, forward: view.forward }
}

fn light(light: &FrameLight) -> twin::Light {
    let FrameLight { kind, position, direction, intensity, radius } = *light;
    match kind {
        LightKind::Point => twin::Light::Point { position, intensity, radius },
        LightKind::Directional => twin::Light::Directional { direction, irradiance: intensity },
        LightKind::Spot { exponent, cutoff } => {
            twin::Light::Spot { position, intensity, radius, direction, exponent, cutoff: cutoff.to_degrees() }
        }
    }
}
