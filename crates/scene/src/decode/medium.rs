//! `medium: (extinction, albedo, phase, scale_height, base_height, ambient, emission)`.

use glam::DVec3;
use tyndall_document::{Decoder, Diagnostic, Fields, MISSING_FIELD, Node, Span, Value};
use tyndall_shaders::scene::{DROPLET_DIAMETERS, HeightFog, Phase};

use super::values::{Range, number, vector};
use super::{given, parts_of};
use crate::model::Medium;

/// What a scene file says of the medium.
#[derive(Debug)]
pub(crate) struct MediumDraft {
    /// Its phase function stands in wherever `phase_file` names another.
    pub medium: Medium,
    /// The file of a measured phase function: a path as written, and where.
    pub phase_file: Option<(String, Span)>,
    pub height_fog: HeightFog,
    /// Ambient of light scattered many times, W/(sr m²).
    pub ambient: DVec3,
    /// Radiance that the medium emits where it is thick and black, W/(sr m²).
    pub emission: DVec3,
}

pub(super) fn medium(decoder: &mut Decoder, node: &Node) -> Option<MediumDraft> {
    let known = ["extinction", "albedo", "phase", "scale_height", "base_height", "ambient", "emission"];
    let fields = decoder.fields(node, "a medium", &known)?;
    let mut colour = |name: &str, default: DVec3, range: Range| {
        given(fields.get(name), default, |n| vector(decoder, n, name, range))
    };
    let extinction = colour("extinction", DVec3::ZERO, Range::NotAbove(1e30));
    let albedo = colour("albedo", DVec3::ONE, Range::Unit);
    let ambient = colour("ambient", DVec3::ZERO, Range::NotNegative);
    let emission = colour("emission", DVec3::ZERO, Range::NotNegative);
    let phase = given(fields.get("phase"), PhaseDraft::Known(Phase::Isotropic), |n| phase(decoder, n));
    let height_fog = height_fog(decoder, &fields);
    let (phase, phase_file) = match phase? {
        PhaseDraft::Known(phase) => (phase, None),
        PhaseDraft::File(path, span) => (Phase::Isotropic, Some((path, span))),
    };
    let medium = Medium { extinction: extinction?, albedo: albedo?, phase };
    Some(MediumDraft { medium, phase_file, height_fog: height_fog?, ambient: ambient?, emission: emission? })
}

fn height_fog(decoder: &mut Decoder, fields: &Fields) -> Option<HeightFog> {
    let base = fields.get("base_height");
    let base_height = given(base, 0.0, |n| number(decoder, n, "base_height", Range::Any));
    let Some(node) = fields.get("scale_height") else {
        let Some(base) = base else { return Some(HeightFog::NONE) };
        let message = "`base_height` says where the medium has its own extinction, and no `scale_height` how it falls";
        let mistake = Diagnostic::error(MISSING_FIELD, decoder.place(base.span), message);
        decoder.report(mistake.suggest("add `scale_height: …`, metres, or leave `base_height` out"));
        return None;
    };
    let scale_height = number(decoder, node, "scale_height", Range::Positive)?;
    Some(HeightFog { base_height: base_height?, falloff: 1.0 / scale_height })
}

enum PhaseDraft {
    Known(Phase),
    File(String, Span),
}

const PHASES: &[&str] = &[
    "Isotropic",
    "HenyeyGreenstein",
    "DoubleHenyeyGreenstein",
    "Schlick",
    "Rayleigh",
    "CornetteShanks",
    "Droplets",
    "Measured",
];

fn phase(decoder: &mut Decoder, node: &Node) -> Option<PhaseDraft> {
    let (name, content) = decoder.variant(node, "a phase function", PHASES)?;
    let names: &[&str] = match name {
        "HenyeyGreenstein" | "CornetteShanks" => &["g"],
        "DoubleHenyeyGreenstein" => &["g1", "g2", "f"],
        "Schlick" => &["k"],
        "Droplets" => &["diameter"],
        _ => &[],
    };
    let empty = Node { span: node.span, value: Value::Unit };
    let content = content.unwrap_or(&empty);
    if name == "Measured" {
        return file(decoder, content);
    }
    // The contract names a parameter by its letter alone: `HenyeyGreenstein(0.75)` is as clear as `(g: 0.75)`.
    let nodes: Vec<&Node> = match &content.value {
        Value::Tuple(items) if !items.is_empty() && items.len() == names.len() => items.iter().collect(),
        _ => parts_of(decoder, content, name, names)?,
    };
    let mut values = Vec::new();
    for (name, node) in names.iter().zip(nodes) {
        let range = match *name {
            "f" => Range::Unit,
            "diameter" => Range::Within(DROPLET_DIAMETERS.0, DROPLET_DIAMETERS.1),
            _ => Range::Between(-1.0, 1.0),
        };
        values.push(number(decoder, node, name, range));
    }
    let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
    Some(PhaseDraft::Known(match (name, values.as_slice()) {
        ("HenyeyGreenstein", &[g]) => Phase::HenyeyGreenstein { g },
        ("CornetteShanks", &[g]) => Phase::CornetteShanks { g },
        ("DoubleHenyeyGreenstein", &[g1, g2, f]) => Phase::DoubleHenyeyGreenstein { g1, g2, f },
        ("Schlick", &[k]) => Phase::Schlick { k },
        ("Droplets", &[diameter]) => Phase::Droplets { diameter },
        ("Rayleigh", _) => Phase::Rayleigh,
        _ => Phase::Isotropic,
    }))
}

fn file(decoder: &mut Decoder, content: &Node) -> Option<PhaseDraft> {
    match &content.value {
        Value::Tuple(items) if items.len() == 1 => {
            decoder.text(&items[0]).map(|text| PhaseDraft::File(text.to_owned(), items[0].span))
        }
        _ => {
            decoder.wrong_type(content, "a path: `Measured(\"fog.phase.txt\")`");
            None
        }
    }
}
