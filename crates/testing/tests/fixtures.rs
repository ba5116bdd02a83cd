//! Every code has a fixture that pins its text and position.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{BAD_SIZE, BAD_VERSION, Diagnostics, NEWER_VERSION, Source, fixture};
use tyndall_graph::{PlanOptions, plan};
use tyndall_plugin::{Registry, SearchPath};
use tyndall_render::{Error, Loaded, load};
use tyndall_testing::codes::STALE_REASON;
use tyndall_testing::file::{check, check_run, read};
use tyndall_testing::mutants::{Hunt, Trouble, hunt};
use tyndall_testing::{CODES, Session, TestFile};

/// Reads a fixture as a test file beside the graph that it names, and holds it against that; one of reasons for mutants
/// as these.
fn run(source: &Arc<Source>) -> Diagnostics {
    if source.name().starts_with(STALE_REASON.0) {
        return reasons(source);
    }
    let mut out = Diagnostics::default();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(source.name());
    std::fs::write(&path, source.text()).unwrap();
    std::fs::write(folder.path().join("small.graph.ron"), include_str!("small.graph.ron")).unwrap();
    let registry = tyndall_render::registry(vec![tyndall_core::plugin()], &[]).unwrap();
    if let Some(file) = read(&path, &mut out)
        && let Some(loaded) = load(&file.request, &registry, &mut out)
    {
        check(&file, &loaded.graph, &|_| false, &mut out);
        rerun(&file, &loaded, &registry, &mut out);
    }
    renamed(out, &format!("{}/", folder.path().display()), "")
}

/// Holds each other run of each relation against the test's own.
fn rerun(file: &TestFile, own: &Loaded, registry: &Registry, out: &mut Diagnostics) {
    for relation in &file.relations {
        for settings in &relation.runs {
            let mut request = file.request.clone();
            request.set.extend(settings.iter().cloned());
            let other = load(&request, registry, out).unwrap();
            let planned = |loaded: &Loaded| plan(&loaded.graph, &PlanOptions::new(loaded.graph.size)).unwrap();
            let expect: Vec<_> = relation.expect.iter().collect();
            check_run(file, &expect, (own, &planned(own)), (&other, &planned(&other)), out);
        }
    }
}

/// Holds reasons against a plugin without any WGSL.
fn reasons(source: &Arc<Source>) -> Diagnostics {
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

/// Without the folder, which has another name in every run.
fn renamed(mistakes: Diagnostics, folder: &str, name: &str) -> Diagnostics {
    use tyndall_document::Place;
    let short = |place: Place| match place {
        Place::Text { source, span } => {
            Place::Text { source: Source::new(source.name().replace(folder, name), source.text()), span }
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
    let codes = [CODES, &[BAD_SIZE, BAD_VERSION, NEWER_VERSION]].concat();
    fixture::check(Path::new("tests/fixtures"), &codes, &run);
}

/// The test that the fixtures are mistakes of has none.
#[test]
fn the_right_test_is_accepted() {
    let source = Source::new("right.test.ron", include_str!("right.test.ron"));
    let found = run(&source);
    assert!(found.is_empty(), "{found:?}");
}
