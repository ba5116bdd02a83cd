//! What all tests of a run found: for programs as JSON and JUnit XML, for people as lines.

use std::fmt::Write as _;
use std::time::Duration;

use serde_json::{Value, json};

use crate::outcome::{Outcome, PortOutcome, RelationOutcome, State};
use crate::session::Saved;

/// Tests that are printed as the slowest.
pub const SLOWEST: usize = 10;

/// The report for programs.
pub fn json(adapter: &str, outcomes: &[Outcome], saved: Saved) -> Value {
    let failed = outcomes.iter().filter(|outcome| !outcome.passed()).count();
    json!({
        "adapter": adapter,
        "passed": outcomes.len() - failed,
        "failed": failed,
        "sharing": { "passes": saved.passes, "spared": saved.spared, "rendering_ms": milliseconds(saved.rendering) },
        "tests": outcomes.iter().map(test).collect::<Vec<_>>(),
    })
}

fn test(outcome: &Outcome) -> Value {
    json!({
        "name": outcome.name(),
        "file": outcome.path.display().to_string(),
        "about": outcome.about,
        "graph": outcome.graph.display().to_string(),
        "passed": outcome.passed(),
        "milliseconds": milliseconds(outcome.took),
        "first_diverging_pass": outcome.guilty().first(),
        "diverging": outcome.guilty(),
        "inherited": outcome.inherited(),
        "suspicions": outcome.suspicions.iter().map(suspicion).collect::<Vec<_>>(),
        "left_out": outcome.left_out,
        "ports": outcome.ports.iter().map(port).collect::<Vec<_>>(),
        "relations": outcome.relations.iter().map(relation).collect::<Vec<_>>(),
        "passes": outcome.passes.iter().map(pass).collect::<Vec<_>>(),
        "robustness": outcome.robustness,
        "text": outcome.text(),
    })
}

fn suspicion(suspicion: &crate::outcome::Suspicion) -> Value {
    json!({ "pass": suspicion.pass, "unheld": suspicion.unheld })
}

fn pass(pass: &crate::outcome::PassOutcome) -> Value {
    json!({ "name": pass.name, "use": pass.kind, "reads": pass.reads, "bytes": pass.bytes, "gpu_us": pass.microseconds })
}

fn port(port: &PortOutcome) -> Value {
    let check = |check: &crate::outcome::Check| {
        let judgement = &check.judgement;
        json!({ "what": check.what, "passed": judgement.passed, "figures": judgement.figures, "excess": finite(judgement.excess) })
    };
    json!({
        "port": port.name,
        "pass": port.pass,
        "use": port.kind,
        "frame": port.frame,
        "state": state(port.state),
        "stale": port.stale,
        "checks": port.checks.iter().map(check).collect::<Vec<_>>(),
    })
}

fn relation(relation: &RelationOutcome) -> Value {
    json!({
        "about": relation.about,
        "port": relation.port,
        "passed": relation.judgement.passed,
        "figures": relation.judgement.figures,
        "state": state(relation.state),
    })
}

fn state(state: State) -> &'static str {
    match state {
        State::Passed => "passed",
        State::Guilty => "diverged",
        State::Inherited => "inherited",
        State::Unjudged => "unjudged",
    }
}

/// JSON has no infinity.
fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e4).round() / 10.0
}

/// The report as JUnit XML: a case for each test, as continuous integration reads it.
pub fn junit(outcomes: &[Outcome]) -> String {
    let failed = outcomes.iter().filter(|outcome| !outcome.passed()).count();
    let time: f64 = outcomes.iter().map(|outcome| outcome.took.as_secs_f64()).sum();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"images\" tests=\"{}\" failures=\"{failed}\" time=\"{time:.3}\">\n",
        outcomes.len()
    );
    for outcome in outcomes {
        let (name, file) = (escaped(&outcome.name()), escaped(&outcome.path.display().to_string()));
        let _ = write!(xml, "<testcase name=\"{name}\" file=\"{file}\" time=\"{:.3}\"", outcome.took.as_secs_f64());
        if outcome.passed() {
            xml += "/>\n";
            continue;
        }
        let message = match outcome.guilty().first() {
            Some(pass) => format!("first diverging pass: {pass}"),
            None => "could not be judged".to_owned(),
        };
        let _ = write!(
            xml,
            ">\n<failure message=\"{}\">{}</failure>\n</testcase>\n",
            escaped(&message),
            escaped(&outcome.text())
        );
    }
    xml + "</testsuite>\n</testsuites>\n"
}

/// XML 1.0 has no way to write most control characters at all.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\n' | '\t' => out.push(letter),
            control if control.is_control() => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

/// The slowest tests, a line each.
pub fn slowest(outcomes: &[Outcome]) -> Vec<String> {
    let mut by_time: Vec<&Outcome> = outcomes.iter().collect();
    by_time.sort_by_key(|outcome| std::cmp::Reverse(outcome.took));
    let line = |outcome: &&Outcome| format!("{:>9.1} ms  {}", outcome.took.as_secs_f64() * 1e3, outcome.name());
    by_time.iter().take(SLOWEST).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn xml_is_escaped() {
        assert_eq!(escaped("a<b> & \"c\"\u{1b}\n"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}\n");
    }
}
