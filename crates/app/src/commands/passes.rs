//! `passes`: what every pass declares.

use serde_json::{Value, json};
use tyndall_document::did_you_mean;
use tyndall_graph::descriptor::{
    Axis, Class, Dimension, Disabled, Extent, ParamDescriptor, ParamType, ParamValue, PortDescriptor, PortKind, Preset,
    Role, SizeRule,
};
use tyndall_plugin::{Limit, Origin, RegistryPass};

use crate::App;
use crate::cli::{Arguments, Passes};
use crate::failure::Failure;
use crate::{plugins, terminal};

/// Every sound pass, and then every mistake of those that are not; or one pass.
pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Passes) -> Result<(), Failure> {
    let registry = plugins::registry(app, arguments, &[])?;
    let Some(name) = &verb.name else {
        let passes: Vec<&RegistryPass> = registry.passes().collect();
        if verb.json {
            terminal::line(&format!("{:#}", passes.iter().map(|pass| as_json(pass)).collect::<Value>()));
        } else {
            terminal::text(&list(&passes));
        }
        let mistakes = registry.mistakes();
        return if mistakes.has_errors() { Err(mistakes.into()) } else { Ok(()) };
    };
    let pass = match registry.find(name) {
        Some(found) => found.map_err(Clone::clone)?,
        None => {
            let near = registry.near(name).map(|near| format!("; {}", did_you_mean(near))).unwrap_or_default();
            return Err(Failure::Usage(format!("there is no pass `{name}`{near}")));
        }
    };
    if verb.json {
        terminal::line(&format!("{:#}", as_json(pass)));
    } else {
        terminal::text(&document(pass));
    }
    Ok(())
}

/// One line for each pass, under its plugin.
fn list(passes: &[&RegistryPass]) -> String {
    let width = passes.iter().map(|pass| pass.descriptor.name.len()).max().unwrap_or_default();
    let mut text = String::new();
    let mut plugin = "";
    for pass in passes {
        let name = pass.descriptor.name.as_str();
        let of = name.split_once('.').map_or(name, |(plugin, _)| plugin);
        if of != plugin {
            plugin = of;
            text += &format!("{of} {}  {}  [{}]\n", pass.version, pass.plugin_about, origin(&pass.origin));
        }
        text += &format!("  {name:width$}  {}\n", first_sentence(&pass.descriptor.about));
    }
    text
}

fn first_sentence(text: &str) -> &str {
    text.find(". ").map_or(text, |end| &text[..=end])
}

fn origin(origin: &Origin) -> String {
    match origin {
        Origin::BuiltIn => "built in".to_owned(),
        Origin::Folder(path) => path.display().to_string(),
    }
}

/// Everything that a pass declares, as a page.
fn document(pass: &RegistryPass) -> String {
    let descriptor = &pass.descriptor;
    let mut text = format!("{}  ({}, {})\n\n", descriptor.name, pass.version, origin(&pass.origin));
    text += &wrapped(&descriptor.about, "");
    if !descriptor.source.is_empty() {
        text += &wrapped(&format!("Source: {}", descriptor.source), "");
    }
    section(&mut text, "Inputs", descriptor.ports.iter().filter(|port| port.role.is_input()).map(port_text));
    section(&mut text, "Outputs", descriptor.ports.iter().filter(|port| port.role.is_output()).map(port_text));
    section(&mut text, "Parameters", descriptor.params.iter().map(|param| param_text(pass, param)));
    section(&mut text, "Presets", descriptor.presets.iter().map(preset_text));
    section(&mut text, "Limits", pass.limits.iter().map(limit_text));
    if !descriptor.scene.is_empty() {
        text += &format!("\nReads of the scene: {}\n", descriptor.scene.join(", "));
    }
    text
}

fn section(text: &mut String, title: &str, entries: impl Iterator<Item = String>) {
    let entries: Vec<String> = entries.collect();
    if !entries.is_empty() {
        *text += &format!("\n{title}\n{}", entries.concat());
    }
}

