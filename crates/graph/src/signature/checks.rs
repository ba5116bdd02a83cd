//! Names and defaults of a descriptor.

use tyndall_document::is_name;

use super::DescriptorError;
use crate::descriptor::{PRESET, ParamDescriptor, ParamType, PassDescriptor};

/// Checks that every name is valid and that none appears twice.
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
        let why = || "appears twice".to_owned();
        errors.extend(twice.then(|| DescriptorError::BadPreset { preset: preset.name.clone(), why: why() }));
    }
    for (index, param) in descriptor.params.entries() {
        errors.extend((!is_name(&param.name)).then(|| DescriptorError::BadName(param.name.clone())));
        let twice = descriptor.param_named(&param.name) != Some(index);
        errors.extend(twice.then(|| DescriptorError::DuplicateParam(param.name.clone())));
    }
}

/// What the parameter accepts can be, and its default is such a value.
pub(super) fn check_default(param: &ParamDescriptor, errors: &mut Vec<DescriptorError>) {
    let bad = |why: String| DescriptorError::BadDefault { param: param.name.clone(), why };
    match &param.accepts {
        ParamType::Choice { words } if words.is_empty() => errors.push(DescriptorError::NoChoices(param.name.clone())),
        ParamType::Vector { length, .. } if !(2..=4).contains(length) => {
            errors.push(bad(format!("must be 2 to 4 numbers, got {length}")));
        }
        _ => errors.extend(param.check(&param.default).err().map(|refusal| bad(refusal.to_string()))),
    }
}

/// Each preset is one that the parameter [`PRESET`] can choose, and gives values that its parameters accept.
pub(super) fn check_presets(descriptor: &PassDescriptor, errors: &mut Vec<DescriptorError>) {
    let choices = descriptor.param(PRESET).map(|param| param.accepts.choices()).unwrap_or_default();
    for preset in &descriptor.presets {
        let mut wrong = |why: String| errors.push(DescriptorError::BadPreset { preset: preset.name.clone(), why });
        if !choices.contains(&preset.name) {
            wrong(format!("is not one of the choices of the parameter `{PRESET}`"));
        }
        for (name, value) in &preset.values {
            match descriptor.param(name) {
                None => wrong(format!("gives `{name}`, which is not a parameter of the pass")),
                Some(_) if name == PRESET => wrong("chooses a preset".to_owned()),
                Some(param) => {
                    let refusal = param.check(value).err();
                    refusal.into_iter().for_each(|refusal| wrong(format!("gives `{name}`, which {refusal}")));
                }
            }
        }
    }
}
