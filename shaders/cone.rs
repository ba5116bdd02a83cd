//! A spot's cone of light: twin of `cone.wgsl`.

/// `I/I₀` of a spot in a direction whose angle with the axis has this cosine: cosᴺ inside the cutoff (degrees), 0 outside.
/// Beyond 90° from the axis only a spot with N = 0 shines.
pub fn spot_falloff(cosine: f64, exponent: f64, cutoff: f64) -> f64 {
    let inside = cosine >= cutoff.to_radians().cos() && (cosine > 0.0 || exponent == 0.0);
    if !inside {
        0.0
    } else if exponent == 0.0 {
        1.0
    } else {
        cosine.powf(exponent)
    }
}

/// The parts of a ray that lie in a cone, as intervals of θ (radians, −π/2..π/2), the angle at the light from the ray's
/// nearest point, growing along the ray. `along` and `across` are the components of the axis along the ray and along the
/// way from the light to that point: cos ψ = along·sin θ + across·cos θ.
///
/// This is Hong 2006, section 6.2.1, with the tilt of the axis out of the plane of light and ray, which the thesis leaves
/// out: cos ψ = cos δ·cos(θ − β).
pub fn ray_in_cone(along: f64, across: f64, cutoff: f64) -> Vec<[f64; 2]> {
    use std::f64::consts::{FRAC_PI_2, PI};
    let c = cutoff.to_radians().cos();
    let in_plane = along.hypot(across);
    if c <= -in_plane {
        return vec![[-FRAC_PI_2, FRAC_PI_2]];
    }
    if c >= in_plane {
        return Vec::new();
    }
    let beta = along.atan2(across);
    let half = (c / in_plane).acos();
    let turns = [-2.0 * PI, 0.0, 2.0 * PI];
    let parts = turns.map(|turn| [(beta - half + turn).max(-FRAC_PI_2), (beta + half + turn).min(FRAC_PI_2)]);
    parts.into_iter().filter(|[low, high]| high > low).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// A point of the ray is in the cone exactly where an interval says so.
        #[test]
        fn intervals_hold_the_lit_points(
            along in -1.0..1.0f64, across in -1.0..1.0f64, cutoff in 1.0..179.0f64, theta in -1.57..1.57f64,
        ) {
            prop_assume!(along.hypot(across) <= 1.0);
            let cosine = along * theta.sin() + across * theta.cos();
            let c = cutoff.to_radians().cos();
            prop_assume!((cosine - c).abs() > 1e-9);
            let parts = ray_in_cone(along, across, cutoff);
            prop_assert!(parts.len() <= 2);
            prop_assert_eq!(parts.iter().any(|[low, high]| (*low..=*high).contains(&theta)), cosine > c);
        }
    }

    #[test]
    fn a_wide_cone_leaves_a_dark_one() {
        // the ray crosses the dark cone behind the spot
        assert_eq!(ray_in_cone(0.0, -1.0, 150.0).len(), 2);
        assert_eq!(ray_in_cone(0.0, -1.0, 90.0).len(), 0);
        assert_eq!(ray_in_cone(0.0, 0.5, 150.0).len(), 1);
    }

    #[test]
    fn falloff_ends_at_the_cutoff() {
        assert_eq!(spot_falloff(0.5, 2.0, 70.0), 0.25);
        assert_eq!(spot_falloff(0.5, 2.0, 50.0), 0.0);
        assert_eq!(spot_falloff(-0.5, 2.0, 170.0), 0.0);
        assert_eq!(spot_falloff(-0.5, 0.0, 170.0), 1.0);
    }
}
