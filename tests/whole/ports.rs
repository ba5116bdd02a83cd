//! Every kind of port does on a device what it declares: history, in-out, optional, off, buffers, 3D, every format.

use crate::support::{content, executor, gpu, planned, registry, run_all, with_plugin};
use tyndall_gpu::{FrameOptions, Numbers, wgpu};
use tyndall_graph::Roots;
use tyndall_plugin::Registry;

/// A plugin `t` of one pass, `t.p`.
fn one_pass(pass: &str, shader: &str) -> Registry {
    let manifest = format!(
        "(name: \"t\", version: \"0.1.0\", about: \"For tests.\",
          passes: {{ \"p\": (about: \"For tests.\", shader: \"p.wgsl\", {pass}) }})"
    );
    with_plugin("t", &[("plugin.ron", &manifest), ("p.wgsl", shader)])
}

const ACCUMULATE: &str = "
var input: texture_2d<f32>;
var before: texture_2d<f32>;
var sum: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(sum, id.xy, textureLoad(input, id.xy, 0) + textureLoad(before, id.xy, 0));
}";

const ACCUMULATE_PORTS: &str = r#"ports: {
    "input": (about: "Added in each frame"),
    "before": (about: "The sum so far", history: (100.0, 200.0, 300.0, 0.0)),
    "sum": (about: "The sum", size: Same("input")),
}"#;

#[test]
fn a_history_begins_as_declared_and_carries_over() {
    let registry = one_pass(ACCUMULATE_PORTS, ACCUMULATE);
    let text = r#"(version: 1, size: (5, 3), passes: {
        "one": (use: "core.constant", params: { "value": (1.0, 2.0, 3.0) }),
        "sum": (use: "t.p", inputs: { "input": "one.color", "before": "sum.sum" }),
    }, outputs: { "sum": "sum.sum" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    for frame in 1..=5_u16 {
        let report = executor.frame(FrameOptions { frame: frame.into(), ..FrameOptions::default() }).unwrap();
        // The constant is kept until its memory is poisoned, the sum runs in every frame.
        assert_eq!(report.passes_run, if matches!(frame, 1 | 4) { 2 } else { 1 });
        let n = f32::from(frame);
        let expected = [100.0 + n, 200.0 + 2.0 * n, 300.0 + 3.0 * n, n].repeat(15);
        assert_eq!(content(&executor, "sum").floats(), expected, "frame {frame}");
        if frame == 3 {
            executor.poison(f32::NAN).unwrap();
        }
    }
}

/// Nothing but a history reads the source: it runs all the same, and is carried over unharmed by who shares its memory.
#[test]
fn a_source_that_only_a_history_reads_is_carried_over() {
    let registry = one_pass(ACCUMULATE_PORTS, ACCUMULATE);
    let text = r#"(version: 1, size: (2, 2), passes: {
        "a": (use: "core.constant", params: { "value": (7.0, 8.0, 9.0) }),
        "b": (use: "core.scale", inputs: { "input": "a.color" }, params: { "factor": (2.0, 2.0, 2.0) }),
        "one": (use: "core.constant", params: { "value": (1.0, 1.0, 1.0) }),
        "sum": (use: "t.p", inputs: { "input": "one.color", "before": "b.scaled" }),
    }, outputs: { "sum": "sum.sum" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    for frame in 0..4 {
        executor.frame(FrameOptions::default()).unwrap();
        let expected = if frame == 0 { [101.0, 201.0, 301.0, 1.0] } else { [15.0, 17.0, 19.0, 2.0] };
        assert_eq!(content(&executor, "sum").floats(), expected.repeat(4), "frame {frame}");
    }
}

#[test]
fn an_in_out_port_makes_a_new_version_and_leaves_the_old_one() {
    let registry = one_pass(
        r#"ports: { "image": (about: "Changed in place") }"#,
        "var image: texture_storage_2d<rgba32float, read_write>;
        @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            textureStore(image, id.xy, textureLoad(image, id.xy) + 1.0);
        }",
    );
    let text = r#"(version: 1, size: (2, 2), passes: {
        "a": (use: "core.constant", params: { "value": (1.0, 2.0, 3.0) }),
        "b": (use: "t.p", inputs: { "image": "a.color" }),
        "c": (use: "t.p", inputs: { "image": "b.image" }),
        "off": (use: "t.p", inputs: { "image": "c.image" }, enabled: false),
    }, outputs: { "a": "a.color", "c": "c.image", "off": "off.image" })"#;
    for share in [true, false] {
        let plan = planned(&registry, text, |_, options| options.share = share);
        let mut executor = executor(&gpu(), &registry, plan);
        for _ in 0..2 {
            executor.frame(FrameOptions::default()).unwrap();
            assert_eq!(content(&executor, "a").floats(), [1.0, 2.0, 3.0, 1.0].repeat(4));
            assert_eq!(content(&executor, "c").floats(), [3.0, 4.0, 5.0, 3.0].repeat(4));
            assert_eq!(content(&executor, "off").floats(), content(&executor, "c").floats());
        }
    }
}

