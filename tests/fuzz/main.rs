//! Breaks files for as long as it is told to, and sees that each is read, drawn or refused: `cargo xtask fuzz` runs it.
//!
//! Files of the repository are what it starts from (`corpus.rs`). They are broken by their structure (`structure.rs`), so that
//! most of them get past the parser, and byte by byte. What panics, or takes longer than [`SLOW`], is a find: it is
//! written to the folder of finds, and the run goes on. The case that is at work is on disk before it begins, so that one that ends the
//! process can be found there.

#![allow(clippy::unwrap_used, reason = "what cannot be set up ends the run")]
#![allow(clippy::print_stdout, reason = "a command-line tool prints to standard output")]

mod cases;
mod corpus;
mod structure;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use cases::{Bench, Case, End};
use corpus::{Corpus, KINDS, Kind};
use tyndall_tests::broken::Random;

/// A case that takes longer is a find. Machines that are busy with other things take long, too.
const SLOW: Duration = Duration::from_secs(20);
/// A case that takes longer ends the run: its thread is lost.
const LOST: Duration = Duration::from_secs(120);
/// Of so many cases one is drawn, where enough are sound.
const DRAWN_OF: u64 = 50;
/// Finds after which a run ends.
const MOST_FINDS: usize = 50;

const USAGE: &str = "\
Usage: tyndall-fuzz --seconds N [--seed SEED] [--cases N] [--kind KIND] [--finds DIR]

  --seconds  how long to go on
  --seed     chooses the cases; by default another one each time
  --cases    ends after so many cases
  --kind     only one kind of file: graph, scene, model, picture, manifest, shader, test
  --finds    the folder for finds, by default target/fuzz";

/// What a command line asks for.
struct Wanted {
    until: Instant,
    seed: u64,
    cases: u64,
    kinds: Vec<Kind>,
    finds: PathBuf,
}

/// What all threads count.
#[derive(Default)]
struct Tally {
    cases: AtomicU64,
    drawn: AtomicU64,
    /// Cases and those that were refused, of each kind.
    kinds: Mutex<BTreeMap<&'static str, [u64; 2]>>,
    /// Messages of finds, each once.
    finds: Mutex<BTreeMap<String, PathBuf>>,
    /// When each thread began its case; none where it is done.
    began: Mutex<BTreeMap<u64, Instant>>,
}

thread_local! {
    /// What the last panic of this thread said.
    static SAID: RefCell<String> = const { RefCell::new(String::new()) };
}

