//! Types as WGSL names and lays them out.

use naga::common::DiagnosticDisplay;
use naga::{Handle, Module, Type, TypeInner};

/// A member of a struct.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// Bytes; of an array without a length: those of one element.
    pub size: u32,
    /// WGSL's name of its type.
    pub ty: String,
}

/// The members of the struct type of this name, in order; empty where the module has none. With it a test can
/// compare a `#[repr(C)]` struct with WGSL's offsets.
///
/// [`crate::link`] removes what no entry point uses, but removes nothing from a root that has no entry point, such as
/// one that only imports the module in question.
pub fn members(module: &Module, type_name: &str) -> Vec<Member> {
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(type_name));
    found.map(|(handle, _)| members_of(module, handle)).unwrap_or_default()
}

/// The members of a type; empty unless it is a struct.
pub fn members_of(module: &Module, ty: Handle<Type>) -> Vec<Member> {
    let TypeInner::Struct { members, .. } = &module.types[ty].inner else { return Vec::new() };
    let member = |member: &naga::StructMember| Member {
        name: member.name.clone().unwrap_or_default(),
        offset: member.offset,
        size: size(module, member.ty),
        ty: type_name(module, member.ty),
    };
    members.iter().map(member).collect()
}

/// Bytes of a value; of an array without a length: those of one element.
pub fn size(module: &Module, ty: Handle<Type>) -> u32 {
    module.types[ty].inner.try_size(module.to_ctx()).unwrap_or(0)
}

/// WGSL's name of a type. `atomic<T>` is named `T`: the data are the same.
pub fn type_name(module: &Module, ty: Handle<Type>) -> String {
    match module.types[ty].inner {
        TypeInner::Atomic(scalar) => DiagnosticDisplay(scalar).to_string(),
        _ => DiagnosticDisplay((ty, module.to_ctx())).to_string(),
    }
}

/// What a buffer repeats.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeated {
    /// WGSL's name of the element's type.
    pub element: String,
    /// Bytes from one element to the next.
    pub stride: u32,
    /// Bytes before the first element.
    pub header: u32,
}

/// The elements of an array, or of the array without a length at the end of a struct.
pub fn repeated(module: &Module, ty: Handle<Type>) -> Option<Repeated> {
    match &module.types[ty].inner {
        TypeInner::Array { base, stride, .. } => {
            Some(Repeated { element: type_name(module, *base), stride: *stride, header: 0 })
        }
        TypeInner::Struct { members, .. } => {
            let last = members.last()?;
            match module.types[last.ty].inner {
                TypeInner::Array { base, stride, size: naga::ArraySize::Dynamic } => {
                    Some(Repeated { element: type_name(module, base), stride, header: last.offset })
                }
                _ => None,
            }
        }
        _ => None,
    }
}
