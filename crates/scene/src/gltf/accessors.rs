//! Checked reading of accessors: every offset, count, type and number is verified before anything is allocated.

use gltf::json::Root;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::validation::Checked::Valid;

use super::document::LeftOut;
use super::fault::{Checked, Fault};
use crate::codes::{GLTF_ACCESSOR_TYPE, GLTF_BUFFER_RANGE, GLTF_NOT_FINITE, GLTF_REFERENCE, GLTF_TOO_LARGE};

/// Largest number of elements of an accessor that no buffer backs: all zero, but for its sparse elements (glTF 2.0, 5.1.1).
const MOST_ZEROED: usize = 1 << 20;

/// A component type and whether integers are normalised to 0..1 or −1..1.
pub(crate) type Kind = (ComponentType, bool);

/// 32-bit floats only.
pub(crate) const FLOAT: &[Kind] = &[(ComponentType::F32, false)];
/// Positions, with those of KHR_mesh_quantization.
pub(crate) const POSITION: &[Kind] = &[
    (ComponentType::F32, false),
    (ComponentType::I8, false),
    (ComponentType::I8, true),
    (ComponentType::U8, false),
    (ComponentType::U8, true),
    (ComponentType::I16, false),
    (ComponentType::I16, true),
    (ComponentType::U16, false),
    (ComponentType::U16, true),
];
/// Normals and rotations.
pub(crate) const SIGNED: &[Kind] = &[
    (ComponentType::F32, false),
    (ComponentType::I8, true),
    (ComponentType::I16, true),
    (ComponentType::U8, true),
    (ComponentType::U16, true),
];
/// Colours.
pub(crate) const COLOR: &[Kind] = &[(ComponentType::F32, false), (ComponentType::U8, true), (ComponentType::U16, true)];
/// Texture coordinates: as positions.
pub(crate) const TEXCOORD: &[Kind] = POSITION;

/// The elements of an accessor in its buffer.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn iter(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let (bytes, stride, size) = (self.bytes, self.stride, self.size);
        (0..self.count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

/// The JSON and the bytes that it describes.
#[derive(Clone, Copy)]
pub(crate) struct Data<'a> {
    pub root: &'a Root,
    pub left_out: &'a LeftOut,
    pub buffers: &'a [Vec<u8>],
}

impl<'a> Data<'a> {
    /// The bytes of a buffer view and its stride.
    pub fn view(&self, index: usize) -> Checked<(&'a [u8], Option<usize>)> {
        let view = self.root.buffer_views.get(index).ok_or_else(|| absent("bufferView", index))?;
        let buffer = view.buffer.value();
        let bytes = self.buffers.get(buffer).ok_or_else(|| absent("buffer", buffer))?;
        let start = view.byte_offset.unwrap_or_default().0;
        let range = range(start, view.byte_length.0, bytes.len()).ok_or_else(|| {
            let message = format!(
                "bufferView {index}: {} bytes at {start} do not lie in buffer {buffer} of {} bytes",
                view.byte_length.0,
                bytes.len()
            );
            Fault::new(GLTF_BUFFER_RANGE, message)
        })?;
        Ok((&bytes[range], view.byte_stride.map(|s| s.0)))
    }

    /// An accessor and its number of elements, at least one.
    pub fn accessor(&self, index: usize) -> Checked<(&'a Accessor, usize)> {
        let accessor = self.root.accessors.get(index).ok_or_else(|| absent("accessor", index))?;
        match usize::try_from(accessor.count.0) {
            Ok(count) if count > 0 && u32::try_from(count).is_ok() => Ok((accessor, count)),
            _ => Err(Fault::new(GLTF_BUFFER_RANGE, format!("accessor {index}: a count of {}", accessor.count.0))),
        }
    }

