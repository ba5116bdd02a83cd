// Between linear light and sRGB, the exact transfer function of IEC 61966-2-1 (two pieces, not a power of 2.2).

// sRGB, 0..1, of linear light; values outside 0..1 are clamped first, and NaN becomes 0.
fn srgb_from_linear(linear: vec3<f32>) -> vec3<f32> {
    let value = saturate(linear);
    let curve = 1.055 * pow(value, vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * value, value <= vec3<f32>(0.0031308));
}

// Linear light of sRGB, 0..1.
fn linear_from_srgb(encoded: vec3<f32>) -> vec3<f32> {
    let curve = pow((encoded + 0.055) / 1.055, vec3<f32>(2.4));
    return select(curve, encoded / 12.92, encoded <= vec3<f32>(0.04045));
}

// Luminance of linear RGB with the primaries of BT.709.
fn luminance(linear: vec3<f32>) -> f32 {
    return dot(linear, vec3<f32>(0.2126729, 0.7151522, 0.0721750));
}
