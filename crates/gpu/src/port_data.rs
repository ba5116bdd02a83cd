//! What a port holds, on the CPU: its bytes, and the numbers that they are.

use half::f16;
use tyndall_graph::Resource;
use tyndall_graph::descriptor::{Dimension, Scalar};

/// The content of a port, as the GPU holds it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PortData {
    /// What the port is: its size, and the format of a texel or the stride of an element.
    pub resource: Resource,
    /// How its numbers are stored.
    pub scalar: Scalar,
    /// Texels or elements: row 0 the top, layers one after another, no padding between rows.
    pub bytes: Vec<u8>,
}

/// Numbers that lose nothing of what a port holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers {
    /// Floats of 32 or fewer bits.
    Floats(Vec<f32>),
    /// Whole numbers from 0.
    Whole(Vec<u32>),
    /// Whole numbers with a sign.
    Signed(Vec<i32>),
}

impl PortData {
    /// A port that holds these numbers, each rounded to what the port can store.
    pub fn from_numbers(resource: Resource, scalar: Scalar, numbers: impl IntoIterator<Item = f64>) -> Self {
        let mut bytes = Vec::with_capacity(resource.bytes() as usize);
        numbers.into_iter().for_each(|number| encode(scalar, number, &mut bytes));
        Self { resource, scalar, bytes }
    }

    /// Texels in x, or elements of a buffer.
    pub fn width(&self) -> u32 {
        match self.resource {
            Resource::Texture { width, .. } => width,
            Resource::Buffer { bytes, stride } => (bytes / u64::from(stride.max(1))) as u32,
        }
    }

    /// Texels in y, 1 of a buffer.
    pub fn height(&self) -> u32 {
        match self.resource {
            Resource::Texture { height, .. } => height,
            Resource::Buffer { .. } => 1,
        }
    }

    /// Layers or texels in z, 1 otherwise.
    pub fn layers(&self) -> u32 {
        match self.resource {
            Resource::Texture { depth_or_layers, .. } => depth_or_layers,
            Resource::Buffer { .. } => 1,
        }
    }

    /// Numbers of a texel or an element, padding of elements included.
    pub fn channels(&self) -> u32 {
        match self.resource {
            Resource::Texture { format, .. } => format.channels(),
            Resource::Buffer { stride, .. } => (stride / self.scalar.bytes() as u32).max(1),
        }
    }

    /// It is a buffer.
    pub fn is_buffer(&self) -> bool {
        matches!(self.resource, Resource::Buffer { .. })
    }

    /// It is one plain two-dimensional image.
    pub fn is_image(&self) -> bool {
        matches!(self.resource, Resource::Texture { dimension: Dimension::D2, .. })
    }

    /// How many numbers it holds.
    pub fn len(&self) -> usize {
        self.bytes.len() / self.scalar.bytes()
    }

    /// It holds no number.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number at this place, exactly; `None` beyond the last.
    pub fn get(&self, index: usize) -> Option<f64> {
        let size = self.scalar.bytes();
        let bytes = self.bytes.get(index * size..(index + 1) * size)?;
        Some(decode(self.scalar, bytes))
    }

    /// The number at this place, exactly.
    ///
    /// # Panics
    /// Beyond the last number, as a slice does.
    pub fn number(&self, index: usize) -> f64 {
        let size = self.scalar.bytes();
        decode(self.scalar, &self.bytes[index * size..(index + 1) * size])
    }

    /// The numbers of a texel (x, y, layer), exactly; channels that are not there are 0.
    pub fn texel(&self, [x, y, layer]: [u32; 3]) -> [f64; 4] {
        let channels = self.channels() as usize;
        let first = ((layer * self.height() + y) * self.width() + x) as usize * channels;
        std::array::from_fn(|channel| if channel < channels { self.number(first + channel) } else { 0.0 })
    }

    /// All numbers, exactly: `width * height * layers * channels`.
    pub fn numbers(&self) -> Numbers {
        let words = || self.bytes.as_chunks().0.iter().copied();
        match self.scalar {
            Scalar::U32 => Numbers::Whole(words().map(u32::from_le_bytes).collect()),
            Scalar::I32 => Numbers::Signed(words().map(i32::from_le_bytes).collect()),
            Scalar::F32 => Numbers::Floats(words().map(f32::from_le_bytes).collect()),
            Scalar::F16 | Scalar::Unorm8 => Numbers::Floats(self.floats()),
        }
    }

    /// All numbers as floats: whole numbers beyond 2^24 are rounded.
    pub fn floats(&self) -> Vec<f32> {
        self.exact().map(|number| number as f32).collect()
    }

    /// All numbers, one after another, exactly.
    pub fn exact(&self) -> impl Iterator<Item = f64> + '_ {
        self.bytes.chunks_exact(self.scalar.bytes()).map(|bytes| decode(self.scalar, bytes))
    }
}

impl Numbers {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Floats(numbers) => numbers.len(),
            Self::Whole(numbers) => numbers.len(),
            Self::Signed(numbers) => numbers.len(),
        }
    }

    /// There are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All of them in double precision, which holds each exactly.
    pub fn exact(&self) -> Vec<f64> {
        match self {
            Self::Floats(numbers) => numbers.iter().copied().map(f64::from).collect(),
            Self::Whole(numbers) => numbers.iter().copied().map(f64::from).collect(),
            Self::Signed(numbers) => numbers.iter().copied().map(f64::from).collect(),
        }
    }
}

