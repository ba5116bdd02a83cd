//! How far a picture is from the truth.

use tyndall_image::metrics::{Percentiles, percentiles};

use crate::truth::Truth;

/// Errors are relative to the truth or, where that is darker, to this fraction of the mean of the true picture, so that very
/// dark pixels do not dominate.
pub(crate) const FLOOR: f64 = 0.01;

/// Errors of one picture.
#[derive(Debug, Clone)]
pub(crate) struct Errors {
    /// Over all channels of all pixels but those on outlines; `None` of a picture without pixels.
    pub percentiles: Option<Percentiles>,
    /// Of the sum of all pixels: of its worst channel, relative to the true sum.
    pub sum: f64,
    /// Of the worst channel of each pixel.
    pub of_pixels: Vec<f64>,
}

impl Errors {
    /// Of a picture that has the truth's pixels.
    pub fn new(found: &[[f32; 3]], truth: &Truth) -> Self {
        let floor = FLOOR * truth.mean();
        let pixels = found.iter().zip(&truth.pixels);
        let errors: Vec<[f64; 3]> = pixels
            .map(|(found, wanted)| [0, 1, 2].map(|channel| relative(found[channel], wanted[channel], floor)))
            .collect();
        let of_pixels = errors.iter().map(|pixel| pixel.iter().copied().fold(0.0, f64::max)).collect();
        let is_edge = |pixel: usize| truth.edges.as_ref().is_some_and(|edges| edges[pixel]);
        let compared = errors.iter().enumerate().filter(|(pixel, _)| !is_edge(*pixel));
        let mut values: Vec<f64> = compared.flat_map(|(_, errors)| *errors).collect();
        Self { percentiles: percentiles(&mut values), sum: sum(found, truth), of_pixels }
    }
}

/// The error of the sum of a picture; if the truth is black, anything else is infinitely wrong.
fn sum(found: &[[f32; 3]], truth: &Truth) -> f64 {
    let of_channel = |channel: usize| {
        let found: f64 = found.iter().map(|pixel| f64::from(pixel[channel])).sum();
        let wanted: f64 = truth.pixels.iter().map(|pixel| pixel[channel]).sum();
        let error = (found - wanted).abs() / wanted.abs();
        if found == wanted {
            0.0
        } else if error.is_nan() {
            f64::INFINITY
        } else {
            error
        }
    };
    (0..3).map(of_channel).fold(0.0, f64::max)
}

/// |found − wanted|/max(|wanted|, floor); NaN is infinitely wrong.
fn relative(found: f32, wanted: f64, floor: f64) -> f64 {
    let difference = (f64::from(found) - wanted).abs();
    if difference == 0.0 {
        0.0
    } else if difference.is_finite() {
        difference / wanted.abs().max(floor)
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// 100 grey pixels from 1 to 100; their mean is 50.5.
    fn ramp() -> Truth {
        Truth { pixels: (1..=100).map(|n| DVec3::splat(f64::from(n))).collect(), edges: None }
    }

    fn found(change: impl Fn(usize, f64) -> f64) -> Errors {
        let truth = ramp();
        let pixels = truth.pixels.iter().enumerate().map(|(index, pixel)| [change(index, pixel.x) as f32; 3]);
        Errors::new(&pixels.collect::<Vec<_>>(), &truth)
    }

    #[test]
    fn the_truth_has_no_error() {
        let errors = found(|_, value| value);
        assert_eq!(errors.percentiles.unwrap().max, 0.0);
        assert!(errors.of_pixels.iter().all(|error| *error == 0.0));
    }

    #[test]
    fn errors_are_relative_to_the_truth_and_not_to_what_was_found() {
        let errors = found(|_, value| value / 2.0).percentiles.unwrap();
        assert_eq!((errors.p50, errors.p99, errors.max), (0.5, 0.5, 0.5));
        assert_eq!(found(|_, value| value * 2.0).percentiles.unwrap().p50, 1.0);
    }

    #[test]
    fn one_pixel_in_a_hundred_is_the_maximum_and_no_percentile() {
        let errors = found(|index, value| if index == 9 { 3.0 * value } else { value });
        let percentiles = errors.percentiles.unwrap();
        assert_eq!((percentiles.p50, percentiles.p99, percentiles.max), (0.0, 0.0, 2.0));
        assert_eq!(errors.of_pixels.iter().position(|error| *error == 2.0), Some(9));
    }

    #[test]
    fn what_is_dark_is_compared_with_a_part_of_the_mean() {
        let truth = Truth { pixels: vec![DVec3::ZERO, DVec3::splat(200.0)], edges: None };
        let errors = Errors::new(&[[0.0, 0.0, 0.5], [200.0; 3]], &truth);
        assert_eq!(errors.of_pixels, [0.5 / (FLOOR * 100.0), 0.0]);
    }

    /// An error on an outline shows in the sum and on the map, but in no percentile.
    #[test]
    fn outlines_are_left_to_the_sum() {
        let pixels = vec![DVec3::splat(1.0); 4];
        let truth = Truth { pixels, edges: Some(vec![false, true, false, false]) };
        let errors = Errors::new(&[[1.0; 3], [3.0; 3], [1.0; 3], [1.0; 3]], &truth);
        assert_eq!((errors.percentiles.unwrap().max, errors.sum, errors.of_pixels[1]), (0.0, 0.5, 2.0));
        let errors = Errors::new(&[[1.0; 3], [1.0; 3], [1.0; 3], [1.0, 1.0, 2.0]], &truth);
        assert_eq!((errors.percentiles.unwrap().max, errors.sum), (1.0, 0.25));
    }

    #[test]
    fn what_is_no_number_is_infinitely_wrong() {
        for wrong in [f64::NAN, f64::INFINITY] {
            assert_eq!(found(|index, value| if index == 0 { wrong } else { value }).of_pixels[0], f64::INFINITY);
        }
        let black = Truth { pixels: vec![DVec3::ZERO], edges: None };
        assert_eq!(Errors::new(&[[0.0; 3]], &black).of_pixels, [0.0]);
        assert_eq!(Errors::new(&[[1e-9, 0.0, 0.0]], &black).of_pixels, [f64::INFINITY]);
    }
}
