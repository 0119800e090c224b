//! Weights that convert bands rendered with one lamp to another lamp.

use colorimetry::matrix::{determinant, inverse};
use spectra::{BandGrid, KM_LUMENS_PER_WATT, Observer, Tabulated};

use super::knots::Knots;
use crate::xyz::equal_energy_luminance;

/// Weights that convert the bands of a light group to its XYZ and its bands with a lamp.
///
/// Light of a lamp S(λ) reaches a pixel as L(λ) = T(λ) S(λ), where T is the transfer of the scene (all reflections and
/// transmissions along all paths), which does not depend on the lamp. A band holds the mean of T S over its width. T is
/// reconstructed from these means: within a band it is the parabola whose means, weighted by S, over the band itself and its two
/// neighbors (at the ends of the grid, over the last three bands) are those of the image, so the band's own value is kept exactly.
/// Then X′ = Kₘ ∫ T S′ x̄ dλ and L′ᵦ = ∫ᵦ T S′ dλ / Δλ. All of this is linear in the bands: one weight per band for
/// each of X, Y, Z and for each band.
///
/// The result is exact if T is a parabola over three bands. Where S does not determine the parabola (its lines are too close to a
/// common edge of two bands, or a neighbor is dark), a line or a constant replaces it; where S has no light at all, a band stays
/// dark.
#[derive(Clone, Debug, PartialEq)]
pub struct BandWeights {
    /// X, Y, Z per band.
    xyz: Vec<[f64; 3]>,
    /// For each band: the first band from which it is computed, and the weights of that band and the next two.
    bands: Vec<(usize, [f64; 3])>,
}

/// A band in which a lamp has visible light but the lamp of the render has none, so nothing is known there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DarkBand {
    /// Lower end of the band, nm.
    pub from_nm: f64,
    /// Upper end of the band, nm.
    pub to_nm: f64,
}

impl BandWeights {
    /// The largest fraction of a new lamp's Y that may lie in bands where the old lamp has no light.
    pub const DARK_SHARE: f64 = 1e-4;

    /// The weights for light whose lamp is unknown: its own spectrum takes the place of the transfer.
    pub fn observed(grid: &BandGrid, observer: Observer) -> Self {
        let one = |_| 1.0;
        let knots = Knots::new(grid, &[]);
        Self::of_powers(
            &Lamp::new(grid, &one, &knots),
            &one,
            (grid, &knots),
            observer,
        )
    }

    /// The weights that change light of the lamp `before` to light of the lamp `after`. Both cover the grid and are linear between
    /// their points, as returned by [`BandGrid::lamp`].
    ///
    /// Bands in which `before` has no light stay dark, provided that this is invisible: they may contain the fraction
    /// [`Self::DARK_SHARE`] of the Y of `after`.
    ///
    /// # Errors
    /// When they contain more; the error is the band with most of it.
    pub fn new(
        grid: &BandGrid,
        before: &Tabulated,
        after: &Tabulated,
        observer: Observer,
    ) -> Result<Self, DarkBand> {
        let knots = Knots::new(grid, &[before, after]);
        let after = |nm| after.clamped_at(nm);
        let lamp = Lamp::new(grid, &|nm| before.clamped_at(nm), &knots);
        match dark_band(&lamp, &after, (grid, &knots), observer) {
            Some(band) => Err(band),
            None => Ok(Self::of_powers(&lamp, &after, (grid, &knots), observer)),
        }
    }

    /// The weights from the lamp `before` to a lamp of the power `after`; 0 in bands where `before` has no light.
    fn of_powers(
        before: &Lamp,
        after: &dyn Fn(f64) -> f64,
        (grid, knots): (&BandGrid, &Knots),
        observer: Observer,
    ) -> Self {
        let scale = luminous_scale(observer);
        let mut xyz = vec![[0.0; 3]; before.means.len()];
        let mut bands = Vec::new();
        for band in 0..before.means.len() {
            let (from_nm, to_nm) = ends_of(grid, band);
            let stencil = before.stencil(band);
            let mut own = [0.0; 3];
            knots.integrate(from_nm, to_nm, |nm, d_nm| {
                let light = after(nm) * d_nm;
                let shares = stencil.shares((nm - grid.center_nm(band as u32)) / grid.width_nm());
                let seen = observer.at(nm);
                for (i, share) in shares.into_iter().enumerate() {
                    let power = before.means.get(stencil.first + i).copied();
                    if let Some(power) = power.filter(|&power| power > 0.0) {
                        let transfer = light * share / power;
                        own[i] += transfer / grid.width_nm();
                        let sums = &mut xyz[stencil.first + i];
                        *sums =
                            std::array::from_fn(|axis| sums[axis] + scale * transfer * seen[axis]);
                    }
                }
            });
            bands.push((stencil.first, own));
        }
        Self { xyz, bands }
    }

