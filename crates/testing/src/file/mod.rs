//! A test file, `NAME.test.ron`, as it was read: what to render, which ports to look at, and what must hold of them.

mod check;
mod expect;
mod read;
mod reason;
mod rerun;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Place, Source, Span};
use tyndall_render::{Request, Setting};

use crate::adapter::AdapterClass;
use crate::metric::Metric;

pub(crate) use check::matches;
pub use check::{Tapped, check};
pub use expect::parse_metric;
pub use read::read;
pub use rerun::check_run;

/// What ends the name of a test file.
pub const SUFFIX: &str = ".test.ron";

/// A test file.
#[derive(Debug, Clone)]
pub struct TestFile {
    /// Its text.
    pub source: Arc<Source>,
    /// Its path, as it was given.
    pub path: PathBuf,
    /// What it is for.
    pub about: String,
    /// What is rendered: paths are relative to the working directory.
    pub request: Request,
    /// The frames that are looked at, rising.
    pub frames: Vec<u32>,
    /// What is looked at, in the order of the file.
    pub taps: Vec<Tap>,
    /// How ports change from run to run.
    pub relations: Vec<Relation>,
}

/// What must hold of the ports that a pattern matches.
///
/// Properties add up over all taps that match a port; its golden and its reference are those of the last tap that has
/// one, so a general tap stands first and its exceptions after it.
#[derive(Debug, Clone)]
pub struct Tap {
    /// `pass.port`, where `*` stands for any characters.
    pub pattern: String,
    /// Where the pattern stands.
    pub span: Span,
    /// How far from its golden.
    pub golden: Option<Golden>,
    /// A picture that another renderer made.
    pub reference: Option<Reference>,
    /// What needs no golden.
    pub properties: Vec<Spanned<Property>>,
}

/// How far a port may be from its golden.
#[derive(Debug, Clone)]
pub struct Golden {
    /// On every adapter that is not named.
    pub metric: Metric,
    /// By class of adapter.
    pub adapters: Vec<(AdapterClass, Metric)>,
    /// Where the metric stands.
    pub span: Span,
}

impl Golden {
    /// The metric for this class of adapter.
    pub fn metric(&self, class: AdapterClass) -> Metric {
        let found = self.adapters.iter().find(|(candidate, _)| *candidate == class);
        found.map_or(self.metric, |(_, metric)| *metric)
    }
}

/// A picture that another renderer made.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Its path, relative to the working directory.
    pub file: PathBuf,
    /// How far from it.
    pub metric: Metric,
    /// Where it comes from.
    pub provenance: String,
    /// Where the metric stands.
    pub span: Span,
}

/// Something and where it stands.
#[derive(Debug, Clone)]
pub struct Spanned<T> {
    /// What.
    pub value: T,
    /// Where.
    pub span: Span,
}

/// What must hold of a port without a golden. Numbers are those of the channels that mean something, without alpha.
#[derive(Debug, Clone, PartialEq)]
pub enum Property {
    /// No number is infinite or NaN.
    Finite,
    /// No number is below 0 or NaN.
    NonNegative,
    /// Every number lies within.
    Range(f64, f64),
    /// Alpha is 1 everywhere.
    AlphaOne,
    /// Every vector has length 1, or 0 where `or_zero`.
    UnitLength {
        /// How far from it.
        within: f64,
        /// Length 0 will do.
        or_zero: bool,
    },
    /// Not everything is the same: the picture is not blank.
    Varies,
    /// Every number is at most that of another port.
    AtMost {
        /// The other port.
        port: String,
        /// More than that by this part of it, at most.
        within: f64,
    },
    /// As another port, by a metric.
    Equal {
        /// The other port.
        port: String,
        /// The metric.
        by: Metric,
    },
    /// As the sum of other ports, by a metric.
    Sum {
        /// The other ports.
        ports: Vec<String>,
        /// The metric.
        by: Metric,
    },
    /// The mean of each channel.
    Mean {
        /// One number for all channels, or one for each.
        value: Vec<f64>,
        /// How far from it, as a part of it.
        within: f64,
    },
    /// As the pass's reference on the CPU computes it, by a metric.
    CpuReference {
        /// The metric.
        by: Metric,
    },
}

impl Property {
    /// So strict that nobody need say why; see [`Metric::is_strict`].
    pub fn is_strict(&self) -> bool {
        match self {
            Property::UnitLength { within, .. } | Property::AtMost { within, .. } | Property::Mean { within, .. } => {
                *within <= Metric::STRICT
            }
            _ => self.metric().is_none_or(|by| by.is_strict()),
        }
    }

