//! A scene as the twins of the shaders take it.

use glam::DVec3;
use tyndall_scene::model::LightKind;
use tyndall_scene::{FrameLight, Scene};
use tyndall_shaders::scene::{Camera, Light, Medium, Phase};

/// What a scene without a medium has.
const NO_MEDIUM: Medium = Medium { extinction: DVec3::ZERO, albedo: DVec3::ONE, phase: Phase::Isotropic };

/// What double-precision light needs of a scene at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Twin {
    pub camera: Camera,
    pub medium: Medium,
    pub lights: Vec<Light>,
}

impl Twin {
    /// Of a scene at time 0, in a picture of this width/height.
    pub fn new(scene: &Scene, aspect: f64) -> Self {
        let frame = scene.at(0.0);
        let view = frame.camera;
        let tangent = (view.vertical_fov / 2.0).tan();
        let camera = Camera {
            position: view.position,
            right: view.right * tangent * aspect,
            up: view.up * tangent,
            forward: view.forward,
        };
        Self { camera, medium: scene.medium.unwrap_or(NO_MEDIUM), lights: frame.lights.iter().map(light).collect() }
    }
}

fn light(light: &FrameLight) -> Light {
    let FrameLight { kind, position, direction, intensity, radius } = *light;
    match kind {
        LightKind::Point => Light::Point { position, intensity, radius },
        LightKind::Spot { exponent, cutoff } => {
            Light::Spot { position, intensity, radius, direction, exponent, cutoff: cutoff.to_degrees() }
        }
        LightKind::Directional => Light::Directional { direction, irradiance: intensity },
    }
}
