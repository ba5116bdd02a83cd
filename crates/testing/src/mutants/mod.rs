//! Mutants: whether the tests notice mistakes, and lay them at the right door.
//!
//! Of every pass a few shaders are made that differ from the right one in a single place ([`Mutation`]), and the tests
//! that run the pass are run with each, the quickest first. A mutant is *killed* where a test fails and every pass that
//! it names is the pass that was changed. One that makes a test blame another pass is *misnamed*; one that no test
//! notices *survives*, and is said why: nothing depends on the place, no bit changes, or all stays within tolerances.
//!
//! Goldens are a record of what was; properties, references on the CPU and relations say what is right. So each mutant
//! is first shown to these alone, and only where they do not kill it to the goldens as well.

mod draw;
mod figures;
mod reasons;
mod trial;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use tyndall_document::Diagnostics;
use tyndall_plugin::{Origin, RegistryPass};
use tyndall_render::Error;
use tyndall_shader::{Linked, Mutation};

pub use figures::{Figures, json, missed, table};
pub use reasons::REASONS;

use crate::options::Options;
use crate::outcome::Outcome;
use crate::session::Session;
use draw::Draw;
use reasons::Reasons;
use trial::{Trial, Trials};

/// Which mutants are made, and which tests run.
#[derive(Debug, Clone)]
pub struct Hunt {
    /// Test files.
    pub tests: Vec<PathBuf>,
    /// Only passes (`plugin.pass`) whose name holds this.
    pub filter: String,
    /// So many mutants of each pass; fewer where fewer mistakes can be made in it.
    pub per_pass: usize,
    /// Draws the mutants.
    pub seed: u64,
    /// Show mutants to goldens too.
    pub goldens: bool,
    /// Show each mutant to every test, with goldens and without, though one of them kills it: another may lay it at another
    /// pass.
    pub every_test: bool,
    /// Also report passes that no test runs.
    pub untested: bool,
}

/// What became of the mutants of a pass.
#[derive(Debug)]
pub struct PassFindings {
    /// `plugin.pass`.
    pub pass: String,
    /// Tests that run it.
    pub tests: usize,
    /// Mistakes that can be made in its shaders; 0 where it has none.
    pub sites: usize,
    /// Drawn mistakes that no compiler or driver takes, and which do not count.
    pub invalid: usize,
    /// The mutants.
    pub mutants: Vec<Mutant>,
    /// Time for all of them.
    pub took: Duration,
}

/// One mutant, and what became of it.
#[derive(Debug)]
pub struct Mutant {
    /// The shader's file.
    pub file: String,
    /// What was changed.
    pub mutation: Mutation,
    /// By properties, references and relations alone.
    pub without_goldens: Verdict,
    /// By everything; what they alone found where they killed it, or where goldens are left out.
    pub verdict: Verdict,
    /// Why it survives, as somebody wrote it down.
    pub reason: Option<String>,
}

/// What became of a mutant.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// A test fails, and names the pass.
    Killed {
        /// The test.
        test: String,
    },
    /// A test fails, and names other passes.
    Misnamed {
        /// The test.
        test: String,
        /// The passes that it names, by their kinds.
        named: Vec<String>,
    },
    /// No test runs the pass.
    Untested,
    /// Whatever stands in the place, no port comes out different.
    Unreached,
    /// No port comes out different, though something else in the place would show.
    SameBits,
    /// Ports come out different, within what tests allow; and the check that came nearest, if any asks by how much.
    Tolerated(Option<Nearest>),
}

/// The check that came nearest to a failure.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// The part of its tolerance that was used up.
    pub excess: f64,
    /// What it asks of which port of which test.
    pub check: String,
}

impl Verdict {
    /// It is killed.
    pub fn is_killed(&self) -> bool {
        matches!(self, Verdict::Killed { .. })
    }
}

/// Why mutants could not be made or judged.
#[derive(Debug)]
pub enum Trouble {
    /// A test fails before anything is changed.
    Failing(Box<Outcome>),
    /// A graph, a plugin, a file of reasons, or the machine.
    Error(Error),
    /// A pass does not come out the same once its loops are made to end.
    Unbounded(String),
    /// All mutants were judged, and there are reasons for such as are killed.
    Needless(Vec<PassFindings>, Diagnostics),
}

impl From<Error> for Trouble {
    fn from(error: Error) -> Self {
        Trouble::Error(error)
    }
}

