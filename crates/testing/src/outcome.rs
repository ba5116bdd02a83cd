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
    /// In how many other ways everything was rendered, and held against the first bit by bit.
    pub variations: usize,
    /// What came out different in another order, with other memory, or when it was done again.
    pub robustness: Vec<String>,
    /// Ports that the test does not look at, for a report.
    pub unchecked: Vec<UncheckedPort>,
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
    /// Of every number that was rendered, in order, where [`Options::digest`](crate::Options::digest) asks for it: two runs
    /// of a test that come out alike bit by bit have the same.
    pub digest: Option<u64>,
    /// Name of its page in a report, without the suffix; empty where there is no report.
    pub page: String,
    /// Path of the picture that stands for it in a report: of a port that diverged, else of the last one.
    pub picture: Option<String>,
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

/// A port that a test does not look at.
#[derive(Debug)]
pub struct UncheckedPort {
    /// `pass.port`.
    pub name: String,
    /// The pass that writes it.
    pub pass: String,
    /// The frame.
    pub frame: u32,
    /// What was rendered, no larger than a golden is.
    pub picture: Picture,
}

/// Ports in which the mistake may be as well: those that a pass at fault was made from and in which no check holds every
/// number, and those that it is held against.
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
    /// The name of a golden that is gone, of whose record no tap knows.
    OrphanRecord(String),
    /// A golden could not be written.
    NotBlessed(String),
    /// A pass could not be run alone.
    NotIsolated(String),
}

impl Problem {
    /// In one line; of several mistakes the first.
    pub(crate) fn line(&self) -> String {
        match self {
            Problem::Mistakes(mistakes) => {
                mistakes.iter().next().map_or_else(String::new, |first| format!("{}: {}", first.code, first.message))
            }
            Problem::Machine(why) => format!("cannot run: {why}"),
            Problem::Orphan(path) if crate::golden::may_be_dropped(path) => {
                format!("no tap claims the golden `{}`: delete it, or bless to drop it", path.display())
            }
            Problem::Orphan(path) if path.to_string_lossy().ends_with(crate::file::GOLDENS) => {
                format!("no test claims the goldens `{}`: delete them, or restore their test", path.display())
            }
            Problem::Orphan(path) => {
                format!(
                    "`{}` lies among goldens, and no test knows it: delete it, or move it elsewhere",
                    path.display()
                )
            }
            Problem::OrphanRecord(name) => {
                format!("the record of the golden `{name}` has no file, and no tap claims it: bless to drop it")
            }
            Problem::NotBlessed(why) => format!("not blessed: {why}"),
            Problem::NotIsolated(why) => format!("cannot run a pass alone: {why}"),
        }
    }
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
    /// By which metric, where it says what every number is.
    pub by: Option<Metric>,
    /// Other ports that it depends on, `pass.port`, beside those upstream.
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
    /// The frame.
    pub frame: u32,
    /// What the relation says.
    pub about: String,
    /// `pass.port`.
    pub port: String,
    /// The pass that writes it.
    pub pass: String,
    /// What it was made from that came out of something else in another run, and that nothing holds there: `pass.port`.
    pub unheld: Vec<String>,
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

    /// What of it does not hold, where there was something to hold it against.
    pub fn divergences(&self) -> impl Iterator<Item = &Check> + Clone {
        self.checks.iter().filter(|check| !check.judgement.passed && check.reach != Reach::Nothing)
    }

    /// Something of it does not hold, whatever other ports come to.
    pub fn fails_by_itself(&self) -> bool {
        self.divergences().any(|check| check.also_on.is_empty())
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

    /// Nothing failed, but nothing was held against anything either: what the test says is of goldens or of its own size,
    /// and these were left out. It has neither passed nor failed.
    pub fn checked_nothing(&self) -> bool {
        let checks = self.ports.iter().map(|port| port.checks.len()).sum::<usize>();
        self.passed() && checks + self.relations.len() + self.variations == 0
    }

    /// 0 passed, 1 something does not hold, 2 the input is wrong, 3 the machine cannot do it.
    pub fn exit_code(&self) -> u8 {
        let of_problem = |problem: &Problem| match problem {
            Problem::Mistakes(_) => 2,
            Problem::Machine(_) => 3,
            Problem::Orphan(_) | Problem::OrphanRecord(_) | Problem::NotBlessed(_) | Problem::NotIsolated(_) => 1,
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
        self.unchecked.clear();
        self.ports.iter_mut().for_each(|port| (port.actual, port.expected) = (None, None));
        let checks = self.ports.iter_mut().flat_map(|port| &mut port.checks).map(|check| &mut check.judgement);
        let relations = self.relations.iter_mut().map(|relation| &mut relation.judgement);
        checks.chain(relations).for_each(|judgement| judgement.pictures = None);
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
                other => format!("  {}\n", other.line()),
            };
        }
        for (at, guilty) in self.guilty().into_iter().enumerate() {
            let kind = self.passes.iter().find(|pass| pass.name == guilty).map_or("", |pass| pass.kind.as_str());
            let suspicion = self.suspicions.iter().find(|suspicion| suspicion.pass == guilty);
            match at {
                0 => text += &format!("  first diverging pass: `{guilty}` ({kind})\n"),
                _ if suspicion.is_some() => text += &format!("  diverging too: `{guilty}` ({kind})\n"),
                _ => {}
            }
            if let Some(Suspicion { unheld, .. }) = suspicion {
                let ports = unheld.join("`, `");
                text += &format!(
                    "    or what it depends on: `{ports}` may be wrong, and no check would tell: give it a golden or a CpuReference that is strict enough\n"
                );
            }
        }
        let to_tell = |state| matches!(state, State::Guilty | State::Unjudged);
        for port in self.ports.iter().filter(|port| to_tell(port.state)) {
            text += &self.port_text(port);
        }
        for relation in self.relations.iter().filter(|relation| relation.state == State::Guilty) {
            let RelationOutcome { port, about, judgement, .. } = relation;
            text += &format!("    {port}{}  {about}: {}\n", frame(relation.frame), judgement.figures);
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
            let Check { what, judgement, .. } = check;
            text += &format!("    {}{}  {what}: {}\n", port.name, frame(port.frame), judgement.figures);
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
        let frame = if port.key == port.name { String::new() } else { format!(" --frame {}", port.frame) };
        format!("tyndall test {} --tap {}{frame} --bless", quoted(&self.path.display().to_string()), port.name)
    }
}

/// A frame other than the first.
fn frame(frame: u32) -> String {
    if frame > 0 { format!(" frame {frame}") } else { String::new() }
}

/// A path as a shell takes it for one word.
fn quoted(path: &str) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "/\\._-+,:@%".contains(letter);
    if path.chars().all(plain) { path.to_owned() } else { format!("'{}'", path.replace('\'', "'\\''")) }
}

/// What a comparison with a golden is called.
pub const GOLDEN: &str = "golden";

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn paths_are_one_word_of_a_shell() {
        assert_eq!(quoted("plugins/lens/tests/lens.test.ron"), "plugins/lens/tests/lens.test.ron");
        assert_eq!(quoted("my tests/it's.test.ron"), r"'my tests/it'\''s.test.ron'");
        assert_eq!(quoted("a$b"), "'a$b'");
    }
}
