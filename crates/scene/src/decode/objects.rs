//! `objects: [(mesh, scale, rotation, translation, material, casts_shadow)]`.

use glam::{DQuat, DVec3};
use tyndall_document::{Decoder, Diagnostic, Fields, Node, OUT_OF_RANGE, Span, Value};

use super::{Reader, or_default, parts_of, path, variant};
use crate::animate::Animated;
use crate::codes::{BRIGHTER_THAN_WHITE, NAMED_MATERIALS};
use crate::field::{Fields as PluginFields, Holder};
use crate::model::Material;
use crate::primitives::Primitive;
use crate::read::{LENGTH, Range, SceneReader, animated_place, direction, number, numbers, vector};

pub(super) const OBJECT_FIELDS: &[&str] =
    &["mesh", "translation", "rotation", "scale", "material", "materials", "casts_shadow"];
pub(super) const MATERIAL_FIELDS: &[&str] = &["diffuse", "specular", "shininess"];

/// What a scene file says of an object.
#[derive(Debug)]
pub(crate) struct ObjectDraft {
    pub span: Span,
    pub mesh: MeshDraft,
    pub translation: Animated,
    pub rotation: DQuat,
    pub scale: DVec3,
    pub material: Option<Material>,
    /// Those that replace materials of the file, each with the name that it has there.
    pub materials: Vec<NamedMaterial>,
    pub casts_shadow: bool,
    /// Those that plugins bring.
    pub fields: PluginFields,
}

