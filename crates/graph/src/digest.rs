//! Numbers that stand for what they were made of: the same with every toolchain and on every machine, unlike those of the
//! standard library's hasher.

use std::hash::Hasher;

use siphasher::sip::SipHasher13;

/// A hash of pieces: SipHash 1-3. Each piece counts with its length, so that none runs into the next.
#[derive(Debug, Clone, Copy, Default)]
pub struct Digest(SipHasher13);

impl Digest {
    /// The hash of these bytes alone.
    pub fn of(bytes: &[u8]) -> u64 {
        let mut digest = Self::default();
        digest.bytes(bytes);
        digest.finish()
    }

    /// Adds bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.write(&(bytes.len() as u64).to_le_bytes());
        self.0.write(bytes);
    }

    /// Adds text.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Adds a number.
    pub fn number(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// The hash of all that was added.
    pub fn finish(&self) -> u64 {
        self.0.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Goldens are recorded with these numbers: whatever changes them makes all goldens stale.
    #[test]
    fn digests_are_the_same_for_ever() {
        let digest = |pieces: &[&str]| {
            let mut digest = Digest::default();
            pieces.iter().for_each(|piece| digest.text(piece));
            digest.finish()
        };
        assert_eq!(digest(&["light", "fog"]), 12_489_747_809_977_350_201);
        assert_ne!(digest(&["light", "fog"]), digest(&["lightfog"]));
        assert_ne!(digest(&["light", "fog"]), digest(&["lightf", "og"]));
    }
}
