//! `compare`: figures, tables and a page, from two methods and one scene to what is refused.

use std::collections::BTreeSet;

use serde_json::Value;
use tyndall_image::read;
use tyndall_tests::{Desk, shipped};

use crate::run::Program;

/// A lamp in view, drawn by the shipped graphs.
fn desk() -> Desk {
    let desk = Desk::new();
    for graph in ["airlight", "reference", "froxels"] {
        let text = std::fs::read_to_string(shipped(graph)).unwrap();
        desk.put(&format!("graphs/{graph}.graph.ron"), &text.replace("scenes/pavilion", "lamp"));
    }
    let lamp = std::fs::read_to_string(shipped("airlight").with_file_name("scenes/compare/lamp.scene.ron")).unwrap();
    desk.put("graphs/lamp.scene.ron", &lamp);
    desk.put(
        "graphs/light.compare.ron",
        r#"(
            version: 1,
            about: "Two <marches> & more",
            output: "airlight",
            size: (32, 24),
            scenes: {
                "lamp": (scene: "lamp.scene.ron"),
                "lamp, denser": (scene: "lamp.scene.ron", set: { "scene.medium.extinction": (0.3, 0.3, 0.3) }),
            },
            methods: {
                "march, 16": (graph: "reference.graph.ron", set: { "steps": 16, "shadows": false }),
                "march, 1024": (graph: "reference.graph.ron", set: { "steps": 1024, "shadows": false }),
                "quadrature": (graph: "airlight.graph.ron"),
                "froxels": (graph: "froxels.graph.ron", set: { "froxels.width": 16, "froxels.height": 12, "froxels.slices": 64 }),
            },
        )"#,
    );
    desk
}

fn method<'a>(rows: &'a Value, name: &str) -> &'a Value {
    rows.as_array().unwrap().iter().find(|row| row["method"] == name).unwrap()
}

fn error(rows: &Value, name: &str, which: &str) -> f64 {
    method(rows, name)["error"][which].as_f64().unwrap()
}

#[test]
fn figures_tell_the_methods_apart() {
    let desk = desk();
    let ended = desk.ends(0, &["compare", "--scene", "LAMP", "--rounds", "2", "--json", "figures.json"]);
    let figures: Value = serde_json::from_str(&std::fs::read_to_string(desk.path("figures.json")).unwrap()).unwrap();
    assert_eq!(figures["size"], serde_json::json!([32, 24]));
    assert_eq!(figures["scenes"].as_array().unwrap().len(), 2);
    for scene in figures["scenes"].as_array().unwrap() {
        let rows = &scene["methods"];
        for which in ["p50", "p99", "max"] {
            let [few, many, quadrature] =
                ["march, 16", "march, 1024", "quadrature"].map(|name| error(rows, name, which));
            assert!(many < 0.2 * few, "{which}: {many} against {few}");
            assert!(quadrature < 1e-3, "{which}: {quadrature}");
        }
        // A grid that is coarser than the picture is about right, and wrong at the core.
        assert!(error(rows, "froxels", "p50") < 0.03 && error(rows, "froxels", "max") > 0.05, "{rows}");
        for row in rows.as_array().unwrap() {
            assert!(row["gpu_us"].is_null() || row["gpu_us"].as_f64().unwrap() > 0.0);
            // A march binds the hierarchy of triangles, which is empty here.
            let once = row["set_up_bytes"].as_u64().unwrap();
            assert!(
                once == 0 || once < 128 && row["method"].as_str().unwrap().contains("march"),
                "nothing here is a table: {row}"
            );
        }
        assert_eq!(method(rows, "quadrature")["bytes"], 32 * 24 * 16);
        // two grids, the far ends of the columns, where the slices stand, and the picture
        let froxels = 2 * 16 * 12 * 64 * 16 + 16 * 12 * 16 + 16 + 32 * 24 * 16;
        assert_eq!(method(rows, "froxels")["bytes"], froxels);
    }
    let worst =
        |name| figures["scenes"].as_array().unwrap().iter().map(move |scene| error(&scene["methods"], name, "max"));
    assert_eq!(error(&figures["all"], "march, 16", "max"), worst("march, 16").fold(0.0, f64::max));
    for part in ["march, 1024", "lamp, denser", "p99", "1 % of the picture's mean", "wrote out/compare/index.html"] {
        assert!(ended.out.contains(part), "no {part} in {}", ended.out);
    }
    let markdown = std::fs::read_to_string(desk.path("out/compare/table.md")).unwrap();
    assert!(markdown.lines().filter(|line| line.starts_with("| march, 16 |")).count() == 3, "{markdown}");
}

