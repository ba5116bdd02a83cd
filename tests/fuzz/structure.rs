//! Breaks RON, JSON and WGSL by their structure: values, entries and names change places, within a file and between files.

use std::ops::Range;

use tyndall_tests::broken::{Random, mutate};

/// Instead of a number.
const ODD_NUMBERS: [&str; 17] = [
    "0",
    "-1",
    "1",
    "0.0",
    "-0.0",
    "0.5",
    "1e-45",
    "1e-10",
    "1e10",
    "3.4028235e38",
    "1e39",
    "1e308",
    "inf",
    "NaN",
    "4294967295",
    "4294967296",
    "18446744073709551616",
];
/// Instead of any other value.
const ODD_VALUES: [&str; 9] = [
    "\"\"",
    "\"$frame\"",
    "\"../x\"",
    "()",
    "[]",
    "{}",
    "true",
    "(0.0, 0.0, 0.0)",
    "Keys([(0.0, (1.0, 2.0, 3.0)), (1.0, (3.0, 2.0, 1.0))])",
];
/// What surrounds a value.
const WRAPS: [(&str, &str); 6] =
    [("(", ")"), ("[", "]"), ("Some(", ")"), ("Keys([(0.0, ", ")])"), ("{\"a\": ", "}"), ("\"", "\"")];

/// The parts of a text.
#[derive(Default)]
struct Parts {
    /// Atoms, strings, and brackets with what is between them and the name before them.
    values: Vec<Range<usize>>,
    /// Each with the comma behind it.
    entries: Vec<Range<usize>>,
    /// Before a colon.
    keys: Vec<Range<usize>>,
}

/// Breaks a text in one place, or in up to three; another text of its kind gives parts.
pub fn broken(random: &mut Random, text: &[u8], donor: &[u8]) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..1 + random.below(2) * random.below(3) {
        text = once(random, &text, donor);
    }
    text
}

fn once(random: &mut Random, text: &[u8], donor: &[u8]) -> Vec<u8> {
    let (parts, given) = (Parts::of(text), Parts::of(donor));
    let (value, entry, key) = (pick(random, &parts.values), pick(random, &parts.entries), pick(random, &parts.keys));
    let [like_value, like_entry, like_key] = [(&given.values, &value), (&given.entries, &entry), (&given.keys, &key)]
        .map(|(from, part)| {
            let like: Vec<_> = from
                .iter()
                .filter(|given| form(&donor[(*given).clone()]) == form(&text[part.clone()]))
                .cloned()
                .collect();
            pick(random, if like.is_empty() { from } else { &like })
        });
    let own: Vec<_> =
        parts.values.iter().filter(|own| form(&text[(*own).clone()]) == form(&text[value.clone()])).cloned().collect();
    match random.below(12) {
        0 => replaced(text, entry, b""),
        1 => inserted(text, entry.start, &text[entry]),
        2 | 3 => replaced(text, value, &donor[like_value]),
        4 | 5 => replaced(text, value, &text[pick(random, &own)]),
        6 | 7 if form(&text[value.clone()]) == b'0' => replaced(text, value, random.of(&ODD_NUMBERS).as_bytes()),
        6 => replaced(text, value, random.of(&ODD_VALUES).as_bytes()),
        7 => {
            let (before, after) = WRAPS[random.below(WRAPS.len())];
            replaced(text, value.clone(), &[before.as_bytes(), &text[value], after.as_bytes()].concat())
        }
        8 => replaced(text, key, &donor[like_key]),
        9 | 10 => inserted(text, entry.start, &donor[like_entry]),
        _ => mutate(random, text),
    }
}

/// What a part looks like: parts of one form can change places, and still be read.
fn form(part: &[u8]) -> u8 {
    let part = part.trim_ascii_start();
    let is_key = |at: Option<usize>| {
        at.is_some_and(|at| part[..at].iter().all(|byte| byte.is_ascii_alphanumeric() || b"_ \"".contains(byte)))
    };
    let named = is_key(part.iter().position(|byte| *byte == b':'));
    match part.first() {
        Some(b'0'..=b'9' | b'-' | b'+') => b'0',
        Some(b'"') if named => b'k',
        Some(first) if first.is_ascii_alphabetic() => match (named, part.contains(&b'(')) {
            (true, _) => b'n',
            (false, true) => b'V',
            (false, false) => b'v',
        },
        Some(first) => *first,
        None => 0,
    }
}

