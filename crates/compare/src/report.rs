//! A finished comparison, as text and as files.

use std::path::{Path, PathBuf};

use serde_json::Value;
use tyndall_image::{Error, Image, Meaning, write_bytes};

use crate::figures::Figures;
use crate::page::{self, Pixels};
use crate::table;

/// A finished comparison.
pub struct Comparison {
    pub(crate) figures: Figures,
    pub(crate) pictures: Vec<Pixels>,
}

impl Comparison {
    /// All tables with their explanations, for a terminal.
    pub fn text(&self) -> String {
        table::text(&self.figures)
    }

    /// All figures, as JSON.
    pub fn json(&self) -> Value {
        self.figures.json()
    }

    /// Writes the page and its pictures, the tables in Markdown (`table.md`) and, where there are times, error over time
    /// (`plot.svg`) into a folder; the page (`index.html`) is written last, when all that it shows exists. Returns the paths,
    /// except those of pictures.
    ///
    /// # Errors
    /// Whatever the file system refuses.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Error> {
        let figures = &self.figures;
        let (width, height) = figures.size;
        for picture in &self.pictures {
            let data = picture.pixels.iter().flatten().map(|byte| f32::from(*byte) / 255.0).collect();
            tyndall_image::write(&folder.join(&picture.path), &Image::new(width, height, 3, data), Meaning::Display)?;
        }
        let mut files = vec![("table.md", table::markdown(figures))];
        let plot = page::plot_of(figures, &figures.about, &figures.over_all(), page::P99);
        files.extend(plot.map(|plot| ("plot.svg", plot)));
        files.push(("index.html", page::html(figures)));
        let mut written = Vec::new();
        for (name, text) in files {
            written.push(folder.join(name));
            write_bytes(&folder.join(name), text.as_bytes())?;
        }
        Ok(written)
    }
}
