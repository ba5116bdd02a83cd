// Light scattered once toward the eye along a ray through a homogeneous medium (airlight), by Gauss-Legendre quadrature.
//
//   x         distance from the eye along the ray, m
//   l         distance of the light from the eye, m
//   t         where the ray is nearest to the light (its foot), m; below 0 behind the eye
//   h         distance of the light from the ray, m, floored
//   s, r      x - t and the distance of the light from the point, sqrt(h^2 + s^2)
//   v         (r + s)/h = tan(pi/4 + theta/2), theta = atan(s/h) the angle at the light (the papers' theta)
//   rho       width of the phase function's lobe, see phase.wgsl
//   psi       angle of a node: v = rho tan(psi/2), 0..pi along an endless line
//   y         tan of half the way of a node from the middle of the interval in psi
//   sigma_t, sigma_s   extinction and scattering coefficient, 1/m
//
// With v, both optical paths and the scattering angle are rational: x + r = t + h v, mu = (1 - v^2)/(1 + v^2), and
//   L = sigma_s I/h * integral of p(mu) e^(-sigma_t (t + h v)) 2/(1 + v^2) dv
// (Hong 2006, eq. 4.3; Biri, Arques and Michelin 2006, eq. 4; both in theta). In psi a lobe is nearly constant:
//   Henyey-Greenstein   p 2/(1 + v^2) dv = (1 + rho)/(8 pi rho) sqrt(q) dpsi     q = cos^2(psi/2) + rho^2 sin^2(psi/2)
//   Schlick                              = 1/(4 pi rho) q dpsi
// and the isotropic and Rayleigh functions are the first with rho = 1, the latter and Cornette and Shanks times (1 + mu^2).

#import scene
#import medium
#import phase
#import cone
#import quadrature
#import ray

// Where a light stands beside a ray.
struct LightBesideRay {
    t: f32,
    h: f32,
    along: f32,                 // of a spot's axis, see cone.wgsl
    across: f32,
}

// h is floored at the light's radius, and at 1e-6 of the light's distance, as airlight grows like 1/h.
fn light_beside_ray(light: Light, ray: Ray) -> LightBesideRay {
    let to_light = light.position - ray.origin;
    let t = dot(to_light, ray.direction);
    // by cross products, as to_light - t * direction cancels near the light
    let away = cross(to_light, ray.direction);
    let foot_from_light = cross(away, ray.direction);
    let true_h = length(away);
    let h = max(max(true_h, light.radius), max(1e-6 * length(to_light), 1e-12));
    let across = dot(light.direction, foot_from_light) / max(true_h, 1e-30);
    return LightBesideRay(t, h, dot(light.direction, ray.direction), clamp(across, -1.0, 1.0));
}

// v of the point at s from the foot, without cancellation at either end.
fn v_of(s: f32, h: f32) -> f32 {
    let r = sqrt(h * h + s * s);
    return select(h / (r - s), (r + s) / h, s > 0.0);
}

// One lobe of a phase function: factor * q^(1/2 or 1) * (1 or 1 + mu^2).
struct Lobe {
    rho: f32,
    factor: f32,
    whole_power: bool,
    mu_squared: f32,            // 1 where the lobe has the factor 1 + mu^2, else 0
}

fn henyey_greenstein_lobe(rho: f32) -> Lobe {
    return Lobe(rho, (1.0 + rho) / (2.0 * FOUR_PI * rho), false, 0.0);
}

// The single lobe, or the first of two.
fn first_lobe(medium: Medium) -> Lobe {
    var lobe = henyey_greenstein_lobe(medium.rho1);
    switch medium.phase {
        case SCHLICK: { lobe = Lobe(medium.rho1, 1.0 / (FOUR_PI * medium.rho1), true, 0.0); }
        case RAYLEIGH: { lobe = Lobe(1.0, 0.75 / FOUR_PI, false, 1.0); }
        case CORNETTE_SHANKS: {
            lobe.factor *= 1.5 / (2.0 + medium.g1 * medium.g1);
            lobe.mu_squared = 1.0;
        }
        case DOUBLE_HENYEY_GREENSTEIN: { lobe.factor *= 1.0 - medium.weight; }
        default: {}
    }
    return lobe;
}

