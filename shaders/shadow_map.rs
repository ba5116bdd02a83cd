//! A shadow map of lamps: twin of `shadow_map.wgsl`.

use crate::scene::{Caster, Light};
use glam::{DVec2, DVec3};

/// How lights share the layers of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiles {
    /// Tiles in a row.
    pub across: u32,
    /// Texels of a tile's edge.
    pub edge: u32,
}

impl Tiles {
    /// Of so many lights on layers of this size.
    pub fn new(lights: usize, size: u32) -> Self {
        let across = (1..).find(|across: &u32| (*across as usize).pow(2) >= lights).unwrap_or(1);
        Self { across, edge: (size / across).max(1) }
    }

    /// Texel and layer of the direction from a light to a point.
    pub fn texel(&self, light: usize, away: DVec3) -> ([u32; 2], u32) {
        let axis = away.abs().max_position();
        let beside: Vec<f64> =
            (0..3).filter(|other| *other != axis).map(|other| away[other] / away[axis].abs()).collect();
        let tile = [light as u32 % self.across, light as u32 / self.across];
        let place =
            |i: usize| ((0.5 + 0.5 * beside[i]) * f64::from(self.edge)).clamp(0.0, f64::from(self.edge - 1)) as u32;
        let texel = [0, 1].map(|i| tile[i] * self.edge + place(i));
        (texel, 2 * axis as u32 + u32::from(away[axis] < 0.0))
    }

    /// The light that a texel belongs to, whether there is one or not.
    pub fn light(&self, [x, y]: [u32; 2]) -> Option<usize> {
        let tile = [x, y].map(|at| at / self.edge);
        tile.iter().all(|at| *at < self.across).then(|| (tile[1] * self.across + tile[0]) as usize)
    }

    /// Unit vector to a texel's middle.
    pub fn direction(&self, [x, y]: [u32; 2], layer: u32) -> DVec3 {
        let middle = |at: u32| (2.0 * f64::from(at % self.edge) + 1.0) / f64::from(self.edge) - 1.0;
        let (beside, along) = (DVec2::new(middle(x), middle(y)), if layer % 2 == 1 { -1.0 } else { 1.0 });
        let direction = match layer / 2 {
            0 => DVec3::new(along, beside.x, beside.y),
            1 => DVec3::new(beside.x, along, beside.y),
            _ => DVec3::new(beside.x, beside.y, along),
        };
        direction.normalize()
    }
}

/// Whether a point is behind what a map holds of a light: distances by layer and row, m, in rows of `size` texels.
pub fn is_hidden(distances: &[f32], size: u32, lights: &[Light], light: usize, point: DVec3) -> bool {
    let Some(position) = lights.get(light).and_then(place) else { return false };
    let ([x, y], layer) = Tiles::new(lights.len(), size).texel(light, point - position);
    let nearest = distances.get(((layer * size + y) * size + x) as usize).copied().map_or(f64::INFINITY, f64::from);
    point.distance(position) > nearest
}

/// Where a light stands that has a map.
pub fn place(light: &Light) -> Option<DVec3> {
    match *light {
        Light::Point { position, .. } | Light::Spot { position, .. } => Some(position),
        Light::Directional { .. } => None,
    }
}

/// Distance of the nearest caster in a direction, m; infinite where there is none.
pub fn nearest(casters: &[Caster], origin: DVec3, direction: DVec3) -> f64 {
    casters.iter().filter_map(|caster| distance(caster, origin, direction)).fold(f64::INFINITY, f64::min)
}

/// Möller and Trumbore 1997.
fn distance(&[a, b, c]: &Caster, origin: DVec3, direction: DVec3) -> Option<f64> {
    let (to_b, to_c, from_a) = (b - a, c - a, origin - a);
    let across = direction.cross(to_c);
    let determinant = to_b.dot(across);
    let u = from_a.dot(across) / determinant;
    let turned = from_a.cross(to_b);
    let (v, way) = (direction.dot(turned) / determinant, to_c.dot(turned) / determinant);
    (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && way > 0.0).then_some(way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_and_directions_are_each_others_inverse() {
        for (lights, across) in [(0, 1), (1, 1), (2, 2), (4, 2), (5, 3), (9, 3), (10, 4)] {
            let tiles = Tiles::new(lights, 24);
            assert_eq!(tiles, Tiles { across, edge: 24 / across });
            for (x, y, layer) in (0..24).flat_map(|x| (0..24).flat_map(move |y| (0..6).map(move |layer| (x, y, layer))))
            {
                let light = tiles.light([x, y]).unwrap();
                assert_eq!(tiles.texel(light, 3.0 * tiles.direction([x, y], layer)), ([x, y], layer));
            }
        }
    }

    #[test]
    fn the_nearest_of_two_is_found() {
        let triangle = |z: f64| [DVec3::new(-1.0, -1.0, z), DVec3::new(1.0, -1.0, z), DVec3::new(0.0, 1.0, z)];
        let casters = [triangle(3.0), triangle(2.0), triangle(-1.0)];
        assert_eq!(nearest(&casters, DVec3::ZERO, DVec3::Z), 2.0);
        assert_eq!(nearest(&casters, DVec3::new(3.0, 0.0, 0.0), DVec3::Z), f64::INFINITY);
    }
}