#[test]
fn what_flows_past_a_pass_that_is_off() {
    let registry = registry(&[]);
    let text = r#"(version: 1, size: (2, 1), passes: {
        "a": (use: "core.constant", params: { "value": (1.0, 2.0, 3.0) }),
        "passed": (use: "core.scale", inputs: { "input": "a.color" }, params: { "factor": (9.0, 9.0, 9.0) }, enabled: false),
        "constant": (use: "core.constant", params: { "value": (5.0, 5.0, 5.0) }, enabled: false),
        "sum": (use: "core.add", inputs: { "a": "passed.scaled", "b": "constant.color" }),
        "surfaces": (use: "core.gbuffer", enabled: false),
    }, outputs: { "sum": "sum.sum", "passed": "passed.scaled", "constant": "constant.color" })"#;
    let plan = planned(&registry, text, |_, options| options.roots = Roots::All);
    let mut executor = executor(&gpu(), &registry, plan);
    run_all(&mut executor);
    assert_eq!(content(&executor, "sum").floats(), [1.0, 2.0, 3.0, 1.0].repeat(2));
    assert_eq!(content(&executor, "passed").floats(), [1.0, 2.0, 3.0, 1.0].repeat(2));
    assert_eq!(content(&executor, "constant").floats(), [0.0, 0.0, 0.0, 1.0].repeat(2));
}

/// Every output of a pass that is off can be asked for, a rasteriser's depth too.
#[test]
fn constants_of_every_format_can_be_looked_at() {
    let registry = registry(&[]);
    let text = r#"(version: 1, size: (2, 1), passes: { "s": (use: "core.gbuffer", enabled: false) },
        outputs: { "depth": "s.depth", "raster": "s.raster_depth", "triangle": "s.triangle", "material": "s.material" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    run_all(&mut executor);
    assert_eq!(content(&executor, "depth").floats(), [f32::INFINITY; 2]);
    assert_eq!(content(&executor, "raster").floats(), [0.0; 2]);
    assert_eq!(content(&executor, "triangle").floats(), [0.0; 2]);
    let material = content(&executor, "material");
    assert_eq!((material.layers(), material.floats()), (2, [0.0, 0.0, 0.0, 1.0].repeat(4)));
}

#[test]
fn an_absent_optional_input_of_whole_numbers_has_all_bits_that_it_declares() {
    let registry = one_pass(
        r#"ports: {
            "a": (about: "May be absent", optional: (4294967295.0, 16777217.0, 0.0, 7.0)),
            "b": (about: "What it was", size: Fixed(1, 1)),
        }"#,
        "var a: texture_2d<u32>;
         var b: texture_storage_2d<rgba32uint, write>;
         @compute @workgroup_size(1) fn main() { textureStore(b, vec2(0), textureLoad(a, vec2(0), 0)); }",
    );
    let text = r#"(version: 1, size: (2, 2), passes: { "p": (use: "t.p") }, outputs: { "b": "p.b" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    run_all(&mut executor);
    // a constant is of single precision, which has 2^24 beside 2^24 + 1
    assert_eq!(content(&executor, "b").numbers(), Numbers::Whole(vec![u32::MAX, 1 << 24, 0, 7]));
}

#[test]
fn an_absent_optional_input_reads_as_declared() {
    let registry = one_pass(
        r#"ports: {
            "a": (about: "May be absent", optional: (0.25, inf, -1.0, 4.0)),
            "copied": (about: "The same", size: Same("a")),
        }"#,
        "var a: texture_2d<f32>;
        var copied: texture_storage_2d<rgba32float, write>;
        @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            textureStore(copied, id.xy, textureLoad(a, id.xy, 0));
        }",
    );
    let text = r#"(version: 1, size: (3, 1), passes: { "p": (use: "t.p") }, outputs: { "copied": "p.copied" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    run_all(&mut executor);
    assert_eq!(content(&executor, "copied").floats(), [0.25, f32::INFINITY, -1.0, 4.0].repeat(3));
}