    /// The XYZ that a value of 1 in each band contributes, with Y in cd/m² up to the scene's scale.
    pub fn weights(&self) -> &[[f64; 3]] {
        &self.xyz
    }

    /// Returns the XYZ of one value of radiance per band, with Y in cd/m² up to the scene's scale.
    ///
    /// # Panics
    /// When the number of values is not the number of bands.
    pub fn xyz(&self, radiance: &[f32]) -> [f64; 3] {
        assert_eq!(radiance.len(), self.xyz.len(), "one value per band");
        let mut xyz = [0.0; 3];
        for (&value, weight) in radiance.iter().zip(&self.xyz) {
            for (sum, w) in xyz.iter_mut().zip(weight) {
                *sum += f64::from(value) * w;
            }
        }
        xyz
    }

    /// Returns the mean radiance over each band with the new lamp; never below 0.
    ///
    /// # Panics
    /// When the number of values is not the number of bands.
    pub fn relit<'a>(&'a self, radiance: &'a [f32]) -> impl Iterator<Item = f64> + 'a {
        self.relit_component(radiance).map(|sum| sum.max(0.0))
    }

    /// As [`Self::relit`] for a component of the Stokes vector, which may be below 0.
    ///
    /// # Panics
    /// When the number of values is not the number of bands.
    pub fn relit_component<'a>(&'a self, radiance: &'a [f32]) -> impl Iterator<Item = f64> + 'a {
        assert_eq!(radiance.len(), self.bands.len(), "one value per band");
        self.bands.iter().map(|(first, weights)| {
            let values = radiance[*first..].iter().zip(weights);
            values.map(|(&value, w)| f64::from(value) * w).sum()
        })
    }
}

/// Returns Kₘ; for observers other than that of 1931 the factor that gives an equal-energy radiance of 1 the same Y as for that
/// observer, so an exposure means the same for all of them.
fn luminous_scale(observer: Observer) -> f64 {
    if observer == Observer::Cie1931Deg2 {
        return KM_LUMENS_PER_WATT;
    }
    let sum: f64 = (380..=780).map(|nm| observer.at(f64::from(nm))[1]).sum();
    equal_energy_luminance() / sum
}

/// Returns the band with the most Y of `after` among the bands in which `before` has no light; `None` if all of them together
/// have too little to be visible.
fn dark_band(
    before: &Lamp,
    after: &dyn Fn(f64) -> f64,
    (grid, knots): (&BandGrid, &Knots),
    observer: Observer,
) -> Option<DarkBand> {
    let luminance = |band: usize| {
        let (from_nm, to_nm) = ends_of(grid, band);
        let mut sum = 0.0;
        knots.integrate(from_nm, to_nm, |nm, d_nm| {
            sum += after(nm) * observer.at(nm)[1] * d_nm;
        });
        sum
    };
    let of_bands: Vec<f64> = (0..before.means.len()).map(luminance).collect();
    let is_dark = |band: &usize| before.means[*band] <= 0.0;
    let dark = || (0..of_bands.len()).filter(is_dark);
    let share: f64 = dark().map(|band| of_bands[band]).sum();
    if share <= BandWeights::DARK_SHARE * of_bands.iter().sum::<f64>() {
        return None;
    }
    let most = dark().max_by(|&a, &b| of_bands[a].total_cmp(&of_bands[b]))?;
    let (from_nm, to_nm) = ends_of(grid, most);
    Some(DarkBand { from_nm, to_nm })
}

fn ends_of(grid: &BandGrid, band: usize) -> (f64, f64) {
    let at = |offset| grid.wavelength_nm(band as u32, offset);
    (at(0.0), at(1.0))
}

/// The moments of a lamp in the bands.
struct Lamp {
    /// Its mean over each band.
    means: Vec<f64>,
    /// Its centroid in each band, in band widths from the first band's center.
    centroids: Vec<f64>,
    /// Its mean square distance from the centroid in each band, in squared band widths.
    spreads: Vec<f64>,
}

