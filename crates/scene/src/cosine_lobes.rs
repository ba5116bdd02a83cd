//! The lobes cosⁿ of a scene, of Phong surfaces and of spots, each once: a table of scattered light is made for each.

use crate::encode::cosine_of_cutoff;
use crate::frame::FrameLight;
use crate::layout::CosineLobe;
use crate::model::{LightKind, Material};

/// How many there can be; the table of `surface_radiance.lobes` has one layer for each, and one for Lambert.
pub const COSINE_LOBES_MAX: usize = SHININESSES_MAX + SPOTS_MAX;

/// Of more shininesses, this many between the least and the largest stand for them, each the same factor above the one
/// before: a shininess from 1 to 1000 is then off by 17 % at most. What a lobe reflects in all stays right.
pub const SHININESSES_MAX: usize = 23;

/// Of more shapes of spots, the first ones stand for all: each of the others by the one of most alike mean cosine.
pub const SPOTS_MAX: usize = 8;

/// The least shininess where many stand for more: below it a lobe hardly changes.
const LEAST: f32 = 0.1;

/// Lobes of Phong surfaces, by growing shininess, then those of spots.
pub(crate) struct CosineLobes {
    pub items: Vec<CosineLobe>,
}

impl CosineLobes {
    pub fn of(materials: &[Material], lights: &[FrameLight]) -> Self {
        let mut items: Vec<CosineLobe> = represented(shininesses(materials)).into_iter().map(phong).collect();
        items.extend(spots(lights.iter().map(|light| &light.kind)).into_iter().take(SPOTS_MAX));
        Self { items }
    }

    /// The number of a material's lobe, from 1; 0 where it has none.
    pub fn of_material(&self, material: &Material) -> u32 {
        let shininess = material.shininess as f32;
        let distance = |lobe: &CosineLobe| (lobe.exponent.max(LEAST) / shininess.max(LEAST)).ln().abs();
        if has_lobe(material) { self.nearest(phong(shininess), distance) } else { 0 }
    }

    /// The number of a spot's lobe, from 1; 0 of other lights.
    pub fn of_light(&self, light: &FrameLight) -> u32 {
        spot(&light.kind).map_or(0, |spot| self.nearest(spot, |lobe| (mean_cosine(lobe) - mean_cosine(&spot)).abs()))
    }

    fn nearest(&self, wanted: CosineLobe, distance: impl Fn(&CosineLobe) -> f32) -> u32 {
        let numbered = || (1..).zip(&self.items).filter(|(_, lobe)| lobe.is_spot == wanted.is_spot);
        let exact = numbered().find(|(_, lobe)| **lobe == wanted);
        let nearest = exact.or_else(|| numbered().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))));
        nearest.map_or(0, |(number, _)| number)
    }
}

/// The distinct shininesses of Phong lobes, growing.
pub(crate) fn shininesses(materials: &[Material]) -> Vec<f32> {
    let mut values: Vec<f32> = materials.iter().filter(|m| has_lobe(m)).map(|m| m.shininess as f32).collect();
    values.sort_by(f32::total_cmp);
    values.dedup();
    values
}

/// The distinct shapes of spots, in the order of the lights.
pub(crate) fn spots<'a>(lights: impl Iterator<Item = &'a LightKind>) -> Vec<CosineLobe> {
    let mut items = Vec::new();
    for spot in lights.filter_map(spot) {
        if !items.contains(&spot) {
            items.push(spot);
        }
    }
    items
}

/// Those shininesses, or as many as there can be which stand for them.
fn represented(values: Vec<f32>) -> Vec<f32> {
    match values[..] {
        [least, .., largest] if values.len() > SHININESSES_MAX => {
            let (low, high) = (least.max(LEAST).ln(), largest.max(LEAST).ln());
            let value = |i: usize| (low + (high - low) * i as f32 / (SHININESSES_MAX - 1) as f32).exp();
            (0..SHININESSES_MAX).map(value).collect()
        }
        _ => values,
    }
}

fn has_lobe(material: &Material) -> bool {
    material.specular.max_element() > 0.0
}

fn phong(shininess: f32) -> CosineLobe {
    CosineLobe { exponent: shininess, cos_cutoff: 0.0, is_spot: 0, pad0: 0 }
}

fn spot(kind: &LightKind) -> Option<CosineLobe> {
    let LightKind::Spot { exponent, cutoff } = *kind else { return None };
    let (exponent, cos_cutoff) = (exponent as f32, cosine_of_cutoff(cutoff));
    // beyond a right angle only a spot with n = 0 shines
    let cos_cutoff = if exponent > 0.0 { cos_cutoff.max(0.0) } else { cos_cutoff };
    Some(CosineLobe { exponent, cos_cutoff, is_spot: 1, pad0: 0 })
}

