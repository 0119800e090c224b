//! A film by two beams: those reflected once at each of its two surfaces.

use crate::{Amplitudes, Polarized, fresnel};
use std::f64::consts::TAU;

/// Path difference l between the two beams.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PathDifference {
    /// l = 2 n d cos θ₂, the physically correct one.
    Optical,
    /// l = 2 d cos θ₂, as Suzuki, Yokoi and Toriwaki print it. The index is missing, so the fringes are n times as wide.
    AsPrinted,
}

/// Powers of a film by [`two_beam`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBeam {
    /// Reflectance with interference; may exceed 1.
    pub reflectance: Polarized,
    /// Transmittance without interference, t² = (t_b t_c)².
    pub transmittance: Polarized,
}

/// Powers of a film of real `index` in air by the two-beam formula of Suzuki, Yokoi and Toriwaki ("Study on Color Computation in
/// Computer Graphics and Its Application to Rendering Color Caused by Light Interference", section 4-2):
///
/// r² = r_c² + (t_a r_b t_c)² + 2 r_c t_a r_b t_c cos(2πl/λ − π), with the magnitudes of Fresnel's amplitudes into (a) and out of (c)
/// the upper surface and at the lower one (b). Here r_b = r_c = r and t_a t_c = 1 − r², hence R = r² + ((1 − r²) r)² −
/// 2 r² (1 − r²) cos(2πl/λ) and T = (1 − r²)². The printed text calls the amplitude of s-polarized light ∥ and the other ⊥; here s and
/// p have their usual meaning.
///
/// **Where it fails.** The formula omits light that is reflected more than once inside, and T does not interfere, so energy is not
/// conserved: R + T ≠ 1. For a film of index 4/3 with the optical path difference (values from this crate's tests),
/// R at normal incidence is off by at most 0.0016 (0.0800 instead of 0.0784 at the crest of a fringe), and R + T ranges from 0.96 to
/// 1.04. At steep angles the crests exceed 1 as soon as r > (√5 − 1)/2: beyond 77.6° for s, beyond 81.5° for unpolarized light, up to
/// 32/27 = 1.185. Use [`film`](crate::film), except to reproduce pictures made with the formula.
///
/// Domain: `index` real, ≥ 1; `thickness_nm` ≥ 0; `wavelength_nm` > 0; `cos_incident` in (0, 1].
pub fn two_beam(
    index: f64,
    thickness_nm: f64,
    wavelength_nm: f64,
    cos_incident: f64,
    path: PathDifference,
) -> TwoBeam {
    let sin2 = (1.0 - cos_incident) * (1.0 + cos_incident);
    let cosine = (1.0 - sin2 / (index * index)).sqrt();
    let Amplitudes { r_s, r_p, .. } =
        fresnel(1.0.into(), cos_incident.into(), index.into(), cosine.into());
    let length_nm = match path {
        PathDifference::Optical => 2.0 * index * thickness_nm * cosine,
        PathDifference::AsPrinted => 2.0 * thickness_nm * cosine,
    };
    let cos_phase = (TAU * length_nm / wavelength_nm).cos();
    let (s, p) = (r_s.norm_sqr(), r_p.norm_sqr());
    let reflected = |r2: f64| r2 * (1.0 + (1.0 - r2) * (1.0 - r2 - 2.0 * cos_phase));
    TwoBeam {
        reflectance: Polarized {
            s: reflected(s),
            p: reflected(p),
        },
        transmittance: Polarized {
            s: (1.0 - s).powi(2),
            p: (1.0 - p).powi(2),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film;

    const WATER: f64 = 4.0 / 3.0;

    /// A crest of the fringes: l = λ/2.
    fn crest(degrees: f64) -> TwoBeam {
        let cos1 = degrees.to_radians().cos();
        let cos2 = (1.0 - (1.0 - cos1 * cos1) / (WATER * WATER)).sqrt();
        let thickness_nm = 500.0 / (4.0 * WATER * cos2);
        two_beam(WATER, thickness_nm, 500.0, cos1, PathDifference::Optical)
    }

    /// Returns the angle where an increasing function of the angle reaches 1.
    fn reaches_one(f: impl Fn(TwoBeam) -> f64) -> f64 {
        let (mut low, mut high) = (60.0, 89.0);
        while high - low > 1e-6 {
            let middle = 0.5 * (low + high);
            if f(crest(middle)) < 1.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    #[test]
    fn the_reflectance_exceeds_one_where_the_docs_say() {
        assert!((reaches_one(|beams| beams.reflectance.s) - 77.6).abs() < 0.05);
        assert!((reaches_one(|beams| beams.reflectance.unpolarized()) - 81.5).abs() < 0.05);
        // r = (√5 − 1)/2 solves r (2 − r²) = 1; the greatest r²(2 − r²)² is 32/27, at r² = 2/3.
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        assert!((golden * (2.0 - golden * golden) - 1.0).abs() < 1e-15);
        let steps = (0..9000).map(|i| crest(f64::from(i) * 0.01).reflectance.s);
        assert!((steps.fold(0.0, f64::max) - 32.0 / 27.0).abs() < 1e-6);
    }

    #[test]
    fn energy_is_not_conserved_at_normal_incidence_by_what_the_docs_say() {
        let (mut low, mut high, mut worst) = (2.0_f64, 0.0_f64, 0.0_f64);
        for d in 0..=400 {
            let d = f64::from(d);
            let beams = two_beam(WATER, d, 500.0, 1.0, PathDifference::Optical);
            let sum = beams.reflectance.s + beams.transmittance.s;
            (low, high) = (low.min(sum), high.max(sum));
            let exact = film(WATER.into(), d, 500.0, 1.0).reflectance.s;
            worst = worst.max((beams.reflectance.s - exact).abs());
        }
        assert!(
            (low - 0.96).abs() < 0.003 && (high - 1.04).abs() < 0.003,
            "{low} {high}"
        );
        assert!((worst - 0.0016).abs() < 5e-5, "{worst}");
        assert!((crest(0.0).reflectance.s - 0.0800).abs() < 5e-5);
    }

    /// The printed path difference belongs to a film n times as thin.
    #[test]
    fn the_printed_path_widens_the_fringes_by_the_index() {
        let at = |d, path| two_beam(WATER, d, 500.0, 0.7, path).reflectance;
        let (printed, optical) = (
            at(400.0, PathDifference::AsPrinted),
            at(300.0, PathDifference::Optical),
        );
        assert!((printed.s - optical.s).abs() < 1e-14 && (printed.p - optical.p).abs() < 1e-14);
        assert!((printed.s - at(400.0, PathDifference::Optical).s).abs() > 0.01);
    }
}
