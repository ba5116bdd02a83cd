//! What exact shadow planes cost, and what a march of the same error costs: `cargo bench -p tyndall --bench shadows`.
//!
//! Prints the tables of the README of `shadow_planes` and writes them and the plots to `docs/shadows-*`. Everything runs
//! in the program itself, within one run, so that ratios hold on a machine that does other things too. Pictures are
//! 800×600, or as large as an argument says (then `out/` gets the files); errors are of a smaller picture of the same view,
//! against lit intervals of all triangles in double precision.
//!
//! The march is given the best of all: its error is that of a march in double precision each of whose steps knows for sure
//! whether it is lit, its time that of one that looks a shadow map up, and the map itself, which errs and costs besides, is
//! free. To the time of the planes the CPU's is added, for slices made anew as when the camera moves.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and stops where it cannot measure")]

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use rayon::prelude::*;
use tyndall_page::{Point, Unit, curves};
use tyndall_plugin::each_texel;
use tyndall_scene::{Extensions, Scene};
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::lights::incident;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::phase::phase;
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::scene::{Light, Scene as Twin};
use tyndall_shaders::shadows::lit_intervals;

/// Of the pictures that are timed, unless the first argument says otherwise (`-- 200x150`, for a quick look).
const SIZE: [u32; 2] = [800, 600];
/// Of the pictures whose error is measured.
const SMALL: [u32; 2] = [48, 36];
/// Where the time of a march is measured; it grows with the steps.
const TIMED_STEPS: u32 = 64;
/// What the project promises of the planes, at the 95th percentile.
const PROMISED: f64 = 5e-3;
const ROUNDS: usize = 3;

/// What the shipped plugins add to scenes.
fn extensions() -> Arc<Extensions> {
    let plugins = tyndall::shipped().iter().map(|plugin| plugin()).collect();
    tyndall_render::registry(plugins, &[]).unwrap().extensions().clone()
}

fn main() {
    let size = std::env::args().skip(1).find_map(|argument| {
        let (width, height) = argument.split_once('x')?;
        Some([width.parse().ok()?, height.parse().ok()?])
    });
    let size = size.unwrap_or(SIZE);
    let out = if size == SIZE { shipped("docs") } else { shipped("").join("out") };
    std::fs::create_dir_all(&out).unwrap();
    let bench = Bench { folder: tempfile::tempdir().unwrap(), size, out };
    let mut report = String::from("Measured by `cargo bench -p tyndall --bench shadows`, ");
    report += &format!("{}×{}, {}.\n\n", size[0], size[1], bench.adapter());
    let casters = bench.casters();
    report += &caster_table(&casters);
    bench.caster_plots(&casters);
    report += &bench.more_lights();
    report += &bench.more_casters();
    println!("\n{report}");
    bench.write("shadows-cost.md", &report);
}

/// A folder with a scene and graphs, in which the program runs.
struct Bench {
    folder: tempfile::TempDir,
    size: [u32; 2],
    /// Where plots and tables go.
    out: PathBuf,
}

/// One caster: what both ways take, and what they err by.
struct Measured {
    name: &'static str,
    triangles: usize,
    /// p95 of the planes.
    error: f64,
    planes_ms: f64,
    /// Slices for a camera that moved.
    slices_ms: f64,
    /// Silhouettes and slices.
    first_ms: f64,
    mebibytes: f64,
    /// Of `TIMED_STEPS` steps with a map.
    march_ms: f64,
    /// Steps and p95 of the march.
    march: Vec<(u32, f64)>,
}

/// A pixel, and what of its ray each light reaches.
struct Seen {
    ray: Ray,
    /// m.
    way: f64,
    lit: Vec<Vec<[f64; 2]>>,
    /// Airlight in the first channel, between all triangles, in double precision.
    airlight: f64,
}

/// Steps of the marches whose error is found.
const STEPS: [u32; 6] = [64, 256, 1024, 4096, 16384, 65536];

impl Measured {
    fn planes(&self) -> f64 {
        self.planes_ms + self.slices_ms
    }

    /// Time of a march of so many steps, ms.
    fn march_of(&self, steps: f64) -> f64 {
        self.march_ms * steps / f64::from(TIMED_STEPS)
    }

