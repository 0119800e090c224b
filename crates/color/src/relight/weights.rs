//! What bands that were seen under one lamp weigh under another.

use colorimetry::matrix::{determinant, inverse};
use spectra::{BandGrid, KM_LUMENS_PER_WATT, Observer, Tabulated};

use super::knots::Knots;
use crate::xyz::equal_energy_luminance;

/// Turns the bands of a light group into its XYZ, and into its bands, under a lamp.
///
/// Light of a lamp S(λ) reaches a pixel as L(λ) = T(λ) S(λ), with T the transfer of the scene (all reflections and
/// transmissions along all paths), which no lamp changes. A band holds the mean of T S over its width. T is reconstructed
/// from these means: within a band as the parabola whose means, weighted by S, over the band itself and its two neighbors are
/// those of the image (at the ends of the grid, over the last three bands), so that the band's own value is kept exactly.
/// Then X′ = Kₘ ∫ T S′ x̄ dλ and L′ᵦ = ∫ᵦ T S′ dλ / Δλ. All of this is linear in the bands: one weight per band for
/// each of X, Y, Z and for each band.
///
/// It is exact where T is a parabola over three bands. Where S is no guide (its lines lie too close to a common edge of two
/// bands, or a neighbor is dark) the parabola is a line, or a constant; where it gives no light at all a band stays dark.
#[derive(Clone, Debug, PartialEq)]
pub struct BandWeights {
    /// X, Y, Z per band.
    xyz: Vec<[f64; 3]>,
    /// Band by band: the first band that it is made of, and the weights of this and the next ones.
    bands: Vec<(usize, [f64; 3])>,
}

/// A lamp gives light that is seen where the lamp that an image was rendered with gives none, so that nothing is known there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DarkBand {
    /// Lower end of the band, nm.
    pub from_nm: f64,
    /// Upper end of the band, nm.
    pub to_nm: f64,
}

impl BandWeights {
    /// The largest share of a new lamp's Y that may lie in bands where the old lamp gives no light.
    pub const DARK_SHARE: f64 = 1e-4;

    /// For light whose lamp is not known: its own spectrum takes the transfer's place.
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

    /// For light of the lamp `before` that is to be light of the lamp `after`; both cover the grid, and are linear between
    /// their points, as [`BandGrid::lamp`] makes them.
    ///
    /// Bands in which `before` gives no light stay dark, as long as nobody sees that: they may have a share of
    /// [`Self::DARK_SHARE`] of the Y of `after`.
    ///
    /// # Errors
    /// When they have a larger one: the band with most of it.
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

    /// The weights from the lamp `before` to that of the power `after`; 0 in bands where `before` gives no light.
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

    /// XYZ, Y in cd/m² up to the scene's scale, that a value of 1 in each band adds.
    pub fn weights(&self) -> &[[f64; 3]] {
        &self.xyz
    }

    /// XYZ, Y in cd/m² up to the scene's scale, of one value of radiance per band.
    ///
    /// # Panics
    /// When there is not one value per band.
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

    /// The mean radiance over each band under the new lamp; nowhere below 0.
    ///
    /// # Panics
    /// When there is not one value per band.
    pub fn relit<'a>(&'a self, radiance: &'a [f32]) -> impl Iterator<Item = f64> + 'a {
        assert_eq!(radiance.len(), self.bands.len(), "one value per band");
        self.bands.iter().map(|(first, weights)| {
            let values = radiance[*first..].iter().zip(weights);
            let sum: f64 = values.map(|(&value, w)| f64::from(value) * w).sum();
            sum.max(0.0)
        })
    }
}

/// Kₘ, and for observers other than that of 1931 what makes an equal-energy radiance of 1 as bright as to that one: an
/// exposure then means the same for all of them.
fn luminous_scale(observer: Observer) -> f64 {
    if observer == Observer::Cie1931Deg2 {
        return KM_LUMENS_PER_WATT;
    }
    let sum: f64 = (380..=780).map(|nm| observer.at(f64::from(nm))[1]).sum();
    equal_energy_luminance() / sum
}

/// Of the bands in which `before` gives no light the one that has most of the Y of `after`; `None` where all of them together
/// have too little to be seen.
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

/// A lamp as the bands see it.
struct Lamp {
    /// Its mean over each band.
    means: Vec<f64>,
    /// Its centroid in each band, in band widths from the first band's center.
    centroids: Vec<f64>,
    /// The mean square of the place about the centroid, likewise.
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

    /// How the transfer in a band follows from bands.
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

    /// The parabola whose weighted means over three bands are theirs.
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

    /// The line through the band's weighted mean with the slope of its neighbors, or toward the one that is lit.
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

/// Centroids of bands that are nearer than this, in band widths, give no slope between them: noise would grow more than twofold.
const MIN_APART: f64 = 0.5;

/// The transfer in a band as a polynomial of the place in the band, its coefficients linear in the transfers of three bands.
struct Stencil {
    /// The first of the bands.
    first: usize,
    /// Of 1, u and u², for each of the bands.
    coefficients: [[f64; 3]; 3],
}

impl Stencil {
    /// The band's own transfer.
    fn constant(band: usize, count: usize) -> Self {
        let first = band.saturating_sub(1).min(count.saturating_sub(3));
        let mut coefficients = [[0.0; 3]; 3];
        coefficients[0][band - first] = 1.0;
        Self {
            first,
            coefficients,
        }
    }

    /// The share of each of the bands in the transfer at `u`, in band widths from the band's center.
    fn shares(&self, u: f64) -> [f64; 3] {
        let [one, slope, bend] = &self.coefficients;
        std::array::from_fn(|i| one[i] + u * (slope[i] + u * bend[i]))
    }
}

#[cfg(test)]
mod tests;
