//! The color of light that several facets reflect.

use crate::wide::Real;

/// Cosines and weights for the mean over a hemisphere, Σ w F(cos θ) ≈ ∫ F 2 cos θ d(cos θ): the three-point Gauss rule for the
/// weight x on [0, 1] (Abramowitz and Stegun, table 25.8, k = 1, doubled).
pub const MEAN_COSINES: [(f64, f64); 3] = [
    (0.212_340_538_239_152_96, 0.139_653_959_802_908_25),
    (0.590_533_135_559_265_3, 0.458_482_212_719_172_5),
    (0.911_412_040_487_296, 0.401_863_827_477_919_26),
];

/// Returns the reflectance of facets, averaged over a hemisphere by [`MEAN_COSINES`].
pub fn mean_reflectance(reflectance: impl Fn(f64) -> f64) -> f64 {
    let parts = MEAN_COSINES.map(|(cosine, weight)| weight * reflectance(cosine));
    parts.iter().sum()
}

/// Fraction of light that leaves after meeting two or more facets of mean reflectance F, where a fraction E leaves the surface
/// after each: F E F + F (1 − E) F E F + …, without the light that leaves after the first facet and relative to the 1 − E that
/// meets a second one. The sum is F² E / (1 − F (1 − E)) (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, 2017,
/// with the F of the facet that the light meets first).
#[inline]
pub fn multiple_color<T: Real>(mean_reflectance: T, mean_energy: f64) -> T {
    let kept = mean_reflectance.times(1.0 - mean_energy);
    (mean_reflectance * mean_reflectance).times(mean_energy) / kept.complement()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Complex64, Layer, reflectance_unpolarized, stack};

    fn finely(reflectance: impl Fn(f64) -> f64) -> f64 {
        let steps = 20_000;
        let value = |i: u32| reflectance(((f64::from(i) + 0.5) / f64::from(steps)).sqrt());
        (0..steps).map(value).sum::<f64>() / f64::from(steps)
    }

    #[test]
    fn the_rule_is_exact_for_polynomials() {
        for power in 0..6 {
            let found = mean_reflectance(|x| x.powi(power));
            let exact = 2.0 / (f64::from(power) + 2.0);
            assert!((found - exact).abs() < 1e-14, "{power}: {found}");
        }
        assert!((mean_reflectance(|x| x.powi(6)) - 0.25).abs() > 1e-5);
    }

    /// Metals, bare and under a layer of index 2.4: three points are off by 0.2 % where the layer is thin, and by 5 % of all light
    /// where several fringes fall between the points.
    #[test]
    fn three_points_are_enough() {
        let metals = [(0.25, 3.1), (0.05, 3.9), (2.7, 3.8), (0.9, 6.5), (1.5, 0.0)];
        for (n, k) in metals {
            let index = Complex64::new(n, k);
            let bare = |cosine| reflectance_unpolarized(index, cosine);
            assert!((mean_reflectance(bare) - finely(bare)).abs() < 0.002);
            for (thickness_nm, most) in [(100.0, 0.003), (300.0, 0.003), (1000.0, 0.05)] {
                let layer = Layer {
                    index: 2.4.into(),
                    thickness_nm,
                };
                let under = |cosine| {
                    let found = stack(1.0, &[layer], index, 550.0, cosine);
                    found.reflectance.unpolarized()
                };
                let error = (mean_reflectance(under) - finely(under)).abs();
                assert!(error < most, "{index} {thickness_nm}: {error}");
            }
        }
    }

    /// The color is the sum of F (F (1 − E))ⁿ F E over n = 0, 1, …, and nothing is lost where F = 1.
    #[test]
    fn the_color_is_that_of_a_series() {
        for (f, e) in [(0.9_f64, 0.7_f64), (0.5, 0.4), (0.04, 0.9)] {
            let series: f64 = (0..200).map(|n| f * (f * (1.0 - e)).powi(n) * f * e).sum();
            assert!((multiple_color(f, e) - series).abs() < 1e-12);
        }
        assert!((multiple_color(1.0, 0.3) - 1.0).abs() < 1e-15);
    }
}
