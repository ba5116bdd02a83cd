//! EXT_mesh_gpu_instancing: a mesh at many places of one node.

use std::collections::BTreeMap;

use glam::{DAffine3, DQuat, DVec3, Vec3, Vec4};
use serde_json::Value;

use super::accessors::{Data, FLOAT, SIGNED};
use super::fault::{At, Checked, Fault};
use crate::codes::{GLTF_ACCESSOR_TYPE, GLTF_SYNTAX, GLTF_TOO_LARGE, GLTF_TRANSFORM};

/// Places of all nodes of a file together, and primitives drawn at all of them.
pub(crate) const MOST_PLACES: usize = 1 << 20;

/// By node, node ← place for each of its places. A node without attributes has none.
pub(crate) fn places(data: Data) -> Checked<BTreeMap<usize, Vec<DAffine3>>> {
    let mut left = MOST_PLACES;
    let mut all = BTreeMap::new();
    for (&node, attributes) in &data.left_out.instancing {
        let places = of_node(data, attributes, &mut left).at(|| format!("node {node}, EXT_mesh_gpu_instancing"))?;
        all.insert(node, places);
    }
    Ok(all)
}

fn of_node(data: Data, attributes: &Value, left: &mut usize) -> Checked<Vec<DAffine3>> {
    let accessor = |name: &'static str| accessor(attributes, name);
    let attributes = [accessor("TRANSLATION")?, accessor("ROTATION")?, accessor("SCALE")?];
    let given = || attributes.iter().flatten();
    let counts = given().map(|index| Ok(data.accessor(*index)?.1)).collect::<Checked<Vec<usize>>>()?;
    let count = counts.first().copied().unwrap_or(0);
    if let Some(other) = counts.iter().find(|other| **other != count) {
        return Err(Fault::new(
            GLTF_ACCESSOR_TYPE,
            format!("{other} elements beside {count}: attributes must have equally many"),
        ));
    }
    *left = left.checked_sub(count).ok_or_else(|| {
        Fault::new(GLTF_TOO_LARGE, format!("the file has more than {MOST_PLACES} places of instanced meshes"))
    })?;
    let vectors = |attribute: Option<usize>, name: &str, default: DVec3| match attribute {
        None => Ok(vec![default; count]),
        Some(index) => {
            let values = data.floats::<3>(index, FLOAT).at(|| name.to_owned())?;
            Ok(values.into_iter().map(|value| Vec3::from_array(value).as_dvec3()).collect())
        }
    };
    let [translation, rotation, scale] = attributes;
    let translations = vectors(translation, "TRANSLATION", DVec3::ZERO)?;
    let scales = vectors(scale, "SCALE", DVec3::ONE)?;
    let rotations = match rotation {
        None => vec![DQuat::IDENTITY; count],
        Some(index) => rotations(data, index).at(|| "ROTATION".to_owned())?,
    };
    let parts = scales.into_iter().zip(rotations).zip(translations);
    Ok(parts.map(|((s, r), t)| DAffine3::from_scale_rotation_translation(s, r, t)).collect())
}

/// The accessor of an attribute, which may be left out.
fn accessor(attributes: &Value, name: &str) -> Checked<Option<usize>> {
    let Some(value) = attributes.get(name) else { return Ok(None) };
    let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
    index
        .map(Some)
        .ok_or_else(|| Fault::new(GLTF_SYNTAX, format!("{name} is {value}, and not the index of an accessor")))
}

fn rotations(data: Data, accessor: usize) -> Checked<Vec<DQuat>> {
    let unit = |(at, value): (usize, [f32; 4])| match Vec4::from_array(value).as_dvec4().try_normalize() {
        Some(unit) => Ok(DQuat::from_vec4(unit)),
        None => Err(Fault::new(GLTF_TRANSFORM, format!("element {at} is a quaternion of length 0"))),
    };
    data.floats::<4>(accessor, SIGNED)?.into_iter().enumerate().map(unit).collect()
}
