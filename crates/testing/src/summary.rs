//! What all tests of a run found: for programs as JSON and JUnit XML, for people as lines.

use std::fmt::Write as _;
use std::time::Duration;

use serde_json::{Value, json};
use tyndall_page::escaped;

use crate::outcome::{Outcome, PortOutcome, Problem, RelationOutcome, State};
use crate::session::Saved;

/// What is said of a test that [checked nothing](Outcome::checked_nothing).
pub const NOTHING: &str =
    "nothing was checked: all that it says is of goldens or of its own size, and these were left out";

/// Why a test has not passed, in one line.
pub fn headline(outcome: &Outcome) -> Option<String> {
    if outcome.checked_nothing() {
        return Some(NOTHING.to_owned());
    }
    let stops = |problem: &&Problem| matches!(problem, Problem::Mistakes(_) | Problem::Machine(_));
    let stopped = outcome.problems.iter().find(stops).map(Problem::line);
    let diverging = || outcome.guilty().first().map(|pass| format!("first diverging pass: {pass}"));
    let unjudged = || {
        let port = outcome.ports.iter().find(|port| port.state == State::Unjudged)?;
        let check = port.checks.iter().find(|check| !check.judgement.passed)?;
        Some(format!("{}: {}", port.name, check.judgement.figures))
    };
    let other = || outcome.robustness.first().cloned().or_else(|| outcome.problems.first().map(Problem::line));
    stopped.or_else(diverging).or_else(unjudged).or_else(other)
}

/// How many tests passed, how many failed, and how many checked nothing.
pub fn counts(outcomes: &[Outcome]) -> [usize; 3] {
    let count = |is: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| is(outcome)).count();
    let nothing = count(&Outcome::checked_nothing);
    let passed = count(&Outcome::passed) - nothing;
    [passed, outcomes.len() - passed - nothing, nothing]
}

/// Tests that are printed as the slowest.
pub const SLOWEST: usize = 10;

/// The report for programs.
pub fn json(adapter: &str, outcomes: &[Outcome], saved: Saved) -> Value {
    let [passed, failed, nothing] = counts(outcomes);
    json!({
        "adapter": adapter,
        "passed": passed,
        "failed": failed,
        "checked_nothing": nothing,
        "sharing": { "passes": saved.passes, "spared": saved.spared, "spared_ms": milliseconds(saved.spared_time) },
        "milliseconds": {
            "rendering": milliseconds(saved.rendering),
            "references": milliseconds(saved.references),
            "comparing": milliseconds(saved.comparing),
            "report": milliseconds(saved.reporting),
        },
        "tests": outcomes.iter().map(test).collect::<Vec<_>>(),
    })
}

fn test(outcome: &Outcome) -> Value {
    json!({
        "name": outcome.name(),
        "file": outcome.path.display().to_string(),
        "about": outcome.about,
        "graph": outcome.graph.display().to_string(),
        "passed": outcome.passed() && !outcome.checked_nothing(),
        "checked_nothing": outcome.checked_nothing(),
        "why": headline(outcome),
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
        "frame": relation.frame,
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

/// What took time, and what sharing has saved: lines for people. Of tests that ran beside each other the sum.
pub fn times(outcomes: &[Outcome], saved: Saved) -> Vec<String> {
    let Saved { passes, spared, spared_time, rendering, references, comparing, reporting } = saved;
    let judged: Duration = outcomes.iter().map(|outcome| outcome.took).sum();
    let parts = [
        ("rendering", rendering),
        ("references on the CPU", references),
        ("comparing", comparing),
        ("the report", reporting),
        ("the rest", judged.saturating_sub(rendering + references + comparing + reporting)),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(_, time)| *time >= Duration::from_millis(50))
        .map(|(what, time)| format!("{:.1} s {what}", time.as_secs_f64()))
        .collect();
    let sharing = format!(
        "sharing spared {spared} of {passes} runs of passes: about {:.1} s, by what they took when they first ran",
        spared_time.as_secs_f64()
    );
    let parts = (!parts.is_empty()).then(|| format!("time: {}", parts.join(", ")));
    parts.into_iter().chain((spared > 0).then_some(sharing)).collect()
}

/// The report as JUnit XML: a case for each test, as continuous integration reads it.
pub fn junit(outcomes: &[Outcome]) -> String {
    let [_, failed, nothing] = counts(outcomes);
    let errors = outcomes.iter().filter(|outcome| outcome.exit_code() > 1).count();
    let time: f64 = outcomes.iter().map(|outcome| outcome.took.as_secs_f64()).sum();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"images\" tests=\"{}\" failures=\"{}\" errors=\"{errors}\" skipped=\"{nothing}\" time=\"{time:.3}\">\n",
        outcomes.len(),
        failed - errors
    );
    for outcome in outcomes {
        let (name, file) = (escaped(&outcome.name()), escaped(&outcome.path.display().to_string()));
        let _ = write!(xml, "<testcase name=\"{name}\" file=\"{file}\" time=\"{:.3}\"", outcome.took.as_secs_f64());
        let Some(why) = headline(outcome) else {
            xml += "/>\n";
            continue;
        };
        let (why, text) = (escaped(&why), escaped(&outcome.text()));
        // As continuous integration tells them apart: what does not hold, what could not be run, what was not checked.
        let found = match outcome.exit_code() {
            0 => format!("<skipped message=\"{why}\"/>"),
            1 => format!("<failure message=\"{why}\">{text}</failure>"),
            _ => format!("<error message=\"{why}\">{text}</error>"),
        };
        let _ = write!(xml, ">\n{found}\n</testcase>\n");
    }
    xml + "</testsuite>\n</testsuites>\n"
}

/// The slowest tests, a line each.
pub fn slowest(outcomes: &[Outcome]) -> Vec<String> {
    let mut by_time: Vec<&Outcome> = outcomes.iter().collect();
    by_time.sort_by_key(|outcome| std::cmp::Reverse(outcome.took));
    let line = |outcome: &&Outcome| format!("{:>9.1} ms  {}", outcome.took.as_secs_f64() * 1e3, outcome.name());
    by_time.iter().take(SLOWEST).map(line).collect()
}
