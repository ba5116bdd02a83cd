//! The pages themselves.

use std::fmt::Write as _;

use super::GENERATOR;
use super::pictures::{MULTIPLES, STEPS, Shown};
use crate::outcome::{Outcome, PassOutcome, PortOutcome, RelationOutcome, State};
use crate::summary::escaped;

/// Width and height of a pass in the drawing of the graph, and the room between, in CSS pixels.
const CARD: usize = 164;
const ROW: usize = 88;
const GAP: usize = 30;

fn whole(title: &str, body: &str) -> String {
    let title = escaped(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n{GENERATOR}\n\
         <title>{title}</title>\n<link rel=\"icon\" href=\"data:,\">\n<link rel=\"stylesheet\" href=\"report.css\">\n<script src=\"report.js\" defer></script>\n</head>\n\
         <body>\n{body}</body>\n</html>\n"
    )
}

/// The list of tests, failed ones first.
pub(super) fn index(adapter: &str, outcomes: &[Outcome]) -> String {
    let failed = outcomes.iter().filter(|outcome| !outcome.passed()).count();
    let mut body = format!(
        "<header><h1>Image tests</h1><p><b>{} passed, {failed} failed</b> on {}</p></header>\n<main><table><thead><tr>\
         <th>test</th><th>first diverging pass</th><th>inherited</th><th>ports</th><th>time</th></tr></thead><tbody>\n",
        outcomes.len() - failed,
        escaped(adapter)
    );
    let mut rows: Vec<&Outcome> = outcomes.iter().collect();
    rows.sort_by_key(|outcome| outcome.passed());
    for outcome in rows {
        let class = if outcome.passed() { "passed" } else { "failed" };
        let first = outcome.guilty().first().map_or("", |pass| pass);
        let first = if first.is_empty() && !outcome.passed() { "could not be judged" } else { first };
        let _ = writeln!(
            body,
            "<tr class=\"{class}\"><td><a href=\"{}.html\">{}</a><br><small>{}</small></td><td class=\"first\">{}</td><td>{}</td><td>{}</td><td>{:.0} ms</td></tr>",
            outcome.page,
            escaped(&outcome.name()),
            escaped(&outcome.about),
            escaped(first),
            escaped(&outcome.inherited().join(", ")),
            outcome.ports.len(),
            outcome.took.as_secs_f64() * 1e3
        );
    }
    body += "</tbody></table></main>\n";
    whole("Image tests", &body)
}

/// The page of one test.
pub(super) fn test(outcome: &Outcome, folder: &str, shown: &[Shown]) -> String {
    let name = outcome.name();
    let verdict = if outcome.passed() { "passed" } else { "failed" };
    let mut body = format!(
        "<header><a href=\"index.html\">all tests</a><h1>{}</h1><p>{}</p><p class=\"{verdict}\"><b>{verdict}</b> <code>{}</code></p></header>\n<main>\n",
        escaped(&name),
        escaped(&outcome.about),
        escaped(&outcome.graph.display().to_string())
    );
    let text = outcome.text();
    if !text.is_empty() {
        // Without the indentation that lines below a test's name have.
        let text: Vec<&str> = text.lines().map(|line| line.strip_prefix("  ").unwrap_or(line)).collect();
        let _ = writeln!(body, "<pre>{}</pre>", escaped(&text.join("\n")));
    }
    body += &graph(outcome, folder);
    for relation in &outcome.relations {
        body += &relation_line(relation);
    }
    let mut ports: Vec<(&PortOutcome, &Shown)> = outcome.ports.iter().zip(shown).collect();
    ports.sort_by_key(|(port, _)| match port.state {
        State::Guilty => 0,
        State::Unjudged => 1,
        State::Inherited => 2,
        State::Passed => 3,
    });
    for (port, shown) in ports {
        body += &section(outcome, port, shown, folder);
    }
    body += "</main>\n<footer>keys: <kbd>j</kbd> <kbd>k</kbd> next and previous port, <kbd>←</kbd> <kbd>→</kbd> the slider, <kbd>t</kbd> light or dark</footer>\n";
    whole(&name, &body)
}

