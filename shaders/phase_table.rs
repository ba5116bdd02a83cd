//! Measured phase functions: tables over the scattering angle.

use crate::quadrature::gauss_legendre;
use std::f64::consts::PI;
use std::sync::{Mutex, PoisonError};

/// A phase function that is linear in the scattering angle between rows, normalised to 1 over the sphere.
#[derive(PartialEq)]
pub struct PhaseTable {
    /// Scattering angles, rad, ascending from 0 to π.
    angles: Vec<f64>,
    /// At each angle, 1/sr.
    values: Vec<f64>,
    /// Integral over the angle from there to π, 1/sr.
    rest: Vec<f64>,
}

impl std::fmt::Debug for PhaseTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PhaseTable({} rows)", self.angles.len())
    }
}

/// Why rows are not a phase function; `row` counts from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFault {
    /// Fewer than two rows.
    TooFew,
    /// A number that is infinite or none.
    NotFinite {
        /// Of the first such.
        row: usize,
    },
    /// A value below 0.
    Negative {
        /// Of the first such.
        row: usize,
    },
    /// An angle that is not above the one before it.
    NotAscending {
        /// Of the first such.
        row: usize,
    },
    /// The first angle is not 0°.
    Start,
    /// The last angle is not 180°.
    End,
    /// Zero everywhere, or so narrow or large that its integral is not finite.
    Integral,
}

/// Angles this near to 0° and 180° are taken for them.
const END_DEGREES: f64 = 1e-6;
/// Steps of what shaders read: the narrowest at both ends, 0.08° where a fogbow is.
const STEPS: usize = 4096;

/// Every table that was made, once.
static TABLES: Mutex<Vec<&'static PhaseTable>> = Mutex::new(Vec::new());

impl PhaseTable {
    /// From rows of scattering angle (degrees, from 0 to 180) and value (in any unit). The same rows give the same table.
    ///
    /// # Errors
    /// The first fault of the rows.
    pub fn new(rows: &[(f64, f64)]) -> Result<&'static PhaseTable, TableFault> {
        check(rows)?;
        let last = rows.len() - 1;
        let angle = |(row, &(degrees, _)): (usize, &(f64, f64))| match row {
            0 => 0.0,
            row if row == last => PI,
            _ => degrees.to_radians(),
        };
        // any unit is good, also one in which the integral would overflow
        let largest = rows.iter().map(|row| row.1).fold(0.0, f64::max);
        let mut table = PhaseTable {
            angles: rows.iter().enumerate().map(angle).collect(),
            values: rows.iter().map(|row| row.1 / largest).collect(),
            rest: Vec::new(),
        };
        let integral = table.mean(|_| 1.0);
        table.values.iter_mut().for_each(|value| *value /= integral);
        if !table.values.iter().all(|value| (*value as f32).is_finite()) || integral.is_nan() || integral <= 0.0 {
            return Err(TableFault::Integral);
        }
        table.rest = table.rests();
        let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = tables.iter().find(|known| ***known == table) {
            return Ok(known);
        }
        let kept: &'static PhaseTable = Box::leak(Box::new(table));
        tables.push(kept);
        Ok(kept)
    }

    /// At a scattering angle, rad; 1/sr.
    pub fn at(&self, angle: f64) -> f64 {
        let (row, along) = self.place(angle);
        self.values[row] + (self.values[row + 1] - self.values[row]) * along
    }

    /// The scattering angles of its rows, rad, ascending from 0 to π.
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Mean of a function of µ over it.
    pub fn mean(&self, of: impl Fn(f64) -> f64) -> f64 {
        const WIDEST: f64 = PI / 90.0;
        let rule = gauss_legendre(8);
        let mut sum = 0.0;
        for (angles, values) in self.angles.windows(2).zip(self.values.windows(2)) {
            let width = angles[1] - angles[0];
            let parts = (width / WIDEST).ceil().max(1.0) as usize;
            for part in 0..parts {
                for &(x, weight) in &rule {
                    let along = (part as f64 + 0.5 + 0.5 * x) / parts as f64;
                    let angle = angles[0] + width * along;
                    let value = values[0] + (values[1] - values[0]) * along;
                    sum += weight * 0.5 * width / parts as f64 * value * of(angle.cos()) * 2.0 * PI * angle.sin();
                }
            }
        }
        sum
    }

    /// Integral over the scattering angle from 0 to π, 1/sr.
    pub fn total(&self) -> f64 {
        self.rest[0]
    }

    /// What shaders read: the items of `PhaseTable` of `scene.wgsl`.
    pub fn items(&self) -> Vec<[f32; 4]> {
        let item = |step: usize| {
            let share = step as f64 / STEPS as f64;
            let angle = angle_of(share);
            let inverse = share_of(self.angle_with_rest(self.total() * share.powi(3)));
            [self.at(angle) as f32, self.rest_at(angle) as f32, inverse as f32, 0.0]
        };
        (0..=STEPS).map(item).collect()
    }

    /// The row at or before an angle, and how far, 0..1, it is on the way to the next.
    fn place(&self, angle: f64) -> (usize, f64) {
        let after = self.angles.partition_point(|known| *known <= angle);
        let row = after.clamp(1, self.angles.len() - 1) - 1;
        let along = (angle - self.angles[row]) / (self.angles[row + 1] - self.angles[row]);
        (row, along.clamp(0.0, 1.0))
    }

    fn rests(&self) -> Vec<f64> {
        let mut rest = vec![0.0; self.angles.len()];
        for row in (0..self.angles.len() - 1).rev() {
            let mean = (self.values[row] + self.values[row + 1]) / 2.0;
            rest[row] = rest[row + 1] + mean * (self.angles[row + 1] - self.angles[row]);
        }
        rest
    }

    fn rest_at(&self, angle: f64) -> f64 {
        let (row, _) = self.place(angle);
        self.rest[row + 1] + (self.at(angle) + self.values[row + 1]) / 2.0 * (self.angles[row + 1] - angle)
    }

    /// The angle from which on the integral is `rest`.
    fn angle_with_rest(&self, rest: f64) -> f64 {
        let before = self.rest.partition_point(|known| *known >= rest);
        let row = before.clamp(1, self.rest.len() - 1) - 1;
        let (width, low, high) = (self.angles[row + 1] - self.angles[row], self.values[row + 1], self.values[row]);
        // from the end of the row backward by x of it: width (low x + (high - low) x^2/2) = wanted
        let wanted = (rest - self.rest[row + 1]) / width;
        let root = (low * low + 2.0 * (high - low) * wanted).max(0.0).sqrt();
        let x = if low + root > 0.0 { 2.0 * wanted / (low + root) } else { 0.0 };
        self.angles[row + 1] - width * x.clamp(0.0, 1.0)
    }
}

