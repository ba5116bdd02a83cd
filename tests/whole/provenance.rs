//! What results are made from: what shaders do and scene data hold, and no more than that.

use crate::support::{planned, scene_of, with_plugin};
use tyndall_graph::{Digest, MadeFrom, Provenance};
use tyndall_plugin::Registry;
use tyndall_scene::Scene;

const MANIFEST: &str = r#"(name: "t", version: "0.1.0", about: "For tests.", passes: {
    "one": (about: "Writes one.", shader: "one.wgsl", ports: { "result": (about: "One", size: Frame(1.0)) }),
    "two": (about: "Writes two.", shader: "two.wgsl", ports: { "result": (about: "Two", size: Frame(1.0)) }),
    "same": (about: "Passes on.", shader: "same.wgsl",
        ports: { "input": (about: "Any"), "result": (about: "The same", size: Same("input")) }),
})"#;

const SHARED: &str =
    "const ONE = 1.0;\nconst TWO = 2.0;\nfn one() -> f32 { return ONE; }\nfn two() -> f32 { return TWO; }\n";

const GRAPH: &str = r#"(version: 1, size: (4, 4), passes: {
    "one": (use: "t.one"), "after": (use: "t.same", inputs: { "input": "one.result" }), "two": (use: "t.two"),
}, outputs: { "after": "after.result", "two": "two.result" })"#;

fn registry(shared: &str) -> Registry {
    let writes = |function: &str| {
        format!(
            "#import \"shared.wgsl\"\nvar result: texture_storage_2d<rgba32float, write>;
            @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
                textureStore(result, id.xy, vec4({function}()));
            }}"
        )
    };
    let same = "var input: texture_2d<f32>;\nvar result: texture_storage_2d<rgba32float, write>;
        @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            textureStore(result, id.xy, textureLoad(input, id.xy, 0));
        }";
    let (one, two) = (writes("one"), writes("two"));
    let files = [
        ("plugin.ron", MANIFEST),
        ("shared.wgsl", shared),
        ("one.wgsl", &one),
        ("two.wgsl", &two),
        ("same.wgsl", same),
    ];
    with_plugin("t", &files)
}

/// What each pass of a graph was made from, by name.
fn origins(registry: &Registry, graph: &str, scene: Option<&Scene>) -> Vec<(String, MadeFrom)> {
    let plan = planned(registry, graph, |_, _| ());
    let shaders = |pass: &str| registry.pass(pass).unwrap().fingerprint;
    let mut provenance = Provenance::new(&plan, &shaders, &|_| 0);
    let encoded = scene.map(|scene| scene.encode(0.0, 1.0));
    let version = |name: &String| encoded.as_ref().map_or(0, |encoded| Digest::of(encoded.bytes(name)));
    let versions: Vec<u64> = provenance.scene().iter().map(version).collect();
    provenance.update(&plan, &plan.values(0, 0.0), |index| versions[index]);
    plan.passes.handles().map(|pass| (plan.pass_name(pass).to_owned(), provenance.of(pass).made_from)).collect()
}

/// The passes that are made from something else than with the shared file as it is, and what of it changed.
fn changed(shared: &str) -> Vec<String> {
    let [before, after] = [SHARED, shared].map(|shared| origins(&registry(shared), GRAPH, None));
    let differing = before.iter().zip(&after).filter(|(a, b)| a.1 != b.1);
    differing.map(|(a, b)| format!("{}: {}", a.0, a.1.changed(&b.1).join(", "))).collect()
}

#[test]
fn a_shared_file_changes_what_uses_it_and_all_downstream() {
    assert_eq!(changed(&format!("// As before.\n{SHARED}")), [""; 0]);
    assert_eq!(changed(&format!("fn idle() -> f32 {{ return TWO; }}\n{SHARED}")), [""; 0]);
    assert_eq!(changed(&SHARED.replace("ONE = 1.0", "ONE = 1.5")), ["one: shaders", "after: shaders"]);
    assert_eq!(changed(&SHARED.replace("return TWO", "return 2.0 * TWO")), ["two: shaders"]);
}

/// Tables of equal length are not taken for one another.
#[test]
fn two_measured_phase_functions_differ() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |name: &str, forward: f32| {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("0 {forward}\n90 0.5\n180 1\n")).unwrap();
        scene_of(&format!(
            "(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), medium: (extinction: (0.1, 0.1, 0.1), phase: Measured({path:?})))"
        ))
    };
    let graph = r#"(version: 1, size: (4, 4), passes: {
        "surfaces": (use: "core.gbuffer"), "air": (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }),
    }, outputs: { "airlight": "air.radiance" })"#;
    let registry = crate::support::registry(&[]);
    let [a, b, again] = [("a", 3.0), ("b", 4.0), ("c", 3.0)]
        .map(|(name, forward)| origins(&registry, graph, Some(&scene(name, forward))));
    assert_eq!(a, again);
    assert_eq!(a[0], b[0], "surfaces do not depend on the medium");
    assert_eq!(a[1].1.changed(&b[1].1), ["scene"]);
}
