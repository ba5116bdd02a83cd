//! What test programs print, summed.

/// Sums over all test programs of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Tests that passed.
    pub passed: usize,
    /// Tests that failed.
    pub failed: usize,
    /// Tests that are marked to be ignored.
    pub ignored: usize,
    /// Tests that did not run, because they need the folder that TYNDALL_ASSETS names.
    pub without_assets: usize,
    /// Test programs that reported a result.
    pub programs: usize,
}

impl Tally {
    /// Takes one line of output: `test result: ok. 3 passed; 0 failed; …`, or `not run: 2 tests need TYNDALL_ASSETS`.
    ///
    /// The second kind may follow other text in its line, because the test harness has often begun one.
    pub fn read(&mut self, line: &str) {
        if let Some(result) = line.strip_prefix("test result: ") {
            self.programs += 1;
            self.passed += before(result, " passed");
            self.failed += before(result, " failed");
            self.ignored += before(result, " ignored");
        } else if let Some((_, rest)) = line.split_once("not run: ")
            && rest.contains("TYNDALL_ASSETS")
        {
            self.without_assets += leading(rest);
        }
    }
}

/// The number right before `word`.
fn before(text: &str, word: &str) -> usize {
    let number = text.split_once(word).and_then(|(front, _)| front.rsplit(' ').next());
    number.and_then(|number| number.parse().ok()).unwrap_or(0)
}

fn leading(text: &str) -> usize {
    text.split(' ').next().and_then(|number| number.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(text: &str) -> Tally {
        let mut tally = Tally::default();
        text.lines().for_each(|line| tally.read(line));
        tally
    }

    #[test]
    fn results_are_summed() {
        let text = "\
running 4 tests
test a ... ok
test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.00s
test b ... not run: 2 tests need TYNDALL_ASSETS
not run: 1 test needs TYNDALL_ASSETS
test result: FAILED. 11 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 1.00s";
        let expected = Tally { passed: 14, failed: 2, ignored: 1, without_assets: 3, programs: 2 };
        assert_eq!(tally(text), expected);
    }

    #[test]
    fn other_lines_count_nothing() {
        assert_eq!(tally("3 passed\nnot run: 3 of them\nnot run: many need TYNDALL_ASSETS"), Tally::default());
    }
}
