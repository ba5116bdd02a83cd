//! Names and defaults of a descriptor.

use tyndall_document::is_name;

use super::DescriptorError;
use crate::descriptor::{PRESET, ParamDescriptor, ParamValue, PassDescriptor};

/// Every name is one, and none stands twice.
pub(super) fn check_names(descriptor: &PassDescriptor, errors: &mut Vec<DescriptorError>) {
    let bad = !descriptor.name.split('.').all(is_name);
    errors.extend(bad.then(|| DescriptorError::BadName(descriptor.name.clone())));
    for (index, port) in descriptor.ports.entries() {
        errors.extend((!is_name(&port.name)).then(|| DescriptorError::BadName(port.name.clone())));
        let twice = descriptor.port_named(&port.name) != Some(index);
        errors.extend(twice.then(|| DescriptorError::DuplicatePort(port.name.clone())));
    }
    for (index, preset) in descriptor.presets.iter().enumerate() {
        errors.extend((!is_name(&preset.name)).then(|| DescriptorError::BadName(preset.name.clone())));
        let twice = descriptor.presets[..index].iter().any(|other| other.name == preset.name);
        let why = || "stands twice".to_owned();
        errors.extend(twice.then(|| DescriptorError::BadPreset { preset: preset.name.clone(), why: why() }));
    }
    for (index, param) in descriptor.params.entries() {
        errors.extend((!is_name(&param.name)).then(|| DescriptorError::BadName(param.name.clone())));
        let twice = descriptor.param_named(&param.name) != Some(index);
        errors.extend(twice.then(|| DescriptorError::DuplicateParam(param.name.clone())));
    }
}

/// The default is one of the parameter's values.
pub(super) fn check_default(param: &ParamDescriptor, errors: &mut Vec<DescriptorError>) {
    if matches!(param.default, ParamValue::Choice(_)) && param.choices.is_empty() {
        errors.push(DescriptorError::NoChoices(param.name.clone()));
        return;
    }
    let whys = faults(param, &param.default).into_iter();
    errors.extend(whys.map(|why| DescriptorError::BadDefault { param: param.name.clone(), why }));
}

/// Each preset is one that the parameter [`PRESET`] can choose, and gives values that its parameters may have.
pub(super) fn check_presets(descriptor: &PassDescriptor, errors: &mut Vec<DescriptorError>) {
    let param_named = |name: &str| descriptor.param_named(name).map(|param| &descriptor.params[param]);
    let choices = param_named(PRESET).map(|param| param.choices.as_slice()).unwrap_or_default();
    for preset in &descriptor.presets {
        let mut wrong = |why: String| errors.push(DescriptorError::BadPreset { preset: preset.name.clone(), why });
        if !choices.contains(&preset.name) {
            wrong(format!("is none that the parameter `{PRESET}` can choose"));
        }
        for (name, value) in &preset.values {
            match param_named(name) {
                None => wrong(format!("gives `{name}`, which is no parameter")),
                Some(_) if name == PRESET => wrong("chooses a preset".to_owned()),
                Some(param) if std::mem::discriminant(value) != std::mem::discriminant(&param.default) => {
                    wrong(format!("gives `{name}` a value of another type"));
                }
                Some(param) => {
                    faults(param, value).into_iter().for_each(|why| wrong(format!("gives `{name}`, which {why}")))
                }
            }
        }
    }
}

/// Why a value of the right type is none that the parameter may have.
fn faults(param: &ParamDescriptor, value: &ParamValue) -> Vec<String> {
    let numbers = match value {
        ParamValue::Integer(value) => vec![*value as f64],
        ParamValue::Float(value) => vec![*value],
        ParamValue::Vector(values) => values.clone(),
        ParamValue::Bool(_) | ParamValue::File(_) | ParamValue::Choice(_) => Vec::new(),
    };
    let mut faults = Vec::new();
    if let (ParamValue::Vector(values), ParamValue::Vector(default)) = (value, &param.default) {
        if !(2..=4).contains(&values.len()) {
            faults.push("is a vector of other than 2 to 4 numbers".to_owned());
        } else if values.len() != default.len() {
            faults.push(format!("is a vector of other than {} numbers", default.len()));
        }
    }
    let (low, high) = param.range.unwrap_or((f64::MIN, f64::MAX));
    let outside = numbers.iter().filter(|number| !(**number >= low && **number <= high));
    faults.extend(outside.map(|number| format!("is {number}, outside its range")));
    if let ParamValue::Choice(word) = value
        && !param.choices.contains(word)
    {
        faults.push(format!("is `{word}`, which is not one of its words"));
    }
    faults
}
