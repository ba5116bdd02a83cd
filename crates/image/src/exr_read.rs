//! Reading OpenEXR: R, G, B; X, Y (Z); Y; or a single channel of any name, each with or without A, of half, float or whole
//! numbers.
//!
//! The picture is what the display window shows: pixels outside the data window are 0, and those of the data window outside
//! the display window (overscan) are left out.
//!
//! B44 and DWA compression are not supported. Sizes are checked against the file's length before anything of that size
//! is allocated.

use std::io::Cursor;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use exr::block::UncompressedBlock;
use exr::block::reader::ChunksReader;
use exr::compression::Compression;
use exr::meta::BlockDescription;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use half::f16;

use crate::image::FromExact;
use crate::{Image, limits};

/// Largest side of a tile, pixels: those of today's files have 512 at most.
const LARGEST_TILE: usize = 8_192;

/// The first layer of the file whose channels are known.
pub(crate) fn decode<T: FromExact>(bytes: &[u8]) -> Result<Image<T>, String> {
    // The reader asserts what it expects of a file; if an assertion fails, the file is at fault.
    catch_unwind(AssertUnwindSafe(|| decode_checked(bytes))).unwrap_or_else(|_| Err("not a valid EXR file".to_owned()))
}

fn decode_checked<T: FromExact>(bytes: &[u8]) -> Result<Image<T>, String> {
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(said)?;
    let (layer, sources) = choose_layer(reader.headers())?;
    for header in reader.headers() {
        check_size(header, bytes.len())?;
    }
    let header = &reader.headers()[layer];
    if !is_safe(header.compression) {
        return Err(format!("EXR files with {} are not supported", header.compression));
    }
    let window = Window::of(header)?;
    let [width, height] = window.size;
    let channels = sources.len();
    let mut image =
        Image::new(width as u32, height as u32, channels as u32, vec![T::default(); width * height * channels]);
    let samples = header.layer_size.width() * header.layer_size.height() * distinct(&sources);

    let first_level = |block: exr::block::BlockIndex| block.layer == layer && block.level == exr::math::Vec2(0, 0);
    let chunks = reader.filter_chunks(false, |_, _, block| first_level(block)).map_err(said)?;
    let mut filled = 0;
    chunks
        .decompress_sequential(false, |meta, block| {
            if first_level(block.index) {
                filled += copy_block(&meta.headers[layer], &block, &sources, (window, &mut image));
            }
            Ok(())
        })
        .map_err(said)?;
    match filled == samples {
        true => Ok(image),
        false => Err("parts of the picture are missing".to_owned()),
    }
}

/// Where the pixels of a file lie in the picture that it shows.
#[derive(Clone, Copy)]
struct Window {
    /// Pixels of the display window.
    size: [usize; 2],
    /// Of the first pixel of the data window, from the first of the display window.
    offset: [i64; 2],
}

impl Window {
    fn of(header: &Header) -> Result<Self, String> {
        let display = header.shared_attributes.display_window;
        let position = header.own_attributes.layer_position;
        let data = [header.layer_size.width(), header.layer_size.height()];
        let size = [display.size.width(), display.size.height()];
        let offset = [(position.0, display.position.0), (position.1, display.position.1)]
            .map(|(data, display)| i64::from(data) - i64::from(display));
        let window = Self { size, offset };
        if size != data {
            let channels = header.channels.list.len() as u64;
            limits::window((size[0] as u64, size[1] as u64), (data[0] * data[1]) as u64, channels)?;
        }
        if [0, 1].iter().any(|&axis| window.inside(axis, 0, data[axis]).is_empty()) {
            return Err(format!(
                "its data window, {}, lies outside of its display window, {}",
                corners([position.0, position.1], data),
                corners([display.position.0, display.position.1], size)
            ));
        }
        Ok(window)
    }

    /// Of `count` pixels of the data window along an axis from `first` on, those that the display window shows.
    fn inside(&self, axis: usize, first: usize, count: usize) -> Range<usize> {
        let start = first as i64 + self.offset[axis];
        let skipped = (-start).clamp(0, count as i64);
        let shown = (self.size[axis] as i64 - start).clamp(skipped, count as i64);
        skipped as usize..shown as usize
    }
}

/// `(5 4)-(14 11)`: the first and the last pixel.
fn corners(first: [i32; 2], size: [usize; 2]) -> String {
    let last = [0, 1].map(|axis| i64::from(first[axis]) + size[axis] as i64 - 1);
    format!("({} {})-({} {})", first[0], first[1], last[0], last[1])
}

/// Whether the unpacker of the `exr` crate (1.74) withstands hostile data. That of B44 panics where arithmetic
/// wraps around, and that of DWA allocates whatever the data say.
fn is_safe(compression: Compression) -> bool {
    use Compression as C;
    matches!(compression, C::Uncompressed | C::RLE | C::ZIP1 | C::ZIP16 | C::PIZ | C::PXR24)
}

/// The index of the layer, and those of its channels that make up the image, in order.
fn choose_layer(headers: &[Header]) -> Result<(usize, Vec<usize>), String> {
    let found = headers.iter().position(|header| !header.deep && sources(header).is_some());
    let layer = found.ok_or_else(|| {
        let names =
            headers.iter().flat_map(|header| header.channels.list.iter().map(|channel| channel.name.to_string()));
        let names: Vec<String> = names.take(16).collect();
        format!("no layer with the channels R, G, B, or X, Y (Z), or Y, and A beside them; it has {}", names.join(", "))
    })?;
    Ok((layer, sources(&headers[layer]).unwrap_or_default()))
}

