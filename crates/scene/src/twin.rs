//! A scene at one time as the twins of shaders take it.

use glam::DVec3;
use tyndall_shaders::scene as twin;

use crate::cosine_lobes::CosineLobes;
use crate::frame::{FrameLight, View};
use crate::layout::CosineLobe;
use crate::model::LightKind;
use crate::scene::Scene;

impl Scene {
    /// What [`Scene::encode`] gives shaders, in double precision, for the twins of shaders; triangles apart.
    pub fn twin(&self, time: f64, aspect: f64) -> twin::Scene {
        let frame = self.at(time);
        let shiny = self.materials.iter().filter(|material| material.specular.max_element() > 0.0);
        let lobes = CosineLobes::of(&self.materials, &frame.lights);
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
            shininesses: shiny.map(|material| material.shininess).collect(),
            cosine_lobes: lobes.items.iter().map(cosine_lobe).collect(),
        }
    }
}

fn cosine_lobe(lobe: &CosineLobe) -> twin::CosineLobe {
    let [exponent, cos_cutoff] = [lobe.exponent, lobe.cos_cutoff].map(f64::from);
    twin::CosineLobe { exponent, cos_cutoff, is_spot: lobe.is_spot != 0 }
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