/// Runs the tests on mutants of every pass; tells of each pass when it is done with it.
///
/// # Errors
/// Tests that fail as they are; reasons for mutants that cannot be made or do not survive.
pub fn hunt(
    session: &mut Session,
    hunt: &Hunt,
    told: &mut dyn FnMut(&PassFindings),
) -> Result<Vec<PassFindings>, Trouble> {
    let baseline = baseline(session, hunt)?;
    let mut reasons = Reasons::default();
    for folder in baseline.folders() {
        reasons.read(&folder)?;
    }
    reasons.refuse_unknown(&|pass, function, change| baseline.can_be_made(pass, function, change))?;
    let mut all = Vec::new();
    for pass in baseline.passes.values().filter(|pass| pass.descriptor.name.contains(&hunt.filter)) {
        let tests = baseline.tests_of(&pass.descriptor.name);
        if tests.is_empty() && !hunt.untested {
            continue;
        }
        let mut findings = of_pass(session, hunt, pass, &tests)?;
        for mutant in &mut findings.mutants {
            let Mutation { function, change, .. } = &mutant.mutation;
            mutant.reason = reasons.of(&findings.pass, function, change, mutant.verdict.is_killed());
        }
        told(&findings);
        all.push(findings);
    }
    match reasons.refuse_needless() {
        Ok(()) => Ok(all),
        Err(needless) => Err(Trouble::Needless(all, needless)),
    }
}

/// The tests as they are: all must pass.
struct Baseline {
    passes: BTreeMap<String, RegistryPass>,
    tests: Vec<Tested>,
}

/// A test that passes.
struct Tested {
    path: PathBuf,
    kinds: BTreeSet<String>,
    took: Duration,
}

fn baseline(session: &mut Session, hunt: &Hunt) -> Result<Baseline, Trouble> {
    let mut found = Baseline { passes: BTreeMap::new(), tests: Vec::new() };
    for path in &hunt.tests {
        let (registry, kinds) = session.runs(path)?;
        for pass in registry.passes() {
            found.passes.entry(pass.descriptor.name.clone()).or_insert_with(|| pass.clone());
        }
        if !kinds.iter().any(|kind| kind.contains(&hunt.filter)) {
            continue;
        }
        let outcome = session.run(path, &Options { without_goldens: !hunt.goldens, ..Options::default() });
        if !outcome.passed() {
            return Err(Trouble::Failing(Box::new(outcome)));
        }
        // The second time everything is known that does not change, as it is with mutants.
        let again = session.run(path, &Options { without_goldens: !hunt.goldens, ..Options::default() });
        found.tests.push(Tested { path: path.clone(), kinds, took: again.took });
    }
    found.tests.sort_by_key(|test| test.took);
    Ok(found)
}

impl Baseline {
    /// The tests that run a pass, the quickest first.
    fn tests_of(&self, pass: &str) -> Vec<&Path> {
        self.tests.iter().filter(|test| test.kinds.contains(pass)).map(|test| test.path.as_path()).collect()
    }

    /// The folders of the plugins.
    fn folders(&self) -> BTreeSet<PathBuf> {
        let folder = |pass: &RegistryPass| match &pass.origin {
            Origin::Folder(path) => Some(path.clone()),
            Origin::BuiltIn => None,
        };
        self.passes.values().filter_map(folder).collect()
    }

    fn can_be_made(&self, pass: &str, function: &str, change: &str) -> bool {
        let Some(pass) = self.passes.get(pass) else { return false };
        let is = |mutation: &Mutation| mutation.function == function && mutation.change == change;
        pass.shaders().any(|(_, shader)| shader.mutations().iter().any(is))
    }
}

fn of_pass(session: &mut Session, hunt: &Hunt, pass: &RegistryPass, tests: &[&Path]) -> Result<PassFindings, Trouble> {
    let start = Instant::now();
    let name = pass.descriptor.name.clone();
    let sites: Vec<(String, Arc<Linked>, Mutation)> = pass
        .shaders()
        .flat_map(|(file, shader)| {
            shader.mutations().into_iter().map(move |mutation| (file.to_owned(), shader.clone(), mutation))
        })
        .collect();
    let mut findings = PassFindings {
        pass: name.clone(),
        tests: tests.len(),
        sites: sites.len(),
        invalid: 0,
        mutants: Vec::new(),
        took: start.elapsed(),
    };
    let places: Vec<_> = sites.iter().map(|(_, _, mutation)| (mutation.function.as_str(), mutation.kind)).collect();
    let mut draw = Draw::new(&places, &name, hunt.seed);
    let mut trials = Trials {
        session,
        pass: &name,
        fingerprint: pass.fingerprint,
        tests,
        goldens: hunt.goldens,
        every_test: hunt.every_test,
    };
    let bounds = pass.shaders().map(|(file, shader)| Ok((file.to_owned(), trials.bound(file, shader)?)));
    let bounds = bounds.collect::<Result<BTreeMap<_, _>, Trouble>>()?;
    while findings.mutants.len() < hunt.per_pass
        && let Some(site) = draw.next()
    {
        let (file, shader, mutation) = &sites[site];
        match trials.run(file, shader, mutation, bounds[file])? {
            Trial::Invalid => {
                findings.invalid += 1;
                draw.undo(site);
            }
            Trial::Judged { without_goldens, verdict } => findings.mutants.push(Mutant {
                file: file.clone(),
                mutation: mutation.clone(),
                without_goldens,
                verdict,
                reason: None,
            }),
        }
    }
    findings.took = start.elapsed();
    Ok(findings)
}

impl From<Diagnostics> for Trouble {
    fn from(mistakes: Diagnostics) -> Self {
        Trouble::Error(mistakes.into())
    }
}