#[test]
fn buffers_flow_between_passes() {
    let manifest = r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
        "fill": (about: "Counts.", shader: "fill.wgsl",
            ports: { "items": (about: "Pairs", size: Fixed(100)) }),
        "read": (about: "Mirrors.", shader: "read.wgsl", ports: {
            "items": (about: "Pairs"),
            "mirrored": (about: "The same, from the end", size: Same("items")),
        }),
    })"#;
    let fill = "var<storage, read_write> items: array<vec2<f32>>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            if id.x < arrayLength(&items) { items[id.x] = vec2(f32(id.x), 0.5); }
        }";
    let read = "var<storage, read> items: array<vec2<f32>>;
        var<storage, read_write> mirrored: array<vec2<f32>>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let n = arrayLength(&items);
            if id.x < n { mirrored[id.x] = items[n - 1u - id.x]; }
        }";
    let registry = with_plugin("t", &[("plugin.ron", manifest), ("fill.wgsl", fill), ("read.wgsl", read)]);
    let text = r#"(version: 1, size: (2, 2), passes: {
        "a": (use: "t.fill"), "b": (use: "t.read", inputs: { "items": "a.items" }),
    }, outputs: { "mirrored": "b.mirrored" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    run_all(&mut executor);
    let data = content(&executor, "mirrored");
    assert_eq!((data.width(), data.height(), data.channels(), data.is_buffer()), (100, 1, 2, true));
    let expected: Vec<f32> = (0..100_u8).rev().flat_map(|n| [f32::from(n), 0.5]).collect();
    assert_eq!(data.floats(), expected);
}

#[test]
fn a_volume_is_written_and_read() {
    let manifest = r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
        "fill": (about: "Coordinates.", shader: "fill.wgsl",
            ports: { "volume": (about: "Coordinates", size: Fixed(3, 4, 5)) }),
        "read": (about: "Doubles.", shader: "read.wgsl", ports: {
            "volume": (about: "Coordinates"),
            "doubled": (about: "Twice that", size: Same("volume")),
        }),
    })"#;
    let fill = "var volume: texture_storage_3d<rgba32float, write>;
        @compute @workgroup_size(4, 4, 4) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            if all(id < textureDimensions(volume)) { textureStore(volume, id, vec4(vec3<f32>(id), 1.0)); }
        }";
    let read = "var volume: texture_3d<f32>;
        var doubled: texture_storage_3d<rgba32float, write>;
        @compute @workgroup_size(4, 4, 4) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            if all(id < textureDimensions(doubled)) { textureStore(doubled, id, 2.0 * textureLoad(volume, id, 0)); }
        }";
    let registry = with_plugin("t", &[("plugin.ron", manifest), ("fill.wgsl", fill), ("read.wgsl", read)]);
    let text = r#"(version: 1, size: (2, 2), passes: {
        "a": (use: "t.fill"), "b": (use: "t.read", inputs: { "volume": "a.volume" }),
    }, outputs: { "doubled": "b.doubled" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    executor.poison(f32::NAN).unwrap();
    run_all(&mut executor);
    let data = content(&executor, "doubled");
    assert_eq!((data.width(), data.height(), data.layers(), data.channels(), data.is_image()), (3, 4, 5, 4, false));
    let texel = |z: u8, y: u8, x: u8| [x, y, z].map(|n| 2.0 * f32::from(n));
    let texels = (0..5).flat_map(|z| (0..4).flat_map(move |y| (0..3).map(move |x| texel(z, y, x))));
    assert_eq!(data.floats(), texels.flat_map(|[x, y, z]| [x, y, z, 2.0]).collect::<Vec<_>>());
}

