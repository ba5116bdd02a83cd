//! How ports change from run to run.

use tyndall_image::Image;

use crate::file::Change;
use crate::metric::{Judgement, Metric};
use crate::picture::Picture;
use crate::property::{at_most, sum};

/// Judges a change from the test's own run to the other runs. `computed` gives what the reference on the CPU says of one
/// of these.
pub(crate) fn judge(
    change: Change,
    own: &Picture,
    others: &[Picture],
    computed: &dyn Fn(usize) -> Result<Picture, String>,
) -> Judgement {
    let each = |judge: &dyn Fn(&Picture) -> Judgement| worst(others.iter().map(judge));
    match change {
        Change::Same(by) => each(&|other| by.judge(other, own)),
        Change::Scaled(factor, by) => {
            let expected = scaled(own, factor);
            each(&|other| by.judge(other, &expected))
        }
        Change::Shifted(x, y, by) => each(&|other| match (cut(other, x, y), cut(own, -x, -y)) {
            (Some(other), Some(own)) => by.judge(&other, &own),
            _ => fails("nothing is left of a picture that is shifted so far"),
        }),
        Change::SumOfRuns(by) => match sum(others.iter().cloned().map(Ok)) {
            Ok(total) => by.judge(own, &total),
            Err(why) => fails(&why),
        },
        Change::NoMore(within) => each(&|other| at_most(&other.compared(), &own.compared(), within)),
        Change::NoLess(within) => each(&|other| at_most(&own.compared(), &other.compared(), within)),
        Change::CpuReference(by) => worst(others.iter().enumerate().map(|(run, other)| match computed(run) {
            Ok(expected) => by.judge(other, &expected),
            Err(why) => fails(&why),
        })),
        Change::Differs(least) => each(&|other| {
            // The cap on how loose a metric may be does not limit how much must differ: only the measurement counts here.
            let comparable = |picture: &Picture| picture.compared().data.iter().all(|value| value.is_finite());
            if !(comparable(other) && comparable(own)) || other.compared().data.len() != own.compared().data.len() {
                return fails("NaN or another size does not count as a difference");
            }
            let found = Metric::RelativeRmse { tolerance: least }.judge(other, own);
            Judgement::new(!found.passed, format!("must differ by more: {}", found.figures), 1.0 / found.excess)
        }),
    }
}

fn fails(why: &str) -> Judgement {
    Judgement::failed(why.to_owned())
}

/// The worst of several; none at all fails.
fn worst(judgements: impl Iterator<Item = Judgement>) -> Judgement {
    let key = |judgement: &Judgement| (!judgement.passed, judgement.excess);
    let worse = |a: Judgement, b: Judgement| if key(&b) > key(&a) { b } else { a };
    judgements.reduce(worse).unwrap_or_else(|| fails("there is no other run"))
}

fn scaled(picture: &Picture, factor: f64) -> Picture {
    let mut scaled = picture.clone();
    let (alpha, channels) = (picture.alpha().is_some(), picture.image.channels as usize);
    for (index, value) in scaled.image.data.iter_mut().enumerate() {
        if !(alpha && index % channels == 3) {
            *value *= factor;
        }
    }
    scaled
}

/// What is left of a picture of one layer without the columns and rows that a shift by (x, y) brings in: those on the
/// left and top for a shift to the right and down.
fn cut(picture: &Picture, x: i32, y: i32) -> Option<Picture> {
    let image = &picture.image;
    let width = image.width.checked_sub(x.unsigned_abs()).filter(|width| *width > 0)?;
    let height = image.height.checked_sub(y.unsigned_abs()).filter(|height| *height > 0)?;
    let (left, top) = (x.max(0) as u32, y.max(0) as u32);
    let mut data = Vec::with_capacity((width * height * image.layers * image.channels) as usize);
    for layer in 0..image.layers {
        for row in top..top + height {
            for column in left..left + width {
                data.extend_from_slice(image.pixel_in_layer(layer, column, row)?);
            }
        }
    }
    Some(Picture::new(Image { width, height, data, ..*image }, picture.class))
}

#[cfg(test)]
mod tests {
    use tyndall_graph::descriptor::Class;

    use super::{Change, Image, Judgement, Metric, Picture, scaled};

    fn judge(change: Change, own: &Picture, others: &[Picture]) -> Judgement {
        super::judge(change, own, others, &|_| Ok(own.clone()))
    }

    const BY: Metric = Metric::RelativeRmse { tolerance: 1e-3 };

    fn picture(value: impl Fn(u32, u32) -> f32) -> Picture {
        let texels = (0..8).flat_map(|y| (0..8).map(move |x| (x, y)));
        Picture::new(
            Image::new(8, 8, 4, texels.flat_map(|(x, y)| [value(x, y), 0.1, 0.2, 1.0]).collect()),
            Class::Color,
        )
    }

    /// Each change with another run that shows it and one that does not.
    #[test]
    fn each_change_can_fail() {
        let own = picture(|x, y| (1 + x + 8 * y) as f32);
        let zero = picture(|_, _| 0.0);
        let twice = scaled(&own, 2.0);
        let cases = [
            (Change::Same(BY), own.clone(), twice.clone()),
            (Change::Scaled(2.0, BY), twice.clone(), own.clone()),
            (Change::SumOfRuns(BY), own.clone(), twice.clone()),
            (Change::NoMore(0.0), own.clone(), twice.clone()),
            (Change::NoLess(0.0), twice.clone(), zero),
            (Change::Differs(0.1), twice.clone(), own.clone()),
            (Change::CpuReference(BY), own.clone(), twice),
        ];
        for (change, right, wrong) in cases {
            assert!(judge(change, &own, &[right]).passed, "{change:?}");
            assert!(!judge(change, &own, &[wrong]).passed, "{change:?}");
            assert!(!judge(change, &own, &[]).passed, "{change:?}");
        }
    }

    #[test]
    fn numbers_that_are_none_are_no_difference() {
        let (own, nothing) = (picture(|x, _| x as f32), picture(|_, _| f32::NAN));
        assert!(!judge(Change::Differs(0.1), &own, std::slice::from_ref(&nothing)).passed);
        assert!(!judge(Change::Differs(0.1), &nothing, &[own]).passed);
    }

    #[test]
    fn a_shift_is_to_the_right_and_down() {
        let own = picture(|x, y| (1 + x + 8 * y) as f32);
        let shifted = picture(|x, y| if x >= 2 && y >= 1 { (1 + x - 2 + 8 * (y - 1)) as f32 } else { 99.0 });
        assert!(judge(Change::Shifted(2, 1, BY), &own, std::slice::from_ref(&shifted)).passed);
        assert!(judge(Change::Shifted(-2, -1, BY), &shifted, std::slice::from_ref(&own)).passed);
        assert!(!judge(Change::Shifted(1, 1, BY), &own, std::slice::from_ref(&shifted)).passed);
        assert!(!judge(Change::Shifted(8, 0, BY), &own, &[shifted]).passed);
    }

    #[test]
    fn the_worst_of_several_runs_counts() {
        let own = picture(|x, _| x as f32);
        assert!(!judge(Change::Same(BY), &own, &[own.clone(), scaled(&own, 2.0), own.clone()]).passed);
    }
}
