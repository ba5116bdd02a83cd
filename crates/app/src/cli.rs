//! The command line, as `contract` states it.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Render graphs for light scattering: stills and sequences from graph files, pass by pass.
#[derive(Debug, Parser)]
#[command(name = "tyndall", version, propagate_version = true)]
pub(crate) struct Arguments {
    /// A folder with plugins (or a plugin's folder); may be given more than once. TYNDALL_PLUGIN_PATH adds more.
    #[arg(long, global = true, value_name = "DIR")]
    pub plugin_path: Vec<PathBuf>,
    #[command(subcommand)]
    pub verb: Verb,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Run a graph without a window and write its outputs
    Render(Render),
    /// Find every mistake of graph files, without a GPU
    Check(Check),
    /// Show the scheduled graph: order, culled passes, resources, lifetimes, what shares memory
    Show(Show),
    /// Say why a pass is ordered or culled, why a port has its size, format and storage
    Explain(Explain),
    /// List every pass of every plugin, or document one
    Passes(Passes),
    /// Measure a graph: times per pass and per frame, bytes of memory
    Bench(Bench),
    /// Compare ways to make the same light: error against double precision, GPU time, memory
    Compare(Compare),
    /// Print the numbers of one pixel of one port
    Probe(Probe),
    /// Run image tests, pass by pass: the first pass that diverges is named
    Test(Test),
    /// Put mistakes into the shaders of passes, and see whether image tests notice and name the right pass
    Mutants(Mutants),
    /// Compare two image files
    Diff(Diff),
    /// List the adapters of this machine
    Adapters,
    /// Write a commented graph or scene to start from
    New {
        #[command(subcommand)]
        what: New,
    },
}

impl Verb {
    /// The adapter that the command line asks for.
    pub fn adapter(&self) -> Option<&str> {
        match self {
            Verb::Render(verb) => verb.adapter.as_deref(),
            Verb::Bench(verb) => verb.adapter.as_deref(),
            Verb::Compare(verb) => verb.adapter.as_deref(),
            Verb::Probe(verb) => verb.adapter.as_deref(),
            Verb::Test(verb) => verb.adapter.as_deref(),
            Verb::Mutants(verb) => verb.adapter.as_deref(),
            _ => None,
        }
    }
}

