//! The command line.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::warnings::WarningArguments;

/// Render graphs for light scattering: stills and sequences from graph files, pass by pass.
#[derive(Debug, Parser)]
#[command(name = "tyndall", version, propagate_version = true)]
pub(crate) struct Arguments {
    /// A folder of plugins, or the folder of one plugin; may be given more than once. TYNDALL_PLUGIN_PATH adds more
    #[arg(long, global = true, value_name = "DIR")]
    pub plugin_path: Vec<PathBuf>,
    #[command(subcommand)]
    pub verb: Verb,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Run a graph without a window and write its outputs
    Render(Render),
    /// Report every mistake in graph files, without a GPU
    Check(Check),
    /// Show the scheduled graph: order, culled passes, resources, lifetimes, shared memory
    Show(Show),
    /// Explain why a pass is ordered or culled, or why a port has its size, format and storage
    Explain(Explain),
    /// List every pass of every plugin, or document one
    Passes(Passes),
    /// Measure a graph: time per pass and per frame, and memory
    Bench(Bench),
    /// Compare methods that compute the same light: error against double precision, GPU time, memory
    Compare(Compare),
    /// Print the numbers of one pixel of one port
    Probe(Probe),
    /// Run image tests pass by pass, and name the first pass that diverges
    Test(Test),
    /// Put mistakes into shaders, and see whether image tests notice them and name the right pass
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
    /// The scene to use instead of the graph's
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Size of the picture, such as 640x480
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Set a parameter of the graph, `pass.parameter` or `scene.<path>`; VALUE is RON, and the last one given wins
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
    /// Render frames A to B, excluding B; `####` in FILE becomes the frame's number
    #[arg(long, value_name = "A..B", value_parser = frames)]
    pub frames: Option<(u32, u32)>,
    /// Use the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Render again whenever a file that the picture depends on changes
    #[arg(long)]
    pub watch: bool,
    #[command(flatten)]
    pub warnings: WarningArguments,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Graph files, scene files (`.scene.ron`) or comparison files (`.compare.ron`)
    #[arg(value_name = "GRAPH", required = true)]
    pub files: Vec<PathBuf>,
    /// How to write the mistakes
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    #[command(flatten)]
    pub warnings: WarningArguments,
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
    /// Write a drawing of it
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Write it for Graphviz
    #[arg(long, value_name = "FILE")]
    pub dot: Option<PathBuf>,
    /// Write it as JSON
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
    /// A pass to document, such as `airlight.homogeneous`
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// Write JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    #[command(flatten)]
    pub graph: GraphArguments,
    /// Number of frames
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Write the figures to FILE as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Keep results that have not changed, instead of running every pass in every frame
    #[arg(long)]
    pub keep: bool,
    /// Vary `pass.parameter`, or a parameter of the graph, from A to B over the frames
    #[arg(long, value_name = "NAME=A..B")]
    pub vary: Vec<String>,
    /// Use the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

/// Render the same scenes by every method of a comparison file, and measure each against double precision.
///
/// Error: |found - true| / max(true, 1 % of the mean of the true picture), for every channel of every pixel. The truth is
/// computed on the CPU by adaptive quadrature, up to the rendered depth.
///
/// Time: of the passes that the compared light depends on, except rasterising, each alone on the GPU; the median over
/// rounds in which all methods take turns. Passes whose results are kept while camera and lights move (tables) count
/// separately, as set-up. Bytes: what these passes write, tables and per-frame textures.
///
/// Writes the tables to standard output, and to DIR/index.html a page with pictures, maps of the error and plots of error
/// over time, with table.md (Markdown) and plot.svg beside it.
#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// The comparison file
    #[arg(value_name = "FILE", default_value = "graphs/light.compare.ron")]
    pub file: PathBuf,
    /// Only scenes whose name contains this, in any case; may be given more than once
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// Only methods whose name contains this, in any case; may be given more than once
    #[arg(long, value_name = "NAME")]
    pub method: Vec<String>,
    /// Size of the pictures instead of the file's, such as 640x480
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// How often each method is timed, in turns; the median is reported
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub rounds: u32,
    /// The folder to write the page into
    #[arg(long, value_name = "DIR", default_value = "out/compare")]
    pub out: PathBuf,
    /// Write the figures to FILE as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Use the adapter whose name contains this
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
    /// The pixel, counted from the left and from the top, from 0
    #[arg(value_name = "X,Y", value_parser = pixel)]
    pub pixel: (u32, u32),
    /// The frame to render
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame: u32,
    /// Use the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Test {
    /// Test files, or folders that contain some; by default the working directory
    #[arg(value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Only tests whose path contains TEXT
    #[arg(long, value_name = "TEXT")]
    pub filter: Option<String>,
    /// Only ports that match PATTERN, such as `air.radiance` or `air.*`
    #[arg(long, value_name = "PATTERN")]
    pub tap: Option<String>,
    /// Only frame N, of tests that look at several
    #[arg(long, value_name = "N")]
    pub frame: Option<u32>,
    /// Replace goldens that are missing or different by what is rendered; of stale ones that are still right, renew the record
    #[arg(long, conflicts_with_all = ["isolate", "size", "at_most", "no_goldens", "no_references"])]
    pub bless: bool,
    /// Also bless goldens that were made on another class of adapters
    #[arg(long, requires = "bless")]
    pub any_adapter: bool,
    /// Write pages with pictures into DIR; DIR/index.html opens without a server
    #[arg(long, value_name = "DIR")]
    pub report: Option<PathBuf>,
    /// Write the figures to FILE as JSON, and beside it as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Number of tests to run at a time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub jobs: u16,
    /// Run every pass alone, with its inputs from goldens
    #[arg(long)]
    pub isolate: bool,
    /// Ignore goldens: check only properties, references on the CPU and relations
    #[arg(long)]
    pub no_goldens: bool,
    /// Ignore references on the CPU
    #[arg(long)]
    pub no_references: bool,
    /// Size instead of the tests' own, such as 32x32; goldens are ignored
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Largest size, such as 32x32, of tests that are larger; their goldens are ignored
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with = "size")]
    pub at_most: Option<(u32, u32)>,
    /// Render again in another valid order, chosen by SEED: every port must be bit-equal
    #[arg(long, value_name = "SEED")]
    pub shuffle: Option<u64>,
    /// Render again with memory that is filled with NaN before it is first written
    #[arg(long)]
    pub poison: bool,
    /// Render again without sharing memory between ports
    #[arg(long)]
    pub no_sharing: bool,
    /// Render again N times
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=1000))]
    pub repeat: u32,
    /// Use the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

