//! Vertices, triangles and what is adjacent, as passes number them: instance after instance.

use std::collections::BTreeMap;

use bytemuck::bytes_of;
use glam::{DAffine3, DMat3, Vec3};

use crate::adjacency::Adjacency;
use crate::frame::Frame;
use crate::layout::{Header, Vertex, floats};
use crate::model::Instance;
use crate::moment::Moment;
use crate::scene::Scene;
use crate::scene_data::{Buffers, Encoder, list};

/// Makes `vertices`; afterwards moves those of the instances that move, in place.
pub(crate) struct Vertices;

impl Encoder for Vertices {
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>) {
        let bytes = data.bytes("vertices");
        let instances = || moment.scene.instances.iter().zip(&moment.frame.transforms);
        if bytes.is_empty() {
            *bytes = list(instances().flat_map(|(instance, transform)| world_vertices(instance, transform)));
            return;
        }
        let mut slots = bytes[size_of::<Header>()..].chunks_exact_mut(size_of::<Vertex>());
        for (instance, transform) in instances() {
            let slots = slots.by_ref().take(instance.mesh.positions.len());
            if moment.scene.instance_moves(instance) {
                slots.zip(world_vertices(instance, transform)).for_each(|(slot, v)| slot.copy_from_slice(bytes_of(&v)));
            } else {
                slots.for_each(drop);
            }
        }
    }
}

/// Positions through the transform, normals through its cofactors: right for any affine map, also a flattening one.
fn world_vertices<'a>(instance: &'a Instance, transform: &DAffine3) -> impl Iterator<Item = Vertex> + use<'a> {
    let transform = *transform;
    let matrix = transform.matrix3;
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    let cofactors = DMat3::from_cols(
        matrix.y_axis.cross(matrix.z_axis),
        matrix.z_axis.cross(matrix.x_axis),
        matrix.x_axis.cross(matrix.y_axis),
    ) * sign;
    let mesh = &instance.mesh;
    mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs).map(move |((position, normal), uv)| {
        let turned = (cofactors * normal.as_dvec3()).try_normalize();
        Vertex {
            position: floats(transform.transform_point3(position.as_dvec3())),
            u: uv.x,
            normal: floats(turned.unwrap_or(normal.as_dvec3())),
            v: uv.y,
        }
    })
}

/// Corners of all triangles as indices into the encoded vertices, with the index of their instance; turned around where
/// a transform mirrors, so that they stay counter-clockwise from outside.
pub(crate) fn world_triangles(scene: &Scene, frame: &Frame) -> impl Iterator<Item = [u32; 4]> {
    let mut first = 0;
    let instances = scene.instances.iter().zip(&frame.transforms).enumerate();
    instances.flat_map(move |(index, (instance, transform))| {
        let start = first;
        first += instance.mesh.positions.len() as u32;
        let mirrored = transform.matrix3.determinant() < 0.0;
        instance.mesh.triangles.iter().map(move |&[a, b, c]| {
            let (b, c) = if mirrored { (c, b) } else { (b, c) };
            [start + a, start + b, start + c, index as u32]
        })
    })
}

/// One adjacency per group of meshes that keep their places to one another, with indices into the encoded vertices and
/// triangles; in the order of the objects, and of an object first what its moving nodes do not carry.
pub(crate) fn adjacency(scene: &Scene) -> Vec<Adjacency> {
    let frame = scene.at(0.0);
    let mut triangles = world_triangles(scene, &frame).enumerate();
    let mut groups: BTreeMap<(usize, Option<usize>), Group> = BTreeMap::new();
    let mut first_vertex = 0;
    for (instance, transform) in scene.instances.iter().zip(&frame.transforms) {
        let node = scene.moving_node(instance);
        let group = groups.entry((instance.object, node)).or_default();
        let shift = group.positions.len() as u32;
        // What moves by itself is welded in its own space: at time 0 it may be scaled to nothing.
        match node {
            Some(_) => group.positions.extend(&instance.mesh.positions),
            None => group.positions.extend(world_vertices(instance, transform).map(|v| Vec3::from_array(v.position))),
        }
        group.vertices.extend(first_vertex..first_vertex + instance.mesh.positions.len() as u32);
        for (index, [a, b, c, _]) in triangles.by_ref().take(instance.mesh.triangles.len()) {
            group.triangles.push(index as u32);
            group.corners.push([a, b, c].map(|vertex| vertex - first_vertex + shift));
        }
        first_vertex += instance.mesh.positions.len() as u32;
    }
    groups.into_values().map(Group::adjacency).collect()
}

/// Meshes that keep their places to one another.
#[derive(Default)]
struct Group {
    positions: Vec<Vec3>,
    /// Of each position: its index among the encoded vertices.
    vertices: Vec<u32>,
    /// Into the positions.
    corners: Vec<[u32; 3]>,
    /// Of each of those: its index among the encoded triangles.
    triangles: Vec<u32>,
}

impl Group {
    fn adjacency(self) -> Adjacency {
        let mut adjacency = Adjacency::of(&self.positions, &self.corners);
        adjacency.rename(&self.vertices, &self.triangles);
        adjacency
    }
}
