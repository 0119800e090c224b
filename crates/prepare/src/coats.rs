//! The reflectance of a rough coat as a function of direction and wavelength.

use crate::distribution_of;
use scene::{CoatedBody, FacetTable, Microsurface, facet_direction};
use spectra::{BandTable, knot_before};
use std::f64::consts::FRAC_PI_2;

/// Number of knots over the square root of the cosine.
const COSINES: usize = CoatedBody::COSINES;
/// Number of knots over the square root of the cosine at the facet.
const FACET_COSINES: usize = 128;
/// Square root of the number of facets per direction.
const STEPS: u32 = 48;
/// Number of azimuths within a quarter turn, if the reflectance depends on azimuth.
const AZIMUTHS: u32 = 6;

/// The reflectance and transmittance of a rough coat.
#[derive(Clone, Debug)]
pub struct RoughCoat {
    /// The reflectance E₀ at [`CoatedBody::COSINES`] cosines whose square roots are equally spaced; for a brushed coat, roughly its mean over azimuth.
    pub reflectances: [BandTable; COSINES],
    /// For a brushed coat, (1 − E)/(1 − E₀) as a function of direction.
    pub transmittance_scale: Option<FacetTable>,
    /// The mean Ē for diffuse light, computed from the linear interpolation between the knots.
    pub mean: BandTable,
}

impl RoughCoat {
    /// A coat of index `n`. Light that hits several facets is included by `optics::multiple_color`.
    ///
    /// The azimuthal variation of a brushed coat is that of the single index `typical_n`: 1 − E is the product of a table over the
    /// direction and one over the cosine and the wavelength.
    pub fn new(microsurface: &Microsurface, n: &BandTable, typical_n: f64) -> Self {
        let visible = std::array::from_fn(|knot| {
            VisibleFacets::about(microsurface, cosine_of(knot, COSINES))
        });
        let reflectances = visible
            .each_ref()
            .map(|facets: &VisibleFacets| n.map(|n| facets.reflectance(n)));
        let is_brushed = microsurface.energy.table().widths() > 1;
        let transmittance_scale = is_brushed.then(|| {
            let about = visible
                .each_ref()
                .map(|visible| 1.0 - visible.reflectance(typical_n));
            FacetTable::new(microsurface.roughness, |wo| {
                let passes = 1.0 - VisibleFacets::from(microsurface, wo).reflectance(typical_n);
                passes / about[(wo[2].sqrt() * (COSINES - 1) as f64).round() as usize]
            })
        });
        let mean = mean_of(&reflectances, |cosine| {
            transmittance_scale
                .as_ref()
                .map_or(1.0, |table| table.around(cosine))
        });
        Self {
            reflectances,
            transmittance_scale,
            mean,
        }
    }
}

fn cosine_of(knot: usize, knots: usize) -> f64 {
    (knot as f64 / (knots - 1) as f64).powi(2)
}

/// The facets that are visible from a direction.
struct VisibleFacets {
    /// The reflected weight of the facets at each of [`FACET_COSINES`] cosines to the direction, distributed by hat functions over the
    /// square roots of the cosines.
    weights: [f64; FACET_COSINES],
    /// The fraction of light that hits several facets.
    lost: f64,
    /// The mean directional albedo of the facets.
    mean_energy: f64,
}

impl VisibleFacets {
    /// The facets visible from a direction.
    fn from(microsurface: &Microsurface, wo: [f64; 3]) -> Self {
        let surface = optics::Microsurface {
            distribution: distribution_of(microsurface.distribution),
            alpha: microsurface.roughness,
        };
        let mut weights = [0.0; FACET_COSINES];
        surface.each_reflection(wo, STEPS, |at_facet, weight| {
            let (knot, part) = knot_before(at_facet.clamp(0.0, 1.0).sqrt(), FACET_COSINES);
            weights[knot] += weight * (1.0 - part);
            weights[knot + 1] += weight * part;
        });
        Self {
            weights,
            lost: 1.0 - microsurface.energy.at(wo),
            mean_energy: microsurface.energy.mean(),
        }
    }