/// Of the directions of a lobe, by their intensity: from ∫ cᴺ⁺¹ dc / ∫ cᴺ dc.
fn mean_cosine(lobe: &CosineLobe) -> f32 {
    let (n, c) = (lobe.exponent, lobe.cos_cutoff);
    if n == 0.0 {
        return 0.5 * (1.0 + c);
    }
    (n + 1.0) / (n + 2.0) * (1.0 - c.powf(n + 2.0)) / (1.0 - c.powf(n + 1.0)).max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn material(specular: f64, shininess: f64) -> Material {
        Material { specular: DVec3::splat(specular), shininess, ..Material::default() }
    }

    fn light(kind: LightKind) -> FrameLight {
        FrameLight { position: DVec3::ZERO, direction: DVec3::NEG_Y, intensity: DVec3::ONE, radius: 0.0, kind }
    }

    fn spot_light(exponent: f64, degrees: f64) -> FrameLight {
        light(LightKind::Spot { exponent, cutoff: degrees.to_radians() })
    }

    fn shininess_of(lobes: &CosineLobes, material: &Material) -> f32 {
        lobes.items[lobes.of_material(material) as usize - 1].exponent
    }

    #[test]
    fn each_stands_once() {
        let materials = [(0.0, 5.0), (0.5, 20.0), (0.1, 1.0), (0.2, 20.0), (0.0, 1.0)].map(|(k, n)| material(k, n));
        let lights = [spot_light(20.0, 90.0), light(LightKind::Point), spot_light(0.0, 30.0), spot_light(20.0, 120.0)];
        let lobes = CosineLobes::of(&materials, &lights);
        let found: Vec<(f32, u32)> = lobes.items.iter().map(|lobe| (lobe.exponent, lobe.is_spot)).collect();
        assert_eq!(found, [(1.0, 0), (20.0, 0), (20.0, 1), (0.0, 1)]);
        assert_eq!(materials.map(|material| lobes.of_material(&material)), [0, 2, 1, 2, 0]);
        assert_eq!(lights.map(|light| lobes.of_light(&light)), [3, 0, 4, 3]);
        assert!(CosineLobes::of(&materials[..1], &lights[1..2]).items.is_empty());
    }

    #[test]
    fn as_many_shininesses_as_there_can_be_are_exact() {
        let materials: Vec<Material> = (0..SHININESSES_MAX).map(|i| material(0.1, i as f64 / 16.0)).collect();
        let lobes = CosineLobes::of(&materials, &[]);
        assert!(materials.iter().all(|material| f64::from(shininess_of(&lobes, material)) == material.shininess));
    }

    #[test]
    fn of_more_the_nearest_is_taken() {
        let mut materials: Vec<Material> =
            (0..200).map(|i| material(0.1, 1000f64.powf(f64::from(i) / 199.0))).collect();
        let lobes = CosineLobes::of(&materials, &[]);
        assert_eq!(lobes.items.len(), SHININESSES_MAX);
        for material in &materials {
            let ratio = f64::from(shininess_of(&lobes, material)) / material.shininess;
            assert!(ratio.ln().abs() < 1.17f64.ln(), "{ratio}");
        }
        materials.push(material(0.1, 0.0));
        let lobes = CosineLobes::of(&materials, &[]);
        assert!(lobes.items.iter().all(|lobe| lobe.exponent.is_finite()));

        let spots: Vec<FrameLight> = (0..30).map(|i| spot_light(0.0, 5.0 + 5.0 * f64::from(i))).collect();
        let lobes = CosineLobes::of(&materials, &spots);
        assert_eq!(lobes.items.len(), COSINE_LOBES_MAX);
        let first = SHININESSES_MAX as u32 + 1;
        assert_eq!((lobes.of_light(&spots[0]), lobes.of_light(&spots[29])), (first, first + SPOTS_MAX as u32 - 1));
    }

    #[test]
    fn mean_cosines() {
        let of = |exponent, cos_cutoff| mean_cosine(&CosineLobe { exponent, cos_cutoff, is_spot: 1, pad0: 0 });
        assert_eq!((of(0.0, 0.5), of(0.0, -1.0), of(1.0, 0.0)), (0.75, 0.0, 2.0 / 3.0));
        assert!((of(3.0, 0.999) - 0.9995).abs() < 1e-3);
    }
}
