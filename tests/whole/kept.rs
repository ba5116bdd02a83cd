//! Results are kept where nothing that they are made from has changed, and are then what a fresh frame would give.

use std::collections::BTreeSet;

use crate::support::{
    FOG, LIGHTS, Random, bits, content, executor, gpu, planned, registry, run_all, scene, set_scene, with_plugin,
};
use tyndall_gpu::{Executor, FrameOptions};
use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{Keep, Order};

const OUTPUTS: [&str; 4] = ["radiance", "airlight", "surface", "image"];

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// How often each pass has run, by name.
fn runs(executor: &Executor) -> Vec<(String, u64)> {
    let counters = executor.counters().entries();
    counters.map(|(pass, counters)| (executor.plan().pass_name(pass).to_owned(), counters.runs)).collect()
}

/// The plan has said which passes run once, and which in every frame.
fn ran_as_planned(executor: &Executor, frames: u64) {
    for (pass, counters) in executor.counters().entries() {
        let planned = if executor.plan().passes[pass].volatile { frames } else { 1 };
        assert_eq!(counters.runs, planned, "runs of `{}`", executor.plan().pass_name(pass));
    }
}

#[test]
fn only_tone_mapping_runs_again_where_only_its_exposure_changes() {
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(LIGHTS));
    let keep = Keep::Edges { live: set(&["display.exposure"]), animated: BTreeSet::new() };
    let mut kept = executor(&gpu, &registry, planned(&registry, FOG, |_, options| options.keep = keep));
    let mut images = BTreeSet::new();
    for frame in 0..10 {
        let exposure = ParamValue::Float(0.25 * f64::from(frame + 1));
        set_scene(&mut kept, &scene, 0.0);
        kept.set_param("display", "exposure", exposure.clone()).unwrap();
        let report = kept.frame(FrameOptions { frame, ..FrameOptions::default() }).unwrap();
        assert_eq!(report.passes_run, if frame == 0 { 5 } else { 1 });

        let mut fresh = executor(&gpu, &registry, planned(&registry, FOG, |_, _| ()));
        set_scene(&mut fresh, &scene, 0.0);
        fresh.set_param("display", "exposure", exposure).unwrap();
        run_all(&mut fresh);
        for output in OUTPUTS {
            let (ours, expected) = (content(&kept, output), content(&fresh, output));
            assert!(ours.floats().iter().any(|number| *number > 0.0), "`{output}` is black");
            assert_eq!(bits(&ours), bits(&expected), "`{output}` of frame {frame}");
        }
        images.insert(bits(&content(&kept, "image")));
    }
    assert_eq!(images.len(), 10, "every exposure shows");
    for (pass, runs) in runs(&kept) {
        assert_eq!(runs, if pass == "display" { 10 } else { 1 }, "runs of `{pass}`");
    }
    ran_as_planned(&kept, 10);
}

#[test]
fn a_scene_that_moves_runs_its_readers_alone() {
    let moving =
        "Point(position: Keys([(0.0, (1.0, 2.5, 0.0)), (1.0, (-1.0, 2.5, 0.0))]), intensity: (20.0, 18.0, 15.0))";
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(moving));
    assert_eq!(scene.animated()[0], "lights");
    let keep = Keep::Edges { live: BTreeSet::new(), animated: set(&["lights"]) };
    let mut kept = executor(&gpu, &registry, planned(&registry, FOG, |_, options| options.keep = keep));
    for frame in 0..6_u32 {
        let time = f64::from(frame) / 24.0;
        set_scene(&mut kept, &scene, time);
        kept.frame(FrameOptions { frame, ..FrameOptions::default() }).unwrap();
        let mut fresh = executor(&gpu, &registry, planned(&registry, FOG, |_, _| ()));
        set_scene(&mut fresh, &scene, time);
        run_all(&mut fresh);
        for output in OUTPUTS {
            assert_eq!(bits(&content(&kept, output)), bits(&content(&fresh, output)), "`{output}` of frame {frame}");
        }
    }
    for (pass, runs) in runs(&kept) {
        assert_eq!(runs, if pass == "surfaces" { 1 } else { 6 }, "runs of `{pass}`");
    }
    ran_as_planned(&kept, 6);
}

/// The passes of `surface_radiance` that make tables, and what reads them.
const SCATTERED: &str = r#"(
    version: 1,
    size: (40, 30),
    passes: {
        "surfaces": (use: "core.gbuffer"),
        "around": (use: "surface_radiance.zonal"),
        "lobes": (use: "surface_radiance.lobes", inputs: { "glow": "around.glow", "coefficients": "around.coefficients" }),
        "lit": (
            use: "surface_radiance.phong",
            inputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material", "table": "lobes.table" },
        ),
    },
    outputs: { "radiance": "lit.radiance" },
)"#;

