//! What the pictures are compared with: light in double precision, by the twins of the shaders.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::DVec3;
use tyndall_gpu::PortData;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::reflection::{Surface, reflected};
use tyndall_shaders::scene::Scene;

/// What is compared: an output that the shipped graphs have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Light {
    /// Light that the medium scatters once toward the eye, up to the nearest surface.
    Airlight,
    /// Light that the nearest surface reflects, straight from the lights and scattered once before, attenuated to the eye.
    Surface,
}

impl Light {
    pub const ALL: [Self; 2] = [Self::Airlight, Self::Surface];

    /// The name of the output.
    pub fn output(self) -> &'static str {
        match self {
            Self::Airlight => "airlight",
            Self::Surface => "surface",
        }
    }

    /// What reaches the eye along the ray of a pixel, W/(sr m²).
    fn along(self, scene: &Scene, ray: &Ray, met: &Met) -> DVec3 {
        let lights = scene.lights.iter();
        match self {
            Self::Airlight => lights.map(|light| airlight(light, &scene.medium, ray, 0.0, met.way)).sum(),
            Self::Surface if met.way.is_finite() => {
                let surface = met.surface(ray);
                let leaving: DVec3 = lights.map(|light| reflected(light, &scene.medium, &surface)).sum();
                leaving * transmittance(&scene.medium, met.way)
            }
            Self::Surface => DVec3::ZERO,
        }
    }
}

/// What the rays of all pixels meet, as it is rendered: the truth is the light's, not the geometry's.
#[derive(Debug, Clone)]
pub(crate) struct Geometry {
    /// Metres along the ray, infinite where there is no surface.
    pub depth: PortData,
    /// Unit vectors.
    pub normal: PortData,
    /// Layer 0: Lambert reflectance; layer 1: Phong reflectance, and the shininess.
    pub material: PortData,
}

impl Geometry {
    fn at(&self, x: u32, y: u32) -> Met {
        let texel = |port: &PortData, layer: u32| {
            let first = (((layer * port.height + y) * port.width + x) * port.channels) as usize;
            let channel = |i: usize| port.data.get(first + i).copied().map_or(0.0, f64::from);
            (DVec3::new(channel(0), channel(1), channel(2)), channel(3))
        };
        let (specular, shininess) = texel(&self.material, 1);
        Met {
            way: texel(&self.depth, 0).0.x,
            normal: texel(&self.normal, 0).0,
            diffuse: texel(&self.material, 0).0,
            specular,
            shininess,
        }
    }
}

/// What a ray meets; nothing where the way is infinite.
struct Met {
    way: f64,
    normal: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    shininess: f64,
}

impl Met {
    fn surface(&self, ray: &Ray) -> Surface {
        let Self { way, diffuse, specular, shininess, .. } = *self;
        let normal = if self.normal.dot(ray.direction) > 0.0 { -self.normal } else { self.normal };
        let mirrored = ray.direction.reflect(normal);
        Surface { position: ray.at(way), normal, mirrored, diffuse, specular, shininess }
    }
}

/// A picture in double precision.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Truth {
    /// Row by row from the top, W/(sr m²).
    pub pixels: Vec<DVec3>,
}

impl Truth {
    /// Of a scene, where the rays meet this. Calls `row_done` after each row. Rows are shared out among the processors.
    pub fn new(
        light: Light,
        scene: &Scene,
        (width, height): (u32, u32),
        geometry: &Geometry,
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
                    light.along(scene, &ray, &geometry.at(x, y))
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
