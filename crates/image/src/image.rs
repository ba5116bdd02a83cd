//! An image in memory, and what its channels mean.

use std::path::Path;

use crate::{Error, Kind, Precision};

/// Pixels as linear 32-bit floats: a picture, the layers of an array, or the slices of a 3D texture. Whole numbers are
/// `Image<u32>`; `Image<f64>` holds the numbers of both exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T = f32> {
    /// Pixels in a row.
    pub width: u32,
    /// Rows; row 0 is the top.
    pub height: u32,
    /// Layers of an array or slices of a 3D texture; 1 for a picture.
    pub layers: u32,
    /// Numbers per pixel, 1 to 4.
    pub channels: u32,
    /// Layer by layer, row by row, pixel by pixel: `width * height * layers * channels` numbers.
    pub data: Vec<T>,
}

/// A number of an array in a file.
pub trait Number: Copy {
    /// NumPy's name of its type.
    const NUMPY: &'static str;

    /// Its bytes, the lowest first.
    fn to_bytes(self) -> [u8; 4];
}

/// A number of an image that is written as it is where a format can hold it, and as a float where it cannot.
pub trait Sample: Number + Into<f64> {
    /// How `.exr` holds it.
    const PRECISION: Precision;
}

/// What numbers of files are read into.
pub(crate) trait FromExact: Copy + Default {
    fn from_exact(number: f64) -> Self;
}

impl FromExact for f32 {
    fn from_exact(number: f64) -> Self {
        number as f32
    }
}

impl FromExact for f64 {
    fn from_exact(number: f64) -> Self {
        number
    }
}

impl Number for f32 {
    const NUMPY: &'static str = "<f4";

    fn to_bytes(self) -> [u8; 4] {
        self.to_le_bytes()
    }
}

impl Number for u32 {
    const NUMPY: &'static str = "<u4";

    fn to_bytes(self) -> [u8; 4] {
        self.to_le_bytes()
    }
}

impl Number for i32 {
    const NUMPY: &'static str = "<i4";

    fn to_bytes(self) -> [u8; 4] {
        self.to_le_bytes()
    }
}

impl Sample for f32 {
    const PRECISION: Precision = Precision::Float;
}

impl Sample for u32 {
    const PRECISION: Precision = Precision::Whole;
}

/// What the channels of an image mean, which decides their names in a file and whether they are encoded as sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Meaning {
    /// Linear colour, with or without alpha. In `.exr` R, G, B, A (alpha 1 where the image has none).
    Color,
    /// One number per pixel: the first channel. In `.exr` `Y`.
    Scalar,
    /// A direction or position: the first three channels. In `.exr` X, Y, Z.
    Vector,
    /// Numbers with a meaning of their own: 1 channel is Y, 2 are X, Y, 3 are X, Y, Z and 4 are R, G, B, A in `.exr`.
    Data,
    /// Colour that is already encoded as sRGB, for a screen. It is written to `.png` as it is, and made linear for `.exr`
    /// and `.hdr`.
    Display,
}

impl<T: Copy> Image<T> {
    /// A picture of one layer.
    ///
    /// # Panics
    /// If `data` does not hold `width * height * channels` numbers, or `channels` is not 1 to 4: a bug of the caller.
    pub fn new(width: u32, height: u32, channels: u32, data: Vec<T>) -> Self {
        let image = Self { width, height, layers: 1, channels, data };
        assert!(image.fits(), "{} numbers for {width}x{height} pixels of {channels} channels", image.data.len());
        image
    }

    /// A picture of one layer in which every pixel is `pixel` (1 to 4 numbers).
    pub fn filled(width: u32, height: u32, pixel: &[T]) -> Self {
        let count = width as usize * height as usize;
        Self::new(width, height, pixel.len() as u32, pixel.repeat(count))
    }

