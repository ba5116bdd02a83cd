//! Numbers, vectors and keys with the ranges that they have.

use glam::DVec3;
use tyndall_document::{Decoder, Diagnostic, Node, OUT_OF_RANGE, Value};
use tyndall_shaders::phase::Interval;

use crate::animate::{Animated, Blend, least_length};
use crate::codes::{CONSTANT_ONLY, EMPTY_KEYS, UNSORTED_KEYS, ZERO_DIRECTION};

/// A way between two directions that comes this near to 0, relative to their length, passes through it.
const NO_LENGTH: f64 = 1e-9;

/// Lengths and coordinates, m, are at most this: squares of it, and their products with what a pass has beside them, are still
/// finite in single precision.
pub const FARTHEST: f64 = 1e12;

/// A coordinate, m.
pub const COORDINATE: Range = Range::Within(-FARTHEST, FARTHEST);

/// A length that is not 0, m.
pub const LENGTH: Range = Range::UpTo(FARTHEST);

/// Radiance, irradiance and intensity: what is made of them stays finite in single precision.
pub const POWER: Range = Range::NotAbove(1e20);

/// An extinction, 1/m: nothing is seen through a millionth of a millionth of a metre of more.
pub const EXTINCTION: Range = Range::NotAbove(1e12);

/// Which numbers are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// All that fit single precision.
    Any,
    /// 0 or more.
    NotNegative,
    /// Above 0.
    Positive,
    /// Above or below 0.
    NotZero,
    /// 0 to 1, both included.
    Unit,
    /// Between the two, both excluded.
    Between(f64, f64),
    /// Between the two, both included.
    Within(f64, f64),
    /// Above 0, up to a value that is included.
    UpTo(f64),
    /// 0 or more, up to a value that is included.
    NotAbove(f64),
}

impl From<Interval> for Range {
    fn from(interval: Interval) -> Self {
        match interval {
            Interval::Open(low, high) => Range::Between(low, high),
            Interval::Closed(low, high) => Range::Within(low, high),
        }
    }
}

impl Range {
    fn holds(self, value: f64) -> bool {
        match self {
            Range::Any => true,
            Range::NotNegative => value >= 0.0,
            // What becomes 0 in single precision is 0 for a shader.
            Range::Positive => value as f32 > 0.0,
            Range::NotZero => value as f32 != 0.0,
            Range::Unit => (0.0..=1.0).contains(&value),
            Range::Between(low, high) => value > low && value < high,
            Range::Within(low, high) => (low..=high).contains(&value),
            Range::UpTo(high) => value as f32 > 0.0 && value <= high,
            Range::NotAbove(high) => (0.0..=high).contains(&value),
        }
    }

    fn text(self, value: f64) -> String {
        match self {
            Range::Any => "fit single precision".to_owned(),
            Range::NotNegative => "be 0 or more".to_owned(),
            Range::Positive => "be above 0".to_owned(),
            Range::NotZero => "be above or below 0".to_owned(),
            Range::Unit => "lie in 0..1".to_owned(),
            Range::Between(low, high) => format!("lie between {low} and {high}, both excluded"),
            Range::Within(low, high) => format!("lie in {}..{}", shown(low), shown(high)),
            Range::UpTo(_) if value as f32 <= 0.0 => "be above 0".to_owned(),
            Range::UpTo(high) => format!("be at most {}", shown(high)),
            Range::NotAbove(_) if value < 0.0 => "be 0 or more".to_owned(),
            Range::NotAbove(high) => format!("be at most {}", shown(high)),
        }
    }
}

/// A number as people write it. Digits beyond 16 would be noise.
fn shown(value: f64) -> String {
    let extreme = value != 0.0 && !(1e-6..1e9).contains(&value.abs());
    if extreme { format!("{value:e}") } else { value.to_string() }
}

/// A number of a range; `name` is the field's name for messages.
pub fn number(decoder: &mut Decoder, node: &Node, name: &str, range: Range) -> Option<f64> {
    let value = decoder.float(node)?;
    let fits = (value as f32).is_finite();
    if fits && range.holds(value) {
        return Some(value);
    }
    let must = if fits { range } else { Range::Any };
    let message = format!("`{name}` is {}; it must {}", shown(value), must.text(value));
    decoder.report(Diagnostic::error(OUT_OF_RANGE, decoder.place(node.span), message));
    None
}

/// Numbers of a range in a tuple; each mistake is reported at its number.
pub fn numbers<const N: usize>(decoder: &mut Decoder, node: &Node, name: &str, range: Range) -> Option<[f64; N]> {
    if let Value::Variant { name: variant, .. } = &node.value
        && variant == "Keys"
    {
        let message = format!("`{name}` is the same at every time and takes no `Keys`");
        let hint = "translation, position, look_at, direction and intensity may have keys";
        decoder.report(Diagnostic::error(CONSTANT_ONLY, decoder.place(node.span), message).suggest(hint));
        return None;
    }
    let values = decoder.floats::<N>(node)?;
    let Value::Tuple(items) = &node.value else { return None };
    let checked: Vec<Option<f64>> = items.iter().map(|item| number(decoder, item, name, range)).collect();
    checked.iter().all(Option::is_some).then_some(values)
}

