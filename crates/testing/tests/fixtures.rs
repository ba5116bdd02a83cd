//! Every code has a fixture that pins its text and position.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{BAD_SIZE, BAD_VERSION, Diagnostics, NEWER_VERSION, Source, fixture};
use tyndall_graph::{PlanOptions, plan};
use tyndall_plugin::Registry;
use tyndall_render::{Loaded, load};
use tyndall_testing::file::{check, check_run, read};
use tyndall_testing::{CODES, TestFile};

/// Reads a fixture as a test file beside the graph that it names, and holds it against that.
fn run(source: &Arc<Source>) -> Diagnostics {
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
    without(out, &format!("{}/", folder.path().display()))
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

/// Without the folder, which has another name in every run.
fn without(mistakes: Diagnostics, folder: &str) -> Diagnostics {
    use tyndall_document::Place;
    let short = |place: Place| match place {
        Place::Text { source, span } => {
            Place::Text { source: Source::new(source.name().replace(folder, ""), source.text()), span }
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
