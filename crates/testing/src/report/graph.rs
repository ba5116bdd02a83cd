//! The graph of a test, from left to right: a card for each pass with a picture of each port, and lines between them.

use std::fmt::Write as _;

use tyndall_page::{Picture, escaped};

use super::port::{anchor, state};
use crate::outcome::{Outcome, PassOutcome, PortOutcome, State};

/// Width of a pass, and the room between, in CSS pixels.
const CARD: usize = 176;
const GAP: usize = 28;
const BELOW: usize = 14;
/// Height of what is written on a card, with its borders.
const TEXT: usize = 60;
/// Rooms for pictures of ports: a few large ones, or many small ones.
const LARGE: Rooms = Rooms { class: "large", in_a_row: 2, height: 60 };
const SMALL: Rooms = Rooms { class: "small", in_a_row: 4, height: 30 };

/// How pictures lie on a card; the style sheet has the same heights.
struct Rooms {
    class: &'static str,
    in_a_row: usize,
    height: usize,
}

/// Left, top and height of a card.
type Place = (usize, usize, usize);

/// The drawing; `folder` holds the pictures.
pub(super) fn graph(outcome: &Outcome, folder: &str) -> String {
    let cards: Vec<Vec<String>> = outcome.passes.iter().map(|pass| thumbnails(outcome, pass, folder)).collect();
    let counts: Vec<usize> = cards.iter().map(Vec::len).collect();
    let (places, width, height) = places(&outcome.passes, &counts);
    let mut lines = String::new();
    let mut drawn = String::new();
    for ((pass, thumbnails), place) in outcome.passes.iter().zip(&cards).zip(&places) {
        for from in &pass.reads {
            if let Some(at) = outcome.passes.iter().position(|other| other.name == *from) {
                lines += &line(places[at], *place);
            }
        }
        drawn += &card(outcome, pass, *place, thumbnails);
    }
    format!(
        "<div class=\"graph\" tabindex=\"0\" role=\"region\" aria-label=\"the graph\" style=\"height:{height}px\"><div style=\"width:{width}px;height:{height}px\">\
         <svg width=\"{width}\" height=\"{height}\" aria-hidden=\"true\">{lines}</svg>{drawn}</div></div>\n"
    )
}

fn rooms(count: usize) -> Rooms {
    if count <= LARGE.in_a_row { LARGE } else { SMALL }
}

/// The place of each card, each column in the middle; and the size of the drawing.
fn places(passes: &[PassOutcome], counts: &[usize]) -> (Vec<Place>, usize, usize) {
    let columns = columns(passes);
    let mut bottoms = vec![0; columns.iter().max().map_or(0, |most| most + 1)]; // none where no pass was planned
    let mut places: Vec<Place> = Vec::with_capacity(passes.len());
    for (column, count) in columns.iter().zip(counts) {
        let rooms = rooms(*count);
        let height = TEXT + count.div_ceil(rooms.in_a_row) * rooms.height;
        places.push((column * (CARD + GAP), bottoms[*column], height));
        bottoms[*column] += height + BELOW;
    }
    let tallest = bottoms.iter().max().copied().unwrap_or(0);
    for ((_, top, _), column) in places.iter_mut().zip(&columns) {
        *top += (tallest - bottoms[*column]) / 2;
    }
    (places, (bottoms.len() * (CARD + GAP)).saturating_sub(GAP), tallest)
}

/// How many passes lie before each, along the longest way.
fn columns(passes: &[PassOutcome]) -> Vec<usize> {
    let mut columns: Vec<usize> = Vec::with_capacity(passes.len());
    for pass in passes {
        let before = passes.iter().zip(&columns).filter(|(other, _)| pass.reads.contains(&other.name));
        let column = before.map(|(_, column)| column + 1).max().unwrap_or(0);
        columns.push(column);
    }
    columns
}

fn line(from: Place, to: Place) -> String {
    let (start, end) = ((from.0 + CARD, from.1 + from.2 / 2), (to.0, to.1 + to.2 / 2));
    let bend = GAP / 2;
    format!(
        "<path d=\"M{} {} C{} {} {} {} {} {}\"/>",
        start.0,
        start.1,
        start.0 + bend,
        start.1,
        end.0.saturating_sub(bend),
        end.1,
        end.0,
        end.1
    )
}

