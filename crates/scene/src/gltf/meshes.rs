//! Mesh primitives as triangle meshes.

use glam::{DAffine2, DMat2, DVec2, Vec2, Vec3};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked::Valid;

use super::accessors::{COLOR, Data, POSITION, SIGNED, TEXCOORD};
use super::fault::{At, Checked, Fault};
use crate::codes::{GLTF_ACCESSOR_TYPE, GLTF_INDEX_RANGE, GLTF_MODE, GLTF_REFERENCE, GLTF_TOO_LARGE};
use crate::mesh::Mesh;

/// Largest number of vertices, and of triangles, of a glTF file and of a scene: 512 MiB and 256 MiB as scene data.
pub(crate) const MOST_ELEMENTS: usize = 1 << 24;

/// Which texture coordinates a material wants, and how it changes them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UvSource {
    /// n of `TEXCOORD_n`.
    pub set: u32,
    /// KHR_texture_transform.
    pub transform: DAffine2,
}

impl UvSource {
    /// KHR_texture_transform: scale, then rotate, then offset; its angle runs counter-clockwise in an image whose v
    /// points down.
    pub fn new(set: u32, offset: [f32; 2], rotation: f32, scale: [f32; 2]) -> UvSource {
        let (sin, cos) = f64::from(rotation).sin_cos();
        let rotation = DMat2::from_cols(DVec2::new(cos, -sin), DVec2::new(sin, cos));
        let scale = DMat2::from_diagonal(Vec2::from_array(scale).as_dvec2());
        UvSource {
            set,
            transform: DAffine2::from_mat2_translation(rotation * scale, Vec2::from_array(offset).as_dvec2()),
        }
    }
}

/// What remains of the numbers of vertices and triangles that one file may have.
pub(crate) struct Budget {
    pub left: usize,
}

impl Budget {
    fn take(&mut self, number: usize) -> Checked<()> {
        self.left = self.left.checked_sub(number).ok_or_else(|| {
            Fault::new(GLTF_TOO_LARGE, format!("the file has more than {MOST_ELEMENTS} vertices or indices"))
        })?;
        Ok(())
    }
}

/// The mesh of a primitive, `None` where it has no triangles (points and lines), and whether its colours were clamped.
pub(crate) fn mesh(
    data: Data,
    primitive: &Primitive,
    uv: Option<UvSource>,
    budget: &mut Budget,
) -> Checked<Option<(Mesh, bool)>> {
    let Valid(mode) = primitive.mode else { return Err(Fault::new(GLTF_MODE, "unknown mode")) };
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(None);
    }
    let attribute = |semantic| primitive.attributes.get(&Valid(semantic)).map(|index| index.value());
    let position = attribute(Semantic::Positions);
    let position = position.ok_or_else(|| Fault::new(GLTF_REFERENCE, "POSITION is missing"))?;
    let vertices = reserve(data, position, budget).at(|| "POSITION".into())?;
    let positions = data.floats::<3>(position, POSITION).at(|| "POSITION".into())?;
    let triangles = triangles(data, primitive, mode, vertices, budget)?;
    let uvs = match uv {
        Some(uv) => uvs(data, attribute(Semantic::TexCoords(uv.set)), uv, vertices)?,
        None => vec![Vec2::ZERO; vertices],
    };
    let positions = positions.into_iter().map(Vec3::from_array).collect();
    let (colors, clamped) = match attribute(Semantic::Colors(0)) {
        Some(index) => colors(data, index, vertices).at(|| "COLOR_0".into())?,
        None => (Vec::new(), false),
    };
    let mut mesh = Mesh { positions, normals: Vec::new(), uvs, colors, triangles };
    mesh.turn_triangles();
    match attribute(Semantic::Normals) {
        None => {
            budget.take(mesh.triangles.len() * 3)?;
            mesh = mesh.flattened();
        }
        Some(index) => {
            let label = || "NORMAL".to_owned();
            same_count(data, index, vertices).at(label)?;
            let normals = data.floats::<3>(index, SIGNED).at(label)?;
            mesh.normals = normals.into_iter().map(Vec3::from_array).collect();
            mesh.repair_normals();
        }
    }
    Ok(Some((mesh, clamped)))
}

/// Whether the positions of a primitive stand in a buffer.
pub(crate) fn has_bytes(data: Data, primitive: &Primitive) -> bool {
    let position = primitive.attributes.get(&Valid(Semantic::Positions));
    position
        .and_then(|index| data.root.accessors.get(index.value()))
        .is_some_and(|accessor| accessor.buffer_view.is_some() || accessor.sparse.is_some())
}

