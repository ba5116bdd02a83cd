//! Quadrature: the Gauss-Legendre rules of `quadrature.wgsl`, and an adaptive rule that does not depend on them.

use std::f64::consts::PI;
use std::iter::Sum;
use std::ops::{Add, Mul, Sub};

use glam::{DVec3, DVec4};

/// Nodes on −1..1 and weights of the Gauss-Legendre rule with `n` nodes, by Newton's method.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..20 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=n {
                let next = ((2 * k - 1) as f64 * x * value - (k - 1) as f64 * before) / k as f64;
                before = value;
                value = next;
            }
            slope = n as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// What can be integrated: a number, or several at once.
pub trait Value: Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Sum {
    /// The largest part of its component of `whole` that any component is; 0 of a component that is 0.
    fn part_of(self, whole: Self) -> f64;
}

impl Value for f64 {
    fn part_of(self, whole: f64) -> f64 {
        if self == 0.0 { 0.0 } else { (self / whole).abs() }
    }
}

impl Value for DVec3 {
    fn part_of(self, whole: DVec3) -> f64 {
        largest_part(self.to_array(), whole.to_array())
    }
}

impl Value for DVec4 {
    fn part_of(self, whole: DVec4) -> f64 {
        largest_part(self.to_array(), whole.to_array())
    }
}

fn largest_part<const N: usize>(parts: [f64; N], wholes: [f64; N]) -> f64 {
    parts.into_iter().zip(wholes).map(|(part, whole)| part.part_of(whole)).fold(0.0, f64::max)
}

/// Integral of `f` over `a..b` to a relative error of about `tolerance` in every component: see [`integrate_pieces`].
pub fn integrate<V: Value>(f: impl Fn(f64) -> V, a: f64, b: f64, tolerance: f64) -> V {
    integrate_pieces(f, a, b, &[], tolerance)
}

/// The same of an `f` that is smooth only between `kinks`, by bisection of the worst parts (Gauss-Kronrod, 7 and 15 nodes).
/// No singularity is searched for: `f` should have no features narrower than 1/100 of the interval.
pub fn integrate_pieces<V: Value>(f: impl Fn(f64) -> V, a: f64, b: f64, kinks: &[f64], tolerance: f64) -> V {
    const PARTS_AT_FIRST: usize = 32;
    const PARTS_AT_MOST: usize = 20_000;
    let even = (0..=PARTS_AT_FIRST).map(|i| a + (b - a) * i as f64 / PARTS_AT_FIRST as f64);
    let within = kinks.iter().copied().filter(|kink| (*kink - a) * (*kink - b) < 0.0);
    let mut edges: Vec<f64> = even.chain(within).collect();
    edges.sort_unstable_by(|x, y| if a <= b { x.total_cmp(y) } else { y.total_cmp(x) });
    let mut parts: Vec<Part<V>> = edges.array_windows().map(|[a, b]| Part::new(&f, *a, *b)).collect();
    loop {
        let sum: V = parts.iter().map(|part| part.value).sum();
        let error: f64 = parts.iter().map(|part| part.error.part_of(sum)).sum();
        if error <= tolerance || parts.len() >= PARTS_AT_MOST {
            return sum;
        }
        let limit = 0.25 * error / parts.len() as f64;
        parts = parts.into_iter().flat_map(|part| part.refined(&f, sum, limit)).collect();
    }
}

struct Part<V> {
    a: f64,
    b: f64,
    value: V,
    error: V,
}

impl<V: Value> Part<V> {
    fn new(f: &impl Fn(f64) -> V, a: f64, b: f64) -> Self {
        let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
        let (mut kronrod, mut gauss) = (V::default(), V::default());
        for (i, &(x, weight, gauss_weight)) in KRONROD.iter().enumerate() {
            let value = if i == 7 { f(middle) } else { f(middle - half * x) + f(middle + half * x) };
            kronrod = kronrod + value * weight;
            gauss = gauss + value * gauss_weight;
        }
        Part { a, b, value: kronrod * half, error: (kronrod - gauss) * half }
    }

    /// Itself, or its halves where its error is a larger part of the sum than the limit and it can still be halved.
    fn refined(self, f: &impl Fn(f64) -> V, sum: V, limit: f64) -> Vec<Self> {
        let middle = (self.a + self.b) / 2.0;
        if self.error.part_of(sum) <= limit || middle <= self.a || middle >= self.b {
            return vec![self];
        }
        vec![Part::new(f, self.a, middle), Part::new(f, middle, self.b)]
    }
}

/// Node, its weight in the 15-point rule, and in the 7-point rule (Piessens et al. 1983, QUADPACK, qk15).
const KRONROD: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_22, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_67),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_41, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_37),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn rules_integrate_polynomials() {
        for n in 2..=16 {
            let rule = gauss_legendre(n);
            for power in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, weight)| weight * x.powi(power as i32)).sum();
                let expected = if power % 2 == 0 { 2.0 / (power + 1) as f64 } else { 0.0 };
                assert!((sum - expected).abs() < 1e-13, "{n} nodes, power {power}");
            }
        }
    }

    #[test]
    fn the_adaptive_rule_reaches_its_tolerance() {
        let peak = integrate(|x| 1e-3 / (x * x + 1e-6), -1.0, 1.0, 1e-12);
        assert!((peak - 2.0 * (1000.0_f64).atan()).abs() < 1e-11);
        assert!((integrate(f64::exp, 0.0, 1.0, 1e-12) - 1f64.exp_m1()).abs() < 1e-14);
    }

    #[test]
    fn every_component_reaches_the_tolerance() {
        let peaks = |x: f64| DVec3::new(1.0, 1e-9 / (x * x + 1e-6), 0.0);
        let found = integrate(peaks, -1.0, 1.0, 1e-12);
        assert!((found.x - 2.0).abs() < 1e-14 && found.z == 0.0);
        assert!((found.y / (2e-6 * (1000.0_f64).atan()) - 1.0).abs() < 1e-11);
    }

    /// No bisection finds a kink as closely as it is told: with it, the first parts are right.
    #[test]
    fn pieces_are_integrated_each_by_itself() {
        let evaluations = Cell::new(0);
        let hat = |x: f64| {
            evaluations.set(evaluations.get() + 1);
            1.0 - (x - 0.3).abs()
        };
        let expected = 1.0 - (0.3 * 0.3 + 0.7 * 0.7) / 2.0;
        for (a, b, sign) in [(0.0, 1.0, 1.0), (1.0, 0.0, -1.0)] {
            evaluations.set(0);
            let found = integrate_pieces(hat, a, b, &[0.3, 7.0], 1e-13);
            assert!((found - sign * expected).abs() < 1e-15);
            assert_eq!(evaluations.get(), 33 * 15);
        }
    }

    /// The table of the shader holds these rules, one after another.
    #[test]
    fn the_table_of_the_shader_is_this_one() {
        let text = include_str!("quadrature.wgsl");
        let numbers: Vec<f64> = text
            .lines()
            .filter_map(|line| line.trim().strip_prefix("vec2<f32>(")?.strip_suffix("),"))
            .flat_map(|pair| pair.split(',').map(|number| number.trim().parse().expect("a number")))
            .collect();
        let expected: Vec<f64> = (2..=16).flat_map(gauss_legendre).flat_map(|(x, weight)| [x, weight]).collect();
        assert_eq!(numbers.len(), expected.len());
        for (number, expected) in numbers.iter().zip(&expected) {
            assert!((number - expected).abs() < 1e-9);
        }
    }
}
