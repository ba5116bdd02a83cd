//! A folder of pages that show what tests found: static, without a server and without any resource from elsewhere.
//!
//! `index.html` lists the tests, failed ones first; each has a page with its graph, a picture for each port, and for
//! each port that diverged what was expected and what came out, one over the other.

mod page;
mod pictures;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tyndall_image::{Error, NewFolder};

use crate::outcome::Outcome;

/// What the first page of every report says of itself; so a report is known when another is to take its place.
const GENERATOR: &str = "<meta name=\"generator\" content=\"tyndall test --report\">";

/// A report that is being written, test by test; it appears as a whole at the end.
#[derive(Debug)]
pub struct Report {
    folder: NewFolder,
    target: PathBuf,
    pages: Mutex<BTreeSet<String>>,
}

impl Report {
    /// Begins a report that will stand in this folder, which is not there yet, is empty, or holds a report.
    ///
    /// # Errors
    /// If the folder holds something else, or nothing may be written there.
    pub fn begin(target: &Path) -> Result<Self, Error> {
        let holds_report =
            |there: &Path| std::fs::read_to_string(there.join("index.html")).is_ok_and(|page| page.contains(GENERATOR));
        let folder = NewFolder::begin(target, holds_report)?;
        folder.write("report.css", include_bytes!("report.css"))?;
        folder.write("report.js", include_bytes!("report.js"))?;
        Ok(Self { folder, target: target.to_owned(), pages: Mutex::default() })
    }

    /// Writes the page of a test, and lets go of its pictures: so what is held does not grow with the number of tests.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn add(&self, outcome: &mut Outcome) -> Result<(), Error> {
        let name = self.name(outcome);
        let mut shown = Vec::with_capacity(outcome.ports.len());
        for port in &outcome.ports {
            shown.push(pictures::write(&self.folder, &name, port)?);
        }
        self.folder.write(&format!("{name}.html"), page::test(outcome, &name, &shown).as_bytes())?;
        outcome.drop_pictures();
        outcome.page = name;
        Ok(())
    }

    /// Writes the first page, puts the report where it will stand, and gives the path of that page.
    ///
    /// # Errors
    /// What cannot be written; then there is no report, or the one before.
    pub fn finish(self, adapter: &str, outcomes: &[Outcome]) -> Result<PathBuf, Error> {
        self.folder.write("index.html", page::index(adapter, outcomes).as_bytes())?;
        self.folder.persist()?;
        Ok(self.target.join("index.html"))
    }

    /// The name of a test's page and of its folder of pictures: like the test, with a number where that is taken.
    fn name(&self, outcome: &Outcome) -> String {
        let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
        let like: String = outcome.name().chars().map(letter).collect();
        let like = format!("test-{}", like.trim_matches('-'));
        let mut pages = self.pages.lock().unwrap_or_else(PoisonError::into_inner);
        let numbered = (2..).map(|number: u32| format!("{like}-{number}"));
        let free = std::iter::once(like.clone()).chain(numbered).find(|name| !pages.contains(name)).unwrap_or(like);
        pages.insert(free.clone());
        free
    }
}
