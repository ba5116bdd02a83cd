//! What is written is read back: bit for bit where the format can, within its step where it cannot.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;

use tyndall_image::{Image, Meaning, linear_from_srgb, read, read_array, read_exact, write, write_array};

/// Every kind of number that a float can be, in `channels` channels, 7 × 5 pixels.
fn numbers(channels: u32) -> Image {
    let kinds = [
        0.0,
        -0.0,
        1.0,
        -2.5,
        f32::MIN_POSITIVE,
        1e-40,
        f32::from_bits(1),
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        f32::from_bits(0xffc1_2345),
        std::f32::consts::PI,
    ];
    let count = 7 * 5 * channels as usize;
    Image::new(7, 5, channels, kinds.iter().copied().cycle().take(count).collect())
}

fn bits(image: &Image) -> Vec<u32> {
    image.data.iter().map(|value| value.to_bits()).collect()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn same(path: &Path, image: &Image, meaning: Meaning) {
    write(path, image, meaning).unwrap();
    let read = read(path).unwrap();
    assert_eq!((read.width, read.height, read.layers, read.channels), (7, 5, image.layers, image.channels));
    assert_eq!(bits(&read), bits(image), "{meaning:?} in {}", path.display());
}

#[test]
fn exr_and_npy_are_exact_for_every_meaning() {
    let folder = folder();
    for name in ["a.exr", "a.npy"] {
        let path = folder.path().join(name);
        same(&path, &numbers(4), Meaning::Color);
        same(&path, &numbers(1), Meaning::Scalar);
        same(&path, &numbers(3), Meaning::Vector);
        (1..=4).for_each(|channels| same(&path, &numbers(channels), Meaning::Data));
    }
}

/// Beyond 2^24 a float would round them.
#[test]
fn whole_numbers_survive_and_files_say_what_they_are() {
    let folder = folder();
    let image = Image::new(2, 1, 4, vec![0, 1, (1 << 24) + 1, u32::MAX, u32::MAX - 1, 1 << 31, 70_000, 3]);
    for name in ["a.exr", "a.npy"] {
        let path = folder.path().join(name);
        write(&path, &image, Meaning::Data).unwrap();
        assert_eq!(read_exact(&path).unwrap(), image.clone().exact(), "{name}");
        assert_eq!(read(&path).unwrap(), image.floats(), "{name}");
    }
    let meta = exr::meta::MetaData::read_from_file(folder.path().join("a.exr"), true).unwrap();
    let types = meta.headers[0].channels.list.iter().map(|channel| channel.sample_type);
    assert!(types.eq([exr::prelude::SampleType::U32; 4]));
    let header = |path: &Path| String::from_utf8_lossy(&std::fs::read(path).unwrap()[..64]).into_owned();
    assert!(header(&folder.path().join("a.npy")).contains("'descr': '<u4'"));
    let signed = folder.path().join("b.npy");
    write_array(&signed, &[3], &[-1, i32::MIN, (1 << 24) + 1]).unwrap();
    assert!(header(&signed).contains("'descr': '<i4'"));
    let bytes = std::fs::read(&signed).unwrap();
    assert_eq!(bytes[bytes.len() - 12..], [-1, i32::MIN, (1 << 24) + 1].map(i32::to_le_bytes).concat());
}

#[test]
fn exr_channels_are_named_by_meaning() {
    let folder = folder();
    let names = |channels: u32, meaning: Meaning| {
        let path = folder.path().join("a.exr");
        write(&path, &numbers(channels), meaning).unwrap();
        let meta = exr::meta::MetaData::read_from_file(&path, true).unwrap();
        let list = &meta.headers[0].channels.list;
        assert!(list.iter().all(|channel| channel.sample_type == exr::prelude::SampleType::F32));
        list.iter().map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(names(4, Meaning::Color), "A B G R");
    assert_eq!(names(3, Meaning::Color), "A B G R");
    assert_eq!(names(4, Meaning::Display), "A B G R");
    assert_eq!(names(1, Meaning::Scalar), "Y");
    assert_eq!(names(4, Meaning::Scalar), "Y");
    assert_eq!(names(4, Meaning::Vector), "X Y Z");
    assert_eq!(names(3, Meaning::Vector), "X Y Z");
    assert_eq!(
        [1, 2, 3, 4].map(|channels| names(channels, Meaning::Data)),
        ["Y", "X Y", "X Y Z", "A B G R"].map(str::to_owned)
    );
}

#[test]
fn a_colour_without_alpha_is_opaque() {
    let folder = folder();
    let path = folder.path().join("a.exr");
    write(&path, &Image::filled(3, 2, &[0.1, 0.2, 0.3]), Meaning::Color).unwrap();
    assert_eq!(read(&path).unwrap(), Image::filled(3, 2, &[0.1, 0.2, 0.3, 1.0]));
}

#[test]
fn display_colour_is_linear_in_exr_and_untouched_in_png() {
    let folder = folder();
    let image = Image::filled(3, 2, &[0.5, 0.25, 1.0, 0.5]);
    let linear = [linear_from_srgb(0.5), linear_from_srgb(0.25), 1.0, 0.5];
    let exr = folder.path().join("a.exr");
    write(&exr, &image, Meaning::Display).unwrap();
    assert_eq!(read(&exr).unwrap(), Image::filled(3, 2, &linear));
    let png = folder.path().join("a.png");
    write(&png, &image, Meaning::Display).unwrap();
    let codes = image::open(&png).unwrap().into_rgba8().into_raw();
    assert_eq!(codes[..4], [128, 64, 255, 128]);
}

#[test]
fn png_encodes_what_is_linear() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let codes = |image: &Image, meaning: Meaning| {
        write(&path, image, meaning).unwrap();
        image::open(&path).unwrap().into_bytes()
    };
    assert_eq!(codes(&Image::filled(1, 1, &[0.214_041_14, 0.0, 9.0, 1.0]), Meaning::Color), [128, 0, 255, 255]);
    assert_eq!(codes(&Image::filled(1, 1, &[f32::NAN]), Meaning::Scalar), [0]);
    assert_eq!(codes(&Image::filled(1, 1, &[-1.0, 1.0, 0.0, 0.0]), Meaning::Vector), [0, 255, 0]);
    let grey = read(&path.with_file_name("b.png"));
    assert!(grey.is_err());
    write(&path, &Image::filled(2, 2, &[0.25, 0.5, 0.75]), Meaning::Color).unwrap();
    for (found, wanted) in read(&path).unwrap().data.iter().zip([0.25f32, 0.5, 0.75].iter().cycle()) {
        assert!((found - wanted).abs() < 0.005, "{found} {wanted}");
    }
}

#[test]
fn png_of_sixteen_bits_is_read_as_such() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let codes = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(2, 1, vec![1u16, 32_768]).unwrap();
    codes.save(&path).unwrap();
    let read = read(&path).unwrap();
    assert_eq!(read.channels, 1);
    assert_eq!(read.data, [1.0, 32_768.0].map(|code: f32| linear_from_srgb(code / 65_535.0)));
}

