//! The pages themselves.

use std::fmt::Write as _;

use tyndall_page::{Page, Picture, escaped};

use super::graph::graph;
use super::pictures::Shown;
use super::port::{port, relation};
use super::{GENERATOR, Pictures};
use crate::outcome::{Outcome, RelationOutcome, State};
use crate::summary;

/// What every page has in its head.
const HEAD: &str = "<link rel=\"icon\" href=\"data:,\">\n<link rel=\"stylesheet\" href=\"report.css\">\n<script src=\"report.js\" defer></script>\n";

fn whole(title: &str, body: &str) -> String {
    Page { title, head: &format!("{GENERATOR}\n{HEAD}"), body }.html()
}

/// What became of a test: as the style sheet calls it, and in words.
fn verdict(outcome: &Outcome) -> (&'static str, &'static str) {
    match outcome.passed() {
        true if outcome.checked_nothing() => ("nothing", "checked nothing"),
        true => ("passed", "passed"),
        false => ("failed", "failed"),
    }
}

/// The list of tests, failed ones first.
pub(super) fn index(adapter: &str, outcomes: &[Outcome], notes: &[String]) -> String {
    let [passed, failed, nothing] = summary::counts(outcomes);
    let nothing = if nothing > 0 { format!(", {nothing} checked nothing") } else { String::new() };
    // Where nothing went wrong nobody looks for what did.
    let class = if passed < outcomes.len() { "failed" } else { "passed" };
    let mut body = format!(
        "<header><h1>Image tests</h1><p class=\"{class}\"><b>{passed} passed, {failed} failed{nothing}</b> on {}</p></header>\n<main><table class=\"{class}\"><thead><tr>\
         <th></th><th>test</th><th>first diverging pass</th><th>inherited</th><th>ports</th><th>time</th></tr></thead><tbody>\n",
        escaped(adapter)
    );
    let mut rows: Vec<&Outcome> = outcomes.iter().collect();
    rows.sort_by_key(|outcome| (outcome.passed(), !outcome.checked_nothing()));
    for outcome in rows {
        body += &row(outcome);
    }
    body += "</tbody></table></main>\n<footer>";
    notes.iter().for_each(|note| body += &format!("{}<br>", escaped(note)));
    body += "keys: <kbd>t</kbd> light or dark</footer>\n";
    whole("Image tests", &body)
}

fn row(outcome: &Outcome) -> String {
    let (class, word) = verdict(outcome);
    let guilty = outcome.guilty().first().map(|pass| format!("<b>{}</b>", escaped(pass)));
    let why = || summary::headline(outcome).map(|why| format!("<small>{}</small>", escaped(&why)));
    let picture = match &outcome.picture {
        Some(path) => Picture { path, ..Picture::default() }.html(),
        None => String::new(),
    };
    format!(
        "<tr class=\"{class}\"><td class=\"picture\">{picture}</td><td><a href=\"{}.html\">{}</a> <span class=\"state\">{word}</span><br><small>{}</small></td><td class=\"first\">{}</td><td class=\"inherited\">{}</td><td>{}</td><td class=\"time\">{:.2} s</td></tr>\n",
        outcome.page,
        escaped(&outcome.name()),
        escaped(&outcome.about),
        guilty.or_else(why).unwrap_or_default(),
        escaped(&outcome.inherited().join(", ")),
        outcome.ports.len(),
        outcome.took.as_secs_f64()
    )
}

/// The page of one test.
pub(super) fn test(outcome: &Outcome, folder: &str, shown: &Pictures) -> String {
    let name = outcome.name();
    let (class, word) = verdict(outcome);
    let mut body = format!(
        "<header><a href=\"index.html\">all tests</a><h1>{}</h1><p>{}</p><p class=\"{class}\"><b>{word}</b> <code>{}</code></p></header>\n<main>\n",
        escaped(&name),
        escaped(&outcome.about),
        escaped(&outcome.graph.display().to_string())
    );
    let text = if outcome.checked_nothing() { summary::NOTHING.to_owned() } else { outcome.text() };
    if !text.is_empty() {
        // Without the indentation that lines below a test's name have.
        let text: Vec<&str> = text.lines().map(|line| line.strip_prefix("  ").unwrap_or(line)).collect();
        let _ = writeln!(body, "<pre>{}</pre>", escaped(&text.join("\n")));
    }
    for line in &outcome.left_out {
        let _ = writeln!(body, "<p>left out: {}</p>", escaped(line));
    }
    body += &graph(outcome, folder);
    let (failed, held): (Vec<_>, Vec<_>) =
        outcome.relations.iter().zip(&shown.relations).partition(|(relation, _)| relation.state != State::Passed);
    let described = |relations: Vec<(&RelationOutcome, &Option<Shown>)>| -> String {
        relations.into_iter().map(|(of, shown)| relation(of, shown.as_ref(), folder)).collect()
    };
    body += &described(failed);
    let mut ports: Vec<_> = outcome.ports.iter().zip(&shown.ports).collect();
    ports.sort_by_key(|(port, _)| match port.state {
        State::Guilty => 0,
        State::Unjudged => 1,
        State::Inherited => 2,
        State::Passed => 3,
    });
    for (outcome_of, shown) in ports {
        body += &port(outcome, outcome_of, shown, folder);
    }
    if !held.is_empty() {
        body += "<h2>From run to run</h2>\n";
    }
    body += &described(held);
    body += "</main>\n<footer>keys: <kbd>j</kbd> <kbd>k</kbd> next and previous port, <kbd>←</kbd> <kbd>→</kbd> the slider, <kbd>t</kbd> light or dark</footer>\n";
    whole(&name, &body)
}
