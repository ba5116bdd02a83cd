//! A homogeneous medium along a ray: twin of `medium.wgsl`.

use crate::scene::Medium;
use glam::DVec3;

/// What is left of light after a way through the medium, per channel: `e^(−σ_t·way)`, 1 where σ_t is 0 on any way.
pub fn transmittance(medium: &Medium, way: f64) -> DVec3 {
    DVec3::ONE - opacity(medium, way)
}

/// `1 − e^(−σ_t·way)`, without cancellation; `way` in metres, may be infinite.
pub fn opacity(medium: &Medium, way: f64) -> DVec3 {
    let channel = |extinction: f64| if extinction == 0.0 { 0.0 } else { -(-extinction * way).exp_m1() };
    DVec3::new(channel(medium.extinction.x), channel(medium.extinction.y), channel(medium.extinction.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Phase;

    #[test]
    fn transmittance_of_split_ways_is_the_product() {
        let medium = Medium { extinction: DVec3::new(0.0, 0.1, 2.0), albedo: DVec3::ONE, phase: Phase::Isotropic };
        let split = transmittance(&medium, 1.25) * transmittance(&medium, 2.5);
        assert!((transmittance(&medium, 3.75) - split).length() < 1e-15);
        assert_eq!(transmittance(&medium, f64::INFINITY), DVec3::X);
        assert_eq!(opacity(&medium, f64::INFINITY), DVec3::new(0.0, 1.0, 1.0));
        assert!((opacity(&medium, 1e-12).y / 1e-13 - 1.0).abs() < 1e-12);
    }
}