/// Of grey with alpha the grey is red, green and blue. `None` where the channels make no picture: what of them is colour
/// cannot be left out.
fn sources(header: &Header) -> Option<Vec<usize>> {
    let list = &header.channels.list;
    let of = |name: &str| list.iter().position(|channel| channel.name.eq(name));
    let all = |names: &[&str]| names.iter().map(|name| of(name)).collect::<Option<Vec<usize>>>();
    let alpha = of("A").filter(|_| list.len() > 1);
    let colour = [&["R", "G", "B"][..], &["X", "Y", "Z"], &["X", "Y"], &["Y"]];
    let alone = || (list.len() - usize::from(alpha.is_some()) == 1).then(|| vec![usize::from(alpha == Some(0))]);
    let mut found = colour.iter().find_map(|names| all(names)).or_else(alone)?;
    if let Some(alpha) = alpha {
        match found.len() {
            1 => found = vec![found[0]; 3],
            2 => return None,
            _ => {}
        }
        found.push(alpha);
    }
    // Y may be the luminance of a colour whose other two parts are these.
    let is_luminance = of("R").is_none() && of("RY").or(of("BY")).is_some();
    let whole = found.iter().all(|&index| list[index].sampling.0 == 1 && list[index].sampling.1 == 1);
    (whole && !is_luminance).then_some(found)
}

fn check_size(header: &Header, file_bytes: usize) -> Result<(), String> {
    let size = (header.layer_size.width() as u64, header.layer_size.height() as u64);
    limits::count(size, header.channels.list.len() as u64, 2, file_bytes)?;
    if header.channels.list.iter().any(|channel| channel.sampling.0 != 1 || channel.sampling.1 != 1) {
        return Err("subsampled channels are not supported".to_owned());
    }
    match header.blocks {
        BlockDescription::Tiles(tiles) if tiles.tile_size.0.max(tiles.tile_size.1) > LARGEST_TILE => {
            Err(format!("tiles of {}x{} pixels are not supported", tiles.tile_size.0, tiles.tile_size.1))
        }
        _ => Ok(()),
    }
}

/// Channels of the file that make these.
fn distinct(sources: &[usize]) -> usize {
    sources.iter().enumerate().filter(|(at, source)| !sources[..*at].contains(source)).count()
}

/// Copies the lines of a block into the image; the number of samples that the block holds of its channels.
fn copy_block<T: FromExact>(
    header: &Header,
    block: &UncompressedBlock,
    sources: &[usize],
    (window, image): (Window, &mut Image<T>),
) -> usize {
    let channels = sources.len();
    let mut found = 0;
    for line in block.lines(&header.channels) {
        if !sources.contains(&line.location.channel) {
            continue;
        }
        let (position, kind) = (line.location.position, header.channels.list[line.location.channel].sample_type);
        found += line.value.len() / kind.bytes_per_sample();
        let shown = window.inside(0, position.0, line.location.sample_count);
        if shown.is_empty() || window.inside(1, position.1, 1).is_empty() {
            continue;
        }
        let at = |axis: usize, first: usize| (first as i64 + window.offset[axis]) as usize;
        let pixel = at(1, position.1) * window.size[0] + at(0, position.0 + shown.start);
        let bytes = &line.value[shown.start * kind.bytes_per_sample()..shown.end * kind.bytes_per_sample()];
        for target in (0..channels).filter(|&target| sources[target] == line.location.channel) {
            let row = image.data.iter_mut().skip(pixel * channels + target).step_by(channels);
            copy_line(kind, bytes, row);
        }
    }
    found
}

/// Writes samples into a row, which may be longer.
fn copy_line<'a, T: FromExact + 'a>(kind: SampleType, bytes: &[u8], row: impl Iterator<Item = &'a mut T>) {
    // The reader has brought the bytes into the machine's order.
    let four = || bytes.as_chunks::<4>().0.iter().copied();
    match kind {
        SampleType::F32 => fill(row, four().map(|bytes| f64::from(f32::from_ne_bytes(bytes)))),
        SampleType::U32 => fill(row, four().map(|bytes| f64::from(u32::from_ne_bytes(bytes)))),
        SampleType::F16 => fill(row, bytes.as_chunks::<2>().0.iter().map(|&two| f16::from_ne_bytes(two).to_f64())),
    }
}

fn fill<'a, T: FromExact + 'a>(row: impl Iterator<Item = &'a mut T>, samples: impl Iterator<Item = f64>) {
    row.zip(samples).for_each(|(target, sample)| *target = T::from_exact(sample));
}

fn said(error: exr::error::Error) -> String {
    use exr::error::Error as E;
    match error {
        E::NotSupported(what) => format!("this kind of EXR file is not supported: {what}"),
        E::Invalid(what) => format!("not a valid EXR file: {what}"),
        E::Io(error) => format!("not a valid EXR file: {error}"),
        E::Aborted => "not a valid EXR file".to_owned(),
    }
}
