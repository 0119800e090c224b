//! CIE 1931 XYZ: of band values, and relative to an exposure.

use std::sync::OnceLock;

use spectra::{BandGrid, KM_LUMENS_PER_WATT, observer_1931};

/// Y, in cd/m², of the radiance 1 W m⁻² sr⁻¹ nm⁻¹ at every wavelength.
///
/// Y = Kₘ Σ ȳ(λ) Δλ at 380, 381 … 780 nm with Kₘ = 683 lm/W (CIE 015:2018), about 7.298e4.
pub fn equal_energy_luminance() -> f64 {
    static LUMINANCE: OnceLock<f64> = OnceLock::new();
    *LUMINANCE.get_or_init(|| {
        let [_, y_bar, _] = observer_1931();
        let sum: f64 = (380..=780).map(|nm| y_bar.clamped_at(f64::from(nm))).sum();
        KM_LUMENS_PER_WATT * sum
    })
}

/// What XYZ in cd/m² is multiplied by at an exposure of `exposure_ev` stops: the radiance 1 at every
/// wavelength then has Y = 2^EV.
pub fn exposure_scale(exposure_ev: f64) -> f64 {
    exposure_ev.exp2() / equal_energy_luminance()
}

/// The observer integrated over each band of a grid, so that band values give XYZ in one sum.
///
/// X = Kₘ Σ Lᵦ ∫ᵦ x̄(λ) dλ over the bands β, with Lᵦ the mean radiance over a band; the integral is
/// exact for x̄ linear between its 1 nm points. The error is that of taking L and x̄ as uncorrelated
/// within a band: below one per cent for films of a few hundred nanometres and bands of 10 nm.
#[derive(Clone, Debug, PartialEq)]
pub struct BandObserver {
    weights: Vec<[f64; 3]>,
}

impl BandObserver {
    /// The observer on the bands of `grid`.
    pub fn new(grid: &BandGrid) -> Self {
        let weight = |band| {
            let from = grid.wavelength_nm(band, 0.0);
            let to = grid.wavelength_nm(band, 1.0);
            integral(from, to).map(|value| KM_LUMENS_PER_WATT * value)
        };
        Self {
            weights: (0..grid.count()).map(weight).collect(),
        }
    }

    /// XYZ in cd/m² of a radiance of 1 in each band alone.
    pub fn weights(&self) -> &[[f64; 3]] {
        &self.weights
    }

    /// XYZ in cd/m² of one value of radiance per band, W m⁻² sr⁻¹ nm⁻¹.
    ///
    /// # Panics
    /// When there is not one value per band.
    pub fn xyz(&self, radiance: &[f32]) -> [f64; 3] {
        assert_eq!(radiance.len(), self.weights.len(), "one value per band");
        let mut xyz = [0.0; 3];
        for (&value, weight) in radiance.iter().zip(&self.weights) {
            for (sum, w) in xyz.iter_mut().zip(weight) {
                *sum += f64::from(value) * w;
            }
        }
        xyz
    }
}

/// ∫ x̄, ȳ, z̄ dλ between two wavelengths, by trapezia between the whole nanometres.
fn integral(from_nm: f64, to_nm: f64) -> [f64; 3] {
    observer_1931().each_ref().map(|function| {
        let mut low = from_nm;
        let mut sum = 0.0;
        while low < to_nm {
            let high = (low.floor() + 1.0).min(to_nm);
            sum += 0.5 * (function.clamped_at(low) + function.clamped_at(high)) * (high - low);
            low = high;
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reflectance of a free film of index 4/3 in air at normal incidence, Airy's sum of all beams.
    fn film(thickness_nm: f64, nm: f64) -> f64 {
        let n = 4.0_f64 / 3.0;
        let r2 = ((1.0 - n) / (1.0 + n)).powi(2);
        let half_phase = 2.0 * std::f64::consts::PI * n * thickness_nm / nm;
        let f = 4.0 * r2 / (1.0 - r2).powi(2) * half_phase.sin().powi(2);
        f / (1.0 + f)
    }

    /// XYZ of a film under D65, as 100 for a perfect mirror.
    fn film_xyz(bands: u32, thickness_nm: f64) -> [f64; 3] {
        let grid = BandGrid::visible(bands).unwrap();
        let light = spectra::illuminant("D65").unwrap().data;
        // The mean over a band, from 20 points within it.
        let mean = |band| {
            let points = (0..20).map(|i| grid.wavelength_nm(band, (f64::from(i) + 0.5) / 20.0));
            let sum: f64 = points
                .map(|nm| light.at(nm).unwrap() * film(thickness_nm, nm))
                .sum();
            (sum / 20.0) as f32
        };
        let radiance: Vec<f32> = (0..bands).map(mean).collect();
        let scale = 100.0 * exposure_scale(0.0);
        BandObserver::new(&grid).xyz(&radiance).map(|v| v * scale)
    }

    #[test]
    fn equal_energy_of_one_is_one() {
        for bands in [1, 7, 40, 400] {
            let grid = BandGrid::visible(bands).unwrap();
            let xyz = BandObserver::new(&grid).xyz(&vec![1.0; bands as usize]);
            // The 1 nm sum counts both ends whole, the integral by half: 2.5e-7 in Y.
            assert!((xyz[1] * exposure_scale(0.0) - 1.0).abs() < 5e-7, "{xyz:?}");
        }
        assert!((exposure_scale(3.0) / exposure_scale(0.0) - 8.0).abs() < 1e-14);
    }

    /// XYZ of free films of index 4/3 in D65, sums at 1 nm, computed apart from this code (numpy).
    const FILMS: [(f64, [f64; 3]); 3] = [
        (100.0, [7.162_974_235, 7.723_408_026, 7.901_314_441]),
        (250.0, [2.467_596_401, 3.044_270_922, 8.058_016_66]),
        (320.0, [5.732_695_308, 6.910_545_627, 1.753_966_797]),
    ];

    #[test]
    fn films_have_the_colour_of_an_independent_computation() {
        for (thickness_nm, expected) in FILMS {
            for (bands, tolerance) in [(400, 2e-4), (40, 1e-2)] {
                let xyz = film_xyz(bands, thickness_nm);
                for (found, expected) in xyz.iter().zip(expected) {
                    let error = found / expected - 1.0;
                    assert!(
                        error.abs() < tolerance,
                        "{thickness_nm} nm, {bands} bands: {error:e}"
                    );
                }
            }
        }
    }
}
