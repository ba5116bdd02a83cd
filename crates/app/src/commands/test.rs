//! `test`: image tests, pass by pass.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use tyndall_document::render_text;
use tyndall_testing::{
    Options, Outcome, Problem, Report, Robustness, Saved, Session, Shared, ShownMistakes, discover, summary,
};

use crate::App;
use crate::cli::{Arguments, Test};
use crate::failure::Failure;
use crate::warnings::Untold;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Test) -> Result<(), Failure> {
    let options = options(verb)?;
    let here = [PathBuf::from(".")];
    let found = discover(if verb.paths.is_empty() { &here } else { &verb.paths }).map_err(Failure::Usage)?;
    let filter = verb.filter.as_deref().unwrap_or_default();
    let chosen: Vec<PathBuf> = found.tests.into_iter().filter(|path| path.to_string_lossy().contains(filter)).collect();
    if chosen.is_empty() {
        let what = if filter.is_empty() { String::new() } else { format!(" whose path contains {filter:?}") };
        terminal::line("0 passed, 0 failed");
        return Err(Failure::Usage(format!("no tests found{what}: a test is a file NAME.test.ron")));
    }
    // Output that cannot be written is refused before anything is rendered.
    if let Some(path) = verb.json.as_ref().filter(|path| path.with_extension("xml") == **path) {
        let path = path.display();
        let why = format!("--json {path}: beside the figures stands JUnit XML of that name; call them .json");
        return Err(Failure::Usage(why));
    }
    let report = verb.report.as_deref().map(Report::begin).transpose()?;
    let mut run = run_all(app, arguments, verb, &chosen, (&options, report.as_ref()))?;
    if filter.is_empty() && verb.tap.is_none() && verb.frame.is_none() {
        for orphan in found.orphans {
            run.keep(orphaned(orphan), report.as_ref())?;
        }
    }
    if run.outcomes.is_empty() {
        terminal::line("0 passed, 0 failed");
        let tap = verb.tap.as_ref().map(|tap| format!(" that matches `{tap}`: ports are `pass.port`"));
        let frame = verb.frame.map(|frame| format!(" in frame {frame}"));
        let (frame, tap) = (frame.unwrap_or_default(), tap.unwrap_or_default());
        return Err(Failure::Usage(format!("no test looks{frame} at a port{tap}")));
    }
    run.outcomes.sort_by(|a, b| a.path.cmp(&b.path));
    let written = write(verb, &run, report);
    let concluded = conclude(&run.outcomes, run.saved);
    written.and(concluded)
}

/// The figures and the report, if they are asked for.
fn write(verb: &Test, run: &Run, report: Option<Report>) -> Result<(), Failure> {
    if let Some(path) = &verb.json {
        let figures = summary::json(&run.adapter, &run.outcomes, run.saved);
        tyndall_image::write_bytes(path, format!("{figures:#}\n").as_bytes())?;
        tyndall_image::write_bytes(&path.with_extension("xml"), summary::junit(&run.outcomes).as_bytes())?;
        terminal::line(&format!("wrote {} and {}", path.display(), path.with_extension("xml").display()));
    }
    if let Some(report) = report {
        let notes = summary::times(&run.outcomes, run.saved);
        let page = report.finish(&run.adapter, &run.outcomes, &notes)?;
        terminal::line(&format!("wrote {}", page.display()));
    }
    Ok(())
}

fn options(verb: &Test) -> Result<Options, Failure> {
    let robustness =
        Robustness { shuffle: verb.shuffle, poison: verb.poison, no_sharing: verb.no_sharing, repeat: verb.repeat };
    let in_part = verb.no_goldens || verb.no_references;
    if verb.isolate && (robustness.any() || verb.size.or(verb.at_most).is_some() || in_part) {
        return Err(Failure::Usage(
            "--isolate runs passes alone from goldens, and cannot be combined with other ways to run".to_owned(),
        ));
    }
    Ok(Options {
        bless: verb.bless,
        bless_any_adapter: verb.any_adapter,
        tap: verb.tap.clone(),
        frame: verb.frame,
        isolate: verb.isolate,
        without_goldens: verb.no_goldens,
        without_references: verb.no_references,
        size: verb.size,
        at_most: verb.at_most,
        robustness,
        for_report: verb.report.is_some(),
        ..Options::default()
    })
}

/// The results of all tests.
#[derive(Default)]
struct Run {
    outcomes: Vec<Outcome>,
    adapter: String,
    saved: Saved,
    shown: ShownMistakes,
}