/// What every verb that reads a graph takes.
#[derive(Debug, Clone, Args)]
pub(crate) struct GraphArguments {
    /// The graph file
    #[arg(value_name = "GRAPH")]
    pub graph: PathBuf,
    /// Another scene than the graph names
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Size of the picture, 640x480 say
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// A parameter: of the graph, `pass.parameter`, or `scene.<path>`; VALUE is RON. The last one wins
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Render {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// Write a graph output, or any `pass.port`, to FILE (.exr, .png, .hdr, .npy)
    #[arg(long, value_name = "NAME=FILE")]
    pub output: Vec<String>,
    /// Write every port of every pass into DIR
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,
    /// Frames A to B, without B; `####` in FILE becomes the number
    #[arg(long, value_name = "A..B", value_parser = frames)]
    pub frames: Option<(u32, u32)>,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Render again whenever a file changes that the picture depends on
    #[arg(long)]
    pub watch: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Graph files; scene files (`.scene.ron`) and comparisons (`.compare.ron`) as well
    #[arg(value_name = "GRAPH", required = true)]
    pub files: Vec<PathBuf>,
    /// How mistakes are written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people
    Text,
    /// For programs
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct Show {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// Draw it
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// For Graphviz
    #[arg(long, value_name = "FILE")]
    pub dot: Option<PathBuf>,
    /// For programs
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Explain {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// A pass, a `pass.port`, or an output
    #[arg(value_name = "NAME")]
    pub name: String,
}

#[derive(Debug, Args)]
pub(crate) struct Passes {
    /// A pass: `airlight.homogeneous`
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// For programs
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// How many frames
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Write the figures to FILE
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Keep results that have not changed, instead of running every pass in every frame
    #[arg(long)]
    pub keep: bool,
    /// Let `pass.parameter` or a parameter of the graph run from A to B over the frames
    #[arg(long, value_name = "NAME=A..B")]
    pub vary: Vec<String>,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

/// Render the same scenes by every method of a comparison file, and measure each against light computed in double
/// precision.
///
/// Error: |found - true| / max(true, 1 % of the mean of the true picture), of every channel of every pixel. The truth is
/// computed on the CPU by adaptive quadrature, for the depth that was rendered.
///
/// Time: of the passes that the compared light depends on, rasterising apart, each alone on the GPU; the median over rounds
/// in which all methods take turns. Passes whose results stay while camera and lights move (tables) are counted apart, as
/// set-up. Bytes: what these passes write, tables and per-frame textures.
///
/// Writes the tables to standard output, and a page with pictures, maps of the error and error over time to DIR/index.html;
/// beside it table.md (Markdown) and plot.svg.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// The comparison file
    #[arg(value_name = "FILE", default_value = "graphs/light.compare.ron")]
    pub file: PathBuf,
    /// Only scenes whose name holds this, in any case; may be given more than once
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// Only methods whose name holds this, in any case; may be given more than once
    #[arg(long, value_name = "NAME")]
    pub method: Vec<String>,
    /// Another size of the pictures than the file says, 640x480 say
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// How often each method is timed, in turns; the median counts
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub rounds: u32,
    /// The folder of the page
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    pub out: PathBuf,
    /// Write the figures to FILE
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Probe {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// A graph output, or any `pass.port`
    #[arg(value_name = "PORT")]
    pub port: String,
    /// The pixel, from the left and from the top
    #[arg(value_name = "X,Y", value_parser = pixel)]
    pub pixel: (u32, u32),
    /// Which frame
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame: u32,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Test {
    /// Test files, or folders that hold some; the working directory without any
    #[arg(value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Only tests whose path holds TEXT
    #[arg(long, value_name = "TEXT")]
    pub filter: Option<String>,
    /// Only ports that match PATTERN: `air.radiance`, `air.*`
    #[arg(long, value_name = "PATTERN")]
    pub tap: Option<String>,
    /// Only ports of frame N, where a test looks at several
    #[arg(long, value_name = "N")]
    pub frame: Option<u32>,
    /// Make what is rendered the golden, where that is missing, different or stale
    #[arg(long, conflicts_with_all = ["isolate", "size", "no_goldens"])]
    pub bless: bool,
    /// Also bless goldens that were made on another class of adapters
    #[arg(long, requires = "bless")]
    pub any_adapter: bool,
    /// Write pages with pictures into DIR; DIR/index.html needs no server
    #[arg(long, value_name = "DIR")]
    pub report: Option<PathBuf>,
    /// Write the figures to FILE, and beside it the same as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Tests at a time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub jobs: u16,
    /// Run every pass alone, with its inputs from goldens
    #[arg(long)]
    pub isolate: bool,
    /// Leave goldens out: properties, references on the CPU and relations alone
    #[arg(long)]
    pub no_goldens: bool,
    /// Another size than the tests say, 32x32 say; goldens are left out
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Render again in another valid order, drawn by SEED: every port must be bit-equal
    #[arg(long, value_name = "SEED")]
    pub shuffle: Option<u64>,
    /// Render again from memory that holds NaN before it is first written
    #[arg(long)]
    pub poison: bool,
    /// Render again without ports that share memory
    #[arg(long)]
    pub no_sharing: bool,
    /// Render again, so many times
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=1000))]
    pub repeat: u32,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

/// Put mistakes into the shaders of passes, one at a time, and see whether image tests notice.
///
/// A mistake: a sign flipped, a factor dropped, two arguments or min and max swapped, a constant changed. A mutant is killed
/// where a test fails and names the pass that was changed, and no other. Each is shown to properties, references on the CPU
/// and relations first, then to goldens as well: both figures are told. What is not killed is listed with its place and why
/// it survives; what a person knows about it stands in `mutants.ron` beside the plugin's manifest, and kills nothing.
///
/// Exit code 1 where fewer are killed than --at-least and --at-least-without-goldens say.
#[derive(Debug, Args)]
pub(crate) struct Mutants {
    /// Test files, or folders that hold some; the working directory without any
    #[arg(value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Only passes whose name holds TEXT: `airlight.`, `core.tonemap`
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub filter: String,
    /// Mutants of each pass
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub per_pass: u32,
    /// Draws them: the same ones each time
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Leave goldens out: properties, references on the CPU and relations alone
    #[arg(long)]
    pub no_goldens: bool,
    /// Show each mutant to every test that runs the pass, though one kills it: another may lay it at another pass. Takes
    /// several times as long
    #[arg(long)]
    pub every_test: bool,
    /// The part that must be killed
    #[arg(long, value_name = "PERCENT", default_value_t = 95.0)]
    pub at_least: f64,
    /// The part that must be killed without goldens
    #[arg(long, value_name = "PERCENT", default_value_t = 80.0)]
    pub at_least_without_goldens: f64,
    /// Write the figures and every mutant to FILE
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// The adapter whose name holds this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Diff {
    /// An image: .exr, .png, .hdr or .npy
    #[arg(value_name = "A")]
    pub image: PathBuf,
    /// The image that it is held against
    #[arg(value_name = "B")]
    pub reference: PathBuf,
    /// How far A may be from B, as in a test file: `Exact`, `RelativeRmse(1e-3)`, `Absolute(tolerance: 0.01)`, `Flip(mean: 0.01)`.
    /// More than one may be given
    #[arg(long, value_name = "METRIC")]
    pub by: Vec<String>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum New {
    /// Write NAME.graph.ron, and NAME.scene.ron that it draws unless that is there
    Graph {
        /// Path, with or without `.graph.ron`
        name: PathBuf,
    },
    /// Write NAME.scene.ron
    Scene {
        /// Path, with or without `.scene.ron`
        name: PathBuf,
    },
}

/// The command line, or the exit code after help was printed or a mistake was told.
pub(crate) fn parse() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| {
        // Help and version go to standard output, mistakes to standard error; a closed pipe is no reason to panic.
        let _ = error.print();
        if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS }
    })
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match parts {
        Some((0, _) | (_, 0)) => Err("a size of 0 holds no pixel".to_owned()),
        Some(size) => Ok(size),
        None => Err("a size is WIDTHxHEIGHT in pixels, 640x480 say".to_owned()),
    }
}

fn frames(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once("..").and_then(|(a, b)| Some((a.parse::<u32>().ok()?, b.parse::<u32>().ok()?)));
    match parts {
        Some((from, to)) if from < to => Ok((from, to)),
        Some(_) => Err("A must be below B: frame B is not rendered".to_owned()),
        None => Err("frames are A..B, 0..24 say".to_owned()),
    }
}

fn pixel(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    parts.ok_or_else(|| "a pixel is X,Y".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_frames_and_pixels() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(size("0x480").is_err_and(|text| text.contains('0')));
        assert!(size("640").is_err() && size("-1x5").is_err() && size("99999999999x1").is_err());
        assert_eq!(frames("2..5"), Ok((2, 5)));
        assert!(frames("5..5").is_err() && frames("a..b").is_err() && frames("3").is_err());
        assert_eq!(pixel("3,4"), Ok((3, 4)));
        assert!(pixel("3").is_err());
    }
}
