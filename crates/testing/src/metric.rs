//! How far a picture may be from what is expected.

use tyndall_image::{Image, metrics};

use crate::flip;
use crate::picture::Picture;

/// How two pictures are compared, and how far they may be apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Metric {
    /// Every number is bit-equal.
    Exact,
    /// No more than the part `failing` of the numbers differs by more than `tolerance`.
    Absolute {
        /// In the unit of the port.
        tolerance: f64,
        /// 0 to 1.
        failing: f64,
    },
    /// Root of the mean squared difference over that of the expected picture: for linear light. Of a data port every
    /// channel of every layer by itself, for they mean different things; the largest counts.
    RelativeRmse {
        /// At most this.
        tolerance: f64,
    },
    /// What a person sees of the difference (Andersson et al. 2020, LDR-FLIP, 67 pixels per degree): of a display port.
    Flip {
        /// The mean over all pixels is at most this.
        mean: f64,
        /// 99 % of the pixels are at most at this.
        p99: Option<f64>,
    },
}

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// Within the tolerance.
    pub passed: bool,
    /// What was measured, and what is allowed.
    pub figures: String,
    /// What was measured, over what is allowed: 1 is the limit, 0 where nothing differs. Infinite where nothing is allowed.
    pub excess: f64,
    /// The two pictures, where they were compared and are too far apart: for whoever wants to see it.
    pub pictures: Option<Box<Compared>>,
}

/// Two pictures that were compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// What came out.
    pub actual: Picture,
    /// What was expected.
    pub expected: Picture,
    /// How they were compared.
    pub metric: Metric,
}

/// Alpha of a colour is 1 by definition, so it has a tolerance of its own: the rounding of a half float.
pub(crate) const ALPHA_TOLERANCE: f64 = 5e-4;

impl Metric {
    /// The largest relative error for which nobody need say why.
    pub const STRICT: f64 = 1e-4;
    /// The loosest that any test may have: beyond these a comparison says little.
    pub const MOST_RMSE: f64 = 0.05;
    /// The largest part of numbers that may fail.
    pub const MOST_FAILING: f64 = 0.02;
    /// The largest absolute tolerance, as a part of the largest expected number.
    pub const MOST_OF_LARGEST: f64 = 0.05;
    /// The largest mean of FLIP.
    pub const MOST_FLIP_MEAN: f64 = 0.05;
    /// The largest 99th percentile of FLIP.
    pub const MOST_FLIP_P99: f64 = 0.5;

    /// Why no test may be this loose, where it is.
    pub fn beyond_cap(&self) -> Option<String> {
        let over = |what: &str, value: f64, most: f64| {
            (!(0.0..=most).contains(&value)).then(|| format!("{what} is {value}, and may be 0 to {most}"))
        };
        match *self {
            Metric::Exact => None,
            Metric::Absolute { tolerance, failing } => over("the failing part", failing, Self::MOST_FAILING)
                .or((tolerance < 0.0).then(|| format!("a tolerance must be at least 0, got {tolerance}"))),
            Metric::RelativeRmse { tolerance } => over("the relative RMSE", tolerance, Self::MOST_RMSE),
            Metric::Flip { mean, p99 } => over("the mean of FLIP", mean, Self::MOST_FLIP_MEAN)
                .or(p99.and_then(|p99| over("the 99th percentile of FLIP", p99, Self::MOST_FLIP_P99))),
        }
    }

    /// So strict that nobody need say why: rounding of 32-bit floats, a step of 8 bits here and there.
    pub fn is_strict(&self) -> bool {
        match *self {
            Metric::Exact => true,
            Metric::Absolute { tolerance, failing } => tolerance <= Self::STRICT && failing == 0.0,
            Metric::RelativeRmse { tolerance } => tolerance <= Self::STRICT,
            Metric::Flip { mean, p99 } => mean <= 0.005 && p99.is_none_or(|p99| p99 <= 0.05),
        }
    }

