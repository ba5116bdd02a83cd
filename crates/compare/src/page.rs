//! The page: tables, plots, pictures and maps of the error, in one folder that needs nothing else.

use tyndall_page::false_color::{Rgb, legend_of_errors};
use tyndall_page::{Page, Picture, Point, STYLE, escaped, figure, plot};

use crate::figures::{Figures, Row};
use crate::table;

/// The pixels of a picture of the page.
pub(crate) struct Pixels {
    /// Below the page's folder.
    pub path: String,
    pub pixels: Vec<Rgb>,
}

/// What the pictures of a scene are called.
pub(crate) struct Names<'f> {
    scene: (usize, &'f str),
}

impl<'f> Names<'f> {
    /// Of a scene: its index and its name.
    pub fn new(index: usize, name: &'f str) -> Self {
        Self { scene: (index, name) }
    }

    pub fn truth(&self) -> String {
        format!("pictures/{}.truth.png", slug(self.scene))
    }

    /// Of a method, by index and name.
    pub fn found(&self, method: (usize, &str)) -> String {
        format!("pictures/{}.{}.png", slug(self.scene), slug(method))
    }

    pub fn error(&self, method: (usize, &str)) -> String {
        format!("pictures/{}.{}.error.png", slug(self.scene), slug(method))
    }
}

/// `3-march-64-steps`: letters and digits, and a number that keeps names apart.
fn slug((index, name): (usize, &str)) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.map(str::to_ascii_lowercase).collect();
    let mut slug = format!("{}-{}", index + 1, words.join("-"));
    slug.truncate(60);
    slug
}

/// Error over time of all methods; `error` is a part of a row and its name.
pub(crate) fn plot_of(figures: &Figures, title: &str, rows: &[Row], error: (&str, fn(&Row) -> f64)) -> Option<String> {
    let points: Vec<Point> = figures
        .methods
        .iter()
        .zip(rows)
        .filter_map(|(method, row)| {
            let time = row.cost.frame_us? / 1e3;
            Some(Point { label: method.name.clone(), family: method.family, x: time, y: error.1(row) })
        })
        .collect();
    plot(title, error.0, &points)
}

/// The error that plots show first.
pub(crate) const P99: (&str, fn(&Row) -> f64) = ("relative error, p99", |row| row.p99);
const MAX: (&str, fn(&Row) -> f64) = ("relative error, largest", |row| row.max);

/// The whole page.
pub(crate) fn html(figures: &Figures) -> String {
    let head = format!("<style>\n{STYLE}{}</style>\n", include_str!("page.css"));
    let mut body = format!(
        "<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n",
        escaped(&figures.about),
        escaped(&table::legend(figures))
    );
    if figures.scenes.len() > 1 {
        body += &contents(figures);
        body += &over_all(figures);
    }
    for index in 0..figures.scenes.len() {
        body += &scene(figures, index);
    }
    body += &format!("<script>\n{}</script>\n", include_str!("page.js"));
    Page { title: &figures.about, head: &head, body: &body }.html()
}

fn contents(figures: &Figures) -> String {
    let links = figures.scenes.iter().enumerate();
    let links: String =
        links.map(|(index, scene)| format!(" <a href=\"#scene-{}\">{}</a>", index + 1, escaped(&scene.name))).collect();
    format!("<nav aria-label=\"Scenes\"><a href=\"#all\">All scenes</a>{links}</nav>\n")
}

fn over_all(figures: &Figures) -> String {
    let rows = figures.over_all();
    let plots = plots(figures, "All scenes", &rows);
    format!(
        "<section id=\"all\">\n<h2>All scenes</h2>\n<p>{}</p>\n{}{plots}</section>\n",
        table::OVER_ALL,
        table::html(&figures.methods, &rows)
    )
}

fn plots(figures: &Figures, title: &str, rows: &[Row]) -> String {
    let plot = |(name, error)| plot_of(figures, &format!("{title}: {name}"), rows, (name, error));
    let plots: Vec<String> = [P99, MAX].into_iter().filter_map(plot).collect();
    if plots.is_empty() {
        return "<p>This adapter measures no GPU times, so there is no plot of error over time.</p>\n".to_owned();
    }
    format!("<div class=\"plots\">\n{}</div>\n", plots.concat())
}

fn scene(figures: &Figures, index: usize) -> String {
    let scene = &figures.scenes[index];
    let number = index + 1;
    let name = escaped(&scene.name);
    format!(
        "<section id=\"scene-{number}\">\n<h2>{name}</h2>\n<p>{}</p>\n{}{}{}</section>\n",
        escaped(&scene.about),
        viewer(figures, index),
        table::html(&figures.methods, &scene.rows),
        plots(figures, &scene.name, &scene.rows)
    )
}

/// The true picture, that of one method, and its error; and all methods to choose from.
fn viewer(figures: &Figures, index: usize) -> String {
    let names = Names::new(index, &figures.scenes[index].name);
    let first = figures.methods.first().map_or("", |method| method.name.as_str());
    let picture = |path: String, class: &str, alt: &str| {
        Picture { path: &path, class, alt, size: Some(figures.size), lazy: false }.html()
    };
    let truth = picture(names.truth(), "", "The true picture");
    let found = picture(names.found((0, first)), "found", "The picture of the chosen method");
    let error = picture(names.error((0, first)), "error", "Its relative error by colour");
    format!(
        "<div class=\"viewer\">\n{}\n{}\n{}\n</div>\n{}",
        figure(&truth, "truth, in double precision"),
        figure(&found, &format!("<span class=\"name\">{}</span>", escaped(first))),
        figure(&error, &legend_of_errors()),
        choice(figures, index)
    )
}

/// All methods of a scene, each with the picture of its error.
fn choice(figures: &Figures, index: usize) -> String {
    let scene = &figures.scenes[index];
    let names = Names::new(index, &scene.name);
    let mut html = "<fieldset>\n<legend>Method (its relative error, worst channel)</legend>\n".to_owned();
    for (place, (method, row)) in figures.methods.iter().zip(&scene.rows).enumerate() {
        let of = (place, method.name.as_str());
        let (found, error, name) = (names.found(of), names.error(of), escaped(&method.name));
        let checked = if place == 0 { " checked" } else { "" };
        let picture = Picture { path: &error, size: Some(figures.size), lazy: true, ..Picture::default() };
        html += &format!(
            "<label title=\"{}\"><input type=\"radio\" name=\"scene-{}\" data-found=\"{found}\" data-error=\"{error}\" \
             data-name=\"{name}\"{checked}>{}<span>{name}</span> <small>p99 {}</small></label>\n",
            escaped(&method.about),
            index + 1,
            picture.html(),
            escaped(&table::error(row.p99))
        );
    }
    html + "</fieldset>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_have_names_of_their_own_that_any_disk_takes() {
        let names = Names::new(0, "Lamp, g = 0.5 / é");
        assert_eq!(names.truth(), "pictures/1-lamp-g-0-5.truth.png");
        assert_ne!(names.found((0, "a b")), names.found((1, "a-b")));
        assert_eq!(names.error((2, "../x")), "pictures/1-lamp-g-0-5.3-x.error.png");
        assert!(slug((0, &"long ".repeat(99))).len() <= 60);
    }
}
