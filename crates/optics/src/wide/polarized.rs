//! What interfaces and films do to polarized light: the powers of s and p, and the phase between them.

use super::Real;
use super::elementary::sin_cos_half_turns;
use crate::PathDifference;

/// Least |q|²; smaller values are replaced by it (as in [`stack`](crate::stack)).
const LEAST_Q2: f64 = 1e-100;

/// What an interface or a film does to polarized light, reflected or transmitted, in the frame whose reference axis is s.
///
/// The amplitudes a_s and a_p are those of reflection, or of transmission in units in which their squares are powers. These four
/// numbers are all that light's Stokes vector depends on: [`Mueller::from_powers`](crate::Mueller::from_powers) is the matrix.
/// Signs are those of the crate: r_p = −r_s at normal incidence, waves vary as exp(−iωt).
#[derive(Clone, Copy, Debug)]
pub struct PolarizedPowers<T> {
    /// |a_s|².
    pub s: T,
    /// |a_p|².
    pub p: T,
    /// Re(a_s a_p*).
    pub re: T,
    /// Im(a_s a_p*).
    pub im: T,
}

/// Reflection of polarized light by a half space of index n + ik seen from vacuum, like
/// [`interface_reflectance`](super::interface_reflectance).
///
/// With c the cosine, s² = 1 − c² and q = a + ib, q² = (n + ik)² − s²: r_s = (c − q) / (c + q) and
/// r_p = −r_s (cq − s²) / (cq + s²) (Born and Wolf, Principles of Optics, 7th ed., section 1.5, equation 21, factored by
/// n² = q² + s² and 1 = c² + s²). Hence r_s r_p* = −R_s (c²|q|² − s⁴ − 2i s² c b) / |cq + s²|². All terms are multiplied by the
/// larger part of q: it is a root, and the smaller part times it is nk, without cancellation.
///
/// Domain: n ≥ 0, k ≥ 0, not both 0; `cosine` in (0, 1]. It agrees with [`stack`](crate::stack) without layers within 1e-14 where
/// |n + ik| is at least 0.1.
#[inline(always)]
pub fn interface_polarized<T: Real>(n: T, k: T, cosine: f64) -> PolarizedPowers<T> {
    let sin2 = (1.0 - cosine) * (1.0 + cosine);
    let one = n.constant(1.0);
    let re = k.negate_mul_add(k, (n - one).mul_add(n + one, n.constant(cosine * cosine)));
    let nk = n * k;
    let size = re.mul_add(re, (nk * nk).times(4.0)).sqrt();
    let large2 = (size + re.abs()).times(0.5).at_least(LEAST_Q2);
    let large = large2.sqrt();
    let (a, b) = (re.choose(large2, nk), re.choose(nk, large2));
    let (c, ca, cb) = (large.times(cosine), a.times(cosine), b.times(cosine));
    let s2 = large.times(sin2);
    let (down, up) = (c - a, c + a);
    let (less, more) = (ca - s2, ca + s2);
    let (b2, cb2) = (b * b, cb * cb);
    // r_s = √(reflected / arriving) and r_p = −r_s √(below / above), apart from the phases.
    let (reflected, arriving) = (down.mul_add(down, b2), up.mul_add(up, b2));
    let (below, above) = (less.mul_add(less, cb2), more.mul_add(more, cb2));
    let factor = reflected / (arriving * above);
    PolarizedPowers {
        s: factor * above,
        p: factor * below,
        re: -(factor * less.mul_add(more, cb2)),
        im: factor * (s2 * cb).times(2.0),
    }
}

