//! What reaches a point from a light, without what the medium takes: twin of `lights.wgsl`.

use crate::cone::spot_falloff;
use crate::scene::Light;
use glam::DVec3;

/// Light at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incident {
    /// Unit vector.
    pub to_light: DVec3,
    /// W/m² on a surface that faces the light, before extinction.
    pub irradiance: DVec3,
    /// Metres through the medium; of a directional light 0: its irradiance reaches every point as it is.
    pub way: f64,
}

/// What a light sends to a point: `I/d²` of a point or spot light, d floored at the light's radius.
/// At the light itself it comes from above.
pub fn incident(light: &Light, position: DVec3) -> Incident {
    let at = |light_position: DVec3, intensity: DVec3, radius: f64| {
        let away = light_position - position;
        let d = away.length().max(radius).max(1e-12);
        Incident { to_light: away / away.length().max(1e-12), irradiance: intensity / (d * d), way: d }
    };
    match *light {
        Light::Directional { direction, irradiance } => Incident { to_light: -direction, irradiance, way: 0.0 },
        Light::Point { position, intensity, radius } => at(position, intensity, radius),
        Light::Spot { position, intensity, radius, direction, exponent, cutoff } => {
            let incident = at(position, intensity, radius);
            let falloff = spot_falloff(-direction.dot(incident.to_light), exponent, cutoff);
            Incident { irradiance: incident.irradiance * falloff, ..incident }
        }
    }
}

/// Bits of each of the four channels of a texture that says which lights reach a point.
const BITS_OF_CHANNEL: usize = 32;

/// Lights that there are bits for.
pub const LIT_LIGHTS: usize = 4 * BITS_OF_CHANNEL;

/// The channel and the bit of a light; none beyond [`LIT_LIGHTS`].
pub fn lit_bit(light: usize) -> Option<(usize, u32)> {
    (light < LIT_LIGHTS).then_some((light / BITS_OF_CHANNEL, 1 << (light % BITS_OF_CHANNEL)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_the_shader() {
        let stated = format!("const BITS_OF_CHANNEL: u32 = {BITS_OF_CHANNEL}u;");
        assert!(include_str!("lights.wgsl").contains(&stated), "lights.wgsl does not say: {stated}");
        assert_eq!((lit_bit(0), lit_bit(33), lit_bit(LIT_LIGHTS)), (Some((0, 1)), Some((1, 2)), None));
        assert_eq!(lit_bit(LIT_LIGHTS - 1), Some((3, 1 << 31)));
    }

    #[test]
    fn falls_with_the_square_of_the_distance() {
        let light = Light::Point { position: DVec3::Y * 4.0, intensity: DVec3::splat(32.0), radius: 0.0 };
        let incident = incident(&light, DVec3::ZERO);
        assert_eq!(incident.to_light, DVec3::Y);
        assert_eq!(incident.irradiance, DVec3::splat(2.0));
        assert_eq!(incident.way, 4.0);
    }

    #[test]
    fn a_radius_floors_the_distance_and_not_the_direction() {
        let light = Light::Point { position: DVec3::X * 0.5, intensity: DVec3::ONE, radius: 2.0 };
        let near = incident(&light, DVec3::ZERO);
        assert_eq!((near.to_light, near.irradiance, near.way), (DVec3::X, DVec3::splat(0.25), 2.0));
        assert_eq!(incident(&light, DVec3::X * 0.5).to_light, DVec3::ZERO, "at the light itself it comes from nowhere");
    }

    #[test]
    fn a_spot_shines_along_its_direction() {
        let spot = |direction| Light::Spot {
            position: DVec3::Y * 2.0,
            intensity: DVec3::splat(4.0),
            radius: 0.0,
            direction,
            exponent: 2.0,
            cutoff: 30.0,
        };
        assert_eq!(incident(&spot(DVec3::NEG_Y), DVec3::ZERO).irradiance, DVec3::ONE);
        assert_eq!(incident(&spot(DVec3::Y), DVec3::ZERO).irradiance, DVec3::ZERO);
    }
}
