//! Passes for tests and benchmarks: every kind of port, size, parameter and switch occurs.

#![allow(dead_code, reason = "each test uses a part of it")]
#![allow(missing_docs, clippy::unwrap_used, reason = "it is for tests")]

pub mod random;

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_graph::descriptor::{
    Axis, Class, Dimension, Disabled, Extent, Format, ParamDescriptor, ParamType, ParamValue, PassDescriptor,
    PortDescriptor, PortKind, Role, SizeRule,
};
use tyndall_graph::{Catalogue, Graph, Overrides, Plan, PlanOptions, plan, read, validate_with};

pub fn texture(class: Class, format: Option<Format>) -> PortKind {
    PortKind::Texture { dimension: Dimension::D2, class, format, filtered: false }
}

pub fn port(name: &str, role: Role, kind: PortKind) -> PortDescriptor {
    PortDescriptor {
        name: name.into(),
        about: String::new(),
        unit: String::new(),
        role,
        kind,
        size: None,
        unordered: false,
    }
}

pub fn input(name: &str, class: Class) -> PortDescriptor {
    port(name, Role::Input, texture(class, None))
}

pub fn output(name: &str, class: Class, format: Format) -> PortDescriptor {
    port(name, Role::Output { disabled: Disabled::Constant([0.0; 4]) }, texture(class, Some(format)))
}

pub trait With {
    fn unit(self, unit: &str) -> Self;
    fn size(self, size: SizeRule) -> Self;
    fn through(self, input: &str) -> Self;
}

impl With for PortDescriptor {
    fn unit(self, unit: &str) -> Self {
        Self { unit: unit.into(), ..self }
    }
    fn size(self, size: SizeRule) -> Self {
        Self { size: Some(size), ..self }
    }
    fn through(self, input: &str) -> Self {
        Self { role: Role::Output { disabled: Disabled::Input(input.into()) }, ..self }
    }
}

pub fn param(name: &str, default: ParamValue, range: Option<(f64, f64)>) -> ParamDescriptor {
    ParamDescriptor {
        name: name.into(),
        about: String::new(),
        unit: String::new(),
        accepts: match &default {
            ParamValue::Bool(_) => ParamType::Bool,
            ParamValue::Integer(_) => ParamType::Integer { range },
            ParamValue::Float(_) => ParamType::Float { range },
            ParamValue::Vector(values) => ParamType::Vector { length: values.len(), range },
            ParamValue::Choice(word) => ParamType::Choice { words: vec![word.clone()] },
            ParamValue::File(_) => ParamType::File,
        },
        default,
        fixed: false,
    }
}

pub fn choice(name: &str, default: &str, words: &[&str]) -> ParamDescriptor {
    let accepts = ParamType::Choice { words: words.iter().map(|word| (*word).to_owned()).collect() };
    ParamDescriptor { accepts, ..param(name, ParamValue::Choice(default.into()), None) }
}

pub fn pass(name: &str, ports: Vec<PortDescriptor>, params: Vec<ParamDescriptor>) -> PassDescriptor {
    PassDescriptor {
        name: name.into(),
        about: String::new(),
        source: String::new(),
        ports: ports.into(),
        params: params.into(),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 0,
    }
}

const RADIANCE: &str = "W·sr⁻¹·m⁻²";

fn color(name: &str) -> PortDescriptor {
    output(name, Class::Color, Format::Rgba32Float).unit(RADIANCE)
}

/// The passes of the example graph.
fn rendering() -> Vec<PassDescriptor> {
    let depth = || input("depth", Class::Scalar).unit("m");
    let same = || SizeRule::same("depth");
    vec![
        PassDescriptor {
            scene: vec!["camera".into(), "triangles".into()],
            ..pass(
                "core.gbuffer",
                vec![
                    output("depth", Class::Scalar, Format::R32Float).unit("m"),
                    output("normal", Class::Vector, Format::Rgba16Float),
                    output("material", Class::Data, Format::Rgba32Uint),
                ],
                vec![],
            )
        },
        PassDescriptor {
            scene: vec!["camera".into(), "lights".into(), "medium".into()],
            ..pass(
                "surface_radiance.phong",
                vec![
                    depth(),
                    input("normal", Class::Vector).size(same()),
                    input("material", Class::Data).size(same()),
                    color("radiance").size(same()),
                ],
                vec![],
            )
        },
        PassDescriptor {
            scene: vec!["camera".into(), "lights".into(), "medium".into()],
            ..pass(
                "airlight.homogeneous",
                vec![depth(), color("radiance").size(same())],
                vec![param("nodes", ParamValue::Integer(12), Some((2.0, 32.0)))],
            )
        },
        pass(
            "core.compose",
            vec![
                input("surface", Class::Color).unit(RADIANCE),
                input("airlight", Class::Color).unit(RADIANCE).size(SizeRule::same("surface")),
                depth().size(SizeRule::same("surface")),
                color("radiance").size(SizeRule::same("surface")),
            ],
            vec![],
        ),
        pass(
            "core.tonemap",
            vec![
                input("radiance", Class::Color).unit(RADIANCE),
                output("color", Class::Display, Format::Rgba8Unorm).size(SizeRule::same("radiance")),
            ],
            vec![
                ParamDescriptor { unit: "1".into(), ..param("exposure", ParamValue::Float(1.0), Some((0.0, 1000.0))) },
                choice("curve", "none", &["reinhard", "filmic", "none"]),
                param("tint", ParamValue::Vector(vec![1.0; 3]), Some((0.0, 10.0))),
                param("dither", ParamValue::Bool(false), None),
                param("seed", ParamValue::Integer(0), None),
            ],
        ),
    ]
}

