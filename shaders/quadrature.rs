//! Quadrature: the Gauss-Legendre rules of `quadrature.wgsl`, and an adaptive rule that does not depend on them.

use std::f64::consts::PI;

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

/// Integral of `f` over `a..b` to a relative error of about `tolerance`, by bisection of the worst part (Gauss-Kronrod,
/// 7 and 15 nodes). No singularity is searched for: `f` should be smooth, its parts no narrower than 1/100 of the interval.
pub fn integrate(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    const PARTS_AT_FIRST: usize = 32;
    const PARTS_AT_MOST: usize = 20_000;
    let edge = |i: usize| a + (b - a) * i as f64 / PARTS_AT_FIRST as f64;
    let mut parts: Vec<Part> = (0..PARTS_AT_FIRST).map(|i| Part::new(&f, edge(i), edge(i + 1))).collect();
    loop {
        let sum: f64 = parts.iter().map(|part| part.value).sum();
        let error: f64 = parts.iter().map(|part| part.error).sum();
        if error <= tolerance * sum.abs() || parts.len() >= PARTS_AT_MOST {
            return sum;
        }
        let limit = 0.25 * error / parts.len() as f64;
        parts = parts.into_iter().flat_map(|part| part.refined(&f, limit)).collect();
    }
}

struct Part {
    a: f64,
    b: f64,
    value: f64,
    error: f64,
}

impl Part {
    fn new(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> Self {
        let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
        let mut kronrod = 0.0;
        let mut gauss = 0.0;
        for (i, &(x, weight, gauss_weight)) in KRONROD.iter().enumerate() {
            let value = if i == 7 { f(middle) } else { f(middle - half * x) + f(middle + half * x) };
            kronrod += weight * value;
            gauss += gauss_weight * value;
        }
        Part { a, b, value: kronrod * half, error: ((kronrod - gauss) * half).abs() }
    }

    /// Itself, or its halves where its error is above the limit and it can still be halved.
    fn refined(self, f: &impl Fn(f64) -> f64, limit: f64) -> Vec<Part> {
        let middle = (self.a + self.b) / 2.0;
        if self.error <= limit || middle <= self.a || middle >= self.b {
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
