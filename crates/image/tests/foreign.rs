//! Files as other programs write them: windows and alpha of EXR, headers of Radiance.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;

use exr::meta::attribute::IntegerBounds;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image as ExrImage, ImageAttributes, Layer,
    LayerAttributes, LineOrder, Vec2, WritableImage,
};
use tyndall_image::{FileKind, Image, decode};

/// First and last pixel.
type Corners = [[i32; 2]; 2];

fn size([first, last]: Corners) -> [usize; 2] {
    [0, 1].map(|axis| (last[axis] - first[axis] + 1) as usize)
}

/// A file with these channels, each holding 1 + its number of pixels from the top left, times its place in the list.
fn exr(names: &[&str], data: Corners, display: Corners, blocks: Blocks) -> Vec<u8> {
    let [width, height] = size(data);
    let channel = |(place, name): (usize, &&str)| {
        let samples = (0..width * height).map(|pixel| ((pixel + 1) * (place + 1)) as f32).collect();
        AnyChannel::new(*name, FlatSamples::F32(samples))
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let attributes = LayerAttributes { layer_position: Vec2(data[0][0], data[0][1]), ..LayerAttributes::default() };
    let encoding = Encoding { compression: Compression::ZIP16, blocks, line_order: LineOrder::Increasing };
    let layer = Layer::new((width, height), attributes, encoding, channels);
    let [shown, rows] = size(display);
    let window = IntegerBounds::new((display[0][0], display[0][1]), (shown, rows));
    let mut image = ExrImage::from_layer(layer);
    image.attributes = ImageAttributes::new(window);
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn read_exr(bytes: &[u8]) -> Image {
    decode(Path::new("a.exr"), FileKind::Exr, bytes).unwrap()
}

fn refused(kind: FileKind, bytes: &[u8]) -> String {
    decode(Path::new("a"), kind, bytes).unwrap_err().to_string()
}

const WHOLE: Corners = [[0, 0], [9, 7]];

#[test]
fn a_picture_is_what_its_display_window_shows() {
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 4))] {
        for (data, display) in [
            // A crop, overscan, both, and the same far from the origin.
            ([[5, 4], [14, 11]], [[0, 0], [19, 15]]),
            ([[-3, -2], [22, 17]], [[0, 0], [19, 15]]),
            ([[-4, 3], [9, 20]], [[0, 0], [19, 15]]),
            ([[10, 4], [30, 6]], [[0, 0], [19, 15]]),
            ([[-90, 104], [-81, 111]], [[-95, 100], [-76, 115]]),
            ([[0, 0], [19, 15]], [[0, 0], [19, 15]]),
            ([[7, 7], [16, 14]], [[7, 7], [16, 14]]),
        ] {
            let image = read_exr(&exr(&["R", "G", "B", "A"], data, display, blocks));
            let ([width, height], stored) = (size(display), size(data)[0]);
            assert_eq!((image.width as usize, image.height as usize, image.channels), (width, height, 4));
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let at = [x as i32 + display[0][0] - data[0][0], y as i32 + display[0][1] - data[0][1]];
                let is_inside = [0, 1].iter().all(|&axis| (0..size(data)[axis] as i32).contains(&at[axis]));
                let pixel = if is_inside { (at[1] as usize * stored + at[0] as usize + 1) as f32 } else { 0.0 };
                let expected = [1.0, 2.0, 3.0, 4.0].map(|place| place * pixel);
                assert_eq!(image.pixel(x as u32, y as u32).unwrap(), expected, "{data:?} {display:?} at {x} {y}");
            }
        }
    }
}

#[test]
fn pixels_that_are_all_outside_of_the_picture_are_refused() {
    let text = refused(FileKind::Exr, &exr(&["Y"], [[20, 0], [29, 7]], [[0, 0], [19, 15]], Blocks::ScanLines));
    assert!(
        text.contains("its data window, (20 0)-(29 7), lies outside of its display window, (0 0)-(19 15)"),
        "{text}"
    );
}

/// A picture may be much larger than what a file holds of it, but not by any factor.
#[test]
fn a_small_region_of_a_large_picture_is_read_and_a_huge_picture_is_not() {
    let region = |last: [i32; 2]| exr(&["R", "G", "B", "A"], WHOLE, [[0, 0], last], Blocks::ScanLines);
    assert_eq!(read_exr(&region([1919, 1079])).width, 1920);
    let text = refused(FileKind::Exr, &region([4999, 4999]));
    assert!(text.contains("of 5000x5000 pixels the file holds only 80"), "{text}");
    assert!(refused(FileKind::Exr, &region([99_999, 0])).contains("on a side"));
}