    /// The metric of one that says what every number is, and so leaves no room for a mistake.
    pub fn metric(&self) -> Option<Metric> {
        match self {
            Property::Equal { by, .. } | Property::Sum { by, .. } | Property::CpuReference { by } => Some(*by),
            _ => None,
        }
    }

    /// The other ports that it names.
    pub fn ports(&self) -> &[String] {
        match self {
            Property::AtMost { port, .. } | Property::Equal { port, .. } => std::slice::from_ref(port),
            Property::Sum { ports, .. } => ports,
            _ => &[],
        }
    }
}

/// How ports change from the test's own run to others.
#[derive(Debug, Clone)]
pub struct Relation {
    /// What it says.
    pub about: String,
    /// Where it stands.
    pub span: Span,
    /// What is set in each other run, on top of what the test sets.
    pub runs: Vec<Vec<Setting>>,
    /// What must hold, by port.
    pub expect: Vec<Expectation>,
}

/// How a port changes.
#[derive(Debug, Clone)]
pub struct Expectation {
    /// `pass.port`.
    pub port: String,
    /// Where it stands.
    pub span: Span,
    /// How.
    pub change: Change,
}

/// How a port of the test's own run and that of other runs belong together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Each other run is the same.
    Same(Metric),
    /// Each other run is this many times as much.
    Scaled(f64, Metric),
    /// In each other run everything is so many pixels further right and down; what came in from outside is not compared.
    Shifted(i32, i32, Metric),
    /// The test's own run is the sum of the other runs.
    SumOfRuns(Metric),
    /// No number of another run is larger, but by this part of it.
    NoMore(f64),
    /// No number of another run is smaller, but by this part of it.
    NoLess(f64),
    /// Each other run differs, by more than this relative RMSE.
    Differs(f64),
    /// Each other run is as the pass's reference on the CPU computes it.
    CpuReference(Metric),
}

impl Change {
    /// So strict that nobody need say why; see [`Metric::is_strict`].
    pub fn is_strict(&self) -> bool {
        match self {
            Change::NoMore(within) | Change::NoLess(within) => *within <= Metric::STRICT,
            _ => self.metric().is_none_or(|by| by.is_strict()),
        }
    }

    /// The metric by which runs are compared.
    pub fn metric(&self) -> Option<Metric> {
        match *self {
            Change::Same(by) | Change::SumOfRuns(by) | Change::CpuReference(by) => Some(by),
            Change::Scaled(_, by) | Change::Shifted(_, _, by) => Some(by),
            Change::NoMore(_) | Change::NoLess(_) | Change::Differs(_) => None,
        }
    }

    /// Whether it holds of every port where the only other run is the test's own once more.
    pub fn holds_of_the_same_run(&self) -> bool {
        match self {
            Change::Same(_) | Change::SumOfRuns(_) | Change::NoMore(_) | Change::NoLess(_) => true,
            Change::Scaled(factor, _) => *factor == 1.0,
            Change::Shifted(x, y, _) => (*x, *y) == (0, 0),
            Change::Differs(_) | Change::CpuReference(_) => false,
        }
    }
}

impl TestFile {
    /// The place of a span of the file.
    pub fn place(&self, span: Span) -> Place {
        self.source.place(span)
    }

    /// The ports that properties and relations name.
    pub fn ports_named(&self) -> impl Iterator<Item = &str> {
        let properties = self.taps.iter().flat_map(|tap| &tap.properties);
        let named = properties.flat_map(|property| property.value.ports()).map(String::as_str);
        let expected = self.relations.iter().flat_map(|relation| &relation.expect);
        named.chain(expected.map(|expectation| expectation.port.as_str()))
    }

    /// Its name without `.test.ron`.
    pub fn stem(&self) -> &str {
        stem(&self.path)
    }

    /// The folder with its goldens.
    pub fn goldens(&self) -> PathBuf {
        self.path.with_file_name(format!("{}{GOLDENS}", self.stem()))
    }
}

/// What ends the name of a folder of goldens.
pub const GOLDENS: &str = ".goldens";

fn stem(path: &Path) -> &str {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    name.strip_suffix(SUFFIX).or_else(|| name.strip_suffix(".ron")).unwrap_or(name)
}
