//! From reflection to what a port declares: the parts of a descriptor that WGSL knows.

use naga::{ImageDimension, StorageAccess};
use tyndall_document::{Diagnostic, Place};
use tyndall_graph::descriptor::{Class, Dimension, Format, PortKind};

use crate::codes;
use crate::link::Linked;
use crate::reflect::{Resource, ResourceKind, SampleClass};

/// What a shader says about a port.
#[derive(Debug, Clone, PartialEq)]
pub struct ReflectedPort {
    /// Its name.
    pub name: String,
    /// Whether the shader can write to it: an output, or read and written in place.
    pub writable: bool,
    /// Whether the shader reads it. A storage buffer that is declared `read_write` but only written is not readable.
    pub readable: bool,
    /// What flows. The class is a guess, because WGSL does not know it: one channel is `Scalar`, unsigned integers,
    /// layers and 3D are `Data`, `rgba8unorm` is `Display`, depth is `RasterDepth`, all else `Color`.
    pub kind: PortKind,
    /// Where its variable is declared.
    pub place: Place,
}

/// The ports of these names that the shader has, in the order of the names.
///
/// # Errors
/// Every variable of these names that cannot be a port (a cube texture, a buffer with something before its array).
/// A name that the shader does not have is left out.
pub fn reflect_ports(linked: &Linked, names: &[&str]) -> Result<Vec<ReflectedPort>, Vec<Diagnostic>> {
    let (mut ports, mut problems) = (Vec::new(), Vec::new());
    for resource in names.iter().filter_map(|name| linked.resource(name)) {
        match derive_port(resource) {
            Ok(port) => ports.push(port),
            Err(problem) => problems.push(*problem),
        }
    }
    if problems.is_empty() { Ok(ports) } else { Err(problems) }
}

/// What a shader says about the port that this variable is.
///
/// # Errors
/// The variable is of a kind that cannot be a port.
pub fn derive_port(resource: &Resource) -> Result<ReflectedPort, Box<Diagnostic>> {
    let wrong = |message: String| Diagnostic::error(codes::PORT, resource.place.clone(), message);
    let name = &resource.name;
    let (kind, writable, readable) = match &resource.kind {
        ResourceKind::Texture { dimension: dim, arrayed, class, filtered } => {
            let dimension = dimension(*dim, *arrayed)
                .ok_or_else(|| wrong(format!("`{name}` is {}, which a port cannot be", shape(*dim, *arrayed))))?;
            let class = sampled_class(dimension, *class);
            (PortKind::Texture { dimension, class, format: None, filtered: *filtered }, false, true)
        }
        ResourceKind::StorageTexture { dimension: dim, arrayed, format, access } => {
            let dimension = dimension(*dim, *arrayed)
                .ok_or_else(|| wrong(format!("`{name}` is {}, which a port cannot be", shape(*dim, *arrayed))))?;
            let class = stored_class(dimension, *format);
            let kind = PortKind::Texture { dimension, class, format: Some(*format), filtered: false };
            (kind, access.contains(StorageAccess::STORE), access.contains(StorageAccess::LOAD))
        }
        ResourceKind::Uniform { type_name, size, .. } => {
            (PortKind::Value { element: type_name.clone(), bytes: *size }, false, true)
        }
        ResourceKind::StorageBuffer { header: 1.., type_name, .. } => {
            let problem = wrong(format!("the buffer `{name}` must be an array, but is `{type_name}`"));
            return Err(Box::new(
                problem.suggest("a port is an `array<T>`; make what precedes the array a port of its own"),
            ));
        }
        ResourceKind::StorageBuffer { type_name, read_only, element, stride, .. } => {
            let kind = match element {
                Some(element) => PortKind::Buffer { element: element.clone(), stride: *stride },
                None => PortKind::Value { element: type_name.clone(), bytes: *stride },
            };
            (kind, !read_only, *read_only || resource.read)
        }
        ResourceKind::Sampler { .. } => return Err(Box::new(wrong(format!("`{name}` is a sampler, not a port")))),
    };
    Ok(ReflectedPort { name: name.clone(), writable, readable, kind, place: resource.place.clone() })
}

/// The dimension of a port; `None` where a port cannot have it.
pub fn dimension(dimension: ImageDimension, arrayed: bool) -> Option<Dimension> {
    match (dimension, arrayed) {
        (ImageDimension::D2, false) => Some(Dimension::D2),
        (ImageDimension::D2, true) => Some(Dimension::D2Array),
        (ImageDimension::D3, false) => Some(Dimension::D3),
        _ => None,
    }
}

/// A dimension, in words.
pub fn shape(dimension: ImageDimension, arrayed: bool) -> String {
    let name = match dimension {
        ImageDimension::D1 => "a 1D texture",
        ImageDimension::D2 => "a 2D texture",
        ImageDimension::D3 => "a 3D texture",
        ImageDimension::Cube => "a cube texture",
    };
    if arrayed { format!("{name} with layers") } else { name.to_owned() }
}

fn sampled_class(dimension: Dimension, class: SampleClass) -> Class {
    match class {
        SampleClass::Depth => Class::RasterDepth,
        SampleClass::Float if dimension == Dimension::D2 => Class::Color,
        _ => Class::Data,
    }
}

fn stored_class(dimension: Dimension, format: Format) -> Class {
    match format {
        _ if dimension != Dimension::D2 => Class::Data,
        Format::R32Float | Format::R16Float => Class::Scalar,
        Format::Rgba32Float | Format::Rgba16Float => Class::Color,
        Format::Rgba8Unorm => Class::Display,
        Format::Depth32Float => Class::RasterDepth,
        _ => Class::Data,
    }
}