#[test]
fn hdr_keeps_one_part_in_a_hundred_of_the_largest() {
    let folder = folder();
    let path = folder.path().join("a.hdr");
    let data: Vec<f32> = (0..40 * 3 * 3).map(|n| 1.1f32.powi(n - 180)).collect();
    let image = Image::new(40, 3, 3, data);
    write(&path, &image, Meaning::Color).unwrap();
    let read = read(&path).unwrap();
    assert_eq!((read.width, read.height, read.channels), (40, 3, 3));
    for (found, wanted) in read.data.chunks(3).zip(image.data.chunks(3)) {
        let largest = wanted.iter().fold(0.0f32, |a, &b| a.max(b));
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= largest / 100.0), "{found:?} {wanted:?}");
    }
}

#[test]
fn layers_and_buffers_go_to_npy_only() {
    let folder = folder();
    let cube = Image { width: 3, height: 2, layers: 2, channels: 2, data: (0..24).map(|n| n as f32).collect() };
    let path = folder.path().join("a.npy");
    write(&path, &cube, Meaning::Data).unwrap();
    assert_eq!(read_array(&path).unwrap().shape, [2, 2, 3, 2]);
    assert_eq!(read(&path).unwrap(), cube);
    for name in ["a.exr", "a.png", "a.hdr"] {
        let error = write(&folder.path().join(name), &cube, Meaning::Data).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains(".npy"));
    }
    write_array(&path, &[24], &cube.data).unwrap();
    assert_eq!(read_array(&path).unwrap().shape, [24]);
    assert_eq!(read_array(&path).unwrap().data, cube.data);
    assert!(write_array(&path, &[23], &cube.data).is_err());
    assert!(read(&path).unwrap_err().to_string().contains("is not an image"));
}

#[test]
fn images_of_one_channel_have_two_axes() {
    let folder = folder();
    let path = folder.path().join("a.npy");
    write(&path, &numbers(4), Meaning::Scalar).unwrap();
    assert_eq!(read_array(&path).unwrap().shape, [5, 7]);
    write(&path, &numbers(4), Meaning::Vector).unwrap();
    assert_eq!(read_array(&path).unwrap().shape, [5, 7, 3]);
    write(&path, &numbers(4), Meaning::Color).unwrap();
    assert_eq!(read_array(&path).unwrap().shape, [5, 7, 4]);
}
