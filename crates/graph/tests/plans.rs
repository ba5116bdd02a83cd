//! Plans, pinned as text.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::collections::BTreeSet;
use std::sync::Arc;

use support::{CONTRACT, file, graph, planned, try_graph};
use tyndall_document::{Place, Source};
use tyndall_graph::descriptor::ParamValue;
use tyndall_graph::{
    CullReason, Graph, Handle, Keep, Order, Override, Overrides, ParamSetting, Plan, PlanOptions, Roots, Slot,
    SlotKind, Step, Until, explain, plan, show,
};

const FOGGED: &str = r#"        "surfaces": (use: "core.gbuffer"),
        "lit": (use: "surface_radiance.phong", inputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material" }, enabled: "$direct"),
        "air": (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }),
        "fogged": (use: "core.compose", inputs: { "surface": "lit.radiance", "airlight": "air.radiance", "depth": "surfaces.depth" }),
        "glow": (use: "core.halve", inputs: { "image": "fogged.radiance" }),
        "wide": (use: "core.halve", inputs: { "image": "glow.half" }),
        "smooth": (use: "core.accumulate", inputs: { "sample": "fogged.radiance", "before": "smooth.mean" }, enabled: "$smooth"),
        "graded": (use: "core.grade", inputs: { "image": "smooth.mean" }),
        "display": (use: "core.tonemap", inputs: { "radiance": "graded.image" }),
"#;