fn port_text(port: &PortDescriptor) -> String {
    let mut facts = vec![kind(&port.kind)];
    facts.extend((!port.unit.is_empty()).then(|| port.unit.clone()));
    facts.extend(port.size.as_ref().map(size));
    facts.extend(role(port));
    facts.extend(port.unordered.then(|| "unordered".to_owned()));
    format!("  {}: {}\n{}", port.name, facts.join(", "), wrapped(&port.about, "      "))
}

fn param_text(pass: &RegistryPass, param: &ParamDescriptor) -> String {
    let mut facts = vec![type_name(&param.accepts).to_owned()];
    facts.extend((!param.unit.is_empty()).then(|| param.unit.clone()));
    facts.push(format!("default {}", param.default));
    facts.extend(param.accepts.range().map(|(low, high)| format!("{low} to {high}")));
    let choices = param.accepts.choices();
    facts.extend((!choices.is_empty()).then(|| format!("one of {}", choices.join(", "))));
    facts.extend(param.fixed.then(|| "part of the pipeline".to_owned()));
    facts.extend(need(pass, param).map(|port| format!("needs the input {port}")));
    format!("  {}: {}\n{}", param.name, facts.join(", "), wrapped(&param.about, "      "))
}

/// The input without which a switch has no effect.
fn need<'a>(pass: &'a RegistryPass, param: &ParamDescriptor) -> Option<&'a str> {
    pass.needs.iter().find(|need| need.param == param.name).map(|need| need.port.as_str())
}

fn limit_text(limit: &Limit) -> String {
    wrapped(&format!("{}: {}", limit.feature.name, limit.text), "  ")
}

fn preset_text(preset: &Preset) -> String {
    let values: Vec<String> = preset.values.iter().map(|(name, value)| format!("{name} {value}")).collect();
    let values = if values.is_empty() { "the defaults".to_owned() } else { values.join(", ") };
    wrapped(&format!("{}: {values}", preset.name), "  ") + &wrapped(&preset.about, "      ")
}

fn kind(kind: &PortKind) -> String {
    match kind {
        PortKind::Texture { dimension, class, format, filtered } => {
            let dimension = match dimension {
                Dimension::D2 => "2D texture",
                Dimension::D2Array => "2D texture with layers",
                Dimension::D3 => "3D texture",
            };
            let format = format.map(|format| format!(", {format}")).unwrap_or_default();
            format!("{dimension} of {}{format}{}", class_name(*class), if *filtered { ", filtered" } else { "" })
        }
        PortKind::Buffer { element, stride } => format!("buffer of {element} ({stride} bytes each)"),
        PortKind::Value { element, bytes } => format!("value {element} ({bytes} bytes)"),
    }
}

fn class_name(class: Class) -> String {
    format!("{class:?}").to_lowercase()
}

fn role(port: &PortDescriptor) -> Option<String> {
    // A constant has four channels; for a scalar port the first one is shown.
    let constant = |value: &[f32; 4]| match port.kind {
        PortKind::Texture { class: Class::Scalar, .. } => value[0].to_string(),
        _ => format!("({})", value.map(|channel| channel.to_string()).join(", ")),
    };
    match &port.role {
        Role::Input => None,
        Role::Optional(value) => Some(format!("optional, else {}", constant(value))),
        Role::History(first) => Some(format!("the frame before, at first {}", constant(first))),
        Role::Output { disabled } => Some(match disabled {
            Disabled::Input(port) => format!("when off: {port} is passed on"),
            Disabled::Constant(value) => format!("off: {}", constant(value)),
        }),
        Role::InOut => Some("changed in place".to_owned()),
    }
}

fn type_name(accepts: &ParamType) -> &'static str {
    match accepts {
        ParamType::Bool => "switch",
        ParamType::Integer { .. } => "whole number",
        ParamType::Float { .. } => "number",
        ParamType::Vector { .. } => "vector",
        ParamType::Choice { .. } => "choice",
        ParamType::File => "file",
    }
}

