//! Light that a surface reflects toward the eye, straight from a light and scattered once by the medium before: twin of
//! `reflection.wgsl`, by brute force.
//!
//! Scattered light comes from every direction ω, as much as the airlight that an eye at the surface would see there, with
//! nothing in its way. What a surface makes of it are convolutions with max(0, cos)ⁿ: about the normal with n = 1
//! (Lambert), and about the mirrored view ray with the shininess (Phong; not clipped by the surface).

use crate::airlight::airlight;
use crate::lights::incident;
use crate::medium::transmittance;
use crate::phase::phase;
use crate::quadrature::gauss_legendre;
use crate::ray::Ray;
use crate::scene::{Light, Medium, Phase};
use glam::DVec3;
use std::f64::consts::PI;
use std::rc::Rc;
use std::sync::LazyLock;

/// A point of a surface and how it reflects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// m.
    pub position: DVec3,
    /// Unit vector, turned to the eye.
    pub normal: DVec3,
    /// Unit vector: the view ray mirrored at the surface.
    pub mirrored: DVec3,
    /// Lambert reflectance ρ; the BRDF is ρ/π.
    pub diffuse: DVec3,
    /// k_s of the Phong lobe.
    pub specular: DVec3,
    /// n of the Phong lobe.
    pub shininess: f64,
}

/// Radiance that leaves the surface toward the eye, W/(sr m²): what the light sends straight and what the medium scatters
/// to it. Not attenuated on the way to the eye.
pub fn reflected(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    direct(light, medium, surface) + scattered(light, medium, surface)
}

/// The part that comes straight from the light: Hong 2006, eq. 4.12, with the BRDF ρ/π; 0 where the light is behind.
pub fn direct(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    let incident = incident(light, surface.position);
    let cosine = surface.normal.dot(incident.to_light);
    if cosine <= 0.0 {
        return DVec3::ZERO;
    }
    let lobe = surface.mirrored.dot(incident.to_light).max(0.0).powf(surface.shininess);
    let brdf = surface.diffuse / PI * cosine + surface.specular * lobe;
    brdf * incident.irradiance * transmittance(medium, incident.way)
}

/// The part that the medium scattered once: Hong 2006, eq. 4.15, with the albedo that it leaves out and the BRDF ρ/π,
/// `I·σ_s/d·(ρ/π·J¹ + k_s·Jⁿ)`. Of a directional light, which is not attenuated, `E·albedo·(ρ/π·S¹ + k_s·Sⁿ)`.
/// A spot is integrated direction by direction, to a relative error of about 1e-3.
pub fn scattered(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    match *light {
        Light::Spot { .. } => scattered_from_all_around(light, medium, surface),
        Light::Point { intensity, .. } => {
            let incident = incident(light, surface.position);
            let field = |sigma: f64| Rc::new(Field::of_point(&medium.phase, sigma * incident.way));
            // channels of one extinction see one field
            let [r, g, b] = medium.extinction.to_array();
            let red = field(r);
            let green = if g == r { red.clone() } else { field(g) };
            let blue = if b == g { green.clone() } else { field(b) };
            intensity * medium.scattering() / incident.way * surface.terms(incident.to_light, &[red, green, blue])
        }
        Light::Directional { direction, irradiance } => {
            let field = Rc::new(Field::of_sun(&medium.phase));
            let lit = DVec3::from_array(medium.extinction.to_array().map(|sigma| f64::from(sigma > 0.0)));
            lit * medium.albedo * irradiance * surface.terms(-direction, &[field.clone(), field.clone(), field])
        }
    }
}

impl Surface {
    /// ρ/π·J¹ + k_s·Jⁿ of the three channels.
    fn terms(&self, to_light: DVec3, fields: &[Rc<Field>; 3]) -> DVec3 {
        let lobe = |factor: DVec3, n: f64, axis: DVec3| {
            let theta = axis.angle_between(to_light);
            let channel = |i: usize| if factor[i] == 0.0 { 0.0 } else { factor[i] * fields[i].over_lobe(n, theta) };
            DVec3::new(channel(0), channel(1), channel(2))
        };
        lobe(self.diffuse / PI, 1.0, self.normal) + lobe(self.specular, self.shininess, self.mirrored)
    }
}

