//! What must hold of a port without a golden.

use tyndall_image::Image;

use crate::file::Property;
use crate::metric::{Judgement, over};
use crate::picture::Picture;

/// Judges a property. `other` gives another port's picture, `computed` what the reference on the CPU says.
pub(crate) fn judge(
    property: &Property,
    picture: &Picture,
    other: &dyn Fn(&str) -> Option<Picture>,
    computed: &dyn Fn() -> Result<Picture, String>,
) -> Judgement {
    let image = picture.compared();
    let named = |port: &str| other(port).ok_or_else(|| format!("`{port}` was not rendered"));
    match property {
        Property::Finite => numbers(&image, "is infinite or NaN", |value| value.is_finite()),
        Property::NonNegative => numbers(&image, "is negative or NaN", |value| value >= 0.0),
        Property::Range(low, high) => {
            let within = |value: f64| (*low..=*high).contains(&value);
            numbers(&image, &format!("is outside {low}..{high}"), within)
        }
        Property::AlphaOne => match picture.alpha() {
            Some(alpha) => numbers(&alpha, "is an alpha other than 1", |value| value == 1.0),
            None => fails("it has no alpha"),
        },
        Property::UnitLength { within, or_zero } => vectors(&image, *within, *or_zero),
        Property::Varies => {
            let mut texels = image.data.chunks_exact(image.channels.max(1) as usize);
            let first = texels.next().unwrap_or_default();
            let differs = |(a, b): (&f64, &f64)| a != b && !a.is_nan() && !b.is_nan();
            let varies = texels.any(|texel| texel.iter().zip(first).any(differs));
            let figures = if varies { "not blank".to_owned() } else { format!("every texel is {}", shortest(first)) };
            Judgement::new(varies, figures, if varies { 0.0 } else { f64::INFINITY })
        }
        Property::AtMost { port, within } => match named(port) {
            Ok(bound) => at_most(&image, &bound.compared(), *within),
            Err(why) => fails(&why),
        },
        Property::Equal { port, by } => match named(port) {
            Ok(expected) => by.judge(picture, &expected),
            Err(why) => fails(&why),
        },
        Property::Sum { ports, by } => match sum(ports.iter().map(|port| named(port))) {
            Ok(expected) => by.judge(picture, &expected),
            Err(why) => fails(&why),
        },
        Property::Mean { value, within } => mean(&image, value, *within),
        Property::CpuReference { by } => match computed() {
            Ok(expected) => by.judge(picture, &expected),
            Err(why) => fails(&why),
        },
    }
}

/// What a property is called in messages.
pub(crate) fn name(property: &Property) -> String {
    match property {
        Property::Finite => "finite".to_owned(),
        Property::NonNegative => "non-negative".to_owned(),
        Property::Range(low, high) => format!("range {low}..{high}"),
        Property::AlphaOne => "alpha 1".to_owned(),
        Property::UnitLength { .. } => "unit length".to_owned(),
        Property::Varies => "varies".to_owned(),
        Property::AtMost { port, .. } => format!("at most `{port}`"),
        Property::Equal { port, .. } => format!("equal to `{port}`"),
        Property::Sum { ports, .. } => format!("sum of `{}`", ports.join("`, `")),
        Property::Mean { .. } => "mean".to_owned(),
        Property::CpuReference { .. } => "CPU reference".to_owned(),
    }
}

fn fails(why: &str) -> Judgement {
    Judgement::failed(why.to_owned())
}

/// Every number must do; says how many do not, and the first.
fn numbers(image: &Image<f64>, what: &str, does: impl Fn(f64) -> bool) -> Judgement {
    let wrong: Vec<usize> = (0..image.data.len()).filter(|index| !does(image.data[*index])).collect();
    let Some(first) = wrong.first() else {
        return Judgement::new(!image.data.is_empty(), "every number".to_owned(), 0.0);
    };
    let texel = first / image.channels.max(1) as usize;
    let (x, y) = (texel % image.width.max(1) as usize, texel / image.width.max(1) as usize);
    let (count, all, value) = (wrong.len(), image.data.len(), shortest(&image.data[*first..=*first]));
    fails(&format!("{count} of {all} numbers fail: at {x},{y} {value} {what}"))
}

