//! `test`: image tests, pass by pass.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use tyndall_document::render_text;
use tyndall_testing::{Options, Outcome, Problem, Robustness, Saved, Session, discover, report, summary};

use crate::App;
use crate::cli::{Arguments, Test};
use crate::failure::Failure;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Test) -> Result<(), Failure> {
    let options = options(verb)?;
    let here = [PathBuf::from(".")];
    let found = discover(if verb.paths.is_empty() { &here } else { &verb.paths }).map_err(Failure::Usage)?;
    let filter = verb.filter.as_deref().unwrap_or_default();
    let chosen: Vec<PathBuf> = found.tests.into_iter().filter(|path| path.to_string_lossy().contains(filter)).collect();
    if chosen.is_empty() {
        let what = if filter.is_empty() { String::new() } else { format!(" whose path holds {filter:?}") };
        terminal::line("0 passed, 0 failed");
        return Err(Failure::Usage(format!("there is no test{what}: a test is a file NAME.test.ron")));
    }
    let run = run_all(app, arguments, verb, &chosen, &options);
    let mut outcomes = run.outcomes;
    if filter.is_empty() && verb.tap.is_none() {
        outcomes.extend(found.orphans.into_iter().map(orphaned));
    }
    if let Some(path) = &verb.json {
        let figures = summary::json(&run.adapter, &outcomes, run.saved);
        tyndall_image::write_bytes(path, format!("{figures:#}\n").as_bytes())?;
        tyndall_image::write_bytes(&path.with_extension("xml"), summary::junit(&outcomes).as_bytes())?;
        terminal::line(&format!("wrote {} and {}", path.display(), path.with_extension("xml").display()));
    }
    if let Some(folder) = &verb.report {
        let start = Instant::now();
        let page = report::write(folder, &run.adapter, &outcomes).map_err(Failure::Usage)?;
        terminal::line(&format!("wrote {} in {:.1} s", page.display(), start.elapsed().as_secs_f64()));
    }
    conclude(&outcomes, run.saved)
}

fn options(verb: &Test) -> Result<Options, Failure> {
    let robustness =
        Robustness { shuffle: verb.shuffle, poison: verb.poison, no_sharing: verb.no_sharing, repeat: verb.repeat };
    if verb.isolate && (robustness.any() || verb.size.is_some() || verb.no_goldens) {
        return Err(Failure::Usage(
            "--isolate runs passes alone from goldens: it goes with no other way to run".to_owned(),
        ));
    }
    Ok(Options {
        bless: verb.bless,
        bless_any_adapter: verb.any_adapter,
        tap: verb.tap.clone(),
        isolate: verb.isolate,
        without_goldens: verb.no_goldens,
        until_failure: false,
        size: verb.size,
        robustness,
        for_report: verb.report.is_some(),
    })
}

/// What all tests found.
struct Run {
    outcomes: Vec<Outcome>,
    adapter: String,
    saved: Saved,
}

/// Runs tests in so many threads as asked for; those of one graph in one thread, since they share results.
fn run_all(app: &App, arguments: &Arguments, verb: &Test, tests: &[PathBuf], options: &Options) -> Run {
    let groups = groups(tests);
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Run { outcomes: Vec::new(), adapter: String::new(), saved: Saved::default() });
    let search = plugins::search_paths(arguments, &[]);
    let work = || {
        let mut session = None;
        while let Some(group) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
            for path in group {
                let plugins = app.plugins.clone();
                let outcome = match session
                    .get_or_insert_with(|| Session::new(plugins, search.clone(), verb.adapter.as_deref()))
                {
                    Ok(session) => session.run(path, options),
                    Err(error) => Outcome {
                        path: path.to_path_buf(),
                        problems: vec![Problem::Machine(error.to_string())],
                        ..Outcome::default()
                    },
                };
                let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                told(&outcome);
                done.outcomes.push(outcome);
            }
        }
        if let Some(Ok(session)) = session {
            let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            done.adapter.clone_from(&session.gpu().info.name);
            done.saved.passes += session.saved.passes;
            done.saved.spared += session.saved.spared;
            done.saved.rendering += session.saved.rendering;
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..verb.jobs {
            scope.spawn(work);
        }
        work();
    });
    let mut run = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    run.outcomes.sort_by(|a, b| a.path.cmp(&b.path));
    run
}

/// Tests by the graph that they name, as far as a glance at the file tells.
fn groups(tests: &[PathBuf]) -> Vec<Vec<&Path>> {
    let mut groups: BTreeMap<String, Vec<&Path>> = BTreeMap::new();
    for path in tests {
        let graph = std::fs::read_to_string(path).ok().and_then(|text| {
            let line = text.lines().find(|line| line.trim_start().starts_with("graph:"))?;
            Some(line.trim().to_owned())
        });
        let folder = path.parent().unwrap_or(Path::new("")).display();
        groups.entry(format!("{folder} {}", graph.unwrap_or_default())).or_default().push(path);
    }
    groups.into_values().collect()
}

/// A folder of goldens that belongs to no test.
fn orphaned(folder: PathBuf) -> Outcome {
    let outcome = Outcome { path: folder.clone(), problems: vec![Problem::Orphan(folder)], ..Outcome::default() };
    told(&outcome);
    outcome
}

fn told(outcome: &Outcome) {
    let took = outcome.took.as_secs_f64() * 1e3;
    let word = if outcome.passed() { "ok    " } else { "FAILED" };
    terminal::line(&format!("{word} {}  ({took:.0} ms)", outcome.name()));
    for line in &outcome.blessed {
        terminal::line(&format!("  {line}"));
    }
    let stale = outcome.ports.iter().filter(|port| port.passed() && !port.stale.is_empty()).count();
    if stale > 0 {
        terminal::line(&format!("  {stale} goldens are stale, and still right: --bless renews them"));
    }
    if !outcome.warnings.is_empty() {
        terminal::error(&render_text(&outcome.warnings, terminal::color()));
    }
    terminal::text(&outcome.text());
}

/// The slowest tests, what sharing saved, and the last line.
fn conclude(outcomes: &[Outcome], saved: Saved) -> Result<(), Failure> {
    let failed = outcomes.iter().filter(|outcome| !outcome.passed()).count();
    if outcomes.len() > 1 {
        terminal::line("\nslowest:");
        summary::slowest(outcomes).iter().for_each(|line| terminal::line(line));
        let Saved { passes, spared, rendering } = saved;
        terminal::line(&format!(
            "sharing spared {spared} of {passes} runs of passes; {:.1} s of rendering",
            rendering.as_secs_f64()
        ));
    }
    terminal::line(&format!("{} passed, {failed} failed", outcomes.len() - failed));
    match outcomes.iter().map(Outcome::exit_code).max() {
        Some(0) | None => Ok(()),
        Some(code) => Err(Failure::Told(code)),
    }
}