    /// The mean over azimuth.
    fn about(microsurface: &Microsurface, cosine: f64) -> Self {
        let azimuths = match microsurface.energy.table().widths() {
            1 => 1,
            _ => AZIMUTHS,
        };
        let mut mean = Self {
            weights: [0.0; FACET_COSINES],
            lost: 0.0,
            mean_energy: microsurface.energy.mean(),
        };
        for azimuth in 0..azimuths {
            let azimuth = FRAC_PI_2 * (f64::from(azimuth) + 0.5) / f64::from(azimuths);
            let visible = Self::from(microsurface, facet_direction(cosine.max(1e-4), azimuth));
            let pairs = mean.weights.iter_mut().zip(visible.weights);
            pairs.for_each(|(sum, weight)| *sum += weight / f64::from(azimuths));
            mean.lost += visible.lost / f64::from(azimuths);
        }
        mean
    }

    /// The reflectance of a coat of index `n`.
    fn reflectance(&self, n: f64) -> f64 {
        let fresnel = |cosine: f64| optics::reflectance_unpolarized(n.into(), cosine.max(1e-6));
        let facets = self.weights.iter().enumerate();
        let once: f64 = facets
            .map(|(facet, weight)| weight * fresnel(cosine_of(facet, FACET_COSINES)))
            .sum();
        let mean = optics::mean_reflectance(fresnel);
        once + self.lost * optics::multiple_color(mean, self.mean_energy)
    }
}

