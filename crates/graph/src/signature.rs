//! A descriptor with its names resolved to indices, and the mistakes that a descriptor can make.

use std::fmt;

use crate::descriptor::{
    Axis, Class, Dimension, Disabled, Extent, Format, ParamDescriptor, ParamValue, PassDescriptor, PortDescriptor, PortKind,
    Role, SizeRule,
};
use crate::file::is_name;
use crate::plan::Usages;

/// What validation and planning read of a descriptor.
#[derive(Debug, Default)]
pub(crate) struct Signature {
    pub ports: Vec<PortSignature>,
    /// Ports in an order in which each one's size follows from those before it.
    pub size_order: Vec<u32>,
    /// Inputs that demand a size.
    pub demands: Vec<u32>,
    /// Parameters that set a size.
    pub size_params: Vec<u32>,
}

/// What validation and planning read of a port.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PortSignature {
    pub role: RoleKind,
    pub rule: Option<[Amount; 3]>,
    /// Of an output of any class: the input whose class (and format) it has.
    pub like: Option<u32>,
    /// Of an output: the input that flows on where the pass is switched off; `None`: a constant.
    pub through: Option<u32>,
    /// The value of a constant in the place of the port.
    pub constant: [f32; 4],
    /// How many extents mean something.
    pub axes: u32,
    /// How the pass uses what is bound there.
    pub usages: Usages,
}

/// [`Role`] without what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RoleKind {
    Input,
    Optional,
    History,
    Output,
    InOut,
}

impl RoleKind {
    pub fn is_input(self) -> bool {
        self != RoleKind::Output
    }

    pub fn is_output(self) -> bool {
        matches!(self, RoleKind::Output | RoleKind::InOut)
    }
}

/// [`Extent`] with indices.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Amount {
    Fixed(u32),
    Frame(usize, f64),
    Port(u32, usize, f64),
    Param(u32),
    FramePixels(f64),
}

/// The rule of a port that states none: the frame's size.
pub(crate) const FRAME: [Amount; 3] = [Amount::Frame(0, 1.0), Amount::Frame(1, 1.0), Amount::Fixed(1)];

/// What a descriptor gets wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs, reason = "the text that each displays says it")]
pub enum DescriptorError {
    DuplicatePass(String),
    BadName(String),
    DuplicatePort(String),
    DuplicateParam(String),
    UnknownSizePort { port: String, named: String },
    HistorySize { port: String, named: String },
    UnknownSizeParam { port: String, named: String },
    SizeParamNotInteger { port: String, named: String },
    BadScale { port: String },
    ZeroSize { port: String },
    SizeCycle { port: String },
    NoFormat { port: String },
    NoClass { port: String },
    UnknownThrough { port: String, named: String },
    ThroughHistory { port: String, named: String },
    ThroughOther { port: String, named: String },
    NoChoices(String),
    BadDefault { param: String, why: String },
}

impl fmt::Display for DescriptorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use DescriptorError as E;
        match self {
            E::DuplicatePass(name) => write!(f, "there is a pass named `{name}` already"),
            E::BadName(name) => write!(f, "`{name}` is not a name: lower-case letters, digits and `_`, a letter first"),
            E::DuplicatePort(name) => write!(f, "two ports are named `{name}`"),
            E::DuplicateParam(name) => write!(f, "two parameters are named `{name}`"),
            E::UnknownSizePort { port, named } => write!(f, "the size of `{port}` names `{named}`, which is no port"),
            E::HistorySize { port, named } => {
                write!(f, "the size of `{port}` names the history port `{named}`, whose size is known last")
            }
            E::UnknownSizeParam { port, named } => write!(f, "the size of `{port}` names `{named}`, which is no parameter"),
            E::SizeParamNotInteger { port, named } => {
                write!(f, "the size of `{port}` names the parameter `{named}`, which is not a whole number")
            }
            E::BadScale { port } => write!(f, "the size of `{port}` has a factor that is not above 0"),
            E::ZeroSize { port } => write!(f, "the size of `{port}` has an extent of 0"),
            E::SizeCycle { port } => write!(f, "the size of `{port}` follows from itself"),
            E::NoFormat { port } => write!(f, "the output `{port}` has no format"),
            E::NoClass { port } => write!(f, "the output `{port}` has any class, but its size names no texture input"),
            E::UnknownThrough { port, named } => {
                write!(f, "where the pass is off `{port}` gives `{named}`, which is no input")
            }
            E::ThroughHistory { port, named } => {
                write!(f, "where the pass is off `{port}` gives the history port `{named}`, which holds another frame")
            }
            E::ThroughOther { port, named } => {
                write!(f, "where the pass is off `{port}` gives `{named}`, which is of another kind")
            }
            E::NoChoices(param) => write!(f, "the parameter `{param}` has no words to choose from"),
            E::BadDefault { param, why } => write!(f, "the default of the parameter `{param}` {why}"),
        }
    }
}

