// A spot's cone of light, and the parts of a ray that lie in it.
//
//   axis      unit vector, the way the spot shines
//   psi       angle between the axis and the way from the light to a point
//   c         cosine of the cutoff, a half-angle below 180 degrees
//   N         exponent of the spot's cos^N
//   along     component of the axis along the ray
//   across    component of the axis along the way from the light to the foot, the ray's nearest point to the light.
//   tilt      what is left of the axis, out of the plane of light and ray: along^2 + across^2 = cos^2(delta) = 1 - tilt^2
//   v         place on the ray, tan(pi/4 + theta/2), theta the angle at the light from the foot, growing along the ray
//
// cos(psi) = cos(delta) cos(theta + alpha), so in v
//   cos(psi) = (along (v^2 - 1) + 2 across v)/(1 + v^2)
// The thesis (Hong 2006, section 6.2.1) leaves cos(delta) out, which is right only where the axis lies in the plane.

#import scene

// Angles, rad.
const PI: f32 = 3.14159265359;
const HALF_PI: f32 = 1.57079632679;
const QUARTER_PI: f32 = 0.78539816340;

// I/I_0 of a spot where the angle with its axis has this cosine: cos^N inside the cutoff (90 degrees at most), 0 outside.
fn spot_falloff(light: Light, cosine: f32) -> f32 {
    return select(0.0, pow(max(cosine, 1e-30), light.exponent), cosine >= light.cos_cutoff);
}

// The lit parts of a ray, in v, each from x to y, in order.
struct SpotBesideRay {
    along: f32,
    across: f32,
    first: vec2<f32>,           // an empty part has x >= y
    second: vec2<f32>,
}

// cos^N is left out where it is below 2^-30 of its largest value on the ray, so that nodes stand where the light is.
const FALLOFF_BITS: f32 = 30.0;

// Of the ray from v0 to v1. `from_light` is the unit vector from the light to the foot; `depth_of_v` the optical depth of
// one unit of v: it moves what counts to the near end, so more of a tail there is kept.
fn spot_beside_ray(light: Light, direction: vec3<f32>, from_light: vec3<f32>, v0: f32, v1: f32, depth_of_v: f32) -> SpotBesideRay {
    let along = dot(light.direction, direction);
    let across = clamp(dot(light.direction, from_light), -1.0, 1.0);
    // v of the peak, tan(pi/4 + atan2(along, across)/2), at an end of the ray where across < 0
    let m = sqrt(along * along + across * across);
    let toward = max(across, 0.0);
    let peak = select(m + along, toward, along < 0.0) / max(select(toward, m - along, along < 0.0), 1e-30);
    let v = clamp(peak, v0, v1);
    let q = 1.0 / (1.0 + v * v);
    let highest = max(along * (1.0 - 2.0 * q) + 2.0 * across * v * q, 0.0);
    let bits = FALLOFF_BITS + 1.4427 * depth_of_v * (v - v0);
    // an exponent of 0 is not looked at
    let lowest = highest * exp2(-bits / light.exponent);
    // a ray that meets the light has no foot beside it: what is not along it counts as tilt
    let meets = dot(from_light, from_light) < 0.5;
    let tilt = select(dot(light.direction, cross(direction, from_light)), sqrt(max(1.0 - along * along, 0.0)), meets);
    let faint = light.exponent > 0.0 && lowest > light.cos_cutoff;
    let cutoff = select(vec2<f32>(light.cos_cutoff, light.sin_cutoff), vec2<f32>(lowest, sqrt(max(1.0 - lowest * lowest, 0.0))), faint);
    let lit = ray_in_cone(along, across, tilt, cutoff.x, cutoff.y);
    return SpotBesideRay(along, across, lit.first, lit.second);
}

// The largest v there is: its square must stay finite.
const V_MAX: f32 = 1e18;

struct Lit {
    first: vec2<f32>,           // an empty part has x >= y
    second: vec2<f32>,
}

// The parts of 0 <= v <= V_MAX with cos(psi) >= c: the roots of (along - c) v^2 + 2 across v - (along + c) = 0, in the form
// that does not cancel. Two parts need a cone wider than a half-space (c < 0), whose dark rest is a cone. `sine` is of the
// cutoff, as along^2 + across^2 - c^2 of a narrow cone would cancel: sine^2 - tilt^2 is the same.
fn ray_in_cone(along: f32, across: f32, tilt: f32, c: f32, sine: f32) -> Lit {
    let nothing = vec2<f32>(0.0);
    let discriminant = (sine - abs(tilt)) * (sine + abs(tilt));
    if discriminant <= 0.0 {
        return Lit(select(nothing, vec2<f32>(0.0, V_MAX), c < 0.0), nothing);
    }
    let root = sqrt(discriminant);
    let q = -(across + select(-root, root, across >= 0.0));
    let a = along - c;
    // v = q/a and v = -(along + c)/q; where a is 0 the first root is at infinity
    let v1 = clamp(q / select(min(a, -1e-30), a, a > 1e-30), -V_MAX, V_MAX);
    let v2 = clamp(-(along + c) / q, -V_MAX, V_MAX);
    let low = max(min(v1, v2), 0.0);
    let high = max(max(v1, v2), 0.0);
    if a <= 0.0 {                // lit between the roots
        return Lit(vec2<f32>(low, high), nothing);
    }
    if low <= 0.0 {              // lit beyond the upper root only
        return Lit(vec2<f32>(high, V_MAX), nothing);
    }
    return Lit(vec2<f32>(0.0, low), vec2<f32>(high, V_MAX));
}
