//! Random graphs of passes with several kinds of resource, versions in place, history and switches.

use std::fmt::Write;
use std::sync::Arc;

use proptest::prelude::*;
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_graph::descriptor::{
    Class, Dimension, Disabled, Extent, Format, PassDescriptor, PortDescriptor, PortKind, Role, SizeRule,
};
use tyndall_graph::{Catalogue, Graph, Overrides, read, validate_with};

use super::{pass, port};

/// Kinds of resource.
const RESOURCES: usize = 4;

fn kind(resource: usize) -> PortKind {
    let texture =
        |dimension, format| PortKind::Texture { dimension, class: Class::Data, format: Some(format), filtered: false };
    match resource {
        0 => texture(Dimension::D2, Format::Rgba32Float),
        1 => texture(Dimension::D2, Format::R32Float),
        2 => texture(Dimension::D3, Format::Rgba16Float),
        _ => PortKind::Buffer { element: "Item".into(), stride: 16 },
    }
}

fn size(resource: usize) -> SizeRule {
    match resource {
        0 => SizeRule::frame(1.0),
        1 => SizeRule::frame(0.5),
        2 => SizeRule::fixed(8, 8, 8),
        _ => SizeRule { width: Extent::FramePixels(1.0), height: Extent::Fixed(1), depth: Extent::Fixed(1) },
    }
}

fn input(name: &str, resource: usize) -> PortDescriptor {
    PortDescriptor { size: Some(size(resource)), ..port(name, Role::Optional([0.25; 4]), kind(resource)) }
}

fn output(name: &str, resource: usize, disabled: Disabled) -> PortDescriptor {
    PortDescriptor { size: Some(size(resource)), ..port(name, Role::Output { disabled }, kind(resource)) }
}

fn constant() -> Disabled {
    Disabled::Constant([0.5; 4])
}

/// Every form of pass for each kind of resource.
pub fn catalogue() -> Catalogue {
    let mut catalogue = Catalogue::new();
    for resource in 0..RESOURCES {
        let other = (resource + 1) % RESOURCES;
        let mix = vec![
            input("a", resource),
            input("b", resource),
            output("x", resource, Disabled::Input("b".into())),
            output("y", other, constant()),
        ];
        let change = vec![port("v", Role::InOut, kind(resource)), input("a", resource), output("x", other, constant())];
        let remember = vec![
            input("a", resource),
            port("h", Role::History([0.125; 4]), kind(resource)),
            output("x", resource, Disabled::Input("a".into())),
        ];
        let act = vec![input("a", resource)];
        let descriptors: Vec<PassDescriptor> = vec![
            pass(&format!("make.r{resource}"), vec![output("x", resource, constant())], vec![]),
            pass(&format!("mix.r{resource}"), mix, vec![]),
            PassDescriptor { scene: vec!["camera".into()], ..pass(&format!("change.r{resource}"), change, vec![]) },
            pass(&format!("remember.r{resource}"), remember, vec![]),
            PassDescriptor { side_effect: true, ..pass(&format!("act.r{resource}"), act, vec![]) },
        ];
        for descriptor in descriptors {
            catalogue.insert(Arc::new(descriptor)).unwrap();
        }
    }
    catalogue
}

/// What a pass of a random graph is drawn from.
#[derive(Debug, Clone)]
pub struct Draw {
    form: u8,
    resource: usize,
    picks: [u32; 3],
    enabled: bool,
    place: u32,
}

fn draw() -> impl Strategy<Value = Draw> {
    let form = prop_oneof![3 => Just(0u8), 6 => Just(1), 4 => Just(2), 1 => Just(3), 1 => Just(4)];
    (form, 0..RESOURCES, any::<[u32; 3]>(), prop::bool::weighted(0.85), any::<u32>())
        .prop_map(|(form, resource, picks, enabled, place)| Draw { form, resource, picks, enabled, place })
}

