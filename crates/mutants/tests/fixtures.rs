//! Every code has a fixture that pins its text and position.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostics, Place, Source, fixture};
use tyndall_mutants::{CODES, Hunt, Trouble, hunt};
use tyndall_plugin::SearchPath;
use tyndall_render::Error;
use tyndall_testing::Session;

/// Holds reasons against a plugin of one small pass.
fn run(source: &Arc<Source>) -> Diagnostics {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    put(
        "plugins/pair/plugin.ron",
        "(name: \"pair\", version: \"0.1.0\", about: \"two passes\", passes: { \"first\": (about: \"it\", shader: \"first.wgsl\", ports: { \"result\": (about: \"it\", size: Frame(1.0), disabled: Constant(0.0, 0.0, 0.0, 1.0)) }) })",
    );
    put(
        "plugins/pair/first.wgsl",
        "var result: texture_storage_2d<rgba32float, write>;\n@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) { textureStore(result, id.xy, vec4<f32>(1.0)); }",
    );
    put("plugins/pair/mutants.ron", source.text());
    put(
        "a.graph.ron",
        "(version: 1, size: (8, 8), passes: { \"start\": (use: \"pair.first\") }, outputs: { \"end\": \"start.result\" })",
    );
    put("a.test.ron", "(version: 1, graph: \"a.graph.ron\", size: (8, 8), taps: { \"*\": (properties: [Finite]) })");
    let search = vec![SearchPath { path: folder.path().join("plugins"), required: true }];
    let mut session = Session::new(Vec::new(), search, None).unwrap_or_else(|error| panic!("{error}"));
    let tests = vec![folder.path().join("a.test.ron")];
    let request =
        Hunt { tests, filter: String::new(), per_pass: 1, seed: 1, goldens: false, every_test: false, untested: true };
    match hunt(&mut session, &request, &mut |_| {}) {
        Err(Trouble::Error(Error::Mistakes(mistakes))) => {
            renamed(mistakes, &format!("{}/plugins/pair/mutants.ron", folder.path().display()), source.name())
        }
        other => panic!("{other:?}"),
    }
}

/// With the name of the fixture for its path, which is another in every run.
fn renamed(mistakes: Diagnostics, path: &str, name: &str) -> Diagnostics {
    let short = |place: Place| match place {
        Place::Text { source, span } => {
            Place::Text { source: Source::new(source.name().replace(path, name), source.text()), span }
        }
        other => other,
    };
    let renamed = mistakes.into_iter().map(|mut mistake| {
        mistake.place = short(mistake.place);
        mistake
    });
    renamed.collect()
}

#[test]
fn every_code_has_its_text() {
    fixture::check(Path::new("tests/fixtures"), CODES, &run);
}
