// Light that a surface reflects toward the eye: straight from a light, and scattered once by the medium before.
//
//   rho         Lambert reflectance; the BRDF is rho/pi
//   k_s, n      Phong lobe
//   d           distance of the light from the surface, m
//   T           optical depth of that way, sigma_t d; a table has it as its coordinate, so density does not change it
//   theta       angle between the way to the light and the axis of a lobe: the normal (Lambert), the mirrored view ray (Phong)
//   w           sin^2(theta/2)
//   J^n(T, theta)   the lobe max(0, cos)^n over the light that the medium scatters to the surface (Hong 2006, eqs. 4.13
//               and 4.14): radiance is I sigma_s/d (rho/pi J^1 + k_s J^n). n = 1 is Lambert's
//   S^n(theta)  the same of a directional light, whose irradiance E is the same everywhere: E albedo (rho/pi S^1 + k_s S^n)
//
//   psi         angle at a spot between its axis and the way to the surface; N its exponent
//   A(T, psi)   what a spot scatters to a point from all around, of what a point light of its intensity on the axis would
//
// The thesis leaves out the albedo and 1/pi, and has J for theta up to 90 degrees only, where back faces are not yet dark.
//
// A spot's light is taken as a point light's times A: right in the mean over all normals, and in the colour; how a narrow
// beam bends the light to its side is left out. By the symmetry of light's path (from the light and from the surface,
// directions at the same angle to the way between them are alike) A is a convolution of the same field:
// A = J of the lobe that the spot sends, at psi, over that of the whole sphere.
//
// A table has a layer for each lobe, Lambert's first. Its texels are cells between angles (x) and depths (y); the last row is
// S. A texel holds the corners of its cell, so that one load is enough:
//   (T0, theta0), (T0, theta1), (T1, theta0), (T1, theta1)
// of e^T J (n+1)/(2 pi) and of S (n+1)/(2 pi), which change little; of a spot's lobe, of A.

#import scene
#import medium
#import lights

// Depths are spaced evenly below the first and in equal ratios above it, as J goes like T ln T near 0. Beyond the last
// one no light is left.
const FIRST_DEPTH: f32 = 0.02;
const LAST_DEPTH: f32 = 40.0;

// What the medium scatters to a point stands at nodes of ln tan(gamma/2), gamma the angle to the light: the first, and from
// one to the next.
const FIRST_NODE: f32 = -12.5;
const NODE_STEP: f32 = 0.075;

// Of T, among `cells` cells: 0..cells.
fn depth_coordinate(depth: vec3<f32>, cells: f32) -> vec3<f32> {
    return log2(1.0 + min(depth, vec3<f32>(LAST_DEPTH)) / FIRST_DEPTH) * (cells / log2(1.0 + LAST_DEPTH / FIRST_DEPTH));
}

// T of a coordinate.
fn depth_at(coordinate: f32, cells: f32) -> f32 {
    return FIRST_DEPTH * (exp2(coordinate / cells * log2(1.0 + LAST_DEPTH / FIRST_DEPTH)) - 1.0);
}

// Angles in sin(theta/2): spaced evenly within the lobe, whose width this is, and in equal ratios outside.
fn lobe_width(n: f32, cos_cutoff: f32) -> f32 {
    return max(min(inverseSqrt(max(n, 1.0)), sqrt(0.5 - 0.5 * cos_cutoff)), 1e-3);
}

// The coordinate of an angle is toward log2(1 + u factor) + away u^4, u = sin(theta/2): half the cells are in equal ratios
// around the light, half away from it, where a directional light may be seen through a backward peak.
struct AngleAxis {
    factor: f32,
    toward: f32,
    away: f32,
}

fn angle_axis(width: f32, cells: f32) -> AngleAxis {
    let factor = 1.0 / width;
    return AngleAxis(factor, 0.5 * cells / log2(1.0 + factor), 0.5 * cells);
}

fn angle_coordinate(axis: AngleAxis, sine_of_half: f32) -> f32 {
    let square = sine_of_half * sine_of_half;
    return axis.toward * log2(1.0 + sine_of_half * axis.factor) + axis.away * square * square;
}

// sin(theta/2) of a coordinate, by bisection.
fn sine_of_half_at(axis: AngleAxis, coordinate: f32) -> f32 {
    var low = 0.0;
    var width = 1.0;
    for (var i = 0u; i < 24u; i++) {
        width *= 0.5;
        low += select(0.0, width, angle_coordinate(axis, low + width) <= coordinate);
    }
    return low;
}

