//! How tests are run.

use tyndall_graph::Order;

use crate::session::Variation;

/// How tests are run.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Write goldens that are missing or different, and record anew what stale ones were made from.
    pub bless: bool,
    /// Also where the golden was made on another class of adapters.
    pub bless_any_adapter: bool,
    /// Judge (and bless) only ports that match this pattern.
    pub tap: Option<String>,
    /// Judge (and bless) only ports of this frame.
    pub frame: Option<u32>,
    /// Run every pass alone, with its inputs from goldens.
    pub isolate: bool,
    /// Leave goldens and other renderers' pictures out: properties, references on the CPU and relations alone.
    pub without_goldens: bool,
    /// Leave references on the CPU out.
    pub without_references: bool,
    /// Ask no more than what tells whose fault it is once something does not hold: no relations, and nothing of ports that
    /// were made from one that fails.
    pub fail_fast: bool,
    /// Judge ports of passes of this kind (`plugin.pass`) alone: neither what they were made from nor what is made from
    /// them, and no relations.
    pub only: Option<String>,
    /// Tell a digest of all that is rendered.
    pub digest: bool,
    /// Another size than the test says, in pixels. Goldens are left out, and whatever else is stated for a size.
    pub size: Option<(u32, u32)>,
    /// The largest size, in pixels: a test of a larger one runs in this one, as if `size` said so.
    pub at_most: Option<(u32, u32)>,
    /// Render again in other ways, and hold every port against the first rendering, bit by bit.
    pub robustness: Robustness,
    /// Keep what a report shows: pictures of ports that pass too, and the time of every pass.
    pub for_report: bool,
}

impl Options {
    /// The size in which a test runs that says this one.
    pub(crate) fn size_of(&self, own: (u32, u32)) -> (u32, u32) {
        let most = self.at_most.unwrap_or((u32::MAX, u32::MAX));
        let (width, height) = self.size.unwrap_or(own);
        (width.min(most.0), height.min(most.1))
    }

    /// Whether ports of a frame are judged.
    pub(crate) fn looks_at(&self, frame: u32) -> bool {
        self.frame.is_none_or(|chosen| chosen == frame)
    }
}

/// In which other ways everything is rendered again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Robustness {
    /// In another valid order, drawn by this seed.
    pub shuffle: Option<u64>,
    /// With NaN in memory before it is first written.
    pub poison: bool,
    /// With ports that share no memory, beside those that do.
    pub no_sharing: bool,
    /// So many times in the same way.
    pub repeat: u32,
}

impl Robustness {
    /// Any other way at all.
    pub fn any(&self) -> bool {
        *self != Self::default()
    }

    /// The ways, each with its name.
    pub(crate) fn variations(&self) -> Vec<(String, Variation)> {
        let order = self.shuffle.map_or(Order::File, Order::Shuffled);
        let base = Variation { order, poison: self.poison, share: true, reuse: false };
        let mut ways = Vec::new();
        let mut name = vec!["again".to_owned()];
        name.extend(self.shuffle.map(|seed| format!("in the order of seed {seed}")));
        name.extend(self.poison.then(|| "from poisoned memory".to_owned()));
        let name = name.join(" ");
        for _ in 0..self.repeat.max(1) {
            ways.push((format!("{name}, memory shared"), base));
        }
        if self.no_sharing {
            ways.push((format!("{name}, no memory shared"), Variation { share: false, ..base }));
        }
        if self.any() { ways } else { Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_test_runs_larger_than_it_says_for_the_sake_of_a_largest_size() {
        let most = Options { at_most: Some((32, 32)), ..Options::default() };
        assert_eq!([(48, 36), (8, 6), (40, 12)].map(|own| most.size_of(own)), [(32, 32), (8, 6), (32, 12)]);
        let other = Options { size: Some((64, 48)), ..Options::default() };
        assert_eq!((other.size_of((8, 6)), Options::default().size_of((8, 6))), ((64, 48), (8, 6)));
    }
}
