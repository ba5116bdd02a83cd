// A shadow map of lamps: about each one a cube, whose six faces hold the distance of the nearest triangle that casts
// shadows, in the middle of each texel (Williams 1978). To compare with: what stands behind an edge within a texel is
// taken for what its middle sees.
//
//   layer   face of the cube: 2 axis, and 1 more where the axis is looked along backwards
//   tile    part of a layer that one lamp has: n lights share each layer as k x k tiles, k = ceil(sqrt(n))
//   edge    texels of a tile's edge
//   away    from the lamp to a point, m

#import scene

struct Tiles {
    across: u32,                // k
    edge: u32,
}

fn tiles_of(lights: u32, size: u32) -> Tiles {
    let root = u32(sqrt(f32(lights)));
    let across = max(root + select(0u, 1u, root * root < lights), 1u);
    return Tiles(across, max(size / across, 1u));
}

// Texel and layer of a direction.
fn map_texel(tiles: Tiles, light: u32, away: vec3<f32>) -> vec3<u32> {
    let length = abs(away);
    let on_x = length.x >= length.y && length.x >= length.z;
    let on_y = !on_x && length.y >= length.z;
    let axis = select(select(2u, 1u, on_y), 0u, on_x);
    let along = select(select(away.z, away.y, on_y), away.x, on_x);
    let beside = select(select(away.xy, away.xz, on_y), away.yz, on_x);
    let place = (0.5 + 0.5 * beside / max(abs(along), 1e-30)) * f32(tiles.edge);
    let in_tile = min(vec2<u32>(max(place, vec2<f32>(0.0))), vec2<u32>(tiles.edge - 1u));
    let tile = vec2<u32>(light % tiles.across, light / tiles.across);
    return vec3<u32>(tile * tiles.edge + in_tile, 2u * axis + select(0u, 1u, along < 0.0));
}

// The direction of a texel's middle, not normalised.
fn map_direction(tiles: Tiles, texel: vec2<u32>, layer: u32) -> vec3<f32> {
    let beside = (2.0 * vec2<f32>(texel % tiles.edge) + 1.0) / f32(tiles.edge) - 1.0;
    let along = select(1.0, -1.0, layer % 2u == 1u);
    let z = vec3<f32>(beside, along);
    let y = vec3<f32>(beside.x, along, beside.y);
    return select(select(z, y, layer / 2u == 1u), vec3<f32>(along, beside), layer / 2u == 0u);
}

// Whether a point is behind what the map says. A directional light has no place, and so no map: it reaches all. Nor is
// anything hidden where no map is fed: that has one layer, and what is read beyond it is not looked at.
fn is_hidden_in_map(shadow_map: texture_2d_array<f32>, tiles: Tiles, light: Light, index: u32, point: vec3<f32>) -> bool {
    let away = point - light.position;
    let texel = map_texel(tiles, index, away);
    let is_mapped = light.kind != DIRECTIONAL && textureNumLayers(shadow_map) == 6u;
    let nearest = textureLoad(shadow_map, texel.xy, texel.z, 0).x;
    return is_mapped && dot(away, away) > nearest * nearest;
}