/// Passes of other forms.
fn forms() -> Vec<PassDescriptor> {
    let any = || texture(Class::Any, None);
    let buffer = |element: &str, stride| PortKind::Buffer { element: element.into(), stride };
    let constant = || Role::Output { disabled: Disabled::Constant([0.0; 4]) };
    let elements = SizeRule { width: Extent::FramePixels(0.5), height: Extent::Fixed(1), depth: Extent::Fixed(1) };
    let cube = |extent: &str| SizeRule {
        width: Extent::Param(extent.into()),
        height: Extent::Param(extent.into()),
        depth: Extent::Param(extent.into()),
    };
    let volume = |format| PortKind::Texture { dimension: Dimension::D3, class: Class::Data, format, filtered: true };
    vec![
        pass(
            "core.add",
            vec![
                input("a", Class::Color),
                port("b", Role::Optional([0.0, 0.0, 0.0, 1.0]), texture(Class::Color, None)).size(SizeRule::same("a")),
                output("sum", Class::Color, Format::Rgba32Float).size(SizeRule::same("a")).through("a"),
            ],
            vec![],
        ),
        pass(
            "core.halve",
            vec![
                port("image", Role::Input, any()),
                port("half", constant(), any()).size(SizeRule::scaled("image", 0.5)),
            ],
            vec![],
        ),
        pass(
            "core.accumulate",
            vec![
                input("sample", Class::Color),
                port("before", Role::History([0.0; 4]), texture(Class::Color, Some(Format::Rgba32Float)))
                    .size(SizeRule::same("sample")),
                output("mean", Class::Color, Format::Rgba32Float).size(SizeRule::same("sample")).through("sample"),
            ],
            vec![],
        ),
        pass(
            "core.grade",
            vec![port("image", Role::InOut, texture(Class::Color, Some(Format::Rgba32Float)))],
            vec![param("gain", ParamValue::Float(1.0), None)],
        ),
        pass(
            "core.table",
            vec![port("table", constant(), volume(Some(Format::Rgba16Float))).size(cube("extent"))],
            vec![param("extent", ParamValue::Integer(16), Some((-4.0, 64.0)))],
        ),
        pass("core.look_up", vec![port("table", Role::Input, volume(None)), color("color")], vec![]),
        pass("core.list", vec![port("list", constant(), buffer("Fragment", 16)).size(elements)], vec![]),
        pass("core.resolve", vec![port("list", Role::Input, buffer("Fragment", 16)), color("color")], vec![]),
        pass("core.resolve_links", vec![port("list", Role::Input, buffer("Link", 8)), color("color")], vec![]),
        pass(
            "core.meter",
            vec![
                input("image", Class::Color),
                port("mean", constant(), PortKind::Value { element: "Mean".into(), bytes: 16 }),
            ],
            vec![],
        ),
        pass(
            "core.expose",
            vec![
                input("image", Class::Color),
                port("mean", Role::Input, PortKind::Value { element: "Mean".into(), bytes: 16 }),
                output("color", Class::Color, Format::Rgba32Float).size(SizeRule::same("image")).through("image"),
            ],
            vec![],
        ),
        PassDescriptor { side_effect: true, ..pass("core.log", vec![input("image", Class::Color)], vec![]) },
        pass(
            "core.image",
            vec![output("image", Class::Color, Format::Rgba32Float)],
            vec![param("file", ParamValue::File(String::new()), None)],
        ),
        pass(
            "core.picture",
            vec![output("image", Class::Color, Format::Rgba32Float).size(SizeRule::picture("file"))],
            vec![param("file", ParamValue::File(String::new()), None)],
        ),
        pass(
            "core.tile",
            vec![output("tile", Class::Color, Format::Rgba32Float).size(SizeRule::fixed(64, 64, 1))],
            vec![],
        ),
        pass(
            "core.half_float",
            vec![
                port("image", Role::Input, texture(Class::Color, Some(Format::Rgba16Float))),
                output("image16", Class::Color, Format::Rgba16Float).size(SizeRule::same("image")).through("image"),
            ],
            vec![],
        ),
        pass("core.seconds", vec![output("time", Class::Scalar, Format::R32Float).unit("s")], vec![]),
        pass(
            "core.clock",
            vec![output("color", Class::Color, Format::Rgba32Float).size(SizeRule {
                width: Extent::Frame { axis: Axis::Y, scale: 0.5 },
                height: Extent::Frame { axis: Axis::X, scale: 0.5 },
                depth: Extent::Fixed(1),
            })],
            vec![param("frame", ParamValue::Integer(0), None), param("time", ParamValue::Float(0.0), None)],
        ),
    ]
}