// Integral over v from start to start + width of one lobe times what is left of the light.
fn lobe_airlight(lobe: Lobe, light: Light, beside: LightBesideRay, extinction: vec3<f32>, start: f32, width: f32, nodes: u32) -> vec3<f32> {
    let end = start + width;
    let from_direction = normalize(vec2<f32>(lobe.rho, start));
    let to_direction = normalize(vec2<f32>(lobe.rho, end));
    let middle = normalize(from_direction + to_direction);
    let sine = lobe.rho * width * inverseSqrt(lobe.rho * lobe.rho + start * start) * inverseSqrt(lobe.rho * lobe.rho + end * end);
    let reach = sine / (1.0 + dot(from_direction, to_direction));
    let is_spot = light.kind == SPOT;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < nodes; i++) {
        let node = gauss_legendre(nodes, i);
        let y = reach * node.x;
        let c = middle.x - middle.y * y;
        let s = lobe.rho * (middle.y + middle.x * y);
        let b = 1.0 + y * y;
        let q = (c * c + s * s) / b;
        let v = s / c;
        let mu = (c * c - s * s) / (c * c + s * s);
        var value = node.y * select(sqrt(q), q, lobe.whole_power) * (1.0 + lobe.mu_squared * mu * mu) / b;
        if is_spot {
            let cosine = -mu * beside.along + 2.0 * c * s / (c * c + s * s) * beside.across;
            value *= pow(max(cosine, 1e-30), light.exponent);
        }
        sum += value * exp(-extinction * (beside.t + beside.h * v));
    }
    return 2.0 * reach * lobe.factor * sum;
}

// Optical depth beyond its value at the near end of the lit interval after which nothing is left that counts.
const DEPTH_MAX: f32 = 7.5;

fn interval_airlight(light: Light, beside: LightBesideRay, medium: Medium, start: f32, width: f32, nodes: u32) -> vec3<f32> {
    var sum = lobe_airlight(first_lobe(medium), light, beside, medium.extinction, start, width, nodes);
    if medium.phase == DOUBLE_HENYEY_GREENSTEIN {
        var lobe = henyey_greenstein_lobe(medium.rho2);
        lobe.factor *= medium.weight;
        sum += lobe_airlight(lobe, light, beside, medium.extinction, start, width, nodes);
    }
    return sum;
}

// Airlight of a point or spot light over `way` metres of the ray, W/(sr m^2).
fn point_airlight(light: Light, medium: Medium, ray: Ray, way: f32, nodes: u32) -> vec3<f32> {
    let least = least_extinction(medium);
    if least <= 0.0 || way <= 0.0 {
        return vec3<f32>(0.0);
    }
    let beside = light_beside_ray(light, ray);
    let x = min(way, 1e15);
    let s0 = -beside.t;
    let s1 = x - beside.t;
    let v0 = v_of(s0, beside.h);
    let v1 = v_of(s1, beside.h);
    let h2 = beside.h * beside.h;
    var start = v0;
    // v1 - v0 without cancellation
    var width = x * (v0 + v1) / (sqrt(h2 + s0 * s0) + sqrt(h2 + s1 * s1));
    width = min(width, DEPTH_MAX / (least * beside.h));
    var lit = Lit(1u, vec2<f32>(start, start + width), vec2<f32>(0.0));
    if light.kind == SPOT {
        lit = ray_in_cone(beside.along, beside.across, light.cos_cutoff);
    }
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < lit.count; i++) {
        let part = select(lit.second, lit.first, i == 0u);
        let part_start = max(part.x, start);
        let part_end = min(part.y, start + width);
        if part_end > part_start {
            let part_width = select(part_end - part_start, width, part.x <= start && part.y >= start + width);
            sum += interval_airlight(light, beside, medium, part_start, part_width, nodes);
        }
    }
    return medium.scattering * light.intensity / beside.h * sum;
}

// Airlight of a directional light, whose irradiance reaches every point unattenuated: albedo p E (1 - e^(-sigma_t x)).
fn directional_airlight(light: Light, medium: Medium, ray: Ray, way: f32) -> vec3<f32> {
    let half = 0.5 * (light.direction + ray.direction);
    let albedo = medium.scattering / max(medium.extinction, vec3<f32>(1e-30));
    let value = albedo * light.intensity * phase(medium, dot(half, half)) * opacity(medium.extinction * min(way, ENDLESS));
    return select(vec3<f32>(0.0), value, medium.extinction > vec3<f32>(0.0));
}

// Airlight of one light over `way` metres of the ray, infinite to the sky, W/(sr m^2).
fn airlight(light: Light, medium: Medium, ray: Ray, way: f32, nodes: u32) -> vec3<f32> {
    if light.kind == DIRECTIONAL {
        return directional_airlight(light, medium, ray, way);
    }
    return point_airlight(light, medium, ray, way, nodes);
}
