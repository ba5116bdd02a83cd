//! The sRGB transfer function (IEC 61966-2-1).

/// Encoded value of a linear one; both in 0..1. Outside, the curve continues (the linear part through 0).
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear value of an encoded one; both in 0..1. Outside, the curve continues (the linear part through 0).
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A number in 0..1 as a byte; smaller numbers and NaN become 0, larger ones 255.
pub(crate) fn byte(value: f32) -> u8 {
    // `as` saturates and turns NaN into 0.
    (value * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_round_trip() {
        for code in 0..=255u8 {
            assert_eq!(byte(srgb_from_linear(linear_from_srgb(f32::from(code) / 255.0))), code);
        }
    }

    #[test]
    fn known_values() {
        assert!((linear_from_srgb(0.5) - 0.214_041_14).abs() < 1e-6);
        assert!((srgb_from_linear(0.18) - 0.461_356_13).abs() < 1e-6);
        assert_eq!(byte(srgb_from_linear(1.0)), 255);
    }

    #[test]
    fn values_out_of_range_are_black_or_white() {
        let codes = [f32::NAN, f32::NEG_INFINITY, -1.0, f32::INFINITY, 7.0].map(|value| byte(srgb_from_linear(value)));
        assert_eq!(codes, [0, 0, 0, 255, 255]);
    }
}
