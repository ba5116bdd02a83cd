//! Broken files end in an error that names them: no panic, no giant allocation.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;

use tyndall_image::{FileKind, Image, Kind, Meaning, decode, read, read_array, write};

fn sound(kind: FileKind) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a").with_extension(kind.suffix());
    let data = (0..33 * 20 * 4).map(|n| (n % 97) as f32 / 50.0).collect();
    write(&path, &Image::new(33, 20, 4, data), Meaning::Color).unwrap();
    std::fs::read(path).unwrap()
}

/// A small generator (xorshift, Marsaglia 2003): the same mutations in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit as u64) as usize
    }
}

/// Decodes what it is given and demands sane sizes of what comes out.
fn survives(kind: FileKind, bytes: &[u8]) -> bool {
    match decode(Path::new("hostile"), kind, bytes) {
        Ok(image) => {
            assert!(image.data.len() < 1 << 24, "{} numbers from {} bytes", image.data.len(), bytes.len());
            assert_eq!(image.data.len(), image.pixel_count() * image.channels as usize);
            true
        }
        Err(error) => {
            assert!(error.to_string().starts_with("hostile: "));
            assert_eq!(error.kind(), Kind::Input);
            false
        }
    }
}

/// EXR files as other programs write them: other compressions, tiles, half floats.
fn foreign_exr(compression: exr::compression::Compression) -> [Vec<u8>; 2] {
    use exr::prelude::*;
    let samples: Vec<f16> = (0..33 * 70).map(|n| f16::from_f32((n % 97) as f32 / 50.0)).collect();
    let file = |blocks: Blocks| {
        let channels = ["R", "G", "B"].map(|name| AnyChannel::new(name, FlatSamples::F16(samples.clone())));
        let channels = AnyChannels::sort(channels.into_iter().collect());
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let layer = Layer::new((33, 70), LayerAttributes::named("picture"), encoding, channels);
        let mut bytes = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    [file(Blocks::ScanLines), file(Blocks::Tiles(Vec2(16, 16)))]
}

#[test]
fn files_of_other_programs_are_read_and_their_mutations_survived() {
    use exr::compression::Compression as C;
    let kinds = [C::PIZ, C::RLE, C::ZIP1, C::ZIP16, C::PXR24, C::Uncompressed];
    for sound in kinds.into_iter().flat_map(foreign_exr) {
        assert!(survives(FileKind::Exr, &sound));
        let refused = mutate(FileKind::Exr, &sound, 1_000);
        assert!(refused > 50, "only {refused} mutations were refused");
    }
}

#[test]
fn compressions_whose_unpackers_fail_on_hostile_data_are_refused() {
    use exr::compression::Compression as C;
    for kind in [C::B44, C::B44A, C::DWAA(None), C::DWAB(None)] {
        let [sound, _] = foreign_exr(kind);
        let error = decode(Path::new("a.exr"), FileKind::Exr, &sound).unwrap_err();
        assert_eq!(error.to_string(), format!("a.exr: EXR files with {kind} are not supported"));
    }
}

#[test]
fn mutated_files_are_read_or_refused() {
    for kind in FileKind::ALL {
        let sound = sound(kind);
        assert!(survives(kind, &sound));
        let refused = mutate(kind, &sound, 4_000);
        assert!(refused > 200, "only {refused} mutations of {kind:?} were refused");
    }
}

/// Decodes `rounds` mutations of a sound file; how many of them were refused.
fn mutate(kind: FileKind, sound: &[u8], rounds: usize) -> usize {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut refused = 0;
    for round in 0..rounds {
        let mut bytes = sound.to_vec();
        // Most mutations go where the sizes stand.
        let reach = if round % 4 == 0 { bytes.len() } else { bytes.len().min(400) };
        for _ in 0..=random.below(4) {
            let at = random.below(reach);
            bytes[at] = [0, 1, 0x7f, 0x80, 0xff, random.below(256) as u8][random.below(6)];
        }
        refused += usize::from(!survives(kind, &bytes));
    }
    refused
}

#[test]
fn truncated_files_are_refused() {
    for kind in FileKind::ALL {
        let sound = sound(kind);
        let step = (sound.len() / 300).max(1);
        for length in (0..sound.len() - 16).step_by(step) {
            assert!(!survives(kind, &sound[..length]), "{kind:?} cut to {length} of {} bytes", sound.len());
        }
    }
}

#[test]
fn a_tiny_file_cannot_claim_a_huge_picture() {
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x75\x30\0\0\x75\x30\x08\x06\0\0\0".to_vec();
    png.extend(crc(&png[12..29]).to_be_bytes());
    png.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
    let text = decode(Path::new("a.png"), FileKind::Png, &png).unwrap_err().to_string();
    assert!(text.contains("30000x30000"), "{text}");
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n";
    let text = decode(Path::new("a.hdr"), FileKind::Hdr, hdr).unwrap_err().to_string();
    assert!(text.contains("30000x30000"), "{text}");
}

/// CRC-32 as PNG wants it (ISO 3309), bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(crc & 1)))
    })
}

#[test]
fn errors_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.exr");
    let error = read(&missing).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert_eq!(error.to_string(), format!("{}: cannot read: no such file or directory", missing.display()));
    let text = folder.path().join("text.npy");
    std::fs::write(&text, "hello").unwrap();
    assert!(read_array(&text).unwrap_err().to_string().starts_with(&text.display().to_string()));
}

#[test]
fn files_of_another_kind_say_what_they_are() {
    let error = decode(Path::new("a.exr"), FileKind::Exr, &sound(FileKind::Png)).unwrap_err();
    assert!(error.to_string().contains("not a valid EXR file"), "{error}");
    let big_endian = b"\x93NUMPY\x01\x00\x36\x00{'descr': '>f4', 'fortran_order': False, 'shape': (1,)}";
    let mut bytes = big_endian.to_vec();
    bytes.resize(10 + 0x36, b' ');
    bytes.extend([0; 4]);
    let error = decode(Path::new("a.npy"), FileKind::Npy, &bytes).unwrap_err();
    assert_eq!(error.to_string(), "a.npy: numbers of type `>f4` are not supported; `<f4` is");
}
