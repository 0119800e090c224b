//! A model of the clear sky and the sun, as a function of turbidity and the sun's elevation.
//!
//! A. J. Preetham, P. Shirley and B. Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999: luminance and chromaticity of
//! the sky fitted to a simulation of multiple scattering (appendix A.2), the spectrum as CIE daylight of that chromaticity
//! (appendix A.5), and sunlight attenuated by the atmosphere (appendix A.1, after M. Iqbal, An Introduction to Solar Radiation, 1983).
//! The fit covers turbidities of 2 to 6; near the sun and toward the horizon, real skies differ from it.

use crate::Spectrum;
use crate::data::{KM_LUMENS_PER_WATT, daylight_components, observer_1931};
use std::f64::consts::PI;

mod figures;

use figures::{GASES, OZONE, PEREZ, SUN, VAPOR, ZENITH_X, ZENITH_Y};

/// Angular diameter of the sun, degrees.
pub const SUN_DIAMETER_DEG: f64 = 0.533;
/// Thickness of the ozone layer, cm at normal temperature and pressure.
const OZONE_CM: f64 = 0.35;
/// Precipitable water, cm.
const WATER_CM: f64 = 2.0;

/// A clear sky at one time.
#[derive(Clone, Debug)]
pub struct ClearSky {
    /// Zenith angle of the sun, radians.
    sun_angle: f64,
    turbidity: f64,
    /// Luminance in kcd/m², x and y at the zenith.
    zenith: [f64; 3],
    /// Perez coefficients A to E of luminance, x and y.
    perez: [[f64; 5]; 3],
}

/// Skylight from one direction, as amounts of the three components of daylight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLight {
    /// Radiance of each component where its value is 1, W m⁻² sr⁻¹ nm⁻¹.
    pub amounts: [f64; 3],
}

impl ClearSky {
    /// Range of turbidities that are accepted: 2 to 6, for which the model was fitted, and far above, where the fit is extrapolated.
    /// Below 2 the fit reverses: clearer air would give more light.
    pub const TURBIDITY: (f64, f64) = (2.0, 10.0);

    /// Creates the sky for a zenith angle of the sun from 0 to π/2 and a turbidity within [`Self::TURBIDITY`].
    pub fn new(sun_angle: f64, turbidity: f64) -> Self {
        let t = turbidity;
        // χ = (4/9 − T/120) (π − 2 θ).
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * sun_angle);
        let luminance = (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192;
        let fitted = |rows: &[[f64; 4]; 3]| {
            let of_row = |row: &[f64; 4]| row.iter().fold(0.0, |sum, c| sum * sun_angle + c);
            (of_row(&rows[0]) * t + of_row(&rows[1])) * t + of_row(&rows[2])
        };
        Self {
            sun_angle,
            turbidity,
            zenith: [luminance.max(0.0), fitted(&ZENITH_X), fitted(&ZENITH_Y)],
            perez: PEREZ.map(|rows| rows.map(|[slope, start]| slope * t + start)),
        }
    }

    /// Returns luminance in cd/m² and chromaticity x, y in a direction above the horizon, given by the cosine of its zenith angle and
    /// its angle from the sun.
    pub fn color(&self, cosine: f64, from_sun: f64) -> [f64; 3] {
        let [luminance, x, y] = std::array::from_fn(|i| {
            let perez = &self.perez[i];
            let here = distribution(perez, cosine, from_sun);
            self.zenith[i] * here / distribution(perez, 1.0, self.sun_angle)
        });
        [1000.0 * luminance.max(0.0), x, y]
    }

    /// Returns the light from a direction above the horizon; arguments as for [`Self::color`].
    pub fn light(&self, cosine: f64, from_sun: f64) -> SkyLight {
        let [luminance, x, y] = self.color(cosine, from_sun);
        // M₁ and M₂ for a chromaticity (CIE 015:2018, equations 4.8 and 4.9).
        let below = 0.0241 + 0.2562 * x - 0.7341 * y;
        let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / below;
        let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / below;
        let [s0, s1, s2] = component_luminances();
        let scale = luminance / (s0 + m1 * s1 + m2 * s2);
        SkyLight {
            amounts: [scale, scale * m1, scale * m2],
        }
    }

    /// Returns the radiance of the sun's disk at the ground, W m⁻² sr⁻¹ nm⁻¹. The tables cover 380 to 750 nm.
    pub fn sun_radiance(&self, nm: f64) -> f64 {
        let um = nm / 1000.0;
        // Relative optical mass (Kasten 1966).
        let degrees = self.sun_angle.to_degrees();
        let mass = 1.0 / (self.sun_angle.cos() + 0.15 * (93.885 - degrees).powf(-1.253));
        // Ångström's β from the turbidity, with α = 1.3.
        let beta = (0.046_083_658_220_5 * self.turbidity - 0.045_860_259_285_22).max(0.0);
        let rayleigh = 0.008_735 * mass * um.powf(-4.08);
        let aerosol = mass * beta * um.powf(-1.3);
        let ozone = mass * OZONE_CM * linear(&OZONE, nm);
        let gases = linear(&GASES, nm) * mass;
        let gases = 1.41 * gases / (1.0 + 118.93 * gases).powf(0.45);
        let vapor = linear(&VAPOR, nm) * WATER_CM * mass;
        let vapor = 0.2385 * vapor / (1.0 + 20.07 * vapor).powf(0.45);
        100.0 * sun_above_the_air(nm) * (-(rayleigh + aerosol + ozone + gases + vapor)).exp()
    }
}