fn main() -> ExitCode {
    let wanted = match wanted(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(wanted) => wanted,
        Err(message) => {
            eprintln!("error: {message}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    std::panic::set_hook(Box::new(|info| SAID.with(|said| *said.borrow_mut() = info.to_string())));
    let (corpus, tally) = (Corpus::of_repository(), Tally::default());
    println!("seed {}, {} files to start from", wanted.seed, corpus.len());
    let start = Instant::now();
    std::thread::scope(|scope| {
        scope.spawn(|| watch(&wanted, &tally));
        for thread in 0..std::thread::available_parallelism().map_or(1, usize::from) as u64 {
            let (wanted, corpus, tally) = (&wanted, &corpus, &tally);
            scope.spawn(move || work(thread, wanted, corpus, tally));
        }
    });
    report(&tally, start.elapsed())
}

fn wanted(arguments: &[String]) -> Result<Wanted, String> {
    let clock = std::time::UNIX_EPOCH.elapsed().map_or(1, |since| since.as_nanos() as u64);
    let finds = tyndall_tests::root().join("target/fuzz");
    let mut wanted = Wanted { until: Instant::now(), seed: clock, cases: u64::MAX, kinds: KINDS.to_vec(), finds };
    let mut seconds = None;
    for pair in arguments.chunks(2) {
        let [option, value] = pair else { return Err(format!("`{}` needs a value", pair[0])) };
        let number = || value.parse::<u64>().map_err(|_| format!("{option} must be a whole number, got `{value}`"));
        match option.as_str() {
            "--seconds" => seconds = Some(number()?),
            "--seed" => wanted.seed = number()?,
            "--cases" => wanted.cases = number()?,
            "--finds" => wanted.finds = PathBuf::from(value),
            "--kind" => {
                let kind = KINDS.into_iter().find(|kind| kind.name() == value);
                wanted.kinds = vec![kind.ok_or_else(|| format!("unknown kind `{value}`"))?];
            }
            _ => return Err(format!("unknown option `{option}`")),
        }
    }
    let seconds = seconds.ok_or("--seconds is missing")?;
    wanted.until += Duration::from_secs(seconds.min(1_000_000));
    Ok(wanted)
}

/// Ends the process where a case does not end; the folder of what is at work holds it.
fn watch(wanted: &Wanted, tally: &Tally) {
    let is_over = || Instant::now() >= wanted.until || tally.cases.load(Relaxed) >= wanted.cases;
    while !is_over() || !tally.began.lock().unwrap().is_empty() {
        std::thread::sleep(Duration::from_millis(100));
        let lost =
            tally.began.lock().unwrap().iter().find(|(_, began)| began.elapsed() > LOST).map(|(thread, _)| *thread);
        if let Some(thread) = lost {
            println!("{}: takes more than {LOST:.0?}", wanted.finds.join(format!("at-work-{thread}")).display());
            std::process::exit(4);
        }
    }
}

fn work(thread: u64, wanted: &Wanted, corpus: &Corpus, tally: &Tally) {
    // xorshift must not begin at 0
    let mut random = Random((wanted.seed ^ (thread + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)) | 1);
    let mut bench = Bench::new(&wanted.finds.join(format!("at-work-{thread}")));
    while Instant::now() < wanted.until && tally.cases.load(Relaxed) < wanted.cases {
        let kind = wanted.kinds[random.below(wanted.kinds.len())];
        let case = bench.put(Case::new(kind, corpus, &mut random));
        let cases = tally.cases.fetch_add(1, Relaxed) + 1;
        let draws = tally.drawn.load(Relaxed) < cases / DRAWN_OF;
        let start = Instant::now();
        tally.began.lock().unwrap().insert(thread, start);
        let ended = catch_unwind(AssertUnwindSafe(|| bench.run(&case, draws)));
        tally.began.lock().unwrap().remove(&thread);
        let refused = matches!(ended, Ok(End::Refused));
        tally.drawn.fetch_add(u64::from(matches!(ended, Ok(End::Drawn))), Relaxed);
        let mut kinds = tally.kinds.lock().unwrap();
        let counts = kinds.entry(kind.name()).or_default();
        *counts = [counts[0] + 1, counts[1] + u64::from(refused)];
        drop(kinds);
        let found = match ended {
            Err(_) => Some(SAID.with(|said| said.borrow().clone())),
            Ok(_) if start.elapsed() > SLOW => Some(format!("{} takes {:.0?}", kind.name(), start.elapsed())),
            Ok(_) => None,
        };
        if let Some(message) = found {
            keep(tally, &wanted.finds, &case, &message);
            bench = Bench::new(&wanted.finds.join(format!("at-work-{thread}")));
        }
        if tally.finds.lock().unwrap().len() >= MOST_FINDS {
            return;
        }
    }
}

/// A find goes to a folder of its own, the first of each message.
fn keep(tally: &Tally, folder: &Path, case: &Case, message: &str) {
    let mut finds = tally.finds.lock().unwrap();
    // where it is said, and not about which file
    let place = message.lines().next().unwrap_or_default().to_owned();
    if finds.contains_key(&place) {
        return;
    }
    let kept = folder.join(format!("find-{}", finds.len() + 1));
    std::fs::create_dir_all(&kept).unwrap();
    std::fs::write(kept.join(case.file), &case.bytes).unwrap();
    std::fs::write(kept.join("message.txt"), message).unwrap();
    println!("{}: {message}", kept.join(case.file).display());
    finds.insert(place, kept);
}

fn report(tally: &Tally, time: Duration) -> ExitCode {
    for (kind, [cases, refused]) in &*tally.kinds.lock().unwrap() {
        println!("{kind:9} {cases:9} cases, {refused:9} refused");
    }
    let (cases, finds) = (tally.cases.load(Relaxed), tally.finds.lock().unwrap().len());
    println!("{cases} cases in {time:.0?}, {} drawn, {finds} finds", tally.drawn.load(Relaxed));
    if finds == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
