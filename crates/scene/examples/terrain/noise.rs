//! Repeatable noise, by sums and products alone, so that it is the same on every machine.

/// A repeatable number in 0..1 of a cell.
fn at_cell(x: i32, z: i32, seed: u32) -> f64 {
    let mut n =
        (x as u32).wrapping_mul(0x9e37_79b1) ^ (z as u32).wrapping_mul(0x85eb_ca6b) ^ seed.wrapping_mul(0xc2b2_ae35);
    n = (n ^ n >> 15).wrapping_mul(0x2c1b_3c6d);
    n = (n ^ n >> 12).wrapping_mul(0x297a_2d39);
    f64::from(n ^ n >> 15) / f64::from(u32::MAX)
}

/// Smooth noise in −1..1 with cells of side 1.
pub fn noise(x: f64, z: f64, seed: u32) -> f64 {
    let (x0, z0) = (x.floor(), z.floor());
    let smooth = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (u, v) = (smooth(x - x0), smooth(z - z0));
    let at = |dx: i32, dz: i32| at_cell(x0 as i32 + dx, z0 as i32 + dz, seed);
    let near = at(0, 0) + (at(1, 0) - at(0, 0)) * u;
    let far = at(0, 1) + (at(1, 1) - at(0, 1)) * u;
    2.0 * (near + (far - near) * v) - 1.0
}

/// A sum of octaves of noise, each of half the size and half the height of the one before; about −1..1.
pub fn fractal(x: f64, z: f64, octaves: u32, seed: u32) -> f64 {
    let (mut sum, mut height, mut scale) = (0.0, 0.5, 1.0);
    for octave in 0..octaves {
        sum += height * noise(x * scale, z * scale, seed + octave);
        height *= 0.5;
        // not quite twice, so that the cells of octaves do not line up
        scale *= 2.03;
    }
    sum
}