impl From<Vec<f32>> for Numbers {
    fn from(numbers: Vec<f32>) -> Self {
        Self::Floats(numbers)
    }
}

impl From<Vec<u32>> for Numbers {
    fn from(numbers: Vec<u32>) -> Self {
        Self::Whole(numbers)
    }
}

impl FromIterator<f32> for Numbers {
    fn from_iter<I: IntoIterator<Item = f32>>(numbers: I) -> Self {
        Self::Floats(numbers.into_iter().collect())
    }
}

impl FromIterator<u32> for Numbers {
    fn from_iter<I: IntoIterator<Item = u32>>(numbers: I) -> Self {
        Self::Whole(numbers.into_iter().collect())
    }
}

/// A number from its bytes, of which there are as many as it takes.
fn decode(scalar: Scalar, bytes: &[u8]) -> f64 {
    let four = || bytes.first_chunk().copied().unwrap_or_default();
    match scalar {
        Scalar::F32 => f64::from(f32::from_le_bytes(four())),
        Scalar::U32 => f64::from(u32::from_le_bytes(four())),
        Scalar::I32 => f64::from(i32::from_le_bytes(four())),
        Scalar::F16 => f16::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default()).to_f64(),
        Scalar::Unorm8 => f64::from(f32::from(bytes.first().copied().unwrap_or_default()) / 255.0),
    }
}

/// Appends the bytes of a number.
pub(crate) fn encode(scalar: Scalar, number: f64, bytes: &mut Vec<u8>) {
    match scalar {
        Scalar::F32 => bytes.extend((number as f32).to_le_bytes()),
        Scalar::U32 => bytes.extend((number as u32).to_le_bytes()),
        Scalar::I32 => bytes.extend((number as i32).to_le_bytes()),
        Scalar::F16 => bytes.extend(f16::from_f64(number).to_le_bytes()),
        Scalar::Unorm8 => bytes.push((number.clamp(0.0, 1.0) * 255.0).round() as u8),
    }
}

#[cfg(test)]
mod tests {
    use tyndall_graph::descriptor::Format;

    use super::*;

    fn row(format: Format, width: u32) -> Resource {
        Resource::Texture { dimension: Dimension::D2, format, width, height: 1, depth_or_layers: 1 }
    }

    #[test]
    fn whole_numbers_beyond_what_a_float_holds_survive() {
        let words = [0, 1, (1 << 24) + 1, u32::MAX];
        for resource in [row(Format::Rgba32Uint, 1), Resource::Buffer { bytes: 16, stride: 4 }] {
            let data = PortData::from_numbers(resource, Scalar::U32, words.map(f64::from));
            assert_eq!(data.bytes, words.map(u32::to_le_bytes).concat());
            assert_eq!(data.numbers(), Numbers::Whole(words.to_vec()));
            assert_eq!(data.numbers().exact(), words.map(f64::from));
            assert_eq!((data.number(2), data.get(3), data.get(4)), (16_777_217.0, Some(4_294_967_295.0), None));
        }
    }

    #[test]
    fn numbers_with_a_sign_survive() {
        let words = [-1, i32::MIN, (1 << 24) + 1];
        let resource = Resource::Buffer { bytes: 12, stride: 4 };
        let data = PortData::from_numbers(resource, Scalar::I32, words.map(f64::from));
        assert_eq!((data.numbers(), data.width()), (Numbers::Signed(words.to_vec()), 3));
    }

    /// Every number of a format of few bits comes out as the same bytes again.
    #[test]
    fn every_half_and_every_byte_survives() {
        let halves: Vec<u8> =
            (0..=u16::MAX).filter(|bits| !f16::from_bits(*bits).is_nan()).flat_map(u16::to_le_bytes).collect();
        let bytes: Vec<u8> = (0..=u8::MAX).collect();
        for (format, bytes) in [(Format::R16Float, halves), (Format::Rgba8Unorm, bytes)] {
            let data = PortData { resource: row(format, 1), scalar: format.scalar(), bytes };
            assert_eq!(PortData::from_numbers(data.resource, data.scalar, data.exact()).bytes, data.bytes);
            assert_eq!(data.numbers(), Numbers::Floats(data.floats()));
        }
    }

    #[test]
    fn the_shape_of_textures_and_buffers() {
        let texture = Resource::Texture {
            dimension: Dimension::D3,
            format: Format::Rg32Float,
            width: 2,
            height: 3,
            depth_or_layers: 4,
        };
        let data = PortData::from_numbers(texture, Scalar::F32, vec![0.5; 48]);
        let shape = |data: &PortData| (data.width(), data.height(), data.layers(), data.channels(), data.len());
        assert_eq!((shape(&data), data.is_buffer(), data.is_image()), ((2, 3, 4, 2, 48), false, false));
        let buffer = PortData::from_numbers(Resource::Buffer { bytes: 96, stride: 32 }, Scalar::U32, vec![7.0; 24]);
        assert_eq!((shape(&buffer), buffer.is_buffer(), buffer.is_image()), ((3, 1, 1, 8, 24), true, false));
    }
}