fn pick(random: &mut Random, parts: &[Range<usize>]) -> Range<usize> {
    if parts.is_empty() { 0..0 } else { parts[random.below(parts.len())].clone() }
}

fn replaced(text: &[u8], part: Range<usize>, by: &[u8]) -> Vec<u8> {
    [&text[..part.start], by, &text[part.end..]].concat()
}

fn inserted(text: &[u8], at: usize, part: &[u8]) -> Vec<u8> {
    replaced(text, at..at, part)
}

impl Parts {
    /// Of any text: brackets that do not match are taken as they come.
    fn of(text: &[u8]) -> Self {
        let mut parts = Self::default();
        // where each open bracket's value begins, and the entry in it
        let mut open: Vec<[usize; 2]> = Vec::new();
        let (mut at, mut entry, mut atom) = (0, 0, None::<Range<usize>>);
        while at < text.len() {
            let end = token(text, at);
            match text[at] {
                b'(' | b'[' | b'{' => {
                    // the name of a variant stands directly before it
                    let named = atom.take().filter(|atom| atom.end == at);
                    open.push([named.map_or(at, |atom| atom.start), entry]);
                    entry = end;
                }
                b')' | b']' | b'}' => {
                    if let Some([start, before]) = open.pop() {
                        parts.values.push(start..end);
                        entry = before;
                    }
                }
                b',' => {
                    parts.entry(entry..end);
                    entry = end;
                }
                b':' => parts.keys.extend(atom.take()),
                byte if byte.is_ascii_whitespace()
                    || text[at..].starts_with(b"//")
                    || text[at..].starts_with(b"/*") => {}
                _ => {
                    parts.values.push(at..end);
                    atom = Some(at..end);
                }
            }
            at = end;
        }
        parts
    }

    fn entry(&mut self, part: Range<usize>) {
        if !part.is_empty() {
            self.entries.push(part);
        }
    }
}

/// Where the token that begins here ends.
fn token(text: &[u8], at: usize) -> usize {
    let rest = &text[at..];
    let until = |end: &[u8]| rest.windows(end.len()).position(|part| part == end).map(|found| found + end.len());
    let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.' | b'-' | b'+' | b'$');
    let length = if rest.starts_with(b"//") {
        until(b"\n")
    } else if rest.starts_with(b"/*") {
        until(b"*/")
    } else if rest[0] == b'"' {
        string(rest)
    } else {
        Some(rest.iter().take_while(|byte| is_word(byte)).count().max(1))
    };
    at + length.unwrap_or(rest.len())
}

/// The length of a string with its quotes.
fn string(rest: &[u8]) -> Option<usize> {
    let mut escaped = false;
    let end = rest.iter().skip(1).position(|byte| {
        let is_end = *byte == b'"' && !escaped;
        escaped = *byte == b'\\' && !escaped;
        is_end
    });
    end.map(|found| found + 2)
}

/// Breaks what is no text: bytes, and numbers of headers.
pub fn broken_bytes(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    const NUMBERS: [u32; 8] = [0, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff, 0x7f80_0000, 0x0001_0000, 3];
    let mut broken = if random.below(3) == 0 { mutate(random, bytes) } else { bytes.to_vec() };
    for _ in 0..1 + random.below(3) {
        // most of a header stands in front
        let reach = if random.below(2) == 0 { broken.len().min(400) } else { broken.len() };
        let at = random.below(reach);
        let number = NUMBERS[random.below(NUMBERS.len())];
        let number = if random.below(2) == 0 { number.to_le_bytes() } else { number.to_be_bytes() };
        for (byte, value) in broken.iter_mut().skip(at).zip(number) {
            *byte = value;
        }
    }
    broken
}
