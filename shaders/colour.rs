//! Between linear light and sRGB: twin of `colour.wgsl`.

/// sRGB, 0..1, of linear light (IEC 61966-2-1); what is outside 0..1 is clamped first.
pub fn srgb_from_linear(linear: f64) -> f64 {
    let value = linear.clamp(0.0, 1.0);
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// Linear light of sRGB, 0..1.
pub fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_are_inverse() {
        for byte in 0..=255u8 {
            let encoded = f64::from(byte) / 255.0;
            assert!((srgb_from_linear(linear_from_srgb(encoded)) - encoded).abs() < 1e-7);
        }
        assert_eq!(srgb_from_linear(-1.0), 0.0);
        assert!((srgb_from_linear(7.0) - 1.0).abs() < 1e-15);
    }
}
