//! The node hierarchy of a glTF file's scene, parents before children.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat4, DQuat, DVec3, Mat4, Quat, Vec3};
use gltf::json::{Node as JsonNode, Root};

use super::accessors::absent;
use super::fault::{At, Checked, Fault, element};
use super::motion::{Motion, Tracks};
use crate::codes::{GLTF_HIERARCHY, GLTF_NOT_FINITE, GLTF_TRANSFORM};
use crate::model::{Node, NodeTransform};

/// The nodes of the scene that is drawn: index in the file and node.
pub(crate) type Hierarchy = Vec<(usize, Node)>;

/// Walks the file's default scene (or its first; without scenes, every node that has no parent).
pub(crate) fn hierarchy(root: &Root, mut tracks: BTreeMap<usize, Tracks>) -> Checked<Hierarchy> {
    let mut placed = vec![false; root.nodes.len()];
    let mut hierarchy = Hierarchy::new();
    let mut waiting: Vec<(usize, Option<usize>)> = roots(root)?.into_iter().rev().map(|node| (node, None)).collect();
    while let Some((index, parent)) = waiting.pop() {
        let json = root.nodes.get(index).ok_or_else(|| absent("node", index))?;
        let label = || element("node", index, json.name.as_deref());
        if std::mem::replace(&mut placed[index], true) {
            let message = "has two parents, or is its own ancestor";
            return Err(Fault::new(GLTF_HIERARCHY, message)).at(label);
        }
        let node = node(json, tracks.remove(&index), parent.map(|p: usize| (p, &hierarchy[p].1))).at(label)?;
        hierarchy.push((index, node));
        let here = hierarchy.len() - 1;
        let children = json.children.iter().flatten().rev();
        waiting.extend(children.map(|child| (child.value(), Some(here))));
    }
    Ok(hierarchy)
}

fn roots(root: &Root) -> Checked<Vec<usize>> {
    let index = root.scene.map(|s| s.value());
    match root.scenes.get(index.unwrap_or(0)) {
        Some(scene) => Ok(scene.nodes.iter().map(|node| node.value()).collect()),
        None => match index {
            Some(index) => Err(absent("scene", index)),
            None => {
                let mut child = vec![false; root.nodes.len()];
                for index in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
                    *child.get_mut(index.value()).ok_or_else(|| absent("node", index.value()))? = true;
                }
                Ok((0..root.nodes.len()).filter(|&i| !child[i]).collect())
            }
        },
    }
}

fn node(json: &JsonNode, tracks: Option<Tracks>, parent: Option<(usize, &Node)>) -> Checked<Node> {
    let above = parent.map(|p| p.1);
    let moves = tracks.is_some() || above.is_some_and(|p| p.moves);
    let may_flip = tracks.as_ref().is_some_and(Tracks::may_flip) || above.is_some_and(|p| p.may_flip);
    let transform = match (json.matrix, tracks) {
        (Some(matrix), _) => NodeTransform::Fixed(affine(matrix)?),
        (None, tracks) => {
            let (translation, rotation, scale) = parts(json)?;
            match tracks {
                Some(tracks) => NodeTransform::Moving(Box::new(Motion::new(translation, rotation, scale, tracks))),
                None => {
                    let fixed = DAffine3::from_scale_rotation_translation(scale, rotation, translation);
                    NodeTransform::Fixed(fixed)
                }
            }
        }
    };
    Ok(Node { parent: parent.map(|p| p.0), transform, moves, may_flip })
}

/// The nodes at which the mesh of a node is drawn: itself, or one for each of its places, which are put behind the others.
pub(crate) fn instanced(nodes: &mut Vec<Node>, node: usize, places: Option<Vec<DAffine3>>) -> Vec<usize> {
    let Some(places) = places else { return vec![node] };
    let first = nodes.len();
    let Node { moves, may_flip, .. } = nodes[node];
    let parent = Some(node);
    nodes.extend(places.into_iter().map(|place| Node {
        parent,
        transform: NodeTransform::Fixed(place),
        moves,
        may_flip,
    }));
    (first..nodes.len()).collect()
}

fn affine(matrix: [f32; 16]) -> Checked<DAffine3> {
    let matrix = Mat4::from_cols_array(&matrix);
    if !matrix.is_finite() {
        return Err(Fault::new(GLTF_NOT_FINITE, "matrix is not finite"));
    }
    if (matrix.row(3) - glam::Vec4::W).abs().max_element() > 1e-6 {
        return Err(Fault::new(GLTF_TRANSFORM, "matrix is not affine: its last row must be 0, 0, 0, 1"));
    }
    Ok(DAffine3::from_mat4(DMat4::from_cols_array(&matrix.to_cols_array().map(f64::from))))
}

fn parts(json: &JsonNode) -> Checked<(DVec3, DQuat, DVec3)> {
    let translation = Vec3::from_array(json.translation.unwrap_or_default());
    let scale = Vec3::from_array(json.scale.unwrap_or([1.0; 3]));
    let rotation = Quat::from_array(json.rotation.unwrap_or_default().0);
    if !(translation.is_finite() && scale.is_finite() && rotation.is_finite()) {
        return Err(Fault::new(GLTF_NOT_FINITE, "translation, rotation or scale is not finite"));
    }
    if rotation.length() < 1e-6 {
        return Err(Fault::new(GLTF_TRANSFORM, "rotation is a quaternion of length 0"));
    }
    Ok((translation.as_dvec3(), rotation.as_dquat().normalize(), scale.as_dvec3()))
}
