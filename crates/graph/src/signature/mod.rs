//! A descriptor with its names resolved to handles.

mod checks;
mod errors;
mod resolve;

use crate::descriptor::{Axis, ParamDescriptor, PassDescriptor, PortDescriptor};
use crate::handle::{Handle, Table};
pub use errors::DescriptorError;

use checks::{check_default, check_names, check_presets};
use resolve::resolve;

/// What validation and planning read of a descriptor.
#[derive(Debug, Default)]
pub(crate) struct Signature {
    pub ports: Table<PortDescriptor, PortSignature>,
    /// Ports in an order in which each one's size follows from those before it.
    pub size_order: Vec<Handle<PortDescriptor>>,
    /// Inputs that demand a size.
    pub demands: Vec<Handle<PortDescriptor>>,
    /// Parameters that set a size.
    pub size_params: Vec<Handle<ParamDescriptor>>,
}

/// What validation and planning read of a port.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PortSignature {
    pub role: RoleKind,
    pub rule: Option<Rule>,
    /// Of an output of any class: the input whose class (and format) it has.
    pub like: Option<Handle<PortDescriptor>>,
    /// Of an output: the input that is passed on while the pass is disabled; `None` for a constant.
    pub through: Option<Handle<PortDescriptor>>,
    /// The value of a constant in the place of the port.
    pub constant: [f32; 4],
    /// How many extents apply.
    pub axes: usize,
}

/// [`Role`] without its data.
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

    /// Whether it is fed in the same frame.
    pub fn reads_this_frame(self) -> bool {
        matches!(self, RoleKind::Input | RoleKind::Optional | RoleKind::InOut)
    }
}

/// [`Extent`](crate::descriptor::Extent) with handles.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Amount {
    Fixed(u32),
    Frame(Axis, f64),
    Port(Handle<PortDescriptor>, Axis, f64),
    Param(Handle<ParamDescriptor>),
    Picture(Handle<ParamDescriptor>, Axis),
    FramePixels(f64),
}

/// [`SizeRule`](crate::descriptor::SizeRule) with handles; the two most common rules have variants of their own.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// The frame's size, also for a port that states none.
    Frame,
    /// The size of another port.
    Same(Handle<PortDescriptor>),
    /// Three amounts.
    Other([Amount; 3]),
}

impl Rule {
    fn amounts(self) -> [Amount; 3] {
        match self {
            Rule::Frame => [Amount::Frame(Axis::X, 1.0), Amount::Frame(Axis::Y, 1.0), Amount::Fixed(1)],
            Rule::Same(port) => [Axis::X, Axis::Y, Axis::Z].map(|axis| Amount::Port(port, axis, 1.0)),
            Rule::Other(amounts) => amounts,
        }
    }
}

impl Signature {
    /// Resolves the names of a descriptor.
    pub fn of(descriptor: &PassDescriptor) -> Result<Self, Vec<DescriptorError>> {
        let mut errors = Vec::new();
        check_names(descriptor, &mut errors);
        for param in &descriptor.params {
            check_default(param, &mut errors);
        }
        check_presets(descriptor, &mut errors);
        let ports: Table<PortDescriptor, PortSignature> =
            descriptor.ports.iter().map(|port| resolve(descriptor, port, &mut errors)).collect();
        let size_order = size_order(descriptor, &ports, &mut errors);
        if !errors.is_empty() {
            return Err(once(errors));
        }
        let demands = ports.entries().filter(|(_, port)| port.role.is_input() && port.rule.is_some());
        let demands = demands.map(|(port, _)| port).collect();
        let size_params = size_params(&ports);
        Ok(Self { ports, size_order, demands, size_params })
    }
}

/// The first of equal errors: a rule with three extents can be wrong three times.
fn once(errors: Vec<DescriptorError>) -> Vec<DescriptorError> {
    let mut once: Vec<DescriptorError> = Vec::new();
    for error in errors {
        if !once.contains(&error) {
            once.push(error);
        }
    }
    once
}

/// Orders ports so that each size follows from those before it. An input's size follows from nothing where it is fed;
/// only an optional one may have to be computed.
fn size_order(
    descriptor: &PassDescriptor,
    ports: &Table<PortDescriptor, PortSignature>,
    errors: &mut Vec<DescriptorError>,
) -> Vec<Handle<PortDescriptor>> {
    let needs = |port: &PortSignature| -> Vec<Handle<PortDescriptor>> {
        let computed = matches!(port.role, RoleKind::Output | RoleKind::Optional);
        let rule = port.rule.filter(|_| computed);
        let named = |amount: Amount| if let Amount::Port(other, ..) = amount { Some(other) } else { None };
        rule.into_iter().flat_map(Rule::amounts).filter_map(named).collect()
    };
    let mut order: Vec<Handle<PortDescriptor>> = Vec::with_capacity(ports.len());
    let mut left: Vec<_> = ports.handles().filter(|port| ports[*port].role != RoleKind::History).collect();
    while !left.is_empty() {
        let ready = |port: Handle<PortDescriptor>| needs(&ports[port]).iter().all(|other| order.contains(other));
        let (now, later): (Vec<_>, Vec<_>) = left.iter().partition(|port| ready(**port));
        if now.is_empty() {
            let name = |port: Handle<PortDescriptor>| descriptor.ports[port].name.clone();
            errors.extend(later.into_iter().map(|port| DescriptorError::SizeCycle { port: name(port) }));
            break;
        }
        order.extend(now);
        left = later;
    }
    order
}

fn size_params(ports: &Table<PortDescriptor, PortSignature>) -> Vec<Handle<ParamDescriptor>> {
    let amounts = ports.iter().filter_map(|port| port.rule).flat_map(Rule::amounts);
    let params = amounts.filter_map(|amount| match amount {
        Amount::Param(param) | Amount::Picture(param, _) => Some(param),
        _ => None,
    });
    let mut params: Vec<_> = params.collect();
    params.sort_unstable();
    params.dedup();
    params
}