/// A picture of each port: first those that the test looks at.
fn thumbnails(outcome: &Outcome, pass: &PassOutcome, folder: &str) -> Vec<String> {
    let tapped = outcome.ports.iter().filter(|port| port.pass == pass.name && port.actual.is_some());
    let tapped = tapped.map(|port| {
        let said = if port.checks.is_empty() { "nothing was checked of it" } else { state(port.state) };
        thumbnail(&port.name, port.frame, folder, (&format!("#{}", anchor(port)), class(port), said))
    });
    let unchecked = outcome.unchecked.iter().filter(|port| port.pass == pass.name).map(|port| {
        let target = format!("{folder}/{}.{}.actual.png", port.name, port.frame);
        thumbnail(&port.name, port.frame, folder, (&target, "unseen", "the test does not look at it"))
    });
    tapped.chain(unchecked).collect()
}

fn class(port: &PortOutcome) -> &'static str {
    if port.checks.is_empty() { "unseen" } else { state(port.state) }
}

fn thumbnail(name: &str, frame: u32, folder: &str, (target, class, said): (&str, &str, &str)) -> String {
    let (path, target) = (format!("{folder}/{name}.{frame}.actual.png"), escaped(target));
    let alt = if frame > 0 { format!("{name}, frame {frame}") } else { name.to_owned() };
    let picture = Picture { path: &path, alt: &alt, ..Picture::default() }.html();
    format!("<a class=\"{class}\" href=\"{target}\" title=\"{}: {said}\">{picture}</a>", escaped(&alt))
}

fn card(outcome: &Outcome, pass: &PassOutcome, (x, y, height): Place, thumbnails: &[String]) -> String {
    let checked = || outcome.ports.iter().filter(|port| port.pass == pass.name && !port.checks.is_empty());
    let class = match () {
        () if outcome.guilty().contains(&pass.name.as_str()) => state(State::Guilty),
        () if outcome.inherited().contains(&pass.name.as_str()) => state(State::Inherited),
        () if checked().any(|port| port.state == State::Unjudged) => state(State::Unjudged),
        () if checked().next().is_none() => "unseen",
        () => state(State::Passed),
    };
    let time = pass.microseconds.map_or(String::new(), |us| format!("{:.2} ms, ", us / 1e3));
    let mut html = String::new();
    let _ = write!(
        html,
        "<div class=\"card {class}\" style=\"left:{x}px;top:{y}px;width:{CARD}px;height:{height}px\"><b>{}</b><small>{}<br>{time}{}</small><span class=\"{}\">{}</span></div>",
        escaped(&pass.name),
        escaped(&pass.kind),
        tyndall_gpu::bytes(pass.bytes),
        rooms(thumbnails.len()).class,
        thumbnails.concat()
    );
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pass(name: &str, reads: &[&str]) -> PassOutcome {
        let reads = reads.iter().map(|name| (*name).to_owned()).collect();
        PassOutcome { name: name.to_owned(), kind: String::new(), reads, bytes: 0, microseconds: None }
    }

    /// However many ports a pass has, its card has room for them, and none lies over another.
    #[test]
    fn cards_have_room_for_every_port() {
        let passes = [pass("a", &[]), pass("b", &["a"]), pass("c", &["a"]), pass("d", &["b", "c"])];
        let (places, width, height) = places(&passes, &[1, 13, 2, 0]);
        let [a, b, c, d] = places.as_slice() else { panic!("{places:?}") };
        assert_eq!((a.0, b.0, c.0, d.0), (0, CARD + GAP, CARD + GAP, 2 * (CARD + GAP)));
        assert_eq!((a.2, b.2, c.2, d.2), (TEXT + 60, TEXT + 4 * 30, TEXT + 60, TEXT));
        assert!(c.1 >= b.1 + b.2 && width == 3 * CARD + 2 * GAP);
        assert!(places.iter().all(|(_, top, tall)| top + tall <= height));
    }
}
