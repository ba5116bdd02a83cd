//! Extinction and in-scattering of sunlight in air of constant density, in double precision: twin of `air.wgsl`.

use std::f64::consts::PI;

use glam::DVec3;
use tyndall_shaders::phase::phase;
use tyndall_shaders::scene::Phase;

/// What the passes of this plugin know of the air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// β_R, scattering coefficient of molecules, 1/m.
    pub rayleigh: DVec3,
    /// β_M, scattering coefficient of aerosols, 1/m.
    pub mie: DVec3,
    /// β_ex, 1/m.
    pub extinction: DVec3,
    /// Mean cosine of what aerosols scatter, of each channel, above 0 forward.
    pub g: DVec3,
    /// Height of the sky dome at the zenith, m; without one a ray to the sky has no end.
    pub dome: Option<f64>,
    /// Optical depth of the whole atmosphere toward the zenith, where irradiance is that above it; without one irradiance
    /// is that on the ground.
    pub above: Option<DVec3>,
}

impl Air {
    /// β_R·f_R + β_M·f_HG, 1/(m sr), at w = sin² of half the scattering angle. Hoffman and Preetham 2002, "Combined
    /// Scattering", with f_HG normalised: (1 − g²), not (1 − g)².
    pub fn angular_scattering(&self, w: f64) -> DVec3 {
        let haze = self.g.to_array().map(|g| phase(&Phase::HenyeyGreenstein { g }, w));
        self.rayleigh * phase(&Phase::Rayleigh, w) + self.mie * DVec3::from_array(haze)
    }

    /// Length of a ray of this direction in the air, m; `way` to the nearest surface, or infinite.
    pub fn way(&self, direction: DVec3, way: f64) -> f64 {
        match self.dome {
            Some(dome) if way.is_infinite() => dome * air_mass(elevation_degrees(direction)),
            _ => way,
        }
    }

    /// F_ex over `s` metres.
    pub fn extinction_factor(&self, s: f64) -> DVec3 {
        each(self.extinction, |beta| if beta == 0.0 { 1.0 } else { (-beta * s).exp() })
    }

    /// What is left on the ground of the irradiance of a light that travels in this direction.
    pub fn sunlight(&self, direction: DVec3) -> DVec3 {
        let Some(depth) = self.above else { return DVec3::ONE };
        let elevation = elevation_degrees(-direction);
        visible_disc(elevation) * each(-air_mass(elevation) * depth, f64::exp)
    }

    /// L_in of a light of irradiance `e` that travels in direction `sun`, along a ray of `s` metres, W/(sr m²):
    /// E·(β_R·f_R + β_M·f_HG)/β_ex·(1 − F_ex).
    pub fn in_scattering(&self, sun: DVec3, e: DVec3, ray: DVec3, s: f64) -> DVec3 {
        let w = (0.5 * (sun + ray)).length_squared();
        let source = e * self.sunlight(sun) * self.angular_scattering(w);
        let length = each(self.extinction, |beta| if beta == 0.0 { 0.0 } else { -(-beta * s).exp_m1() / beta });
        source * length
    }
}

/// Elevation of a direction above the horizon, degrees.
pub fn elevation_degrees(direction: DVec3) -> f64 {
    direction.y.atan2(direction.x.hypot(direction.z)).to_degrees()
}

/// Relative optical length of a way out of the atmosphere, 1 toward the zenith: Kasten 1965, as the SIGGRAPH 2003 course
/// has it (Iqbal 1983). Below the horizon as at the horizon.
pub fn air_mass(elevation_degrees: f64) -> f64 {
    let elevation = elevation_degrees.max(0.0);
    1.0 / (elevation.to_radians().sin() + 0.15 * (3.885 + elevation).powf(-1.253))
}

/// The part of the sun's disc, 0.534° across, that is above the horizon, without refraction.
pub fn visible_disc(elevation_degrees: f64) -> f64 {
    let x = (elevation_degrees / 0.267).clamp(-1.0, 1.0);
    0.5 + (x.asin() + x * (1.0 - x * x).sqrt()) / PI
}

fn each(vector: DVec3, of: impl Fn(f64) -> f64) -> DVec3 {
    DVec3::from_array(vector.to_array().map(of))
}

/// Scattering coefficient of air at a wavelength in metres, 1/m: the SIGGRAPH 2003 course, with the depolarisation of
/// 0.035 that its own values come from (it prints 0.0035).
pub fn rayleigh_coefficient(wavelength: f64) -> f64 {
    let (n, molecules, depolarisation) = (1.0003_f64, 2.545e25, 0.035);
    let king = (6.0 + 3.0 * depolarisation) / (6.0 - 7.0 * depolarisation);
    8.0 * PI.powi(3) * (n * n - 1.0).powi(2) / (3.0 * molecules * wavelength.powi(4)) * king
}

