//! What each pixel's ray meets, in double precision: what image tests hold `gbuffer.wgsl` and `visibility.wgsl` against.
//!
//! Every ray is met with every triangle that may be there, so nothing here knows of rasterisers, of depth buffers or of a
//! triangle that was found before. A rasteriser rounds corners to parts of a pixel, so where a pixel's centre lies that near to an edge it may
//! see the triangle on the other side: tests leave room for a few such pixels.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::{DVec2, DVec3, DVec4};
use tyndall_plugin::{Outputs, Pixel, ReferenceInput, rgba};
use tyndall_shaders::colour::linear_from_srgb;
use tyndall_shaders::ray::Ray;
use tyndall_shaders::scene::{Camera, Filter, Material, Surfaces, Texture, Triangle, Wrap};

/// Every port of `core.gbuffer`.
pub(crate) fn gbuffer(input: &ReferenceInput<'_>) -> Outputs {
    let (camera, surfaces, size) = (&input.scene()?.camera, input.surfaces()?, input.size("depth")?);
    let places: Vec<_> = surfaces.triangles.iter().map(|triangle| pixels_around(triangle, camera, size)).collect();
    let pixels = input.pixels("depth", |Pixel { at, ray, .. }| {
        let hit = nearest(&surfaces.triangles, &places, *at, ray);
        let along_axis = |hit: &Hit| hit.way * ray.direction.dot(camera.forward);
        let raster_depth = hit.as_ref().map_or(0.0, |hit| camera.nearest / along_axis(hit));
        (seen(surfaces, ray, hit.as_ref()), raster_depth, hit)
    })?;
    let hits = || pixels.iter().map(|(.., hit)| hit.as_ref());
    let seen = || pixels.iter().map(|(seen, ..)| seen);
    let layers = seen().map(|seen| seen.reflected).chain(seen().map(|seen| seen.shiny));
    Ok(BTreeMap::from([
        ("depth", hits().map(|hit| hit.map_or(f32::INFINITY, |hit| hit.way as f32)).collect()),
        ("normal", rgba(seen().map(|seen| seen.normal))),
        ("material", layers.flat_map(|layer| layer.map(|number| number as f32)).collect()),
        ("triangle", hits().map(|hit| hit.map_or(0, |hit| hit.triangle as u32 + 1)).collect()),
        ("raster_depth", pixels.iter().map(|(_, raster_depth, _)| *raster_depth as f32).collect()),
    ]))
}

/// Where a ray meets a triangle.
struct Hit {
    /// m along the ray.
    way: f64,
    /// Index of the triangle.
    triangle: usize,
    /// Barycentric coordinates of its corners.
    parts: [f64; 3],
}

/// What is seen there.
struct Seen {
    normal: DVec3,
    /// Lambert reflectance, rank of the shininess.
    reflected: [f64; 4],
    /// Phong reflectance, shininess.
    shiny: [f64; 4],
}

/// The nearest triangle on the ray of a pixel. `places` are the columns and rows where each can be seen.
fn nearest(triangles: &[Triangle], places: &[[Range<u32>; 2]], [x, y]: [u32; 2], ray: &Ray) -> Option<Hit> {
    let near = places.iter().enumerate().filter(|(_, [across, down])| across.contains(&x) && down.contains(&y));
    let hits = near.filter_map(|(index, _)| meet(index, &triangles[index], ray));
    hits.min_by(|a, b| a.way.total_cmp(&b.way))
}

/// Columns and rows in which a triangle can be seen, and one more on each side; all where it reaches behind the eye.
fn pixels_around(triangle: &Triangle, camera: &Camera, size: [u32; 2]) -> [Range<u32>; 2] {
    let corners = triangle.corners.map(|corner| corner.position - camera.position);
    if corners.iter().any(|corner| corner.dot(camera.forward) < camera.nearest) {
        return size.map(|size| 0..size);
    }
    let place = |corner: DVec3, axis: DVec3| corner.dot(axis) / axis.length_squared() / corner.dot(camera.forward);
    let range = |axis: DVec3, size: u32| {
        let at = corners.map(|corner| (place(corner, axis) + 1.0) / 2.0 * f64::from(size));
        let (least, most) = (at.iter().copied().fold(f64::MAX, f64::min), at.iter().copied().fold(f64::MIN, f64::max));
        // Casts stay within 0 and the largest number.
        (least - 1.0).max(0.0) as u32..((most + 2.0).max(0.0) as u32).min(size)
    };
    [range(camera.right, size[0]), range(-camera.up, size[1])]
}