    /// Finite numbers, N per element.
    pub fn floats<const N: usize>(&self, index: usize, kinds: &[Kind]) -> Checked<Vec<[f32; N]>> {
        let (accessor, count) = self.accessor(index)?;
        let component = component_of(accessor, index)?;
        let expected = match N {
            1 => Type::Scalar,
            2 => Type::Vec2,
            3 => Type::Vec3,
            _ => Type::Vec4,
        };
        if accessor.type_ != Valid(expected) || !kinds.contains(&(component, accessor.normalized)) {
            return Err(wrong_type(index, accessor, &format!("{expected:?} of {}", kinds_text(kinds))));
        }
        let size = N * component.size();
        let decode = |bytes: &[u8]| decode::<N>(bytes, component, accessor.normalized);
        let mut values: Vec<[f32; N]> = match self.elements(accessor, index, count, size)? {
            Some(elements) => elements.iter().map(decode).collect(),
            None => vec![[0.0; N]; count],
        };
        for (at, bytes) in self.sparse(accessor, index, count, size)? {
            values[at] = decode(bytes);
        }
        match values.iter().position(|v| !v.iter().all(|c| c.is_finite())) {
            Some(at) => Err(Fault::new(GLTF_NOT_FINITE, format!("element {at} is {:?}", values[at]))),
            None => Ok(values),
        }
    }

    /// Finite numbers, three per element; a fourth is left out.
    pub fn triples(&self, index: usize, kinds: &[Kind]) -> Checked<Vec<[f32; 3]>> {
        if self.accessor(index)?.0.type_ == Valid(Type::Vec4) {
            return Ok(self.floats::<4>(index, kinds)?.into_iter().map(|[x, y, z, _]| [x, y, z]).collect());
        }
        self.floats::<3>(index, kinds)
    }

    /// Whole numbers, one per element.
    pub fn indices(&self, index: usize) -> Checked<Vec<u32>> {
        let (accessor, count) = self.accessor(index)?;
        let component = component_of(accessor, index)?;
        let whole = matches!(component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32);
        if accessor.type_ != Valid(Type::Scalar) || !whole || accessor.normalized {
            return Err(wrong_type(index, accessor, "Scalar of U8, U16 or U32"));
        }
        let size = component.size();
        let mut values = match self.elements(accessor, index, count, size)? {
            Some(elements) => elements.iter().map(whole_number).collect(),
            None => vec![0; count],
        };
        for (at, bytes) in self.sparse(accessor, index, count, size)? {
            values[at] = whole_number(bytes);
        }
        Ok(values)
    }

    /// Where the elements lie; nothing for an accessor without a buffer view.
    fn elements(&self, accessor: &Accessor, index: usize, count: usize, size: usize) -> Checked<Option<Elements<'a>>> {
        let Some(view) = accessor.buffer_view else {
            if count > MOST_ZEROED {
                let message = format!("accessor {index}: {count} elements without a bufferView, at most {MOST_ZEROED}");
                return Err(Fault::new(GLTF_TOO_LARGE, message));
            }
            return Ok(None);
        };
        let offset = accessor.byte_offset.unwrap_or_default().0;
        self.strided(view.value(), offset, count, size)
            .map(Some)
            .map_err(|fault| Fault { message: format!("accessor {index}: {}", fault.message), ..fault })
    }

    fn strided(&self, view: usize, offset: u64, count: usize, size: usize) -> Checked<Elements<'a>> {
        let (bytes, stride) = self.view(view)?;
        let stride = stride.unwrap_or(size);
        if stride < size || stride > 1 << 16 {
            return Err(Fault::new(GLTF_BUFFER_RANGE, format!("a stride of {stride} bytes for elements of {size}")));
        }
        let needed = (count as u64 - 1) * stride as u64 + size as u64;
        let range = range(offset, needed, bytes.len()).ok_or_else(|| {
            let message =
                format!("{count} elements need {needed} bytes at {offset}, bufferView {view} has {}", bytes.len());
            Fault::new(GLTF_BUFFER_RANGE, message)
        })?;
        Ok(Elements { bytes: &bytes[range], stride, size, count })
    }

    /// The sparse elements: index and bytes.
    fn sparse(&self, accessor: &Accessor, index: usize, count: usize, size: usize) -> Checked<Vec<(usize, &'a [u8])>> {
        let Some(sparse) = &accessor.sparse else { return Ok(Vec::new()) };
        let label = |fault: Fault| Fault { message: format!("accessor {index}, sparse: {}", fault.message), ..fault };
        let number = sparse.count.0;
        if number == 0 || number > count as u64 {
            return Err(label(Fault::new(GLTF_BUFFER_RANGE, format!("a count of {number} of {count} elements"))));
        }
        let number = number as usize;
        let Valid(kind) = sparse.indices.component_type else {
            return Err(label(Fault::new(GLTF_ACCESSOR_TYPE, "indices must be U8, U16 or U32")));
        };
        let indices =
            self.strided(sparse.indices.buffer_view.value(), sparse.indices.byte_offset.0, number, kind.0.size());
        let values = self.strided(sparse.values.buffer_view.value(), sparse.values.byte_offset.0, number, size);
        let (indices, values) = (indices.map_err(label)?, values.map_err(label)?);
        let at = |bytes| {
            let at = whole_number(bytes) as usize;
            let outside = || label(Fault::new(GLTF_BUFFER_RANGE, format!("index {at} of {count} elements")));
            if at < count { Ok(at) } else { Err(outside()) }
        };
        indices.iter().zip(values.iter()).map(|(index, value)| Ok((at(index)?, value))).collect()
    }
}