/// Numbers with as few digits as tell them from other 32-bit floats, where they are such.
fn shortest(numbers: &[f64]) -> String {
    let number = |number: &f64| match *number as f32 {
        float if f64::from(float) == *number => format!("{float:?}"),
        _ => format!("{number:?}"),
    };
    numbers.iter().map(number).collect::<Vec<_>>().join(", ")
}

fn vectors(image: &Image<f64>, within: f64, or_zero: bool) -> Judgement {
    let length = |vector: &[f64]| vector.iter().map(|value| value.powi(2)).sum::<f64>().sqrt();
    let lengths =
        image.data.chunks_exact(image.channels as usize).map(length).filter(|length| !(or_zero && *length == 0.0));
    let worst = lengths
        .map(|length| (length - 1.0).abs())
        .fold(0.0, |a: f64, b| if b.is_nan() { f64::INFINITY } else { a.max(b) });
    let figures = format!("lengths are up to {worst:.2e} from 1, at most {within:e}");
    Judgement::new(worst <= within, figures, over(worst, within))
}

/// No number is more than the bound, but by this part of it.
pub(crate) fn at_most(image: &Image<f64>, bound: &Image<f64>, within: f64) -> Judgement {
    if (image.width, image.height, image.layers, image.channels)
        != (bound.width, bound.height, bound.layers, bound.channels)
    {
        return fails("the pictures are of different size");
    }
    let more = |(&value, &bound): (&f64, &f64)| {
        let more = if value == bound || bound == f64::INFINITY && !value.is_nan() {
            0.0
        } else {
            (value - bound) / bound.abs().max(f64::MIN_POSITIVE)
        };
        if more.is_nan() { f64::INFINITY } else { more }
    };
    let worst = image.data.iter().zip(&bound.data).map(more).fold(f64::NEG_INFINITY, f64::max);
    let figures = format!("more by up to {:.2e} of it, at most {within:e}", worst.max(0.0));
    Judgement::new(worst <= within, figures, over(worst.max(0.0), within))
}

/// The sum of pictures, alpha kept.
pub(crate) fn sum(parts: impl Iterator<Item = Result<Picture, String>>) -> Result<Picture, String> {
    let mut total: Option<Picture> = None;
    for part in parts {
        let part = part?;
        let Some(total) = &mut total else {
            total = Some(part);
            continue;
        };
        if total.image.data.len() != part.image.data.len() {
            return Err("the parts are of different size".to_owned());
        }
        let alpha = total.alpha().map(|_| 3);
        let channels = total.image.channels as usize;
        for (index, (sum, value)) in total.image.data.iter_mut().zip(&part.image.data).enumerate() {
            if alpha != Some(index % channels) {
                *sum += value;
            }
        }
    }
    total.ok_or_else(|| "there is nothing to add".to_owned())
}

fn mean(image: &Image<f64>, value: &[f64], within: f64) -> Judgement {
    let channels = image.channels as usize;
    if value.len() != 1 && value.len() != channels {
        return fails(&format!("the mean of {channels} channels is asked for as {} numbers", value.len()));
    }
    let count = (image.data.len() / channels.max(1)).max(1) as f64;
    let means = (0..channels).map(|channel| image.data.iter().skip(channel).step_by(channels).sum::<f64>() / count);
    let means: Vec<f64> = means.collect();
    let wanted = |channel: usize| value[if value.len() == 1 { 0 } else { channel }];
    let off =
        |(channel, mean): (usize, &f64)| (mean - wanted(channel)).abs() / wanted(channel).abs().max(f64::MIN_POSITIVE);
    let worst =
        means.iter().enumerate().map(off).fold(0.0, |a: f64, b| if b.is_nan() { f64::INFINITY } else { a.max(b) });
    let figures = format!("the mean is {means:?}, wanted {value:?} within {within:e} of it");
    Judgement::new(worst <= within, figures, over(worst, within))
}

#[cfg(test)]
mod tests {
    use tyndall_graph::descriptor::Class;

    use super::*;
    use crate::metric::Metric;

