// A spot's cone of light, and the part of a ray that lies in it.
//
//   axis      unit vector, the way the spot shines
//   c         cosine of the cutoff, a half-angle below 180 degrees
//   N         exponent of the spot's cos^N
//   along     component of the axis along the ray
//   across    component of the axis along the way from the light to the foot, the ray's nearest point to the light.
//             What is left of the axis is out of the plane of light and ray: along^2 + across^2 = cos^2(delta)
//   v         place on the ray, tan(pi/4 + theta/2), theta the angle at the light from the foot, growing along the ray
//
// cos(psi), psi between axis and way to the point, is cos(delta) cos(theta + alpha), so in v
//   cos(psi) = (along (v^2 - 1) + 2 across v) / (1 + v^2)
// The thesis (Hong 2006, section 6.2.1) leaves cos(delta) out, which is right only where the axis lies in the plane.

#import scene

// I / I_0 of a spot where the angle with its axis has this cosine: cos^N inside the cutoff, 0 outside. Beyond 90 degrees
// from the axis only a spot with N = 0 shines.
fn spot_falloff(light: Light, cosine: f32) -> f32 {
    let inside = cosine >= light.cos_cutoff && (cosine > 0.0 || light.exponent == 0.0);
    return select(0.0, pow(max(cosine, 1e-30), light.exponent), inside);
}

// The parts of a ray that lie in a cone: 0 to 2 intervals of v, none of them empty.
struct Lit {
    count: u32,
    first: vec2<f32>,
    second: vec2<f32>,
}

// The largest v there is: its square must stay finite.
const V_MAX: f32 = 1e18;

// The parts of 0 <= v <= V_MAX with cos(psi) >= c: the roots of (along - c) v^2 + 2 across v - (along + c) = 0, in the form
// that does not cancel. Two intervals need a cone wider than a half-space (c < 0), whose dark rest is a cone.
fn ray_in_cone(along: f32, across: f32, c: f32) -> Lit {
    let discriminant = along * along + across * across - c * c;
    if discriminant <= 0.0 {
        return Lit(select(0u, 1u, c < 0.0), vec2<f32>(0.0, V_MAX), vec2<f32>(0.0));
    }
    let root = sqrt(discriminant);
    let q = -(across + select(-root, root, across >= 0.0));
    let a = along - c;
    let b = -(along + c);
    // v = q/a and v = b/q; where a is 0 the first root is at infinity
    let divisor = select(min(a, -1e-30), a, a > 1e-30);
    let v1 = clamp(q / divisor, -V_MAX, V_MAX);
    let v2 = clamp(b / q, -V_MAX, V_MAX);
    let low = max(min(v1, v2), 0.0);
    let high = max(max(v1, v2), 0.0);
    if a <= 0.0 {                // lit between the roots
        return Lit(select(0u, 1u, high > low), vec2<f32>(low, high), vec2<f32>(0.0));
    }
    if low <= 0.0 {              // lit beyond the upper root only
        return Lit(1u, vec2<f32>(high, V_MAX), vec2<f32>(0.0));
    }
    return Lit(2u, vec2<f32>(0.0, low), vec2<f32>(high, V_MAX));
}