/// The number of elements, taken off the budget before they are read.
fn reserve(data: Data, accessor: usize, budget: &mut Budget) -> Checked<usize> {
    let (_, count) = data.accessor(accessor)?;
    budget.take(count)?;
    Ok(count)
}

fn same_count(data: Data, accessor: usize, vertices: usize) -> Checked<()> {
    match data.accessor(accessor)?.1 {
        count if count == vertices => Ok(()),
        count => Err(Fault::new(GLTF_ACCESSOR_TYPE, format!("{count} elements for {vertices} vertices"))),
    }
}

fn uvs(data: Data, accessor: Option<usize>, uv: UvSource, vertices: usize) -> Checked<Vec<Vec2>> {
    let label = || format!("TEXCOORD_{}", uv.set);
    let Some(accessor) = accessor else {
        let message = format!("{} is missing, which the material's texture needs", label());
        return Err(Fault::new(GLTF_REFERENCE, message));
    };
    same_count(data, accessor, vertices).at(label)?;
    let values = data.floats::<2>(accessor, TEXCOORD).at(label)?;
    let transform = |uv_of: [f32; 2]| uv.transform.transform_point2(Vec2::from_array(uv_of).as_dvec2()).as_vec2();
    Ok(values.into_iter().map(transform).collect())
}

/// Linear factors of the base colour (glTF 2.0, 3.9.2), and whether one was clamped; alpha is drawn opaque.
fn colors(data: Data, accessor: usize, vertices: usize) -> Checked<(Vec<Vec3>, bool)> {
    same_count(data, accessor, vertices)?;
    let values: Vec<Vec3> = data.triples(accessor, COLOR)?.into_iter().map(Vec3::from_array).collect();
    // A surface reflects what it gets and no more. Exporters round.
    let clamped: Vec<Vec3> = values.iter().map(|value| value.clamp(Vec3::ZERO, Vec3::ONE)).collect();
    let differs = values.iter().zip(&clamped).any(|(value, clamped)| (*value - *clamped).abs().max_element() > 1e-3);
    Ok((clamped, differs))
}

fn triangles(
    data: Data,
    primitive: &Primitive,
    mode: Mode,
    vertices: usize,
    budget: &mut Budget,
) -> Checked<Vec<[u32; 3]>> {
    let label = || "indices".to_owned();
    let indices = match primitive.indices {
        None => {
            budget.take(vertices)?;
            (0..vertices as u32).collect()
        }
        Some(accessor) => {
            reserve(data, accessor.value(), budget).at(label)?;
            data.indices(accessor.value()).at(label)?
        }
    };
    if let Some(at) = indices.iter().position(|&i| i as usize >= vertices) {
        let message = format!("element {at} is {}, the primitive has {vertices} vertices", indices[at]);
        return Err(Fault::new(GLTF_INDEX_RANGE, message)).at(label);
    }
    let corners = |mut triangle: [u32; 3], flip: bool| {
        if flip {
            triangle.swap(1, 2);
        }
        triangle
    };
    let distinct = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    Ok(match mode {
        Mode::TriangleStrip => {
            let windows = indices.windows(3).enumerate();
            windows.map(|(i, w)| corners([w[0], w[1], w[2]], i % 2 == 1)).filter(distinct).collect()
        }
        Mode::TriangleFan => {
            let rim = indices.get(1..).unwrap_or_default().windows(2);
            rim.map(|w| [w[0], w[1], indices[0]]).filter(distinct).collect()
        }
        _ if indices.len() % 3 != 0 => {
            let message = format!("{} indices do not form whole triangles", indices.len());
            return Err(Fault::new(GLTF_INDEX_RANGE, message)).at(label);
        }
        _ => indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of KHR_texture_transform's text: offset · rotation · scale with rotation (cos, −sin; sin, cos)
    /// column by column.
    #[test]
    fn texture_transform_follows_the_extension() {
        let uv = UvSource::new(0, [0.5, 0.25], std::f32::consts::FRAC_PI_2, [2.0, 3.0]);
        let point = uv.transform.transform_point2(DVec2::new(1.0, 1.0));
        // (2, 3) turned: x' = cos·x + sin·y, y' = −sin·x + cos·y.
        assert!((point - DVec2::new(3.5, -1.75)).length() < 1e-6, "{point}");
    }
}
