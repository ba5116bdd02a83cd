//! `cargo xtask demo`: the shipped graphs with the shipped scenes, into `out/`.

use crate::command::{Failure, succeed};
use crate::workspace::Workspace;
use crate::{compiler, driver};

/// A graph of `graphs/` and what to write of it, for each scene.
struct Demo {
    graph: &'static str,
    outputs: &'static [(&'static str, &'static str)],
}

const DEMOS: [Demo; 2] = [
    Demo { graph: "airlight", outputs: &[("image", "png"), ("airlight", "exr")] },
    Demo { graph: "fog", outputs: &[("image", "png"), ("radiance", "exr")] },
];

/// Scenes of `graphs/scenes/`.
const SCENES: [&str; 2] = ["pavilion", "primitives"];

/// Builds, makes sure of a driver, renders, and prints each file that was written.
///
/// # Errors
/// If one of these fails.
pub fn run(workspace: &Workspace) -> Result<(), Failure> {
    compiler::ensure()?;
    succeed(workspace.cargo().args(["build", "--release", "--package", "tyndall"]))?;
    driver::ensure(workspace)?;
    let mut written = Vec::new();
    for demo in &DEMOS {
        for scene in SCENES {
            let files = render(workspace, demo, scene)?;
            written.extend(files);
        }
    }
    println!("\nWritten:");
    written.iter().for_each(|file| println!("  {file}"));
    Ok(())
}

fn render(workspace: &Workspace, demo: &Demo, scene: &str) -> Result<Vec<String>, Failure> {
    let mut command = workspace.tyndall();
    command.args(["render", &format!("graphs/{}.graph.ron", demo.graph)]);
    command.args(["--scene", &format!("graphs/scenes/{scene}.scene.ron")]);
    let mut files = Vec::new();
    for (output, suffix) in demo.outputs {
        let file = format!("out/{}.{scene}.{output}.{suffix}", demo.graph);
        command.args(["--output", &format!("{output}={file}")]);
        files.push(file);
    }
    succeed(&mut command)?;
    match files.iter().find(|file| !workspace.root.join(file).is_file()) {
        Some(missing) => Err(Failure::check(format!("{missing} was not written"))),
        None => Ok(files),
    }
}
