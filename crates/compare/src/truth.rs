//! The reference that pictures are compared with: light in double precision, by the twins of the shaders.

use glam::DVec3;
use rayon::prelude::*;
use tyndall_gpu::PortData;
use tyndall_shaders::airlight::airlight;
use tyndall_shaders::medium::transmittance;
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::reflection::{Surface, reflected};
use tyndall_shaders::scene::Scene;

use crate::casters::Casters;

/// An output that can be compared; the shipped graphs have them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Output {
    /// Light that the medium scatters once toward the eye, up to the nearest surface.
    Airlight,
    /// Light that the nearest surface reflects, straight from the lights and scattered once before, attenuated to the eye.
    Surface,
}

impl Output {
    pub const ALL: [Self; 2] = [Self::Airlight, Self::Surface];

    /// The name of the output.
    pub fn name(self) -> &'static str {
        match self {
            Self::Airlight => "airlight",
            Self::Surface => "surface",
        }
    }

    /// What reaches the eye along the ray of a pixel, W/(sr m²); airlight from the lit parts of each light, if given.
    fn along(self, scene: &Scene, ray: &Ray, met: &Met, lit: Option<&[Vec<[f64; 2]>]>) -> DVec3 {
        let lights = scene.lights.iter();
        let over = |light, [near, far]: [f64; 2]| airlight(light, &scene.medium, ray, near, far);
        match (self, lit) {
            (Self::Airlight, Some(lit)) => {
                lights.zip(lit).flat_map(|(light, lit)| lit.iter().map(move |part| over(light, *part))).sum()
            }
            (Self::Airlight, None) => lights.map(|light| over(light, [0.0, met.distance])).sum(),
            (Self::Surface, _) if met.distance.is_finite() => {
                let surface = met.surface(ray);
                let leaving: DVec3 = lights.map(|light| reflected(light, &scene.medium, &surface)).sum();
                leaving * transmittance(&scene.medium, met.distance)
            }
            (Self::Surface, _) => DVec3::ZERO,
        }
    }
}

/// What the rays of all pixels meet, as rendered: the truth concerns the light, not the geometry.
#[derive(Debug, Clone)]
pub(crate) struct Geometry {
    /// Metres along the ray, infinite where there is no surface.
    pub depth: PortData,
    /// Unit vectors.
    pub normal: PortData,
    /// Layer 0: Lambert reflectance; layer 1: Phong reflectance, and the shininess.
    pub material: PortData,
    /// The object that each triangle belongs to.
    pub objects: Vec<usize>,
    /// 1 + the index of the triangle that is met; 0 for none.
    pub triangle: PortData,
}

impl Geometry {
    fn at(&self, x: u32, y: u32) -> Met {
        let texel = |port: &PortData, layer: u32| {
            let first = (((layer * port.height() + y) * port.width() + x) * port.channels()) as usize;
            let channel = |i: usize| port.get(first + i).unwrap_or(0.0);
            (DVec3::new(channel(0), channel(1), channel(2)), channel(3))
        };
        let (specular, shininess) = texel(&self.material, 1);
        Met {
            distance: texel(&self.depth, 0).0.x,
            normal: texel(&self.normal, 0).0,
            diffuse: texel(&self.material, 0).0,
            specular,
            shininess,
        }
    }

    /// The object that a pixel shows.
    fn object(&self, x: u32, y: u32) -> Option<usize> {
        let triangle = self.triangle.get((y * self.triangle.width() + x) as usize)? as usize;
        self.objects.get(triangle.checked_sub(1)?).copied()
    }
}

/// What a ray meets; nothing if the distance is infinite.
struct Met {
    distance: f64,
    normal: DVec3,
    diffuse: DVec3,
    specular: DVec3,
    shininess: f64,
}

impl Met {
    fn surface(&self, ray: &Ray) -> Surface {
        let Self { distance, diffuse, specular, shininess, .. } = *self;
        let normal = if self.normal.dot(ray.direction) > 0.0 { -self.normal } else { self.normal };
        let mirrored = ray.direction.reflect(normal);
        Surface { position: ray.at(distance), normal, mirrored, diffuse, specular, shininess }
    }
}

/// A picture in double precision.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Truth {
    /// Row by row from the top, W/(sr m²).
    pub pixels: Vec<DVec3>,
    /// Whether there is an outline at each pixel: the object, the lights that reach it, or the number of lit parts of the
    /// ray differ within 3×3 pixels. `None` if there are no shadows.
    pub edges: Option<Vec<bool>>,
}

/// What decides about outlines at a pixel: its object, and for each light whether it reaches the object, and the number of
/// lit parts of the ray.
type Outlined = (Option<usize>, Vec<(bool, usize)>);

/// What the truth is computed from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<'a> {
    /// Camera, medium and lights.
    pub scene: &'a Scene,
    /// Where the rays end.
    pub geometry: &'a Geometry,
    /// What casts shadows, if shadows are computed.
    pub casters: Option<&'a Casters>,
}

impl Truth {
    /// Of a scene. Calls `row_done` after each row. Rows are spread over the cores.
    pub fn new(output: Output, seen: Seen<'_>, (width, height): (u32, u32), row_done: &(dyn Fn() + Sync)) -> Self {
        let row = |y: u32| -> Vec<_> {
            let row = (0..width).map(|x| seen.pixel(output, [x, y], [width, height])).collect();
            row_done();
            row
        };
        let rows: Vec<Vec<_>> = (0..height).into_par_iter().map(row).collect();
        let (pixels, outlined): (Vec<DVec3>, Vec<Outlined>) = rows.into_iter().flatten().unzip();
        let edges = seen.casters.map(|_| edges(&outlined, width as usize));
        Self { pixels, edges }
    }

    /// The mean over all channels of all pixels.
    pub fn mean(&self) -> f64 {
        self.pixels.iter().map(|pixel| pixel.element_sum()).sum::<f64>() / (3.0 * self.pixels.len() as f64)
    }
}

impl Seen<'_> {
    fn pixel(&self, output: Output, [x, y]: [u32; 2], size: [u32; 2]) -> (DVec3, Outlined) {
        let ray = ray_of_pixel(&self.scene.camera, [x, y], size);
        let mut met = self.geometry.at(x, y);
        let Some(casters) = self.casters else {
            return (output.along(self.scene, &ray, &met, None), (None, Vec::new()));
        };
        met.distance = casters.end(&ray, met.distance);
        let lit: Vec<_> = self.scene.lights.iter().map(|light| casters.lit(light, &ray, met.distance)).collect();
        let outlined = lit.iter().map(|lit| (Casters::reaches(lit, met.distance), lit.len())).collect();
        (output.along(self.scene, &ray, &met, Some(&lit)), (self.geometry.object(x, y), outlined))
    }
}

/// Whether each pixel differs from another within 3×3.
fn edges(outlined: &[Outlined], width: usize) -> Vec<bool> {
    let height = outlined.len() / width.max(1);
    let is_edge = |at: usize| {
        let (x, y) = (at % width, at / width);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
        rows.into_iter().any(|y| columns.clone().any(|x| outlined[y * width + x] != outlined[at]))
    };
    (0..outlined.len()).map(is_edge).collect()
}