/// A material of a file that is replaced.
#[derive(Debug)]
pub(crate) struct NamedMaterial {
    /// In the file.
    pub name: String,
    /// Of the name in the scene file.
    pub span: Span,
    pub material: Material,
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
pub(super) fn objects(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Vec<ObjectDraft>> {
    let items = decoder.list(node)?;
    Some(items.iter().filter_map(|item| object(decoder, item)).collect())
}

fn object(decoder: &mut SceneReader<'_>, node: &Node) -> Option<ObjectDraft> {
    let (fields, own) = decoder.fields_of(Holder::Object, node, "an object", OBJECT_FIELDS)?;
    let mesh = fields.required(decoder, "mesh").and_then(|n| mesh(decoder, n));
    let translation = or_default(fields.get("translation"), Animated::Constant(DVec3::ZERO), |n| {
        animated_place(decoder, n, "translation")
    });
    let rotation = or_default(fields.get("rotation"), DQuat::IDENTITY, |n| rotation(decoder, n));
    let scale = or_default(fields.get("scale"), DVec3::ONE, |n| scale(decoder, n));
    let material = or_default(fields.get("material"), None, |n| material(decoder, n).map(Some));
    let materials = or_default(fields.get("materials"), Vec::new(), |n| materials(decoder, n, &fields));
    let casts_shadow = or_default(fields.get("casts_shadow"), true, |n| decoder.bool(n));
    Some(ObjectDraft {
        span: node.span,
        mesh: mesh?,
        translation: translation?,
        rotation: rotation?,
        scale: scale?,
        material: material?,
        materials: materials?,
        casts_shadow: casts_shadow?,
        fields: own?,
    })
}

fn rotation(decoder: &mut Decoder, node: &Node) -> Option<DQuat> {
    let parts = parts_of(decoder, node, "a rotation", &["axis", "angle"])?;
    let axis = direction(decoder, parts[0], "axis");
    let angle = number(decoder, parts[1], "angle", Range::Any);
    Some(DQuat::from_axis_angle(axis?.normalize(), angle?.to_radians()))
}

/// One number above 0, or three that are not 0: below 0 they mirror.
fn scale(decoder: &mut Decoder, node: &Node) -> Option<DVec3> {
    match node.value {
        Value::Tuple(_) | Value::List(_) => vector(decoder, node, "scale", Range::NotZero),
        _ => number(decoder, node, "scale", Range::Positive).map(DVec3::splat),
    }
}

fn material(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Material> {
    let (fields, own) = decoder.fields_of(Holder::Material, node, "a material", MATERIAL_FIELDS)?;
    let default = Material::default();
    let mut color =
        |name, default| or_default(fields.get(name), default, |n| vector(decoder, n, name, Range::NotNegative));
    let diffuse = color("diffuse", default.diffuse);
    let specular = color("specular", default.specular);
    let shininess = or_default(fields.get("shininess"), default.shininess, |n| {
        number(decoder, n, "shininess", Range::NotAbove(1e6))
    });
    if let (Some(diffuse), Some(node)) = (diffuse, fields.get("diffuse"))
        && diffuse.max_element() > 1.0
    {
        let message = format!("`diffuse` {diffuse} reflects more light than it receives");
        let place = decoder.place(node.span);
        decoder.report(Diagnostic::warning(BRIGHTER_THAN_WHITE, place, message));
    }
    let (diffuse, specular, shininess, fields) = (diffuse?, specular?, shininess?, own?);
    Some(Material { diffuse, specular, shininess, fields, ..default })
}

/// `{ "Paint": (diffuse: …) }`, for an object of a file that has no `material` for all of it.
fn materials(decoder: &mut SceneReader<'_>, node: &Node, fields: &Fields) -> Option<Vec<NamedMaterial>> {
    let of_file =
        matches!(fields.get("mesh").map(|mesh| &mesh.value), Some(Value::Variant { name, .. }) if name == "File");
    let mistake = match fields.get("material") {
        Some(_) => Some(("`material` replaces every material already", "leave one of the two out")),
        None if !of_file => Some(("only a mesh of a file has materials with names", "write `material: (…)`")),
        None => None,
    };
    if let Some((message, hint)) = mistake {
        let place = decoder.place(node.span);
        decoder.report(Diagnostic::error(NAMED_MATERIALS, place, message).suggest(hint));
        return None;
    }
    let read = |decoder: &mut SceneReader<'_>, (name, span, node): (&str, Span, &Node)| {
        material(decoder, node).map(|material| NamedMaterial { name: name.to_owned(), span, material })
    };
    let items = decoder.map(node)?;
    let read: Vec<Option<NamedMaterial>> = items.into_iter().map(|item| read(decoder, item)).collect();
    read.into_iter().collect()
}

fn mesh(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let meshes: [(&str, Reader<MeshDraft>); 5] =
        [("Sphere", sphere), ("Box", cuboid), ("Torus", torus), ("Plane", plane), ("File", file)];
    variant(decoder, node, "a mesh", &meshes)
}

fn sphere(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let fields = decoder.fields(node, "a Sphere", &["radius"])?;
    let radius = measure(decoder, &fields, "radius")?;
    Some(MeshDraft::Primitive(Primitive::Sphere { radius }))
}

fn cuboid(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let size = size(decoder, node, "a Box")?;
    Some(MeshDraft::Primitive(Primitive::Box { size }))
}

fn torus(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let fields = decoder.fields(node, "a Torus", &["major", "minor"])?;
    let (major, minor) = (measure(decoder, &fields, "major"), measure(decoder, &fields, "minor"));
    let (major, minor) = (major?, minor?);
    if minor < major {
        return Some(MeshDraft::Primitive(Primitive::Torus { major, minor }));
    }
    let message = format!("`minor` is {minor}; it must be below `major`, {major}, or the tube meets itself");
    let place = decoder.place(fields.get("minor")?.span);
    decoder.report(Diagnostic::error(OUT_OF_RANGE, place, message));
    None
}

fn plane(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let size = size(decoder, node, "a Plane")?;
    Some(MeshDraft::Primitive(Primitive::Plane { size }))
}

fn file(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MeshDraft> {
    let (path, span) = path(decoder, node, "File(\"model.glb\")")?;
    Some(MeshDraft::File(path, span))
}

/// A length of a primitive.
fn measure(decoder: &mut Decoder, fields: &Fields, name: &str) -> Option<f64> {
    let node = fields.required(decoder, name)?;
    number(decoder, node, name, LENGTH)
}

/// The edge lengths of a primitive.
fn size<const N: usize>(decoder: &mut Decoder, node: &Node, what: &str) -> Option<[f64; N]> {
    let fields = decoder.fields(node, what, &["size"])?;
    let node = fields.required(decoder, "size")?;
    numbers(decoder, node, "size", LENGTH)
}
