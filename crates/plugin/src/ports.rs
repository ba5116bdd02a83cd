//! What a manifest adds to reflection, joined into a descriptor.

use std::sync::Arc;

use tyndall_document::{BAD_SIZE, Decoder, Diagnostic, Diagnostics, Node, Source, Value};
use tyndall_graph::descriptor::{
    Class, Disabled, Extent, Format, ParamDescriptor, ParamType, PassDescriptor, PortDescriptor, PortKind, Role,
    SizeRule,
};
use tyndall_shader::{Linked, ParamKind, ReflectedPort, ResourceKind, SampleClass, derive_port};

use crate::codes::{BAD_PARAM, BAD_PORT};
use crate::keys;
use crate::manifest::{Entry, ManifestPass};
use crate::presets::{preset_param, presets};

/// A switch that does nothing where an optional input is not fed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Need {
    /// The switch.
    pub param: String,
    /// The input.
    pub port: String,
}

/// The descriptor of a pass of a manifest, from its shader and what the manifest adds.
pub(crate) fn descriptor(
    plugin: &str,
    pass: &ManifestPass,
    source: &Arc<Source>,
    linked: &Linked,
    scene_names: &[&str],
    out: &mut Diagnostics,
) -> PassDescriptor {
    let mut decoder = Decoder::new(source, out);
    let ports = pass.ports.iter().filter_map(|entry| port(&mut decoder, entry, linked)).collect();
    let params: Vec<ParamDescriptor> =
        pass.params.iter().filter_map(|entry| param(&mut decoder, entry, linked)).collect();
    let presets = presets(&mut decoder, &pass.presets, &params);
    let params = preset_param(&presets).into_iter().chain(params).collect();
    let mut scene: Vec<String> = linked.resources.iter().map(|resource| resource.name.clone()).collect();
    scene.retain(|name| scene_names.contains(&name.as_str()));
    scene.sort();
    PassDescriptor {
        name: format!("{plugin}.{}", pass.name),
        about: pass.about.clone(),
        source: pass.origin.clone(),
        ports,
        params,
        presets,
        scene,
        side_effect: false,
        revision: 0,
    }
}

fn port(decoder: &mut Decoder<'_>, entry: &Entry, linked: &Linked) -> Option<PortDescriptor> {
    let fields = decoder.fields(&entry.value, "a port", keys::PORT)?;
    let Some(resource) = linked.resource(&entry.name) else {
        let names = linked.resources.iter().map(|resource| resource.name.as_str());
        let message = format!("the shader has no variable `{}` for this port", entry.name);
        let problem = Diagnostic::error(BAD_PORT, decoder.place(entry.name_span), message);
        let otherwise = format!("declare `var {}: …;` in the shader", entry.name);
        decoder.report(problem.suggest_near_or(&entry.name, names, otherwise));
        return None;
    };
    let reflected = match derive_port(resource) {
        Ok(reflected) => reflected,
        Err(problem) => {
            decoder.report(*problem);
            return None;
        }
    };
    let text = |decoder: &mut Decoder<'_>, name: &str| {
        fields.get(name).and_then(|node| decoder.text(node)).unwrap_or_default().to_owned()
    };
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let unit = text(decoder, "unit");
    let class = fields.get("class").and_then(|node| class(decoder, node));
    let size = fields.get("size").and_then(|node| size(decoder, node));
    let optional = fields.get("optional").and_then(|node| decoder.floats4(node));
    let history = fields.get("history").and_then(|node| decoder.floats4(node));
    let disabled = fields.get("disabled").and_then(|node| disabled(decoder, node));
    let unordered = fields.get("unordered").and_then(|node| decoder.bool(node)).unwrap_or(false);
    let role = match (reflected.readable, reflected.writable) {
        (true, true) => Role::InOut,
        (true, false) => match (optional, history) {
            (Some(value), None) => Role::Optional(value),
            (None, Some(value)) => Role::History(value),
            (None, None) => Role::Input,
            (Some(_), Some(_)) => {
                let place = decoder.place(entry.value.span);
                decoder.report(Diagnostic::error(BAD_PORT, place, "a port is `optional` or `history`, not both"));
                return None;
            }
        },
        _ => Role::Output { disabled: disabled.unwrap_or(Disabled::Constant([0.0, 0.0, 0.0, 1.0])) },
    };
    let mut kind = kind(reflected, class);
    if let (Role::Optional(_), ResourceKind::Texture { class: SampleClass::Uint, .. }) = (&role, &resource.kind) {
        store_as(&mut kind, Format::Rgba32Uint);
    }
    Some(PortDescriptor { name: entry.name.clone(), about, unit, role, kind, size, unordered })
}

