//! The results of a comparison.

use serde_json::{Value, json};
use tyndall_image::metrics::{Percentiles, median};

use crate::errors::FLOOR;
use crate::measure::Cost;

/// Everything that was measured.
#[derive(Debug, Clone)]
pub(crate) struct Figures {
    pub about: String,
    /// The output compared: `airlight`.
    pub output: &'static str,
    /// Whether shadows were compared.
    pub shadows: bool,
    pub adapter: String,
    pub size: (u32, u32),
    pub rounds: u32,
    pub methods: Vec<Method>,
    pub scenes: Vec<SceneFigures>,
}

/// A method.
#[derive(Debug, Clone)]
pub(crate) struct Method {
    pub name: String,
    pub about: String,
    /// Index of its graph among all: methods of one graph differ by their settings.
    pub family: usize,
    /// Name of that graph.
    pub graph: String,
}

/// One scene by every method.
#[derive(Debug, Clone)]
pub(crate) struct SceneFigures {
    pub name: String,
    pub about: String,
    /// Mean of the true picture, W/(sr m²).
    pub mean: f64,
    /// In the order of the methods.
    pub rows: Vec<Row>,
}

/// One method in one scene, or in all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    pub p50: f64,
    pub p95: f64,
    pub p99: f64,
    pub max: f64,
    /// Of the sum of the picture.
    pub sum: f64,
    pub cost: Cost,
}

impl Row {
    pub fn new((errors, sum): (Percentiles, f64), cost: Cost) -> Self {
        Self { p50: errors.p50, p95: errors.p95, p99: errors.p99, max: errors.max, sum, cost }
    }

    /// Over several scenes: the median p50, the worst of the other errors, the sum of times, the most bytes.
    fn over(rows: &[Row]) -> Self {
        let worst = |of: fn(&Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        let most = |of: fn(&Row) -> u64| rows.iter().map(of).max().unwrap_or_default();
        let mut p50: Vec<f64> = rows.iter().map(|row| row.p50).collect();
        Self {
            p50: median(&mut p50).unwrap_or_default(),
            p95: worst(|row| row.p95),
            p99: worst(|row| row.p99),
            max: worst(|row| row.max),
            sum: worst(|row| row.sum),
            cost: Cost {
                frame_us: rows.iter().map(|row| row.cost.frame_us).sum(),
                set_up_us: rows.iter().map(|row| row.cost.set_up_us).sum(),
                scene_us: rows.iter().map(|row| row.cost.scene_us).sum(),
                frame_bytes: most(|row| row.cost.frame_bytes),
                set_up_bytes: most(|row| row.cost.set_up_bytes),
            },
        }
    }

    fn json(&self, method: &Method) -> Value {
        json!({
            "method": method.name,
            "graph": method.graph,
            "error": { "p50": self.p50, "p95": self.p95, "p99": self.p99, "max": self.max, "sum": self.sum },
            "gpu_us": self.cost.frame_us,
            "set_up_us": self.cost.set_up_us,
            "scene_us": self.cost.scene_us,
            "bytes": self.cost.frame_bytes,
            "set_up_bytes": self.cost.set_up_bytes,
        })
    }
}

impl Figures {
    /// Every method over all scenes, see [`Row::over`].
    pub fn over_all(&self) -> Vec<Row> {
        let of = |method: usize| self.scenes.iter().map(|scene| scene.rows[method]).collect::<Vec<_>>();
        (0..self.methods.len()).map(|method| Row::over(&of(method))).collect()
    }

    /// As JSON. An infinite error is null.
    pub fn json(&self) -> Value {
        let rows = |rows: &[Row]| -> Vec<Value> {
            rows.iter().zip(&self.methods).map(|(row, method)| row.json(method)).collect()
        };
        let scene = |scene: &SceneFigures| {
            let SceneFigures { name, about, mean, .. } = scene;
            json!({ "name": name, "about": about, "mean": mean, "methods": rows(&scene.rows) })
        };
        json!({
            "about": self.about,
            "output": self.output,
            "shadows": self.shadows,
            "adapter": self.adapter,
            "size": [self.size.0, self.size.1],
            "rounds": self.rounds,
            "error_floor_of_mean": FLOOR,
            "all": rows(&self.over_all()),
            "scenes": self.scenes.iter().map(scene).collect::<Vec<_>>(),
        })
    }
}