pub fn catalogue() -> Catalogue {
    let mut catalogue = Catalogue::new();
    for descriptor in rendering().into_iter().chain(forms()) {
        catalogue.insert(Arc::new(descriptor)).unwrap();
    }
    catalogue
}

/// Files whose names begin with `missing` do not exist.
pub fn exists(path: &Path) -> bool {
    !path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("missing"))
}

/// The graph of a text, or its mistakes as they are shown.
pub fn try_graph(text: &str, overrides: &Overrides) -> Result<Arc<Graph>, String> {
    let source = Source::new("graphs/test.graph.ron", text);
    let mut out = Diagnostics::default();
    let file = read(&source, &mut out);
    let graph = file.and_then(|file| validate_with(&file, &catalogue(), overrides, &exists, &mut out));
    graph.ok_or_else(|| render_text(out.iter(), false))
}

pub fn graph(text: &str) -> Arc<Graph> {
    try_graph(text, &Overrides::default()).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

pub fn planned(text: &str) -> Plan {
    let graph = graph(text);
    plan(&graph, &PlanOptions::new(graph.size)).unwrap()
}

/// A file around passes and outputs.
pub fn file(passes: &str, outputs: &str) -> String {
    format!("(\n    version: 1,\n    passes: {{\n{passes}    }},\n    outputs: {{ {outputs} }},\n)\n")
}

pub const CONTRACT: &str = r#"(
    version: 1,
    about: "Point lights in homogeneous fog: airlight and fogged surfaces.",
    scene: "scenes/pavilion.scene.ron",
    size: (1280, 720),
    params: { "exposure": 1.0 },
    passes: {
        "surfaces": (use: "core.gbuffer"),
        "lit":      (use: "surface_radiance.phong", inputs: { "depth": "surfaces.depth", "normal": "surfaces.normal", "material": "surfaces.material" }),
        "air":      (use: "airlight.homogeneous", inputs: { "depth": "surfaces.depth" }),
        "fogged":   (use: "core.compose", inputs: { "surface": "lit.radiance", "airlight": "air.radiance", "depth": "surfaces.depth" }),
        "display":  (use: "core.tonemap", inputs: { "radiance": "fogged.radiance" }, params: { "exposure": "$exposure" }),
    },
    outputs: { "radiance": "fogged.radiance", "airlight": "air.radiance", "surface": "lit.radiance", "image": "display.color" },
)
"#;

/// A graph file of about as many passes, in groups like the example graph's, each group reading the one before it.
pub fn generated(passes: usize) -> String {
    use std::fmt::Write;
    let mut text = String::from(
        "(\n    version: 1,\n    about: \"Generated.\",\n    params: { \"exposure\": 1.0 },\n    passes: {\n",
    );
    let groups = passes.div_ceil(5);
    for group in 0..groups {
        let left = (passes - 5 * group).min(5);
        let lines = [
            format!(r#""surfaces_{group}": (use: "core.gbuffer"),"#),
            format!(
                r#""lit_{group}": (use: "surface_radiance.phong", inputs: {{ "depth": "surfaces_{group}.depth", "normal": "surfaces_{group}.normal", "material": "surfaces_{group}.material" }}),"#
            ),
            format!(
                r#""air_{group}": (use: "airlight.homogeneous", inputs: {{ "depth": "surfaces_{group}.depth" }}, params: {{ "nodes": 8 }}),"#
            ),
            format!(
                r#""fogged_{group}": (use: "core.compose", inputs: {{ "surface": "lit_{group}.radiance", "airlight": "air_{group}.radiance", "depth": "surfaces_{group}.depth" }}),"#
            ),
            match group {
                0 => format!(r#""sum_{group}": (use: "core.add", inputs: {{ "a": "fogged_{group}.radiance" }}),"#),
                _ => format!(
                    r#""sum_{group}": (use: "core.add", inputs: {{ "a": "fogged_{group}.radiance", "b": "sum_{}.sum" }}),"#,
                    group - 1
                ),
            },
        ];
        for line in &lines[..left] {
            writeln!(text, "        {line}").unwrap();
        }
    }
    let last = match (passes % 5, groups - 1) {
        (0, last) => format!("sum_{last}.sum"),
        (1, last) => format!("surfaces_{last}.depth"),
        (2, last) => format!("lit_{last}.radiance"),
        (3, last) => format!("air_{last}.radiance"),
        (_, last) => format!("fogged_{last}.radiance"),
    };
    let line = r#"        "display": (use: "core.tonemap", inputs: { "radiance": "sum_0.sum" }, params: { "exposure": "$exposure" }),"#;
    if passes >= 5 {
        writeln!(text, "{line}").unwrap();
        write!(text, "    }},\n    outputs: {{ \"last\": \"{last}\", \"image\": \"display.color\" }},\n)\n").unwrap();
    }
    text
}