impl std::error::Error for DescriptorError {}

impl Signature {
    /// Resolves the names of a descriptor.
    pub fn of(descriptor: &PassDescriptor) -> Result<Self, Vec<DescriptorError>> {
        let mut errors = Vec::new();
        check_names(descriptor, &mut errors);
        for param in &descriptor.params {
            check_default(param, &mut errors);
        }
        let ports: Vec<PortSignature> = descriptor.ports.iter().map(|port| resolve(descriptor, port, &mut errors)).collect();
        let size_order = size_order(descriptor, &ports, &mut errors);
        if !errors.is_empty() {
            return Err(errors);
        }
        let demanding = |port: &u32| ports[*port as usize].role.is_input() && ports[*port as usize].rule.is_some();
        let demands = (0..ports.len() as u32).filter(demanding).collect();
        let size_params = size_params(&ports);
        Ok(Self { ports, size_order, demands, size_params })
    }
}

fn check_names(descriptor: &PassDescriptor, errors: &mut Vec<DescriptorError>) {
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

fn check_default(param: &ParamDescriptor, errors: &mut Vec<DescriptorError>) {
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

fn resolve(descriptor: &PassDescriptor, port: &PortDescriptor, errors: &mut Vec<DescriptorError>) -> PortSignature {
    let (role, constant) = match &port.role {
        Role::Input => (RoleKind::Input, [0.0; 4]),
        Role::Optional(value) => (RoleKind::Optional, *value),
        Role::History(value) => (RoleKind::History, *value),
        Role::Output { disabled: Disabled::Constant(value) } => (RoleKind::Output, *value),
        Role::Output { disabled: Disabled::Input(_) } => (RoleKind::Output, [0.0; 4]),
        Role::InOut => (RoleKind::InOut, [0.0; 4]),
    };
    PortSignature {
        role,
        rule: port.size.as_ref().map(|rule| amounts(descriptor, port, rule, errors)),
        like: like(descriptor, port, errors),
        through: through(descriptor, port, errors),
        constant,
        axes: axes(&port.kind),
        usages: usages(role, &port.kind),
    }
}

fn amounts(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    rule: &SizeRule,
    errors: &mut Vec<DescriptorError>,
) -> [Amount; 3] {
    [&rule.width, &rule.height, &rule.depth].map(|extent| amount(descriptor, port, extent, errors))
}

fn amount(
    descriptor: &PassDescriptor,
    port: &PortDescriptor,
    extent: &Extent,
    errors: &mut Vec<DescriptorError>,
) -> Amount {
    let name = || port.name.clone();
    let mut scale_of = |scale: f64| {
        errors.extend((!(scale > 0.0 && scale.is_finite())).then(|| DescriptorError::BadScale { port: name() }));
        scale
    };
    match extent {
        Extent::Fixed(0) => {
            errors.push(DescriptorError::ZeroSize { port: name() });
            Amount::Fixed(1)
        }
        Extent::Fixed(texels) => Amount::Fixed(*texels),
        Extent::Frame { axis, scale } => Amount::Frame(index_of(*axis), scale_of(*scale)),
        Extent::FramePixels(scale) => Amount::FramePixels(scale_of(*scale)),
        Extent::Port { port: named, axis, scale } => {
            let scale = scale_of(*scale);
            match descriptor.ports.iter().position(|other| other.name == *named) {
                Some(other) if matches!(descriptor.ports[other].role, Role::History(_)) => {
                    errors.push(DescriptorError::HistorySize { port: name(), named: named.clone() });
                    Amount::Fixed(1)
                }
                Some(other) => Amount::Port(other as u32, index_of(*axis), scale),
                None => {
                    errors.push(DescriptorError::UnknownSizePort { port: name(), named: named.clone() });
                    Amount::Fixed(1)
                }
            }
        }
        Extent::Param(named) => match descriptor.params.iter().position(|param| param.name == *named) {
            Some(param) if matches!(descriptor.params[param].default, ParamValue::Integer(_)) => Amount::Param(param as u32),
            found => {
                let (port, named) = (name(), named.clone());
                errors.push(match found {
                    Some(_) => DescriptorError::SizeParamNotInteger { port, named },
                    None => DescriptorError::UnknownSizeParam { port, named },
                });
                Amount::Fixed(1)
            }
        },
    }
}

fn index_of(axis: Axis) -> usize {
    match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    }
}

/// The input that an output of any class is like: the first texture that its size names.
fn like(descriptor: &PassDescriptor, port: &PortDescriptor, errors: &mut Vec<DescriptorError>) -> Option<u32> {
    let PortKind::Texture { class, format, .. } = &port.kind else { return None };
    if !matches!(port.role, Role::Output { .. }) {
        return None;
    }
    if *class != Class::Any {
        errors.extend(format.is_none().then(|| DescriptorError::NoFormat { port: port.name.clone() }));
        return None;
    }
    let rule = port.size.as_ref();
    let extents = rule.iter().flat_map(|rule| [&rule.width, &rule.height, &rule.depth]);
    let named = extents.filter_map(|extent| match extent {
        Extent::Port { port, .. } => descriptor.ports.iter().position(|other| other.name == *port),
        _ => None,
    });
    let is_texture_input = |port: &usize| {
        let port = &descriptor.ports[*port];
        port.role.is_input() && matches!(port.kind, PortKind::Texture { .. })
    };
    let found = named.into_iter().find(is_texture_input).map(|port| port as u32);
    errors.extend(found.is_none().then(|| DescriptorError::NoClass { port: port.name.clone() }));
    found
}

/// The input that flows on where the pass is switched off.
fn through(descriptor: &PassDescriptor, port: &PortDescriptor, errors: &mut Vec<DescriptorError>) -> Option<u32> {
    let Role::Output { disabled: Disabled::Input(named) } = &port.role else { return None };
    let name = port.name.clone();
    let found = descriptor.ports.iter().position(|other| other.name == *named && other.role.is_input());
    let Some(index) = found else {
        errors.push(DescriptorError::UnknownThrough { port: name, named: named.clone() });
        return None;
    };
    let input = &descriptor.ports[index];
    if matches!(input.role, Role::History(_)) {
        errors.push(DescriptorError::ThroughHistory { port: name, named: named.clone() });
    } else if !may_stand_for(&input.kind, &port.kind) {
        errors.push(DescriptorError::ThroughOther { port: name, named: named.clone() });
    }
    Some(index as u32)
}

fn may_stand_for(input: &PortKind, output: &PortKind) -> bool {
    match (input, output) {
        (PortKind::Texture { dimension: a, class: class_a, .. }, PortKind::Texture { dimension: b, class: class_b, .. }) => {
            a == b && (class_a == class_b || *class_a == Class::Any || *class_b == Class::Any)
        }
        (PortKind::Buffer { element: a, .. }, PortKind::Buffer { element: b, .. }) => a == b,
        (PortKind::Value { element: a, .. }, PortKind::Value { element: b, .. }) => a == b,
        _ => false,
    }
}

fn axes(kind: &PortKind) -> u32 {
    match kind {
        PortKind::Texture { dimension: Dimension::D2, .. } => 2,
        PortKind::Texture { .. } => 3,
        PortKind::Buffer { .. } => 1,
        PortKind::Value { .. } => 0,
    }
}

fn usages(role: RoleKind, kind: &PortKind) -> Usages {
    match kind {
        PortKind::Texture { class, format, .. } if role.is_output() => {
            let drawn = *class == Class::RasterDepth || *format == Some(Format::Depth32Float);
            if drawn { Usages::ATTACHMENT } else { Usages::STORAGE }
        }
        PortKind::Texture { .. } => Usages::SAMPLED,
        PortKind::Value { .. } if !role.is_output() => Usages::UNIFORM,
        PortKind::Buffer { .. } | PortKind::Value { .. } => Usages::STORAGE,
    }
}

/// Orders ports so that each size follows from those before it. An input's size follows from nothing where it is fed;
/// only an optional one may have to be computed.
fn size_order(descriptor: &PassDescriptor, ports: &[PortSignature], errors: &mut Vec<DescriptorError>) -> Vec<u32> {
    let needs = |port: &PortSignature| -> Vec<u32> {
        let computed = matches!(port.role, RoleKind::Output | RoleKind::Optional);
        let rule = port.rule.filter(|_| computed);
        let named = |amount: Amount| if let Amount::Port(other, ..) = amount { Some(other) } else { None };
        rule.into_iter().flatten().filter_map(named).collect()
    };
    let mut order: Vec<u32> = Vec::with_capacity(ports.len());
    let mut left: Vec<u32> = (0..ports.len() as u32).filter(|port| ports[*port as usize].role != RoleKind::History).collect();
    while !left.is_empty() {
        let ready = |port: &u32| needs(&ports[*port as usize]).iter().all(|other| order.contains(other));
        let (now, later): (Vec<u32>, Vec<u32>) = left.iter().partition(|port| ready(port));
        if now.is_empty() {
            errors.extend(later.iter().map(|port| DescriptorError::SizeCycle { port: descriptor.ports[*port as usize].name.clone() }));
            break;
        }
        order.extend(now);
        left = later;
    }
    order
}

fn size_params(ports: &[PortSignature]) -> Vec<u32> {
    let amounts = ports.iter().filter_map(|port| port.rule).flatten();
    let mut params: Vec<u32> =
        amounts.filter_map(|amount| if let Amount::Param(param) = amount { Some(param) } else { None }).collect();
    params.sort_unstable();
    params.dedup();
    params
}
