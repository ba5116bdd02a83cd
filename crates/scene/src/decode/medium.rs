//! `medium: (extinction, albedo, phase)`.

use glam::DVec3;
use tyndall_document::{Decoder, Node, Value};
use tyndall_shaders::scene::Phase;

use super::values::{Range, number, vector};
use super::{given, parts_of};
use crate::model::Medium;

pub(super) fn medium(decoder: &mut Decoder, node: &Node) -> Option<Medium> {
    let fields = decoder.fields(node, "a medium", &["extinction", "albedo", "phase"])?;
    let extinction =
        given(fields.get("extinction"), DVec3::ZERO, |n| vector(decoder, n, "extinction", Range::NotNegative));
    let albedo = given(fields.get("albedo"), DVec3::ONE, |n| vector(decoder, n, "albedo", Range::Unit));
    let phase = given(fields.get("phase"), Phase::Isotropic, |n| phase(decoder, n));
    Some(Medium { extinction: extinction?, albedo: albedo?, phase: phase? })
}

const PHASES: &[&str] =
    &["Isotropic", "HenyeyGreenstein", "DoubleHenyeyGreenstein", "Schlick", "Rayleigh", "CornetteShanks"];

fn phase(decoder: &mut Decoder, node: &Node) -> Option<Phase> {
    let (name, content) = decoder.variant(node, "a phase function", PHASES)?;
    let names: &[&str] = match name {
        "HenyeyGreenstein" | "CornetteShanks" => &["g"],
        "DoubleHenyeyGreenstein" => &["g1", "g2", "f"],
        "Schlick" => &["k"],
        _ => &[],
    };
    let empty = Node { span: node.span, value: Value::Unit };
    // The contract names a parameter by its letter alone: `HenyeyGreenstein(0.75)` is as clear as `(g: 0.75)`.
    let nodes: Vec<&Node> = match content.map(|c| &c.value) {
        Some(Value::Tuple(items)) if !items.is_empty() && items.len() == names.len() => items.iter().collect(),
        _ => parts_of(decoder, content.unwrap_or(&empty), name, names)?,
    };
    let mut values = Vec::new();
    for (name, node) in names.iter().zip(nodes) {
        let range = if *name == "f" { Range::Unit } else { Range::Between(-1.0, 1.0) };
        values.push(number(decoder, node, name, range));
    }
    let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
    Some(match (name, values.as_slice()) {
        ("HenyeyGreenstein", &[g]) => Phase::HenyeyGreenstein { g },
        ("CornetteShanks", &[g]) => Phase::CornetteShanks { g },
        ("DoubleHenyeyGreenstein", &[g1, g2, f]) => Phase::DoubleHenyeyGreenstein { g1, g2, f },
        ("Schlick", &[k]) => Phase::Schlick { k },
        ("Rayleigh", _) => Phase::Rayleigh,
        _ => Phase::Isotropic,
    })
}