    /// The difference of one number that the tolerance is about, in the unit of the port: where a report draws the line
    /// between pixels that fail and pixels that do not.
    pub fn scale(&self, expected: &Picture) -> f64 {
        match *self {
            Metric::Exact => f64::from(f32::MIN_POSITIVE),
            Metric::Absolute { tolerance, .. } => tolerance,
            Metric::RelativeRmse { tolerance } => {
                let numbers = expected.compared().data.into_iter().filter(|value| value.is_finite());
                let (sum, count) = numbers.fold((0.0, 0), |(sum, count), v| (sum + v.powi(2), count + 1));
                tolerance * (sum / f64::from(count.max(1))).sqrt()
            }
            Metric::Flip { mean, p99 } => p99.unwrap_or(mean),
        }
    }

    /// What a judgement by this metric measured, in the unit of the tolerance; `None` where that is not known.
    pub(crate) fn measured(&self, judgement: &Judgement) -> Option<f64> {
        let tolerance = self.tolerance()?;
        Some(judgement.excess * tolerance).filter(|measured| measured.is_finite())
    }

    /// The one number that it allows.
    fn tolerance(&self) -> Option<f64> {
        match *self {
            Metric::Absolute { tolerance, .. } | Metric::RelativeRmse { tolerance } => Some(tolerance),
            Metric::Exact | Metric::Flip { .. } => None,
        }
    }

    /// What is held by this metric differs by less than was measured by another one.
    pub(crate) fn excludes(&self, measured_by: &Metric, judgement: &Judgement) -> bool {
        let is_like = std::mem::discriminant(self) == std::mem::discriminant(measured_by);
        let measured = measured_by.measured(judgement).filter(|_| is_like);
        *self == Metric::Exact || self.tolerance().zip(measured).is_some_and(|(tolerance, found)| tolerance < found)
    }

    /// Compares; pictures that cannot be compared do not pass.
    pub fn judge(&self, actual: &Picture, expected: &Picture) -> Judgement {
        let mut judgement = self
            .try_judge(actual, expected)
            .unwrap_or_else(|why| Judgement::failed(format!("cannot be compared: {why}")));
        if !judgement.passed {
            let compared = Compared { actual: actual.clone(), expected: expected.clone(), metric: *self };
            judgement.pictures = Some(Box::new(compared));
        }
        judgement
    }

    fn try_judge(&self, actual: &Picture, expected: &Picture) -> Result<Judgement, String> {
        let said = |error: metrics::Incomparable| error.to_string();
        let (image, wanted) = (actual.compared(), expected.compared());
        metrics::same_shape(&image, &wanted).map_err(said)?;
        if let Some(alpha) = alpha_mistake(actual, expected)? {
            return Ok(Judgement::failed(alpha));
        }
        match *self {
            Metric::Exact => {
                let differing = metrics::differing_bits(&image, &wanted).map_err(said)?;
                let figures = format!("{differing} of {} numbers differ, none may", image.data.len());
                Ok(Judgement::new(differing == 0, figures, over(differing as f64, 0.0)))
            }
            Metric::Absolute { tolerance, failing } => {
                if let Some(why) = beyond_largest(tolerance, largest(&wanted)) {
                    return Ok(Judgement::failed(why));
                }
                let found = metrics::absolute(&image, &wanted, tolerance).map_err(said)?;
                let part = found.failing_fraction();
                let figures = format!(
                    "{:.2} % of the numbers differ by more than {tolerance:e} (at most {} %), the largest by {:.3e}",
                    100.0 * part,
                    100.0 * failing,
                    found.largest
                );
                let largest = if part <= failing { found.largest.min(tolerance) } else { found.largest };
                Ok(Judgement::new(part <= failing, figures, over(largest, tolerance)))
            }
            Metric::RelativeRmse { tolerance } => {
                let like_actual = Picture { image: expected.image.clone(), ..*actual };
                let mut worst = 0.0f64;
                for (image, wanted) in actual.planes().iter().zip(&like_actual.planes()) {
                    worst = worst.max(metrics::relative_rmse(image, wanted).map_err(said)?);
                }
                let figures = format!("relative RMSE {worst:.3e}, at most {tolerance:e}");
                Ok(Judgement::new(worst <= tolerance, figures, over(worst, tolerance)))
            }
            Metric::Flip { mean, p99 } => {
                let found = flip::compare(actual, expected)?;
                let mut figures = format!("FLIP mean {:.4}, at most {mean}", found.mean);
                let mut excess = over(found.mean, mean);
                if let Some(p99) = p99 {
                    figures += &format!("; 99th percentile {:.4}, at most {p99}", found.p99);
                    excess = excess.max(over(found.p99, p99));
                }
                Ok(Judgement::new(found.mean <= mean && p99.is_none_or(|p99| found.p99 <= p99), figures, excess))
            }
        }
    }
}

