//! A folder of pages that show what tests found: static, without a server and without any resource from elsewhere.
//!
//! `index.html` lists the tests, failed ones first; each has a page with its graph, a picture for each port, and for
//! each port that diverged what was expected and what came out, one over the other.

mod page;
mod pictures;

use std::path::{Path, PathBuf};

use crate::outcome::Outcome;

/// Writes the pages into a folder, and gives the path of the first. Other files of the folder stay.
///
/// # Errors
/// What could not be written.
pub fn write(folder: &Path, adapter: &str, outcomes: &[Outcome]) -> Result<PathBuf, String> {
    let file = |name: &str, content: &str| -> Result<PathBuf, String> {
        let path = folder.join(name);
        tyndall_image::write_bytes(&path, content.as_bytes()).map_err(|error| error.to_string())?;
        Ok(path)
    };
    file("report.css", include_str!("report.css"))?;
    file("report.js", include_str!("report.js"))?;
    for (number, outcome) in outcomes.iter().enumerate() {
        let name = slug(number, outcome);
        let shown = pictures::write(&folder.join(&name), outcome)?;
        file(&format!("{name}.html"), &page::test(outcome, &name, &shown))?;
    }
    file("index.html", &page::index(adapter, outcomes))
}

/// The name of a test's page and of its folder of pictures.
fn slug(number: usize, outcome: &Outcome) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
    format!("{number:03}-{}", outcome.name().chars().map(letter).collect::<String>().trim_matches('-'))
}
