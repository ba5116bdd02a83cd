//! What became of all mutants, for people and programs.

use std::time::Duration;

use serde_json::{Value, json};

use crate::findings::{Mutant, Nearest, PassFindings, Verdict};

/// Counts of mutants.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Figures {
    /// All.
    pub made: usize,
    /// Killed by everything together.
    pub killed: usize,
    /// Killed by properties, references and relations alone.
    pub without_goldens: usize,
    /// Noticed, and laid at the wrong door.
    pub misnamed: usize,
    /// Neither noticed nor, with that, killed.
    pub survived: usize,
    /// Of these, with a reason.
    pub explained: usize,
}

impl Figures {
    /// Of some passes together.
    pub fn of<'a>(findings: impl IntoIterator<Item = &'a PassFindings>) -> Self {
        let mut figures = Self::default();
        for mutant in findings.into_iter().flat_map(|findings| &findings.mutants) {
            let misnamed = matches!(mutant.verdict, Verdict::Misnamed { .. });
            let killed = mutant.verdict.is_killed();
            figures.made += 1;
            figures.killed += usize::from(killed);
            figures.without_goldens += usize::from(mutant.without_goldens.is_killed());
            figures.misnamed += usize::from(misnamed);
            figures.survived += usize::from(!killed && !misnamed);
            figures.explained += usize::from(!killed && mutant.reason.is_some());
        }
        figures
    }

    /// Percent of all mutants that are killed: by everything, and without goldens.
    pub fn percent(&self) -> (f64, f64) {
        let part = |count: usize| 100.0 * count as f64 / self.made.max(1) as f64;
        (part(self.killed), part(self.without_goldens))
    }
}

/// Fewer places than these are told: a score of few mutants says little.
const FEW: usize = 10;

/// A table of the passes, for people.
pub fn table(findings: &[PassFindings]) -> Vec<String> {
    let width = findings.iter().map(|of_pass| of_pass.pass.len()).max().unwrap_or(0);
    let mut lines =
        vec![format!("{:width$}  tests  places  made  killed  without goldens  wrong pass  survived  seconds", "pass")];
    for of_pass in findings {
        let PassFindings { pass, tests, sites, .. } = of_pass;
        let figures = Figures::of([of_pass]);
        let Figures { made, killed, without_goldens, misnamed, survived, .. } = figures;
        let seconds = of_pass.took.as_secs_f64();
        let few = if *sites < FEW { "  (no more mistakes can be made in it)" } else { "" };
        lines.push(if *sites == 0 {
            format!("{pass:width$}  {tests:5}       -  no WGSL of its own: what it does stands in Rust")
        } else {
            format!(
                "{pass:width$}  {tests:5}  {sites:6}  {made:4}  {killed:6}  {without_goldens:15}  {misnamed:10}  {survived:8}  {seconds:7.1}{few}"
            )
        });
    }
    lines
}

/// What became of the mutants of a pass in one line, for people.
pub fn headline(of_pass: &PassFindings) -> String {
    let Figures { made, killed, without_goldens, .. } = Figures::of([of_pass]);
    let seconds = of_pass.took.as_secs_f64();
    format!("{}: {killed} of {made} killed, {without_goldens} without goldens  ({seconds:.1} s)", of_pass.pass)
}

/// What became of all mutants in one line, for people; whether they were shown to goldens, and how long it took.
pub fn summary(findings: &[PassFindings], goldens: bool, took: Duration) -> String {
    let figures = Figures::of(findings);
    let (killed, alone) = figures.percent();
    let Figures { made, misnamed, survived, explained, .. } = figures;
    let all = if goldens { format!("{} killed ({killed:.1} %), ", figures.killed) } else { String::new() };
    format!(
        "{made} mutants of {} passes: {all}{} without goldens ({alone:.1} %), {misnamed} laid at another pass, {survived} survived ({explained} with a reason) in {:.0} s",
        findings.iter().filter(|of_pass| of_pass.sites > 0).count(),
        figures.without_goldens,
        took.as_secs_f64()
    )
}

/// Every mutant of a pass that was not killed, or by goldens only, for people.
pub fn missed(of_pass: &PassFindings) -> Vec<String> {
    let survivors = || of_pass.mutants.iter().filter(|mutant| !mutant.verdict.is_killed());
    let by_goldens =
        || of_pass.mutants.iter().filter(|mutant| mutant.verdict.is_killed() && !mutant.without_goldens.is_killed());
    let mut lines: Vec<String> = survivors().flat_map(mutant_lines).collect();
    for mutant in by_goldens() {
        lines.push(format!("  {}: killed by goldens only", place(mutant)));
        lines.push(format!("    `{}`  {}", mutant.mutation.change, verdict_text(&mutant.without_goldens)));
    }
    lines
}

fn mutant_lines(mutant: &Mutant) -> Vec<String> {
    let mut lines = vec![
        format!("  {}: not killed", place(mutant)),
        format!("    `{}`  {}", mutant.mutation.change, verdict_text(&mutant.verdict)),
    ];
    lines.extend(mutant.reason.as_ref().map(|reason| format!("    reason: {reason}")));
    lines
}

fn place(mutant: &Mutant) -> String {
    let mutation = &mutant.mutation;
    let file = mutation.place.file().unwrap_or(&mutant.file);
    let at = mutation.place.line_column().map(|(line, column)| format!(":{line}:{column}")).unwrap_or_default();
    format!("{file}{at}  {}, {}", mutation.function, mutation.kind.name())
}

fn verdict_text(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Killed { test } => format!("killed by {test}"),
        Verdict::Misnamed { test, named } => format!("{test} fails, and names `{}`", named.join("`, `")),
        Verdict::Untested => "no test runs this pass".to_owned(),
        Verdict::Unreached => "no test reaches it: whatever stands there, no port comes out different".to_owned(),
        Verdict::SameBits => "no port comes out different by a bit, though something else there would show".to_owned(),
        Verdict::Tolerated(Some(Nearest { excess, check })) => {
            format!("within tolerances: the nearest is at {excess:.2} of what {check} allows")
        }
        Verdict::Tolerated(None) => "a port comes out different, and no check asks by how much".to_owned(),
    }
}

/// The same for programs.
pub fn json(seed: u64, findings: &[PassFindings]) -> Value {
    let figures = |figures: Figures| {
        json!({
            "made": figures.made,
            "killed": figures.killed,
            "killed_without_goldens": figures.without_goldens,
            "wrong_pass": figures.misnamed,
            "survived": figures.survived,
            "explained": figures.explained,
        })
    };
    let mutant = |mutant: &Mutant| {
        json!({
            "place": place(mutant),
            "function": mutant.mutation.function,
            "change": mutant.mutation.change,
            "kind": mutant.mutation.kind.name(),
            "killed": mutant.verdict.is_killed(),
            "verdict": verdict_text(&mutant.verdict),
            "killed_without_goldens": mutant.without_goldens.is_killed(),
            "without_goldens": verdict_text(&mutant.without_goldens),
            "reason": mutant.reason,
        })
    };
    let pass = |of_pass: &PassFindings| {
        json!({
            "pass": of_pass.pass,
            "tests": of_pass.tests,
            "places": of_pass.sites,
            "invalid": of_pass.invalid,
            "seconds": of_pass.took.as_secs_f64(),
            "figures": figures(Figures::of([of_pass])),
            "mutants": of_pass.mutants.iter().map(mutant).collect::<Vec<_>>(),
        })
    };
    json!({ "seed": seed, "figures": figures(Figures::of(findings)), "passes": findings.iter().map(pass).collect::<Vec<_>>() })
}