    /// Steps at which the march errs by no more, and whether that many were marched: beyond them the error falls as it
    /// did between the last two.
    fn steps_for(&self, error: f64) -> (f64, bool) {
        let found = self.march.windows(2).find(|pair| pair[1].1 <= error);
        let (pair, measured) = (found.unwrap_or(&self.march[self.march.len() - 2..]), found.is_some());
        let [(few, high), (many, low)] = [pair[0], pair[1]].map(|(steps, error)| (f64::from(steps).ln(), error.ln()));
        let steps = (few + (error.ln() - high) * (many - few) / (low - high)).exp();
        (steps.max(1.0), measured || self.march[0].1 <= error)
    }

    /// What a march errs by that takes as long as the planes: there the ratio of the times at the same error is 1.
    fn error_of_same_time(&self) -> f64 {
        let steps = (f64::from(TIMED_STEPS) * self.planes() / self.march_ms).ln();
        let found = self.march.windows(2).find(|pair| f64::from(pair[1].0).ln() >= steps);
        let pair = found.unwrap_or(&self.march[self.march.len() - 2..]);
        let [(few, high), (many, low)] = [pair[0], pair[1]].map(|(steps, error)| (f64::from(steps).ln(), error.ln()));
        (high + (low - high) * (steps - few) / (many - few)).exp()
    }
}

