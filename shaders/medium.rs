//! A medium along a ray, homogeneous or with a density that falls with the height: twin of `medium.wgsl`.

use crate::scene::{HeightFog, Medium};
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

/// Density of the medium at a height, m: 1 at the base height.
pub fn density(fog: &HeightFog, height: f64) -> f64 {
    ((fog.base_height - height) * fog.falloff).exp()
}

/// Integral of the density along a ray, m: the way of density 1 that is as thick. The ray starts at `height` and climbs by
/// `climb` in every metre; `way` may be infinite.
pub fn effective_way(fog: &HeightFog, height: f64, climb: f64, way: f64) -> f64 {
    let rate = fog.falloff * climb;
    let start = density(fog, height);
    if rate == 0.0 || way == 0.0 { start * way } else { start * -(-rate * way).exp_m1() / rate }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;
    use crate::scene::Phase;

    const FOG: HeightFog = HeightFog { base_height: 3.0, falloff: 0.2 };

    #[test]
    fn the_effective_way_is_the_integral_of_the_density() {
        for (height, climb, way) in [(1.0, 0.3, 12.0), (40.0, -0.9, 45.0), (5.0, 1e-9, 30.0), (5.0, 0.0, 7.0)] {
            let expected = integrate(|x| density(&FOG, height + climb * x), 0.0, way, 1e-13);
            let value = effective_way(&FOG, height, climb, way);
            assert!((value / expected - 1.0).abs() < 1e-7, "{value} instead of {expected}");
        }
    }

    #[test]
    fn endless_ways() {
        assert!((effective_way(&FOG, 3.0, 0.5, f64::INFINITY) - 10.0).abs() < 1e-12);
        assert_eq!(effective_way(&FOG, 3.0, -0.5, f64::INFINITY), f64::INFINITY);
        assert_eq!(effective_way(&FOG, 3.0, 0.0, f64::INFINITY), f64::INFINITY);
    }

    /// A scale height beyond all bounds is a homogeneous medium.
    #[test]
    fn without_falloff_the_way_is_itself() {
        for way in [0.0, 2.5, f64::INFINITY] {
            assert_eq!(effective_way(&HeightFog::NONE, 100.0, -0.4, way), way);
        }
        let nearly = HeightFog { base_height: 0.0, falloff: 1e-12 };
        assert!((effective_way(&nearly, 100.0, -0.4, 50.0) / 50.0 - 1.0).abs() < 1e-9);
    }

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