/// Jⁿ(T, θ) = ∫ F(T, γ)·max(0, cos)ⁿ dω (Hong 2006, eqs. 4.13 and 4.14): of the radiance around a point in a medium at the
/// optical depth T from a point light, `I·σ_s/d·F`, with a lobe whose axis is θ (radians) from the way to the light.
pub fn convolution(kind: &Phase, n: f64, depth: f64, theta: f64) -> f64 {
    Field::of_point(kind, depth).over_lobe(n, theta)
}

/// Sⁿ(θ) = ∫ p·max(0, cos)ⁿ dω: the same of a directional light of irradiance E, around which the radiance is albedo·p·E.
pub fn sun_convolution(kind: &Phase, n: f64, theta: f64) -> f64 {
    Field::of_sun(kind).over_lobe(n, theta)
}

/// What the medium scatters to a point from all around, as a function of the angle γ to the light alone.
///
/// Right to six digits for lobes of n up to 10⁴.
pub struct Field {
    /// F·sin γ at each of [`ANGLES`], times the width that it stands for.
    glows: Vec<f64>,
}

impl Field {
    /// Around a point at this optical depth from a point light.
    pub fn of_point(kind: &Phase, depth: f64) -> Self {
        Self::new(|gamma| glow(kind, depth, gamma))
    }

    /// Of a directional light.
    pub fn of_sun(kind: &Phase) -> Self {
        Self::new(|gamma| phase(kind, (gamma / 2.0).sin().powi(2)) * gamma.sin())
    }

    fn new(around: impl Fn(f64) -> f64) -> Self {
        Self { glows: ANGLES.iter().map(|(gamma, width)| width * around(*gamma)).collect() }
    }

    /// ∫ F·max(0, cos)ⁿ dω about an axis at the angle θ from the way to the light.
    pub fn over_lobe(&self, n: f64, theta: f64) -> f64 {
        self.over(&LobeOverCircles::new(n, theta))
    }

    /// The same, of a lobe that serves many fields.
    pub fn over(&self, lobe: &LobeOverCircles) -> f64 {
        let lit = &self.glows[lobe.first..lobe.first + lobe.sums.len()];
        lit.iter().zip(&lobe.sums).map(|(glow, sum)| glow * sum).sum()
    }

    /// ∫ F dω: the light that comes from all around.
    pub fn all_around(&self) -> f64 {
        2.0 * PI * self.glows.iter().sum::<f64>()
    }
}

/// γ, and the width that it stands for, of the integral over a [`Field`]: panels that grow from the light outward as far as
/// the sharpest lobe bears.
static ANGLES: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let mut edges = vec![0.0, 1e-6];
    while let Some(last) = edges.last().copied().filter(|last| *last < PI) {
        edges.push((2.0 * last).min(last + 0.02).min(PI));
    }
    let rule = gauss_legendre(8);
    let node = |[a, b]: [f64; 2], (x, weight): (f64, f64)| (a + (b - a) * 0.5 * (x + 1.0), 0.5 * (b - a) * weight);
    edges.array_windows::<2>().flat_map(|panel| rule.iter().map(|at| node(*panel, *at)).collect::<Vec<_>>()).collect()
});

/// max(0, cos)ⁿ about an axis, integrated over each circle around the way to the light. No field has a part in it.
pub struct LobeOverCircles {
    /// Of [`ANGLES`], the first that the lobe reaches.
    first: usize,
    sums: Vec<f64>,
}

impl LobeOverCircles {
    /// `theta` (radians) is the angle between the axis and the way to the light.
    pub fn new(n: f64, theta: f64) -> Self {
        let before = |gamma: f64| gamma <= theta - reach(n);
        let first = ANGLES.partition_point(|(gamma, _)| before(*gamma));
        let lit = ANGLES[first..].iter().take_while(|(gamma, _)| *gamma < theta + reach(n));
        Self { first, sums: lit.map(|(gamma, _)| azimuthal_sum(n, theta, *gamma)).collect() }
    }
}

/// Where cosⁿ is below 1e-14, an angle from its axis; at most a right angle.
fn reach(n: f64) -> f64 {
    (-32.0 / n.max(1e-3)).exp().clamp(0.0, 1.0).acos()
}

/// sin γ·F(T, γ): of the airlight on an endless ray that makes the angle γ with the way to the light, with h = d·sin γ,
/// `∫ p·e^(−T·(cos γ + sin γ·v))·2/(1 + v²) dv` from v = tan(γ/2) on, see the glossary of `airlight_pieces.wgsl`.
pub fn glow(kind: &Phase, depth: f64, gamma: f64) -> f64 {
    glow_of(|w| phase(kind, w), depth, gamma)
}

