//! A descriptor with its names resolved to indices.

mod checks;
mod errors;
mod resolve;

use crate::descriptor::PassDescriptor;
use crate::plan::Usages;
pub use errors::DescriptorError;

use checks::{check_default, check_names, check_presets};
use resolve::resolve;

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
    pub rule: Option<Rule>,
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
    Picture(u32, usize),
    FramePixels(f64),
}

/// [`SizeRule`] with indices; the two that nearly all ports have are apart.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rule {
    /// The frame's size. Also that of a port that states none.
    Frame,
    /// The size of another port.
    Same(u32),
    /// Three amounts.
    Other([Amount; 3]),
}

impl Rule {
    fn amounts(self) -> [Amount; 3] {
        match self {
            Rule::Frame => [Amount::Frame(0, 1.0), Amount::Frame(1, 1.0), Amount::Fixed(1)],
            Rule::Same(port) => [0, 1, 2].map(|axis| Amount::Port(port, axis, 1.0)),
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
        let ports: Vec<PortSignature> =
            descriptor.ports.iter().map(|port| resolve(descriptor, port, &mut errors)).collect();
        let size_order = size_order(descriptor, &ports, &mut errors);
        if !errors.is_empty() {
            return Err(once(errors));
        }
        let demanding = |port: &u32| ports[*port as usize].role.is_input() && ports[*port as usize].rule.is_some();
        let demands = (0..ports.len() as u32).filter(demanding).collect();
        let size_params = size_params(&ports);
        Ok(Self { ports, size_order, demands, size_params })
    }
}

/// Each error where it stands first: a rule with three extents can be wrong three times.
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
fn size_order(descriptor: &PassDescriptor, ports: &[PortSignature], errors: &mut Vec<DescriptorError>) -> Vec<u32> {
    let needs = |port: &PortSignature| -> Vec<u32> {
        let computed = matches!(port.role, RoleKind::Output | RoleKind::Optional);
        let rule = port.rule.filter(|_| computed);
        let named = |amount: Amount| if let Amount::Port(other, ..) = amount { Some(other) } else { None };
        rule.into_iter().flat_map(Rule::amounts).filter_map(named).collect()
    };
    let mut order: Vec<u32> = Vec::with_capacity(ports.len());
    let mut left: Vec<u32> =
        (0..ports.len() as u32).filter(|port| ports[*port as usize].role != RoleKind::History).collect();
    while !left.is_empty() {
        let ready = |port: &u32| needs(&ports[*port as usize]).iter().all(|other| order.contains(other));
        let (now, later): (Vec<u32>, Vec<u32>) = left.iter().partition(|port| ready(port));
        if now.is_empty() {
            errors.extend(
                later
                    .iter()
                    .map(|port| DescriptorError::SizeCycle { port: descriptor.ports[*port as usize].name.clone() }),
            );
            break;
        }
        order.extend(now);
        left = later;
    }
    order
}

fn size_params(ports: &[PortSignature]) -> Vec<u32> {
    let amounts = ports.iter().filter_map(|port| port.rule).flat_map(Rule::amounts);
    let params = amounts.filter_map(|amount| match amount {
        Amount::Param(param) | Amount::Picture(param, _) => Some(param),
        _ => None,
    });
    let mut params: Vec<u32> = params.collect();
    params.sort_unstable();
    params.dedup();
    params
}
