//! Structs of scene data as a shader declares them, held against those that the program fills.

use tyndall_document::Diagnostic;
use tyndall_scene::Extensions;
use tyndall_scene::layout::{Header, Shape, Type};
use tyndall_shader::{Linked, Member, Resource, ResourceKind, members};

use crate::codes::SCENE_LAYOUT;

/// Reports every variable whose type is not laid out as the scene data of its name.
pub(crate) fn check(linked: &Linked, extensions: &Extensions) -> Vec<Diagnostic> {
    let mistake = |resource: &Resource| {
        let problem = disagreement(linked, resource, extensions.shape(&resource.name)?)?;
        let message = format!("`{}` is not laid out as the scene data of this name: {problem}", resource.name);
        Some(Diagnostic::error(SCENE_LAYOUT, resource.place.clone(), message))
    };
    linked.resources.iter().filter_map(mistake).collect()
}

fn disagreement(linked: &Linked, resource: &Resource, shape: Shape) -> Option<String> {
    match (shape, &resource.kind) {
        (Shape::Record(ty), ResourceKind::Uniform { type_name, size, .. })
        | (Shape::Record(ty), ResourceKind::StorageBuffer { type_name, element: None, stride: size, .. }) => {
            of_type(linked, ty, type_name, *size)
        }
        (Shape::Record(ty), _) => Some(format!("it is one `{}`", ty.name)),
        (Shape::List(ty), ResourceKind::StorageBuffer { element: Some(element), stride, header, .. })
            if *header == size_of::<Header>() as u32 =>
        {
            of_type(linked, ty, element, *stride)
        }
        (Shape::List(ty), _) => {
            Some(format!("it is a `count: u32`, padding to 16 bytes, and `items: array<{}>`", ty.name))
        }
        (Shape::Bytes, _) => None,
    }
}

/// How a type of a shader, of so many bytes, differs from ours.
fn of_type(linked: &Linked, ty: Type, name: &str, size: u32) -> Option<String> {
    let found = members(&linked.module, name);
    if ty.members.is_empty() || found.is_empty() {
        return (ty.name != name).then(|| format!("expected `{}`, found `{name}`", ty.name));
    }
    let expected = ty.members.iter().filter(|member| !member.name.starts_with("pad"));
    let expected: Vec<String> = expected.map(|m| format!("`{}: {}` at byte {}", m.name, m.ty, m.offset)).collect();
    let described = |m: &Member| format!("`{}: {}` at byte {}", m.name, m.ty, m.offset);
    let found: Vec<String> = found.iter().filter(|member| !member.name.starts_with("pad")).map(described).collect();
    let at = (0..expected.len().max(found.len())).find(|at| expected.get(*at) != found.get(*at));
    let or_end = |member: Option<&String>| member.cloned().unwrap_or_else(|| format!("the end of `{}`", ty.name));
    match at {
        Some(at) => Some(format!("expected {}, found {}", or_end(expected.get(at)), or_end(found.get(at)))),
        None => (ty.size != size as usize).then(|| format!("expected {} bytes, found {size}", ty.size)),
    }
}
