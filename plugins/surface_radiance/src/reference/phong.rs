//! Direct and scattered light on surfaces; the latter from the table of lobes that the pass was given.

use std::f64::consts::PI;

use glam::DVec3;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::lights::incident;
use tyndall_shaders::scene::{HeightFog, Light, Scene};

use super::around::row_of;
use super::lobes::{AngleAxis, Lobe, lobes_of};
use super::{Surface, of_surfaces, rgb, straight};
use crate::cosine_lobes::CosineLobes;

/// Light of every light, as the parameters ask for.
pub(crate) fn phong(input: &ReferenceInput<'_>) -> Outputs {
    let table = if input.is_on("scattered") { Some(input.input("table")?) } else { None };
    let direct = input.is_on("direct");
    let layers = Layers::of(input.moment()?.scene);
    of_surfaces(input, &HeightFog::NONE, table.is_some(), |scene, light, surface| {
        let mut sum = DVec3::ZERO;
        if direct {
            sum += straight(scene, &HeightFog::NONE, light, surface);
        }
        if let Some(table) = table {
            sum += scattered(scene, light, surface, &layers, table);
        }
        sum
    })
}

/// What the medium scatters to a surface on the way.
fn scattered(scene: &Scene, light: &Light, surface: &Surface, layers: &Layers, table: &PortData) -> DVec3 {
    let (medium, arriving) = (&scene.medium, incident(light, surface.position));
    let is_sun = matches!(light, Light::Directional { .. });
    let on_axis = match *light {
        Light::Directional { irradiance, .. } => irradiance,
        Light::Point { intensity, .. } | Light::Spot { intensity, .. } => intensity / arriving.way.powi(2),
    };
    let of = |axis: DVec3, layer: u32, angles: &AngleAxis| {
        let at = angles.coordinate((0.5 * (axis - arriving.to_light).length()).min(1.0));
        DVec3::from_array(std::array::from_fn(|channel| {
            let depth = (!is_sun).then(|| medium.extinction[channel] * arriving.way);
            cell(table, layer, at, depth)
        }))
    };
    let of_lobe = |n: f64, axis: DVec3, layer: u32| {
        of(axis, layer, &AngleAxis::new(n, -1.0, table.width())) * 2.0 * PI / (n + 1.0)
    };
    let lambert = of_lobe(1.0, surface.normal, 0);
    let phong = of_lobe(surface.phong[3], surface.mirrored, layers.of_shininesses[surface.diffuse[3] as usize]);
    let all_around = match *light {
        Light::Spot { direction, exponent, cutoff, .. } => {
            let cos_cutoff = cutoff.to_radians().cos();
            let layer = layers.of_spot(exponent, cos_cutoff);
            of(-direction, layer, &AngleAxis::new(exponent, cos_cutoff, table.width()))
        }
        _ => DVec3::ONE,
    };
    let lit = DVec3::from_array(medium.extinction.to_array().map(|sigma| f64::from(sigma > 0.0)));
    let scattering = if is_sun { medium.albedo * lit } else { medium.scattering() * arriving.way };
    let reflected = rgb(&surface.diffuse) / PI * lambert + rgb(&surface.phong) * phong;
    let left = (-medium.extinction * arriving.way).exp();
    scattering * reflected * all_around * on_axis * left
}

/// The layers of the table.
struct Layers {
    lobes: Vec<Lobe>,
    /// By their rank, from 1.
    of_shininesses: Vec<u32>,
}

impl Layers {
    fn of(scene: &tyndall_plugin::scene::Scene) -> Self {
        let of_shininesses = CosineLobes::of(scene).shininess_layers(&scene.shininesses());
        Self { lobes: lobes_of(scene), of_shininesses }
    }

    /// That of the spot among the lobes of the scene that is as it is.
    fn of_spot(&self, exponent: f64, cos_cutoff: f64) -> u32 {
        let off = |lobe: &Lobe| (lobe.exponent - exponent).abs() + (lobe.cos_cutoff - cos_cutoff).abs();
        let spots = (0..).zip(&self.lobes).filter(|(_, lobe)| lobe.is_spot);
        spots.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).map_or(0, |(layer, _)| layer)
    }
}

/// The table between the corners of a cell, at an angle's coordinate and a depth; without one in the last row.
fn cell(table: &PortData, layer: u32, angle: f64, depth: Option<f64>) -> f64 {
    let last = table.height() - 1;
    let column = (angle as u32).min(table.width() - 1);
    let (row, down) = match depth {
        Some(depth) => {
            let at = row_of(depth, f64::from(last));
            let row = (at as u32).min(last - 1);
            (row, at - f64::from(row))
        }
        None => (last, 0.0),
    };
    let corners = table.texel([column, row, layer]);
    let across = angle - f64::from(column);
    let mix = |a: f64, b: f64, part: f64| a + (b - a) * part;
    mix(mix(corners[0], corners[1], across), mix(corners[2], corners[3], across), down)
}