/// Written in WGSL, read back exactly. Five texels wide, so that rows are padded.
#[test]
fn every_format_reads_back_what_was_written() {
    let float = "vec4(0.25, -2.0, 1024.0, 0.0) + f32(id.x)";
    let unorm = "vec4(0.0, 0.2, 1.0, 7.0) + f32(id.x) / 255.0";
    let uint = "vec4(0xffffffffu - id.x, 70000u + id.x, 16777217u + id.x, id.x)";
    let cases = [
        ("r32float", float, 1),
        ("rg32float", float, 2),
        ("rgba32float", float, 4),
        ("r16float", float, 1),
        ("rg16float", float, 2),
        ("rgba16float", float, 4),
        ("rgba8unorm", unorm, 4),
        ("r32uint", uint, 1),
        ("rg32uint", uint, 2),
        ("rgba32uint", uint, 4),
    ];
    let gpu = gpu();
    for (format, value, channels) in cases {
        let shader = format!(
            "var stored: texture_storage_2d<{format}, write>;
            @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
                textureStore(stored, id.xy, {value});
            }}"
        );
        let registry = one_pass("ports: { \"stored\": (about: \"Known values\", size: Frame(1.0)) }", &shader);
        let text = r#"(version: 1, size: (5, 3), passes: { "p": (use: "t.p") }, outputs: { "stored": "p.stored" })"#;
        let mut executor = executor(&gpu, &registry, planned(&registry, text, |_, _| ()));
        run_all(&mut executor);
        let data = content(&executor, "stored");
        assert_eq!((data.width(), data.height(), data.layers(), data.channels()), (5, 3, 1, channels), "{format}");
        let texel = |x: u8| {
            let part = |x: u8| f64::from(f32::from(x) / 255.0);
            let wide = f64::from(x);
            match format {
                "rgba8unorm" => [part(x), part(51 + x), 1.0, 1.0],
                "r32uint" | "rg32uint" | "rgba32uint" => {
                    [4_294_967_295.0 - wide, 70000.0 + wide, 16_777_217.0 + wide, wide]
                }
                _ => [0.25 + wide, wide - 2.0, 1024.0 + wide, wide],
            }
        };
        let row: Vec<f64> = (0..5).flat_map(|x| texel(x)[..channels as usize].to_vec()).collect();
        assert_eq!(data.exact().collect::<Vec<f64>>(), row.repeat(3), "{format}");
    }
}

/// The last format, a rasteriser's depth: 1e-6 m over the distance along the view axis.
#[test]
fn a_depth_buffer_reads_back() {
    let (gpu, registry) = (gpu(), registry(&[]));
    let text = r#"(version: 1, size: (9, 9), passes: { "s": (use: "core.gbuffer") },
        outputs: { "depth": "s.depth", "raster": "s.raster_depth" })"#;
    let mut executor = executor(&gpu, &registry, planned(&registry, text, |_, _| ()));
    executor.poison(f32::NAN).unwrap();
    crate::support::set_scene(&mut executor, &crate::support::scene(""), 0.0);
    run_all(&mut executor);
    let (depth, raster) = (content(&executor, "depth").floats(), content(&executor, "raster").floats());
    let middle = 4 * 9 + 4;
    let expected = 1e-6 / depth[middle];
    assert!((raster[middle] / expected - 1.0).abs() < 1e-3, "{} {expected}", raster[middle]);
    assert_eq!(raster.len(), 81);
    assert!(depth.iter().zip(&raster).all(|(depth, raster)| depth.is_finite() == (*raster > 0.0)));
}

/// What costs something on some devices is asked for where a pass does it, and nowhere else.
#[test]
fn textures_allow_what_passes_do_with_them() {
    let registry = registry(&[]);
    let plan = planned(&registry, crate::support::FOG, |_, options| options.share = false);
    let executor = executor(&gpu(), &registry, plan);
    let (stored, drawn) = (wgpu::TextureUsages::STORAGE_BINDING, wgpu::TextureUsages::RENDER_ATTACHMENT);
    let usages = |name: &str| executor.texture_usages(executor.plan().find(name).unwrap()).unwrap() & (stored | drawn);
    assert_eq!(usages("surfaces.triangle"), drawn);
    assert_eq!(usages("surfaces.raster_depth"), drawn);
    for name in ["surfaces.depth", "surfaces.normal", "surfaces.material", "airlight", "radiance", "image"] {
        assert_eq!(usages(name), stored, "{name}");
    }
}

/// A thread writes a row of its own, as many as the manifest says.
#[test]
fn a_dispatch_may_say_its_threads() {
    let shader = "var result: texture_storage_2d<r32float, write>;
        @compute @workgroup_size(1, 3) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            for (var x = 0u; x < textureDimensions(result).x; x++) {
                textureStore(result, vec2<u32>(x, id.y), vec4<f32>(f32(10u * id.y + x)));
            }
        }";
    let pass = "dispatch: (1, 3), ports: { \"result\": (about: \"Numbers\", class: Scalar, size: Fixed(2, 3)) }";
    let registry = one_pass(pass, shader);
    let text = r#"(version: 1, size: (1, 1), passes: { "p": (use: "t.p") }, outputs: { "result": "p.result" })"#;
    let mut executor = executor(&gpu(), &registry, planned(&registry, text, |_, _| ()));
    executor.frame(FrameOptions::default()).unwrap();
    assert_eq!(content(&executor, "result").floats(), [0.0, 1.0, 10.0, 11.0, 20.0, 21.0]);
}