impl Run {
    /// Prints the result of a test, writes its page, and keeps all but the pictures. A test that looked at nothing, because
    /// none of its ports was asked for, has neither passed nor failed.
    fn keep(&mut self, mut outcome: Outcome, report: Option<&Report>) -> Result<(), tyndall_image::Error> {
        if outcome.ports.is_empty() && outcome.relations.is_empty() && outcome.problems.is_empty() {
            return Ok(());
        }
        print_outcome(&outcome, &mut self.shown);
        let start = Instant::now();
        let written = report.map_or(Ok(()), |report| report.add(&mut outcome));
        self.saved.reporting += start.elapsed();
        outcome.took += start.elapsed();
        outcome.drop_pictures();
        self.outcomes.push(outcome);
        written
    }
}

/// Runs tests in as many threads as asked for, each with a session; those of one graph in one thread, one after another, so
/// that the second finds what the first has rendered.
fn run_all(
    app: &App,
    arguments: &Arguments,
    verb: &Test,
    tests: &[PathBuf],
    (options, report): (&Options, Option<&Report>),
) -> Result<Run, tyndall_image::Error> {
    let groups = groups(tests);
    let next = AtomicUsize::new(0);
    let done = Mutex::new((Run::default(), Ok(())));
    let search = plugins::search_paths(arguments, &[]);
    let shared = Arc::<Shared>::default();
    let work = || {
        let mut session = None;
        while let Some(group) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
            for path in group {
                let plugins = app.plugins.clone();
                let outcome = match session
                    .get_or_insert_with(|| Session::sharing(&shared, plugins, search.clone(), verb.adapter.as_deref()))
                {
                    Ok(session) => session.run(path, options),
                    Err(error) => Outcome {
                        path: path.to_path_buf(),
                        problems: vec![Problem::Machine(error.to_string())],
                        ..Outcome::default()
                    },
                };
                let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
                if let Err(error) = done.0.keep(outcome, report) {
                    // A report that cannot be written ends the run.
                    next.store(groups.len(), Ordering::Relaxed);
                    done.1 = Err(error);
                    return;
                }
            }
        }
        if let Some(Ok(session)) = session {
            let done = &mut done.lock().unwrap_or_else(PoisonError::into_inner).0;
            done.adapter.clone_from(&session.gpu().info.name);
            done.saved += session.saved;
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..verb.jobs {
            scope.spawn(work);
        }
        work();
    });
    let (run, written) = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    written.map(|()| run)
}

/// Tests by the graph that they name, as far as a quick look at the file shows.
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

/// A folder of goldens that does not belong to any test.
fn orphaned(folder: PathBuf) -> Outcome {
    Outcome { path: folder.clone(), problems: vec![Problem::Orphan(folder)], ..Outcome::default() }
}

fn print_outcome(outcome: &Outcome, earlier: &mut ShownMistakes) {
    let took = outcome.took.as_secs_f64() * 1e3;
    let word = match outcome.passed() {
        true if outcome.checked_nothing() => "NONE  ",
        true => "ok    ",
        false => "FAILED",
    };
    terminal::line(&format!("{word} {}  ({took:.0} ms)", outcome.name()));
    if outcome.checked_nothing() {
        terminal::line(&format!("  {}", summary::NOTHING));
    }
    for line in &outcome.blessed {
        terminal::line(&format!("  {line}"));
    }
    let stale = outcome.ports.iter().filter(|port| port.passed() && !port.stale.is_empty()).count();
    if stale > 0 {
        let are = if stale == 1 { "golden is" } else { "goldens are" };
        terminal::line(&format!("  {stale} {are} stale, and still right: --bless renews what is"));
    }
    for line in &outcome.left_out {
        terminal::line(&format!("  left out: {line}"));
    }
    let warnings = Untold::of_models().without(outcome.warnings.clone());
    if !warnings.is_empty() {
        terminal::error(&render_text(&warnings, terminal::color()));
    }
    terminal::text(&earlier.text(outcome));
}

/// The slowest tests, what took time, and the last line. Tests that checked nothing count neither way; if no other ran, that
/// is a failure.
fn conclude(outcomes: &[Outcome], saved: Saved) -> Result<(), Failure> {
    let [passed, failed, nothing] = summary::counts(outcomes);
    if outcomes.len() > 1 {
        terminal::line("\nslowest:");
        summary::slowest(outcomes).iter().for_each(|line| terminal::line(line));
        summary::times(outcomes, saved).iter().for_each(|line| terminal::line(line));
    }
    if nothing > 0 {
        terminal::line(&format!("{nothing} of {} tests checked nothing", outcomes.len()));
    }
    terminal::line(&format!("{passed} passed, {failed} failed"));
    if nothing == outcomes.len() {
        return Err(Failure::Usage(format!("no test has checked anything: {}", summary::NOTHING)));
    }
    match outcomes.iter().map(Outcome::exit_code).max() {
        Some(0) | None => Ok(()),
        Some(code) => Err(Failure::Reported(code)),
    }
}