/// Values of an attribute.
fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    html.split(start.as_str()).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn the_page_needs_nothing_but_its_folder() {
    let desk = desk();
    desk.ends(0, &["compare", "graphs/light.compare.ron", "--rounds", "1", "--out", "page"]);
    let html = std::fs::read_to_string(desk.path("page/index.html")).unwrap();
    let mut shown = BTreeSet::new();
    for name in ["src", "data-found", "data-error"] {
        let paths = attributes(&html, name);
        assert!(paths.len() >= 8, "{name}");
        shown.extend(paths);
    }
    for path in &shown {
        let picture = read(&desk.path("page").join(path)).unwrap();
        assert_eq!((picture.width, picture.height), (32, 24), "{path}");
    }
    let mut files = desk.files("page/pictures");
    files.iter_mut().for_each(|name| name.insert_str(0, "pictures/"));
    assert_eq!(files, shown.into_iter().collect::<Vec<_>>(), "every picture is shown, and there");
    for target in attributes(&html, "href") {
        let id = target.strip_prefix('#').unwrap();
        assert!(html.contains(&format!("id=\"{id}\"")), "{target}");
    }
    let named = html.replace("http://www.w3.org/2000/svg", "");
    for outside in ["http:", "https:", "//cdn", "@import", "<link", "url(//"] {
        assert!(!named.contains(outside), "{outside}");
    }
    assert!(html.contains("Two &lt;marches&gt; &amp; more") && !html.contains("<marches>"));
    assert!(html.contains("prefers-color-scheme: dark") && html.contains("<svg class=\"plot\""));
    let plot = std::fs::read_to_string(desk.path("page/plot.svg")).unwrap();
    assert!(plot.contains(">march, 1024</text>") && plot.contains("class=\"front\""));
}

/// The map of a perfect picture is dark, and that of a wrong one bright where it is wrong.
#[test]
fn pictures_show_what_the_figures_say() {
    let desk = desk();
    desk.ends(0, &["compare", "--scene", "denser", "--method", "march, 16", "--method", "quad", "--rounds", "1"]);
    let picture = |name: &str| read(&desk.path(&format!("out/compare/pictures/1-lamp-denser.{name}.png"))).unwrap();
    let mean = |name: &str| {
        let picture = picture(name).first_channels(3);
        picture.data.iter().map(|value| f64::from(*value)).sum::<f64>() / picture.data.len() as f64
    };
    assert!(mean("1-march-16.error") > 2.0 * mean("2-quadrature.error"));
    let (truth, found) = (picture("truth"), picture("2-quadrature"));
    let worst = truth.data.iter().zip(&found.data).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst < 0.02, "{worst}");
    assert!((mean("truth") - mean("1-march-16")).abs() > 0.005);
    let html = std::fs::read_to_string(desk.path("out/compare/index.html")).unwrap();
    assert!(!html.contains("1024") && html.contains("march, 16"));
}

#[test]
fn what_is_wrong_is_told_and_nothing_is_written() {
    let desk = desk();
    desk.put("there", "");
    desk.put(
        "graphs/broken.graph.ron",
        "(version: 1, passes: { \"air\": (use: \"air.nothing\") }, outputs: { \"airlight\": \"air.radiance\" })",
    );
    let text = std::fs::read_to_string(desk.path("graphs/light.compare.ron")).unwrap();
    desk.put("graphs/broken.compare.ron", &text.replace("\"airlight.graph.ron\"", "\"broken.graph.ron\""));
    let file = "graphs/light.compare.ron";
    let cases: [(&[&str], &str); 8] = [
        (&["compare", "missing.compare.ron"], "missing.compare.ron"),
        (&["compare", file, "--scene", "lump"], "`lamp, denser`"),
        (&["compare", file, "--method", "ray"], "`quadrature`"),
        (&["compare", file, "--size", "32"], "32"),
        (&["compare", file, "--rounds", "0"], "0"),
        (&["compare", file, "--out", "there"], "there is not a folder"),
        (&["compare", "graphs/broken.compare.ron"], "air.nothing"),
        (&["compare", "graphs/broken.compare.ron"], "`quadrature` uses it"),
    ];
    for (arguments, part) in cases {
        let ended = desk.ends(2, arguments);
        assert!(ended.err.contains(part), "{arguments:?} does not say {part}: {}", ended.err);
    }
    desk.ends(3, &["compare", file, "--adapter", "no such adapter"]);
    desk.ends(3, &["compare", file, "--size", "100000x100000"]);
    assert!(desk.files("out").is_empty());
}

/// What the machine cannot do names the method: a grid that no adapter holds.
#[test]
fn a_method_that_the_machine_cannot_run_is_named() {
    let desk = desk();
    let text = std::fs::read_to_string(desk.path("graphs/light.compare.ron")).unwrap();
    let text = text.replace("\"froxels.slices\": 64", "\"froxels.slices\": 2048");
    desk.put(
        "graphs/huge.compare.ron",
        &text.replace(": 16, \"froxels.height\": 12", ": 2048, \"froxels.height\": 2048"),
    );
    let ended = desk.ends(3, &["compare", "graphs/huge.compare.ron", "--method", "froxels"]);
    assert!(ended.err.contains("method `froxels` cannot draw scene `lamp`"), "{}", ended.err);
    assert!(desk.files("out").is_empty());
}
