//! `camera: (position, look_at, up, vertical_fov)`.

use glam::DVec3;
use tyndall_document::{Code, Decoder, Diagnostic, Node};

use crate::animate::{Animated, least_length};
use crate::codes::{CAMERA_ON_TARGET, UP_ALONG_VIEW};
use crate::model::Camera;
use crate::read::{Range, animated_place, direction, number};

/// Below this sine of the angle between them, `up` is parallel to the view.
const PARALLEL: f64 = 1e-9;

/// What a scene file says of the camera.
#[derive(Debug)]
pub(crate) enum CameraDraft {
    /// All that is needed.
    Given(Camera),
    /// The camera of a glTF file, with another angle if one is given (radians).
    Model { vertical_fov: Option<f64> },
}

pub(super) fn camera(decoder: &mut Decoder, node: &Node) -> Option<CameraDraft> {
    let fields = decoder.fields(node, "a camera", &["position", "look_at", "up", "vertical_fov"])?;
    let fov = fields.get("vertical_fov");
    let fov = fov.map(|n| number(decoder, n, "vertical_fov", Range::Between(0.0, 180.0)).map(f64::to_radians));
    let names = ["position", "look_at", "up"];
    if names.iter().all(|name| fields.get(name).is_none()) {
        // Only the angle is given: the camera stands where that of the glTF file does.
        return Some(CameraDraft::Model { vertical_fov: fov.transpose_option()? });
    }
    let position_node = fields.required(decoder, "position");
    let look_at_node = fields.required(decoder, "look_at");
    let position = position_node.and_then(|n| animated_place(decoder, n, "position"));
    let look_at = look_at_node.and_then(|n| animated_place(decoder, n, "look_at"));
    let up_node = fields.get("up");
    let up = match up_node {
        Some(node) => direction(decoder, node, "up"),
        None => Some(DVec3::Y),
    };
    let (position, look_at, up) = (position?, look_at?, up?);
    let (position_node, look_at_node) = (position_node?, look_at_node?);
    let mut report = |code: Code, node: &Node, message: &str, other: (&Node, &str)| {
        let diagnostic = Diagnostic::error(code, decoder.place(node.span), message);
        let other_place = decoder.place(other.0.span);
        decoder.report(diagnostic.relate(other_place, other.1));
    };
    if view_vanishes(&position, &look_at, |view| view, look_at.at(0.0).length().max(1.0)) {
        report(CAMERA_ON_TARGET, look_at_node, "`look_at` is equal to `position`", (position_node, "the position"));
        return None;
    }
    if view_vanishes(&position, &look_at, |view| up.normalize().cross(view), 0.0) {
        let (at, other) = (up_node.unwrap_or(look_at_node), (look_at_node, "where the camera looks"));
        report(UP_ALONG_VIEW, at, "`up` is parallel to the view", other);
        return None;
    }
    let vertical_fov = fov.transpose_option()?.unwrap_or(45f64.to_radians());
    Some(CameraDraft::Given(Camera::LookAt { position, look_at, up, vertical_fov }))
}

/// `Some(None)`: given and faulty.
trait TransposeOption<T> {
    fn transpose_option(self) -> Option<Option<T>>;
}

impl<T> TransposeOption<T> for Option<Option<T>> {
    fn transpose_option(self) -> Option<Option<T>> {
        match self {
            Some(None) => None,
            Some(Some(value)) => Some(Some(value)),
            None => Some(None),
        }
    }
}

/// Whether a linear function of the view becomes 0 at some time. Between keys the view is linear in time, so the ends
/// of each piece say all. `scale` is the length against which a view counts as 0 by itself.
fn view_vanishes(position: &Animated, look_at: &Animated, of: impl Fn(DVec3) -> DVec3, scale: f64) -> bool {
    let mut times = position.times();
    times.extend(look_at.times());
    times.sort_unstable_by(f64::total_cmp);
    let views: Vec<DVec3> = times.iter().map(|&t| look_at.at(t) - position.at(t)).collect();
    let vanishes = |view: DVec3| of(view).length() <= PARALLEL * view.length() || view.length() < 1e-12 * scale;
    let between = |pair: &[DVec3]| {
        let ends = (of(pair[0]), of(pair[1]));
        least_length(ends.0, ends.1) < PARALLEL
    };
    views.iter().any(|&view| vanishes(view)) || views.windows(2).any(between)
}