/// Put mistakes into shaders, one at a time, and see whether image tests notice them.
///
/// A mistake is a flipped sign, a dropped factor, two swapped arguments, `min` for `max`, or a changed constant. A mutant is
/// killed if a test fails and names the changed pass, and no other. Properties, references on the CPU and relations are
/// tried first, then goldens as well, and both figures are reported. Survivors are listed with their places and the reason
/// why they survive. A known reason can be written in `mutants.ron` beside the plugin's manifest; it does not count as a kill.
///
/// The exit code is 1 if fewer are killed than --at-least or --at-least-without-goldens demands.
#[derive(Debug, Args)]
pub(crate) struct Mutants {
    /// Test files, or folders that contain some; by default the working directory
    #[arg(value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Only passes whose name contains TEXT, such as `airlight.` or `core.tonemap`
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub filter: String,
    /// Number of mutants of each pass
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub per_pass: u32,
    /// Chooses the mutants: the same seed gives the same ones
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Ignore goldens: check only properties, references on the CPU and relations
    #[arg(long)]
    pub no_goldens: bool,
    /// Try every test that runs the pass, even after one has killed the mutant: another test may blame the wrong pass. Takes
    /// several times as long
    #[arg(long)]
    pub every_test: bool,
    /// The percentage that must be killed
    #[arg(long, value_name = "PERCENT", default_value_t = 95.0)]
    pub at_least: f64,
    /// The percentage that must be killed without goldens
    #[arg(long, value_name = "PERCENT", default_value_t = 80.0)]
    pub at_least_without_goldens: f64,
    /// Write the figures and every mutant to FILE as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Use the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Diff {
    /// An image: .exr, .png, .hdr or .npy
    #[arg(value_name = "A")]
    pub image: PathBuf,
    /// The image to compare it with
    #[arg(value_name = "B")]
    pub reference: PathBuf,
    /// How far A may differ from B, as in a test file: `Exact`, `RelativeRmse(1e-3)`, `Absolute(tolerance: 0.01)`,
    /// `Flip(mean: 0.01)`; may be given more than once
    #[arg(long, value_name = "METRIC")]
    pub by: Vec<String>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum New {
    /// Write NAME.graph.ron, and its NAME.scene.ron unless that exists
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

/// The command line, or the exit code after help or a mistake has been printed.
pub(crate) fn parse() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| {
        // Help and version go to standard output, mistakes to standard error; a closed pipe must not cause a panic.
        let _ = error.print();
        if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS }
    })
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match parts {
        Some((0, _) | (_, 0)) => Err("width and height must be at least 1".to_owned()),
        Some(size) => Ok(size),
        None => Err("write WIDTHxHEIGHT in pixels, such as 640x480".to_owned()),
    }
}

fn frames(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once("..").and_then(|(a, b)| Some((a.parse::<u32>().ok()?, b.parse::<u32>().ok()?)));
    match parts {
        Some((from, to)) if from < to => Ok((from, to)),
        Some(_) => Err("A must be less than B: frame B is not rendered".to_owned()),
        None => Err("write A..B, such as 0..24".to_owned()),
    }
}

fn pixel(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    parts.ok_or_else(|| "write X,Y, such as 320,240".to_owned())
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
        assert!(size("0x480").is_err_and(|text| text.contains("at least 1")));
        assert!(size("640").is_err() && size("-1x5").is_err() && size("99999999999x1").is_err());
        assert_eq!(frames("2..5"), Ok((2, 5)));
        assert!(frames("5..5").is_err() && frames("a..b").is_err() && frames("3").is_err());
        assert_eq!(pixel("3,4"), Ok((3, 4)));
        assert!(pixel("3").is_err());
    }
}
