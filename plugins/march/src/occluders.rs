//! The triangles that cast shadows, in a hierarchy of boxes: `occluder_nodes` and `occluder_corners` of
//! `occluder_data.wgsl`, for passes that ask of single points whether a light reaches them.
//!
//! Nodes stand in the order of a walk that goes down wherever a ray meets a box; each says where the walk goes on where it
//! does not. A leaf holds a few triangles, which follow one another.

use glam::DVec3;
use tyndall_plugin::scene::layout::{Shape, floats};
use tyndall_plugin::scene::{Buffers, Encoder, Moment, Part, SceneData, wgsl_struct};

/// Triangles of a leaf at most.
const LEAF: usize = 4;

wgsl_struct! {
    /// `OccluderNode`.
    struct OccluderNode {
        /// m, world.
        low: [f32; 3],
        /// The first triangle below it.
        first: u32,
        /// m, world.
        high: [f32; 3],
        /// Of a leaf its triangles, else 0.
        triangles: u32,
        /// The node that follows all below it.
        skip: u32,
        /// 0.
        pad0: u32,
        /// 0.
        pad1: u32,
        /// 0.
        pad2: u32,
    }
}

/// The scene data that are worked out here.
pub(crate) fn data() -> SceneData {
    let items =
        vec![("occluder_nodes", Shape::list::<OccluderNode>()), ("occluder_corners", Shape::list::<[f32; 4]>())];
    SceneData::kept(items, &[Part::Geometry], |_| Box::new(Hierarchy))
}

/// Made anew for each moment.
struct Hierarchy;

impl Encoder for Hierarchy {
    /// Triangles with a corner that is not finite are left out.
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>) {
        let triangles = moment.casters();
        let is_finite = |corners: &&[DVec3; 3]| corners.iter().all(|corner| corner.is_finite());
        let mut order: Vec<&[DVec3; 3]> = triangles.iter().filter(is_finite).collect();
        let mut nodes = Vec::with_capacity(order.len());
        if !order.is_empty() {
            build(&mut order, 0, &mut nodes);
        }
        let corners = order.into_iter().flatten().map(|corner| {
            let [x, y, z] = floats(*corner);
            [x, y, z, 0.0]
        });
        data.set_list("occluder_nodes", nodes);
        data.set_list("occluder_corners", corners);
    }
}

/// Appends the node of these triangles, which are sorted by where they are, and all below it.
fn build(triangles: &mut [&[DVec3; 3]], first: usize, nodes: &mut Vec<OccluderNode>) {
    let corners = || triangles.iter().copied().flatten();
    let low = corners().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
    let index = nodes.len();
    let is_leaf = triangles.len() <= LEAF;
    nodes.push(OccluderNode {
        low: floats(low),
        first: first as u32,
        high: floats(high),
        triangles: if is_leaf { triangles.len() as u32 } else { 0 },
        ..Default::default()
    });
    if !is_leaf {
        // The halves of the longest way across, by number: no tree is deep.
        let axis = (high - low).max_position();
        let middle = triangles.len() / 2;
        let place = |corners: &[DVec3; 3]| corners.iter().map(|corner| corner[axis]).sum::<f64>();
        triangles.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
        let (near, far) = triangles.split_at_mut(middle);
        build(near, first, nodes);
        build(far, first + middle, nodes);
    }
    nodes[index].skip = nodes.len() as u32;
}
