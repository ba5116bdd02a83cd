//! What a test found.

use std::path::PathBuf;
use std::time::Duration;

use tyndall_document::{Diagnostics, render_text};

use crate::metric::{Judgement, Metric};
use crate::picture::Picture;

/// What a test found.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Path of the test file.
    pub path: PathBuf,
    /// What the test is for.
    pub about: String,
    /// Path of the graph.
    pub graph: PathBuf,
    /// Every port that was looked at, in the order in which the passes ran, frame by frame.
    pub ports: Vec<PortOutcome>,
    /// How ports change from run to run.
    pub relations: Vec<RelationOutcome>,
    /// What came out different in another order, with other memory, or when it was done again.
    pub robustness: Vec<String>,
    /// What the passes that are named were made from, and nothing holds.
    pub suspicions: Vec<Suspicion>,
    /// What the test says and was not asked, with the reason.
    pub left_out: Vec<String>,
    /// What stood in the way of judging, and goldens that nobody claims.
    pub problems: Vec<Problem>,
    /// Mistakes that leave a meaning.
    pub warnings: Diagnostics,
    /// Goldens that were written, with what changed.
    pub blessed: Vec<String>,
    /// The passes that ran, in order.
    pub passes: Vec<PassOutcome>,
    /// Wall-clock time.
    pub took: Duration,
    /// Name of its page in a report, without the suffix; empty where there is no report.
    pub page: String,
}

/// A pass that ran.
#[derive(Debug, Clone, PartialEq)]
pub struct PassOutcome {
    /// Its name in the graph.
    pub name: String,
    /// Its kind: `plugin.pass`.
    pub kind: String,
    /// The passes that it reads.
    pub reads: Vec<String>,
    /// Bytes of what it writes.
    pub bytes: u64,
    /// GPU time alone, where it was measured.
    pub microseconds: Option<f64>,
}

/// Ports that a pass at fault was made from, and in which no check holds every number: the mistake may be there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Suspicion {
    /// The pass that is named.
    pub pass: String,
    /// `pass.port`, in the order in which the passes ran.
    pub unheld: Vec<String>,
}

/// What stood in the way of judging.
#[derive(Debug)]
pub enum Problem {
    /// The test file, its graph or its scene is wrong.
    Mistakes(Diagnostics),
    /// The machine cannot do it.
    Machine(String),
    /// A golden that no tap claims.
    Orphan(PathBuf),
    /// A golden could not be written.
    NotBlessed(String),
    /// A pass could not be run alone.
    NotIsolated(String),
}

/// What was found about a port in a frame.
#[derive(Debug)]
pub struct PortOutcome {
    /// `pass.port`.
    pub name: String,
    /// The pass that writes it.
    pub pass: String,
    /// Its kind: `plugin.pass`.
    pub kind: String,
    /// The frame.
    pub frame: u32,
    /// The name of its golden.
    pub key: String,
    /// Everything that was asked.
    pub checks: Vec<Check>,
    /// Whose fault it is.
    pub state: State,
    /// What has changed since its golden was made.
    pub stale: Vec<&'static str>,
    /// What was rendered; kept where somebody wants to see it.
    pub actual: Option<Picture>,
    /// Its golden; kept where somebody wants to see it.
    pub expected: Option<Picture>,
    /// How far from its golden it may be, where it has one.
    pub metric: Option<Metric>,
}

/// Whose fault it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// Everything holds.
    Passed,
    /// Something does not hold, and everything that the pass reads holds.
    Guilty,
    /// Something does not hold, and neither does something that the pass reads.
    Inherited,
    /// What it was to be held against is missing, and that alone does not hold.
    Unjudged,
}

/// One thing that was asked of a port.
#[derive(Debug)]
pub struct Check {
    /// What: `golden`, `finite`.
    pub what: String,
    /// What was found.
    pub judgement: Judgement,
    /// How much it says of the port.
    pub reach: Reach,
    /// Other passes that it depends on, beside those upstream.
    pub also_on: Vec<String>,
}

/// How much a check says of a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// What every number is: a golden, another renderer's picture, the reference on the CPU, other ports.
    EveryNumber,
    /// Something about the numbers, such as their range.
    Something,
    /// Nothing, since what it compares with is missing.
    Nothing,
}

/// What was found about a relation and a port.
#[derive(Debug)]
pub struct RelationOutcome {
    /// What the relation says.
    pub about: String,
    /// `pass.port`.
    pub port: String,
    /// The pass that writes it.
    pub pass: String,
    /// What was found.
    pub judgement: Judgement,
    /// Whose fault it is.
    pub state: State,
}

impl PortOutcome {
    /// Everything holds.
    pub fn passed(&self) -> bool {
        self.checks.iter().all(|check| check.judgement.passed)
    }
}

impl Outcome {
    /// Everything holds and nothing stood in the way.
    pub fn passed(&self) -> bool {
        self.problems.is_empty()
            && self.robustness.is_empty()
            && self.ports.iter().all(PortOutcome::passed)
            && self.relations.iter().all(|relation| relation.judgement.passed)
    }