/// An element that is referred to and does not exist.
pub(crate) fn absent(kind: &str, index: usize) -> Fault {
    Fault::new(GLTF_REFERENCE, format!("{kind} {index} does not exist"))
}

fn range(start: u64, length: u64, available: usize) -> Option<std::ops::Range<usize>> {
    let end = start.checked_add(length)?;
    (end <= available as u64).then_some(start as usize..end as usize)
}

fn component_of(accessor: &Accessor, index: usize) -> Checked<ComponentType> {
    match accessor.component_type {
        Valid(kind) => Ok(kind.0),
        _ => Err(Fault::new(GLTF_ACCESSOR_TYPE, format!("accessor {index}: unknown componentType"))),
    }
}

fn wrong_type(index: usize, accessor: &Accessor, expected: &str) -> Fault {
    let kind = match accessor.type_ {
        Valid(kind) => format!("{kind:?}"),
        _ => "an unknown type".to_owned(),
    };
    let component = match accessor.component_type {
        Valid(component) => format!("{:?}", component.0),
        _ => "an unknown component type".to_owned(),
    };
    let normalized = if accessor.normalized { ", normalized" } else { "" };
    let message = format!("accessor {index} is {kind} of {component}{normalized}; expected {expected}");
    Fault::new(GLTF_ACCESSOR_TYPE, message)
}

fn kinds_text(kinds: &[Kind]) -> String {
    let text = |kind: &Kind| format!("{:?}{}", kind.0, if kind.1 { " normalized" } else { "" });
    kinds.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// Little-endian, 1 to 4 bytes.
fn whole_number(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
}

fn decode<const N: usize>(bytes: &[u8], kind: ComponentType, normalized: bool) -> [f32; N] {
    let size = kind.size();
    std::array::from_fn(|i| {
        let number = whole_number(&bytes[i * size..(i + 1) * size]);
        let (value, most) = match kind {
            ComponentType::F32 => (f32::from_bits(number), 1.0),
            ComponentType::U32 => (number as f32, u32::MAX as f32),
            ComponentType::U8 => (number as f32, 255.0),
            ComponentType::U16 => (number as f32, 65_535.0),
            ComponentType::I8 => (f32::from(number as u8 as i8), 127.0),
            ComponentType::I16 => (f32::from(number as u16 as i16), 32_767.0),
        };
        if normalized { (value / most).max(-1.0) } else { value }
    })
}