impl SkyLight {
    /// Returns the radiance at a wavelength where the components have these values, W m⁻² sr⁻¹ nm⁻¹; not below 0.
    pub fn of_components(&self, components: [f64; 3]) -> f64 {
        let terms = self.amounts.iter().zip(components);
        terms
            .map(|(amount, value)| amount * value)
            .sum::<f64>()
            .max(0.0)
    }
}

/// The components S₀, S₁ and S₂ of daylight, from 300 to 830 nm.
pub fn daylight_basis() -> [Spectrum; 3] {
    daylight_components().clone().map(Spectrum::Table)
}

/// Perez's distribution (1 + A exp(B / cos θ)) (1 + C exp(D γ) + E cos² γ) (Perez et al. 1993, equation 3 of the model).
fn distribution(&[a, b, c, d, e]: &[f64; 5], cosine: f64, from_sun: f64) -> f64 {
    let toward = from_sun.cos();
    (1.0 + a * (b / cosine.max(1e-3)).exp())
        * (1.0 + c * (d * from_sun).exp() + e * toward * toward)
}

/// Luminance Kₘ Σ S ȳ Δλ of each component, by sums at 1 nm from 380 to 780 nm.
fn component_luminances() -> [f64; 3] {
    static FOUND: std::sync::OnceLock<[f64; 3]> = std::sync::OnceLock::new();
    *FOUND.get_or_init(|| {
        let [_, y, _] = observer_1931();
        daylight_components().each_ref().map(|component| {
            let product = |nm| component.clamped_at(nm) * y.clamped_at(nm);
            KM_LUMENS_PER_WATT * (380..=780).map(|nm| product(f64::from(nm))).sum::<f64>()
        })
    })
}

/// Returns the radiance of the sun above the atmosphere in units of 10 W cm⁻² µm⁻¹ sr⁻¹; beyond the table, extrapolated as a black
/// body of 5777 K.
fn sun_above_the_air(nm: f64) -> f64 {
    let (end, _) = SUN[SUN.len() - 1];
    let beyond = crate::black_body(nm.max(end), 5777.0) / crate::black_body(end, 5777.0);
    linear(&SUN, nm) * beyond
}