fn relation_line(relation: &RelationOutcome) -> String {
    let class = state(relation.state);
    format!(
        "<p class=\"relation {class}\"><b>{}</b> {}: {}</p>\n",
        escaped(&relation.port),
        escaped(&relation.about),
        escaped(&relation.judgement.figures)
    )
}

/// The graph, from left to right: a card for each pass with a picture of its first port, and lines between them.
fn graph(outcome: &Outcome, folder: &str) -> String {
    let columns = columns(&outcome.passes);
    let mut rows = vec![0; columns.iter().max().map_or(0, |most| most + 1)];
    let places: Vec<(usize, usize)> = columns
        .iter()
        .map(|column| {
            let row = rows[*column];
            rows[*column] += 1;
            (column * (CARD + GAP), row * (ROW + 12))
        })
        .collect();
    let (width, height) = (rows.len() * (CARD + GAP), rows.iter().max().unwrap_or(&0) * (ROW + 12));
    let mut lines = String::new();
    let mut cards = String::new();
    for (pass, (x, y)) in outcome.passes.iter().zip(&places) {
        for from in &pass.reads {
            let Some(at) = outcome.passes.iter().position(|other| other.name == *from) else { continue };
            let (start, end) = ((places[at].0 + CARD, places[at].1 + ROW / 2), (*x, y + ROW / 2));
            let bend = GAP / 2;
            let _ = write!(
                lines,
                "<path d=\"M{} {} C{} {} {} {} {} {}\"/>",
                start.0,
                start.1,
                start.0 + bend,
                start.1,
                end.0.saturating_sub(bend),
                end.1,
                end.0,
                end.1
            );
        }
        cards += &card(outcome, pass, (*x, *y), folder);
    }
    format!(
        "<div class=\"graph\" tabindex=\"0\" role=\"region\" aria-label=\"the graph\" style=\"width:{width}px;height:{height}px\"><svg width=\"{width}\" height=\"{height}\" aria-hidden=\"true\">{lines}</svg>{cards}</div>\n"
    )
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

fn card(outcome: &Outcome, pass: &PassOutcome, (x, y): (usize, usize), folder: &str) -> String {
    let ports: Vec<&PortOutcome> = outcome.ports.iter().filter(|port| port.pass == pass.name).collect();
    let class = match () {
        () if outcome.guilty().contains(&pass.name.as_str()) => "diverged",
        () if outcome.inherited().contains(&pass.name.as_str()) => "inherited",
        () if ports.is_empty() => "unseen",
        () => "passed",
    };
    let thumbnails: String = ports
        .iter()
        .filter(|port| port.actual.is_some())
        .map(|port| {
            let (anchor, title) = (escaped(&anchor(port)), escaped(&port.name));
            format!("<a href=\"#{anchor}\" title=\"{title}\"><img src=\"{folder}/{title}.{}.actual.png\" alt=\"{title}\"></a>", port.frame)
        })
        .collect();
    let time = pass.microseconds.map_or(String::new(), |us| format!("{:.2} ms, ", us / 1e3));
    format!(
        "<div class=\"card {class}\" style=\"left:{x}px;top:{y}px;width:{CARD}px;height:{ROW}px\"><b>{}</b><small>{}<br>{time}{}</small><span>{thumbnails}</span></div>",
        escaped(&pass.name),
        escaped(&pass.kind),
        tyndall_gpu::bytes(pass.bytes)
    )
}

fn anchor(port: &PortOutcome) -> String {
    format!("{}.{}", port.name, port.frame)
}

fn state(state: State) -> &'static str {
    match state {
        State::Passed => "passed",
        State::Guilty => "diverged",
        State::Inherited => "inherited",
        State::Unjudged => "unjudged",
    }
}

