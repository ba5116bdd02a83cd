//! The view ray of a pixel: twin of `ray.wgsl`.

use crate::scene::Camera;
use glam::DVec3;

/// A half-line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts, m.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

impl Ray {
    /// The point `x` metres along the ray.
    pub fn at(&self, x: f64) -> DVec3 {
        self.origin + x * self.direction
    }
}

/// The ray through the centre of a pixel of an image of this size; row 0 is the top.
pub fn ray_of_pixel(camera: &Camera, pixel: [u32; 2], size: [u32; 2]) -> Ray {
    let across = |axis: usize| (2.0 * f64::from(pixel[axis]) + 1.0) / f64::from(size[axis]) - 1.0;
    let direction = camera.forward + across(0) * camera.right - across(1) * camera.up;
    Ray { origin: camera.position, direction: direction.normalize() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_is_the_top_and_rays_go_through_centres() {
        let camera =
            Camera { position: DVec3::ONE, nearest: 1e-6, right: 2.0 * DVec3::X, up: DVec3::Y, forward: DVec3::NEG_Z };
        let ray = ray_of_pixel(&camera, [0, 0], [4, 2]);
        let expected = DVec3::new(-1.5, 0.5, -1.0).normalize();
        assert!((ray.direction - expected).length() < 1e-15);
        assert_eq!(ray_of_pixel(&camera, [0, 0], [1, 1]).direction, DVec3::NEG_Z);
        assert_eq!(ray.origin, DVec3::ONE);
    }
}