impl Judgement {
    /// Without pictures.
    pub(crate) fn new(passed: bool, figures: String, excess: f64) -> Self {
        Self { passed, figures, excess, pictures: None }
    }

    /// One that nothing makes good.
    pub(crate) fn failed(figures: String) -> Self {
        Self::new(false, figures, f64::INFINITY)
    }
}

/// What was measured over what is allowed: nothing uses up none of it, even where none is allowed.
pub(crate) fn over(measured: f64, allowed: f64) -> f64 {
    if measured == 0.0 { 0.0 } else { measured / allowed }
}

/// Why an absolute tolerance is too large beside the largest expected number.
fn beyond_largest(tolerance: f64, largest: f64) -> Option<String> {
    let most = Metric::MOST_OF_LARGEST * largest;
    let all_zero =
        || format!("every expected number is 0, and a tolerance of {tolerance} is much beside that: use Exact");
    let part = || format!("a tolerance of {tolerance} is more than 5 % of the largest number: at most {most:e}");
    (tolerance > most).then(|| if largest == 0.0 { all_zero() } else { part() })
}

fn alpha_mistake(actual: &Picture, expected: &Picture) -> Result<Option<String>, String> {
    let (Some(alpha), Some(wanted)) = (actual.alpha(), expected.alpha()) else { return Ok(None) };
    let found = metrics::absolute(&alpha, &wanted, ALPHA_TOLERANCE).map_err(|error| error.to_string())?;
    Ok((found.failing > 0)
        .then(|| format!("alpha differs in {} pixels, by up to {:.3e}", found.failing, found.largest)))
}

fn largest(image: &Image<f64>) -> f64 {
    let finite = image.data.iter().filter(|value| value.is_finite());
    finite.fold(0.0, |most, value| most.max(value.abs()))
}

