//! What every page has around what it shows.

use crate::escaped;

/// The style that all pages have in common. A page defines the colours `--line` and `--faint`.
pub const STYLE: &str = include_str!("page.css");

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// Its title, as plain text.
    pub title: &'a str,
    /// HTML in its head beside the title: styles, scripts.
    pub head: &'a str,
    /// HTML that it shows.
    pub body: &'a str,
}

impl Page<'_> {
    /// The file.
    pub fn html(&self) -> String {
        let Self { title, head, body } = self;
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
             content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n{head}</head>\n<body>\n{body}</body>\n</html>\n",
            escaped(title)
        )
    }
}
