//! Pictures and what stands below them.

use crate::escaped;

/// A picture of a page.
#[derive(Debug, Clone, Copy, Default)]
pub struct Picture<'a> {
    /// Its file, below the page's folder.
    pub path: &'a str,
    /// What it shows, for those who do not see it; nothing where the text beside it says so.
    pub alt: &'a str,
    /// What the page's style and script know it by.
    pub class: &'a str,
    /// Width and height, so that the page does not move while it is loaded.
    pub size: Option<(u32, u32)>,
    /// It is loaded when it is about to be seen.
    pub lazy: bool,
}

impl Picture<'_> {
    /// The element.
    pub fn html(&self) -> String {
        let mut html = format!("<img src=\"{}\" alt=\"{}\"", escaped(self.path), escaped(self.alt));
        if !self.class.is_empty() {
            html += &format!(" class=\"{}\"", self.class);
        }
        if let Some((width, height)) = self.size {
            html += &format!(" width=\"{width}\" height=\"{height}\"");
        }
        html + if self.lazy { " loading=\"lazy\">" } else { ">" }
    }
}

/// Something to look at and, below, what it is: both HTML.
pub fn figure(content: &str, caption: &str) -> String {
    format!("<figure>{content}<figcaption>{caption}</figcaption></figure>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_says_what_is_known_of_it() {
        let plain = Picture { path: "a&b.png", ..Picture::default() };
        assert_eq!(plain.html(), "<img src=\"a&amp;b.png\" alt=\"\">");
        let all = Picture { path: "a.png", alt: "light", class: "found", size: Some((4, 3)), lazy: true };
        let html = "<img src=\"a.png\" alt=\"light\" class=\"found\" width=\"4\" height=\"3\" loading=\"lazy\">";
        assert_eq!(all.html(), html);
    }
}
