//! A folder of pages that show what tests found: static, without a server and without any resource from elsewhere.
//!
//! `index.html` lists the tests, failed ones first; each has a page with its graph, a picture for each port, and for
//! everything that diverged from a picture what was expected and what came out, one over the other.

mod graph;
mod page;
mod pictures;
mod port;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tyndall_image::{Error, NewFolder};
use tyndall_page::STYLE;

use self::pictures::{Folder, Shown};
use crate::outcome::{GOLDEN, Outcome, RelationOutcome, State};

/// What the first page of every report says of itself; so a report is known when another is to take its place.
const GENERATOR: &str = "<meta name=\"generator\" content=\"tyndall test --report\">";

/// What is shown of a test.
struct Pictures {
    /// Of each port.
    ports: Vec<PortPictures>,
    /// Of each relation that failed against a picture.
    relations: Vec<Option<Shown>>,
}

/// What is shown of a port.
struct PortPictures {
    /// What came out, beside its golden where it has one.
    own: Option<Shown>,
    /// Of each other check that failed against a picture, by its place among the checks.
    failed: Vec<(usize, Shown)>,
}

impl Pictures {
    fn write(folder: &Folder<'_>, outcome: &Outcome) -> Result<Self, Error> {
        outcome.unchecked.iter().try_for_each(|port| folder.unchecked(port))?;
        let mut ports = Vec::with_capacity(outcome.ports.len());
        for port in &outcome.ports {
            let mut failed = Vec::new();
            for (index, check) in port.checks.iter().enumerate().filter(|(_, check)| check.what != GOLDEN) {
                let stem = format!("{}.{}.check-{index}", port.name, port.frame);
                if let Some(compared) = &check.judgement.pictures {
                    failed.push((index, folder.compared(stem, compared)?));
                }
            }
            ports.push(PortPictures { own: folder.port(port)?, failed });
        }
        let relation = |(index, relation): (usize, &RelationOutcome)| {
            let compared = relation.judgement.pictures.as_ref();
            compared.map(|compared| folder.compared(format!("relation-{index}"), compared)).transpose()
        };
        let relations = outcome.relations.iter().enumerate().map(relation).collect::<Result<_, _>>()?;
        Ok(Self { ports, relations })
    }
}

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
        folder.write("report.css", [STYLE, include_str!("report.css")].concat().as_bytes())?;
        folder.write("report.js", include_bytes!("report.js"))?;
        Ok(Self { folder, target: target.to_owned(), pages: Mutex::default() })
    }

    /// Writes the page of a test, and lets go of its pictures: so what is held does not grow with the number of tests.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn add(&self, outcome: &mut Outcome) -> Result<(), Error> {
        let name = self.name(outcome);
        // What nobody asked for and fails all the same is told like what somebody did.
        let is_reported =
            |name: &str, frame: u32| outcome.ports.iter().any(|port| port.name == name && port.frame == frame);
        outcome.unchecked.retain(|port| !is_reported(&port.name, port.frame));
        let shown = Pictures::write(&Folder { report: &self.folder, name: &name }, outcome)?;
        self.folder.write(&format!("{name}.html"), page::test(outcome, &name, &shown).as_bytes())?;
        let stem = |shown: &Shown| format!("{name}/{}.actual.png", shown.stem);
        let guilty = outcome.ports.iter().position(|port| port.state == State::Guilty);
        let stands_for_it =
            guilty.or(outcome.ports.len().checked_sub(1)).and_then(|port| shown.ports[port].own.as_ref());
        outcome.picture = stands_for_it.map(stem);
        outcome.drop_pictures();
        outcome.page = name;
        Ok(())
    }

    /// Writes the first page, puts the report where it will stand, and gives the path of that page. `notes` are lines
    /// about the whole run.
    ///
    /// # Errors
    /// What cannot be written; then there is no report, or the one before.
    pub fn finish(self, adapter: &str, outcomes: &[Outcome], notes: &[String]) -> Result<PathBuf, Error> {
        self.folder.write("index.html", page::index(adapter, outcomes, notes).as_bytes())?;
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