    fn picture(class: Class, data: &[f32]) -> Picture {
        Picture::new(Image::new(data.len() as u32 / 4, 1, 4, data.to_vec()), class)
    }

    fn holds(property: &Property, class: Class, data: &[f32], other: &[f32]) -> bool {
        let other = |_: &str| Some(picture(class, other));
        let computed = || Ok(picture(class, data));
        judge(property, &picture(class, data), &other, &computed).passed
    }

    /// Each property with numbers of which it holds and numbers of which it does not.
    #[test]
    fn each_property_can_fail() {
        let port = || "other.port".to_owned();
        let by = Metric::RelativeRmse { tolerance: 1e-3 };
        let base = [0.5, 0.25, 0.5, 1.0, 0.25, 0.5, 0.0, 1.0];
        let color = [
            (Property::Finite, [f32::INFINITY, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
            (Property::NonNegative, [0.0, -1e-9, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
            (Property::NonNegative, [0.0, f32::NAN, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
            (Property::Range(0.0, 0.5), [0.6, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
            (Property::AlphaOne, [0.0, 0.0, 0.0, 0.99, 0.0, 0.0, 0.0, 1.0]),
            (Property::Varies, [0.5, 0.5, 0.5, 1.0, 0.5, 0.5, 0.5, 1.0]),
            (Property::AtMost { port: port(), within: 0.0 }, [0.5, 0.3, 0.5, 1.0, 0.2, 0.2, 0.0, 1.0]),
            (Property::Equal { port: port(), by }, [0.5, 0.3, 0.5, 1.0, 0.25, 0.5, 0.0, 1.0]),
            (
                Property::Mean { value: vec![0.375, 0.375, 0.25], within: 1e-6 },
                [0.5, 0.3, 0.5, 1.0, 0.25, 0.5, 0.0, 1.0],
            ),
        ];
        for (property, wrong) in color {
            assert!(holds(&property, Class::Color, &base, &base), "{property:?}");
            assert!(!holds(&property, Class::Color, &wrong, &base), "{property:?}");
        }
        let nothing = [f32::NAN, f32::NAN, f32::NAN, 1.0, f32::NAN, f32::NAN, f32::NAN, 1.0];
        assert!(!holds(&Property::Varies, Class::Color, &nothing, &base));
        let endless = [f32::INFINITY, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        assert!(holds(&Property::AtMost { port: port(), within: 0.0 }, Class::Color, &base, &endless));
        let sum = Property::Sum { ports: vec![port(), port()], by };
        let twice = base.map(|value| if value == 1.0 { 1.0 } else { 2.0 * value });
        assert!(holds(&sum, Class::Color, &twice, &base) && !holds(&sum, Class::Color, &base, &base));
        let unit = |or_zero| Property::UnitLength { within: 1e-4, or_zero };
        assert!(holds(&unit(true), Class::Vector, &[0.6, 0.8, 0.0, 7.0, 0.0, 0.0, 0.0, 1.0], &base));
        assert!(!holds(&unit(false), Class::Vector, &[0.6, 0.8, 0.0, 7.0, 0.0, 0.0, 0.0, 1.0], &base));
        assert!(!holds(&unit(true), Class::Vector, &[0.6, 0.9, 0.0, 7.0, 0.0, 0.0, 0.0, 1.0], &base));
        assert!(!holds(&unit(true), Class::Vector, &[f32::NAN, 0.9, 0.0, 7.0, 0.0, 0.0, 0.0, 1.0], &base));
    }

    #[test]
    fn a_reference_that_says_something_else_or_nothing_fails() {
        let property = Property::CpuReference { by: Metric::RelativeRmse { tolerance: 1e-3 } };
        let actual = picture(Class::Color, &[0.5, 0.5, 0.5, 1.0]);
        let half = || Ok(picture(Class::Color, &[0.25, 0.25, 0.25, 1.0]));
        assert!(!judge(&property, &actual, &|_| None, &half).passed);
        assert!(!judge(&property, &actual, &|_| None, &|| Err("it cannot say".to_owned())).passed);
        assert!(judge(&property, &actual, &|_| None, &|| Ok(actual.clone())).passed);
    }
}
