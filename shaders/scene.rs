//! The part of a scene that light scattering needs, in double precision: twin of `scene.wgsl`.

use crate::phase::PhaseTable;
use glam::DVec3;

/// A triangle, world, m.
pub type Triangle = [DVec3; 3];

/// What passes see of a scene at one time, all surfaces apart but for the shadows that they cast.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What fills space; extinction 0 is none.
    pub medium: Medium,
    /// How its density falls with the height.
    pub height_fog: HeightFog,
    /// What the medium sends toward the eye that comes from no light of the scene, where it is endless, W/(sr m²).
    pub ambient: DVec3,
    /// What a ray that meets nothing sees behind the medium, W/(sr m²).
    pub background: DVec3,
    /// In the order of the scene.
    pub lights: Vec<Light>,
    /// Every triangle that casts a shadow.
    pub casters: Vec<Triangle>,
}

/// A pinhole camera: twin of `Camera`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The eye, m.
    pub position: DVec3,
    /// To the right, scaled by the tangent of half the horizontal field of view.
    pub right: DVec3,
    /// Up, scaled by the tangent of half the vertical field of view.
    pub up: DVec3,
    /// Unit vector.
    pub forward: DVec3,
}

/// A phase function: how a scattering event spreads light over directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Phase {
    /// The same everywhere, 1/(4π).
    #[default]
    Isotropic,
    /// Henyey and Greenstein 1941.
    HenyeyGreenstein {
        /// Mean cosine, above 0 forward.
        g: f64,
    },
    /// Two Henyey-Greenstein lobes.
    DoubleHenyeyGreenstein {
        /// Mean cosine of the first.
        g1: f64,
        /// Mean cosine of the second.
        g2: f64,
        /// Weight of the second, 0..1.
        f: f64,
    },
    /// Blasi, Le Saëc and Schlick 1993.
    Schlick {
        /// Above 0 forward.
        k: f64,
    },
    /// Molecules.
    Rayleigh,
    /// Cornette and Shanks 1992.
    CornetteShanks {
        /// Their g, which is not the mean cosine.
        g: f64,
    },
    /// Water droplets of fog and clouds: Jendersie and d'Eon 2023.
    Droplets {
        /// Diameter, µm, within [`DROPLET_DIAMETERS`].
        diameter: f64,
    },
    /// A table. Tables live as long as the process, one of each content, so that a phase function is a plain value.
    Measured(&'static PhaseTable),
}

/// The diameters of droplets, µm, for which Jendersie and d'Eon give the fit that [`Phase::Droplets`] is.
pub const DROPLET_DIAMETERS: (f64, f64) = (5.0, 50.0);

/// A medium that fills space: homogeneous, unless a [`HeightFog`] goes with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Extinction coefficient σ_t of each channel, 1/m.
    pub extinction: DVec3,
    /// Single-scattering albedo σ_s/σ_t of each channel.
    pub albedo: DVec3,
    /// Phase function.
    pub phase: Phase,
}

impl Medium {
    /// Scattering coefficient σ_s = albedo·σ_t of each channel, 1/m.
    pub fn scattering(&self) -> DVec3 {
        self.albedo * self.extinction
    }
}

/// How the density of a medium falls with the height y: `e^(−(y − base_height)·falloff)`. Twin of `HeightFog`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeightFog {
    /// m, where the medium has its own extinction.
    pub base_height: f64,
    /// 1/scale height, 1/m; 0: homogeneous.
    pub falloff: f64,
}

impl HeightFog {
    /// The same density everywhere.
    pub const NONE: HeightFog = HeightFog { base_height: 0.0, falloff: 0.0 };
}

/// A light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Shines alike in all directions.
    Point {
        /// m.
        position: DVec3,
        /// W/sr.
        intensity: DVec3,
        /// Floors the distance between light and ray, m.
        radius: f64,
    },
    /// Shines in a cone.
    Spot {
        /// m.
        position: DVec3,
        /// W/sr, on the axis.
        intensity: DVec3,
        /// Floors the distance between light and ray, m.
        radius: f64,
        /// Unit vector, the way the light travels.
        direction: DVec3,
        /// N of cosᴺ.
        exponent: f64,
        /// Half-angle of the cone, degrees, below 180.
        cutoff: f64,
    },
    /// Comes from one direction, everywhere.
    Directional {
        /// Unit vector, the way the light travels.
        direction: DVec3,
        /// W/m².
        irradiance: DVec3,
    },
}