impl std::fmt::Display for Metric {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Metric::Exact => f.write_str("Exact"),
            Metric::Absolute { tolerance, failing } => {
                write!(f, "Absolute(tolerance: {tolerance:e}, failing: {failing})")
            }
            Metric::RelativeRmse { tolerance } => write!(f, "RelativeRmse({tolerance:e})"),
            Metric::Flip { mean, p99: Some(p99) } => write!(f, "Flip(mean: {mean}, p99: {p99})"),
            Metric::Flip { mean, p99: None } => write!(f, "Flip(mean: {mean})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use tyndall_graph::descriptor::Class;

    use super::*;

    fn ramp(class: Class, change: impl Fn(usize, f32) -> f32) -> Picture {
        let data =
            (0..16 * 16 * 4).map(|index| if index % 4 == 3 { 1.0 } else { change(index, 0.1 + index as f32 / 2048.0) });
        Picture::new(Image::new(16, 16, 4, data.collect()), class)
    }

    /// Every metric with the loosest tolerance but one.
    const ALL: [Metric; 4] = [
        Metric::Exact,
        Metric::Absolute { tolerance: 1e-3, failing: 0.0 },
        Metric::RelativeRmse { tolerance: 1e-3 },
        Metric::Flip { mean: 0.005, p99: Some(0.05) },
    ];

    #[test]
    fn a_picture_is_itself_and_half_of_it_is_not() {
        for class in [Class::Display, Class::Color] {
            let picture = ramp(class, |_, value| value);
            let half = ramp(class, |_, value| value / 2.0);
            for metric in ALL.iter().filter(|metric| class == Class::Display || !matches!(metric, Metric::Flip { .. }))
            {
                assert!(metric.judge(&picture, &picture).passed, "{metric}");
                let found = metric.judge(&half, &picture);
                assert!(!found.passed && found.excess > 1.0, "{metric}: {found:?}");
            }
        }
    }

    #[test]
    fn alpha_and_nan_never_pass() {
        let picture = ramp(Class::Display, |_, value| value);
        let mut clear = picture.clone();
        clear.image.data[7] = 0.5;
        let nan = ramp(Class::Display, |index, value| if index == 400 { f32::NAN } else { value });
        for metric in ALL {
            assert!(!metric.judge(&clear, &picture).passed, "{metric}");
            assert!(!metric.judge(&nan, &picture).passed, "{metric}");
        }
    }

    #[test]
    fn a_small_channel_of_data_counts_beside_a_large_one() {
        let picture = |small: f32| {
            let data = (0..64).flat_map(|_| [small, 1000.0]).collect();
            Picture::new(Image::new(8, 8, 2, data), Class::Data)
        };
        let metric = Metric::RelativeRmse { tolerance: 0.01 };
        assert!(!metric.judge(&picture(0.5), &picture(1.0)).passed);
        assert!(metric.judge(&picture(1.0), &picture(1.0)).passed);
    }

    /// The elements of a buffer hold numbers of all sizes, too.
    #[test]
    fn each_number_of_an_element_counts() {
        let buffer = |small: f32| {
            let data = (0..8).flat_map(|_| [small, 1000.0, 0.0]).collect();
            let image = Image { width: 3, height: 8, layers: 1, channels: 1, data };
            Picture { is_buffer: true, ..Picture::new(image, Class::Data) }
        };
        let metric = Metric::RelativeRmse { tolerance: 0.01 };
        assert!(!metric.judge(&buffer(1e-6), &buffer(2e-6)).passed);
        assert!(metric.judge(&buffer(1e-6), &buffer(1e-6)).passed);
        let mut shorter = buffer(1e-6);
        shorter.image = Image { height: 4, data: shorter.image.data[..12].to_vec(), ..shorter.image };
        assert!(!metric.judge(&shorter, &buffer(1e-6)).passed);
    }

    #[test]
    fn tolerances_are_capped() {
        assert!(Metric::RelativeRmse { tolerance: 0.06 }.beyond_cap().is_some());
        assert!(Metric::Absolute { tolerance: 0.1, failing: 0.5 }.beyond_cap().is_some());
        assert!(Metric::Flip { mean: 0.2, p99: None }.beyond_cap().is_some());
        assert!(Metric::RelativeRmse { tolerance: f64::NAN }.beyond_cap().is_some());
        assert!(ALL.iter().all(|metric| metric.beyond_cap().is_none()));
        let picture = ramp(Class::Color, |_, value| value);
        let loose = Metric::Absolute { tolerance: 0.5, failing: 0.0 };
        assert!(loose.judge(&picture, &picture).figures.contains("5 %"));
        // Where nothing is expected, every tolerance is a large one.
        let black = ramp(Class::Color, |_, _| 0.0);
        for tolerance in [1e-6, 0.5] {
            let found = Metric::Absolute { tolerance, failing: 0.0 }.judge(&black, &black);
            assert!(!found.passed && found.figures.contains("every expected number is 0"), "{found:?}");
        }
        assert!(Metric::Absolute { tolerance: 0.0, failing: 0.0 }.judge(&black, &black).passed);
    }

    #[test]
    fn what_is_too_far_apart_can_be_seen() {
        let (one, half) = (ramp(Class::Color, |_, value| value), ramp(Class::Color, |_, value| value / 2.0));
        let metric = Metric::RelativeRmse { tolerance: 1e-3 };
        assert!(metric.judge(&one, &one).pictures.is_none());
        let pictures = metric.judge(&half, &one).pictures.unwrap();
        assert_eq!((pictures.actual, pictures.expected), (half, one));
    }
}