/// Ē with 1 − Ē = ∫ (1 − E₀) g 2 cos θ d(cos θ) = ∫ (1 − E₀) g 4 t³ dt, where g is the mean of `transmittance_scale` over azimuth.
/// Three-point Gauss quadrature is exact if E₀ and g are linear in t between the knots.
fn mean_of(knots: &[BandTable; COSINES], transmittance_scale: impl Fn(f64) -> f64) -> BandTable {
    const GAUSS: [(f64, f64); 3] = [
        (0.112_701_665_379_258_3, 5.0 / 18.0),
        (0.5, 8.0 / 18.0),
        (0.887_298_334_620_741_7, 5.0 / 18.0),
    ];
    let width = 1.0 / (COSINES - 1) as f64;
    let mut shares = [0.0; COSINES];
    for knot in 0..COSINES - 1 {
        for (part, weight) in GAUSS {
            let t = (knot as f64 + part) * width;
            let share = weight * width * 4.0 * t.powi(3) * transmittance_scale(t * t);
            shares[knot] += share * (1.0 - part);
            shares[knot + 1] += share * part;
        }
    }
    // The part that does not depend on the reflectance; 0 except for the deviation of the mean `transmittance_scale` from 1.
    let rest = 1.0 - shares.iter().sum::<f64>();
    let first = knots[0].map(|e| rest + shares[0] * e);
    let others = knots.iter().zip(shares).skip(1);
    others.fold(first, |sum, (table, share)| {
        sum.combined(table, |sum, e| sum + share * e)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::energy;
    use scene::{Distribution, Grain};
    use spectra::{BandGrid, Spectrum};
    use std::sync::Arc;

    fn coat(roughness: f64, n: f64) -> ([BandTable; COSINES], BandTable) {
        let microsurface = Microsurface {
            distribution: Distribution::Beckmann,
            roughness: [roughness; 2],
            grain: Grain::None,
            energy: Arc::new(energy(Distribution::Beckmann, [roughness; 2])),
        };
        let grid = BandGrid::visible(1).unwrap();
        let index = BandTable::new(&grid, &Spectrum::Constant(n)).unwrap();
        let coat = RoughCoat::new(&microsurface, &index, n);
        (coat.reflectances, coat.mean)
    }

    /// A nearly smooth coat reflects like a smooth one, except near grazing, where its facets' slopes matter, and its mean is that of glass
    /// for diffuse light.
    #[test]
    fn a_nearly_smooth_coat_is_smooth() {
        let (knots, mean) = coat(0.02, 1.5);
        for (knot, of_knot) in knots.iter().enumerate().skip(12) {
            let exact = optics::reflectance_unpolarized(1.5.into(), cosine_of(knot, COSINES));
            let found = of_knot.extent().0;
            assert!(
                (found - exact).abs() < 0.01 * exact + 1e-3,
                "{knot}: {found} {exact}"
            );
        }
        let smooth = optics::hemispherical_reflectance(1.5.into());
        assert!((mean.extent().0 - smooth).abs() < 2e-3);
    }

    /// A mirror, approximated by an enormous index, reflects everything, after one or several facets.
    #[test]
    fn a_mirror_keeps_nothing() {
        for roughness in [0.05, 0.3, 1.0] {
            let (knots, mean) = coat(roughness, 1e9);
            for table in knots.iter().skip(2) {
                assert!(
                    (table.extent().0 - 1.0).abs() < 5e-3,
                    "{:?}",
                    table.extent()
                );
            }
            assert!((mean.extent().0 - 1.0).abs() < 5e-3);
        }
    }

    /// The two tables against E itself, between the knots and at all azimuths: the error of 1 − E is at most 0.003 if the index is the
    /// typical one; if the typical index is 0.1 higher, it is at most 0.003 near 1.5 and 0.01 near 2.4. Without `transmittance_scale` it is
    /// far larger.
    #[test]
    fn a_brushed_coat_is_a_product_of_two_tables() {
        let mut without = 0.0_f64;
        for distribution in [Distribution::Beckmann, Distribution::Ggx] {
            for roughness in [[0.02, 0.3], [0.4, 0.05], [0.05, 1.0]] {
                let microsurface = Microsurface {
                    distribution,
                    roughness,
                    grain: Grain::Along(glam::DVec3::X),
                    energy: Arc::new(energy(distribution, roughness)),
                };
                let grid = BandGrid::new(400.0, 700.0, 2).unwrap();
                for (typical, bound) in [(1.5, 0.003), (2.4, 0.003), (1.6, 0.003), (2.5, 0.01)] {
                    let n = if typical < 2.0 { 1.5 } else { 2.4 };
                    let index = BandTable::new(&grid, &Spectrum::Constant(n)).unwrap();
                    let coat = RoughCoat::new(&microsurface, &index, typical);
                    let [mut worst, mut even] = [0.0_f64; 2];
                    for i in 0..150 {
                        let wo = facet_direction(
                            (f64::from(i) / 149.0 * 85.0).to_radians().cos(),
                            0.77 * f64::from(i),
                        );
                        let exact = 1.0 - VisibleFacets::from(&microsurface, wo).reflectance(n);
                        let about = transmittance_about(&coat, wo[2]);
                        let transmittance_scale = coat
                            .transmittance_scale
                            .as_ref()
                            .expect("it is brushed")
                            .at(wo);
                        worst = worst.max((about * transmittance_scale - exact).abs());
                        even = even.max((about - exact).abs());
                    }
                    println!(
                        "{distribution:?} {roughness:?} {typical} for {n}: {worst:.4} {even:.4}"
                    );
                    assert!(worst < bound, "{distribution:?} {roughness:?} {typical}");
                    without = without.max(even);
                }
            }
        }
        assert!(without > 0.1, "{without}");
    }

    /// 1 − E₀ between the knots.
    fn transmittance_about(coat: &RoughCoat, cosine: f64) -> f64 {
        let (knot, part) = knot_before(cosine.sqrt(), COSINES);
        let [here, next] = [knot, knot + 1].map(|knot| coat.reflectances[knot].extent().0);
        1.0 - here - (next - here) * part
    }
}
