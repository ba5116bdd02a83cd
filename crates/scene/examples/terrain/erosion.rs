//! Mountains as rivers make them: uplift against erosion by running water, until the two balance.
//!
//! Stream power: dh/dt = U − K·√A·S, A the area that drains through a place, S its slope; solved implicitly from the
//! mouths of rivers up (Braun and Willett 2013). Slopes steeper than scree can be slide down.

/// Side of a cell, m.
pub const CELL: f64 = 125.0;
/// Steepest slope.
const SCREE: f64 = 0.95;
/// K·dt: how far water cuts in a step. Only its ratio to the uplift matters in the end.
const CUT: f64 = 0.15;
const STEPS: usize = 120;

/// Heights of a rectangle of cells, m; x grows to the right, z toward the viewer, both from the corner.
pub struct Heights {
    pub columns: usize,
    pub rows: usize,
    pub data: Vec<f64>,
}

impl Heights {
    /// What stands after a long time of uplift, in metres per unit of erosion, on ground of these first heights.
    pub fn eroded(
        columns: usize,
        rows: usize,
        uplift: impl Fn(usize, usize) -> f64,
        first: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let uplift: Vec<f64> = cells().map(|(column, row)| uplift(column, row)).collect();
        let data = cells().map(|(column, row)| first(column, row)).collect();
        let mut heights = Self { columns, rows, data };
        for _ in 0..STEPS {
            heights.step(&uplift);
        }
        heights
    }

    /// Where a cell's water goes, and how far; itself where it lies lowest, or at the edge.
    fn receiver(&self, cell: usize) -> (usize, f64) {
        let (column, row) = (cell % self.columns, cell / self.columns);
        let mut best = (cell, 1.0);
        if column == 0 || row == 0 || column + 1 == self.columns || row + 1 == self.rows {
            return best;
        }
        let mut steepest = 0.0;
        for (z, x) in [(0, 1), (1, 0), (1, 2), (2, 1), (0, 0), (0, 2), (2, 0), (2, 2)] {
            let other = (row + z - 1) * self.columns + column + x - 1;
            let way = if z == 1 || x == 1 { CELL } else { CELL * std::f64::consts::SQRT_2 };
            let slope = (self.data[cell] - self.data[other]) / way;
            if slope > steepest {
                (steepest, best) = (slope, (other, way));
            }
        }
        best
    }

    fn step(&mut self, uplift: &[f64]) {
        let receivers: Vec<(usize, f64)> = (0..self.data.len()).map(|cell| self.receiver(cell)).collect();
        let mut order: Vec<usize> = (0..self.data.len()).collect();
        order.sort_unstable_by(|a, b| self.data[*b].total_cmp(&self.data[*a]).then(a.cmp(b)));
        let mut area = vec![CELL * CELL; self.data.len()];
        for &cell in &order {
            let (below, _) = receivers[cell];
            if below != cell {
                area[below] += area[cell];
            }
        }
        for &cell in order.iter().rev() {
            let (below, way) = receivers[cell];
            let raised = self.data[cell] + CUT * uplift[cell];
            self.data[cell] = if below == cell {
                let (column, row) = (cell % self.columns, cell / self.columns);
                let edge = column == 0 || row == 0 || column + 1 == self.columns || row + 1 == self.rows;
                if edge { self.data[cell] } else { raised }
            } else {
                let cut = CUT * area[cell].sqrt() / way;
                let worn = (raised + cut * self.data[below]) / (1.0 + cut);
                worn.min(self.data[below] + SCREE * way)
            };
        }
    }

    /// Height at a place in metres from the corner, m: cubic between cells (Catmull and Rom).
    pub fn at(&self, x: f64, z: f64) -> f64 {
        let (x, z) = (x / CELL, z / CELL);
        let (x0, z0) = (x.floor(), z.floor());
        let weights = |t: f64| {
            [
                0.5 * t * ((2.0 - t) * t - 1.0),
                0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
                0.5 * t * ((4.0 - 3.0 * t) * t + 1.0),
                0.5 * (t - 1.0) * t * t,
            ]
        };
        let cell =
            |at: f64, offset: usize, count: usize| (at + offset as f64 - 1.0).clamp(0.0, count as f64 - 1.0) as usize;
        let (across, along) = (weights(x - x0), weights(z - z0));
        let mut sum = 0.0;
        for (j, down) in along.iter().enumerate() {
            for (i, right) in across.iter().enumerate() {
                sum += down * right * self.data[cell(z0, j, self.rows) * self.columns + cell(x0, i, self.columns)];
            }
        }
        sum
    }
}