// A lobe and its layer of the table.
struct Lookup {
    axis: vec3<f32>,            // unit vector
    layer: u32,
    angles: AngleAxis,
    factor: f32,                // of what the table holds
}

// Of a BRDF's lobe.
fn lookup_of(axis: vec3<f32>, layer: u32, n: f32, table: texture_2d_array<f32>) -> Lookup {
    return Lookup(axis, layer, angle_axis(lobe_width(n, -1.0), f32(textureDimensions(table).x)), 2.0 * PI / (n + 1.0));
}

// Of A.
fn lookup_of_spot(light: Light, layer: u32, table: texture_2d_array<f32>) -> Lookup {
    let width = lobe_width(light.exponent, light.cos_cutoff);
    return Lookup(-light.direction, layer, angle_axis(width, f32(textureDimensions(table).x)), 1.0);
}

// Rows of the table for the three channels, and how far between their depths.
struct Rows {
    cell: vec3<u32>,
    within: vec3<f32>,
}

fn rows_of(depth: vec3<f32>, is_sun: bool, table: texture_2d_array<f32>) -> Rows {
    let cells = textureDimensions(table).y - 1u;
    let at = depth_coordinate(depth, f32(cells));
    let cell = min(vec3<u32>(at), vec3<u32>(cells - 1u));
    return Rows(select(cell, vec3<u32>(cells), is_sun), at - vec3<f32>(cell));
}

fn cell_value(corners: vec4<f32>, across: f32, down: f32) -> f32 {
    let rows = mix(corners.xz, corners.yw, across);
    return mix(rows.x, rows.y, down);
}

// e^T J, or S, or A, of the three channels.
fn convolution(lookup: Lookup, to_light: vec3<f32>, rows: Rows, table: texture_2d_array<f32>) -> vec3<f32> {
    // half the distance of unit vectors is the sine of half their angle
    let sine_of_half = min(0.5 * length(lookup.axis - to_light), 1.0);
    let at = angle_coordinate(lookup.angles, sine_of_half);
    let cell = min(u32(at), textureDimensions(table).x - 1u);
    let within = at - f32(cell);
    let red = textureLoad(table, vec2<u32>(cell, rows.cell.x), lookup.layer, 0);
    let green = textureLoad(table, vec2<u32>(cell, rows.cell.y), lookup.layer, 0);
    let blue = textureLoad(table, vec2<u32>(cell, rows.cell.z), lookup.layer, 0);
    return lookup.factor * vec3<f32>(cell_value(red, within, rows.within.x), cell_value(green, within, rows.within.y),
        cell_value(blue, within, rows.within.z));
}

// How a point of a surface reflects.
struct Surface {
    position: vec3<f32>,        // m
    rho: vec3<f32>,
    k_s: vec3<f32>,
    n: f32,
    lambert: Lookup,            // about the normal, turned to the eye
    phong: Lookup,              // about the mirrored view ray
}

// Radiance that leaves the surface toward the eye, W/(sr m^2), not attenuated on that way. `spot_layer` is that of a spot.
fn reflected(light: Light, spot_layer: u32, medium: Medium, surface: Surface, direct: bool, scattered: bool, table: texture_2d_array<f32>) -> vec3<f32> {
    let incident = incident_light(light, surface.position);
    var sum = vec3<f32>(0.0);
    if direct {
        sum = direct_share(surface.rho, surface.k_s, surface.n, surface.lambert.axis, surface.phong.axis, incident.to_light) * incident.irradiance;
    }
    if scattered {
        let is_sun = light.kind == DIRECTIONAL;
        let rows = rows_of(medium.extinction * incident.way, is_sun, table);
        let lambert = convolution(surface.lambert, incident.to_light, rows, table);
        let phong = convolution(surface.phong, incident.to_light, rows, table);
        // I sigma_s/d as a part of I/d^2; without a way, E albedo as a part of E
        let scattering = select(medium.scattering * incident.way, albedo(medium), is_sun);
        let of_spot = convolution(lookup_of_spot(light, spot_layer, table), incident.to_light, rows, table);
        let all_around = select(vec3<f32>(1.0), of_spot, light.kind == SPOT);
        sum += scattering * (surface.rho / PI * lambert + surface.k_s * phong) * all_around * incident.on_axis;
    }
    return sum * transmittance(medium, incident.way);
}
