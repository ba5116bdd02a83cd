//! What a linked module binds, and its entry points.

use naga::common::wgsl::ToWgsl as _;
use naga::valid::{GlobalUse, ModuleInfo, ShaderStages};
use naga::{
    AddressSpace, Binding, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ScalarKind, StorageAccess,
    StorageFormat, TypeInner,
};
use tyndall_document::{Diagnostic, Place};
use tyndall_graph::descriptor::Format;

use crate::codes;
use crate::map::Map;
use crate::naming;
use crate::types::{Member, members_of, repeated, size, type_name};

/// A variable that must be bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Resource {
    /// Name of the variable.
    pub name: String,
    /// Always 0 for now.
    pub group: u32,
    /// Its number in the group; the resources are numbered without gaps.
    pub binding: u32,
    /// What is bound.
    pub kind: ResourceKind,
    /// Stages that use it.
    pub stages: ShaderStages,
    /// Whether an entry point reads it.
    pub read: bool,
    /// Whether an entry point writes to it.
    pub written: bool,
    /// Where it is declared.
    pub place: Place,
}

/// What kind of thing a [`Resource`] is.
#[derive(Debug, Clone, PartialEq)]
pub enum ResourceKind {
    /// A texture that is only read.
    Texture {
        /// Its dimension.
        dimension: ImageDimension,
        /// Whether it has layers.
        arrayed: bool,
        /// What reading it gives.
        class: SampleClass,
        /// It is sampled with a filtering sampler, directly or in a function that is called: only then must its
        /// format be filterable, and its layout entry say so.
        filtered: bool,
    },
    /// A texture that is accessed texel by texel.
    StorageTexture {
        /// Its dimension.
        dimension: ImageDimension,
        /// Whether it has layers.
        arrayed: bool,
        /// Its format.
        format: Format,
        /// What the shader may do with it.
        access: StorageAccess,
    },
    /// A uniform buffer.
    Uniform {
        /// WGSL's name of its type.
        type_name: String,
        /// Bytes.
        size: u32,
        /// Members of its type; empty unless that is a struct.
        members: Vec<Member>,
    },
    /// A storage buffer.
    StorageBuffer {
        /// WGSL's name of its type.
        type_name: String,
        /// Whether the shader cannot write to it.
        read_only: bool,
        /// WGSL's name of the type of its elements: of the array that it is, or that ends it. `None` where it is a single
        /// value.
        element: Option<String>,
        /// Bytes from one element to the next; of one value: its bytes.
        stride: u32,
        /// Bytes before the first element.
        header: u32,
        /// Bytes that it must have at least: those with one element.
        size: u32,
    },
    /// A sampler.
    Sampler {
        /// Whether it compares.
        comparison: bool,
        /// Whether it filters (known from its name, see [`naming::SAMPLERS`]).
        filtering: bool,
    },
}

/// What reading a texture gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they say it all")]
pub enum SampleClass {
    Float,
    Uint,
    Sint,
    Depth,
}

/// A function that a pipeline starts.
#[derive(Debug, Clone, PartialEq)]
pub struct EntryPoint {
    /// Its name.
    pub name: String,
    /// Its stage.
    pub stage: naga::ShaderStage,
    /// Threads of a workgroup; zeros unless it is a compute shader.
    pub workgroup_size: [u32; 3],
    /// The resources that it uses, as indices into the list of them.
    pub resources: Vec<usize>,
    /// Of a fragment shader: what it writes, where that is a struct.
    pub targets: Vec<Target>,
}

/// A colour target that a fragment shader writes: a member of the struct that it returns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    /// Name of the member: that of a port.
    pub name: String,
    /// Its `@location`.
    pub location: u32,
    /// What kind of numbers.
    pub class: SampleClass,
}

/// A storage format of WGSL as a format of a port; `None` where a port cannot have it.
pub fn storage_format(format: StorageFormat) -> Option<Format> {
    Format::ALL.iter().copied().find(|known| known.wgsl() == format.to_wgsl())
}

/// A global variable that must be bound.
pub fn is_resource(variable: &GlobalVariable) -> bool {
    matches!(variable.space, AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Handle)
}

/// The resources of a module that is bound and valid, in the order of their numbers.
pub fn resources(module: &Module, info: &ModuleInfo, map: &Map, problems: &mut Vec<Diagnostic>) -> Vec<Resource> {
    let mut found = Vec::new();
    for (handle, variable) in module.global_variables.iter().filter(|(_, variable)| is_resource(variable)) {
        let span = module.global_variables.get_span(handle);
        let name = variable.name.clone().unwrap_or_default();
        let kind = match kind(module, info, handle) {
            Ok(kind) => kind,
            Err(message) => {
                let message = format!("`{name}` {message}");
                problems.push(Diagnostic::error(codes::VARIABLE, map.place_of_name(span, &name), message));
                continue;
            }
        };
        let uses = || {
            module
                .entry_points
                .iter()
                .enumerate()
                .map(|(index, entry)| (entry.stage, info.get_entry_point(index)[handle]))
        };
        let used_as = |what| uses().any(|(_, usage)| usage.intersects(what));
        let Some(binding) = variable.binding else { continue };
        found.push(Resource {
            place: map.place_of_name(span, &name),
            name,
            group: binding.group,
            binding: binding.binding,
            stages: uses().filter(|(_, usage)| !usage.is_empty()).map(|(stage, _)| stage_bit(stage)).collect(),
            read: used_as(GlobalUse::READ | GlobalUse::ATOMIC),
            written: used_as(GlobalUse::WRITE | GlobalUse::ATOMIC),
            kind,
        });
    }
    found.sort_by_key(|resource| resource.binding);
    found
}

