//! A froxel grid in double precision: twin of `grid.wgsl`.

use glam::{DVec2, DVec3};
use tyndall_plugin::PortData;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::Camera;

/// Where the slices of a grid stand: twin of `Grid`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Where the first slice ends, m.
    pub near: f64,
    /// Where the last slice ends, m.
    pub far: f64,
    /// Number of slices, at least 2.
    pub slices: u32,
}

impl Grid {
    /// Distance of a border along the ray, m: 0 of border 0, then from `near` to `far` by equal ratios.
    pub fn border(&self, border: u32) -> f64 {
        if border == 0 {
            return 0.0;
        }
        let part = f64::from(border - 1) / f64::from(self.slices - 1);
        self.near.powf(1.0 - part) * self.far.powf(part)
    }

    /// The slice that holds a distance; the last one beyond the far end.
    pub fn slice(&self, way: f64) -> u32 {
        (1..self.slices).take_while(|border| self.border(*border) <= way).count() as u32
    }

    /// The grid as a pass was given it: near and far, and as many slices as its texture has.
    pub(crate) fn read(data: &PortData, texture: &PortData) -> Result<Self, String> {
        match (data.get(0), data.get(1)) {
            (Some(near), Some(far)) => Ok(Self { near, far, slices: texture.layers() }),
            _ => Err("the grid is cut short".to_owned()),
        }
    }
}

/// The ray through a point of the picture, 0 to 1 to the right and down.
pub fn ray_of_point(camera: &Camera, at: DVec2) -> Ray {
    let across = 2.0 * at - 1.0;
    let direction = camera.forward + across.x * camera.right - across.y * camera.up;
    Ray { origin: camera.position, direction: direction.normalize() }
}

/// A froxel of a texture; columns beyond the edge are those at the edge.
pub(crate) fn froxel(data: &PortData, column: [i64; 2], slice: u32) -> DVec3 {
    let [x, y] = [(column[0], data.width()), (column[1], data.height())];
    let [x, y] = [x, y].map(|(at, size)| at.clamp(0, i64::from(size) - 1) as u32);
    let [r, g, b, _] = data.texel([x, y, slice]);
    DVec3::new(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: Grid = Grid { near: 0.5, far: 100.0, slices: 12 };

    #[test]
    fn borders_grow_by_equal_ratios_from_near_to_far() {
        assert_eq!((GRID.border(0), GRID.border(1)), (0.0, 0.5));
        assert!((GRID.border(12) - 100.0).abs() < 1e-12);
        let ratios: Vec<f64> = (1..12).map(|border| GRID.border(border + 1) / GRID.border(border)).collect();
        assert!(ratios.iter().all(|ratio| (ratio / ratios[0] - 1.0).abs() < 1e-12), "{ratios:?}");
    }

    #[test]
    fn a_slice_holds_what_lies_between_its_borders() {
        for slice in 0..12 {
            let middle = 0.5 * (GRID.border(slice) + GRID.border(slice + 1));
            assert_eq!(GRID.slice(middle), slice);
        }
        assert_eq!((GRID.slice(0.0), GRID.slice(1e9)), (0, 11));
    }
}
