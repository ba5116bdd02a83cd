//! A folder for the files of a test, and pictures that are drawn in this process.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use tyndall_document::{Diagnostics, render_text};
use tyndall_image::Image;
use tyndall_render::{Error, Request, Setting};
use tyndall_testing::{Drawn, Sessions};

/// A folder outside the repository, with a graph and a scene in it; gone at the end of the test.
pub struct Desk {
    folder: tempfile::TempDir,
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

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A shipped graph.
pub fn shipped(graph: &str) -> PathBuf {
    root().join("graphs").join(format!("{graph}.graph.ron"))
}

/// Devices with the plugins that the program ships, for all tests of this process.
pub fn sessions() -> &'static Sessions {
    static SESSIONS: LazyLock<Sessions> = LazyLock::new(|| Sessions::new(tyndall::shipped(), Vec::new()));
    &SESSIONS
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
    pub fn put(&self, name: &str, content: &(impl AsRef<[u8]> + ?Sized)) {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
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

    /// What `tyndall render` would be asked with these arguments; paths are in this folder, where they are not absolute.
    pub fn request(&self, graph: &Path, scene: Option<&Path>, size: Option<(u32, u32)>, settings: &[&str]) -> Request {
        let setting = |text: &&str| Setting { text: (*text).to_owned(), argument: format!("--set {text}") };
        Request {
            graph: self.folder.path().join(graph),
            scene: scene.map(|scene| self.folder.path().join(scene)),
            size,
            set: settings.iter().map(setting).collect(),
        }
    }

    /// Draws ports of a graph with a scene, in this process.
    ///
    /// # Errors
    /// Those of `tyndall render`.
    pub fn try_draw(
        &self,
        graph: &Path,
        scene: impl AsRef<Path>,
        size: (u32, u32),
        ports: &[&str],
        settings: &[&str],
    ) -> Result<Drawn, Error> {
        let request = self.request(graph, Some(scene.as_ref()), Some(size), settings);
        sessions().with(|session| session.draw(&request, ports, 0..1))?
    }

    /// The same of what can be drawn.
    #[track_caller]
    pub fn draw<const N: usize>(
        &self,
        graph: &Path,
        scene: impl AsRef<Path>,
        size: (u32, u32),
        ports: [&str; N],
        settings: &[&str],
    ) -> [Image; N] {
        let drawn = self.try_draw(graph, scene, size, &ports, settings);
        let drawn = drawn.unwrap_or_else(|error| panic!("{settings:?}: {error}")).pictures;
        drawn.try_into().unwrap_or_else(|drawn: Vec<Image>| panic!("{} pictures of {ports:?}", drawn.len()))
    }

    /// One port.
    #[track_caller]
    pub fn picture(
        &self,
        graph: &Path,
        scene: impl AsRef<Path>,
        size: (u32, u32),
        port: &str,
        settings: &[&str],
    ) -> Image {
        let [picture] = self.draw(graph, scene, size, [port], settings);
        picture
    }

    /// What `tyndall render` warns of before it renders the outputs of a graph.
    #[track_caller]
    pub fn warnings(&self, request: &Request) -> String {
        let loaded = sessions().with(|session| session.load(request)).and_then(|loaded| loaded);
        let (_, _, warnings) = loaded.unwrap_or_else(|error| panic!("{error}"));
        text(&warnings)
    }
}

/// What a person reads of mistakes or warnings.
pub fn text(found: &Diagnostics) -> String {
    render_text(found, false)
}

impl Default for Desk {
    fn default() -> Self {
        Self::new()
    }
}
