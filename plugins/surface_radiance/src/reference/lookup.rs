//! Scattered light on surfaces as the thesis looks it up.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::airlight_table::Table;
use tyndall_shaders::lights::incident;
use tyndall_shaders::phase;
use tyndall_shaders::scene::{HeightFog, Light, Medium};

use super::tables::TABLE_DEPTH;
use super::{Surface, of_surfaces, rgb};

/// By J.
pub(crate) fn table(input: &ReferenceInput<'_>) -> Outputs {
    of_tables(input, [1.0, 0.0, 0.0, 0.0])
}

/// By J_k and the first four terms of the phase function's Legendre series.
pub(crate) fn legendre(input: &ReferenceInput<'_>) -> Outputs {
    let means = phase::legendre(&input.scene()?.medium.phase);
    of_tables(input, std::array::from_fn(|k| (2.0 * k as f64 + 1.0) / (4.0 * PI) * means[k]))
}

fn of_tables(input: &ReferenceInput<'_>, weights: [f64; 4]) -> Outputs {
    let (lambert, phong) = (input.input("lambert")?, input.input("phong")?);
    let numbers = [lambert, phong].map(PortData::floats);
    let [lambert, phong] = [(lambert, &numbers[0]), (phong, &numbers[1])].map(|(port, numbers)| of_port(port, numbers));
    of_surfaces(input, &HeightFog::NONE, |scene, light, surface| {
        scattered(&scene.medium, light, surface, weights, [lambert, phong])
    })
}

fn of_port<'a>(data: &PortData, numbers: &'a [f32]) -> Table<'a> {
    Table { size: [data.width(), data.height()], channels: data.channels(), data: numbers }
}

/// I sigma_s/d (rho/pi J^1 + k_s J^n); of a directional light nothing.
fn scattered(
    medium: &Medium,
    light: &Light,
    surface: &Surface,
    weights: [f64; 4],
    [lambert, phong]: [Table<'_>; 2],
) -> DVec3 {
    if matches!(light, Light::Directional { .. }) {
        return DVec3::ZERO;
    }
    let arriving = incident(light, surface.position);
    let j = |table: &Table<'_>, axis: DVec3| {
        let cosine = axis.dot(arriving.to_light);
        let channel = |extinction: f64| {
            let place = [extinction * arriving.way / TABLE_DEPTH, cosine.clamp(-1.0, 1.0).acos() / FRAC_PI_2];
            if cosine < 0.0 { 0.0 } else { table.at(weights, place) }
        };
        DVec3::from_array(medium.extinction.to_array().map(channel))
    };
    let reflected =
        rgb(&surface.diffuse) / PI * j(&lambert, surface.normal) + rgb(&surface.phong) * j(&phong, surface.mirrored);
    arriving.irradiance * arriving.way * medium.scattering() * reflected
}
