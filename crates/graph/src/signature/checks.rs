//! Names and defaults of a descriptor.

use super::DescriptorError;
use crate::descriptor::{ParamDescriptor, ParamValue, PassDescriptor};
use crate::file::is_name;

/// Every name is one, and none stands twice.
pub(super) fn check_names(descriptor: &PassDescriptor, errors: &mut Vec<DescriptorError>) {
    let bad = !descriptor.name.split('.').all(is_name);
    errors.extend(bad.then(|| DescriptorError::BadName(descriptor.name.clone())));
    for (index, port) in descriptor.ports.iter().enumerate() {
        errors.extend((!is_name(&port.name)).then(|| DescriptorError::BadName(port.name.clone())));
        let twice = descriptor.ports[..index].iter().any(|other| other.name == port.name);
        errors.extend(twice.then(|| DescriptorError::DuplicatePort(port.name.clone())));
    }
    for (index, param) in descriptor.params.iter().enumerate() {
        errors.extend((!is_name(&param.name)).then(|| DescriptorError::BadName(param.name.clone())));
        let twice = descriptor.params[..index].iter().any(|other| other.name == param.name);
        errors.extend(twice.then(|| DescriptorError::DuplicateParam(param.name.clone())));
    }
}

/// The default is one of the parameter's values.
pub(super) fn check_default(param: &ParamDescriptor, errors: &mut Vec<DescriptorError>) {
    let mut wrong = |why: String| errors.push(DescriptorError::BadDefault { param: param.name.clone(), why });
    let numbers = match &param.default {
        ParamValue::Integer(value) => vec![*value as f64],
        ParamValue::Float(value) => vec![*value],
        ParamValue::Vector(values) => values.clone(),
        ParamValue::Bool(_) | ParamValue::File(_) | ParamValue::Choice(_) => Vec::new(),
    };
    if matches!(&param.default, ParamValue::Vector(values) if !(2..=4).contains(&values.len())) {
        wrong("is a vector of other than 2 to 4 numbers".to_owned());
    }
    let (low, high) = param.range.unwrap_or((f64::MIN, f64::MAX));
    for number in numbers {
        if !(number >= low && number <= high) {
            wrong(format!("is {number}, outside its range"));
        }
    }
    if let ParamValue::Choice(word) = &param.default {
        if param.choices.is_empty() {
            errors.push(DescriptorError::NoChoices(param.name.clone()));
        } else if !param.choices.contains(word) {
            wrong(format!("is `{word}`, which is not one of its words"));
        }
    }
}