#[test]
fn alpha_is_read_beside_whatever_it_stands() {
    let names = |names: &[&str]| exr(names, WHOLE, WHOLE, Blocks::ScanLines);
    let second = |list: &[&str]| read_exr(&names(list)).pixel(1, 0).unwrap().to_vec();
    // The second pixel holds 2 times the place of each channel in the list.
    assert_eq!(second(&["Y", "A"]), [2.0, 2.0, 2.0, 4.0]);
    assert_eq!(second(&["A", "Y"]), [4.0, 4.0, 4.0, 2.0]);
    assert_eq!(second(&["Z", "A"]), [2.0, 2.0, 2.0, 4.0]);
    assert_eq!(second(&["R", "G", "B", "A"]), [2.0, 4.0, 6.0, 8.0]);
    assert_eq!(second(&["X", "Y", "Z", "A"]), [2.0, 4.0, 6.0, 8.0]);
    assert_eq!(second(&["X", "Y", "Z"]), [2.0, 4.0, 6.0]);
    assert_eq!(second(&["X", "Y"]), [2.0, 4.0]);
    assert_eq!(second(&["A"]), [2.0]);
    // What is left of these would be another picture.
    for list in [&["X", "Y", "A"][..], &["Y", "RY", "BY"], &["Y", "RY", "BY", "A"], &["U", "V"]] {
        let text = refused(FileKind::Exr, &names(list));
        assert!(text.contains("no layer with the channels") && text.contains(list[0]), "{list:?}: {text}");
    }
}

/// A Radiance file of 3 by 2 pixels, not packed; red is the pixel's number in the file, from 1, over 256.
fn radiance(header: &str, resolution: &str) -> Vec<u8> {
    let pixels = (1..=6).flat_map(|number| [number, 0, 0, 128]);
    format!("{header}\n\n{resolution}\n").into_bytes().into_iter().chain(pixels).collect()
}

fn reds(bytes: &[u8]) -> (u32, u32, Vec<f32>) {
    let image = decode(Path::new("a.hdr"), FileKind::Hdr, bytes).unwrap();
    (image.width, image.height, image.data.iter().step_by(3).map(|red| red * 256.0).collect())
}

#[test]
fn radiance_files_of_any_program() {
    let numbers = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    for name in ["#?RADIANCE", "#?RGBE", "#?AUTOPANO"] {
        for header in [
            format!("{name}\nFORMAT=32-bit_rle_rgbe"),
            format!("{name}\n# made by hand\nFORMAT=32-bit_rle_rgbe\nGAMMA=1"),
        ] {
            assert_eq!(reds(&radiance(&header, "-Y 2 +X 3")), (3, 2, numbers.clone()), "{header}");
        }
    }
}

#[test]
fn radiance_scanlines_run_in_any_order() {
    for (resolution, expected) in [
        ("-Y 2 +X 3", (3, 2, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])),
        ("+Y 2 +X 3", (3, 2, vec![4.0, 5.0, 6.0, 1.0, 2.0, 3.0])),
        ("-Y 2 -X 3", (3, 2, vec![3.0, 2.0, 1.0, 6.0, 5.0, 4.0])),
        ("+X 3 -Y 2", (3, 2, vec![1.0, 3.0, 5.0, 2.0, 4.0, 6.0])),
        ("-X 2 +Y 3", (2, 3, vec![6.0, 3.0, 5.0, 2.0, 4.0, 1.0])),
    ] {
        assert_eq!(reds(&radiance("#?RADIANCE", resolution)), expected, "{resolution}");
    }
}

#[test]
fn exposure_is_taken_out() {
    let halves = vec![0.5, 1.0, 1.5, 2.0, 2.5, 3.0];
    for header in ["EXPOSURE=2.0", "EXPOSURE= 4\nEXPOSURE=0.5", "COLORCORR=2 1 1"] {
        let bytes = radiance(&format!("#?RGBE\n{header}"), "-Y 2 +X 3");
        assert_eq!(reds(&bytes), (3, 2, halves.clone()), "{header}");
    }
    let text = refused(FileKind::Hdr, &radiance("#?RGBE\nEXPOSURE=0", "-Y 2 +X 3"));
    assert!(text.contains("`EXPOSURE=0`"), "{text}");
}
