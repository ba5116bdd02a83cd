//! Animated node transforms: linear, stepped and cubic samplers of translation, rotation and scale.

use std::collections::BTreeMap;

use glam::{DAffine3, DQuat, DVec3, DVec4, Vec4};
use gltf::json::animation::{Channel, Interpolation, Property, Sampler};
use gltf::json::validation::Checked::Valid;

use super::accessors::{Data, FLOAT, SIGNED, absent};
use super::fault::{At, Checked, Fault, Report, Unread, element};
use crate::animate::segment;
use crate::codes::GLTF_ANIMATION;

/// Values over time of one property.
#[derive(Clone, Debug, PartialEq)]
struct Track {
    interpolation: Interpolation,
    /// Seconds, strictly ascending, at least one.
    times: Vec<f32>,
    /// One per time, or in-tangent, value, out-tangent per time where cubic. xyz, or a quaternion's xyzw.
    values: Vec<DVec4>,
}

impl Track {
    /// glTF 2.0, appendix C: constant outside the keys; `rotation` interpolates on the sphere.
    fn at(&self, time: f64, rotation: bool) -> DVec4 {
        let times = self.times.iter().map(|t| f64::from(*t));
        let (from, weight) = segment(times, time);
        let to = (from + 1).min(self.times.len() - 1);
        let value = match self.interpolation {
            Interpolation::Step => self.values[from],
            Interpolation::Linear if rotation => {
                let [a, b] = [from, to].map(|i| DQuat::from_vec4(self.values[i]).normalize());
                DVec4::from(a.slerp(b, weight))
            }
            Interpolation::Linear => self.values[from].lerp(self.values[to], weight),
            Interpolation::CubicSpline => self.cubic(from, to, weight),
        };
        // A cubic way between two rotations may pass through 0, where there is none; the nearer key stands in.
        if rotation { value.try_normalize().unwrap_or(self.key(from)) } else { value }
    }

    fn key(&self, index: usize) -> DVec4 {
        if self.interpolation == Interpolation::CubicSpline { self.values[3 * index + 1] } else { self.values[index] }
    }

    fn cubic(&self, from: usize, to: usize, t: f64) -> DVec4 {
        let seconds = f64::from(self.times[to] - self.times[from]);
        let (leaving, arriving) = (self.values[3 * from + 2] * seconds, self.values[3 * to] * seconds);
        let (t2, t3) = (t * t, t * t * t);
        self.key(from) * (2.0 * t3 - 3.0 * t2 + 1.0)
            + leaving * (t3 - 2.0 * t2 + t)
            + self.key(to) * (3.0 * t2 - 2.0 * t3)
            + arriving * (t3 - t2)
    }
}

/// Translation, rotation and scale of a node, each over time or fixed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Motion {
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
    tracks: Tracks,
}

/// The animated properties of one node.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Tracks {
    translation: Option<Track>,
    rotation: Option<Track>,
    scale: Option<Track>,
}

impl Tracks {
    /// Whether an animated scale factor ever falls below 0 at a key.
    pub fn may_flip(&self) -> bool {
        self.scale.as_ref().is_some_and(|t| {
            t.interpolation == Interpolation::CubicSpline || t.values.iter().any(|v| v.truncate().min_element() < 0.0)
        })
    }
}

impl Motion {
    pub fn new(translation: DVec3, rotation: DQuat, scale: DVec3, tracks: Tracks) -> Motion {
        Motion { translation, rotation, scale, tracks }
    }

    /// parent ← node.
    pub fn at(&self, time: f64) -> DAffine3 {
        let tracks = &self.tracks;
        let translation = tracks.translation.as_ref().map_or(self.translation, |t| t.at(time, false).truncate());
        let rotation = tracks.rotation.as_ref().map_or(self.rotation, |t| DQuat::from_vec4(t.at(time, true)));
        let scale = tracks.scale.as_ref().map_or(self.scale, |t| t.at(time, false).truncate());
        DAffine3::from_scale_rotation_translation(scale, rotation, translation)
    }
}

/// The tracks of every animated node. All animations of a file play at once; of two that drive the same property of a
/// node the first counts.
pub(crate) fn tracks(data: Data, report: &mut Report) -> BTreeMap<usize, Tracks> {
    let mut nodes: BTreeMap<usize, Tracks> = BTreeMap::new();
    let mut left = super::meshes::MOST_ELEMENTS;
    for (index, animation) in data.root.animations.iter().enumerate() {
        let label = element("animation", index, animation.name.as_deref());
        for (number, channel) in animation.channels.iter().enumerate() {
            let unread = |report: &mut Report, what| report.unread(what, format!("{number} of {label}"));
            let property = match channel.target.path {
                // glTF 2.0, 5.5: such a channel should be ignored.
                _ if data.left_out.targets.contains(&(index, number)) => Err(Unread::NO_TARGET),
                Valid(Property::MorphTargetWeights) => Err(Unread::MORPH_WEIGHTS),
                Valid(property) => Ok(property),
                _ => Err(Unread::UNKNOWN_PATH),
            };
            let property = match property {
                Ok(property) => property,
                Err(what) => {
                    unread(report, what);
                    continue;
                }
            };
            let of_channel = || format!("{label}, channel {number}");
            match driven(data, &animation.samplers, (channel, property), &mut left).at(of_channel) {
                Err(fault) => report.fault(fault),
                Ok((node, track)) => {
                    let tracks = nodes.entry(node).or_default();
                    let slot = match property {
                        Property::Translation => &mut tracks.translation,
                        Property::Rotation => &mut tracks.rotation,
                        _ => &mut tracks.scale,
                    };
                    if slot.is_none() {
                        *slot = Some(track);
                    } else {
                        unread(report, Unread::ANIMATED_TWICE);
                    }
                }
            }
        }
    }
    nodes
}

