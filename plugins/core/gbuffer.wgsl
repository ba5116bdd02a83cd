// What each pixel's ray meets: distance, normal, material, from the triangle that was found to be visible.
//
// The ray goes through the pixel's centre, and its meeting with the triangle's plane is computed here, relative to the
// camera, so that distances do not depend on how a rasteriser interpolates.
#import scene
#import ray
#import colour

var<uniform> camera: Camera;
var<storage, read> vertices: Vertices;
var<storage, read> vertex_colors: VertexColors;
var<storage, read> triangles: Triangles;
var<storage, read> objects: Objects;
var<storage, read> materials: Materials;
var<storage, read> textures: Textures;
var<storage, read> texels: Texels;
var triangle: texture_2d<u32>;
var depth: texture_storage_2d<r32float, write>;
var normal: texture_storage_2d<rgba32float, write>;
var material: texture_storage_2d_array<rgba32float, write>;

fn infinity() -> f32 {
    // A constant expression may not be infinite in WGSL; a variable may.
    var bits = 0x7f800000u;
    return bitcast<f32>(bits);
}

fn store_nothing(at: vec2<u32>) {
    textureStore(depth, at, vec4(infinity()));
    textureStore(normal, at, vec4(0.0, 0.0, 0.0, 1.0));
    textureStore(material, at, 0, vec4(0.0));
    textureStore(material, at, 1, vec4(0.0, 0.0, 0.0, 1.0));
}

fn wrapped(at: i32, size: i32, mode: u32) -> i32 {
    switch mode {
        case WRAP_MIRROR: {
            let period = 2 * size;
            let m = ((at % period) + period) % period;
            return select(m, period - 1 - m, m >= size);
        }
        case WRAP_CLAMP: {
            return clamp(at, 0, size - 1);
        }
        default: {
            return ((at % size) + size) % size;
        }
    }
}

fn texel(t: Texture, at: vec2<i32>) -> vec4<f32> {
    let x = wrapped(at.x, i32(t.width), t.sampling & 3u);
    let y = wrapped(at.y, i32(t.height), (t.sampling >> 2u) & 3u);
    let packed = texels.items[t.offset + u32(y) * t.width + u32(x)];
    let unpacked = unpack4x8unorm(packed);
    return vec4(linear_from_srgb(unpacked.rgb), unpacked.a);
}

// The nearest texel, or bilinear between texel centres, of linear values; no mip levels, since nothing is anti-aliased.
fn texture_at(index: u32, uv: vec2<f32>) -> vec4<f32> {
    if index == NO_TEXTURE {
        return vec4(1.0);
    }
    let t = textures.items[index];
    let place = uv * vec2(f32(t.width), f32(t.height));
    if (t.sampling & SAMPLE_NEAREST) != 0u {
        return texel(t, vec2<i32>(floor(place)));
    }
    let at = place - 0.5;
    let corner = floor(at);
    let f = at - corner;
    let i = vec2<i32>(corner);
    let top = mix(texel(t, i), texel(t, i + vec2(1, 0)), f.x);
    let bottom = mix(texel(t, i + vec2(0, 1)), texel(t, i + vec2(1, 1)), f.x);
    return mix(top, bottom, f.y);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(depth);
    if any(id.xy >= size) {
        return;
    }
    let visible = textureLoad(triangle, id.xy, 0).r;
    if visible == 0u {
        store_nothing(id.xy);
        return;
    }
    let indices = triangles.items[visible - 1u];
    let direction = ray_of_pixel(camera, id.xy, size).direction;
    let va = vertices.items[indices.x];
    let vb = vertices.items[indices.y];
    let vc = vertices.items[indices.z];
    let a = va.position - camera.position;
    let ab = vb.position - va.position;
    let ac = vc.position - va.position;

    // Möller and Trumbore 1997: distance along the ray and barycentric coordinates of b and c.
    let p = cross(direction, ac);
    let inverse = 1.0 / dot(ab, p);
    let q = cross(-a, ab);
    let face = cross(ab, ac);
    let plane = dot(face, a) / dot(face, direction);
    // No point of the triangle is nearer or farther than its corners, whatever a grazing plane says outside of it.
    let corners = vec3(dot(a, direction), dot(a + ab, direction), dot(a + ac, direction));
    let t = clamp(plane, min(min(corners.x, corners.y), corners.z), max(max(corners.x, corners.y), corners.z));
    if !(t > 0.0 && t < 3e38) {
        store_nothing(id.xy);
        return;
    }
    // A pixel whose centre lies on an edge may miss its triangle by a rounding error.
    let u = clamp(dot(-a, p) * inverse, 0.0, 1.0);
    let v = clamp(dot(direction, q) * inverse, 0.0, 1.0 - u);

    // The side that the eye sees counts, whichever way the triangle is wound (two-sided surfaces).
    let toward_eye = face * select(1.0, -1.0, dot(face, direction) > 0.0);
    var n = normalize((1.0 - u - v) * va.normal + u * vb.normal + v * vc.normal);
    n *= select(1.0, -1.0, dot(n, toward_eye) < 0.0);

    let object = objects.items[indices.w];
    let m = materials.items[object.material];
    let uv = (1.0 - u - v) * vec2(va.u, va.v) + u * vec2(vb.u, vb.v) + v * vec2(vc.u, vc.v);
    let painted = texture_at(m.texture, uv);
    var diffuse = m.diffuse * painted.rgb;
    if vertex_colors.count > 0u {
        let a = vertex_colors.items[indices.x].rgb;
        let b = vertex_colors.items[indices.y].rgb;
        let c = vertex_colors.items[indices.z].rgb;
        diffuse *= (1.0 - u - v) * a + u * b + v * c;
    }
    var specular = m.specular;
    if m.peak > 0.0 {
        let metallic = m.metallic * painted.a;
        specular = m.peak * mix(vec3(0.04), diffuse, metallic);
        diffuse *= 1.0 - metallic;
        specular = min(specular, m.most * (1.0 - diffuse));
    }
    textureStore(depth, id.xy, vec4(t));
    textureStore(normal, id.xy, vec4(n, 1.0));
    textureStore(material, id.xy, 0, vec4(diffuse, f32(m.shininess_rank)));
    textureStore(material, id.xy, 1, vec4(specular, m.shininess));
}