/// Scattering coefficient of aerosols of a turbidity at a wavelength in metres, 1/m: the SIGGRAPH 2003 course with Junge
/// exponent 4; the concentration factor is Preetham, Shirley and Smits' (1999), a hundredth of what the course prints.
pub fn mie_coefficient(turbidity: f64, wavelength: f64) -> f64 {
    let concentration = (0.6544 * turbidity - 0.6510) * 1e-18;
    0.434 * concentration * PI * (2.0 * PI / wavelength).powi(2) * 0.68
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::Atmosphere;

    fn atmosphere() -> Atmosphere {
        Atmosphere {
            rayleigh: DVec3::new(6.95e-6, 1.18e-5, 2.44e-5),
            mie: DVec3::splat(2e-5),
            absorption: DVec3::new(0.0, 1e-6, 5e-6),
            g: DVec3::new(0.7, 0.76, 0.8),
            rayleigh_height: 8400.0,
            mie_height: 1250.0,
            dome: false,
            from_space: false,
        }
    }

    fn air() -> Air {
        atmosphere().air()
    }

    const E: DVec3 = DVec3::new(20.0, 18.0, 15.0);

    fn close(a: DVec3, b: DVec3) {
        assert!(((a - b) / b).abs().max_element() < 1e-12, "{a} {b}");
    }

    /// 650, 570 and 475 nm, and not 700, 530 and 400 as is printed beside these values.
    #[test]
    fn the_coefficients_of_the_papers_are_those_of_650_570_and_475_nm() {
        for (wavelength, printed) in [(650e-9, 6.95e-6), (570e-9, 1.18e-5), (475e-9, 2.44e-5)] {
            assert!((rayleigh_coefficient(wavelength) / printed - 1.0).abs() < 0.01);
        }
        assert!((rayleigh_coefficient(700e-9) / 6.95e-6 - 1.0).abs() > 0.2);
    }

    /// The presets' aerosols are those of their turbidities at 570 nm.
    #[test]
    fn turbidities_of_the_presets() {
        for (turbidity, preset) in [(1.3, 2.2e-5), (3.0, 1.48e-4)] {
            let found = mie_coefficient(turbidity, 570e-9);
            assert!((found / preset - 1.0).abs() < 0.03, "{turbidity}: {found}");
        }
        // Ångström's formula for turbidity 2.5: an optical depth of 0.147 at 550 nm over 1.25 km
        assert!((1250.0 * mie_coefficient(2.5, 550e-9) - 0.147).abs() < 0.003);
    }

    #[test]
    fn no_way_gives_nothing_and_an_endless_one_the_horizon() {
        let (sun, ray) = (DVec3::new(0.3, -0.5, 0.2).normalize(), DVec3::NEG_Z);
        assert_eq!(air().in_scattering(sun, E, ray, 0.0), DVec3::ZERO);
        assert_eq!(air().extinction_factor(0.0), DVec3::ONE);
        assert_eq!(air().extinction_factor(f64::INFINITY), DVec3::ZERO);
        let w = (0.5 * (sun + ray)).length_squared();
        close(air().in_scattering(sun, E, ray, f64::INFINITY), E * air().angular_scattering(w) / air().extinction);
        let none = Air { rayleigh: DVec3::ZERO, mie: DVec3::ZERO, extinction: DVec3::ZERO, ..air() };
        assert_eq!(none.in_scattering(sun, E, ray, f64::INFINITY), DVec3::ZERO);
        assert_eq!(none.extinction_factor(f64::INFINITY), DVec3::ONE);
    }

    #[test]
    fn a_way_in_two_parts_gives_the_same() {
        let (sun, ray) = (DVec3::new(0.3, -0.5, 0.2).normalize(), DVec3::NEG_Z);
        let along = |s: f64| air().in_scattering(sun, E, ray, s);
        for (near, far) in [(10.0, 5e3), (2e4, 3e4), (1.0, 1e5)] {
            close(along(near + far), along(near) + air().extinction_factor(near) * along(far));
        }
    }

    /// Light that is scattered out of a thin layer of air goes into all directions: as much as is lost.
    #[test]
    fn what_is_scattered_is_what_is_lost() {
        let steps = 200_000;
        let mut sum = DVec3::ZERO;
        for i in 0..steps {
            // equal steps of the cosine are equal solid angles
            let w = (f64::from(i) + 0.5) / f64::from(steps);
            sum += air().angular_scattering(w) * (4.0 * PI / f64::from(steps));
        }
        let lost = air().extinction - atmosphere().absorption;
        assert!(((sum - lost) / lost).abs().max_element() < 1e-8, "{sum} {lost}");
    }

    /// Kasten's own table (1965): 1, 1.995, 5.6, 10.39, 36 and so on.
    #[test]
    fn air_masses() {
        for (elevation, mass, within) in [(90.0, 1.0, 1e-3), (30.0, 1.995, 5e-3), (10.0, 5.60, 0.02), (5.0, 10.39, 0.1)]
        {
            assert!((air_mass(elevation) - mass).abs() < within, "{elevation}: {}", air_mass(elevation));
        }
        assert!((36.0..37.0).contains(&air_mass(0.0)) && air_mass(-5.0) == air_mass(0.0));
    }

    #[test]
    fn a_low_sun_is_weaker_and_redder_and_sets_without_a_jump() {
        let air = Atmosphere { from_space: true, ..atmosphere() }.air();
        let at = |degrees: f64| air.sunlight(-DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0));
        let mut before = at(90.0);
        for tenth in (-20..900).rev() {
            let now = at(f64::from(tenth) / 10.0);
            assert!((before - now).min_element() >= 0.0 && (before - now).max_element() < 0.05, "{tenth}: {now}");
            assert!(now.z <= now.y && now.y <= now.x);
            before = now;
        }
        assert_eq!(at(-0.3), DVec3::ZERO);
        assert!((visible_disc(0.0) - 0.5).abs() < 1e-12 && visible_disc(0.267) == 1.0);
    }
}
