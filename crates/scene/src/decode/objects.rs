//! `objects: [(mesh, scale, rotation, translation, material, casts_shadow)]`.

use glam::{DQuat, DVec3};
use tyndall_document::{Decoder, Diagnostic, Fields, Node, OUT_OF_RANGE, Span, Value};

use super::values::{Range, animated, direction, number, numbers, vector};
use super::{given, parts_of};
use crate::animate::Animated;
use crate::codes::BRIGHTER_THAN_WHITE;
use crate::model::Material;
use crate::primitives::Primitive;

/// What a scene file says of an object.
#[derive(Debug)]
pub(crate) struct ObjectDraft {
    pub mesh: MeshDraft,
    pub translation: Animated,
    pub rotation: DQuat,
    pub scale: f64,
    pub material: Option<Material>,
    pub casts_shadow: bool,
}

/// What a scene file says of a mesh.
#[derive(Debug)]
pub(crate) enum MeshDraft {
    /// A mesh of our own making.
    Primitive(Primitive),
    /// A path as written, and where.
    File(String, Span),
}

/// All objects; those with mistakes are left out, their mistakes reported.
pub(super) fn objects(decoder: &mut Decoder, node: &Node) -> Option<Vec<ObjectDraft>> {
    let items = decoder.list(node)?;
    Some(items.iter().filter_map(|item| object(decoder, item)).collect())
}

fn object(decoder: &mut Decoder, node: &Node) -> Option<ObjectDraft> {
    let known = ["mesh", "translation", "rotation", "scale", "material", "casts_shadow"];
    let fields = decoder.fields(node, "an object", &known)?;
    let mesh = fields.required(decoder, "mesh").and_then(|n| mesh(decoder, n));
    let translation =
        given(fields.get("translation"), Animated::Constant(DVec3::ZERO), |n| animated(decoder, n, "translation"));
    let rotation = given(fields.get("rotation"), DQuat::IDENTITY, |n| rotation(decoder, n));
    let scale = given(fields.get("scale"), 1.0, |n| number(decoder, n, "scale", Range::Positive));
    let material = given(fields.get("material"), None, |n| material(decoder, n).map(Some));
    let casts_shadow = given(fields.get("casts_shadow"), true, |n| decoder.bool(n));
    Some(ObjectDraft {
        mesh: mesh?,
        translation: translation?,
        rotation: rotation?,
        scale: scale?,
        material: material?,
        casts_shadow: casts_shadow?,
    })
}

fn rotation(decoder: &mut Decoder, node: &Node) -> Option<DQuat> {
    let parts = parts_of(decoder, node, "a rotation", &["axis", "angle"])?;
    let axis = direction(decoder, parts[0], "axis");
    let angle = number(decoder, parts[1], "angle", Range::Any);
    Some(DQuat::from_axis_angle(axis?.normalize(), angle?.to_radians()))
}

fn material(decoder: &mut Decoder, node: &Node) -> Option<Material> {
    let fields = decoder.fields(node, "a material", &["diffuse", "specular", "shininess"])?;
    let default = Material::default();
    let mut color = |name, default| given(fields.get(name), default, |n| vector(decoder, n, name, Range::NotNegative));
    let diffuse = color("diffuse", default.diffuse);
    let specular = color("specular", default.specular);
    let shininess =
        given(fields.get("shininess"), default.shininess, |n| number(decoder, n, "shininess", Range::NotNegative));
    if let (Some(diffuse), Some(node)) = (diffuse, fields.get("diffuse"))
        && diffuse.max_element() > 1.0
    {
        let message = format!("`diffuse` {diffuse} reflects more light than it receives");
        decoder.report(Diagnostic::warning(BRIGHTER_THAN_WHITE, decoder.place(node.span), message));
    }
    Some(Material { diffuse: diffuse?, specular: specular?, shininess: shininess?, texture: None })
}

fn mesh(decoder: &mut Decoder, node: &Node) -> Option<MeshDraft> {
    let (kind, content) = decoder.variant(node, "a mesh", &["Sphere", "Box", "Torus", "Plane", "File"])?;
    let empty = Node { span: node.span, value: Value::Unit };
    let content = content.unwrap_or(&empty);
    if kind == "File" {
        return match &content.value {
            Value::Tuple(items) if items.len() == 1 => {
                decoder.text(&items[0]).map(|text| MeshDraft::File(text.to_owned(), items[0].span))
            }
            _ => {
                decoder.wrong_type(content, "a path: `File(\"model.glb\")`");
                None
            }
        };
    }
    let names: &[&str] = match kind {
        "Sphere" => &["radius"],
        "Torus" => &["major", "minor"],
        _ => &["size"],
    };
    let fields = decoder.fields(content, &format!("a {kind}"), names)?;
    primitive(decoder, kind, &fields).map(MeshDraft::Primitive)
}

fn primitive(decoder: &mut Decoder, kind: &str, fields: &Fields) -> Option<Primitive> {
    let mut measure = |name| {
        let node = fields.required(decoder, name)?;
        number(decoder, node, name, Range::Positive)
    };
    match kind {
        "Sphere" => Some(Primitive::Sphere { radius: measure("radius")? }),
        "Torus" => {
            let (major, minor) = (measure("major"), measure("minor"));
            let (major, minor) = (major?, minor?);
            if minor < major {
                return Some(Primitive::Torus { major, minor });
            }
            let node = fields.get("minor")?;
            let message = format!("`minor` is {minor}; it must be below `major`, {major}, or the tube meets itself");
            decoder.report(Diagnostic::error(OUT_OF_RANGE, decoder.place(node.span), message));
            None
        }
        _ => {
            let node = fields.required(decoder, "size")?;
            if kind == "Box" {
                numbers::<3>(decoder, node, "size", Range::Positive).map(|size| Primitive::Box { size })
            } else {
                numbers::<2>(decoder, node, "size", Range::Positive).map(|size| Primitive::Plane { size })
            }
        }
    }
}