/// Tables of scattered light depend on the phase function and on the shapes of lobes, and on nothing else of a scene.
#[test]
fn tables_of_scattered_light_run_again_for_the_phase_function_alone() {
    let (gpu, registry) = (gpu(), registry(&[]));
    let mut kept = executor(&gpu, &registry, planned(&registry, SCATTERED, |_, _| ()));
    let mut expected = [0; 4];
    let mut frame = |phase: &str, density: f64, lamp: &str, runs_again: [u64; 4], what: &str| {
        let mut changed = scene(&format!("{lamp}, {LIGHTS}"));
        let medium = changed.medium.as_mut().unwrap();
        medium.extinction *= density;
        medium.phase = match phase {
            "forward" => tyndall_scene::Phase::HenyeyGreenstein { g: 0.7 },
            _ => tyndall_scene::Phase::Rayleigh,
        };
        set_scene(&mut kept, &changed, 0.0);
        kept.frame(FrameOptions::default()).unwrap();
        (0..4).for_each(|pass| expected[pass] += runs_again[pass]);
        let found = runs(&kept);
        let names = ["surfaces", "around", "lobes", "lit"];
        let wanted: Vec<(String, u64)> = names.map(str::to_owned).into_iter().zip(expected).collect();
        let sorted = |mut runs: Vec<(String, u64)>| {
            runs.sort();
            runs
        };
        assert_eq!(sorted(found), sorted(wanted), "{what}");
        let fresh = content(&kept, "radiance");
        assert!(fresh.floats().iter().any(|number| *number > 0.0));
        bits(&fresh)
    };
    let lamp = "Point(position: (0.0, 3.0, 1.0), intensity: (5.0, 5.0, 5.0))";
    let first = frame("forward", 1.0, lamp, [1, 1, 1, 1], "the first frame");
    assert_eq!(first, frame("forward", 1.0, lamp, [0, 0, 0, 0], "nothing new"));
    assert_ne!(first, frame("forward", 2.0, lamp, [0, 0, 0, 1], "another density"));
    let moved = "Point(position: (1.0, 2.0, 1.0), intensity: (7.0, 5.0, 5.0))";
    assert_ne!(first, frame("forward", 1.0, moved, [0, 0, 0, 1], "another place of a light"));
    assert_ne!(first, frame("rayleigh", 1.0, lamp, [0, 1, 1, 1], "another phase function"));
    let spot =
        "Spot(position: (0.0, 3.0, 1.0), intensity: (5.0, 5.0, 5.0), direction: (0.0, -1.0, 0.0), exponent: 2.0)";
    frame("rayleigh", 1.0, spot, [0, 0, 1, 1], "another shape of lobe");
}

#[test]
fn the_same_value_again_runs_nothing() {
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(LIGHTS));
    let mut kept = executor(&gpu, &registry, planned(&registry, FOG, |_, _| ()));
    for frame in 0..3 {
        set_scene(&mut kept, &scene, 0.0);
        kept.set_param("display", "exposure", ParamValue::Float(2.0)).unwrap();
        let report = kept.frame(FrameOptions::default()).unwrap();
        assert_eq!(report.passes_run, if frame == 0 { 5 } else { 0 });
    }
}

/// A value of another type than the parameter's must not reach the GPU's memory.
#[test]
fn a_value_of_another_type_is_refused() {
    let (gpu, registry) = (gpu(), registry(&[]));
    let mut display = executor(&gpu, &registry, planned(&registry, FOG, |_, _| ()));
    assert!(display.set_param("display", "exposure", ParamValue::Vector(vec![1.0; 4])).is_err());
    assert!(display.set_param("display", "curve", ParamValue::Choice("none of them".to_owned())).is_err());
    assert!(display.set_param("display", "curve", ParamValue::Choice("filmic".to_owned())).is_ok());
    assert!(display.set_param("display", "nothing", ParamValue::Float(1.0)).is_err());
    assert!(display.set_param("nobody", "exposure", ParamValue::Float(1.0)).is_err());
}

const PLUGIN: &str = r#"(
    name: "mix", version: "0.1.0", about: "For tests.",
    passes: {
        "change": (about: "In place: image * factor + 1.", shader: "change.wgsl",
            ports: { "image": (about: "Changed") },
            params: { "factor": (about: "Factor", default: 1.0) }),
        "follow": (about: "The frame before, mixed in.", shader: "follow.wgsl",
            ports: {
                "input": (about: "This frame"),
                "before": (about: "The frame before", history: (0.5, 0.25, 0.0, 1.0)),
                "mixed": (about: "Both", size: Same("input")),
            },
            params: { "factor": (about: "Weight of the frame before", default: 0.5) }),
    },
)"#;

const CHANGE: &str = "
struct Params { factor: f32 }
var<uniform> params: Params;
var image: texture_storage_2d<rgba32float, read_write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(image, id.xy, textureLoad(image, id.xy) * params.factor + 1.0);
}";

const FOLLOW: &str = "
struct Params { factor: f32 }
var<uniform> params: Params;
var input: texture_2d<f32>;
var before: texture_2d<f32>;
var mixed: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(mixed, id.xy, textureLoad(input, id.xy, 0) + params.factor * textureLoad(before, id.xy, 0));
}";

