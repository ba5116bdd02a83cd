//! Files that are broken at random.

/// Numbers that look random, the same on every machine.
pub struct Random(pub u64);

impl Random {
    /// Below `end`, which counts as 1 where it is 0.
    pub fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end.max(1) as u64) as usize
    }

    /// One of these.
    pub fn of<'a, T: ?Sized>(&mut self, choices: &[&'a T]) -> &'a T {
        choices[self.below(choices.len())]
    }
}

const BITS: [&[u8]; 24] = [
    b"(",
    b")",
    b"[",
    b"]",
    b"{",
    b"}",
    b"\"",
    b",",
    b":",
    b"NaN",
    b"-inf",
    b"1e400",
    b"99999999999999999999",
    b"-",
    b"$x",
    b"/*",
    b"//",
    b"r#\"",
    b"\\u{110000}",
    b"\xff\xfe",
    b"\0",
    b"Some(",
    b"Keys([(0.0, ",
    b"..",
];
const NUMBERS: [&str; 10] = ["0.0", "-1.0", "1e38", "1e-45", "1e308", "NaN", "inf", "4294967296", "()", "\"a\""];

/// Breaks a file in one to three places.
pub fn mutate(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + random.below(3) {
        let at = random.below(bytes.len());
        match random.below(6) {
            0 if !bytes.is_empty() => bytes[at] = random.below(256) as u8,
            1 => drop(bytes.drain(at..(at + 1 + random.below(20)).min(bytes.len()))),
            2 => drop(bytes.splice(at..at, random.of(&BITS).iter().copied())),
            3 => {
                let from = random.below(bytes.len());
                let part = bytes[from..(from + random.below(60)).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
            4 if random.below(4) == 0 => bytes.truncate(at),
            _ => replace_a_number(random, &mut bytes),
        }
    }
    bytes
}

/// A number for another: what is still sound in form, and so gets further.
fn replace_a_number(random: &mut Random, bytes: &mut Vec<u8>) {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let at = random.below(bytes.len());
    let Some(start) = bytes.iter().skip(at).position(is_digit).map(|found| at + found) else { return };
    let end = bytes.iter().skip(start).position(|byte| !is_digit(byte)).map_or(bytes.len(), |found| start + found);
    bytes.splice(start..end, random.of(&NUMBERS).bytes());
}