    /// The numbers of pixel (`x`, `y`) of the first layer, or `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<&[T]> {
        self.pixel_in_layer(0, x, y)
    }

    /// The numbers of pixel (`x`, `y`) of `layer`, or `None` outside.
    pub fn pixel_in_layer(&self, layer: u32, x: u32, y: u32) -> Option<&[T]> {
        if x >= self.width || y >= self.height || layer >= self.layers {
            return None;
        }
        let row = layer as usize * self.height as usize + y as usize;
        let start = (row * self.width as usize + x as usize) * self.channels as usize;
        self.data.get(start..start + self.channels as usize)
    }

    /// Number of pixels of all layers.
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize * self.layers as usize
    }

    /// The same image with only its first `count` channels (all of them if it has no more).
    pub fn first_channels(&self, count: u32) -> Self {
        let kept = count.clamp(1, self.channels);
        let data = match kept == self.channels {
            true => self.data.clone(),
            false => {
                let pixels = self.data.chunks_exact(self.channels as usize);
                pixels.flat_map(|pixel| &pixel[..kept as usize]).copied().collect()
            }
        };
        Self { channels: kept, data, ..*self }
    }

    /// The same image with each number turned into another.
    pub fn map<U>(&self, turn: impl Fn(T) -> U) -> Image<U> {
        let Self { width, height, layers, channels, ref data } = *self;
        Image { width, height, layers, channels, data: data.iter().copied().map(turn).collect() }
    }

    /// With every number exactly as it is.
    pub fn exact(self) -> Image<f64>
    where
        T: Into<f64>,
    {
        let Self { width, height, layers, channels, data } = self;
        Image { width, height, layers, channels, data: data.into_iter().map(Into::into).collect() }
    }

    /// In single precision, as metrics of the eye and formats for it want it: whole numbers beyond 2^24 are rounded.
    pub fn floats(&self) -> Image
    where
        T: Into<f64>,
    {
        self.map(|number| number.into() as f32)
    }

    fn fits(&self) -> bool {
        (1..=4).contains(&self.channels) && self.pixel_count() * self.channels as usize == self.data.len()
    }

    /// Checks that the image has pixels, and as many numbers as its size says.
    pub(crate) fn check(&self, path: &Path) -> Result<(), Error> {
        if self.fits() && !self.data.is_empty() {
            return Ok(());
        }
        let Self { width, height, layers, channels, .. } = self;
        let count = self.data.len();
        let message =
            format!("an image of {width}x{height}x{layers} with {channels} channels cannot hold {count} numbers");
        Err(Error::new(Kind::Usage, path, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_row_by_row_from_the_top() {
        let image = Image::new(2, 2, 2, (0..8).map(|n| n as f32).collect());
        assert_eq!(image.pixel(1, 0), Some(&[2.0, 3.0][..]));
        assert_eq!(image.pixel(0, 1), Some(&[4.0, 5.0][..]));
        assert_eq!(image.pixel(2, 0), None);
        assert_eq!(image.first_channels(1).data, [0.0, 2.0, 4.0, 6.0]);
    }

    #[test]
    fn both_kinds_of_numbers_are_held_exactly() {
        let (float, whole) =
            (Image::filled(1, 1, &[f32::MIN_POSITIVE, f32::MAX]), Image::filled(1, 1, &[(1 << 24) + 1, u32::MAX]));
        assert_eq!(float.clone().exact().floats(), float);
        assert_eq!(whole.exact().data, [16_777_217.0, 4_294_967_295.0]);
    }

    #[test]
    fn an_image_whose_data_does_not_fit_is_refused() {
        let image = Image { width: 2, height: 2, layers: 1, channels: 1, data: vec![0.0; 3] };
        assert!(image.check(Path::new("a.exr")).is_err());
        let empty = Image::<f32> { width: 0, height: 2, layers: 1, channels: 1, data: vec![] };
        assert!(empty.check(Path::new("a.exr")).is_err());
    }
}
