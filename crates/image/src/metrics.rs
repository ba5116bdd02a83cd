//! Numbers that say how far an image is from a reference.
//!
//! All work on the plain numbers of the images, each channel of each pixel by itself, in double precision.
//! Numbers that are equal differ by 0, equal infinities too; NaN, and an infinity against anything else, differ by
//! infinity. So an image with NaN in it never passes, whatever the tolerance.
//! Images of different sizes or channels, and selections without a pixel, are errors: nothing passes by being empty.

use crate::Image;

/// Why two images cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Incomparable(String);

/// How many numbers differ by more than a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Absolute {
    /// The largest difference, in the unit of the images.
    pub largest: f64,
    /// How many numbers differ by more than the tolerance.
    pub failing: usize,
    /// How many numbers were compared.
    pub count: usize,
}

impl Absolute {
    /// The fraction of the numbers that differ by more than the tolerance, 0 to 1.
    pub fn failing_fraction(&self) -> f64 {
        self.failing as f64 / self.count as f64
    }
}

/// How relative errors are spread (nearest rank: each is an error that occurs).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Percentiles {
    /// Half of the errors are at most this.
    pub p50: f64,
    /// 95 % of the errors are at most this.
    pub p95: f64,
    /// 99 % of the errors are at most this.
    pub p99: f64,
    /// The largest error.
    pub max: f64,
    /// How many errors there are.
    pub count: usize,
}

/// Differences beyond `tolerance` (≥ 0, in the unit of the images).
///
/// # Errors
/// If the images are of different shape.
pub fn absolute<T: Copy + Into<f64>>(
    image: &Image<T>,
    reference: &Image<T>,
    tolerance: f64,
) -> Result<Absolute, Incomparable> {
    let mut result = Absolute { largest: 0.0, failing: 0, count: 0 };
    for (a, b) in pairs(image, reference)? {
        let difference = difference(a, b);
        result.largest = result.largest.max(difference);
        result.failing += usize::from(difference > tolerance);
        result.count += 1;
    }
    Ok(result)
}

/// Numbers whose bits differ (so -0 differs from 0, and NaN equals only the same NaN).
///
/// # Errors
/// If the images are of different shape.
pub fn differing_bits<T: Copy + Into<f64>>(image: &Image<T>, reference: &Image<T>) -> Result<usize, Incomparable> {
    Ok(pairs(image, reference)?.filter(|(a, b)| a.to_bits() != b.to_bits()).count())
}

/// Root of the mean squared difference over the root of the mean square of the reference: √(Σ(a−b)² / Σb²).
///
/// Infinities of the reference that the image has too are left out of both sums. 0 where the images are equal, infinity
/// where the reference is black and the image is not.
///
/// # Errors
/// If the images are of different shape.
pub fn relative_rmse<T: Copy + Into<f64>>(image: &Image<T>, reference: &Image<T>) -> Result<f64, Incomparable> {
    let (mut error, mut power) = (0.0, 0.0);
    for (a, b) in pairs(image, reference)? {
        error += difference(a, b).powi(2);
        power += if b.is_finite() { b * b } else { 0.0 };
    }
    Ok(if error == 0.0 { 0.0 } else { (error / power).sqrt() })
}

/// Percentiles of |a−b| / max(|b|, `floor`).
///
/// `floor` (> 0, in the unit of the images) keeps very dark pixels from dominating; `keep`, one per pixel in the order of
/// the data, selects the pixels (without it, all).
///
/// # Errors
/// If the images are of different shape, `keep` has another number of pixels, or no pixel is left.
pub fn relative_errors<T: Copy + Into<f64>>(
    image: &Image<T>,
    reference: &Image<T>,
    floor: f64,
    keep: Option<&[bool]>,
) -> Result<Percentiles, Incomparable> {
    if keep.is_some_and(|keep| keep.len() != image.pixel_count()) {
        return Err(Incomparable("the selection and the image differ in their numbers of pixels".to_owned()));
    }
    let channels = image.channels.max(1) as usize;
    let kept = |index: usize| keep.is_none_or(|keep| keep[index / channels]);
    let errors = pairs(image, reference)?.enumerate().filter(|(index, _)| kept(*index));
    let mut errors: Vec<f64> = errors.map(|(_, (a, b))| relative(a, b, floor)).collect();
    percentiles(&mut errors).ok_or_else(|| Incomparable("no pixel is left to compare".to_owned()))
}

/// Percentiles of any errors (NaN counts as the largest); `None` if there are none. Sorts them.
pub fn percentiles(errors: &mut [f64]) -> Option<Percentiles> {
    errors.sort_by(f64::total_cmp);
    let count = errors.len();
    // Nearest rank: the smallest error that at least this part of the errors does not exceed.
    let rank = |part: f64| errors.get(((part * count as f64).ceil() as usize).clamp(1, count.max(1)) - 1).copied();
    Some(Percentiles { p50: rank(0.5)?, p95: rank(0.95)?, p99: rank(0.99)?, max: rank(1.0)?, count })
}