impl Lamp {
    fn new(grid: &BandGrid, power: &dyn Fn(f64) -> f64, knots: &Knots) -> Self {
        let moments = (0..grid.count()).map(|band| {
            let (from_nm, to_nm) = ends_of(grid, band as usize);
            let mut moments = [0.0; 3];
            knots.integrate(from_nm, to_nm, |nm, d_nm| {
                let place = (nm - grid.center_nm(band)) / grid.width_nm();
                let power = power(nm) * d_nm / grid.width_nm();
                let powers = [power, power * place, power * place * place];
                moments = std::array::from_fn(|i| moments[i] + powers[i]);
            });
            moments
        });
        let moments: Vec<[f64; 3]> = moments.collect();
        let mean = |m: &[f64; 3], i: usize| if m[0] > 0.0 { m[i] / m[0] } else { 0.0 };
        let places = moments.iter().zip(0..);
        Self {
            means: moments.iter().map(|m| m[0]).collect(),
            centroids: places
                .map(|(m, band)| mean(m, 1) + f64::from(band))
                .collect(),
            spreads: moments
                .iter()
                .map(|m| mean(m, 2) - mean(m, 1).powi(2))
                .collect(),
        }
    }

    /// Returns how the transfer in a band follows from the values of bands.
    fn stencil(&self, band: usize) -> Stencil {
        let count = self.means.len();
        if count >= 3 && self.means[band] > 0.0 {
            let first = band.saturating_sub(1).min(count - 3);
            if let Some(stencil) = self
                .parabola(band, first)
                .or_else(|| self.line(band, first))
            {
                return stencil;
            }
        }
        Stencil::constant(band, count)
    }

    /// The parabola whose weighted means over three bands equal the bands' values.
    fn parabola(&self, band: usize, first: usize) -> Option<Stencil> {
        let is_lit = |i: &usize| self.means[*i] > 0.0;
        let apart = |i: usize| self.centroids[i + 1] - self.centroids[i] >= MIN_APART;
        if !(first..first + 3).all(|i| is_lit(&i)) || !apart(first) || !apart(first + 1) {
            return None;
        }
        // Means of 1, u and u², with u from the band's center.
        let rows: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let u = self.centroids[first + i] - band as f64;
            [1.0, u, u * u + self.spreads[first + i]]
        });
        (determinant(&rows).abs() > 1e-6).then(|| Stencil {
            first,
            coefficients: inverse(&rows),
        })
    }

    /// The line through the band's weighted mean with the slope between its neighbors, or to the one neighbor that is lit.
    fn line(&self, band: usize, first: usize) -> Option<Stencil> {
        let pairs = [
            (first, first + 2),
            (first, first + 1),
            (first + 1, first + 2),
        ];
        let usable = |&(low, high): &(usize, usize)| {
            let is_lit = self.means[low] > 0.0 && self.means[high] > 0.0;
            is_lit && self.centroids[high] - self.centroids[low] >= MIN_APART
        };
        let (low, high) = pairs.into_iter().find(usable)?;
        let apart = self.centroids[high] - self.centroids[low];
        let u = self.centroids[band] - band as f64;
        let mut stencil = Stencil::constant(band, first + 3);
        for (place, slope) in [(low - first, -1.0 / apart), (high - first, 1.0 / apart)] {
            stencil.coefficients[1][place] += slope;
            stencil.coefficients[0][place] -= slope * u;
        }
        Some(stencil)
    }
}

/// Centroids of bands closer than this, in band widths, define no slope: it would amplify noise more than twofold.
const MIN_APART: f64 = 0.5;

/// The transfer in a band as a polynomial of the position in the band, with coefficients that are linear in the transfers of three
/// bands.
struct Stencil {
    /// The first of the bands.
    first: usize,
    /// Coefficients of 1, u and u², for each of the bands.
    coefficients: [[f64; 3]; 3],
}

impl Stencil {
    /// A constant: the band's own transfer.
    fn constant(band: usize, count: usize) -> Self {
        let first = band.saturating_sub(1).min(count.saturating_sub(3));
        let mut coefficients = [[0.0; 3]; 3];
        coefficients[0][band - first] = 1.0;
        Self {
            first,
            coefficients,
        }
    }

    /// The weight of each of the bands in the transfer at `u`, in band widths from the band's center.
    fn shares(&self, u: f64) -> [f64; 3] {
        let [one, slope, bend] = &self.coefficients;
        std::array::from_fn(|i| one[i] + u * (slope[i] + u * bend[i]))
    }
}

#[cfg(test)]
mod tests;
