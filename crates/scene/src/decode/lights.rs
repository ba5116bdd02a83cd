//! `lights: [Point(…), Spot(…), Directional(…)]`.

use glam::DVec3;
use tyndall_document::{Decoder, Fields, Node};

use super::values::{Range, animated, animated_direction, animated_power, number, vector};
use super::{given, variant};
use crate::animate::Animated;
use crate::model::{Light, LightKind, Placement};

/// All lights; those with mistakes are left out, their mistakes reported.
pub(super) fn lights(decoder: &mut Decoder, node: &Node) -> Option<Vec<Light>> {
    let items = decoder.list(node)?;
    Some(items.iter().filter_map(|item| light(decoder, item)).collect())
}

fn light(decoder: &mut Decoder, node: &Node) -> Option<Light> {
    variant(decoder, node, "a light", &[("Point", point), ("Spot", spot), ("Directional", directional)])
}

fn point(decoder: &mut Decoder, node: &Node) -> Option<Light> {
    let fields = decoder.fields(node, "a Point", &["position", "intensity", "radius"])?;
    let position = needed(decoder, &fields, "position", animated);
    let intensity = needed(decoder, &fields, "intensity", animated_power);
    let radius = radius(decoder, &fields);
    let direction = Animated::Constant(DVec3::NEG_Y);
    let placement = Placement::World { position: position?, direction };
    Some(Light { kind: LightKind::Point, intensity: intensity?, radius: radius?, placement })
}

fn spot(decoder: &mut Decoder, node: &Node) -> Option<Light> {
    let known = ["position", "direction", "intensity", "exponent", "cutoff", "radius"];
    let fields = decoder.fields(node, "a Spot", &known)?;
    let position = needed(decoder, &fields, "position", animated);
    let direction = needed(decoder, &fields, "direction", animated_direction);
    let intensity = needed(decoder, &fields, "intensity", animated_power);
    let exponent = given(fields.get("exponent"), 0.0, |n| number(decoder, n, "exponent", Range::NotNegative));
    let cutoff = given(fields.get("cutoff"), 90.0, |n| number(decoder, n, "cutoff", Range::UpTo(90.0)));
    let radius = radius(decoder, &fields);
    let kind = LightKind::Spot { exponent: exponent?, cutoff: cutoff?.to_radians() };
    let placement = Placement::World { position: position?, direction: direction? };
    Some(Light { kind, intensity: intensity?, radius: radius?, placement })
}

fn directional(decoder: &mut Decoder, node: &Node) -> Option<Light> {
    let fields = decoder.fields(node, "a Directional", &["direction", "irradiance", "radius"])?;
    let direction = needed(decoder, &fields, "direction", animated_direction);
    let irradiance = needed(decoder, &fields, "irradiance", |d, n, name| {
        vector(d, n, name, Range::NotNegative).map(Animated::Constant)
    });
    let radius = radius(decoder, &fields);
    let placement = Placement::World { position: Animated::Constant(DVec3::ZERO), direction: direction? };
    Some(Light { kind: LightKind::Directional, intensity: irradiance?, radius: radius?, placement })
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
    given(fields.get("radius"), 0.0, |n| number(decoder, n, "radius", Range::NotNegative))
}