/// A graph of passes that each read one or two of those before; and the parameters that can be changed.
fn random_graph(random: &mut Random, passes: usize) -> (String, Vec<(String, &'static str)>) {
    let mut text = String::from("(version: 1, size: (4, 3), passes: {\n");
    let mut ports: Vec<String> = Vec::new();
    let mut params = Vec::new();
    let factor = |random: &mut Random| random.below(9) as f64 / 4.0 - 1.0;
    for index in 0..passes {
        let pass = format!("p{index}");
        let near = |random: &mut Random| ports[ports.len() - 1 - random.below(ports.len().min(6))].clone();
        let (line, port) = match if index < 2 { 0 } else { random.below(10) } {
            0 => (format!("(use: \"core.constant\", params: {{ \"value\": ({index}, 0.5, 0.25) }})"), "color"),
            1..=3 => {
                let (a, b) = (near(random), near(random));
                params.push((pass.clone(), "factor"));
                (
                    format!(
                        "(use: \"core.add\", inputs: {{ \"a\": \"{a}\", \"b\": \"{b}\" }}, params: {{ \"factor\": {} }})",
                        factor(random)
                    ),
                    "sum",
                )
            }
            4..=6 => {
                params.push((pass.clone(), "value"));
                (format!("(use: \"core.scale\", inputs: {{ \"input\": \"{}\" }})", near(random)), "scaled")
            }
            7..=8 => {
                params.push((pass.clone(), "factor"));
                (
                    format!(
                        "(use: \"mix.change\", inputs: {{ \"image\": \"{}\" }}, params: {{ \"factor\": {} }})",
                        near(random),
                        factor(random)
                    ),
                    "image",
                )
            }
            _ => {
                params.push((pass.clone(), "factor"));
                let (now, before) = (near(random), near(random));
                (
                    format!("(use: \"mix.follow\", inputs: {{ \"input\": \"{now}\", \"before\": \"{before}\" }})"),
                    "mixed",
                )
            }
        };
        text += &format!("\"{pass}\": {line},\n");
        ports.push(format!("{pass}.{port}"));
    }
    let middle = &ports[passes / 2];
    text += &format!("}}, outputs: {{ \"last\": \"{}\", \"middle\": \"{middle}\" }})", ports[passes - 1]);
    (text, params)
}

/// A value for a parameter of [`random_graph`]; there are few, so that some changes change nothing.
fn random_value(random: &mut Random, param: &str) -> ParamValue {
    let number = random.below(5) as f64 / 4.0 - 0.5;
    match param {
        "value" => ParamValue::Vector(vec![number, 1.0, -number]),
        _ => ParamValue::Float(number),
    }
}

/// Random changes in random graphs: what is kept, in shared memory, always equals what runs anew in memory of its own.
#[test]
fn what_is_kept_is_what_would_run() {
    let gpu = gpu();
    let registry = with_plugin("mix", &[("plugin.ron", PLUGIN), ("change.wgsl", CHANGE), ("follow.wgsl", FOLLOW)]);
    let (mut ran, mut kept_runs) = (0, 0);
    for seed in 1..=12_u64 {
        let random = &mut Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let (text, params) = random_graph(random, 16);
        let live = (0..2).map(|_| &params[random.below(params.len())]).map(|(pass, param)| format!("{pass}.{param}"));
        let keep = Keep::Edges { live: live.collect(), animated: BTreeSet::new() };
        let mut kept = executor(
            &gpu,
            &registry,
            planned(&registry, &text, |_, options| {
                if seed % 3 > 0 {
                    options.keep = keep;
                }
                if seed % 2 > 0 {
                    options.order = Order::Shuffled(seed);
                }
            }),
        );
        let mut fresh = executor(&gpu, &registry, planned(&registry, &text, |_, options| options.share = false));
        for step in 0..60 {
            for _ in 0..random.below(3) {
                let (pass, param) = &params[random.below(params.len())];
                let value = random_value(random, param);
                // A pass that nothing asks for is in neither plan.
                let done =
                    [&mut kept, &mut fresh].map(|executor| executor.set_param(pass, param, value.clone()).is_ok());
                assert_eq!(done[0], done[1]);
            }
            if random.below(10) == 0 {
                kept.poison(f32::NAN).unwrap();
            }
            ran += kept.frame(FrameOptions::default()).unwrap().passes_run;
            kept_runs += fresh.plan().passes.len();
            run_all(&mut fresh);
            for output in ["last", "middle"] {
                let (ours, expected) = (content(&kept, output), content(&fresh, output));
                assert_eq!(bits(&ours), bits(&expected), "`{output}`, step {step} of seed {seed} of\n{text}");
            }
        }
    }
    assert!(ran * 10 < kept_runs * 9, "{ran} of {kept_runs}: nothing was kept");
}
