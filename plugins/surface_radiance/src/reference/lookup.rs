//! Scattered light on surfaces as the papers look it up in tables.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use tyndall_plugin::{Outputs, PortData, ReferenceInput};
use tyndall_shaders::airlight_table::Table;
use tyndall_shaders::lights::incident;
use tyndall_shaders::phase;
use tyndall_shaders::scene::{HeightFog, Light, Medium};
use tyndall_shaders::surface_table::{CLAMPED_COSINE, zonal_polynomials};

use super::tables::TABLE_DEPTH;
use super::{Surface, of_surfaces, rgb};

/// By J.
pub(crate) fn table(input: &ReferenceInput<'_>) -> Outputs {
    by_angle(input, [1.0, 0.0, 0.0, 0.0])
}

/// By J_k and the first four terms of the phase function's Legendre series.
pub(crate) fn legendre(input: &ReferenceInput<'_>) -> Outputs {
    let means = phase::legendre(&input.scene()?.medium.phase);
    by_angle(input, std::array::from_fn(|k| (2.0 * k as f64 + 1.0) / (4.0 * PI) * means[k]))
}

/// By Γ_L, published or clamped, and Γ_P.
pub(crate) fn biri(input: &ReferenceInput<'_>) -> Outputs {
    let clamped = input.is_on("clamped");
    of_tables(input, |tables, along, [lambert, phong]| {
        let polynomials = zonal_polynomials(lambert);
        let weights = if clamped {
            std::array::from_fn(|i| CLAMPED_COSINE[i] * polynomials[i])
        } else {
            [0.0, polynomials[1], 0.0, 0.0]
        };
        let irradiance = 2.0 * PI * tables[0].at(weights, [along, 0.0]);
        let glossy = tables[1].at([1.0, 0.0, 0.0, 0.0], [along, 0.5 + 0.5 * phong]);
        [irradiance.max(0.0), if clamped || phong > 0.0 { glossy } else { 0.0 }]
    })
}

/// By tables whose rows are even in the angle, to 90°; each channel times its weight.
fn by_angle(input: &ReferenceInput<'_>, weights: [f64; 4]) -> Outputs {
    of_tables(input, |tables, along, cosines| {
        let at = |table: &Table<'_>, cosine: f64| {
            let place = [along, cosine.clamp(-1.0, 1.0).acos() / FRAC_PI_2];
            if cosine < 0.0 { 0.0 } else { table.at(weights, place) }
        };
        [at(&tables[0], cosines[0]), at(&tables[1], cosines[1])]
    })
}

/// What the lobes of Lambert and Phong receive: by their tables, T in parts of the tables' depth, and the cosines of the
/// angles between the light and their axes.
fn of_tables(
    input: &ReferenceInput<'_>,
    lobes_at: impl Fn([Table<'_>; 2], f64, [f64; 2]) -> [f64; 2] + Sync,
) -> Outputs {
    let (lambert, phong) = (input.input("lambert")?, input.input("phong")?);
    let numbers = [lambert, phong].map(PortData::floats);
    let tables = [of_port(lambert, &numbers[0]), of_port(phong, &numbers[1])];
    of_surfaces(input, &HeightFog::NONE, true, |scene, light, surface| {
        scattered(&scene.medium, light, surface, |along, cosines| lobes_at(tables, along, cosines))
    })
}

fn of_port<'a>(data: &PortData, numbers: &'a [f32]) -> Table<'a> {
    Table { size: [data.width(), data.height()], channels: data.channels(), data: numbers }
}

/// I sigma_s/d (rho/pi J^1 + k_s J^n); of a directional light nothing.
fn scattered(medium: &Medium, light: &Light, surface: &Surface, lobes_at: impl Fn(f64, [f64; 2]) -> [f64; 2]) -> DVec3 {
    if matches!(light, Light::Directional { .. }) {
        return DVec3::ZERO;
    }
    let arriving = incident(light, surface.position);
    let cosines = [surface.normal, surface.mirrored].map(|axis| axis.dot(arriving.to_light));
    let channels =
        medium.extinction.to_array().map(|extinction| lobes_at(extinction * arriving.way / TABLE_DEPTH, cosines));
    let lobe = |which: usize| DVec3::from_array(channels.map(|lobes| lobes[which]));
    let reflected = rgb(&surface.diffuse) / PI * lobe(0) + rgb(&surface.phong) * lobe(1);
    arriving.irradiance * arriving.way * medium.scattering() * reflected
}
