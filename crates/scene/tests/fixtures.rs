//! Every code has a fixture that pins its text and position.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostics, OUT_OF_RANGE, Source, fixture};
use tyndall_scene::{CODES, Override, Overrides, Scene};

/// Lines `// --set scene.PATH=VALUE` of a fixture are arguments of the command line.
fn overrides(text: &str) -> Overrides {
    let mut out = Diagnostics::default();
    let read = |line: &str| {
        let argument = line.strip_prefix("// ")?;
        let (path, value) = argument.strip_prefix("--set scene.")?.split_once('=')?;
        Some(Override::read(path, value, argument, &mut out).expect("the value is RON"))
    };
    text.lines().filter_map(read).collect()
}

fn run(source: &Arc<Source>) -> Diagnostics {
    match Scene::from_source(source, Path::new("tests/fixtures"), &overrides(source.text()), &Arc::default()) {
        Ok((_, warnings)) => warnings,
        Err(mistakes) => mistakes,
    }
}

#[test]
fn every_code_has_its_text() {
    fixture::check(Path::new("tests/fixtures"), &[CODES, &[OUT_OF_RANGE]].concat(), &run);
}

/// The codes of the document crate that scene files cause as well.
#[test]
fn mistakes_of_the_document_are_told() {
    let codes = |text: &str| {
        let diagnostics = run(&Source::new("test.scene.ron", text));
        diagnostics.iter().map(|d| d.code.0).collect::<Vec<_>>()
    };
    let camera = "camera: (position: (0, 0, 1), look_at: (0, 0, 0))";
    assert_eq!(codes(&format!("({camera}, lamps: [])")), ["unknown-field"]);
    assert_eq!(codes(&format!("({camera}, lights: [Pint()])")), ["unknown-variant"]);
    assert_eq!(codes(&format!("({camera}, lights: [Point()])")), ["missing-field", "missing-field"]);
    assert_eq!(codes(&format!("({camera}, background: (NaN, 0, inf))")), ["not-finite", "not-finite"]);
    assert_eq!(codes(&format!("({camera}, background: 3)")), ["wrong-type"]);
    assert_eq!(codes(&format!("({camera}, objects: [(mesh: File(\"nowhere.glb\"))])")), ["missing-file"]);
    assert_eq!(codes(&format!("({camera}, background: (0, 0, 0), background: (0, 0, 0))")), ["duplicate-name"]);
    assert_eq!(
        codes(&format!("({camera}, lights: [Point(position: Keys([(NaN, (0, 0, 0))]), intensity: (1, 1, 1))])")),
        ["not-finite"]
    );
    assert_eq!(codes("(camera: (position: (0, 0, 1)))"), ["missing-field"]);
    assert_eq!(codes(&format!("({camera}, medium: (base_height: 3))")), ["missing-field"]);
    assert_eq!(codes(&format!("({camera}, medium: (phase: Measured(\"nowhere.txt\")))")), ["missing-file"]);
    assert_eq!(codes(&format!("({camera}, medium: (phase: Measured(3)))")), ["wrong-type"]);
}

/// All mistakes of a file at once, in its order.
#[test]
fn all_mistakes_at_once() {
    let text = "(
        camera: (position: (0, 0, 1), look_at: (0, 0, 1), vertical_fov: 180),
        medium: (extinction: (-1, 0, 0), phase: HenyeyGreenstein(g: 1)),
        lights: [Spot(position: (0, 0, 0), direction: (0, 0, 0), intensity: (1, 1, -1), cutoff: 91)],
        objects: [(mesh: Sphere(radius: 0), scale: 0), (mesh: Torus(major: 1, minor: 1)), (mesh: File(\"models/none.glb\"))],
    )";
    let diagnostics = run(&Source::new("test.scene.ron", text));
    let messages: Vec<_> = diagnostics.iter().map(|d| d.code.0).collect();
    let expected = [
        "camera-on-target",
        "out-of-range",
        "out-of-range",
        "out-of-range",
        "zero-direction",
        "out-of-range",
        "out-of-range",
        "out-of-range",
        "out-of-range",
        "out-of-range",
    ];
    assert_eq!(messages, expected);
}
