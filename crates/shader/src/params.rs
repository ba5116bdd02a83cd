//! Parameters of a shader: members of the uniform `params`, and `override`s.

use naga::{Expression, Literal, Module, Scalar, ScalarKind, TypeInner};
use tyndall_document::{Diagnostic, Place};

use crate::codes;
use crate::map::Map;
use crate::naming::PARAMS;

/// Type of a parameter in WGSL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParamKind {
    /// `bool`; only of an `override`.
    Bool,
    /// `i32`.
    Int,
    /// `u32`: also a switch (0 or 1), or the index of a choice.
    Uint,
    /// `f32`.
    Float,
    /// `vec2<f32>` to `vec4<f32>`.
    Vector(u8),
}

impl ParamKind {
    /// WGSL's name of it.
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::Int => "i32",
            Self::Uint => "u32",
            Self::Float => "f32",
            Self::Vector(2) => "vec2<f32>",
            Self::Vector(3) => "vec3<f32>",
            Self::Vector(_) => "vec4<f32>",
        }
    }
}

/// How a parameter reaches the shader.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamSource {
    /// A member of the uniform `params`.
    Uniform {
        /// Bytes from its start.
        offset: u32,
    },
    /// A pipeline constant: wgpu takes it by the parameter's name, as a number (`bool`: 0 or 1).
    Override {
        /// Value where none is given.
        default: Option<ParamDefault>,
    },
}

/// Default of an `override`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamDefault {
    /// Of a `bool`.
    Bool(bool),
    /// Of an `i32` or `u32`.
    Integer(i64),
    /// Of an `f32`.
    Float(f32),
}

/// A parameter that a shader has.
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// Name of the member or `override`.
    pub name: String,
    /// Its type.
    pub kind: ParamKind,
    /// How its value gets there.
    pub source: ParamSource,
    /// Whether an entry point reads it. (An `override` that none reads is not among the parameters at all.)
    pub used: bool,
    /// Where it is declared.
    pub place: Place,
}

impl Param {
    /// Whether it is part of the pipeline.
    pub fn is_override(&self) -> bool {
        matches!(self.source, ParamSource::Override { .. })
    }
}

fn kind(inner: &TypeInner) -> Option<ParamKind> {
    match inner {
        TypeInner::Scalar(Scalar::BOOL) => Some(ParamKind::Bool),
        TypeInner::Scalar(Scalar::I32) => Some(ParamKind::Int),
        TypeInner::Scalar(Scalar::U32) => Some(ParamKind::Uint),
        TypeInner::Scalar(Scalar::F32) => Some(ParamKind::Float),
        TypeInner::Vector { size, scalar: Scalar { kind: ScalarKind::Float, width: 4 } } => {
            Some(ParamKind::Vector(*size as u8))
        }
        _ => None,
    }
}

/// The parameters of a module, members first, each in order of declaration.
///
/// `used` says of each member of `params` whether it is read.
pub fn params(module: &Module, map: &Map, used: &[bool], problems: &mut Vec<Diagnostic>) -> Vec<Param> {
    let mut found = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        if variable.name.as_deref() == Some(PARAMS) && variable.space == naga::AddressSpace::Uniform {
            members(module, map, (handle, variable), used, problems, &mut found);
        }
    }
    for (handle, constant) in module.overrides.iter() {
        overridden(module, map, (handle, constant), problems, &mut found);
    }
    found
}

fn members(
    module: &Module,
    map: &Map,
    (handle, variable): (naga::Handle<naga::GlobalVariable>, &naga::GlobalVariable),
    used: &[bool],
    problems: &mut Vec<Diagnostic>,
    found: &mut Vec<Param>,
) {
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
        let place = map.place_of_name(module.global_variables.get_span(handle), PARAMS);
        let message = format!("`{PARAMS}` must be a struct, whose members are the parameters");
        problems.push(Diagnostic::error(codes::PARAM, place, message));
        return;
    };
    for (index, member) in members.iter().enumerate() {
        let name = member.name.clone().unwrap_or_default();
        let place = map.place_of_name(module.types.get_span(variable.ty), &name);
        match kind(&module.types[member.ty].inner) {
            Some(kind) => found.push(Param {
                name,
                kind,
                source: ParamSource::Uniform { offset: member.offset },
                used: used.get(index).copied().unwrap_or(true),
                place,
            }),
            None => {
                let ty = crate::types::type_name(module, member.ty);
                problems.push(unsupported(&name, &ty, place));
            }
        }
    }
}

fn overridden(
    module: &Module,
    map: &Map,
    (handle, constant): (naga::Handle<naga::Override>, &naga::Override),
    problems: &mut Vec<Diagnostic>,
    found: &mut Vec<Param>,
) {
    let name = constant.name.clone().unwrap_or_default();
    let place = map.place_of_name(module.overrides.get_span(handle), &name);
    let default = match constant.init.map(|init| &module.global_expressions[init]) {
        None => None,
        Some(Expression::Literal(literal)) => default(*literal),
        Some(Expression::ZeroValue(_)) => Some(zero(&module.types[constant.ty].inner)),
        // Computed from other parameters: a constant of the shader's own.
        Some(_) => return,
    };
    match kind(&module.types[constant.ty].inner) {
        Some(kind) => {
            let source = ParamSource::Override { default };
            found.push(Param { name, kind, source, used: true, place });
        }
        None => problems.push(unsupported(&name, &crate::types::type_name(module, constant.ty), place)),
    }
}

fn default(literal: Literal) -> Option<ParamDefault> {
    match literal {
        Literal::Bool(value) => Some(ParamDefault::Bool(value)),
        Literal::I32(value) => Some(ParamDefault::Integer(value.into())),
        Literal::U32(value) => Some(ParamDefault::Integer(value.into())),
        Literal::F32(value) => Some(ParamDefault::Float(value)),
        _ => None,
    }
}

fn zero(inner: &TypeInner) -> ParamDefault {
    match kind(inner) {
        Some(ParamKind::Bool) => ParamDefault::Bool(false),
        Some(ParamKind::Int | ParamKind::Uint) => ParamDefault::Integer(0),
        _ => ParamDefault::Float(0.0),
    }
}

fn unsupported(name: &str, ty: &str, place: Place) -> Diagnostic {
    Diagnostic::error(codes::PARAM, place, format!("`{name}` is of type `{ty}`, which a parameter cannot have"))
        .suggest("parameters are f32, i32, u32, vec2<f32> to vec4<f32>, and as an override also bool")
}
