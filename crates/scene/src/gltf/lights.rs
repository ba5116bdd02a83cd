//! Lights (KHR_lights_punctual) and cameras of a glTF file.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use gltf::json::Root;
use gltf::json::camera::Type as CameraType;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Type};
use gltf::json::validation::Checked::Valid;

use super::accessors::absent;
use super::fault::{At, Checked, Fault, Report, Unread, element, numbered};
use super::nodes::Hierarchy;
use crate::codes::{GLTF_CAMERA, GLTF_LIGHT};
use crate::model::LightKind;

/// A light at a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModelLight {
    pub node: usize,
    pub kind: LightKind,
    /// W/sr (candela one to one) or W/m² (lux one to one).
    pub intensity: DVec3,
}

/// The lights of all nodes, in the order of the hierarchy.
pub(crate) fn lights(root: &Root, hierarchy: &Hierarchy, report: &mut Report) -> Vec<ModelLight> {
    let all: &[JsonLight] = root.as_ref();
    let mut lights = Vec::new();
    for (node, (index, _)) in hierarchy.iter().enumerate() {
        let json = &root.nodes[*index];
        let extension = json.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
        let Some(number) = extension.map(|e| e.light.value()) else { continue };
        let light = match all.get(number) {
            None => Err(absent("light", number)).at(|| element("node", *index, json.name.as_deref())),
            Some(light) => kind(light)
                .and_then(|kind| Ok((kind, intensity(light)?)))
                .at(|| element("light", number, light.name.as_deref())),
        };
        lights.extend(report.take(light).map(|(kind, intensity)| ModelLight { node, kind, intensity }));
    }
    lights
}

fn kind(light: &JsonLight) -> Checked<LightKind> {
    match light.type_ {
        Valid(Type::Point) => Ok(LightKind::Point),
        Valid(Type::Directional) => Ok(LightKind::Directional),
        Valid(Type::Spot) => {
            let spot = light.spot.as_ref().ok_or_else(|| Fault::new(GLTF_LIGHT, "a spot without cone angles"))?;
            let outer = f64::from(spot.outer_cone_angle);
            // π/2 as an f32 is a little more than π/2.
            if !(outer > 0.0 && outer <= FRAC_PI_2 + 1e-6) {
                return Err(Fault::new(GLTF_LIGHT, format!("outerConeAngle {outer} does not lie in 0..π/2")));
            }
            Ok(LightKind::Spot { exponent: 0.0, cutoff: outer.min(FRAC_PI_2) })
        }
        _ => Err(Fault::new(GLTF_LIGHT, "unknown type")),
    }
}

fn intensity(light: &JsonLight) -> Checked<DVec3> {
    let value = DVec3::from_array(light.color.map(f64::from)) * f64::from(light.intensity);
    if value.is_finite() && value.min_element() >= 0.0 {
        Ok(value)
    } else {
        Err(Fault::new(GLTF_LIGHT, format!("color × intensity {value} is negative or not finite")))
    }
}

/// Node and vertical field of view of the first perspective camera in the hierarchy.
pub(crate) fn camera(root: &Root, hierarchy: &Hierarchy, report: &mut Report) -> Option<(usize, f64)> {
    for (node, (index, _)) in hierarchy.iter().enumerate() {
        let json = &root.nodes[*index];
        let Some(number) = json.camera.map(|c| c.value()) else { continue };
        let Some(camera) = root.cameras.get(number) else {
            let label = element("node", *index, json.name.as_deref());
            report.fault(Fault::new(crate::codes::GLTF_REFERENCE, format!("{label}: camera {number} does not exist")));
            continue;
        };
        let label = || element("camera", number, camera.name.as_deref());
        match (&camera.type_, &camera.perspective) {
            (Valid(CameraType::Perspective), Some(perspective)) => {
                let angle = f64::from(perspective.yfov);
                if angle > 0.0 && angle < PI {
                    return Some((node, angle));
                }
                report.fault(Fault::new(GLTF_CAMERA, format!("{}: yfov {angle} does not lie in 0..π", label())));
            }
            (Valid(CameraType::Orthographic), _) => {
                report.unread(Unread::ORTHOGRAPHIC, numbered(number, camera.name.as_deref()));
            }
            _ => report.fault(Fault::new(GLTF_CAMERA, format!("{}: neither perspective nor orthographic", label()))),
        }
    }
    None
}
