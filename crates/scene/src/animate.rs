//! Values that change with the time: `Keys([(seconds, value), …])` of scene files.

use glam::DVec3;

/// A value between two keys.
pub trait Blend: Copy + PartialEq {
    /// The value on the straight way from this one to another, 0 here and 1 there.
    fn blend(self, to: Self, share: f64) -> Self;
}

impl Blend for f64 {
    fn blend(self, to: Self, share: f64) -> Self {
        self + (to - self) * share
    }
}

impl Blend for DVec3 {
    fn blend(self, to: Self, share: f64) -> Self {
        self.lerp(to, share)
    }
}

/// A constant, or keys with linear interpolation.
#[derive(Clone, Debug, PartialEq)]
pub enum Animated<T = DVec3> {
    /// The same at every time.
    Constant(T),
    /// `(seconds, value)`, at least one, times strictly ascending; constant before the first and after the last.
    Keys(Vec<(f64, T)>),
}

impl<T: Blend> Animated<T> {
    /// The value at a time in seconds.
    pub fn at(&self, time: f64) -> T {
        let keys = match self {
            Animated::Constant(value) => return *value,
            Animated::Keys(keys) => keys,
        };
        let (index, weight) = segment(keys.iter().map(|k| k.0), time);
        let (from, to) = (keys[index].1, keys[(index + 1).min(keys.len() - 1)].1);
        // The second form returns the keys' own values where the weight is 0 or 1.
        if weight == 0.0 { from } else { from.blend(to, weight) }
    }

    /// Whether the value differs between some two times.
    pub fn varies(&self) -> bool {
        match self {
            Animated::Constant(_) => false,
            Animated::Keys(keys) => keys.iter().any(|k| k.1 != keys[0].1),
        }
    }

    /// The times of the keys; of a constant, time 0 alone.
    pub(crate) fn times(&self) -> Vec<f64> {
        match self {
            Animated::Constant(_) => vec![0.0],
            Animated::Keys(keys) => keys.iter().map(|k| k.0).collect(),
        }
    }
}

/// The key at or before a time, and how far, from 0 to below 1, the time is on the way to the next one.
pub(crate) fn segment(times: impl ExactSizeIterator<Item = f64> + Clone, time: f64) -> (usize, f64) {
    let next = times.clone().take_while(|t| *t <= time).count();
    if next == 0 {
        return (0, 0.0);
    }
    let mut pair = times.skip(next - 1);
    match (pair.next(), pair.next()) {
        (Some(from), Some(to)) => (next - 1, (time - from) / (to - from)),
        _ => (next - 1, 0.0),
    }
}

/// The smallest length that a vector reaches on the straight way from `a` to `b`, relative to the longer of the two.
///
/// Zero where the way leads through the origin: a direction that is interpolated so has no value there.
pub(crate) fn least_length(a: DVec3, b: DVec3) -> f64 {
    let longer = a.length().max(b.length());
    if longer == 0.0 {
        return 0.0;
    }
    let way = (b - a) / longer;
    let start = a / longer;
    let nearest = (-start.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (start + way * nearest).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_linear_and_constant_outside() {
        let keys = Animated::Keys(vec![(1.0, DVec3::ZERO), (3.0, DVec3::X), (4.0, DVec3::Y)]);
        let at = |t| keys.at(t);
        assert_eq!((at(0.0), at(1.0), at(2.0), at(3.0)), (DVec3::ZERO, DVec3::ZERO, DVec3::X / 2.0, DVec3::X));
        assert_eq!((at(4.0), at(9.0)), (DVec3::Y, DVec3::Y));
        assert!(keys.varies() && !Animated::Keys(vec![(0.0, DVec3::X), (1.0, DVec3::X)]).varies());
    }

    #[test]
    fn a_way_through_the_origin_has_no_length() {
        assert_eq!(least_length(DVec3::Y, -DVec3::Y), 0.0);
        assert!((least_length(DVec3::Y, DVec3::X) - 0.5f64.sqrt()).abs() < 1e-12);
        assert_eq!(least_length(DVec3::Y, DVec3::Y), 1.0);
    }
}
