//! The distinct shininesses of a scene: a table of scattered light is made for each.

use crate::model::Material;

/// How many there can be; `surface_radiance.lobes` has one layer for each, and one for Lambert.
pub const SHININESSES_MAX: usize = 31;

/// The shininesses of the materials with a Phong lobe, each once, growing.
///
/// Where there are more than [`SHININESSES_MAX`], that many values between the least and the largest stand for them, each
/// the same factor above the one before: a shininess from 1 to 1000 is then off by 12 % at most.
pub(crate) struct Shininesses {
    pub values: Vec<f32>,
}

/// The least shininess that can be one of many values by which a range is divided: below it a lobe hardly changes.
const LEAST: f32 = 0.1;

impl Shininesses {
    pub fn of(materials: &[Material]) -> Self {
        let mut values: Vec<f32> = materials.iter().filter(|m| has_lobe(m)).map(|m| m.shininess as f32).collect();
        values.sort_by(f32::total_cmp);
        values.dedup();
        if let [least, .., largest] = values[..]
            && values.len() > SHININESSES_MAX
        {
            let (low, high) = (least.max(LEAST).ln(), largest.max(LEAST).ln());
            let value = |i: usize| (low + (high - low) * i as f32 / (SHININESSES_MAX - 1) as f32).exp();
            values = (0..SHININESSES_MAX).map(value).collect();
        }
        Self { values }
    }

    /// Of the value nearest to the material's, by their ratio, from 1; 0 where it has no Phong lobe.
    pub fn index(&self, material: &Material) -> u32 {
        let distance = |value: f32| (value.max(LEAST) / (material.shininess as f32).max(LEAST)).ln().abs();
        let nearest = (1..).zip(&self.values).min_by(|a, b| distance(*a.1).total_cmp(&distance(*b.1)));
        nearest.filter(|_| has_lobe(material)).map_or(0, |(index, _)| index)
    }
}

fn has_lobe(material: &Material) -> bool {
    material.specular.max_element() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn material(specular: f64, shininess: f64) -> Material {
        Material { specular: DVec3::splat(specular), shininess, ..Material::default() }
    }

    #[test]
    fn each_stands_once() {
        let materials = [(0.0, 5.0), (0.5, 20.0), (0.1, 1.0), (0.2, 20.0), (0.0, 1.0)].map(|(k, n)| material(k, n));
        let shininesses = Shininesses::of(&materials);
        assert_eq!(shininesses.values, [1.0, 20.0]);
        assert_eq!(materials.map(|material| shininesses.index(&material)), [0, 2, 1, 2, 0]);
        assert!(Shininesses::of(&materials[..1]).values.is_empty());
    }

    #[test]
    fn as_many_as_there_can_be_are_exact() {
        let materials: Vec<Material> = (0..SHININESSES_MAX).map(|i| material(0.1, i as f64)).collect();
        let shininesses = Shininesses::of(&materials);
        for (i, material) in materials.iter().enumerate() {
            let index = shininesses.index(material) as usize;
            // 0 and what is near it differ by less than LEAST
            assert!(index == i + 1 && shininesses.values[index - 1] == i as f32);
        }
    }

    #[test]
    fn of_more_the_nearest_is_taken() {
        let materials: Vec<Material> = (0..200).map(|i| material(0.1, 1000f64.powf(f64::from(i) / 199.0))).collect();
        let shininesses = Shininesses::of(&materials);
        assert_eq!(shininesses.values.len(), SHININESSES_MAX);
        for material in &materials {
            let value = shininesses.values[shininesses.index(material) as usize - 1];
            assert!((f64::from(value) / material.shininess).ln().abs() < 0.5 * 1000f64.ln() / 30.0 + 1e-6);
        }
        let with_zero: Vec<Material> = materials.iter().copied().chain([material(0.1, 0.0)]).collect();
        assert!(Shininesses::of(&with_zero).values.iter().all(|value| value.is_finite()));
    }
}