/// Three numbers of a range.
pub fn vector(decoder: &mut Decoder, node: &Node, name: &str, range: Range) -> Option<DVec3> {
    numbers::<3>(decoder, node, name, range).map(DVec3::from_array)
}

/// Three numbers that are not all 0.
pub fn direction(decoder: &mut Decoder, node: &Node, name: &str) -> Option<DVec3> {
    let value = vector(decoder, node, name, Range::Any)?;
    // Single precision: a direction that becomes 0 there has no length for a shader, but is normalised before.
    if value.length() > 0.0 && value.length().is_finite() {
        return Some(value);
    }
    let message = format!("`{name}` has length 0");
    decoder.report(Diagnostic::error(ZERO_DIRECTION, decoder.place(node.span), message));
    None
}

/// A place, m, or keys of such.
pub fn animated_place(decoder: &mut Decoder, node: &Node, name: &str) -> Option<Animated> {
    keys(decoder, node, name, |d, n, name| vector(d, n, name, COORDINATE))
}

/// A vector without negative components, or keys of such.
pub fn animated_power(decoder: &mut Decoder, node: &Node, name: &str) -> Option<Animated> {
    keys(decoder, node, name, |d, n, name| vector(d, n, name, POWER))
}

/// A vector that has a length at all times, or keys of such.
pub fn animated_direction(decoder: &mut Decoder, node: &Node, name: &str) -> Option<Animated> {
    let animated = keys(decoder, node, name, direction)?;
    if let Animated::Keys(keys) = &animated
        && let Some(pair) = keys.windows(2).find(|k| least_length(k[0].1, k[1].1) < NO_LENGTH)
    {
        let message = format!("`{name}` passes through length 0 between {} s and {} s", pair[0].0, pair[1].0);
        let diagnostic = Diagnostic::error(ZERO_DIRECTION, decoder.place(node.span), message);
        decoder.report(diagnostic.suggest("give a key between the two that leads around the origin"));
        return None;
    }
    Some(animated)
}

/// A number of a range, or keys of such.
pub fn animated_number(decoder: &mut Decoder, node: &Node, name: &str, range: Range) -> Option<Animated<f64>> {
    keys(decoder, node, name, |d, n, name| number(d, n, name, range))
}

/// A value, or `Keys([(seconds, value), …])`.
pub fn keys<T: Blend>(
    decoder: &mut Decoder,
    node: &Node,
    name: &str,
    read: impl Fn(&mut Decoder, &Node, &str) -> Option<T>,
) -> Option<Animated<T>> {
    let content = match &node.value {
        Value::Variant { name: variant, content, .. } if variant == "Keys" => content.as_deref(),
        _ => return read(decoder, node, name).map(Animated::Constant),
    };
    let list = match content.map(|c| &c.value) {
        Some(Value::Tuple(items)) if items.len() == 1 => &items[0],
        _ => {
            decoder.wrong_type(content.unwrap_or(node), "`Keys([(seconds, value), …])`");
            return None;
        }
    };
    let items = decoder.list(list)?;
    if items.is_empty() {
        let message = format!("`{name}` has no keys");
        decoder.report(Diagnostic::error(EMPTY_KEYS, decoder.place(list.span), message));
        return None;
    }
    let keys: Vec<Option<(f64, T)>> = items.iter().map(|item| key(decoder, item, name, &read)).collect();
    let keys: Vec<(f64, T)> = keys.into_iter().collect::<Option<_>>()?;
    if let Some(at) = keys.windows(2).position(|pair| pair[1].0 <= pair[0].0) {
        let message = format!("the key at {} s follows the key at {} s; times must ascend", keys[at + 1].0, keys[at].0);
        decoder.report(Diagnostic::error(UNSORTED_KEYS, decoder.place(items[at + 1].span), message));
        return None;
    }
    Some(Animated::Keys(keys))
}

fn key<T>(
    decoder: &mut Decoder,
    node: &Node,
    name: &str,
    read: &impl Fn(&mut Decoder, &Node, &str) -> Option<T>,
) -> Option<(f64, T)> {
    match &node.value {
        Value::Tuple(pair) if pair.len() == 2 => {
            let time = decoder.float(&pair[0]);
            let value = read(decoder, &pair[1], name);
            time.zip(value)
        }
        _ => {
            decoder.wrong_type(node, "a key `(seconds, value)`");
            None
        }
    }
}
