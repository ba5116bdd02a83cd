//! Every code has a fixture that pins its text and position.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, fixture};
use tyndall_render::load;
use tyndall_testing::CODES;
use tyndall_testing::file::{check, read};

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
    }
    renamed(out, &format!("{}/", folder.path().display()))
}

/// Without the folder, which has another name in every run.
fn renamed(mistakes: Diagnostics, folder: &str) -> Diagnostics {
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
    fixture::check(Path::new("tests/fixtures"), CODES, &run);
}

/// The test that the fixtures are mistakes of has none.
#[test]
fn the_right_test_is_accepted() {
    let source = Source::new("right.test.ron", include_str!("right.test.ron"));
    let found = run(&source);
    assert!(found.is_empty(), "{found:?}");
}
