//! The air of a scene from what it is said to consist of, in double precision: twin of `atmosphere.wgsl`.

use glam::DVec3;

use crate::air::Air;

/// The parameters of `aerial.atmosphere`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Atmosphere {
    /// β_R, scattering coefficient of molecules, 1/m.
    pub rayleigh: DVec3,
    /// β_M, scattering coefficient of aerosols, 1/m.
    pub mie: DVec3,
    /// Absorption coefficient of aerosols, 1/m.
    pub absorption: DVec3,
    /// Mean cosine of what aerosols scatter, of each channel, above 0 forward.
    pub g: DVec3,
    /// Optical length of the molecules toward the zenith, m.
    pub rayleigh_height: f64,
    /// Optical length of the aerosols toward the zenith, m.
    pub mie_height: f64,
    /// Whether a ray to the sky ends at the dome; else it has no end.
    pub dome: bool,
    /// Whether irradiance is that above the atmosphere; else it is that on the ground.
    pub from_space: bool,
}

impl Atmosphere {
    /// What passes know of it.
    pub fn air(&self) -> Air {
        let depth = self.zenith_depth();
        Air {
            rayleigh: self.rayleigh,
            mie: self.mie,
            extinction: self.rayleigh + self.mie + self.absorption,
            g: self.g,
            dome: self.dome.then_some(self.rayleigh_height),
            above: self.from_space.then_some(depth),
        }
    }

    /// Optical depth toward the zenith: each kind of particle over its own optical length.
    pub fn zenith_depth(&self) -> DVec3 {
        self.rayleigh_height * self.rayleigh + self.mie_height * (self.mie + self.absorption)
    }
}
