//! Presets: values of several parameters under one word, in the place of the defaults and of nothing else.

#![allow(clippy::unwrap_used, reason = "a test")]

mod support;

use std::sync::Arc;

use support::{choice, output, param, pass};
use tyndall_document::{Diagnostics, Source};
use tyndall_graph::descriptor::{Class, Format, PRESET, ParamValue, PassDescriptor, Preset};
use tyndall_graph::{Catalogue, DescriptorError, Graph, Override, Overrides, ParamSetting, read, validate};

fn preset(name: &str, values: &[(&str, ParamValue)]) -> Preset {
    let values = values.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    Preset { name: name.into(), about: String::new(), values }
}

fn descriptor(presets: Vec<Preset>) -> PassDescriptor {
    let choose = choice(PRESET, "clear", &["clear", "hazy"]);
    let density = param("density", ParamValue::Float(1.0), Some((0.0, 10.0)));
    let tint = param("tint", ParamValue::Vector(vec![1.0; 3]), None);
    let color = output("color", Class::Color, Format::Rgba32Float);
    PassDescriptor { presets, ..pass("test.air", vec![color], vec![choose, density, tint]) }
}

fn hazy() -> Vec<Preset> {
    let tint = ParamValue::Vector(vec![0.5, 0.25, 0.125]);
    vec![preset("clear", &[]), preset("hazy", &[("density", ParamValue::Float(5.0)), ("tint", tint)])]
}

/// Density and tint of the pass `air` with these parameters and settings of the command line.
fn settings(params: &str, arguments: &[&str]) -> Result<[ParamValue; 2], String> {
    let mut catalogue = Catalogue::new();
    catalogue.insert(Arc::new(descriptor(hazy()))).unwrap();
    let text = format!(
        "(version: 1, params: {{ \"weather\": \"hazy\" }}, passes: {{
            \"air\": (use: \"test.air\", params: {{ {params} }}),
            \"other\": (use: \"test.air\", params: {{ \"preset\": \"$weather\" }}),
        }}, outputs: {{ \"color\": \"air.color\", \"other\": \"other.color\" }})"
    );
    let mut out = Diagnostics::default();
    let file = read(&Source::new("test.graph.ron", text), &mut out).unwrap();
    let parse = |argument: &&str| Override::parse(argument, argument).unwrap();
    let overrides = Overrides { params: arguments.iter().map(parse).collect(), ..Overrides::default() };
    let graph: Option<Arc<Graph>> = validate(&file, &catalogue, &overrides, &mut out);
    let Some(graph) = graph else { return Err(tyndall_document::render_text(out.iter(), false)) };
    let air = graph.pass(graph.pass_named("air").unwrap());
    let value = |name: &str| match &air.params[air.descriptor().param_named(name).unwrap()] {
        ParamSetting::Value(value) => value.clone(),
        live => panic!("{live:?}"),
    };
    Ok([value("density"), value("tint")])
}

fn found(density: f64, tint: [f64; 3]) -> Result<[ParamValue; 2], String> {
    Ok([ParamValue::Float(density), ParamValue::Vector(tint.to_vec())])
}

const WHITE: [f64; 3] = [1.0; 3];
const TINT: [f64; 3] = [0.5, 0.25, 0.125];

#[test]
fn a_preset_stands_in_for_defaults() {
    assert_eq!(settings("", &[]), found(1.0, WHITE));
    assert_eq!(settings("\"preset\": \"hazy\"", &[]), found(5.0, TINT));
    assert_eq!(settings("\"preset\": \"$weather\"", &[]), found(5.0, TINT));
    assert_eq!(settings("\"preset\": \"$weather\"", &["weather=\"clear\""]), found(1.0, WHITE));
    assert_eq!(settings("", &["air.preset=\"hazy\""]), found(5.0, TINT));
}

#[test]
fn what_is_given_stays_in_whatever_order_it_stands() {
    assert_eq!(settings("\"density\": 2, \"preset\": \"hazy\"", &[]), found(2.0, TINT));
    assert_eq!(settings("\"preset\": \"hazy\", \"density\": 2", &[]), found(2.0, TINT));
    assert_eq!(settings("\"density\": 2", &["air.preset=\"hazy\""]), found(2.0, TINT));
    assert_eq!(settings("\"preset\": \"hazy\"", &["air.density=3"]), found(3.0, TINT));
    // The default, said aloud, is given as well.
    assert_eq!(settings("\"preset\": \"hazy\", \"density\": 1.0", &[]), found(1.0, TINT));
}

#[test]
fn an_unknown_preset_is_refused_with_a_near_name() {
    for error in [settings("\"preset\": \"hasy\"", &[]), settings("", &["air.preset=\"hasy\""])] {
        let text = error.unwrap_err();
        assert!(text.contains("unknown-choice") && text.contains("did you mean `hazy`?"), "{text}");
    }
}

#[test]
fn presets_that_contradict_their_pass_are_refused() {
    let wrong = |presets: Vec<Preset>| {
        let errors = Catalogue::new().insert(Arc::new(descriptor(presets))).err().unwrap_or_default();
        assert!(errors.iter().all(|error| matches!(error, DescriptorError::BadPreset { .. })), "{errors:?}");
        errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    let one = |name: &str, value: ParamValue| wrong(vec![preset("hazy", &[(name, value)])]);
    assert_eq!(wrong(hazy()), "");
    assert!(wrong(vec![preset("foggy", &[])]).contains("is not one of the choices of the parameter `preset`"));
    assert!(wrong(vec![preset("hazy", &[]), preset("hazy", &[])]).contains("appears twice"));
    assert!(one("densty", ParamValue::Float(1.0)).contains("not a parameter of the pass"));
    assert!(one("density", ParamValue::Integer(1)).contains("must be a number, got a whole number"));
    assert!(one("density", ParamValue::Float(11.0)).contains("must be between 0 and 10, got 11"));
    assert!(one("tint", ParamValue::Vector(vec![1.0; 2])).contains("must be 3 numbers, got 2 numbers"));
    assert!(one(PRESET, ParamValue::Choice("clear".into())).contains("chooses a preset"));
}