fn stage_bit(stage: naga::ShaderStage) -> ShaderStages {
    match stage {
        naga::ShaderStage::Vertex => ShaderStages::VERTEX,
        naga::ShaderStage::Fragment => ShaderStages::FRAGMENT,
        naga::ShaderStage::Compute => ShaderStages::COMPUTE,
        // Not among our capabilities: naga has refused them.
        _ => ShaderStages::empty(),
    }
}

fn kind(module: &Module, info: &ModuleInfo, handle: Handle<GlobalVariable>) -> Result<ResourceKind, String> {
    let variable = &module.global_variables[handle];
    let type_name = type_name(module, variable.ty);
    let size = size(module, variable.ty);
    Ok(match (variable.space, &module.types[variable.ty].inner) {
        (AddressSpace::Uniform, _) => {
            ResourceKind::Uniform { type_name, size, members: members_of(module, variable.ty) }
        }
        (AddressSpace::Storage { access }, _) => {
            let repeated = repeated(module, variable.ty);
            ResourceKind::StorageBuffer {
                type_name,
                read_only: !access.contains(StorageAccess::STORE),
                stride: repeated.as_ref().map_or(size, |repeated| repeated.stride),
                header: repeated.as_ref().map_or(0, |repeated| repeated.header),
                element: repeated.map(|repeated| repeated.element),
                size,
            }
        }
        (_, TypeInner::Sampler { comparison }) => ResourceKind::Sampler {
            comparison: *comparison,
            filtering: variable.name.as_deref().and_then(naming::sampler).is_none_or(|sampler| sampler.filtering),
        },
        (_, TypeInner::Image { dim, arrayed, class }) => match image(*class) {
            Some(Image::Sampled(class)) => {
                let filtered = is_filtered(module, info, handle);
                ResourceKind::Texture { dimension: *dim, arrayed: *arrayed, class, filtered }
            }
            Some(Image::Storage(format, access)) => {
                ResourceKind::StorageTexture { dimension: *dim, arrayed: *arrayed, format, access }
            }
            None => return Err(format!("is of type `{type_name}`, which a port cannot have")),
        },
        _ => return Err(format!("is of type `{type_name}`, which a port cannot have")),
    })
}

enum Image {
    Sampled(SampleClass),
    Storage(Format, StorageAccess),
}

fn image(class: ImageClass) -> Option<Image> {
    match class {
        ImageClass::Sampled { kind, multi: false } => sample_class(kind).map(Image::Sampled),
        ImageClass::Depth { multi: false } => Some(Image::Sampled(SampleClass::Depth)),
        ImageClass::Storage { format, access } => storage_format(format).map(|format| Image::Storage(format, access)),
        _ => None,
    }
}

fn sample_class(kind: ScalarKind) -> Option<SampleClass> {
    match kind {
        ScalarKind::Float => Some(SampleClass::Float),
        ScalarKind::Uint => Some(SampleClass::Uint),
        ScalarKind::Sint => Some(SampleClass::Sint),
        _ => None,
    }
}

/// Whether an entry point samples this texture with a filtering sampler; naga follows both through calls.
fn is_filtered(module: &Module, info: &ModuleInfo, image: Handle<GlobalVariable>) -> bool {
    let filters = |sampler: Handle<GlobalVariable>| {
        let name = module.global_variables[sampler].name.as_deref();
        name.and_then(naming::sampler).is_none_or(|sampler| sampler.filtering)
    };
    (0..module.entry_points.len()).any(|index| {
        info.get_entry_point(index).sampling_set.iter().any(|key| key.image == image && filters(key.sampler))
    })
}

/// The entry points of a module, in order of declaration.
pub fn entry_points(module: &Module, info: &ModuleInfo, resources: &[Resource]) -> Vec<EntryPoint> {
    let entry_point = |(index, entry): (usize, &naga::EntryPoint)| {
        let uses = |resource: &Resource| {
            let found = module.global_variables.iter().find(|(_, v)| v.name.as_deref() == Some(&resource.name));
            found.is_some_and(|(handle, _)| !info.get_entry_point(index)[handle].is_empty())
        };
        EntryPoint {
            name: entry.name.clone(),
            stage: entry.stage,
            workgroup_size: entry.workgroup_size,
            resources: (0..resources.len()).filter(|index| uses(&resources[*index])).collect(),
            targets: targets(module, entry),
        }
    };
    module.entry_points.iter().enumerate().map(entry_point).collect()
}

fn targets(module: &Module, entry: &naga::EntryPoint) -> Vec<Target> {
    let Some(result) = entry.function.result.as_ref().filter(|_| entry.stage == naga::ShaderStage::Fragment) else {
        return Vec::new();
    };
    let TypeInner::Struct { members, .. } = &module.types[result.ty].inner else { return Vec::new() };
    let target = |member: &naga::StructMember| {
        let Some(Binding::Location { location, .. }) = member.binding else { return None };
        let class = sample_class(module.types[member.ty].inner.scalar_kind()?)?;
        Some(Target { name: member.name.clone()?, location, class })
    };
    members.iter().filter_map(target).collect()
}