/// By the volumes that the ray spans with the edges: all of one sign inside.
fn meet(index: usize, triangle: &Triangle, ray: &Ray) -> Option<Hit> {
    let [a, b, c] = triangle.corners.map(|corner| corner.position - ray.origin);
    let volume = |from: DVec3, to: DVec3| ray.direction.dot(from.cross(to));
    let volumes = [volume(b, c), volume(c, a), volume(a, b)];
    let inside = volumes.iter().all(|part| *part >= 0.0) || volumes.iter().all(|part| *part <= 0.0);
    let all: f64 = volumes.iter().sum();
    if !inside || all == 0.0 {
        return None;
    }
    let parts = volumes.map(|part| part / all);
    let way = (parts[0] * a + parts[1] * b + parts[2] * c).dot(ray.direction);
    (way > 0.0).then_some(Hit { way, triangle: index, parts })
}

fn seen(surfaces: &Surfaces, ray: &Ray, hit: Option<&Hit>) -> Seen {
    let Some(hit) = hit else {
        return Seen { normal: DVec3::ZERO, reflected: [0.0; 4], shiny: [0.0, 0.0, 0.0, 1.0] };
    };
    let triangle = &surfaces.triangles[hit.triangle];
    let [a, b, c] = triangle.corners;
    let face = (b.position - a.position).cross(c.position - a.position);
    let [part_a, part_b, part_c] = hit.parts;
    let normal = (part_a * a.normal + part_b * b.normal + part_c * c.normal).normalize();
    // The side that the eye sees is that of the triangle, and not that of the normals at its corners.
    let side = if (face.dot(ray.direction) > 0.0) == (face.dot(normal) > 0.0) { -1.0 } else { 1.0 };
    let uv = part_a * a.uv + part_b * b.uv + part_c * c.uv;
    let material = &surfaces.materials[triangle.material];
    let texture = material.texture.map_or(DVec4::ONE, |texture| texture_at(&surfaces.textures[texture], uv));
    let color = part_a * a.color + part_b * b.color + part_c * c.color;
    let (diffuse, specular) = reflectances(material, texture.truncate() * color, texture.w);
    let ([red, green, blue], [sr, sg, sb]) = (diffuse.to_array(), specular.to_array());
    Seen {
        normal: side * normal,
        reflected: [red, green, blue, f64::from(material.shininess_rank)],
        shiny: [sr, sg, sb, material.shininess],
    }
}

/// ρ and k_s where texture and vertices have this colour and metallic factor.
fn reflectances(material: &Material, color: DVec3, metallic_there: f64) -> (DVec3, DVec3) {
    let base = material.diffuse * color;
    let Some([metallic, peak, most]) = material.metallic_roughness else { return (base, material.specular) };
    let metallic = metallic * metallic_there;
    let diffuse = (1.0 - metallic) * base;
    let mirrored = (1.0 - metallic) * DVec3::splat(0.04) + metallic * base;
    (diffuse, (peak * mirrored).min(most * (DVec3::ONE - diffuse)))
}

/// The nearest texel, or linear between the centres of the four nearest, of linear light; and the metallic factor.
fn texture_at(texture: &Texture, uv: DVec2) -> DVec4 {
    let place = uv * DVec2::new(f64::from(texture.width), f64::from(texture.height));
    let corner = if texture.filter == Filter::Nearest { place.floor() } else { (place - 0.5).floor() };
    let part = place - 0.5 - corner;
    let texel = |right: f64, down: f64| {
        let x = wrapped(corner.x + right, texture.width, texture.wrap[0]);
        let y = wrapped(corner.y + down, texture.height, texture.wrap[1]);
        let texel = texture.texels[(y * texture.width + x) as usize];
        let [red, green, blue, metallic] = texel.map(|code| f64::from(code) / 255.0);
        DVec3::new(red, green, blue).map(linear_from_srgb).extend(metallic)
    };
    if texture.filter == Filter::Nearest {
        return texel(0.0, 0.0);
    }
    let top = texel(0.0, 0.0).lerp(texel(1.0, 0.0), part.x);
    let bottom = texel(0.0, 1.0).lerp(texel(1.0, 1.0), part.x);
    top.lerp(bottom, part.y)
}

/// The texel along an axis that a place outside of the picture reads.
fn wrapped(at: f64, size: u32, wrap: Wrap) -> u32 {
    let size_there = f64::from(size);
    let inside = match wrap {
        Wrap::Repeat => at.rem_euclid(size_there),
        Wrap::Clamp => at.clamp(0.0, size_there - 1.0),
        // There and back again.
        Wrap::Mirror => {
            let along = at.rem_euclid(2.0 * size_there);
            if along < size_there { along } else { 2.0 * size_there - 1.0 - along }
        }
    };
    inside as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrapped_texels() {
        let read = |wrap| (-4..8).map(|at| wrapped(f64::from(at), 3, wrap)).collect::<Vec<_>>();
        assert_eq!(read(Wrap::Repeat), [2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1]);
        assert_eq!(read(Wrap::Clamp), [0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2]);
        assert_eq!(read(Wrap::Mirror), [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
    }
}