/// The same of any phase function, given at w.
pub fn glow_of(phase: impl Fn(f64) -> f64, depth: f64, gamma: f64) -> f64 {
    let start = (gamma / 2.0).tan();
    let rate = depth * gamma.sin();
    let at = |x: &f64| {
        let v = start + x;
        let w = if v > 1e8 { 1.0 } else { v * v / (1.0 + v * v) };
        phase(w) * (-rate * x).exp() * 2.0 * x / (1.0 + v * v)
    };
    // e^-745 is 0
    let lit = GLOW_NODES.iter().take_while(|x| rate * **x < 745.0);
    (-depth).exp() * STEP * lit.map(at).sum::<f64>()
}

/// Of ln(v - start): what lies between two values or beyond the last ones is less than 1e-9.
const STEP: f64 = 0.1;

/// v - start, in equal steps of its logarithm, in which all scales are alike, so that they reach any precision.
static GLOW_NODES: LazyLock<Vec<f64>> = LazyLock::new(|| (-220..=220).map(|i| (STEP * f64::from(i)).exp()).collect());

/// ∫ max(0, cos γ·cos θ + sin γ·sin θ·cos φ)ⁿ dφ around the way to the light.
fn azimuthal_sum(n: f64, theta: f64, gamma: f64) -> f64 {
    let (a, b) = (gamma.cos() * theta.cos(), gamma.sin() * theta.sin());
    let horizon = if b <= a.abs() { if a > 0.0 { PI } else { 0.0 } } else { (-a / b).acos() };
    if n == 1.0 {
        return 2.0 * (a * horizon + b * horizon.sin());
    }
    // no further than where the lobe is lost beside its largest value
    let least = (a + b) * (-32.0 / n.max(1e-3)).exp();
    let end = if b <= 0.0 { PI } else { ((least - a) / b).clamp(-1.0, 1.0).acos() }.min(horizon);
    let at = |phi: f64| (a + b * phi.cos()).max(0.0).powf(n);
    RULE.with(|rule| rule.iter().map(|(x, weight)| end * weight * at(0.5 * end * (x + 1.0))).sum())
}

thread_local! {
    static RULE: Vec<(f64, f64)> = gauss_legendre(40);
}

/// Any light, direction by direction: the airlight of `airlight.rs` in each, in polar coordinates about the way to the
/// light, where it is integrable.
pub fn scattered_from_all_around(light: &Light, medium: &Medium, surface: &Surface) -> DVec3 {
    let to_light = incident(light, surface.position).to_light;
    let lobe = |factor: DVec3, n: f64, axis: DVec3| {
        if factor == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let around =
            |direction| airlight(light, medium, &Ray { origin: surface.position, direction }, 0.0, f64::INFINITY);
        factor * lobe_of_directions(n, axis, to_light, around)
    };
    lobe(surface.diffuse / PI, 1.0, surface.normal) + lobe(surface.specular, surface.shininess, surface.mirrored)
}

fn lobe_of_directions(n: f64, axis: DVec3, pole: DVec3, around: impl Fn(DVec3) -> DVec3) -> DVec3 {
    let theta = axis.angle_between(pole);
    let across = (axis - pole * axis.dot(pole)).try_normalize().unwrap_or_else(|| pole.any_orthonormal_vector());
    let side = pole.cross(across);
    let (low, high) = ((theta - reach(n)).max(0.0), (theta + reach(n)).min(PI));
    RULE.with(|rule| {
        let mut sum = DVec3::ZERO;
        for (x, weight) in rule {
            // nodes crowd at the pole
            let t = 0.5 * (x + 1.0);
            let gamma = low + (high - low) * t * t;
            let (a, b) = (gamma.cos() * theta.cos(), gamma.sin() * theta.sin());
            let least = (a + b).max(0.0) * (-32.0 / n.max(1e-3)).exp();
            let end = if b <= 0.0 { PI } else { ((least - a) / b).clamp(-1.0, 1.0).acos() };
            for (y, part) in rule {
                let phi = end * y;
                let direction = pole * gamma.cos() + (across * phi.cos() + side * phi.sin()) * gamma.sin();
                let kernel = direction.dot(axis).max(0.0).powf(n);
                sum += around(direction) * (kernel * gamma.sin() * weight * part * end * (high - low) * t);
            }
        }
        sum
    })
}