/// Reflection and transmission of polarized light by a clear film with vacuum on both sides, like
/// [`clear_film_reflectance`](super::clear_film_reflectance).
///
/// With δ = 2πqd/λ, t = 1/D and r = if sin δ / D, D = cos δ − ie sin δ (Abelès' matrix of one layer, for which see Born and Wolf,
/// Principles of Optics, 7th ed., section 1.6.4). With the admittances η₀ and η outside and inside, e = (η² + η₀²) / 2ηη₀ and
/// f = (η² − η₀²) / 2ηη₀, where η is q for s and q/n² for p. Multiplied by 2cq for s and 2n²cq for p, all terms of
/// |D|² = 1 + f² sin² δ and of D_s* D_p are free of cancellation; the imaginary part of the latter has the factor
/// n²(q² + c²) − (q² + n⁴c²) = (n² − 1)² sin²θ.
///
/// Domain: that of [`clear_film_reflectance`](super::clear_film_reflectance). For films of some µm it agrees with
/// [`film`](crate::film) within 5e-13, and within 1e-13 for cosines from 0.1 on. The difference is the rounding of the phase, which
/// sharp fringes near grazing incidence magnify.
#[inline(always)]
pub fn clear_film_polarized<T: Real>(
    n: T,
    twice_nm: f64,
    inverse_wavelength: T,
    cos2: f64,
) -> [PolarizedPowers<T>; 2] {
    let one = n.constant(1.0);
    let (twice_cosine, sin2) = (2.0 * cos2.sqrt(), 1.0 - cos2);
    let cos2 = n.constant(cos2);
    let n2 = n * n;
    let above = n2 - one;
    let q2 = above + cos2;
    let q = q2.sqrt();
    let (sin, cos) = sin_cos_half_turns(q.times(twice_nm) * inverse_wavelength);
    // The squares of 2cq for s, of 2n²cq for p, and the product of both.
    let base = cos2.times(4.0) * q2;
    let (base_p, base_sp) = (base * n2 * n2, base * n2);
    // r_s is √(s²/a) and r_p is −√(p²/b), apart from the phases.
    let s = above * sin;
    let p = s * (n2 + one).mul_add(cos2, -one);
    let (s2, p2) = (s * s, p * p);
    let (a, b) = (base + s2, base_p + p2);
    let over = (a * b).recip();
    let (over_a, over_b) = (over * b, over * a);
    // D_s* D_p.
    let sum = (q2 + cos2) * (n2 * n2).mul_add(cos2, q2);
    let re = (sin * sin).mul_add(sum, cos * cos * base_sp) * over;
    let im = (s * above * cos * q).times(twice_cosine * sin2) * over;
    let sp = -(s * p);
    [
        PolarizedPowers {
            s: s2 * over_a,
            p: p2 * over_b,
            re: sp * re,
            im: sp * im,
        },
        PolarizedPowers {
            s: base * over_a,
            p: base_p * over_b,
            re: base_sp * re,
            im: base_sp * im,
        },
    ]
}