/// The median: the middle value, or the mean of the two in the middle; `None` if there are none. Sorts them.
pub fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => None,
        odd if odd % 2 == 1 => Some(values[middle]),
        _ => Some(0.5 * (values[middle - 1] + values[middle])),
    }
}

/// Sum of the image over the sum of the reference: 1 where they agree in total energy.
///
/// Infinities that both have are left out; other non-finite numbers give infinity. Two black images give 1.
///
/// # Errors
/// If the images are of different shape.
pub fn sum_ratio<T: Copy + Into<f64>>(image: &Image<T>, reference: &Image<T>) -> Result<f64, Incomparable> {
    let (mut sum, mut wanted) = (0.0, 0.0);
    for (a, b) in pairs(image, reference)?.filter(|(a, b)| a != b || a.is_finite()) {
        if !a.is_finite() || !b.is_finite() {
            return Ok(f64::INFINITY);
        }
        sum += a;
        wanted += b;
    }
    Ok(if sum == wanted { 1.0 } else { sum / wanted })
}

fn difference(a: f64, b: f64) -> f64 {
    let difference = (a - b).abs();
    match a == b {
        true => 0.0,
        false if difference.is_nan() => f64::INFINITY,
        false => difference,
    }
}

fn relative(a: f64, b: f64, floor: f64) -> f64 {
    let difference = difference(a, b);
    if difference.is_finite() { difference / b.abs().max(floor) } else { f64::INFINITY }
}

fn pairs<'a, T: Copy + Into<f64>>(
    image: &'a Image<T>,
    reference: &'a Image<T>,
) -> Result<impl Iterator<Item = (f64, f64)> + 'a, Incomparable> {
    same_shape(image, reference)?;
    Ok(image.data.iter().zip(&reference.data).map(|(&a, &b)| (a.into(), b.into())))
}

