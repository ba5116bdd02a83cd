//! The lobes cosⁿ of a scene, of Phong surfaces and of spots, each once: a table of scattered light is made for each.
//! `cosine_lobes`, `shininess_layers` and `spot_layers` of `lobe_data.wgsl`.

use tyndall_plugin::scene::layout::Shape;
use tyndall_plugin::scene::model::LightKind;
use tyndall_plugin::scene::{Buffers, Encoder, Moment, Part, Scene, SceneData, cosine_of_cutoff, wgsl_struct};

/// How many there can be; the table of `surface_radiance.lobes` has one layer for each, and one for Lambert.
pub const COSINE_LOBES_MAX: usize = SHININESSES_MAX + SPOTS_MAX;

/// Of more shininesses, this many between the least and the largest stand for them, each the same factor above the one
/// before: a shininess from 1 to 1000 is then off by 17 % at most. What a lobe reflects in all stays right.
pub const SHININESSES_MAX: usize = 23;

/// Of more shapes of spots, the first ones stand for all: each of the others by the one of most alike mean cosine.
pub const SPOTS_MAX: usize = 8;

/// The least shininess where many stand for more: below it a lobe hardly changes.
const LEAST: f32 = 0.1;

wgsl_struct! {
    /// `CosineLobe`.
    pub(crate) struct CosineLobe {
        /// n.
        pub exponent: f32,
        /// Cosine of the half-angle.
        pub cos_cutoff: f32,
        /// Whether a spot's.
        pub is_spot: u32,
        /// 0.
        pub pad0: u32,
    }
}

/// The scene data that are worked out here. Which materials and which kinds of light there are is the same at all times.
pub(crate) fn data() -> SceneData {
    let items = vec![
        ("cosine_lobes", Shape::list::<CosineLobe>()),
        ("shininess_layers", Shape::list::<u32>()),
        ("spot_layers", Shape::list::<u32>()),
    ];
    SceneData::kept(items, &[Part::Materials], |_| Box::new(Lobes))
}

struct Lobes;

impl Encoder for Lobes {
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>) {
        let lobes = CosineLobes::of(moment.scene);
        data.set_list("shininess_layers", lobes.shininess_layers(&moment.scene.shininesses()));
        data.set_list("spot_layers", moment.scene.lights.iter().map(|light| lobes.layer_of_light(&light.kind)));
        data.set_list("cosine_lobes", lobes.items);
    }
}

/// Lobes of Phong surfaces, by growing shininess, then those of spots.
pub(crate) struct CosineLobes {
    pub items: Vec<CosineLobe>,
}

impl CosineLobes {
    pub fn of(scene: &Scene) -> Self {
        Self::new(scene.shininesses(), scene.lights.iter().map(|light| &light.kind))
    }

    /// Of these distinct shininesses, growing, and of the spots among these lights.
    fn new<'a>(shininesses: Vec<f32>, lights: impl Iterator<Item = &'a LightKind>) -> Self {
        let mut items: Vec<CosineLobe> = represented(shininesses).into_iter().map(phong).collect();
        items.extend(spots(lights).into_iter().take(SPOTS_MAX));
        Self { items }
    }

    /// The layer of each of these shininesses, behind a first 0 of what has no Phong lobe.
    pub fn shininess_layers(&self, shininesses: &[f32]) -> Vec<u32> {
        let layer = |shininess: &f32| {
            let distance = |lobe: &CosineLobe| (lobe.exponent.max(LEAST) / shininess.max(LEAST)).ln().abs();
            self.nearest(phong(*shininess), distance)
        };
        std::iter::once(0).chain(shininesses.iter().map(layer)).collect()
    }

    /// The layer of a spot, from 1; 0 of other lights.
    pub fn layer_of_light(&self, light: &LightKind) -> u32 {
        spot(light).map_or(0, |spot| self.nearest(spot, |lobe| (mean_cosine(lobe) - mean_cosine(&spot)).abs()))
    }

    fn nearest(&self, wanted: CosineLobe, distance: impl Fn(&CosineLobe) -> f32) -> u32 {
        let numbered = || (1..).zip(&self.items).filter(|(_, lobe)| lobe.is_spot == wanted.is_spot);
        let exact = numbered().find(|(_, lobe)| **lobe == wanted);
        let nearest = exact.or_else(|| numbered().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))));
        nearest.map_or(0, |(number, _)| number)
    }
}

