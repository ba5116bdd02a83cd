//! What a run tells of its tests, so that what many of them share is told once.

use std::collections::BTreeMap;

use tyndall_document::render_text;

use crate::outcome::Outcome;

/// What has been told in a run: mistakes that stop many tests, those of a broken shader say, by the test that told them.
#[derive(Debug, Default)]
pub struct ShownMistakes(BTreeMap<String, String>);

impl ShownMistakes {
    /// What a person reads about a failed test, with mistakes that an earlier test has told left to that.
    pub fn text(&mut self, outcome: &Outcome) -> String {
        outcome.text_with(&mut |mistakes| {
            let text = render_text(mistakes, false);
            match self.0.get(&text) {
                Some(earlier) => format!("  cannot run: the mistakes are those of {earlier}, told above\n"),
                None => {
                    self.0.insert(text.clone(), outcome.name());
                    text.trim_end().to_owned() + "\n"
                }
            }
        })
    }
}