fn fogged(direct: bool, smooth: bool) -> Arc<Graph> {
    let text = file(FOGGED, r#""image": "display.color", "airlight": "air.radiance""#);
    graph(&text.replacen(
        "passes",
        &format!("params: {{ \"direct\": {direct}, \"smooth\": {smooth} }},\n    passes"),
        1,
    ))
}

fn with(graph: &Arc<Graph>, change: impl FnOnce(&mut PlanOptions)) -> Plan {
    let mut options = PlanOptions::new(graph.size);
    change(&mut options);
    plan(graph, &options).unwrap()
}

fn edges(live: &[&str], animated: &[&str]) -> Keep {
    let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
    Keep::Edges { live: set(live), animated: set(animated) }
}

fn names(plan: &Plan) -> Vec<&str> {
    plan.passes.handles().map(|position| plan.pass_name(position)).collect()
}

#[test]
fn the_contract() {
    insta::assert_snapshot!(show::text(&planned(CONTRACT)));
}

#[test]
fn everything_on() {
    insta::assert_snapshot!(show::text(&with(&fogged(true, true), |_| ())));
}

#[test]
fn switched_off() {
    insta::assert_snapshot!(show::text(&with(&fogged(false, false), |_| ())));
}

#[test]
fn a_parameter_that_changes_keeps_what_is_before_it() {
    insta::assert_snapshot!(show::text(&with(&fogged(true, false), |options| {
        options.keep = edges(&["display.exposure"], &[]);
    })));
}

#[test]
fn every_port_asked_for_has_a_slot_of_its_own() {
    let plan = with(&fogged(true, true), |options| options.roots = Roots::All);
    assert_eq!(plan.bytes.shared, plan.bytes.unshared);
    insta::assert_snapshot!(show::text(&plan));
}

#[test]
fn as_a_graph_for_other_programs() {
    insta::assert_snapshot!(show::dot(&with(&fogged(false, true), |_| ())));
}

#[test]
fn as_data() {
    insta::assert_snapshot!(show::json(&with(&fogged(false, true), |_| ())));
}

#[test]
fn explained() {
    let plan = with(&fogged(false, true), |_| ());
    let names = [
        "lit",
        "lit.radiance",
        "glow",
        "wide.half",
        "graded.image",
        "smooth.before",
        "image",
        "display",
        "fogged.surface",
    ];
    let text: Vec<String> = names.iter().map(|name| explain(&plan, name).unwrap()).collect();
    insta::assert_snapshot!(text.join("\n"));
}

#[test]
fn explaining_what_is_not_there_names_what_is_near() {
    let plan = planned(CONTRACT);
    let suggestion = |name: &str| explain(&plan, name).unwrap_err().suggestion;
    assert_eq!(suggestion("surface_").as_deref(), Some("did you mean `surfaces`?"));
    assert_eq!(suggestion("imag").as_deref(), Some("did you mean `image`?"));
    assert_eq!(suggestion("lit.radianc").as_deref(), Some("did you mean `lit.radiance`?"));
    assert_eq!(suggestion("lid.radiance").as_deref(), Some("did you mean `lit.radiance`?"));
}

#[test]
fn a_drawing_has_every_pass_and_every_port() {
    let plan = with(&fogged(false, true), |_| ());
    let svg = show::svg(&plan);
    for pass in &plan.graph.passes {
        assert!(svg.contains(&format!(">{}</text>", pass.name)), "{}", pass.name);
        for port in &pass.descriptor().ports {
            assert!(svg.contains(&format!(">{}</text>", port.name)), "{}", port.name);
        }
    }
}

#[test]
fn the_order_is_the_files_but_for_those_that_wait() {
    let text = file(
        r#"        "d": (use: "core.add", inputs: { "a": "c.sum", "b": "a.sum" }),
        "a": (use: "core.add", inputs: { "a": "tile.tile" }),
        "tile": (use: "core.tile"),
        "b": (use: "core.add", inputs: { "a": "tile.tile" }),
        "c": (use: "core.add", inputs: { "a": "b.sum" }),
"#,
        r#""image": "d.sum""#,
    );
    assert_eq!(names(&planned(&text)), ["tile", "b", "c", "a", "d"]);
}

#[test]
fn seeds_give_other_valid_orders() {
    let graph = graph(&support::generated(60));
    let orders: BTreeSet<Vec<String>> = (0..8)
        .map(|seed| with(&graph, |options| options.order = Order::Shuffled(seed)))
        .map(|plan| names(&plan).into_iter().map(str::to_owned).collect())
        .collect();
    assert_eq!(orders.len(), 8);
}

#[test]
fn culling_says_why() {
    let plan = with(&fogged(false, true), |_| ());
    let culled: Vec<(&str, CullReason, String)> = plan
        .culled
        .iter()
        .map(|culled| (plan.graph.pass(culled.pass).name.as_str(), culled.reason, show::culled_words(&plan, culled)))
        .collect();
    let unread = |port: &str| format!("nothing that was asked for (image, airlight) reads any of its ports: {port}");
    assert_eq!(
        culled,
        [
            ("lit", CullReason::Off, "switched off by $direct".to_owned()),
            ("glow", CullReason::Unread, unread("half")),
            ("wide", CullReason::Unread, unread("half")),
        ]
    );
}

#[test]
fn a_root_a_tap_and_a_side_effect_keep_passes_alive() {
    let all = fogged(true, true);
    let glow = all.find("glow.half", Place::Argument(String::new())).unwrap();
    assert!(!names(&with(&all, |_| ())).contains(&"glow"));
    assert!(names(&with(&all, |options| options.taps = vec![glow])).contains(&"glow"));
    let only = with(&all, |options| options.roots = Roots::Ports(vec![glow]));
    assert_eq!(names(&only), ["surfaces", "lit", "air", "fogged", "glow"]);
    assert_eq!(only.outputs, []);
    let log = file(
        "        \"tile\": (use: \"core.tile\"),\n        \"log\": (use: \"core.log\", inputs: { \"image\": \"tile.tile\" }),\n        \"other\": (use: \"core.tile\"),\n",
        r#""image": "other.tile""#,
    );
    assert_eq!(names(&planned(&log)), ["tile", "log", "other"]);
}

#[test]
fn a_constant_flows_out_of_a_pass_that_is_off() {
    let plan = with(&fogged(false, false), |_| ());
    let fogged = plan.graph.pass_named("fogged").unwrap();
    let surface = plan.graph.pass(fogged).descriptor().port_named("surface").unwrap();
    let bindings = plan.bindings(plan.position(fogged).unwrap());
    let surface = &plan.slots[bindings[surface].unwrap()];
    assert_eq!(surface.kind, SlotKind::Constant([0.0; 4]));
    assert_eq!(surface.initial(), Some([0.0; 4]));
    assert_eq!(plan.find("lit.radiance"), None, "nobody asked for it");
    let lit = plan.graph.find("lit.radiance", Place::Argument(String::new())).unwrap();
    let plan = with(&plan.graph, |options| options.taps = vec![lit]);
    let port = &plan.ports[plan.find("lit.radiance").unwrap()];
    assert_eq!((port.pass, plan.slots[port.slot].kind), (None, SlotKind::Constant([0.0; 4])));
}

#[test]
fn an_input_flows_through_a_pass_that_is_off() {
    let plan = with(&fogged(true, false), |_| ());
    assert_eq!(plan.find("smooth.mean"), plan.find("fogged.radiance"));
    let graded = plan.position(plan.graph.pass_named("graded").unwrap()).unwrap();
    let image = plan.descriptor(graded).port_named("image").unwrap();
    assert_eq!(plan.sources(graded)[image], plan.find("fogged.radiance"));
    assert!(plan.ports[plan.find("graded.image").unwrap()].in_place);
}

#[test]
fn history_is_carried_and_its_writer_lives_to_the_end() {
    let plan = with(&fogged(true, true), |_| ());
    let mean = plan.find("smooth.mean").unwrap();
    let (slot, history) = plan.slots.entries().find(|(_, slot)| matches!(slot.kind, SlotKind::History { .. })).unwrap();
    assert_eq!(history.kind, SlotKind::History { of: mean, first: [0.0; 4] });
    let from = plan.ports[mean].slot;
    assert_eq!(plan.steps.last(), Some(&Step::Carry { from, to: slot }));
    assert_eq!(plan.ports[mean].until, Until::End);
}

#[test]
fn what_is_still_needed_is_changed_in_a_copy() {
    // `before` reads the old version behind `graded` in the file, so it must not see the change.
    let text = file(
        r#"        "tile": (use: "core.image"),
        "graded": (use: "core.grade", inputs: { "image": "tile.image" }),
        "before": (use: "core.add", inputs: { "a": "tile.image" }),
        "again": (use: "core.grade", inputs: { "image": "graded.image" }),
"#,
        r#""image": "again.image", "old": "before.sum""#,
    );
    let plan = planned(&text);
    let copies: Vec<&str> = plan
        .steps
        .iter()
        .filter_map(|step| if let Step::Copy { pass, .. } = step { Some(plan.pass_name(*pass)) } else { None })
        .collect();
    assert_eq!(copies, ["graded"]);
    let slot = |name: &str| plan.ports[plan.find(name).unwrap()].slot;
    assert_ne!(slot("tile.image"), slot("graded.image"));
    assert_eq!(slot("graded.image"), slot("again.image"));
}

#[test]
fn without_sharing_every_port_has_its_own_slot() {
    let plan = with(&fogged(true, true), |options| options.share = false);
    let slots: BTreeSet<Handle<Slot>> = plan.ports.iter().map(|port| port.slot).collect();
    assert_eq!(slots.len(), plan.ports.len());
}

#[test]
fn a_live_parameter_runs_only_what_is_behind_it() {
    let volatile = |keep: Keep| -> Vec<String> {
        let plan = with(&fogged(true, false), |options| options.keep = keep);
        let volatile = plan.passes.handles().filter(|position| plan.passes[*position].volatile);
        volatile.map(|pass| plan.pass_name(pass).to_owned()).collect()
    };
    assert_eq!(volatile(edges(&["display.exposure"], &[])), ["display"]);
    assert_eq!(volatile(edges(&["air.nodes"], &[])), ["air", "fogged", "graded", "display"]);
    assert_eq!(volatile(edges(&[], &["medium"])), ["lit", "air", "fogged", "graded", "display"]);
    assert_eq!(volatile(edges(&[], &["camera"])).len(), 6);
    assert_eq!(volatile(edges(&[], &[])).len(), 0);
    assert_eq!(volatile(Keep::Nothing).len(), 6);
}

#[test]
fn kept_ports_leave_their_class_and_both_figures_are_those_of_nothing_kept() {
    let all = fogged(true, false);
    let nothing = with(&all, |_| ());
    let kept = with(&all, |options| options.keep = edges(&["display.exposure"], &[]));
    assert_eq!((kept.bytes.shared, kept.bytes.unshared), (nothing.bytes.shared, nothing.bytes.unshared));
    let names: Vec<String> =
        kept.ports.handles().filter(|port| kept.ports[*port].kept).map(|port| kept.port_name(port)).collect();
    assert_eq!(names, ["air.radiance", "graded.image"]);
}

fn set(text: &str) -> Override {
    Override::parse(text, &format!("--set {text}")).unwrap()
}

#[test]
fn the_command_line_wins_and_the_last_of_a_name() {
    let text = CONTRACT.replace(
        "\"air\":      (use: \"airlight.homogeneous\",",
        "\"air\": (use: \"airlight.homogeneous\", params: { \"nodes\": 4 },",
    );
    let exposure = |params: Vec<Override>| {
        let graph = try_graph(&text, &Overrides { params, ..Overrides::default() }).unwrap();
        let display = graph.pass(graph.pass_named("display").unwrap());
        display.params[display.descriptor().param_named("exposure").unwrap()].clone()
    };
    let value = |value: f64| ParamSetting::Value(ParamValue::Float(value));
    assert_eq!(exposure(vec![]), value(1.0));
    assert_eq!(exposure(vec![set("exposure=2"), set("exposure=3")]), value(3.0), "integers serve as floats");
    assert_eq!(
        exposure(vec![set("display.exposure=5"), set("exposure=3.5")]),
        value(5.0),
        "pass.parameter beats $name"
    );
    assert_eq!(exposure(vec![set("display.exposure=\"$time\"")]), ParamSetting::Time);
}

#[test]
fn the_command_lines_size_wins() {
    let size = |overrides: &Overrides, text: &str| try_graph(text, overrides).unwrap().size;
    assert_eq!(size(&Overrides::default(), CONTRACT), (1280, 720));
    assert_eq!(size(&Overrides { size: Some((32, 16)), ..Overrides::default() }, CONTRACT), (32, 16));
    assert_eq!(size(&Overrides::default(), &CONTRACT.replace("size: (1280, 720),", "")), (640, 480));
}

#[test]
fn paths_are_beside_the_file_that_holds_them() {
    let text = CONTRACT.replacen(
        "\"surfaces\": (",
        "\"photo\": (use: \"core.image\", params: { \"file\": \"photo.exr\" }), \"surfaces\": (",
        1,
    );
    let read = |params: Vec<Override>| {
        let graph = try_graph(&text, &Overrides { params, ..Overrides::default() }).unwrap();
        let photo = graph.pass(graph.pass_named("photo").unwrap());
        (graph.scene.clone().unwrap(), photo.params.iter().next().unwrap().clone())
    };
    let file = |path: &str| ParamSetting::Value(ParamValue::File(path.into()));
    assert_eq!(read(vec![]), ("graphs/scenes/pavilion.scene.ron".to_owned(), file("graphs/photo.exr")));
    assert_eq!(read(vec![set("photo.file=\"other.exr\"")]).1, file("other.exr"));
}

#[test]
fn a_scene_of_the_command_line_stands_in_for_a_missing_one() {
    let text = CONTRACT.replace("pavilion.scene.ron", "missing.scene.ron");
    assert!(try_graph(&text, &Overrides::default()).unwrap_err().contains("missing-file"));
    let overrides = Overrides { scene: Some("mine.scene.ron".into()), ..Overrides::default() };
    assert_eq!(try_graph(&text, &overrides).unwrap().scene.as_deref(), Some("mine.scene.ron"));
}

#[test]
fn every_mistake_is_reported_once_in_the_order_of_the_file() {
    let text = CONTRACT
        .replace("core.gbuffer", "core.gbufer")
        .replace("air.radiance\", \"depth", "air.radience\", \"depth")
        .replace("\"exposure\": 1.0", "\"exposure\": -1")
        .replace("display.color", "displai.color");
    let shown =
        try_graph(&text, &Overrides { params: vec![set("display.tint=1")], ..Overrides::default() }).unwrap_err();
    let heads: Vec<&str> = shown.lines().filter(|line| line.starts_with("error")).collect();
    let codes: Vec<&str> = heads.iter().map(|head| &head[6..head.find(']').unwrap()]).collect();
    assert_eq!(codes, ["out-of-range", "unknown-pass", "unknown-port", "unknown-reference", "wrong-type"], "{shown}");
}

#[test]
fn near_names_stay_cheap_for_a_file_full_of_mistakes() {
    let text = support::generated(10_000).replace(".radiance", ".radience").replace("core.gbuffer", "core.gbufer");
    let started = std::time::Instant::now();
    let source = Source::new("wrong.graph.ron", text);
    let mut out = tyndall_document::Diagnostics::default();
    let file = tyndall_graph::read(&source, &mut out).unwrap();
    assert!(
        tyndall_graph::validate_with(&file, &support::catalogue(), &Overrides::default(), &|_| true, &mut out)
            .is_none()
    );
    assert!(out.len() > 5000);
    assert!(started.elapsed().as_secs_f64() < 5.0, "{:?}", started.elapsed());
}