/// Checks that two images have the same size, layers and channels, and are not empty.
///
/// # Errors
/// If they are of different shape, or empty.
pub fn same_shape<T>(image: &Image<T>, reference: &Image<T>) -> Result<(), Incomparable> {
    let shape = |image: &Image<T>| {
        let Image { width, height, layers, channels, data } = image;
        (format!("{width}x{height}x{layers} with {channels} channels"), data.len())
    };
    let (found, wanted) = (shape(image), shape(reference));
    if found != wanted {
        return Err(Incomparable(format!("the image is {} and the reference {}", found.0, wanted.0)));
    }
    if image.data.is_empty() {
        return Err(Incomparable("the images have no pixels".to_owned()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(data: &[f32]) -> Image {
        Image::new(data.len() as u32, 1, 1, data.to_vec())
    }

    /// A ramp of 100 numbers from 1 to 100.
    fn ramp() -> Image {
        image(&(1..=100).map(|n| n as f32).collect::<Vec<_>>())
    }

    fn changed(change: impl Fn(usize, f32) -> f32) -> Image {
        image(&ramp().data.iter().enumerate().map(|(index, &value)| change(index, value)).collect::<Vec<_>>())
    }

    #[test]
    fn an_image_equals_itself() {
        let ramp = ramp();
        assert_eq!(absolute(&ramp, &ramp, 0.0).unwrap(), Absolute { largest: 0.0, failing: 0, count: 100 });
        assert_eq!(differing_bits(&ramp, &ramp).unwrap(), 0);
        assert_eq!(relative_rmse(&ramp, &ramp).unwrap(), 0.0);
        assert_eq!(relative_errors(&ramp, &ramp, 1e-6, None).unwrap().max, 0.0);
        assert_eq!(sum_ratio(&ramp, &ramp).unwrap(), 1.0);
    }

    #[test]
    fn one_wrong_pixel_is_found() {
        let wrong = changed(|index, value| if index == 41 { value + 0.5 } else { value });
        let found = absolute(&wrong, &ramp(), 0.1).unwrap();
        assert_eq!((found.failing, found.largest, found.failing_fraction()), (1, 0.5, 0.01));
        assert_eq!(differing_bits(&wrong, &ramp()).unwrap(), 1);
        assert!(relative_rmse(&wrong, &ramp()).unwrap() > 0.0);
        let errors = relative_errors(&wrong, &ramp(), 1e-6, None).unwrap();
        assert_eq!((errors.p99, errors.max), (0.0, 0.5 / 42.0));
    }

    #[test]
    fn half_the_density_fails_everywhere() {
        let half = changed(|_, value| value / 2.0);
        assert_eq!(absolute(&half, &ramp(), 0.4).unwrap().failing_fraction(), 1.0);
        assert_eq!(relative_rmse(&half, &ramp()).unwrap(), 0.5);
        assert_eq!(relative_errors(&half, &ramp(), 1e-6, None).unwrap().p50, 0.5);
        assert_eq!(sum_ratio(&half, &ramp()).unwrap(), 0.5);
    }

    #[test]
    fn a_mirrored_image_fails_although_its_sum_agrees() {
        let mirrored = image(&ramp().data.iter().rev().copied().collect::<Vec<_>>());
        assert_eq!(sum_ratio(&mirrored, &ramp()).unwrap(), 1.0);
        assert!(relative_rmse(&mirrored, &ramp()).unwrap() > 0.5);
        assert!(relative_errors(&mirrored, &ramp(), 1e-6, None).unwrap().p50 > 0.5);
        assert!(absolute(&mirrored, &ramp(), 1.0).unwrap().failing >= 98);
    }

    #[test]
    fn a_blank_image_fails() {
        let blank = changed(|_, _| 0.0);
        assert_eq!(sum_ratio(&blank, &ramp()).unwrap(), 0.0);
        assert_eq!(relative_rmse(&blank, &ramp()).unwrap(), 1.0);
        assert_eq!(relative_rmse(&ramp(), &blank).unwrap(), f64::INFINITY);
        assert_eq!(sum_ratio(&ramp(), &blank).unwrap(), f64::INFINITY);
    }

    /// A difference of one beyond 2^24 is one of whole numbers; as floats they would be equal.
    #[test]
    fn whole_numbers_are_compared_exactly() {
        let whole = |number: u32| Image::filled(2, 1, &[number]);
        let (a, b) = (whole((1 << 24) + 1), whole(1 << 24));
        assert_eq!((differing_bits(&a, &b).unwrap(), absolute(&a, &b, 0.0).unwrap().largest), (2, 1.0));
        assert_eq!(differing_bits(&a.floats(), &b.floats()).unwrap(), 0);
    }

    #[test]
    fn nan_never_passes() {
        for other in [image(&[f32::NAN, 1.0]), image(&[1.0, 1.0]), image(&[f32::INFINITY, 1.0])] {
            let nan = image(&[f32::NAN, 1.0]);
            assert_eq!(absolute(&nan, &other, f64::MAX).unwrap().failing, 1);
            assert_eq!(relative_rmse(&nan, &other).unwrap(), f64::INFINITY);
            assert_eq!(relative_errors(&nan, &other, 1e-6, None).unwrap().max, f64::INFINITY);
            assert_eq!(sum_ratio(&nan, &other).unwrap(), f64::INFINITY);
        }
    }

    #[test]
    fn equal_infinities_agree_and_others_do_not() {
        let sky = image(&[f32::INFINITY, 2.0]);
        assert_eq!(relative_errors(&sky, &sky, 1e-6, None).unwrap().max, 0.0);
        assert_eq!((relative_rmse(&sky, &sky).unwrap(), sum_ratio(&sky, &sky).unwrap()), (0.0, 1.0));
        let ground = image(&[5.0, 2.0]);
        assert_eq!(relative_errors(&ground, &sky, 1e-6, None).unwrap().max, f64::INFINITY);
        assert_eq!(relative_errors(&sky, &ground, 1e-6, None).unwrap().max, f64::INFINITY);
        assert_eq!(relative_rmse(&ground, &sky).unwrap(), f64::INFINITY);
    }

    #[test]
    fn the_selection_and_the_floor_are_used() {
        let wrong = changed(|index, value| if index == 0 { 1.1 } else { value });
        let keep: Vec<bool> = (0..100).map(|index| index != 0).collect();
        assert_eq!(relative_errors(&wrong, &ramp(), 1e-6, Some(&keep)).unwrap().max, 0.0);
        assert!(relative_errors(&wrong, &ramp(), 1e-6, None).unwrap().max > 0.09);
        assert!(relative_errors(&wrong, &ramp(), 10.0, None).unwrap().max < 0.011);
    }

    #[test]
    fn nothing_to_compare_is_an_error() {
        assert!(absolute(&ramp(), &image(&[1.0]), 0.0).is_err());
        assert!(relative_errors(&ramp(), &ramp(), 1e-6, Some(&[false; 100])).is_err());
        assert!(relative_errors(&ramp(), &ramp(), 1e-6, Some(&[true; 99])).is_err());
        let empty = Image::<f32> { width: 0, height: 0, layers: 1, channels: 1, data: vec![] };
        assert!(sum_ratio(&empty, &empty).is_err());
        assert_eq!(percentiles(&mut []), None);
    }

    #[test]
    fn percentiles_are_nearest_ranks() {
        let mut errors: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        let found = percentiles(&mut errors).unwrap();
        assert_eq!((found.p50, found.p95, found.p99, found.max), (50.0, 95.0, 99.0, 100.0));
        assert_eq!(percentiles(&mut [3.0]).unwrap().p50, 3.0);
    }

    #[test]
    fn medians() {
        assert_eq!(median(&mut []), None);
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), Some(2.5));
    }
}
