//! What the pictures are compared with: light in double precision, by the twins of the shaders.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::ray::{Ray, ray_of_pixel};

use crate::twin::Twin;

/// What is compared: an output that the shipped graphs have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Light {
    /// Light that the medium scatters once toward the eye, up to the nearest surface.
    Airlight,
}

impl Light {
    pub const ALL: [Self; 1] = [Self::Airlight];

    /// The name of the output.
    pub fn output(self) -> &'static str {
        match self {
            Self::Airlight => "airlight",
        }
    }

    /// What reaches the eye along a ray that ends after `way` metres, W/(sr m²).
    fn along(self, scene: &Twin, ray: &Ray, way: f64) -> DVec3 {
        match self {
            Self::Airlight => scene.lights.iter().map(|light| airlight(light, &scene.medium, ray, 0.0, way)).sum(),
        }
    }
}

/// A picture in double precision.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Truth {
    /// Row by row from the top, W/(sr m²).
    pub pixels: Vec<DVec3>,
}

impl Truth {
    /// Of a scene, for the depth of each pixel in metres, infinite where there is no surface. Calls `row_done` after each
    /// row. Rows are shared out among the processors.
    pub fn new(
        light: Light,
        scene: &Twin,
        (width, height): (u32, u32),
        depth: &[f32],
        row_done: &(dyn Fn() + Sync),
    ) -> Self {
        let rows = Mutex::new(vec![Vec::new(); height as usize]);
        let next = AtomicU32::new(0);
        let work = || {
            loop {
                let y = next.fetch_add(1, Ordering::Relaxed);
                if y >= height {
                    break;
                }
                let pixel = |x: u32| {
                    let ray = ray_of_pixel(&scene.camera, [x, y], [width, height]);
                    light.along(scene, &ray, f64::from(depth[y as usize * width as usize + x as usize]))
                };
                let row: Vec<DVec3> = (0..width).map(pixel).collect();
                rows.lock().unwrap_or_else(|poisoned| poisoned.into_inner())[y as usize] = row;
                row_done();
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..std::thread::available_parallelism().map_or(1, NonZero::get) {
                scope.spawn(work);
            }
        });
        let rows = rows.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        Self { pixels: rows.into_iter().flatten().collect() }
    }

    /// Over all channels of all pixels.
    pub fn mean(&self) -> f64 {
        self.pixels.iter().map(|pixel| pixel.element_sum()).sum::<f64>() / (3.0 * self.pixels.len() as f64)
    }
}