fn kind(reflected: ReflectedPort, stated: Option<Class>) -> PortKind {
    match (reflected.kind, stated) {
        (PortKind::Texture { dimension, format, filtered, .. }, Some(class)) => {
            PortKind::Texture { dimension, class, format, filtered }
        }
        (kind, _) => kind,
    }
}

/// What stands for an optional input that nothing feeds must be of a format that its variable can read.
fn store_as(kind: &mut PortKind, stored: Format) {
    if let PortKind::Texture { format, .. } = kind {
        *format = Some(stored);
    }
}

fn class(decoder: &mut Decoder<'_>, node: &Node) -> Option<Class> {
    let (name, _) = decoder.variant(node, "a class of textures", keys::CLASS)?;
    Some(match name {
        "Color" => Class::Color,
        "Scalar" => Class::Scalar,
        "Vector" => Class::Vector,
        "Display" => Class::Display,
        "Data" => Class::Data,
        "RasterDepth" => Class::RasterDepth,
        _ => Class::Any,
    })
}

fn disabled(decoder: &mut Decoder<'_>, node: &Node) -> Option<Disabled> {
    let (name, content) = decoder.variant(node, "a value of `disabled`", keys::DISABLED)?;
    match (name, content.map(arguments).as_deref()) {
        ("Input", Some([port])) => decoder.text(port).map(|port| Disabled::Input(port.to_owned())),
        ("Constant", Some([_, _, _, _])) => content.and_then(|value| decoder.floats4(value)).map(Disabled::Constant),
        _ => {
            decoder.wrong_type(node, "`Input(\"port\")` or `Constant(r, g, b, a)`");
            None
        }
    }
}

fn size(decoder: &mut Decoder<'_>, node: &Node) -> Option<SizeRule> {
    let (name, content) = decoder.variant(node, "a size", keys::SIZE)?;
    let content = content.map(arguments).unwrap_or_default();
    let rule = match (name, content.as_slice()) {
        ("Same", [port]) => Some(SizeRule::same(decoder.text(port)?)),
        ("Scaled", [port, factor]) => {
            let port = decoder.text(port)?.to_owned();
            factor_of(decoder, factor).map(|factor| SizeRule::scaled(&port, factor))
        }
        ("Frame", []) => Some(SizeRule::frame(1.0)),
        ("Frame", [factor]) => factor_of(decoder, factor).map(SizeRule::frame),
        ("FramePixels", [factor]) => factor_of(decoder, factor).map(|factor| SizeRule {
            width: Extent::FramePixels(factor),
            height: Extent::Fixed(1),
            depth: Extent::Fixed(1),
        }),
        ("Fixed" | "Params", [_] | [_, _] | [_, _, _]) => {
            let extents: Option<Vec<Extent>> = content.iter().map(|node| extent(decoder, node)).collect();
            extents.map(|extents| {
                let at = |axis: usize| extents.get(axis).cloned().unwrap_or(Extent::Fixed(1));
                SizeRule { width: at(0), height: at(1), depth: at(2) }
            })
        }
        _ => None,
    };
    if rule.is_none() {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(BAD_SIZE, place, format!("wrong arguments of the size `{name}`"));
        decoder.report(problem.suggest(
            "sizes are Same(\"port\"), Scaled(\"port\", factor), Frame(factor), Fixed(w, h, d), \
             Params(\"width\", \"height\"), FramePixels(factor)",
        ));
    }
    rule
}

/// The extent of one axis: a number of texels, or the name of an integer parameter.
fn extent(decoder: &mut Decoder<'_>, node: &Node) -> Option<Extent> {
    match &node.value {
        Value::Text(name) => Some(Extent::Param(name.clone())),
        _ => decoder.integer(node).and_then(|texels| u32::try_from(texels).ok()).filter(|t| *t > 0).map(Extent::Fixed),
    }
}

fn factor_of(decoder: &mut Decoder<'_>, node: &Node) -> Option<f64> {
    decoder.float(node).filter(|factor| *factor > 0.0)
}

/// What stands in the parentheses of a variant: one value, or several.
pub(crate) fn arguments(content: &Node) -> Vec<&Node> {
    match &content.value {
        Value::Tuple(items) => items.iter().collect(),
        Value::Unit => Vec::new(),
        _ => vec![content],
    }
}