fn size(rule: &SizeRule) -> String {
    let axes = [&rule.width, &rule.height, &rule.depth];
    if let Extent::Port { port, axis: Axis::X, scale } = &rule.width
        && matches!(&rule.height, Extent::Port { port: other, .. } if other == port)
    {
        return if *scale == 1.0 { format!("as large as {port}") } else { format!("{scale} of {port}") };
    }
    if let Extent::Picture { param, .. } = &rule.width {
        return format!("as large as the picture `{param}`");
    }
    if let Extent::Frame { axis: Axis::X, scale } = rule.width {
        let layers = match rule.depth {
            Extent::Fixed(layers) if layers > 1 => format!(", {layers} layers"),
            _ => String::new(),
        };
        let frame = if scale == 1.0 { "as large as the frame".to_owned() } else { format!("{scale} of the frame") };
        return frame + &layers;
    }
    axes.map(extent).join(" x ")
}

fn extent(extent: &Extent) -> String {
    match extent {
        Extent::Fixed(texels) => texels.to_string(),
        Extent::Frame { scale, .. } => format!("{scale} of the frame"),
        Extent::Port { port, scale, .. } => format!("{scale} of {port}"),
        Extent::Param(name) => name.clone(),
        Extent::Picture { param, axis } => format!("{axis} of the picture `{param}`"),
        Extent::FramePixels(scale) => format!("{scale} per pixel"),
    }
}

/// A paragraph, wrapped at 100 characters.
fn wrapped(text: &str, indent: &str) -> String {
    let mut lines = String::new();
    let mut line = indent.to_owned();
    for word in text.split_whitespace() {
        if line.len() > indent.len() && line.len() + 1 + word.len() > 100 {
            lines += &line;
            lines.push('\n');
            line = indent.to_owned();
        }
        if line.len() > indent.len() {
            line.push(' ');
        }
        line += word;
    }
    lines + &line + "\n"
}

fn as_json(pass: &RegistryPass) -> Value {
    let descriptor = &pass.descriptor;
    json!({
        "name": descriptor.name,
        "version": pass.version.to_string(),
        "origin": origin(&pass.origin),
        "about": descriptor.about,
        "source": descriptor.source,
        "inputs": descriptor.ports.iter().filter(|port| port.role.is_input()).map(port_json).collect::<Vec<_>>(),
        "outputs": descriptor.ports.iter().filter(|port| port.role.is_output()).map(port_json).collect::<Vec<_>>(),
        "params": descriptor.params.iter().map(|param| param_json(pass, param)).collect::<Vec<_>>(),
        "presets": descriptor.presets.iter().map(preset_json).collect::<Vec<_>>(),
        "limits": pass.limits.iter().map(limit_json).collect::<Vec<_>>(),
        "scene": descriptor.scene,
    })
}

fn port_json(port: &PortDescriptor) -> Value {
    let (class, format, filtered) = match &port.kind {
        PortKind::Texture { class, format, filtered, .. } => {
            (Some(class_name(*class)), format.map(|format| format.to_string()), *filtered)
        }
        _ => (None, None, false),
    };
    json!({
        "name": port.name,
        "about": port.about,
        "unit": port.unit,
        "type": kind(&port.kind),
        "class": class,
        "format": format,
        "filtered": filtered,
        "size": port.size.as_ref().map(size),
        "required": port.role == Role::Input,
        "role": role(port),
        "unordered": port.unordered,
    })
}

fn preset_json(preset: &Preset) -> Value {
    let values: serde_json::Map<String, Value> =
        preset.values.iter().map(|(name, value)| (name.clone(), value_json(value))).collect();
    json!({ "name": preset.name, "about": preset.about, "values": values })
}

fn limit_json(limit: &Limit) -> Value {
    json!({ "scene": limit.feature.name, "text": limit.text })
}

fn value_json(value: &ParamValue) -> Value {
    match value {
        ParamValue::Bool(on) => json!(on),
        ParamValue::Integer(number) => json!(number),
        ParamValue::Float(number) => json!(number),
        ParamValue::Vector(numbers) => json!(numbers),
        ParamValue::Choice(word) | ParamValue::File(word) => json!(word),
    }
}

fn param_json(pass: &RegistryPass, param: &ParamDescriptor) -> Value {
    json!({
        "name": param.name,
        "about": param.about,
        "unit": param.unit,
        "type": type_name(&param.accepts),
        "default": value_json(&param.default),
        "range": param.accepts.range().map(|(low, high)| [low, high]),
        "choices": param.accepts.choices(),
        "fixed": param.fixed,
        "needs": need(pass, param),
    })
}
