//! A free film of one layer, in closed form.

use super::Real;
use super::elementary::sin_half_turns;
use crate::PathDifference;

/// Reflectance for unpolarized light of a clear film with vacuum on both sides; the rest is transmitted.
///
/// R = F sin²φ / (1 + F sin²φ) with φ = 2π n d cos θ₂ / λ and F = 4ρ / (1 − ρ)² (Airy 1833; Born and Wolf, Principles of Optics, 7th ed.,
/// section 7.6, equations 15 and 16). With c the cosine outside, q = n cos θ₂ and q² = n² − 1 + c², F is written without cancellation:
/// it is (n² − 1)² / 4c²q² for s, and ((n² + 1)c² − 1)² / n⁴ times that for p, since n⁴c² − q² = (n² − 1)((n² + 1)c² − 1).
///
/// Domain: `n` ≥ 1, without absorption; `twice_nm` twice the thickness, nm; `inverse_wavelength` 1/λ, nm⁻¹; `cos2` the squared cosine
/// outside, in (0, 1]. For films of some µm it agrees with [`film`](crate::film) within 5e-12, and within 5e-14 for cosines above 0.1.
#[inline(always)]
pub fn clear_film_reflectance<T: Real>(n: T, twice_nm: f64, inverse_wavelength: T, cos2: f64) -> T {
    let one = n.constant(1.0);
    let cos2 = n.constant(cos2);
    let n2 = n * n;
    let above = n2 - one;
    let q2 = above + cos2;
    let sine = sin_half_turns(q2.sqrt().times(twice_nm) * inverse_wavelength);
    let base = cos2.times(4.0) * q2;
    let s = above * sine;
    let p = s * (n2 + one).mul_add(cos2, -one);
    let (s2, p2) = (s * s, p * p);
    // R_s = s²/a and R_p = p²/b, over one denominator.
    let (a, b) = (base + s2, (base * n2).mul_add(n2, p2));
    s2.mul_add(b, p2 * a).times(0.5) / (a * b)
}

/// R and T of [`two_beam`](crate::two_beam) for unpolarized light, with the same domain.
#[inline(always)]
pub fn two_beam_powers<T: Real>(
    n: T,
    twice_nm: f64,
    inverse_wavelength: T,
    cosine: f64,
    path: PathDifference,
) -> (T, T) {
    let n2 = n * n;
    let c = n.constant(cosine);
    let q = (n2 - n.constant(1.0) + c * c).sqrt();
    let optical = match path {
        PathDifference::Optical => q,
        PathDifference::AsPrinted => q / n,
    };
    // cos 2πl/λ = 1 − 2 sin² πl/λ.
    let sine = sin_half_turns(optical.times(twice_nm) * inverse_wavelength);
    let cos_phase = (sine * sine).times(2.0).complement();
    let (r_s, t_s) = two_beams((c - q) / (c + q), cos_phase);
    let (r_p, t_p) = two_beams((n2 * c - q) / (n2 * c + q), cos_phase);
    ((r_s + r_p).times(0.5), (t_s + t_p).times(0.5))
}

/// R and T from the amplitude of the upper surface and cos 2πl/λ. (A closure would not be inlined.)
#[inline(always)]
fn two_beams<T: Real>(r: T, cos_phase: T) -> (T, T) {
    let r2 = r * r;
    let rest = r2.complement();
    let reflected = r2 * (rest * (rest - cos_phase.times(2.0)) + r.constant(1.0));
    (reflected, rest * rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{film, two_beam};

    /// The largest error of a formula over indices, thicknesses, wavelengths and cosines.
    fn worst(off: impl Fn(f64, f64, f64, f64) -> f64, cosines: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for n in [1.0, 1.01, 1.333, 1.5, 2.4] {
            for nm in [0.0, 1.0, 105.0, 457.0, 1200.0, 4000.0] {
                for wavelength in [381.0, 551.3, 779.0] {
                    for &cosine in cosines {
                        worst = worst.max(off(n, nm, wavelength, cosine));
                    }
                }
            }
        }
        worst
    }

    #[test]
    fn the_closed_form_is_that_of_the_stack() {
        let off = |index: f64, nm: f64, wavelength: f64, cosine: f64| {
            let closed =
                clear_film_reflectance(index, 2.0 * nm, wavelength.recip(), cosine * cosine);
            (closed
                - film(index.into(), nm, wavelength, cosine)
                    .reflectance
                    .unpolarized())
            .abs()
        };
        let (steep, all) = ([0.1, 0.3, 0.6, 0.9, 1.0], [1e-6, 1e-4, 0.01, 0.05]);
        assert!(worst(off, &steep) < 5e-14, "{:e}", worst(off, &steep));
        assert!(worst(off, &all) < 5e-12, "{:e}", worst(off, &all));
        let shifted = |n: f64, nm: f64, wavelength: f64, cosine: f64| {
            let closed = clear_film_reflectance(n, 2.0 * nm, wavelength.recip(), cosine * cosine);
            let other = film((n * (1.0 + 1e-9)).into(), nm, wavelength, cosine);
            (closed - other.reflectance.unpolarized()).abs()
        };
        assert!(worst(shifted, &steep) > 1e-10, "another index is detected");
    }

    #[test]
    fn two_beams_are_those_of_the_paper() {
        for path in [PathDifference::Optical, PathDifference::AsPrinted] {
            let off = |n: f64, nm: f64, wavelength: f64, cosine: f64| {
                let found = two_beam_powers(n, 2.0 * nm, wavelength.recip(), cosine, path);
                let expected = two_beam(n, nm, wavelength, cosine, path);
                let r = (found.0 - expected.reflectance.unpolarized()).abs();
                r.max((found.1 - expected.transmittance.unpolarized()).abs())
            };
            let found = worst(off, &[1e-3, 0.1, 0.6, 1.0]);
            assert!(found < 1e-12, "{path:?} {found:e}");
        }
    }
}