/// Interpolates linearly between points; beyond them, returns the first or last value.
fn linear(points: &[(f64, f64)], nm: f64) -> f64 {
    let after = points.partition_point(|&(at, _)| at <= nm);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some((low_nm, low)), Some(&(high_nm, high))) => {
            low + (high - low) * (nm - low_nm) / (high_nm - low_nm)
        }
        (Some((_, last)), None) => last,
        (None, first) => first.map_or(0.0, |&(_, value)| value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Observer;
    use std::f64::consts::FRAC_PI_2;

    fn xyz(radiance: impl Fn(f64) -> f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for nm in (380..=780).map(f64::from) {
            let power = KM_LUMENS_PER_WATT * radiance(nm);
            let seen = Observer::Cie1931Deg2.at(nm);
            sums = std::array::from_fn(|i| sums[i] + power * seen[i]);
        }
        sums
    }

    fn spectrum(light: SkyLight) -> impl Fn(f64) -> f64 {
        move |nm| light.of_components(daylight_components().each_ref().map(|s| s.clamped_at(nm)))
    }

    /// The spectrum has the luminance and chromaticity of the fit; clipping at 0 changes neither.
    #[test]
    fn spectra_have_the_colors_of_the_fit() {
        for (sun_deg, turbidity) in [(30.0_f64, 2.0), (60.0, 3.0), (80.0, 6.0)] {
            let sky = ClearSky::new(sun_deg.to_radians(), turbidity);
            for (angle_deg, from_sun_deg) in [(0.0_f64, sun_deg), (45.0, 40.0), (85.0, 100.0_f64)] {
                let (cosine, from_sun) = (angle_deg.to_radians().cos(), from_sun_deg.to_radians());
                let [luminance, x, y] = sky.color(cosine, from_sun);
                let [fx, fy, fz] = xyz(spectrum(sky.light(cosine, from_sun)));
                let sum = fx + fy + fz;
                assert!((fy / luminance - 1.0).abs() < 1e-3, "{fy} {luminance}");
                // The CIE's formulas for M₁ and M₂ are rounded.
                assert!(
                    (fx / sum - x).abs() < 2e-3 && (fy / sum - y).abs() < 2e-3,
                    "{x} {y}"
                );
            }
        }
    }

    /// The luminance of the zenith by hand: T = 3, θ = 60°: χ = 0.419444 · 1.047198 = 0.439241, tan χ = 0.469854;
    /// (12.1359 − 4.9710) · 0.469854 − 0.6465 + 2.4192 = 5.13916 kcd/m².
    #[test]
    fn the_zenith_has_the_luminance_of_the_formula() {
        let sky = ClearSky::new(60.0_f64.to_radians(), 3.0);
        let [luminance, x, y] = sky.color(1.0, 60.0_f64.to_radians());
        assert!((luminance - 5139.16).abs() < 0.02, "{luminance}");
        // Bluer than daylight of 10 000 K (x = 0.2788, y = 0.2920, CIE 015:2018, equations 4.5 to 4.7).
        assert!(x < 0.2788 && y < 0.2920, "{x} {y}");
    }

    /// The sun's illuminance above the atmosphere is 127.5 klx (IES RP-21, Calculation of Daylight Availability, 1984).
    #[test]
    fn the_sun_above_the_air_is_as_bright_as_measured() {
        let half = (SUN_DIAMETER_DEG / 2.0).to_radians();
        let lux = xyz(|nm| 100.0 * sun_above_the_air(nm))[1] * PI * half.sin().powi(2);
        assert!((lux / 127.5e3 - 1.0).abs() < 0.05, "{lux}");
    }

    /// Sunlight reddens and dims toward the horizon, and the atmosphere never increases it.
    #[test]
    fn sunlight_reddens_toward_the_horizon() {
        let redness = |degrees: f64| {
            let sky = ClearSky::new(degrees.to_radians(), 2.5);
            let [x, y, z] = xyz(|nm| sky.sun_radiance(nm));
            (x / (x + y + z), y)
        };
        let steps = [0.0, 30.0, 60.0, 80.0, 88.0, 90.0].map(redness);
        assert!(
            steps
                .windows(2)
                .all(|pair| pair[0].0 < pair[1].0 && pair[0].1 > pair[1].1),
            "{steps:?}"
        );
        // Direct sunlight of a high sun through clear air: 90 to 115 klx at normal incidence.
        let half = (SUN_DIAMETER_DEG / 2.0).to_radians();
        let lux = steps[1].1 * PI * half.sin().powi(2);
        assert!((85e3..120e3).contains(&lux), "{lux}");
        let sky = ClearSky::new(0.5, 2.5);
        assert!(
            (380..=780)
                .map(f64::from)
                .all(|nm| sky.sun_radiance(nm) < 100.0 * sun_above_the_air(nm))
        );
    }

    /// Illuminance of the ground by skylight, lux.
    fn skylight(sun: f64, turbidity: f64, steps: i32) -> f64 {
        let sky = ClearSky::new(sun, turbidity);
        let mut lux = 0.0;
        for i in 0..steps {
            let angle = FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(steps);
            for j in 0..4 * steps {
                let turn = PI * (f64::from(j) + 0.5) / f64::from(2 * steps);
                let toward = sun.cos() * angle.cos() + sun.sin() * angle.sin() * turn.cos();
                let solid_angle =
                    angle.sin() * FRAC_PI_2 / f64::from(steps) * PI / f64::from(2 * steps);
                let [luminance, ..] = sky.color(angle.cos(), toward.clamp(-1.0, 1.0).acos());
                assert!(luminance > 0.0, "{sun} {turbidity}: {luminance}");
                lux += luminance * angle.cos() * solid_angle;
            }
        }
        lux
    }

    /// For a sun 40° from the zenith and T = 3, the fit gives 30 klx of skylight on the ground.
    #[test]
    fn the_sky_lights_the_ground_as_the_fit_says() {
        let lux = skylight(40.0_f64.to_radians(), 3.0, 90);
        assert!((lux / 30.0e3 - 1.0).abs() < 0.02, "{lux}");
    }

    /// Every direction has light for every accepted turbidity, and a lower sun gives less light, except that under the clearest skies the
    /// fit deviates from this order by up to 7 % above 45°. A turbidity of 1.7 would give twice the light of 2.
    #[test]
    fn skylight_falls_with_the_sun() {
        for turbidity in [2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 10.0] {
            let angles = (0..=18).map(|step| (5.0 * f64::from(step)).min(89.99));
            let lux: Vec<f64> = angles
                .map(|degrees| skylight(degrees.to_radians(), turbidity, 24))
                .collect();
            for (step, pair) in lux.windows(2).enumerate() {
                let least = lux[..=step].iter().copied().fold(f64::INFINITY, f64::min);
                let most = if step < 9 { 1.07 * least } else { pair[0] };
                assert!(pair[1] < most, "{turbidity}: {lux:.0?}");
            }
        }
        assert!(skylight(0.5, 1.7, 24) > 1.5 * skylight(0.5, 2.0, 24));
    }
}