/// How many of its spots differ in exponent or cutoff.
pub(crate) fn spot_shapes(scene: &Scene) -> usize {
    spots(scene.lights.iter().map(|light| &light.kind)).len()
}

/// The distinct shapes of spots, in the order of the lights.
fn spots<'a>(lights: impl Iterator<Item = &'a LightKind>) -> Vec<CosineLobe> {
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

    fn spot_light(exponent: f64, degrees: f64) -> LightKind {
        LightKind::Spot { exponent, cutoff: degrees.to_radians() }
    }

    fn exponents(lobes: &CosineLobes, layers: &[u32]) -> Vec<f32> {
        layers.iter().map(|layer| lobes.items[*layer as usize - 1].exponent).collect()
    }

    #[test]
    fn each_stands_once() {
        let shininesses = vec![1.0, 20.0];
        let lights = [spot_light(20.0, 90.0), LightKind::Point, spot_light(0.0, 30.0), spot_light(20.0, 120.0)];
        let lobes = CosineLobes::new(shininesses.clone(), lights.iter());
        let found: Vec<(f32, u32)> = lobes.items.iter().map(|lobe| (lobe.exponent, lobe.is_spot)).collect();
        assert_eq!(found, [(1.0, 0), (20.0, 0), (20.0, 1), (0.0, 1)]);
        assert_eq!(lobes.shininess_layers(&shininesses), [0, 1, 2]);
        assert_eq!(lights.map(|light| lobes.layer_of_light(&light)), [3, 0, 4, 3]);
        assert!(CosineLobes::new(Vec::new(), lights[1..2].iter()).items.is_empty());
    }

    #[test]
    fn as_many_shininesses_as_there_can_be_are_exact() {
        let shininesses: Vec<f32> = (0..SHININESSES_MAX).map(|i| i as f32 / 16.0).collect();
        let lobes = CosineLobes::new(shininesses.clone(), [].iter());
        assert_eq!(exponents(&lobes, &lobes.shininess_layers(&shininesses)[1..]), shininesses);
    }

    #[test]
    fn of_more_the_nearest_is_taken() {
        let mut shininesses: Vec<f32> = (0..200).map(|i| 1000f64.powf(f64::from(i) / 199.0) as f32).collect();
        let lobes = CosineLobes::new(shininesses.clone(), [].iter());
        assert_eq!(lobes.items.len(), SHININESSES_MAX);
        let layers = lobes.shininess_layers(&shininesses);
        assert_eq!(layers.len(), 201);
        for (exponent, shininess) in exponents(&lobes, &layers[1..]).into_iter().zip(&shininesses) {
            let ratio = f64::from(exponent) / f64::from(*shininess);
            assert!(ratio.ln().abs() < 1.17f64.ln(), "{ratio}");
        }
        shininesses.insert(0, 0.0);
        let lobes = CosineLobes::new(shininesses.clone(), [].iter());
        assert!(lobes.items.iter().all(|lobe| lobe.exponent.is_finite()));

        let spots: Vec<LightKind> = (0..30).map(|i| spot_light(0.0, 5.0 + 5.0 * f64::from(i))).collect();
        let lobes = CosineLobes::new(shininesses, spots.iter());
        assert_eq!(lobes.items.len(), COSINE_LOBES_MAX);
        let first = SHININESSES_MAX as u32 + 1;
        let layers = (lobes.layer_of_light(&spots[0]), lobes.layer_of_light(&spots[29]));
        assert_eq!(layers, (first, first + SPOTS_MAX as u32 - 1));
    }

    #[test]
    fn mean_cosines() {
        let of = |exponent, cos_cutoff| mean_cosine(&CosineLobe { exponent, cos_cutoff, is_spot: 1, pad0: 0 });
        assert_eq!((of(0.0, 0.5), of(0.0, -1.0), of(1.0, 0.0)), (0.75, 0.0, 2.0 / 3.0));
        assert!((of(3.0, 0.999) - 0.9995).abs() < 1e-3);
    }
}
