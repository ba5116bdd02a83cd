//! `diff`: two image files, by the metrics of image tests.

use std::path::Path;

use tyndall_graph::descriptor::Class;
use tyndall_image::{FileKind, Image, metrics, srgb_from_linear, supported};
use tyndall_testing::file::parse_metric;
use tyndall_testing::{Metric, Picture};

use crate::cli::Diff;
use crate::failure::Failure;
use crate::terminal;

pub(crate) fn run(verb: &Diff) -> Result<(), Failure> {
    let metrics = verb.by.iter().map(|text| parse_metric(text, &format!("--by {text}")));
    let metrics = metrics.collect::<Result<Vec<Metric>, _>>()?;
    let (mut image, mut reference) =
        (tyndall_image::read_exact(&verb.image)?, tyndall_image::read_exact(&verb.reference)?);
    if let (3, 4) | (4, 3) = (image.channels, reference.channels) {
        terminal::line("only one of them has alpha: red, green and blue are compared");
        (image, reference) = (image.first_channels(3), reference.first_channels(3));
    }
    if let Err(why) = metrics::absolute(&image, &reference, 0.0) {
        return Err(Failure::Usage(format!("{} and {}: {why}", verb.image.display(), verb.reference.display())));
    }
    let display = is_png(&verb.image)? && is_png(&verb.reference)?;
    let metrics = if metrics.is_empty() { usual(display) } else { metrics };
    let mut differ = false;
    for metric in metrics {
        // A metric of what a person sees compares encoded pictures; the others compare the numbers in the files.
        let seen = matches!(metric, Metric::Flip { .. });
        let [image, reference] = [&image, &reference].map(|image| picture(image, seen));
        let found = metric.judge(&image, &reference);
        differ |= !found.passed;
        terminal::line(&format!("{}  {metric}: {}", if found.passed { "within" } else { "beyond" }, found.figures));
    }
    if differ { Err(Failure::Reported(1)) } else { Ok(()) }
}

fn is_png(path: &Path) -> Result<bool, Failure> {
    Ok(supported(path)? == FileKind::Png)
}

/// The strictest of each metric, for want of `--by`.
fn usual(display: bool) -> Vec<Metric> {
    let mut metrics = vec![Metric::Exact, Metric::RelativeRmse { tolerance: 1e-4 }];
    metrics.extend(display.then_some(Metric::Flip { mean: 0.005, p99: Some(0.05) }));
    metrics
}

fn picture(image: &Image<f64>, seen: bool) -> Picture {
    match (seen, image.channels) {
        (true, _) => Picture::new(shown(image), Class::Display),
        (false, 3 | 4) => Picture::new(image.clone(), Class::Color),
        (false, _) => Picture::new(image.clone(), Class::Data),
    }
}

/// Encoded as sRGB for a screen.
fn shown(image: &Image<f64>) -> Image {
    let channels = image.channels as usize;
    let mut shown = image.floats();
    let colours = shown.data.iter_mut().enumerate().filter(|(index, _)| index % channels != 3);
    colours.for_each(|(_, value)| *value = srgb_from_linear(*value));
    shown
}
