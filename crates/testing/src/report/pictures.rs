//! Ports as pictures for the eye: what came out, what was expected, where they differ.

use std::path::Path;

use tyndall_graph::descriptor::Class;
use tyndall_image::{Error, Image, Meaning, NewFolder, encode_png, srgb_from_linear};
use tyndall_page::false_color::{NOT_A_NUMBER, Rgb, STEPS, of_difference};

use crate::flip;
use crate::metric::{ALPHA_TOLERANCE, Compared, Metric};
use crate::outcome::{PortOutcome, UncheckedPort};
use crate::picture::Picture;

/// Multiples of the tolerance at which failing pixels are shown.
pub(super) const MULTIPLES: [f64; 4] = [0.5, 1.0, 2.0, 4.0];

/// A picture that is shown.
pub(super) struct Shown {
    /// What the names of its files begin with, in the folder of the test.
    pub stem: String,
    /// How many numbers of what came out lie in each of equal ranges.
    pub histogram: Vec<usize>,
    /// From where to where the ranges go.
    pub range: (f32, f32),
    /// What was expected, where it is held against that.
    pub against: Option<Against>,
}

/// What was expected, and how far what came out is from it.
pub(super) struct Against {
    /// Pixels beyond each multiple of the tolerance.
    pub failing: [usize; 4],
    /// Pixels in all.
    pub pixels: usize,
    /// The largest difference, over the tolerance: what is white in the picture of the difference.
    pub largest: f64,
    /// How many numbers of what was expected lie in each of the ranges.
    pub histogram: Vec<usize>,
}

/// Where pictures of a test go.
pub(super) struct Folder<'a> {
    /// The report.
    pub report: &'a NewFolder,
    /// The folder of the test in it.
    pub name: &'a str,
}

impl Folder<'_> {
    /// A port that the test looks at: with its golden, where it has one.
    pub fn port(&self, port: &PortOutcome) -> Result<Option<Shown>, Error> {
        let Some(actual) = &port.actual else { return Ok(None) };
        let expected = port.expected.as_ref().zip(port.metric);
        self.show(format!("{}.{}", port.name, port.frame), actual, expected).map(Some)
    }

    /// Two pictures that are too far apart.
    pub fn compared(&self, stem: String, compared: &Compared) -> Result<Shown, Error> {
        self.show(stem, &compared.actual, Some((&compared.expected, compared.metric)))
    }

    /// A port that the test does not look at.
    pub fn unchecked(&self, port: &UncheckedPort) -> Result<(), Error> {
        self.save(&format!("{}.{}", port.name, port.frame), "actual", &Exposure::of(&port.picture).shown(&port.picture))
    }

    fn save(&self, stem: &str, what: &str, image: &Image) -> Result<(), Error> {
        let path = format!("{}/{stem}.{what}.png", self.name);
        self.report.write(&path, &encode_png(Path::new(&path), image, Meaning::Display)?)
    }

    fn show(&self, stem: String, actual: &Picture, expected: Option<(&Picture, Metric)>) -> Result<Shown, Error> {
        let like = |image: &Image<f64>| (image.width, image.height, image.layers, image.channels);
        let expected = expected.filter(|(expected, _)| like(&expected.image) == like(&actual.image));
        let exposure = Exposure::of(expected.map_or(actual, |(expected, _)| expected));
        self.save(&stem, "actual", &exposure.shown(actual))?;
        let against = expected.map(|(expected, metric)| self.against(&stem, actual, expected, metric, &exposure));
        let histogram = histogram(actual, exposure.range);
        Ok(Shown { stem, histogram, range: exposure.range, against: against.transpose()? })
    }

    fn against(
        &self,
        stem: &str,
        actual: &Picture,
        expected: &Picture,
        metric: Metric,
        exposure: &Exposure,
    ) -> Result<Against, Error> {
        let excess = of_metric(actual, expected, metric);
        let (width, height) = flat(&actual.image);
        let largest = excess.iter().copied().filter(|excess| excess.is_finite()).fold(10.0, f64::max);
        let image = |color: &dyn Fn(f64) -> Rgb| {
            let bytes = excess.iter().flat_map(|excess| color(*excess));
            Image::new(width, height, 3, bytes.map(|byte| f32::from(byte) / 255.0).collect())
        };
        let exceeded = |excess: f64| MULTIPLES.iter().filter(|multiple| excess > **multiple).count();
        self.save(stem, "expected", &exposure.shown(expected))?;
        self.save(stem, "difference", &image(&|excess| of_difference(excess, largest)))?;
        self.save(stem, "failing", &image(&|excess| STEPS[exceeded(excess)]))?;
        let failing = MULTIPLES.map(|multiple| excess.iter().filter(|excess| **excess > multiple).count());
        Ok(Against { failing, pixels: excess.len(), largest, histogram: histogram(expected, exposure.range) })
    }
}

/// Layers below one another.
fn flat<T>(image: &Image<T>) -> (u32, u32) {
    (image.width, image.height * image.layers)
}

/// How numbers become grey or colour; the same for what came out and for what was expected.
struct Exposure {
    class: Class,
    range: (f32, f32),
}

