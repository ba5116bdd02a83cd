//! `cargo xtask demo`: the shipped graphs with the shipped scenes, into `out/`.

use crate::command::{Failure, succeed};
use crate::workspace::Workspace;
use crate::{compiler, driver};

/// A graph of `graphs/`, what to write of it, and the scenes of `graphs/scenes/` to draw with it.
struct Demo {
    graph: &'static str,
    scenes: &'static [&'static str],
    outputs: &'static [(&'static str, &'static str)],
}

/// Scenes of `graphs/scenes/` with lamps in fog.
const FOG: &[&str] = &["pavilion", "primitives"];

const DEMOS: [Demo; 4] = [
    Demo { graph: "airlight", scenes: FOG, outputs: &[("image", "png"), ("airlight", "exr")] },
    Demo { graph: "fog", scenes: FOG, outputs: &[("image", "png"), ("radiance", "exr")] },
    Demo {
        graph: "volumetric-shadows",
        scenes: &["shadows/amphora"],
        outputs: &[("image", "png"), ("radiance", "exr")],
    },
    Demo { graph: "aerial-perspective", scenes: &["terrain"], outputs: &[("image", "png"), ("radiance", "exr")] },
];

/// Builds, makes sure that there is a driver, renders, and prints each file written.
///
/// # Errors
/// If one of these fails.
pub fn run(workspace: &Workspace) -> Result<(), Failure> {
    compiler::ensure()?;
    succeed(workspace.cargo().args(["build", "--release", "--package", "tyndall"]))?;
    driver::ensure(workspace)?;
    let mut written = Vec::new();
    for demo in &DEMOS {
        for scene in demo.scenes {
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
    let name = scene.rsplit('/').next().unwrap_or(scene);
    for (output, suffix) in demo.outputs {
        let file = format!("out/{}.{name}.{output}.{suffix}", demo.graph);
        command.args(["--output", &format!("{output}={file}")]);
        files.push(file);
    }
    succeed(&mut command)?;
    match files.iter().find(|file| !workspace.root.join(file).is_file()) {
        Some(missing) => Err(Failure::check(format!("{missing} was not written"))),
        None => Ok(files),
    }
}