fn param(decoder: &mut Decoder<'_>, entry: &Entry, linked: &Linked) -> Option<ParamDescriptor> {
    let fields = decoder.fields(&entry.value, "a parameter", keys::PARAM)?;
    let reflected = linked.param(&entry.name);
    if let Some(node) = fields.get("needs") {
        needed_port(decoder, node, linked);
    }
    let Some(reflected) = reflected else {
        let message = format!("the shader has no parameter `{}`", entry.name);
        let problem = Diagnostic::error(BAD_PARAM, decoder.place(entry.name_span), message);
        let names = linked.params.iter().map(|param| param.name.as_str());
        let otherwise = "parameters are the members of `Params`, and `override`s";
        decoder.report(problem.suggest_near_or(&entry.name, names, otherwise));
        return None;
    };
    let about = fields.required(decoder, "about").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let unit = fields.get("unit").and_then(|node| decoder.text(node)).unwrap_or_default().to_owned();
    let choices = fields.get("choices").and_then(|node| words(decoder, node)).unwrap_or_default();
    let range = fields.get("range").and_then(|node| decoder.floats::<2>(node)).map(|[low, high]| (low, high));
    let node = fields.required(decoder, "default")?;
    let accepts = accepted(reflected.kind, &node.value, range, choices);
    let default = accepts.read(decoder, node, &entry.name, &unit)?;
    Some(ParamDescriptor { name: entry.name.clone(), about, unit, accepts, default, fixed: reflected.is_override() })
}

/// What a parameter accepts: of the type that the shader says; a `u32` is a switch where its default is one, and a choice
/// where there are words to choose from.
fn accepted(kind: ParamKind, default: &Value, range: Option<(f64, f64)>, words: Vec<String>) -> ParamType {
    match (kind, default) {
        (ParamKind::Uint, _) if !words.is_empty() => ParamType::Choice { words },
        (ParamKind::Bool, _) | (ParamKind::Uint, Value::Bool(_)) => ParamType::Bool,
        (ParamKind::Int | ParamKind::Uint, _) => ParamType::Integer { range },
        (ParamKind::Float, _) => ParamType::Float { range },
        (ParamKind::Vector(length), _) => ParamType::Vector { length: length.into(), range },
    }
}

/// The input that a switch needs must be one of the shader's.
fn needed_port(decoder: &mut Decoder<'_>, node: &Node, linked: &Linked) {
    let Some(name) = decoder.text(node) else { return };
    if linked.resource(name).is_none() {
        let message = format!("the shader has no variable `{name}` that the switch could need");
        let problem = Diagnostic::error(BAD_PARAM, decoder.place(node.span), message);
        let names = linked.resources.iter().map(|resource| resource.name.as_str());
        decoder.report(problem.suggest_near_or(name, names, "`needs` names an optional input of the pass"));
    }
}

/// Switches of the pass that do nothing without an input: parameters with `needs`.
pub(crate) fn needs(pass: &ManifestPass) -> Vec<Need> {
    let need = |entry: &Entry| {
        let Value::Struct(fields) = &entry.value.value else { return None };
        match &fields.iter().find(|field| field.name == "needs")?.value.value {
            Value::Text(port) => Some(Need { param: entry.name.clone(), port: port.clone() }),
            _ => None,
        }
    };
    pass.params.iter().filter_map(need).collect()
}

fn words(decoder: &mut Decoder<'_>, node: &Node) -> Option<Vec<String>> {
    let items = decoder.list(node)?;
    items.iter().map(|item| decoder.text(item).map(str::to_owned)).collect()
}

/// Four numbers that may be infinite: what a texel reads as.
trait Floats4 {
    fn floats4(&mut self, node: &Node) -> Option<[f32; 4]>;
}

impl Floats4 for Decoder<'_> {
    fn floats4(&mut self, node: &Node) -> Option<[f32; 4]> {
        let numbers: Option<Vec<f32>> = match &node.value {
            Value::Tuple(items) => items.iter().map(|item| number(&item.value)).collect(),
            _ => None,
        };
        let numbers = numbers.and_then(|numbers| <[f32; 4]>::try_from(numbers).ok());
        if numbers.is_none() {
            self.wrong_type(node, "a tuple of 4 numbers");
        }
        numbers
    }
}

fn number(value: &Value) -> Option<f32> {
    match value {
        Value::Number(number) if !number.value.is_nan() => Some(number.value as f32),
        _ => None,
    }
}
