//! What results were made from changes with what they are computed from, downstream of it, and with nothing else.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::sync::Arc;

use support::{file, graph};
use tyndall_graph::{Graph, MadeFrom, Order, Origin, Plan, PlanOptions, Provenance, Roots, plan};

const FOG: &str = r#"        "surfaces": (use: "core.gbuffer"),
        "lit": (use: "surface_radiance.phong", inputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material" }),
        "air": (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }, params: { "nodes": 8 }),
        "fogged": (use: "core.compose", inputs: { "surface": "lit.radiance", "airlight": "air.radiance", "depth": "surfaces.depth" }),
        "display": (use: "core.tonemap", inputs: { "radiance": "fogged.radiance" }),
"#;

fn fog(change: impl Fn(&str) -> String) -> Arc<Graph> {
    graph(&file(&change(FOG), r#""image": "display.color""#))
}

/// What stands outside of a plan.
#[derive(Clone, Copy)]
struct World {
    /// The pass whose shader is another than usual.
    other_shader: &'static str,
    /// The scene data of another version than usual.
    other_scene: &'static str,
    frame: u32,
}

const USUAL: World = World { other_shader: "", other_scene: "", frame: 1 };

/// The origins of a plan's passes by name.
fn origins(plan: &Plan, world: World) -> Vec<(String, Origin)> {
    let mut provenance = Provenance::new(plan, &|pass| u64::from(pass == world.other_shader), &|_| 0);
    let versions: Vec<u64> = provenance.scene().iter().map(|name| u64::from(name == world.other_scene)).collect();
    let values = plan.values(world.frame, f64::from(world.frame) / 24.0);
    provenance.update(plan, &values, |index| versions[index]);
    plan.passes.handles().map(|pass| (plan.pass_name(pass).to_owned(), *provenance.of(pass))).collect()
}

fn planned(graph: &Arc<Graph>) -> Plan {
    plan(graph, &PlanOptions::new(graph.size)).unwrap()
}

fn of(graph: &Arc<Graph>, world: World) -> Vec<(String, Origin)> {
    origins(&planned(graph), world)
}

/// Passes that were made from something else, each with the parts that differ.
fn changed(before: &[(String, Origin)], after: &[(String, Origin)]) -> Vec<String> {
    let differing = before.iter().zip(after).filter(|(a, b)| a.1.made_from != b.1.made_from);
    differing.map(|(a, b)| format!("{}: {}", a.0, a.1.made_from.changed(&b.1.made_from).join(", "))).collect()
}

#[test]
fn each_part_changes_for_its_own_reason_and_downstream_only() {
    let usual = of(&fog(str::to_owned), USUAL);
    assert_eq!(changed(&usual, &of(&fog(str::to_owned), USUAL)), [""; 0]);
    let shader = of(&fog(str::to_owned), World { other_shader: "airlight.homogeneous", ..USUAL });
    assert_eq!(changed(&usual, &shader), ["air: shaders", "fogged: shaders", "display: shaders"]);
    let parameter = of(&fog(|text| text.replace("\"nodes\": 8", "\"nodes\": 9")), USUAL);
    assert_eq!(changed(&usual, &parameter), ["air: parameters", "fogged: parameters", "display: parameters"]);
    let scene = of(&fog(str::to_owned), World { other_scene: "medium", ..USUAL });
    assert_eq!(changed(&usual, &scene), ["lit: scene", "air: scene", "fogged: scene", "display: scene"]);
    let swapped = |text: &str| text.replace("\"surface\": \"lit.radiance\"", "\"surface\": \"air.radiance\"");
    let wiring = of(&fog(swapped), USUAL);
    let [(_, before), (_, after)] = [&usual, &wiring].map(|all| all.iter().find(|(name, _)| name == "fogged").unwrap());
    assert!(before.made_from.changed(&after.made_from).contains(&"graph"));
}

#[test]
fn sizes_are_a_part_of_the_graph() {
    let graph = fog(str::to_owned);
    let other = plan(&graph, &PlanOptions::new((17, 4))).unwrap();
    let (usual, small) = (of(&graph, USUAL), origins(&other, USUAL));
    assert_eq!(changed(&usual, &small).len(), usual.len());
    assert!(changed(&usual, &small).iter().all(|line| line.ends_with(": graph")));
}

/// Results are shared between plans: what else a plan holds, and in which order, is nothing to a pass.
#[test]
fn other_plans_of_the_same_passes_agree() {
    let graph = fog(str::to_owned);
    let all = of(&graph, USUAL);
    let known = |name: &str| all.iter().find(|(known, _)| known == name).unwrap().1;
    let air = graph.find("air.radiance", tyndall_document::Place::Argument(String::new())).unwrap();
    let options = PlanOptions::new(graph.size);
    for options in [
        PlanOptions { roots: Roots::Ports(vec![air]), share: false, ..options.clone() },
        PlanOptions { roots: Roots::All, order: Order::Shuffled(7), ..options },
    ] {
        for (name, origin) in origins(&plan(&graph, &options).unwrap(), USUAL) {
            assert_eq!(origin, known(&name), "{name}");
        }
    }
}

#[test]
fn the_number_and_the_time_of_a_frame_are_values() {
    let clock = |params: &str| {
        let passes = format!("        \"clock\": (use: \"core.clock\", params: {{ {params} }}),\n");
        graph(&file(&passes, r#""color": "clock.color""#))
    };
    let at = |graph: &Arc<Graph>, frame| of(graph, World { frame, ..USUAL })[0].1.repeatable().unwrap();
    let (frame, time) = (clock("\"frame\": \"$frame\""), clock("\"time\": \"$time\""));
    assert_ne!(at(&frame, 24), at(&frame, 25));
    assert_ne!(at(&time, 24), at(&time, 25));
    assert_ne!(at(&frame, 24), at(&time, 24));
    // Whatever sets a value, the result is the same.
    assert_eq!(at(&frame, 24), at(&clock("\"frame\": 24"), 3));
    assert_eq!(at(&time, 24), at(&clock("\"time\": 1.0"), 3));
}

#[test]
fn what_remembers_is_not_repeatable_and_follows_what_it_remembers() {
    let smooth = |nodes: u32| {
        fog(|text| {
            let passes = text.replace("\"nodes\": 8", &format!("\"nodes\": {nodes}"));
            let passes = passes.replace("\"radiance\": \"fogged.radiance\"", "\"radiance\": \"smooth.mean\"");
            passes
                + "        \"smooth\": (use: \"core.accumulate\", inputs: { \"sample\": \"lit.radiance\", \"before\": \"fogged.radiance\" }),\n"
        })
    };
    let smooth_with = |nodes| {
        let graph = graph_of_all(&smooth(nodes));
        graph.into_iter().find(|(name, _)| name == "smooth").unwrap().1
    };
    let origin = smooth_with(8);
    assert!(origin.remembers && origin.repeatable().is_none());
    assert_eq!(origin.made_from.changed(&smooth_with(9).made_from), ["parameters"], "upstream of what it remembers");
    let all = graph_of_all(&smooth(8));
    let remembering: Vec<&str> =
        all.iter().filter(|(_, origin)| origin.remembers).map(|(name, _)| name.as_str()).collect();
    assert_eq!(remembering, ["smooth", "display"]);
}

fn graph_of_all(graph: &Arc<Graph>) -> Vec<(String, Origin)> {
    origins(&plan(graph, &PlanOptions { roots: Roots::All, ..PlanOptions::new(graph.size) }).unwrap(), USUAL)
}

#[test]
fn a_side_effect_upstream_is_told() {
    let logged = graph(&file(
        "        \"color\": (use: \"core.clock\"),\n        \"log\": (use: \"core.log\", inputs: { \"image\": \"color.color\" }),\n",
        r#""color": "color.color""#,
    ));
    let found: Vec<(String, bool)> =
        of(&logged, USUAL).into_iter().map(|(name, origin)| (name, origin.repeatable().is_some())).collect();
    assert_eq!(found, [("color".to_owned(), true), ("log".to_owned(), false)]);
}

/// Goldens are recorded with these numbers: whatever changes them makes all goldens stale.
#[test]
fn origins_are_the_same_for_ever() {
    let display = of(&fog(str::to_owned), USUAL).pop().unwrap().1.made_from;
    let expected = MadeFrom {
        graph: 687_104_409_605_048_843,
        shaders: 11_064_231_264_984_924_080,
        parameters: 9_254_204_706_792_448_184,
        scene: 9_141_011_832_944_461_165,
    };
    assert_eq!(display, expected);
}
