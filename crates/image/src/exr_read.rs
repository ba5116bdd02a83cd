//! Reading OpenEXR: R, G, B (A); Y; X, Y (Z); or a single channel of any name, of half, float or whole numbers.
//!
//! B44 and DWA compression are not supported. Sizes are checked against the file's length before anything of that size
//! is allocated.

use std::io::Cursor;
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
    let (width, height) = (header.layer_size.width(), header.layer_size.height());
    let data = vec![T::default(); width * height * sources.len()];
    let mut image = Image::new(width as u32, height as u32, sources.len() as u32, data);

    let first_level = |block: exr::block::BlockIndex| block.layer == layer && block.level == exr::math::Vec2(0, 0);
    let chunks = reader.filter_chunks(false, |_, _, block| first_level(block)).map_err(said)?;
    let mut filled = 0;
    chunks
        .decompress_sequential(false, |meta, block| {
            if first_level(block.index) {
                filled += copy_block(&meta.headers[layer], &block, &sources, &mut image);
            }
            Ok(())
        })
        .map_err(said)?;
    match filled == image.data.len() {
        true => Ok(image),
        false => Err("parts of the picture are missing".to_owned()),
    }
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
        format!("no layer with the channels R, G, B (A), or X, Y (Z), or Y; it has {}", names.join(", "))
    })?;
    Ok((layer, sources(&headers[layer]).unwrap_or_default()))
}

fn sources(header: &Header) -> Option<Vec<usize>> {
    let list = &header.channels.list;
    let of = |name: &str| list.iter().position(|channel| channel.name.eq(name));
    let all = |names: &[&str]| names.iter().map(|name| of(name)).collect::<Option<Vec<usize>>>();
    let known = [&["R", "G", "B", "A"][..], &["R", "G", "B"], &["X", "Y", "Z"], &["X", "Y"], &["Y"]];
    let found = known.iter().find_map(|names| all(names)).or((list.len() == 1).then(|| vec![0]));
    found.filter(|found| found.iter().all(|&index| list[index].sampling.0 == 1 && list[index].sampling.1 == 1))
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

/// Copies the lines of a block into the image. Returns the number of samples copied.
fn copy_block<T: FromExact>(
    header: &Header,
    block: &UncompressedBlock,
    sources: &[usize],
    image: &mut Image<T>,
) -> usize {
    let (width, channels) = (image.width as usize, sources.len());
    let mut copied = 0;
    for line in block.lines(&header.channels) {
        let Some(target) = sources.iter().position(|&source| source == line.location.channel) else { continue };
        let start = (line.location.position.1 * width + line.location.position.0) * channels + target;
        let Some(row) = image.data.get_mut(start..) else { continue };
        let row = row.iter_mut().step_by(channels).take(line.location.sample_count);
        let kind = header.channels.list[line.location.channel].sample_type;
        copied += copy_line(kind, line.value, row);
    }
    copied
}

fn copy_line<'a, T: FromExact + 'a>(kind: SampleType, bytes: &[u8], row: impl Iterator<Item = &'a mut T>) -> usize {
    // The reader has brought the bytes into the machine's order.
    let four = || bytes.as_chunks::<4>().0.iter().copied();
    match kind {
        SampleType::F32 => fill(row, four().map(|bytes| f64::from(f32::from_ne_bytes(bytes)))),
        SampleType::U32 => fill(row, four().map(|bytes| f64::from(u32::from_ne_bytes(bytes)))),
        SampleType::F16 => fill(row, bytes.as_chunks::<2>().0.iter().map(|&two| f16::from_ne_bytes(two).to_f64())),
    }
}

fn fill<'a, T: FromExact + 'a>(row: impl Iterator<Item = &'a mut T>, samples: impl Iterator<Item = f64>) -> usize {
    row.zip(samples).map(|(target, sample)| *target = T::from_exact(sample)).count()
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
