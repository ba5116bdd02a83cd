//! `lights: [Point(…), Spot(…), Directional(…)]`.

use glam::DVec3;
use tyndall_document::{Decoder, Fields, Node};

use super::{or_default, variant};
use crate::animate::Animated;
use crate::field::Holder;
use crate::model::{Light, LightKind, Placement};
use crate::read::{
    FARTHEST, POWER, Range, SceneReader, animated_direction, animated_place, animated_power, number, vector,
};

pub(super) const POINT_FIELDS: &[&str] = &["position", "intensity", "radius"];
pub(super) const SPOT_FIELDS: &[&str] = &["position", "direction", "intensity", "exponent", "cutoff", "radius"];
pub(super) const DIRECTIONAL_FIELDS: &[&str] = &["direction", "irradiance", "radius"];

/// All lights; those with mistakes are left out, their mistakes reported.
pub(super) fn lights(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Vec<Light>> {
    let items = decoder.list(node)?;
    Some(items.iter().filter_map(|item| light(decoder, item)).collect())
}

fn light(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Light> {
    variant(decoder, node, "a light", &[("Point", point), ("Spot", spot), ("Directional", directional)])
}

fn point(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Light> {
    let (fields, own) = decoder.fields_of(Holder::Light, node, "a Point", POINT_FIELDS)?;
    let position = needed(decoder, &fields, "position", animated_place);
    let intensity = needed(decoder, &fields, "intensity", animated_power);
    let radius = radius(decoder, &fields);
    let direction = Animated::Constant(DVec3::NEG_Y);
    let placement = Placement::World { position: position?, direction };
    Some(Light { kind: LightKind::Point, intensity: intensity?, radius: radius?, placement, fields: own? })
}

fn spot(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Light> {
    let (fields, own) = decoder.fields_of(Holder::Light, node, "a Spot", SPOT_FIELDS)?;
    let position = needed(decoder, &fields, "position", animated_place);
    let direction = needed(decoder, &fields, "direction", animated_direction);
    let intensity = needed(decoder, &fields, "intensity", animated_power);
    let exponent = or_default(fields.get("exponent"), 0.0, |n| number(decoder, n, "exponent", Range::NotNegative));
    let cutoff = or_default(fields.get("cutoff"), 90.0, |n| number(decoder, n, "cutoff", Range::UpTo(90.0)));
    let radius = radius(decoder, &fields);
    let kind = LightKind::Spot { exponent: exponent?, cutoff: cutoff?.to_radians() };
    let placement = Placement::World { position: position?, direction: direction? };
    Some(Light { kind, intensity: intensity?, radius: radius?, placement, fields: own? })
}

fn directional(decoder: &mut SceneReader<'_>, node: &Node) -> Option<Light> {
    let (fields, own) = decoder.fields_of(Holder::Light, node, "a Directional", DIRECTIONAL_FIELDS)?;
    let direction = needed(decoder, &fields, "direction", animated_direction);
    let irradiance =
        needed(decoder, &fields, "irradiance", |d, n, name| vector(d, n, name, POWER).map(Animated::Constant));
    let radius = radius(decoder, &fields);
    let placement = Placement::World { position: Animated::Constant(DVec3::ZERO), direction: direction? };
    Some(Light { kind: LightKind::Directional, intensity: irradiance?, radius: radius?, placement, fields: own? })
}

fn needed(
    decoder: &mut Decoder,
    fields: &Fields,
    name: &str,
    read: impl Fn(&mut Decoder, &Node, &str) -> Option<Animated>,
) -> Option<Animated> {
    let node = fields.required(decoder, name)?;
    read(decoder, node, name)
}

fn radius(decoder: &mut Decoder, fields: &Fields) -> Option<f64> {
    or_default(fields.get("radius"), 0.0, |n| number(decoder, n, "radius", Range::NotAbove(FARTHEST)))
}
