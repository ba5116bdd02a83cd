//! `medium: (extinction, albedo, phase, scale_height, base_height, ambient, emission)`.

use glam::DVec3;
use tyndall_document::{Decoder, Diagnostic, Fields, MISSING_FIELD, Node, Span, Value};
use tyndall_shaders::phase::{PHASE_FUNCTIONS, PhaseFunction};
use tyndall_shaders::scene::{HeightFog, Phase};

use super::{or_default, parts_of, path};
use crate::field::{Fields as PluginFields, Holder};
use crate::model::Medium;
use crate::read::{COORDINATE, EXTINCTION, LENGTH, POWER, Range, SceneReader, number, vector};

pub(super) const FIELDS: &[&str] =
    &["extinction", "albedo", "phase", "scale_height", "base_height", "ambient", "emission"];

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
    /// Those that plugins bring.
    pub fields: PluginFields,
}

pub(super) fn medium(decoder: &mut SceneReader<'_>, node: &Node) -> Option<MediumDraft> {
    let (fields, own) = decoder.fields_of(Holder::Medium, node, "a medium", FIELDS)?;
    let mut colour = |name: &str, default: DVec3, range: Range| {
        or_default(fields.get(name), default, |n| vector(decoder, n, name, range))
    };
    let extinction = colour("extinction", DVec3::ZERO, EXTINCTION);
    let albedo = colour("albedo", DVec3::ONE, Range::Unit);
    let ambient = colour("ambient", DVec3::ZERO, POWER);
    let emission = colour("emission", DVec3::ZERO, POWER);
    let phase = or_default(fields.get("phase"), PhaseDraft::Known(Phase::Isotropic), |n| phase(decoder, n));
    let height_fog = height_fog(decoder, &fields);
    let (phase, phase_file) = match phase? {
        PhaseDraft::Known(phase) => (phase, None),
        PhaseDraft::File(path, span) => (Phase::Isotropic, Some((path, span))),
    };
    let medium = Medium { extinction: extinction?, albedo: albedo?, phase };
    let (ambient, emission, fields) = (ambient?, emission?, own?);
    Some(MediumDraft { medium, phase_file, height_fog: height_fog?, ambient, emission, fields })
}

fn height_fog(decoder: &mut Decoder, fields: &Fields) -> Option<HeightFog> {
    let base = fields.get("base_height");
    let base_height = or_default(base, 0.0, |n| number(decoder, n, "base_height", COORDINATE));
    let Some(node) = fields.get("scale_height") else {
        let Some(base) = base else { return Some(HeightFog::NONE) };
        let message = "`base_height` says where the medium has its own extinction, and no `scale_height` how it falls";
        let mistake = Diagnostic::error(MISSING_FIELD, decoder.place(base.span), message);
        decoder.report(mistake.suggest("add `scale_height: …`, metres, or leave `base_height` out"));
        return None;
    };
    let scale_height = number(decoder, node, "scale_height", LENGTH)?;
    Some(HeightFog { base_height: base_height?, falloff: 1.0 / scale_height })
}

enum PhaseDraft {
    Known(Phase),
    File(String, Span),
}

/// The phase function whose table stands in a file of its own.
const MEASURED: &str = "Measured";

fn phase(decoder: &mut Decoder, node: &Node) -> Option<PhaseDraft> {
    let names: Vec<&str> = PHASE_FUNCTIONS.iter().map(|function| function.name).chain([MEASURED]).collect();
    let (name, content) = decoder.variant(node, "a phase function", &names)?;
    let empty = Node { span: node.span, value: Value::Unit };
    let content = content.unwrap_or(&empty);
    match PHASE_FUNCTIONS.iter().find(|function| function.name == name) {
        Some(function) => parameters(decoder, content, function).map(PhaseDraft::Known),
        None => path(decoder, content, "Measured(\"fog.phase.txt\")").map(|(path, span)| PhaseDraft::File(path, span)),
    }
}

/// `HenyeyGreenstein(0.75)` is as clear as `HenyeyGreenstein(g: 0.75)`.
fn parameters(decoder: &mut Decoder, content: &Node, function: &PhaseFunction) -> Option<Phase> {
    let names: Vec<&str> = function.parameters.iter().map(|parameter| parameter.name).collect();
    let nodes: Vec<&Node> = match &content.value {
        Value::Tuple(items) if !items.is_empty() && items.len() == names.len() => items.iter().collect(),
        _ => parts_of(decoder, content, function.name, &names)?,
    };
    let mut nodes = nodes.into_iter();
    (function.make)(&mut |parameter| number(decoder, nodes.next()?, parameter.name, parameter.range.into()))
}