/// All about one port; open where it diverged.
fn section(outcome: &Outcome, port: &PortOutcome, shown: &Shown, folder: &str) -> String {
    let class = state(port.state);
    let open = if port.state == State::Guilty { " open" } else { "" };
    let frame = if port.frame > 0 { format!(", frame {}", port.frame) } else { String::new() };
    let mut html = format!(
        "<details class=\"port {class}\" id=\"{}\"{open}><summary><b>{}</b>{frame} <small>{}</small> {class}</summary>\n<ul>",
        escaped(&anchor(port)),
        escaped(&port.name),
        escaped(&port.kind)
    );
    for check in &port.checks {
        let class = if check.judgement.passed { "passed" } else { "failed" };
        let _ =
            write!(html, "<li class=\"{class}\">{}: {}</li>", escaped(&check.what), escaped(&check.judgement.figures));
    }
    html += "</ul>\n";
    if !port.stale.is_empty() {
        let _ = writeln!(
            html,
            "<p>The golden is stale: {} changed since it was made.</p>",
            escaped(&port.stale.join(", "))
        );
    }
    let picture = |what: &str| {
        let name = escaped(&port.name);
        format!("<img src=\"{folder}/{name}.{}.{what}.png\" alt=\"{what}\">", port.frame)
    };
    if shown.compared {
        let _ = writeln!(
            html,
            "<div class=\"pictures\"><figure><div class=\"compare\">{}<div class=\"over\">{}</div></div>\
             <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"expected to the left, actual to the right\"><figcaption>expected to the left, actual to the right</figcaption></figure>\
             <figure>{}<figcaption>difference: blue within the tolerance, red beyond it, white at {} times it</figcaption></figure>\
             <figure>{}<figcaption>{}</figcaption></figure><figure>{}<figcaption><span class=\"counts\"><span><i class=\"actual\"></i>actual</span><span><i class=\"expected\"></i>expected</span><span>{} to {}</span></span></figcaption></figure></div>",
            picture("actual"),
            picture("expected"),
            picture("difference"),
            short(shown.largest),
            picture("failing"),
            failing(shown),
            histogram(shown),
            short(f64::from(shown.range.0)),
            short(f64::from(shown.range.1))
        );
    } else if shown.actual {
        let _ = writeln!(
            html,
            "<div class=\"pictures\"><figure>{}<figcaption>actual</figcaption></figure><figure>{}<figcaption>{} to {}</figcaption></figure></div>",
            picture("actual"),
            histogram(shown),
            short(f64::from(shown.range.0)),
            short(f64::from(shown.range.1))
        );
    }
    if port.metric.is_some() {
        let _ = writeln!(html, "<p>Bless just this: <code>{}</code></p>", escaped(&outcome.bless_command(port)));
    }
    html + "</details>\n"
}

/// A number for the eye: three digits.
fn short(number: f64) -> String {
    let size = number.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) {
        let digits = if size == 0.0 { 0 } else { (2 - size.log10().floor() as i32).max(0) as usize };
        return format!("{number:.digits$}");
    }
    format!("{number:.2e}")
}

/// How many pixels are beyond each multiple of the tolerance, with their colours.
fn failing(shown: &Shown) -> String {
    let count = |((multiple, count), [r, g, b]): ((&f64, usize), &[u8; 3])| {
        format!("<span><i style=\"background:rgb({r},{g},{b})\"></i>{multiple}×: {count}</span>")
    };
    let counts: String = MULTIPLES.iter().zip(shown.failing).zip(&STEPS[1..]).map(count).collect();
    format!("of {} pixels, beyond the tolerance <span class=\"counts\">{counts}</span>", shown.pixels)
}

/// Bars of what came out over those of what was expected; the height is the logarithm of the count.
fn histogram(shown: &Shown) -> String {
    let most = shown.histograms.iter().flatten().max().copied().unwrap_or(1).max(1);
    let height = |count: usize| 80.0 * ((count + 1) as f64).ln() / ((most + 1) as f64).ln();
    let mut bars = String::new();
    for (class, counts) in ["actual", "expected"].iter().zip(&shown.histograms) {
        for (index, count) in counts.iter().enumerate() {
            let height = height(*count);
            let _ = write!(
                bars,
                "<rect class=\"{class}\" x=\"{}\" y=\"{:.1}\" width=\"5\" height=\"{height:.1}\"/>",
                index * 6,
                80.0 - height
            );
        }
    }
    format!("<svg class=\"histogram\" viewBox=\"0 0 192 80\" role=\"img\" aria-label=\"histogram\">{bars}</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1.0, -1.0, 0.752_676_3, 12.3456, 183_921.928, 2.5e-7, 0.00123].map(short);
        assert_eq!(numbers, ["0", "1.00", "-1.00", "0.753", "12.3", "1.84e5", "2.50e-7", "0.00123"]);
    }
}
