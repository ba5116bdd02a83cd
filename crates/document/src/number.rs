//! Numbers, as the `ron` crate reads them.

use crate::Number;

/// Reads a whole token that begins with a digit, a sign or a point. The error says what is wrong with it.
pub(crate) fn read(token: &str) -> Result<Number, &'static str> {
    if let Some(number) = read_plain(token) {
        return Ok(number);
    }
    let (negative, rest) = match token.as_bytes()[0] {
        b'-' => (true, &token[1..]),
        b'+' => (false, &token[1..]),
        _ => (false, token),
    };
    if let Some(number) = read_literal(rest) {
        return Ok(float(if negative { -number } else { number }));
    }
    let radix = [("0x", 16), ("0o", 8), ("0b", 2)].into_iter().find(|(prefix, _)| rest.starts_with(prefix));
    if let Some((_, radix)) = radix {
        let (digits, suffix) = split_suffix(&rest[2..]);
        return read_integer(negative, digits, suffix, radix);
    }
    let (digits, suffix) = split_suffix(rest);
    if digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_') {
        return match read_integer(negative, digits, suffix, 10) {
            // Too large for an integer: a float, unless its suffix insists.
            Err(OUT_OF_RANGE) if suffix.is_empty() => read_float(token),
            Err(_) if matches!(suffix, "f32" | "f64") => read_float(token),
            result => result,
        };
    }
    if suffix.starts_with(['i', 'u']) {
        return Err("an integer cannot have a point or an exponent");
    }
    read_float(token)
}

const OUT_OF_RANGE: &str = "the integer does not fit its type";

/// The common case in few instructions: digits with at most one point among them.
fn read_plain(token: &str) -> Option<Number> {
    let mut integer: i64 = 0;
    let mut point = false;
    if token.len() > 18 {
        return None;
    }
    for byte in token.bytes() {
        match byte {
            b'0'..=b'9' => integer = integer * 10 + i64::from(byte - b'0'),
            b'.' if !point => point = true,
            _ => return None,
        }
    }
    if point {
        return token.parse().ok().map(float);
    }
    Some(Number { value: integer as f64, integer: Some(integer) })
}

fn float(value: f64) -> Number {
    Number { value, integer: None }
}

/// The value of a name like `inf` or `NaNf64`, without its sign.
pub(crate) fn read_literal(name: &str) -> Option<f64> {
    match name {
        "inf" | "inff32" | "inff64" => Some(f64::INFINITY),
        "NaN" | "NaNf32" | "NaNf64" => Some(f64::NAN),
        _ => None,
    }
}

/// Splits a type (`u8`, `f32`) off the end.
fn split_suffix(text: &str) -> (&str, &str) {
    const SUFFIXES: [&str; 10] = ["i8", "i16", "i32", "i64", "u8", "u16", "u32", "u64", "f32", "f64"];
    let suffix = SUFFIXES.into_iter().find(|suffix| text.ends_with(suffix)).unwrap_or("");
    text.split_at(text.len() - suffix.len())
}

fn read_integer(negative: bool, digits: &str, suffix: &str, radix: u32) -> Result<Number, &'static str> {
    // In hexadecimal, `f32` is three digits.
    let float_suffix = matches!(suffix, "f32" | "f64");
    let (first, second) = if radix == 16 && float_suffix { (digits, suffix) } else { (digits, "") };
    if float_suffix && radix != 16 {
        return Err("a number in this base cannot have a float type");
    }
    if first.is_empty() && second.is_empty() {
        return Err("it has no digits");
    }
    if first.starts_with('_') {
        return Err("an underscore cannot precede the first digit");
    }
    let mut value: i128 = 0;
    for byte in first.bytes().chain(second.bytes()).filter(|byte| *byte != b'_') {
        let digit = char::from(byte).to_digit(radix).ok_or(match radix {
            2 => "a binary digit is 0 or 1",
            8 => "an octal digit is 0 to 7",
            16 => "a hexadecimal digit is 0 to 9 or a to f",
            _ => "it has a character that is not a digit",
        })?;
        value = value * i128::from(radix) + i128::from(digit);
        if value > i128::from(u64::MAX) + 1 {
            return Err(OUT_OF_RANGE);
        }
    }
    let value = if negative { -value } else { value };
    let (least, most): (i128, i128) = match suffix {
        "i8" => (i8::MIN.into(), i8::MAX.into()),
        "i16" => (i16::MIN.into(), i16::MAX.into()),
        "i32" => (i32::MIN.into(), i32::MAX.into()),
        "i64" => (i64::MIN.into(), i64::MAX.into()),
        "u8" => (0, u8::MAX.into()),
        "u16" => (0, u16::MAX.into()),
        "u32" => (0, u32::MAX.into()),
        "u64" => (0, u64::MAX.into()),
        _ if negative => (i64::MIN.into(), 0),
        _ => (0, u64::MAX.into()),
    };
    if value < least || value > most {
        return Err(OUT_OF_RANGE);
    }
    Ok(Number { value: value as f64, integer: i64::try_from(value).ok() })
}

/// A decimal with its sign and an optional `f32` or `f64`.
fn read_float(token: &str) -> Result<Number, &'static str> {
    let (text, suffix) = split_suffix(token);
    let mut digits = String::with_capacity(text.len());
    let mut underscore_may_follow = false;
    for character in text.chars() {
        match character {
            '_' if underscore_may_follow => continue,
            '_' => return Err("an underscore must follow a digit"),
            '0'..='9' | 'e' | 'E' => underscore_may_follow = true,
            '.' => underscore_may_follow = false,
            '+' | '-' => {}
            _ => return Err("it has a character that is not a digit"),
        }
        digits.push(character);
    }
    const WRONG: &str = "its digits, point and exponent do not form a number";
    match suffix {
        "f32" => digits.parse::<f32>().map(|value| float(value.into())).map_err(|_| WRONG),
        "" | "f64" => digits.parse::<f64>().map(float).map_err(|_| WRONG),
        _ => Err("an integer cannot have a point or an exponent"),
    }
}