impl Bench {
    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> String {
        let output = Command::new(env!("CARGO_BIN_EXE_tyndall"))
            .args(arguments)
            .current_dir(self.folder.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    fn adapter(&self) -> String {
        self.run(&["adapters"]).lines().next().unwrap_or_default().replace("(default)", "").trim().to_owned()
    }

    fn scene(&self, lights: &str, objects: &str) {
        let keys = "Keys([(0.0, (0.0, 1.8, 0.0)), (100.0, (0.1, 1.8, 0.0))])";
        let text = format!(
            "(
                camera: (position: {keys}, look_at: (0.3, 1.2, -7.0), vertical_fov: 50.0),
                medium: (extinction: (0.1, 0.1, 0.1), albedo: (0.9, 0.9, 0.9), phase: HenyeyGreenstein(g: 0.3)),
                lights: [{lights}],
                objects: [(mesh: Plane(size: (4000.0, 4000.0))), {objects}],
            )"
        );
        std::fs::write(self.path("bench.scene.ron"), text).unwrap();
    }

    /// A graph of one way to make airlight.
    fn graph(&self, way: &str) {
        let text = format!(
            "(version: 1, scene: \"bench.scene.ron\", passes: {{ \"surfaces\": (use: \"core.gbuffer\"), {way} }},
            outputs: {{ \"airlight\": \"air.radiance\", \"depth\": \"surfaces.depth\" }})"
        );
        std::fs::write(self.path("bench.graph.ron"), text).unwrap();
    }

    fn planes(&self) {
        self.graph("\"air\": (use: \"shadow_planes.exact\", inputs: { \"depth\": \"surfaces.depth\" })");
    }

    /// With a shadow map, of `TIMED_STEPS` steps.
    fn march(&self) {
        self.graph(&format!(
            "\"map\": (use: \"march.shadow_map\", params: {{ \"size\": 256 }}),
            \"air\": (use: \"march.airlight\",
                inputs: {{ \"depth\": \"surfaces.depth\", \"shadow_map\": \"map.distances\" }},
                params: {{ \"steps\": {TIMED_STEPS}, \"shadows\": true, \"maps\": true }})"
        ));
    }

    /// GPU time of the pass that makes the airlight, ms: once where it takes a second, else the median of several.
    fn time(&self) -> f64 {
        let once = self.time_of(1);
        if once > 1e3 { once } else { self.time_of(ROUNDS) }
    }

    fn time_of(&self, frames: usize) -> f64 {
        let size = self.size.map(|extent| extent.to_string()).join("x");
        let frames = frames.to_string();
        self.run(&["bench", "bench.graph.ron", "--size", &size, "--frames", &frames, "--json", "bench.json"]);
        let text = std::fs::read_to_string(self.path("bench.json")).unwrap();
        let figures: serde_json::Value = serde_json::from_str(&text).unwrap();
        let passes = figures["passes"].as_array().unwrap();
        passes.iter().find(|pass| pass["name"] == "air").unwrap()["gpu_us"].as_f64().unwrap() / 1e3
    }

    fn read(&self, output: &str) -> tyndall_image::Image {
        let (size, file) = (SMALL.map(|extent| extent.to_string()).join("x"), format!("{output}.npy"));
        self.run(&["render", "bench.graph.ron", "--size", &size, "--output", &format!("{output}={file}")]);
        tyndall_image::read(&self.path(&file)).unwrap()
    }

    fn load(&self) -> Scene {
        Scene::load(&self.path("bench.scene.ron"), &Vec::new(), &extensions()).unwrap().0
    }

    /// Every pixel of the small picture.
    fn truth(&self, scene: &Twin) -> Vec<Seen> {
        self.planes();
        let depth = self.read("depth");
        each_texel([SMALL[0], SMALL[1], 1], |[x, y, _]| {
            let (ray, way) = (ray_of_pixel(&scene.camera, [x, y], SMALL), depth.data[(y * SMALL[0] + x) as usize]);
            let way = f64::from(way);
            let lit: Vec<_> =
                scene.lights.iter().map(|light| lit_intervals(light, &scene.casters, &ray, way)).collect();
            let of_light = |(light, lit): (&Light, &Vec<[f64; 2]>)| {
                lit.iter().map(|[near, far]| airlight(light, &scene.medium, &ray, *near, *far).x).sum::<f64>()
            };
            let sum = scene.lights.iter().zip(&lit).map(of_light).sum();
            Seen { ray, way, lit, airlight: sum }
        })
    }

    /// p95 of the relative error of the picture of the graph.
    fn error(&self, truth: &[Seen]) -> f64 {
        let picture = self.read("airlight");
        error(truth, picture.data.iter().step_by(picture.channels as usize).map(|found| f64::from(*found)))
    }

    /// CPU time of silhouettes and slices, and of slices alone after the camera moved, ms, and their MiB.
    fn slices(&self) -> (f64, f64, f64) {
        let scene = self.load();
        let aspect = f64::from(self.size[0]) / f64::from(self.size[1]);
        let reads = |name: &str| name.starts_with("shadow_");
        let start = Instant::now();
        let mut encoded = scene.encode_for(0.0, aspect, &reads);
        let first = start.elapsed().as_secs_f64() * 1e3;
        let mut moved: Vec<f64> = (1..=ROUNDS)
            .map(|frame| {
                let start = Instant::now();
                encoded.update(&scene, frame as f64, aspect);
                start.elapsed().as_secs_f64() * 1e3
            })
            .collect();
        moved.sort_by(f64::total_cmp);
        let bytes: usize = encoded.items.iter().map(|(_, bytes)| bytes.len()).sum();
        (first, moved[ROUNDS / 2], bytes as f64 / f64::from(1 << 20))
    }

    fn casters(&self) -> Vec<Measured> {
        let body = |path: &Path| format!("(mesh: File(\"{}\"), translation: (-0.9, 1.7, -5.7))", path.display());
        let blob = |name: &str, around: u32, along: u32| {
            write_blob(self.folder.path(), name, around, along);
            body(Path::new(&format!("{name}.gltf")))
        };
        let tree = shipped("graphs/scenes/shadows/models/tree.glb");
        let tree = format!("(mesh: File(\"{}\"), scale: 0.55, translation: (-0.9, 0.0, -5.7))", tree.display());
        let casters = [
            ("box", "(mesh: Box(size: (1.2, 1.0, 1.0)), translation: (-1.0, 1.4, -5.7))".to_owned()),
            ("body", blob("coarse", 100, 76)),
            ("body", blob("fine", 250, 221)),
            ("body", blob("finest", 280, 251)),
            ("tree", tree),
        ];
        casters.into_iter().map(|(name, object)| self.caster(name, &object)).collect()
    }

    fn caster(&self, name: &'static str, object: &str) -> Measured {
        self.scene(LAMP, object);
        let triangles = self.load().instances.iter().map(|instance| instance.mesh.triangles.len()).sum::<usize>() - 2;
        let scene = self.load().twin(0.0, f64::from(SMALL[0]) / f64::from(SMALL[1]));
        let truth = self.truth(&scene);
        let error = self.error(&truth);
        let planes_ms = self.time();
        let (first_ms, slices_ms, mebibytes) = self.slices();
        let march = STEPS.map(|steps| {
            let marched: Vec<f64> = truth.par_iter().map(|seen| march(&scene, seen, steps)).collect();
            (steps, crate::error(&truth, marched.into_iter()))
        });
        self.march();
        let march_ms = self.time_of(1);
        println!(
            "{name}, {triangles} triangles: p95 {error:.1e}, {planes_ms:.0} ms; march {march:?}, {march_ms:.0} ms"
        );
        let march = march.to_vec();
        Measured { name, triangles, error, planes_ms, slices_ms, first_ms, mebibytes, march_ms, march }
    }

    /// A box and lamps about it.
    fn more_lights(&self) -> String {
        let mut table = String::from("\n| lights | planes | march, 64 steps |\n| ---: | ---: | ---: |\n");
        let mut points = Vec::new();
        for count in [1, 2, 4, 8] {
            let lamp = |i: u32| {
                let angle = TAU * f64::from(i) / 8.0;
                let (x, z) = (-0.9 + 2.6 * angle.cos(), -5.9 + 2.6 * angle.sin());
                format!("Point(position: ({x:.3}, 3.3, {z:.3}), intensity: (30.0, 27.0, 21.0)),")
            };
            let lights: String = (0..count).map(lamp).collect();
            self.scene(&lights, "(mesh: Box(size: (1.2, 1.0, 1.0)), translation: (-1.0, 1.4, -5.7))");
            self.planes();
            let planes = self.time();
            self.march();
            let march = self.time_of(1);
            writeln!(table, "| {count} | {planes:.0} ms | {march:.0} ms |").unwrap();
            let last = count == 8;
            points.extend([
                mark(0, "planes", last, f64::from(count), planes),
                mark(1, "march, 64 steps", last, f64::from(count), march),
            ]);
        }
        self.plot(
            "lights",
            ("Lights", "A box: time of the pass `air`"),
            [("lights", Unit::Count), ("time", Unit::Milliseconds)],
            None,
            &points,
        );
        table
    }

    /// Boxes in boxes, whose shadows overlap, and boxes side by side, which cut the light into as many parts and one more.
    fn more_casters(&self) -> String {
        let mut table = String::from("\n| boxes | one in the other | side by side |\n| ---: | ---: | ---: |\n");
        let mut points = Vec::new();
        for count in [1, 2, 4, 8, 16, 32] {
            let boxes = |of: &dyn Fn(f64) -> String| {
                (0..count).map(|i| of(f64::from(i) / f64::from(count))).collect::<String>()
            };
            let nested = boxes(&|part| {
                let size = 1.2 - 0.6 * part;
                format!("(mesh: Box(size: ({size:.4}, {size:.4}, {size:.4})), translation: (-1.0, 1.4, -5.7)),")
            });
            let beside = boxes(&|part| {
                let width = 1.4 / f64::from(count);
                format!(
                    "(mesh: Box(size: ({width:.4}, 1.0, 0.1)), translation: ({:.4}, 1.6, -5.7)),",
                    -2.2 + 2.8 * part
                )
            });
            let times = [nested, beside].map(|objects| {
                self.scene(LAMP, &objects);
                self.planes();
                self.time()
            });
            writeln!(table, "| {count} | {:.0} ms | {:.0} ms |", times[0], times[1]).unwrap();
            let last = count == 32;
            let count = f64::from(count);
            points.extend([
                mark(0, "one in the other", last, count, times[0]),
                mark(1, "side by side", last, count, times[1]),
            ]);
        }
        self.plot(
            "overlap",
            ("Overlapping shadows", "Exact shadow planes of boxes: time of the pass `air`"),
            [("boxes", Unit::Count), ("time", Unit::Milliseconds)],
            None,
            &points,
        );
        table
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.out.join(name);
        std::fs::write(&path, text).unwrap();
        println!("wrote {}", path.display());
    }

    fn plot(
        &self,
        name: &str,
        (title, note): (&str, &str),
        quantities: [(&str, Unit); 2],
        rule: Option<f64>,
        points: &[Point],
    ) {
        let note = format!("{note}, {}×{}", self.size[0], self.size[1]);
        let svg = curves((title, &note), quantities, rule, points).unwrap();
        self.write(&format!("shadows-{name}.svg"), &svg);
    }

    fn caster_plots(&self, casters: &[Measured]) {
        let bodies: Vec<&Measured> = casters.iter().filter(|of| of.name != "tree").collect();
        let last = bodies.len() - 1;
        let tree = casters.iter().find(|of| of.name == "tree").unwrap();
        let series = |family: usize, label: &str, of: &dyn Fn(&Measured) -> f64| -> Vec<Point> {
            let marks = bodies.iter().enumerate();
            let mut marks: Vec<Point> =
                marks.map(|(i, body)| mark(family, label, i == last, body.triangles as f64, of(body))).collect();
            marks.push(mark(family + 2, &format!("tree: {label}"), true, tree.triangles as f64, of(tree)));
            marks
        };
        let ratio = |error: Option<f64>| {
            move |of: &Measured| of.march_of(of.steps_for(error.unwrap_or(of.error)).0) / of.planes()
        };
        let ratios = [series(0, "same p95", &ratio(None)), series(1, "p95 of 0.5 %", &ratio(Some(PROMISED)))].concat();
        self.plot(
            "crossover",
            (
                "March over exact shadow planes: time at the same error",
                "Above the line the planes win. One lamp; the map of the march is free and perfect",
            ),
            [("triangles that cast shadows", Unit::Count), ("time of the march/time of the planes", Unit::Ratio)],
            Some(1.0),
            &ratios,
        );
        let times =
            [series(0, "planes, GPU", &|of| of.planes_ms), series(1, "slices, CPU", &|of| of.slices_ms)].concat();
        self.plot(
            "triangles",
            ("Triangles", "Exact shadow planes, one lamp"),
            [("triangles that cast shadows", Unit::Count), ("time of a frame", Unit::Milliseconds)],
            None,
            &times,
        );
        self.plot(
            "memory",
            ("Memory of the slices of one lamp", "Silhouette edges and their entries in slices"),
            [("triangles that cast shadows", Unit::Count), ("memory", Unit::Mebibytes)],
            None,
            &series(0, "slices", &|of| of.mebibytes),
        );
    }
}

/// p95 of the relative error, of every pixel; dark ones relative to 1 % of the mean.
fn error(truth: &[Seen], found: impl Iterator<Item = f64>) -> f64 {
    let floor = 0.01 * truth.iter().map(|seen| seen.airlight).sum::<f64>() / truth.len() as f64;
    let of_pixel = |(found, seen): (f64, &Seen)| (found - seen.airlight).abs() / seen.airlight.max(floor);
    let mut errors: Vec<f64> = found.zip(truth).map(of_pixel).collect();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() * 95 / 100]
}

/// Airlight in the first channel by equal steps, with the integrand at their middles, as `march.airlight` does it.
fn march(scene: &Twin, seen: &Seen, steps: u32) -> f64 {
    let medium = &scene.medium;
    let dx = seen.way.min(MARCH_DEPTH / medium.extinction.x) / f64::from(steps);
    let of_light = |(light, lit): (&Light, &Vec<[f64; 2]>)| -> f64 {
        let at = |step: u32| {
            let x = (f64::from(step) + 0.5) * dx;
            if !lit.iter().any(|[from, to]| (*from..*to).contains(&x)) {
                return 0.0;
            }
            let arriving = incident(light, seen.ray.at(x));
            // sin^2 of half the scattering angle
            let w = (seen.ray.direction - arriving.to_light).length_squared() / 4.0;
            let reaches = transmittance(medium, arriving.way).x * transmittance(medium, x).x;
            medium.scattering().x * arriving.irradiance.x * phase(&medium.phase, w) * reaches * dx
        };
        (0..steps).map(at).sum()
    };
    scene.lights.iter().zip(&seen.lit).map(of_light).sum()
}

/// Where `march.airlight` ends.
const MARCH_DEPTH: f64 = 16.0;

const LAMP: &str = "Point(position: (-1.7, 3.3, -7.2), intensity: (100.0, 90.0, 70.0))";

fn shipped(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path).canonicalize().unwrap()
}

fn mark(family: usize, label: &str, is_named: bool, x: f64, y: f64) -> Point {
    Point { label: if is_named { label.to_owned() } else { String::new() }, family, x, y }
}

fn caster_table(casters: &[Measured]) -> String {
    let mut table = String::from(
        "| caster | triangles | planes, p95 | planes, GPU | slices, CPU | all of the CPU's | memory | march, 64 steps | steps for this p95 | march/planes | steps for p95 of 0.5 % | march/planes | p95 of a march of the same time |\n\
         | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for of in casters {
        let steps = |error: f64| {
            let (steps, measured) = of.steps_for(error);
            let text = if measured { format!("{steps:.0}") } else { format!("≈ {steps:.0}") };
            let ratio = of.march_of(steps) / of.planes();
            let ratio = if ratio >= 100.0 { format!("{ratio:.0}") } else { format!("{ratio:.1}") };
            (text, ratio)
        };
        let ((same, same_ratio), (promised, promised_ratio)) = (steps(of.error), steps(PROMISED));
        writeln!(
            table,
            "| {} | {} | {:.1e} | {:.0} ms | {:.1} ms | {:.1} ms | {:.2} MiB | {:.0} ms | {same} | {same_ratio} | {promised} | {promised_ratio} | {:.2} % |",
            of.name, of.triangles, of.error, of.planes_ms, of.slices_ms, of.first_ms, of.mebibytes, of.march_ms, 100.0 * of.error_of_same_time()
        )
        .unwrap();
    }
    let crossing = |error: f64| {
        let ratios = casters.iter().filter(|of| of.name != "tree");
        let ratios: Vec<(f64, f64)> = ratios
            .map(|of| {
                ((of.triangles as f64).ln(), (of.march_of(of.steps_for(error.max(of.error)).0) / of.planes()).ln())
            })
            .collect();
        let at = ratios.windows(2).find(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0)).map(|pair| {
            let part = pair[0].1 / (pair[0].1 - pair[1].1);
            (pair[0].0 + part * (pair[1].0 - pair[0].0)).exp()
        });
        at.map_or_else(
            || {
                format!(
                    "the ratio does not cross 1 (it is {:.1} at the most triangles)",
                    ratios.last().unwrap().1.exp()
                )
            },
            |at| format!("the ratio crosses 1 at {at:.0} triangles"),
        )
    };
    table + &format!("\nAt the same p95 {}; at a p95 of 0.5 % {}.\n", crossing(0.0), crossing(PROMISED))
}

/// A closed body with bumps, as glTF: 2 * around * (along - 1) triangles.
fn write_blob(folder: &Path, name: &str, around: u32, along: u32) {
    let vertex = |i: u32, j: u32| {
        let (longitude, latitude) =
            (TAU * f64::from(i % around) / f64::from(around), PI * f64::from(j) / f64::from(along));
        let radius = 0.55 * (1.0 + 0.22 * (5.0 * longitude).sin() * (4.0 * latitude).sin() * latitude.sin());
        // the vertices of a pole are one
        let across = if j.is_multiple_of(along) { 0.0 } else { latitude.sin() };
        radius * DVec3::new(across * longitude.cos(), latitude.cos(), across * longitude.sin())
    };
    let mut bytes = Vec::new();
    for (j, i) in (0..=along).flat_map(|j| (0..around).map(move |i| (j, i))) {
        vertex(i, j).as_vec3().to_array().into_iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    }
    let vertices = around * (along + 1);
    let index = |i: u32, j: u32| j * around + i % around;
    let mut triangles = 0_u32;
    for (j, i) in (0..along).flat_map(|j| (0..around).map(move |i| (j, i))) {
        let [a, b, c, d] = [index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)];
        let first = (j + 1 < along).then_some([a, c, b]);
        let second = (j > 0).then_some([a, d, c]);
        for triangle in first.into_iter().chain(second) {
            triangles += 1;
            triangle.into_iter().for_each(|index| bytes.extend(index.to_le_bytes()));
        }
    }
    let (points, indices) = (12 * vertices, 12 * triangles);
    let text = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],
        \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\"indices\":1}}]}}],
        \"buffers\":[{{\"uri\":\"{name}.bin\",\"byteLength\":{}}}],
        \"bufferViews\":[{{\"buffer\":0,\"byteLength\":{points}}},{{\"buffer\":0,\"byteOffset\":{points},\"byteLength\":{indices}}}],
        \"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":{vertices},\"type\":\"VEC3\",\"min\":[-1,-1,-1],\"max\":[1,1,1]}},
        {{\"bufferView\":1,\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}]}}",
        points + indices,
        3 * triangles
    );
    std::fs::write(folder.join(format!("{name}.bin")), bytes).unwrap();
    std::fs::write(folder.join(format!("{name}.gltf")), text).unwrap();
}