/// The node that a channel animates, and how.
fn driven(
    data: Data,
    samplers: &[Sampler],
    (channel, property): (&Channel, Property),
    left: &mut usize,
) -> Checked<(usize, Track)> {
    let node = channel.target.node.value();
    let target = data.root.nodes.get(node).ok_or_else(|| absent("node", node))?;
    if target.matrix.is_some() {
        return Err(Fault::new(GLTF_ANIMATION, format!("node {node} has a matrix and cannot be animated")));
    }
    let index = channel.sampler.value();
    let sampler = samplers.get(index).ok_or_else(|| absent("sampler", index))?;
    let track = track(data, sampler, property == Property::Rotation, left).at(|| format!("sampler {index}"))?;
    Ok((node, track))
}

fn track(data: Data, sampler: &Sampler, rotation: bool, left: &mut usize) -> Checked<Track> {
    let Valid(interpolation) = sampler.interpolation else {
        return Err(Fault::new(GLTF_ANIMATION, "unknown interpolation"));
    };
    let (input, output) = (sampler.input.value(), sampler.output.value());
    let (keys, values) = (data.accessor(input)?.1, data.accessor(output)?.1);
    let expected = if interpolation == Interpolation::CubicSpline { keys * 3 } else { keys };
    if values != expected {
        return Err(Fault::new(GLTF_ANIMATION, format!("{keys} times need {expected} values, there are {values}")));
    }
    *left = left.checked_sub(keys + values).ok_or_else(|| Fault::new(GLTF_ANIMATION, "too many keys in the file"))?;
    let times: Vec<f32> = data.floats::<1>(input, FLOAT)?.into_iter().map(|[t]| t).collect();
    if let Some(at) = times.windows(2).position(|w| w[1] <= w[0]) {
        let message = format!("time {} s does not follow {} s", times[at + 1], times[at]);
        return Err(Fault::new(GLTF_ANIMATION, message));
    }
    let values: Vec<DVec4> = if rotation {
        data.floats::<4>(output, SIGNED)?.into_iter().map(|v| Vec4::from_array(v).as_dvec4()).collect()
    } else {
        let widen = |[x, y, z]: [f32; 3]| DVec4::new(x.into(), y.into(), z.into(), 0.0);
        data.floats::<3>(output, FLOAT)?.into_iter().map(widen).collect()
    };
    let track = Track { interpolation, times, values };
    match (0..track.times.len()).find(|&i| rotation && track.key(i).length() < 1e-6) {
        Some(at) => Err(Fault::new(GLTF_ANIMATION, format!("rotation {at} is a quaternion of length 0"))),
        None => Ok(track),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(interpolation: Interpolation, values: &[f64]) -> Track {
        let values = values.iter().map(|v| DVec4::new(*v, 0.0, 0.0, 0.0)).collect();
        Track { interpolation, times: vec![0.0, 2.0], values }
    }

    #[test]
    fn samplers_follow_appendix_c() {
        let at = |track: &Track, time| track.at(time, false).x;
        let linear = track(Interpolation::Linear, &[1.0, 3.0]);
        assert_eq!([-1.0, 0.0, 1.0, 2.0, 5.0].map(|t| at(&linear, t)), [1.0, 1.0, 2.0, 3.0, 3.0]);
        let step = track(Interpolation::Step, &[1.0, 3.0]);
        assert_eq!([0.0, 1.9, 2.0].map(|t| at(&step, t)), [1.0, 1.0, 3.0]);
        // Tangents 1/s out of the first and into the last key on a way of 2 over 2 s: a straight line.
        let cubic = track(Interpolation::CubicSpline, &[0.0, 1.0, 1.0, 1.0, 3.0, 0.0]);
        assert_eq!([0.0, 0.5, 1.0, 2.0, 3.0].map(|t| at(&cubic, t)), [1.0, 1.5, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn rotations_stay_on_the_sphere() {
        let values = [DQuat::IDENTITY, DQuat::from_rotation_y(1.0)].map(DVec4::from).to_vec();
        let track = Track { interpolation: Interpolation::Linear, times: vec![0.0, 1.0], values };
        let half = DQuat::from_vec4(track.at(0.5, true));
        assert!(half.angle_between(DQuat::from_rotation_y(0.5)) < 1e-7);
    }
}
