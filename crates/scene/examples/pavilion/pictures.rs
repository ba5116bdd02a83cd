//! Procedural textures, encoded as PNG.

use std::io::Cursor;

use image::{ImageFormat, Rgb, RgbImage};

/// A repeatable number in 0..1 from whole numbers.
fn noise(x: u32, y: u32, seed: u32) -> f32 {
    let mut n = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca6b) ^ seed.wrapping_mul(0xc2b2_ae35);
    n = (n ^ n >> 15).wrapping_mul(0x2c1b_3c6d);
    n = (n ^ n >> 12).wrapping_mul(0x297a_2d39);
    (n ^ n >> 15) as f32 / u32::MAX as f32
}

fn png(side: u32, color: impl Fn(u32, u32) -> [f32; 3]) -> Vec<u8> {
    let picture = RgbImage::from_fn(side, side, |x, y| Rgb(color(x, y).map(|c| (c.clamp(0.0, 1.0) * 255.0) as u8)));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("memory takes every picture");
    bytes.into_inner()
}

/// Slabs in running bond, two by two in a tile of one metre.
pub fn paving() -> Vec<u8> {
    png(128, |x, y| {
        let row = y / 64;
        let column = (x + row * 32) % 128 / 64;
        let (inner_x, inner_y) = ((x + row * 32) % 64, y % 64);
        let joint = inner_x < 2 || inner_y < 2;
        let tint = 0.78 + 0.16 * noise(column, row, 1) + 0.07 * noise(x, y, 2);
        let shade = if joint { 0.45 + 0.1 * noise(x, y, 3) } else { tint };
        [shade, shade * 0.97, shade * 0.92]
    })
}

/// Four rows of four scales, each darker toward the row above.
pub fn tiles() -> Vec<u8> {
    png(128, |x, y| {
        let row = y / 32;
        let shifted = (x + row % 2 * 16) % 128;
        let (across, down) = ((shifted % 32) as f32 / 31.0 - 0.5, (y % 32) as f32 / 31.0);
        // A scale's lower edge is round: beside it the next row shows.
        let edge = 1.0 - 0.9 * across * across;
        let depth = if down > edge { 0.35 } else { 0.55 + 0.4 * down };
        let groove = if across.abs() > 0.47 { 0.6 } else { 1.0 };
        let tint = depth * groove * (0.85 + 0.2 * noise(shifted / 32, row, 4) + 0.06 * noise(x, y, 5));
        [tint, tint, tint]
    })
}
