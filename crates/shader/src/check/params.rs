//! Parameters held against members of `params` and `override`s.

use tyndall_document::{Diagnostic, did_you_mean, near};
use tyndall_graph::descriptor::{ParamDescriptor, ParamType, ParamValue};

use super::Pass;
use crate::codes;
use crate::naming::{PARAMS, counted};
use crate::params::{Param, ParamDefault, ParamKind, ParamSource};

pub fn check(pass: &Pass<'_>, out: &mut Vec<Diagnostic>) {
    for param in found(pass) {
        match pass.descriptor.param(&param.name) {
            Some(declared) => out.extend(disagreement(declared, param)),
            None => out.push(unknown(pass, param)),
        }
    }
    let mut reported: Vec<&str> = Vec::new();
    for param in found(pass) {
        let known = pass.descriptor.param(&param.name).is_some();
        let used = found(pass).any(|other| other.name == param.name && other.used);
        if known && !used && !reported.contains(&param.name.as_str()) {
            reported.push(&param.name);
            let message = format!("the parameter `{}` is declared, and no entry point reads it", param.name);
            let problem = Diagnostic::error(codes::UNUSED, param.place.clone(), message);
            out.push(problem.suggest("use it or remove it"));
        }
    }
    for declared in &pass.descriptor.params {
        let misnamed = |param: &Param| meant(pass, param) == Some(&declared.name);
        let has = found(pass).any(|param| param.name == declared.name || misnamed(param)) || is_unused(pass, declared);
        if !has && declared.accepts != ParamType::File {
            out.push(missing(pass, declared));
        }
    }
}

fn found<'a>(pass: &'a Pass<'_>) -> impl Iterator<Item = &'a Param> {
    let of_scene = |param: &&Param| {
        let list = counted(&param.name).is_some_and(|name| pass.scene_names.contains(&name));
        param.is_override() && list && pass.descriptor.param(&param.name).is_none()
    };
    pass.shaders.iter().flat_map(|linked| &linked.params).filter(move |param| !of_scene(param))
}

fn unknown(pass: &Pass<'_>, param: &Param) -> Diagnostic {
    let message = format!("unknown parameter `{}` of `{}`", param.name, pass.descriptor.name);
    let problem = Diagnostic::error(codes::PARAM, param.place.clone(), message);
    let otherwise = || "declare it among the parameters of the pass, or remove it".to_owned();
    problem.suggest(meant(pass, param).map_or_else(otherwise, did_you_mean))
}

/// Whether it, or the variable whose member it would be, exists but is unused, which is reported elsewhere.
fn is_unused(pass: &Pass<'_>, declared: &ParamDescriptor) -> bool {
    let name = if declared.fixed { declared.name.as_str() } else { PARAMS };
    pass.shaders.iter().flat_map(|linked| &linked.unused).any(|unused| unused.name == name)
}

/// What was probably meant by the name of an unknown parameter.
fn meant<'a>(pass: &'a Pass<'_>, param: &Param) -> Option<&'a str> {
    let names = || pass.descriptor.params.iter().map(|param| param.name.as_str());
    if names().any(|name| name == param.name) { None } else { near(&param.name, names()) }
}

fn missing(pass: &Pass<'_>, declared: &ParamDescriptor) -> Diagnostic {
    let message = format!("no shader of `{}` has its parameter `{}`", pass.descriptor.name, declared.name);
    let ty = kinds(&declared.accepts).first().map_or("f32", |kind| kind.wgsl());
    let suggestion = if declared.fixed {
        format!("declare `override {}: {ty};`", declared.name)
    } else {
        format!("add `{}: {ty},` to the struct of `params`", declared.name)
    };
    Diagnostic::error(codes::PARAM, pass.file(), message).suggest(suggestion)
}

/// The types in WGSL that a parameter may have, the usual one first.
fn kinds(accepts: &ParamType) -> Vec<ParamKind> {
    match accepts {
        ParamType::Bool => vec![ParamKind::Uint, ParamKind::Bool],
        ParamType::Integer { .. } => vec![ParamKind::Int, ParamKind::Uint],
        ParamType::Float { .. } => vec![ParamKind::Float],
        ParamType::Vector { length, .. } => vec![ParamKind::Vector(*length as u8)],
        ParamType::Choice { .. } => vec![ParamKind::Uint],
        ParamType::File => Vec::new(),
    }
}

fn disagreement(declared: &ParamDescriptor, param: &Param) -> Option<Diagnostic> {
    let name = &param.name;
    let wrong = |message: String| Some(Diagnostic::error(codes::PARAM, param.place.clone(), message));
    let allowed = kinds(&declared.accepts);
    if !allowed.contains(&param.kind) {
        let names: Vec<String> = allowed.iter().map(|kind| format!("`{}`", kind.wgsl())).collect();
        let (want, found) = (names.join(" or "), param.kind.wgsl());
        return wrong(format!("the parameter `{name}` is declared as {want}, but is `{found}` in the shader"));
    }
    if declared.fixed != param.is_override() {
        return wrong(if declared.fixed {
            format!("the parameter `{name}` is declared as fixed, but is a member of `params`")
        } else {
            format!("`{name}` is an override, but the parameter is not declared as fixed")
        });
    }
    if let ParamSource::Override { default: Some(default) } = param.source
        && !same(declared, default)
    {
        return wrong(format!(
            "the default of `{name}` is {} in the pass, but {} here",
            declared.default,
            shown(default)
        ))
        .map(|problem| problem.suggest("leave it out here: the pass always gives a value"));
    }
    None
}

fn same(declared: &ParamDescriptor, default: ParamDefault) -> bool {
    match (&declared.default, default) {
        (ParamValue::Bool(value), ParamDefault::Bool(other)) => *value == other,
        (ParamValue::Bool(value), ParamDefault::Integer(other)) => i64::from(*value) == other,
        (ParamValue::Integer(value), ParamDefault::Integer(other)) => *value == other,
        (ParamValue::Float(value), ParamDefault::Float(other)) => (*value as f32).to_bits() == other.to_bits(),
        (ParamValue::Choice(word), ParamDefault::Integer(other)) => declared
            .accepts
            .choices()
            .iter()
            .position(|choice| choice == word)
            .is_some_and(|index| index as i64 == other),
        _ => false,
    }
}

fn shown(default: ParamDefault) -> String {
    match default {
        ParamDefault::Bool(value) => value.to_string(),
        ParamDefault::Integer(value) => value.to_string(),
        ParamDefault::Float(value) => format!("{value:?}"),
    }
}
