//! Starts the program in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tyndall_image::Image;

/// A folder outside the repository, with a graph and a scene in it; gone at the end of the test.
pub struct Desk {
    folder: tempfile::TempDir,
}

/// How a run ended.
pub struct Ended {
    /// Exit code; -1 after a signal.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ended {
    /// A panic is never the right end.
    pub fn of(arguments: &[&str], output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let ended =
            Self { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) };
        assert!(!ended.err.contains("panicked"), "{arguments:?}: {}", ended.err);
        ended
    }
}

/// A lamp and a sun in coloured fog over a floor with a sphere; the sky is not black.
pub const SCENE: &str = r#"(
    camera: (position: (0.0, 1.5, 6.0), look_at: (0.0, 1.0, 0.0), vertical_fov: 50.0),
    medium: (extinction: (0.05, 0.06, 0.08), albedo: (0.9, 0.8, 0.7), phase: HenyeyGreenstein(g: 0.7)),
    background: (0.01, 0.02, 0.03),
    lights: [
        Point(position: (1.0, 2.5, 0.0), intensity: (20.0, 18.0, 15.0)),
        Directional(direction: (0.3, -1.0, 0.2), irradiance: (0.5, 0.5, 0.6)),
    ],
    objects: [
        (mesh: Sphere(radius: 1.0), translation: (0.0, 1.0, 0.0)),
        (mesh: Plane(size: (20.0, 20.0))),
    ],
)"#;

/// Where the shipped graphs are.
pub fn shipped(graph: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs").join(format!("{graph}.graph.ron"))
}

impl Desk {
    /// With `fog.graph.ron` as shipped and `test.scene.ron`, which the graph names.
    pub fn new() -> Self {
        let desk = Self { folder: tempfile::tempdir().unwrap() };
        let graph = std::fs::read_to_string(shipped("fog")).unwrap();
        assert!(graph.contains("scenes/pavilion.scene.ron"));
        desk.put("fog.graph.ron", &graph.replace("scenes/pavilion.scene.ron", "test.scene.ron"));
        desk.put("test.scene.ron", SCENE);
        desk
    }

    /// Writes a file.
    pub fn put(&self, name: &str, text: &str) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The files below `name`, sorted; none where there is no such folder.
    pub fn files(&self, name: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(name)).into_iter().flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The program, to be started in the folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tyndall"));
        command.args(arguments).current_dir(self.folder.path()).env_remove("TYNDALL_PLUGIN_PATH");
        command
    }

    /// Runs the program in the folder, with its output in pipes.
    pub fn run(&self, arguments: &[&str]) -> Ended {
        Ended::of(arguments, &self.command(arguments).output().unwrap())
    }

    /// Runs the program, which must end with this code.
    pub fn ends(&self, code: i32, arguments: &[&str]) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, code, "{arguments:?}\n{}{}", ended.out, ended.err);
        ended
    }

    /// Renders an output (or port) and reads it again: three channels, or one.
    pub fn picture(&self, graph: &Path, scene: &Path, size: &str, port: &str, settings: &[&str]) -> Image {
        let file = format!("{port}.npy");
        let output = format!("{port}={file}");
        let (graph, scene) = (graph.to_str().unwrap(), scene.to_str().unwrap());
        let mut arguments = vec!["render", graph, "--scene", scene, "--size", size, "--output", &output];
        settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
        self.ends(0, &arguments);
        tyndall_image::read(&self.path(&file)).unwrap()
    }
}