/// Reflection and transmission of polarized light by [`two_beam`](crate::two_beam), with the same domain.
///
/// R is the square of r − (1 − r²) r exp(2πil/λ), with r Fresnel's amplitude of the upper surface: here the phase between s and p is that
/// of these amplitudes. (It is small, and the beams left out are of the same order: the phase of [`film`](crate::film) differs.)
/// The transmitted light does not interfere, so its amplitudes 1 − r² are real.
#[inline(always)]
pub fn two_beam_polarized<T: Real>(
    n: T,
    twice_nm: f64,
    inverse_wavelength: T,
    cosine: f64,
    path: PathDifference,
) -> [PolarizedPowers<T>; 2] {
    let n2 = n * n;
    let one = n.constant(1.0);
    let above = n2 - one;
    let c = n.constant(cosine);
    let q = (above + c * c).sqrt();
    let optical = match path {
        PathDifference::Optical => q,
        PathDifference::AsPrinted => q / n,
    };
    let (sin, cos) = sin_cos_half_turns(optical.times(twice_nm) * inverse_wavelength);
    // r_s = −(n² − 1) / (c + q)² and r_p = (n² − 1)((n² + 1)c² − 1) / (n²c + q)², without cancellation.
    let (sum_s, sum_p) = (c + q, n2.mul_add(c, q));
    let over = (sum_s * sum_p).recip();
    let (over_s, over_p) = (over * sum_p, over * sum_s);
    let (over_s, over_p) = (over_s * over_s, over_p * over_p);
    let r_s = -(above * over_s);
    let r_p = above * (n2 + one).mul_add(c * c, -one) * over_p;
    let four = (c * q).times(4.0);
    let (rest_s, rest_p) = (four * over_s, four * n2 * over_p);
    let (s2, p2, sp) = (r_s * r_s, r_p * r_p, r_s * r_p);
    // cos 2πl/λ = 1 − 2 sin² πl/λ.
    let twice = (sin * sin).times(2.0);
    [
        PolarizedPowers {
            s: s2 * s2.mul_add(s2, (twice * rest_s).times(2.0)),
            p: p2 * p2.mul_add(p2, (twice * rest_p).times(2.0)),
            re: sp * s2.mul_add(p2, twice * (rest_s + rest_p)),
            im: sp * (sin * cos).times(2.0) * (s2 - p2),
        },
        PolarizedPowers {
            s: rest_s * rest_s,
            p: rest_p * rest_p,
            re: rest_s * rest_p,
            im: one.constant(0.0),
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::{
        Index, Lanes, Sweep, clear_film_reflectance, interface_reflectance, two_beam_powers,
    };
    use crate::{Complex64, Layer, StackAmplitudes, film, fresnel, stack};
    use pulp::{Arch, Simd, WithSimd};
    use std::f64::consts::TAU;

    const COSINES: [f64; 11] = [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.555, 0.6, 0.8, 1.0];

    /// The largest difference between a formula's numbers and those of amplitudes.
    fn off(found: PolarizedPowers<f64>, a_s: Complex64, a_p: Complex64) -> f64 {
        let cross = a_s * a_p.conj();
        [
            found.s - a_s.norm_sqr(),
            found.p - a_p.norm_sqr(),
            found.re - cross.re,
            found.im - cross.im,
        ]
        .into_iter()
        .fold(0.0, |worst, off| off.abs().max(worst))
    }

    /// Also requires |a_s a_p*|² = |a_s|² |a_p|², which no rounding of a phase breaks: the light stays fully polarized.
    fn pure(found: PolarizedPowers<f64>) -> bool {
        let PolarizedPowers { s, p, re, im } = found;
        (re * re + im * im - s * p).abs() <= 1e-13 * s * p + f64::MIN_POSITIVE
    }

    fn mean(powers: PolarizedPowers<f64>) -> f64 {
        0.5 * (powers.s + powers.p)
    }

    const MEDIA: [(f64, f64); 14] = [
        (1.5, 0.0),
        (1.0, 0.0),
        (0.7, 0.0),
        (0.6, 0.8),
        (0.13, 3.3),
        (0.05, 9.0),
        (2.7, 3.8),
        (1.0, 1e-3),
        (1.5, 1e-6),
        (1.5, 1e-12),
        (0.7, 1e-9),
        (4.1, 0.04),
        (0.0, 2.0),
        (0.02, 0.3),
    ];

    #[test]
    fn an_interface_is_that_of_fresnel() {
        let (mut worst, mut mean_worst) = (0.0_f64, 0.0_f64);
        for (n, k) in MEDIA {
            for cosine in COSINES {
                let found = interface_polarized(n, k, cosine);
                let a = stack(1.0, &[], Complex64::new(n, k), 500.0, cosine).amplitudes;
                let here = off(found, a.r_s, a.r_p);
                assert!(here < 1e-14, "{n} {k} {cosine}: {here:e} {found:?}");
                worst = worst.max(here);
                assert!(pure(found), "{n} {k} {cosine}: {found:?}");
                // The twin loses digits of the small part of q where light is totally reflected almost without loss.
                if n >= 1.0 || k == 0.0 || k > 1e-3 {
                    let twin = interface_reflectance(n, k, cosine);
                    mean_worst = mean_worst.max((mean(found) - twin).abs());
                }
            }
        }
        assert!(mean_worst < 5e-15, "{mean_worst:e}");
        let other = interface_polarized(0.13, 3.3 * (1.0 + 1e-9), 0.5);
        let a = stack(1.0, &[], Complex64::new(0.13, 3.3), 500.0, 0.5).amplitudes;
        assert!(
            off(other, a.r_s, a.r_p) > 1e-11,
            "another index is detected"
        );
    }

    /// A medium of index n < 1 exactly at its critical angle reflects all light in phase: r_s = r_p = 1.
    #[test]
    fn an_interface_at_its_critical_angle_is_finite() {
        let found = interface_polarized(0.6, 0.0, 0.8);
        assert!(
            off(found, Complex64::ONE, Complex64::ONE) < 1e-7,
            "{found:?}"
        );
        // q² is 0 in lanes with any k² = n² − s² and n = 0.
        let none = interface_polarized(0.0, 1e-60, 1.0);
        assert!(none.s.is_finite() && none.im.is_finite(), "{none:?}");
    }

    /// The largest error of a formula over indices, thicknesses, wavelengths and cosines.
    fn worst(off: impl Fn(f64, f64, f64, f64) -> f64, cosines: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for n in [1.0, 1.0001, 1.01, 1.333, 1.5, 2.4, 4.0] {
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
    fn a_clear_film_is_that_of_the_stack() {
        let errors = |n: f64, shift: f64, nm: f64, wavelength: f64, cosine: f64| {
            let [r, t] = clear_film_polarized(n, 2.0 * nm, wavelength.recip(), cosine * cosine);
            assert!(
                pure(r) && pure(t),
                "{n} {nm} {wavelength} {cosine}: {r:?} {t:?}"
            );
            let a = film((n * shift).into(), nm, wavelength, cosine).amplitudes;
            off(r, a.r_s, a.r_p).max(off(t, a.t_s, a.t_p))
        };
        let of = |n, nm, wavelength, cosine| errors(n, 1.0, nm, wavelength, cosine);
        let (steep, grazing) = (worst(of, &COSINES[5..]), worst(of, &COSINES[..5]));
        assert!(steep < 1e-13, "{steep:e}");
        assert!(grazing < 5e-13, "{grazing:e}");
        let shifted = |n, nm, wavelength, cosine| errors(n, 1.0 + 1e-9, nm, wavelength, cosine);
        assert!(
            worst(shifted, &COSINES[5..]) > 1e-10,
            "another index is detected"
        );
    }

    #[test]
    fn the_means_of_a_clear_film_are_those_of_unpolarized_light() {
        let of = |n, nm: f64, wavelength: f64, cosine: f64| {
            let (twice_nm, inverse, cos2) = (2.0 * nm, wavelength.recip(), cosine * cosine);
            let [r, t] = clear_film_polarized(n, twice_nm, inverse, cos2);
            let twin = clear_film_reflectance(n, twice_nm, inverse, cos2);
            (mean(r) - twin).abs().max((mean(r) + mean(t) - 1.0).abs())
        };
        let found = worst(of, &COSINES);
        assert!(found < 2e-15, "{found:e}");
    }

    /// The amplitudes whose squares the paper prints: r − (1 − r²) r exp(2πil/λ), and 1 − r².
    #[test]
    fn two_beams_are_those_of_the_amplitudes() {
        for path in [PathDifference::Optical, PathDifference::AsPrinted] {
            let of = |n: f64, nm: f64, wavelength: f64, cosine: f64| {
                let [r, t] = two_beam_polarized(n, 2.0 * nm, wavelength.recip(), cosine, path);
                assert!(
                    pure(r) && pure(t),
                    "{n} {nm} {wavelength} {cosine}: {r:?} {t:?}"
                );
                // Not `cos_refracted`, which is given a sine that has lost its digits near grazing.
                let inside = ((n - 1.0) * (n + 1.0) + cosine * cosine).sqrt() / n;
                let surface = fresnel(1.0.into(), cosine.into(), n.into(), inside.into());
                let index = if path == PathDifference::Optical {
                    n
                } else {
                    1.0
                };
                let length = 2.0 * nm * index * inside;
                let delay = Complex64::from_polar(1.0, TAU * length / wavelength);
                let reflected = |r: Complex64| r - (1.0 - r * r) * r * delay;
                let (r_s, r_p) = (surface.r_s, surface.r_p);
                let r_off = off(r, reflected(r_s), reflected(r_p));
                r_off.max(off(t, 1.0 - r_s * r_s, 1.0 - r_p * r_p))
            };
            let found = worst(of, &COSINES);
            assert!(found < 5e-13, "{path:?} {found:e}");
            let means = |n, nm: f64, wavelength: f64, cosine| {
                let inverse = wavelength.recip();
                let [r, t] = two_beam_polarized(n, 2.0 * nm, inverse, cosine, path);
                let twin = two_beam_powers(n, 2.0 * nm, inverse, cosine, path);
                (mean(r) - twin.0).abs().max((mean(t) - twin.1).abs())
            };
            let found = worst(means, &COSINES);
            assert!(found < 1e-14, "{path:?} {found:e}");
        }
    }

    /// Two beams are the first two of Airy's sum, and the others are smaller by r² and more. The phase between s and p is itself of that
    /// order: with the third beam, Im r_s r_p* is 4 sin² δ times that of two beams (from r ≈ r₁(1 − β²)(1 + r₁²β²) with β² = exp 2iδ).
    #[test]
    fn two_beams_resemble_all_of_them() {
        let [two, _] = two_beam_polarized(1.1, 914.0, 1.0 / 551.0, 0.5, PathDifference::Optical);
        let [all, _] = clear_film_polarized(1.1, 914.0, 1.0 / 551.0, 0.25);
        let inside = (1.1_f64 * 1.1 - 0.75).sqrt();
        let third = 4.0 * (0.5 * TAU * 914.0 * inside / 551.0).sin().powi(2);
        for (a, b) in [
            (two.s, all.s),
            (two.p, all.p),
            (two.re, all.re),
            (two.im * third, all.im),
        ] {
            assert!((a / b - 1.0).abs() < 0.1, "{two:?} {all:?} {third}");
        }
    }

    /// All formulas on eight indices at once.
    struct Together<'a>(&'a [f64; 8], &'a mut Vec<[f64; 8]>);

    impl WithSimd for Together<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let mut rows = [[0.0; 8]; 20];
            for first in (0..8).step_by(S::F64_LANES) {
                let n = Lanes::load(simd, &self.0[first..]);
                for (row, found) in rows.iter_mut().zip(formulas(n)) {
                    found.store(&mut row[first..]);
                }
            }
            self.1.extend(rows);
        }
    }

    #[inline(always)]
    fn formulas<T: Real>(n: T) -> [T; 20] {
        let inverse = n.constant(1.0 / 551.3);
        let [film_r, film_t] = clear_film_polarized(n, 914.0, inverse, 0.36);
        let [two_r, two_t] = two_beam_polarized(n, 914.0, inverse, 0.6, PathDifference::Optical);
        let metal = interface_polarized(n, n.times(2.0), 0.6);
        let rows = [film_r, film_t, two_r, two_t, metal].map(|a| [a.s, a.p, a.re, a.im]);
        std::array::from_fn(|i| rows[i / 4][i % 4])
    }

    #[test]
    fn lanes_have_what_single_numbers_have() {
        let indices = [1.0, 1.1, 1.333, 1.5, 1.7, 2.0, 2.4, 4.0];
        let mut rows = Vec::new();
        Arch::new().dispatch(Together(&indices, &mut rows));
        for (lane, n) in indices.into_iter().enumerate() {
            for (row, alone) in rows.iter().zip(formulas(n)) {
                assert!((row[lane] - alone).abs() < 1e-13, "{n}: {row:?} {alone}");
            }
        }
        assert!((rows[0][3] - formulas(1.5 + 1e-9)[0]).abs() > 1e-11);
    }

    /// What the sweep gives for a stack, on numbers one by one.
    fn swept(
        incident: f64,
        layers: &[Layer],
        substrate: Complex64,
        wavelength_nm: f64,
        cosine: f64,
    ) -> ([PolarizedPowers<f64>; 2], [f64; 4]) {
        let q0 = incident * cosine;
        let wave = |index: Complex64| {
            let index = Index::new(index.re, index.im, index.im == 0.0, incident);
            index.wave(q0 * q0, q0 * q0, 2.0 / wavelength_nm)
        };
        let mut sweep = Sweep::new(&wave(substrate));
        for (i, layer) in layers.iter().rev().enumerate() {
            sweep.pass(&wave(layer.index), layer.thickness_nm);
            if (i + 1) % crate::wide::SCALED_AFTER == 0 {
                sweep.rescale();
            }
        }
        let (eta_s, eta_p) = (q0, cosine / incident);
        (sweep.polarized(eta_s, eta_p), sweep.powers(eta_s, eta_p))
    }

    /// Amplitudes of transmission whose squares are powers.
    fn transmitted(
        found: &StackAmplitudes,
        incident: f64,
        substrate: Complex64,
    ) -> (Complex64, Complex64) {
        let of = |t: Complex64, power: f64| t / t.norm().max(f64::MIN_POSITIVE) * power.sqrt();
        let a = found.amplitudes;
        // The phase of H.
        let t_p = a.t_p * substrate / incident;
        let power = found.transmittance;
        (of(a.t_s, power.s), of(t_p, power.p))
    }

    fn layer(n: f64, k: f64, thickness_nm: f64) -> Layer {
        Layer {
            index: Complex64::new(n, k),
            thickness_nm,
        }
    }

    fn stacks() -> Vec<Vec<Layer>> {
        let pair = [layer(2.35, 0.0, 58.0), layer(1.38, 0.0, 99.0)];
        let lossy = vec![
            layer(1.46, 0.0, 80.0),
            layer(0.06, 3.6, 25.0),
            layer(2.1, 0.02, 200.0),
            layer(1.0, 0.0, 90.0),
        ];
        let back: Vec<Layer> = lossy.iter().rev().copied().collect();
        vec![
            vec![],
            vec![layer(1.333, 0.0, 457.0)],
            vec![layer(3.18, 3.33, 10.0)],
            vec![layer(0.06, 3.6, 40.0), layer(1.5, 0.0, 0.0)],
            pair.repeat(3),
            lossy,
            back,
        ]
    }

    /// The largest error of the sweep over stacks seen from both sides, where layers are lossy, clear or only tunneled through.
    fn worst_sweep(cosines: &[f64], shift: f64) -> (f64, f64) {
        let (mut worst, mut means) = (0.0_f64, 0.0_f64);
        let media = [
            (1.0, Complex64::ONE),
            (1.0, Complex64::new(1.52, 0.0)),
            (1.52, Complex64::ONE),
            (1.0, Complex64::new(4.08, 0.041)),
            (1.0, Complex64::new(0.4, 2.4)),
        ];
        for layers in stacks() {
            for (incident, substrate) in media {
                for wavelength in [381.0, 551.3, 779.0] {
                    for &cosine in cosines {
                        let ([r, t], powers) =
                            swept(incident, &layers, substrate * shift, wavelength, cosine);
                        let expected = stack(incident, &layers, substrate, wavelength, cosine);
                        let a = expected.amplitudes;
                        let (t_s, t_p) = transmitted(&expected, incident, substrate);
                        let here = off(r, a.r_s, a.r_p).max(off(t, t_s, t_p));
                        assert!(pure(r) && pure(t), "{layers:?} {cosine} {r:?} {t:?}");
                        worst = worst.max(here);
                        let found = [r.s, r.p, t.s, t.p];
                        for (a, b) in found.into_iter().zip(powers) {
                            means = means.max((a - b).abs());
                        }
                    }
                }
            }
        }
        (worst, means)
    }

    #[test]
    fn a_sweep_is_that_of_the_stack() {
        let (steep, means) = worst_sweep(&COSINES[5..], 1.0);
        let (grazing, grazing_means) = worst_sweep(&COSINES[..5], 1.0);
        assert!(steep < 1e-14, "{steep:e}");
        assert!(grazing < 1e-14, "{grazing:e}");
        assert!(
            means.max(grazing_means) < 2e-15,
            "{means:e} {grazing_means:e}"
        );
        let (other, _) = worst_sweep(&COSINES[5..], 1.0 + 1e-9);
        assert!(other > 1e-10, "another index is detected");
    }

    /// Mirrors of hundreds of layers stay finite: the fields, and the products of what the two polarizations pass.
    #[test]
    fn deep_mirrors_and_opaque_layers_stay_finite() {
        let mirror = [layer(2.35, 0.0, 58.0), layer(1.38, 0.0, 99.0)].repeat(500);
        let opaque = [layer(0.06, 3.6, 1e6)].repeat(3);
        for layers in [mirror, opaque] {
            let ([r, t], _) = swept(1.0, &layers, 1.52.into(), 550.0, 0.95);
            let a = stack(1.0, &layers, 1.52.into(), 550.0, 0.95).amplitudes;
            assert!(off(r, a.r_s, a.r_p) < 1e-12, "{r:?} {a:?}");
            assert!(
                t.re.abs() + t.im.abs() < 1e-30 && t.s + t.p < 1e-30,
                "{t:?}"
            );
        }
    }
}