    /// 0 passed, 1 something does not hold, 2 the input is wrong, 3 the machine cannot do it.
    pub fn exit_code(&self) -> u8 {
        let of_problem = |problem: &Problem| match problem {
            Problem::Mistakes(_) => 2,
            Problem::Machine(_) => 3,
            Problem::Orphan(_) | Problem::NotBlessed(_) | Problem::NotIsolated(_) => 1,
        };
        let problems = self.problems.iter().map(of_problem).max().unwrap_or(0);
        problems.max(u8::from(!self.passed()))
    }

    /// The passes whose fault it is, in the order in which they run.
    pub fn guilty(&self) -> Vec<&str> {
        self.passes_in(State::Guilty)
    }

    /// The passes that fail because of others, in the order in which they run.
    pub fn inherited(&self) -> Vec<&str> {
        let guilty = self.guilty();
        self.passes_in(State::Inherited).into_iter().filter(|pass| !guilty.contains(pass)).collect()
    }

    fn passes_in(&self, state: State) -> Vec<&str> {
        let ports = self.ports.iter().filter(|port| port.state == state).map(|port| port.pass.as_str());
        let relations =
            self.relations.iter().filter(|relation| relation.state == state).map(|relation| relation.pass.as_str());
        let failing: Vec<&str> = ports.chain(relations).collect();
        let order = self.passes.iter().map(|pass| pass.name.as_str());
        order.filter(|pass| failing.contains(pass)).collect()
    }

    /// The name of the test: its path without `.test.ron`.
    pub fn name(&self) -> String {
        let path = self.path.display().to_string();
        path.strip_suffix(crate::file::SUFFIX).unwrap_or(&path).to_owned()
    }

    /// Lets go of the pictures of its ports.
    pub fn drop_pictures(&mut self) {
        self.ports.iter_mut().for_each(|port| (port.actual, port.expected) = (None, None));
    }

    /// What a person reads about a failed test.
    pub fn text(&self) -> String {
        self.text_with(&mut |mistakes| render_text(mistakes, false).trim_end().to_owned() + "\n")
    }

    /// The same, with the mistakes of files as `of_mistakes` tells them.
    pub(crate) fn text_with(&self, of_mistakes: &mut dyn FnMut(&Diagnostics) -> String) -> String {
        let mut text = String::new();
        for problem in &self.problems {
            text += &match problem {
                Problem::Mistakes(mistakes) => of_mistakes(mistakes),
                Problem::Machine(why) => format!("  cannot run: {why}\n"),
                Problem::Orphan(path) => {
                    format!("  no tap claims the golden `{}`: delete it, or bless to drop it\n", path.display())
                }
                Problem::NotBlessed(why) => format!("  not blessed: {why}\n"),
                Problem::NotIsolated(why) => format!("  cannot run a pass alone: {why}\n"),
            };
        }
        if let Some(first) = self.guilty().first() {
            let kind = self.ports.iter().find(|port| port.pass == *first).map_or("", |port| port.kind.as_str());
            text += &format!(
                "  first diverging pass: `{first}`{}\n",
                if kind.is_empty() { String::new() } else { format!(" ({kind})") }
            );
            if let Some(Suspicion { unheld, .. }) = self.suspicions.iter().find(|suspicion| suspicion.pass == *first) {
                let ports = unheld.join("`, `");
                text +=
                    &format!("    or what it was made from: nothing holds `{ports}`; a golden or CpuReference would\n");
            }
        }
        let to_tell = |state| matches!(state, State::Guilty | State::Unjudged);
        for port in self.ports.iter().filter(|port| to_tell(port.state)) {
            text += &self.port_text(port);
        }
        for relation in self.relations.iter().filter(|relation| relation.state == State::Guilty) {
            text += &format!("    {}  {}: {}\n", relation.port, relation.about, relation.judgement.figures);
        }
        let inherited = self.inherited();
        if !inherited.is_empty() {
            text += &format!("  inherited: `{}`\n", inherited.join("`, `"));
        }
        for line in &self.robustness {
            text += &format!("  {line}\n");
        }
        text
    }

    fn port_text(&self, port: &PortOutcome) -> String {
        let mut text = String::new();
        for check in port.checks.iter().filter(|check| !check.judgement.passed) {
            let frame = if port.frame > 0 { format!(" frame {}", port.frame) } else { String::new() };
            text += &format!("    {}{frame}  {}: {}\n", port.name, check.what, check.judgement.figures);
            if check.what == GOLDEN {
                if !port.stale.is_empty() {
                    let parts = port.stale.join(", ");
                    text +=
                        &format!("      the golden is stale: {parts} changed since it was made, here or upstream\n");
                }
                text += &format!("      bless just this: {}\n", self.bless_command(port));
            }
        }
        text
    }

    /// The command that blesses one golden.
    pub fn bless_command(&self, port: &PortOutcome) -> String {
        format!("tyndall test {} --tap {} --bless", self.path.display(), port.name)
    }
}

/// What a comparison with a golden is called.
pub const GOLDEN: &str = "golden";
