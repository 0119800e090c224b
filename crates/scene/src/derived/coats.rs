//! What a rough coat reflects over its angle and wavelength.

use crate::Microsurface;
use spectra::BandTable;
use std::f64::consts::FRAC_PI_2;

/// Knots over the root of the cosine: close together near grazing, where reflection changes fast.
pub(crate) const COSINES: usize = 32;
/// Knots over the root of the cosine at the facet.
const FACET_COSINES: usize = 128;
/// Facets per direction, squared.
const STEPS: u32 = 48;
/// Directions about the normal, where they differ: those of a quarter turn.
const AZIMUTHS: u32 = 6;

/// The coat's reflectance E for light from [`COSINES`] cosines, even in their roots, and its mean Ē over diffuse light, which is that of
/// the straight lines between the knots. What met several facets is counted by `optics::multiple_colour`. Of a brushed coat it is the mean
/// about the normal.
pub(crate) fn reflectances(
    microsurface: &Microsurface,
    n: &BandTable,
) -> ([BandTable; COSINES], BandTable) {
    let mean_energy = microsurface.energy.mean();
    let knots = std::array::from_fn(|knot| {
        let (weights, lost) = facets_seen(microsurface, cosine_of(knot, COSINES));
        n.map(|n| {
            let fresnel = |cosine: f64| optics::reflectance_unpolarised(n.into(), cosine.max(1e-6));
            let once: f64 = weights
                .iter()
                .enumerate()
                .map(|(facet, weight)| weight * fresnel(cosine_of(facet, FACET_COSINES)))
                .sum();
            let mean = optics::mean_reflectance(fresnel);
            once + lost * optics::multiple_colour(mean, mean_energy)
        })
    });
    let mean = mean_of(&knots);
    (knots, mean)
}

fn cosine_of(knot: usize, knots: usize) -> f64 {
    (knot as f64 / (knots - 1) as f64).powi(2)
}

/// How much light from a direction is mirrored by facets that stand at each of [`FACET_COSINES`] cosines to it, as hats over the cosines'
/// roots, and how much meets several.
fn facets_seen(microsurface: &Microsurface, cosine: f64) -> ([f64; FACET_COSINES], f64) {
    let surface = optics::Microsurface {
        distribution: microsurface.distribution.into(),
        alpha: microsurface.roughness,
    };
    let azimuths = if microsurface.is_brushed() {
        AZIMUTHS
    } else {
        1
    };
    let (mut weights, mut lost) = ([0.0; FACET_COSINES], 0.0);
    let cosine = cosine.max(1e-4);
    let sine = (1.0 - cosine * cosine).sqrt();
    for azimuth in 0..azimuths {
        let azimuth = FRAC_PI_2 * (f64::from(azimuth) + 0.5) / f64::from(azimuths);
        let eye = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
        lost += (1.0 - microsurface.energy.at(eye)) / f64::from(azimuths);
        surface.each_reflection(eye, STEPS, |at_facet, weight| {
            let place = at_facet.clamp(0.0, 1.0).sqrt() * (FACET_COSINES - 1) as f64;
            let knot = (place as usize).min(FACET_COSINES - 2);
            let part = place - knot as f64;
            weights[knot] += weight * (1.0 - part) / f64::from(azimuths);
            weights[knot + 1] += weight * part / f64::from(azimuths);
        });
    }
    (weights, lost)
}

/// ∫ E 2 cos θ d(cos θ) = ∫ E 4 t³ dt of what is linear in t between the knots: exact by Gauss's three points.
fn mean_of(knots: &[BandTable; COSINES]) -> BandTable {
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
            let share = weight * width * 4.0 * t.powi(3);
            shares[knot] += share * (1.0 - part);
            shares[knot + 1] += share * part;
        }
    }
    let first = knots[0].map(|e| shares[0] * e);
    let others = knots.iter().zip(shares).skip(1);
    others.fold(first, |sum, (table, share)| {
        sum.combined(table, |sum, e| sum + share * e)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Distribution, Energy, Grain};
    use spectra::{BandGrid, Spectrum};
    use std::sync::Arc;

    fn coat(roughness: f64, n: f64) -> ([BandTable; COSINES], BandTable) {
        let microsurface = Microsurface {
            distribution: Distribution::Beckmann,
            roughness: [roughness; 2],
            grain: Grain::None,
            energy: Arc::new(Energy::new(Distribution::Beckmann, [roughness; 2])),
        };
        let grid = BandGrid::visible(1).unwrap();
        reflectances(
            &microsurface,
            &BandTable::new(&grid, &Spectrum::Constant(n)).unwrap(),
        )
    }

    /// A nearly smooth coat reflects as a smooth one, but near grazing, where its facets' slopes count, and its mean is that of diffuse light on glass.
    #[test]
    fn a_nearly_smooth_coat_is_smooth() {
        let (knots, mean) = coat(0.02, 1.5);
        for (knot, of_knot) in knots.iter().enumerate().skip(12) {
            let exact = optics::reflectance_unpolarised(1.5.into(), cosine_of(knot, COSINES));
            let found = of_knot.extent().0;
            assert!(
                (found - exact).abs() < 0.01 * exact + 1e-3,
                "{knot}: {found} {exact}"
            );
        }
        let smooth = optics::hemispherical_reflectance(1.5.into());
        assert!((mean.extent().0 - smooth).abs() < 2e-3);
    }

    /// Of a mirror, which an enormous index is, everything comes back: once or after several facets.
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
}