/// xi of `phase.wgsl` from the scattering angle, rad.
fn share_of(angle: f64) -> f64 {
    let (forward, backward) = ((angle / 2.0).sin().max(0.0).sqrt(), (angle / 2.0).cos().max(0.0).sqrt());
    forward / (forward + backward)
}

/// And back.
fn angle_of(share: f64) -> f64 {
    2.0 * (share * share).atan2((1.0 - share).powi(2))
}

fn check(rows: &[(f64, f64)]) -> Result<(), TableFault> {
    for (row, (degrees, value)) in rows.iter().enumerate() {
        if !degrees.is_finite() || !value.is_finite() {
            return Err(TableFault::NotFinite { row });
        }
        if *value < 0.0 {
            return Err(TableFault::Negative { row });
        }
        if row > 0 && *degrees <= rows[row - 1].0 {
            return Err(TableFault::NotAscending { row });
        }
    }
    match rows {
        [] | [_] => Err(TableFault::TooFew),
        [first, ..] if first.0.abs() > END_DEGREES => Err(TableFault::Start),
        [.., last] if (last.0 - 180.0).abs() > END_DEGREES => Err(TableFault::End),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;

    /// A peak, a bow, a rise at the end.
    fn table() -> &'static PhaseTable {
        let rows = [(0.0, 90.0), (0.5, 40.0), (2.0, 3.0), (20.0, 1.0), (90.0, 0.02), (142.0, 0.2), (180.0, 0.1)];
        PhaseTable::new(&rows).expect("it is a phase function")
    }

    #[test]
    fn integrates_to_one() {
        let density = |angle: f64| table().at(angle) * 2.0 * PI * angle.sin();
        assert!((integrate(density, 0.0, PI, 1e-10) - 1.0).abs() < 1e-8);
        assert!((table().mean(|_| 1.0) - 1.0).abs() < 1e-12);
        let forward = table().mean(|mu| mu);
        assert!(forward > 0.3 && forward < 1.0, "{forward}");
        assert!((integrate(|angle| table().at(angle), 0.0, PI, 1e-10) / table().total() - 1.0).abs() < 1e-8);
    }

    #[test]
    fn is_linear_between_rows_in_any_unit() {
        let [one, other] = [1.0, 1e-7].map(|unit| {
            PhaseTable::new(&[(0.0, 3.0 * unit), (90.0, unit), (180.0, 2.0 * unit)]).expect("it is a phase function")
        });
        assert!((one.at(PI / 4.0) / one.at(PI / 2.0) - 2.0).abs() < 1e-12);
        assert!((0..=10).all(|i| (one.at(0.3 * f64::from(i)) - other.at(0.3 * f64::from(i))).abs() < 1e-12));
    }

    #[test]
    fn equal_rows_are_one_table() {
        assert!(std::ptr::eq(table(), table()));
    }

    #[test]
    fn the_inverse_leads_back() {
        for angle in [1e-4, 0.01, 0.3, 1.7, 2.4, 3.1] {
            let back = table().angle_with_rest(table().rest_at(angle));
            assert!((back - angle).abs() < 1e-9, "{back} {angle}");
            assert!((angle_of(share_of(angle)) - angle).abs() < 1e-12);
        }
        let items = table().items();
        assert_eq!(
            (items[STEPS][1], items[0][1]),
            (0.0, table().total() as f32),
            "no rest at 180 degrees, all of it at 0"
        );
        assert!(items[0][2] == 1.0 && items[STEPS][2] < 1e-6, "and back");
    }

    #[test]
    fn what_is_no_phase_function_is_refused() {
        let fault = |rows: &[(f64, f64)]| PhaseTable::new(rows).expect_err("it is not a phase function");
        assert_eq!(fault(&[]), TableFault::TooFew);
        assert_eq!(fault(&[(0.0, 1.0)]), TableFault::TooFew);
        assert_eq!(fault(&[(0.0, 1.0), (20.0, f64::NAN), (180.0, 1.0)]), TableFault::NotFinite { row: 1 });
        assert_eq!(fault(&[(0.0, 1.0), (20.0, -1.0), (180.0, 1.0)]), TableFault::Negative { row: 1 });
        assert_eq!(fault(&[(0.0, 1.0), (20.0, 1.0), (20.0, 1.0), (180.0, 1.0)]), TableFault::NotAscending { row: 2 });
        assert_eq!(fault(&[(1.0, 1.0), (180.0, 1.0)]), TableFault::Start);
        assert_eq!(fault(&[(0.0, 1.0), (179.0, 1.0)]), TableFault::End);
        assert_eq!(fault(&[(0.0, 0.0), (180.0, 0.0)]), TableFault::Integral);
    }
}
