//! `mutants`: whether image tests notice mistakes.

use std::path::PathBuf;
use std::time::Instant;

use tyndall_mutants::{Figures, Hunt, PassFindings, Trouble, headline, hunt, json, missed, summary, table};
use tyndall_testing::{Session, discover};

use crate::App;
use crate::cli::{Arguments, Mutants};
use crate::failure::Failure;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Mutants) -> Result<(), Failure> {
    let start = Instant::now();
    let here = [PathBuf::from(".")];
    let found = discover(if verb.paths.is_empty() { &here } else { &verb.paths }).map_err(Failure::Usage)?;
    if found.tests.is_empty() {
        return Err(Failure::Usage("no tests found: a test is a file NAME.test.ron".to_owned()));
    }
    let request = Hunt {
        tests: found.tests,
        filter: verb.filter.clone(),
        per_pass: verb.per_pass as usize,
        seed: verb.seed,
        goldens: !verb.no_goldens,
        every_test: verb.every_test,
        untested: verb.paths.is_empty(),
    };
    let search = plugins::search_paths(arguments, &[]);
    let mut session = Session::new(app.plugins.clone(), search, verb.adapter.as_deref())?;
    let (findings, needless) = match hunt(&mut session, &request, &mut print_pass) {
        Ok(findings) => (findings, None),
        Err(Trouble::Needless(findings, needless)) => (findings, Some(needless)),
        Err(trouble) => return Err(failure(trouble)),
    };
    if findings.is_empty() {
        return Err(Failure::Usage(format!("no pass that these tests run has {:?} in its name", verb.filter)));
    }
    terminal::line("");
    table(&findings).iter().for_each(|line| terminal::line(line));
    if let Some(path) = &verb.json {
        tyndall_image::write_bytes(path, format!("{:#}\n", json(verb.seed, &findings)).as_bytes())?;
        terminal::line(&format!("\nwrote {}", path.display()));
    }
    terminal::line(&format!("\n{}", summary(&findings, !verb.no_goldens, start.elapsed())));
    needless.map_or_else(|| enough(verb, &findings), |mistakes| Err(mistakes.into()))
}

/// What became of the mutants of a pass, as soon as it is done.
fn print_pass(of_pass: &PassFindings) {
    terminal::line(&headline(of_pass));
    missed(of_pass).iter().for_each(|line| terminal::line(line));
}

fn failure(trouble: Trouble) -> Failure {
    match trouble {
        Trouble::Failing(outcome) => {
            terminal::line(&format!("FAILED {}", outcome.name()));
            terminal::text(&outcome.text());
            terminal::line("a test fails before anything is changed: make `tyndall test` pass first");
            Failure::Reported(outcome.exit_code())
        }
        Trouble::Error(error) => error.into(),
        Trouble::Needless(_, mistakes) => mistakes.into(),
        Trouble::Unbounded(pass) => Failure::Usage(format!(
            "`{pass}` does not come out the same once its loops are made to end: no mutant of it can be judged"
        )),
    }
}

/// Whether as many are killed as was asked for.
fn enough(verb: &Mutants, findings: &[PassFindings]) -> Result<(), Failure> {
    let (killed, alone) = Figures::of(findings).percent();
    let enough = alone >= verb.at_least_without_goldens && (verb.no_goldens || killed >= verb.at_least);
    if enough { Ok(()) } else { Err(Failure::Reported(1)) }
}