/// The text of a random graph.
pub fn text() -> impl Strategy<Value = String> {
    let size = prop_oneof![1 => 1..12usize, 1 => 1..60usize, 3 => 60..200usize];
    (size.prop_flat_map(|size| prop::collection::vec(draw(), size)), prop::collection::vec(any::<u32>(), 1..6))
        .prop_map(|(draws, outputs)| write_text(&draws, &outputs))
}

/// The graph of such a text.
pub fn graph(text: &str) -> Arc<Graph> {
    let mut out = Diagnostics::default();
    let file = read(&Source::new("random.graph.ron", text), &mut out).unwrap();
    let graph = validate_with(&file, &catalogue(), &Overrides::default(), &|_| true, &mut out);
    graph.unwrap_or_else(|| panic!("{}\n{text}", render_text(out.iter(), false)))
}

fn write_text(draws: &[Draw], outputs: &[u32]) -> String {
    // What each resource's ports are, in an order in which they may be read.
    let mut ports: Vec<Vec<String>> = vec![Vec::new(); RESOURCES];
    let mut lines: Vec<(u32, String)> = Vec::new();
    let mut remembering: Vec<(usize, usize, u32)> = Vec::new();
    for (index, draw) in draws.iter().enumerate() {
        let (resource, other) = (draw.resource, (draw.resource + 1) % RESOURCES);
        // Two in three are recent, so that graphs grow deep.
        let pick = |pick: u32| {
            let ports = &ports[resource];
            let recent = ports.len().saturating_sub(6);
            let from = if pick.is_multiple_of(3) { 0 } else { recent };
            let count = ports.len() - from;
            (count > 0).then(|| ports[from + pick as usize / 3 % count].clone())
        };
        let fed = |name: &str, number: u32| match pick(number) {
            Some(port) if !number.is_multiple_of(7) => format!("\"{name}\": \"{port}\", "),
            _ => String::new(),
        };
        let form = if draw.form == 2 && pick(draw.picks[0]).is_none() { 0 } else { draw.form };
        let name = format!("p{index}");
        let (kind, inputs) = match form {
            0 => ("make", String::new()),
            1 => ("mix", fed("a", draw.picks[0]) + &fed("b", draw.picks[1])),
            2 => ("change", format!("\"v\": \"{}\", ", pick(draw.picks[0]).unwrap()) + &fed("a", draw.picks[1])),
            3 => ("remember", fed("a", draw.picks[0]) + "\"h\": \"HISTORY\", "),
            _ => ("act", fed("a", draw.picks[0])),
        };
        if form == 3 {
            remembering.push((lines.len(), resource, draw.picks[2]));
        }
        let enabled = if draw.enabled { "" } else { ", enabled: false" };
        let line = format!("\"{name}\": (use: \"{kind}.r{resource}\", inputs: {{ {inputs}}}{enabled}),");
        lines.push((draw.place, line));
        match form {
            0 | 3 => ports[resource].push(format!("{name}.x")),
            1 => {
                ports[resource].push(format!("{name}.x"));
                ports[other].push(format!("{name}.y"));
            }
            2 => {
                ports[resource].push(format!("{name}.v"));
                ports[other].push(format!("{name}.x"));
            }
            _ => {}
        }
    }
    // A history port may read any port, later ones and its own pass's too.
    for (line, resource, pick) in remembering {
        let source = &ports[resource][pick as usize % ports[resource].len()];
        lines[line].1 = lines[line].1.replace("HISTORY", source);
    }
    let mut all: Vec<String> = ports.concat();
    if all.is_empty() {
        lines.push((0, "\"only\": (use: \"make.r0\"),".into()));
        all.push("only.x".into());
    }
    // Files in any order, but most of the time near the one in which they run.
    if draws[0].place.is_multiple_of(2) {
        lines.sort();
    }
    let mut text = String::from("(version: 1, passes: {\n");
    for (_, line) in &lines {
        writeln!(text, "    {line}").unwrap();
    }
    text.push_str("}, outputs: {\n");
    for (index, output) in outputs.iter().enumerate() {
        writeln!(text, "    \"o{index}\": \"{}\",", all[*output as usize % all.len()]).unwrap();
    }
    text + "})\n"
}
