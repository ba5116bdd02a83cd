//! From tests that pass to what they make of every mutant.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use tyndall_document::Diagnostics;
use tyndall_plugin::{Origin, Registry, RegistryPass};
use tyndall_render::Error;
use tyndall_shader::{Linked, Mutation};
use tyndall_testing::{Options, Outcome, Session};

use crate::draw::Draw;
use crate::findings::{Mutant, PassFindings};
use crate::reasons::Reasons;
use crate::trial::Trials;

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

impl From<Diagnostics> for Trouble {
    fn from(mistakes: Diagnostics) -> Self {
        Trouble::Error(mistakes.into())
    }
}

/// Runs the tests on mutants of every pass; tells of each pass when it is done with it.
///
/// # Errors
/// Tests that fail as they are; reasons for mutants that cannot be made or do not survive.
pub fn hunt(
    session: &mut Session,
    hunt: &Hunt,
    report: &mut dyn FnMut(&PassFindings),
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
        report(&findings);
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
pub(crate) struct Tested {
    pub path: PathBuf,
    /// What it runs with.
    pub registry: Arc<Registry>,
    /// Of the passes that it runs, `plugin.pass`.
    kinds: BTreeSet<String>,
    /// Of all that it renders.
    pub digest: Option<u64>,
    took: Duration,
}

fn baseline(session: &mut Session, hunt: &Hunt) -> Result<Baseline, Trouble> {
    let mut found = Baseline { passes: BTreeMap::new(), tests: Vec::new() };
    for path in &hunt.tests {
        let (registry, kinds) = session.kinds(path)?;
        for pass in registry.passes() {
            found.passes.entry(pass.descriptor.name.clone()).or_insert_with(|| pass.clone());
        }
        if !kinds.iter().any(|kind| kind.contains(&hunt.filter)) {
            continue;
        }
        let options = Options { without_goldens: !hunt.goldens, digest: true, ..Options::default() };
        let outcome = session.run(path, &options);
        if !outcome.passed() {
            return Err(Trouble::Failing(Box::new(outcome)));
        }
        // The second time everything is known that does not change, as it is with mutants.
        let took = session.run(path, &options).took;
        found.tests.push(Tested { path: path.clone(), registry, kinds, digest: outcome.digest, took });
    }
    found.tests.sort_by_key(|test| test.took);
    Ok(found)
}

impl Baseline {
    /// The tests that run a pass, the quickest first.
    fn tests_of(&self, pass: &str) -> Vec<&Tested> {
        self.tests.iter().filter(|test| test.kinds.contains(pass)).collect()
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

fn of_pass(session: &Session, hunt: &Hunt, pass: &RegistryPass, tests: &[&Tested]) -> Result<PassFindings, Trouble> {
    let start = Instant::now();
    let sites = sites(pass);
    let trials = Trials { session, pass, tests, goldens: hunt.goldens, every_test: hunt.every_test };
    let bounds = pass.shaders().map(|(file, shader)| Ok((file, trials.bound(file, shader)?)));
    let bounds = bounds.collect::<Result<BTreeMap<_, _>, Trouble>>()?;
    let places: Vec<_> = sites.iter().map(|site| (site.mutation.function.as_str(), site.mutation.kind)).collect();
    let mut draw = Draw::new(&places, &pass.descriptor.name, hunt.seed);
    let (mut mutants, mut invalid) = (Vec::new(), 0);
    while mutants.len() < hunt.per_pass
        && let Some(drawn) = draw.next()
    {
        let Site { file, shader, mutation } = &sites[drawn];
        if let Some(judged) = trials.run(file, shader, mutation, bounds[file]) {
            mutants.push(Mutant {
                file: (*file).to_owned(),
                mutation: mutation.clone(),
                without_goldens: judged.without_goldens,
                verdict: judged.verdict,
                reason: None,
            });
        } else {
            invalid += 1;
            draw.undo(drawn);
        }
    }
    Ok(PassFindings {
        pass: pass.descriptor.name.clone(),
        tests: tests.len(),
        sites: sites.len(),
        invalid,
        mutants,
        took: start.elapsed(),
    })
}

/// Where a mistake can be made.
struct Site<'a> {
    file: &'a str,
    shader: &'a Linked,
    mutation: Mutation,
}

fn sites(pass: &RegistryPass) -> Vec<Site<'_>> {
    let mut sites = Vec::new();
    for (file, shader) in pass.shaders() {
        sites.extend(shader.mutations().into_iter().map(|mutation| Site { file, shader, mutation }));
    }
    sites
}