impl Exposure {
    /// So that 99 of 100 numbers are within.
    fn of(picture: &Picture) -> Self {
        let mut finite: Vec<f32> =
            picture.compared().floats().data.into_iter().filter(|value| value.is_finite()).collect();
        let mut at = |part: f32| {
            let place = (part * finite.len().saturating_sub(1) as f32) as usize;
            // Only what stands at the place is wanted, and not all in order.
            if finite.is_empty() { 0.0 } else { *finite.select_nth_unstable_by(place, f32::total_cmp).1 }
        };
        let range = match picture.class {
            Class::Display => (0.0, 1.0),
            Class::Vector => (-1.0, 1.0),
            Class::Color => (0.0, at(0.99)),
            _ => (at(0.01).min(0.0), at(0.99)),
        };
        Self { class: picture.class, range: (range.0, range.1.max(range.0 + f32::MIN_POSITIVE)) }
    }

    fn shown(&self, picture: &Picture) -> Image {
        let compared = picture.compared().floats();
        let (low, high) = self.range;
        let code = |value: f32| {
            let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
            if matches!(self.class, Class::Display | Class::Vector) { part } else { srgb_from_linear(part) }
        };
        let channels = compared.channels as usize;
        let texel = |texel: &[f32]| match *texel {
            [y] => [code(y); 3],
            [x, y] => [code(x), code(y), 0.0],
            [r, g, b, ..] => [code(r), code(g), code(b)],
            [] => [0.0; 3],
        };
        let (width, height) = flat(&compared);
        let nan = NOT_A_NUMBER.map(|byte| f32::from(byte) / 255.0);
        let nan_is_seen = |texel: [f32; 3]| if texel.iter().any(|value| value.is_nan()) { nan } else { texel };
        let data = compared.data.chunks_exact(channels).flat_map(|numbers| nan_is_seen(texel(numbers))).collect();
        Image::new(width, height, 3, data)
    }
}

/// How far each pixel is beyond what a metric allows, over the tolerance.
fn of_metric(actual: &Picture, expected: &Picture, metric: Metric) -> Vec<f64> {
    let seen = matches!(metric, Metric::Flip { .. }).then(|| flip::map(actual, expected));
    let scale = metric.scale(expected);
    let mut excess = match seen {
        Some(Ok(seen)) => seen.into_iter().map(|seen| seen / scale).collect(),
        _ => excess(actual, expected, scale),
    };
    if let (Some(alpha), Some(wanted)) = (actual.alpha(), expected.alpha()) {
        for (excess, (alpha, wanted)) in excess.iter_mut().zip(alpha.data.iter().zip(&wanted.data)) {
            *excess = excess.max((alpha - wanted).abs() / ALPHA_TOLERANCE);
        }
    }
    excess
}

/// The largest difference of each pixel, over the tolerance.
fn excess(actual: &Picture, expected: &Picture, scale: f64) -> Vec<f64> {
    let (actual, expected) = (actual.compared(), expected.compared());
    let channels = actual.channels.max(1) as usize;
    let difference = |(a, b): (&f64, &f64)| {
        let difference = (a - b).abs();
        if a.to_bits() == b.to_bits() || a == b {
            0.0
        } else if difference.is_nan() {
            f64::INFINITY
        } else {
            difference / scale
        }
    };
    let pixels = actual.data.chunks_exact(channels).zip(expected.data.chunks_exact(channels));
    pixels.map(|(a, b)| a.iter().zip(b).map(difference).fold(0.0, f64::max)).collect()
}

/// Numbers in 32 equal ranges; those outside count in the outermost, those that are not finite nowhere.
fn histogram(picture: &Picture, (low, high): (f32, f32)) -> Vec<usize> {
    let mut counts = vec![0; 32];
    for value in picture.compared().floats().data.iter().filter(|value| value.is_finite()) {
        let part = ((value - low) / (high - low)).clamp(0.0, 1.0);
        counts[((part * 32.0) as usize).min(31)] += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(value: f32) -> Picture {
        Picture::new(Image::filled(4, 4, &[value, 0.5, 0.25, 1.0]), Class::Color)
    }

    #[test]
    fn excess_counts_in_tolerances_and_nan_is_beyond_all() {
        assert!(excess(&picture(0.5), &picture(0.5), 0.1).iter().all(|excess| *excess == 0.0));
        let found = excess(&picture(0.5), &picture(0.25), 0.125);
        assert!(found.len() == 16 && found.iter().all(|excess| (excess - 2.0).abs() < 1e-9));
        assert!(excess(&picture(f32::NAN), &picture(0.25), 0.1).iter().all(|excess| excess.is_infinite()));
    }

    #[test]
    fn alpha_counts_and_flip_sees_what_a_person_sees() {
        let of_alpha = |alpha| Picture::new(Image::filled(4, 4, &[0.5, 0.5, 0.25, alpha]), Class::Color);
        let light = Metric::RelativeRmse { tolerance: 0.01 };
        assert!(of_metric(&of_alpha(0.5), &of_alpha(1.0), light).iter().all(|excess| *excess > 4.0));
        let grey = |code: f32| Picture::new(Image::filled(16, 16, &[code / 255.0; 3]), Class::Display);
        let seen = Metric::Flip { mean: 0.005, p99: Some(0.05) };
        assert!(of_metric(&grey(129.0), &grey(128.0), seen).iter().all(|excess| *excess < 1.0));
        assert!(of_metric(&grey(255.0), &grey(0.0), seen).iter().all(|excess| *excess > 4.0));
    }

    #[test]
    fn histograms_count_every_finite_number() {
        let counts = histogram(&picture(0.5), (0.0, 1.0));
        assert_eq!(counts.iter().sum::<usize>(), 4 * 4 * 3);
        assert_eq!((counts[16], counts[8]), (32, 16));
        assert_eq!(histogram(&picture(f32::NAN), (0.0, 1.0)).iter().sum::<usize>(), 4 * 4 * 2);
    }
}
