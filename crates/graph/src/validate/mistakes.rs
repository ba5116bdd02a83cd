//! Mistakes as the steps find them.

use tyndall_document::{Code, Diagnostic, Diagnostics, Place, did_you_mean, near};

/// Most unknown names of one file for which a near one is sought: the search is not cheap, and nobody reads more.
const MOST_SUGGESTIONS: u32 = 100;

/// The mistakes found so far.
pub(super) struct Mistakes {
    found: Diagnostics,
    suggestions: u32,
}

impl Mistakes {
    pub fn new() -> Self {
        Self { found: Diagnostics::default(), suggestions: MOST_SUGGESTIONS }
    }

    /// Where a [`Decoder`](tyndall_document::Decoder) reports what it finds.
    pub fn diagnostics(&mut self) -> &mut Diagnostics {
        &mut self.found
    }

    pub fn into_diagnostics(self) -> Diagnostics {
        self.found
    }

    pub fn extend(&mut self, diagnostics: impl IntoIterator<Item = Diagnostic>) {
        self.found.extend(diagnostics);
    }

    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Reports an unknown name with the near one, if there is one, and gives it; `written` says how it is written.
    pub fn report_unknown<'n>(
        &mut self,
        (code, place): (Code, Place),
        message: String,
        name: &str,
        candidates: impl IntoIterator<Item = &'n str> + Clone,
        written: impl Fn(&str) -> String,
    ) -> Option<&'n str> {
        let mut diagnostic = Diagnostic::error(code, place, message);
        let mut found = None;
        if self.suggestions > 0 {
            self.suggestions -= 1;
            found = near(name, candidates.clone());
            diagnostic = match found {
                Some(near) => diagnostic.suggest(did_you_mean(&written(near))),
                None => diagnostic.suggest_available(candidates.into_iter().map(written)),
            };
        }
        self.report(diagnostic);
        found
    }
}
