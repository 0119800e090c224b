//! Amplitudes of films by Airy's formula, applied layer by layer: independent of the renderers and of `optics`.

use optics::Complex64;
use optics::Layer;
use std::f64::consts::TAU;

/// What multiplies the fields along s and p.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) s: Complex64,
    pub(super) p: Complex64,
}

impl Pair {
    /// The powers of s and p.
    pub(super) fn powers(self) -> [f64; 2] {
        [self.s.norm_sqr(), self.p.norm_sqr()]
    }

    /// What becomes of a Stokes vector about s, from the fields: S0 + S1 = 2 |Eₛ|², S0 − S1 = 2 |Eₚ|², S2 + iS3 = 2 Eₛ Eₚ*.
    pub(super) fn apply(self, [s0, s1, s2, s3]: [f64; 4]) -> [f64; 4] {
        let [s, p] = self.powers();
        let (s, p) = (s * (s0 + s1), p * (s0 - s1));
        let cross = self.s * self.p.conj() * Complex64::new(s2, s3);
        [0.5 * (s + p), 0.5 * (s - p), cross.re, cross.im]
    }

    /// ψ and Δ in degrees, 0 ≤ Δ < 360, in the Nebraska convention (Muller, Surface Science 16, 14–33, 1969): tan ψ exp(iΔ) = rₚ/rₛ with
    /// waves that vary as exp(+iωt), so with the conjugates of these amplitudes.
    pub(super) fn ellipsometric_deg(self) -> [f64; 2] {
        let ratio = self.p / self.s;
        let delta = -ratio.arg().to_degrees();
        [ratio.norm().atan().to_degrees(), delta.rem_euclid(360.0)]
    }
}

/// A boundary seen from the first medium: reflection and transmission (Born and Wolf, Principles of Optics, 7th ed., section 1.5,
/// equations 20 and 21; rₚ = −rₛ at normal incidence).
fn boundary([n0, c0]: [Complex64; 2], [n1, c1]: [Complex64; 2]) -> [Pair; 2] {
    let (s, p) = (n0 * c0 + n1 * c1, n1 * c0 + n0 * c1);
    let twice = 2.0 * n0 * c0;
    [
        Pair {
            s: (n0 * c0 - n1 * c1) / s,
            p: (n1 * c0 - n0 * c1) / p,
        },
        Pair {
            s: twice / s,
            p: twice / p,
        },
    ]
}

/// Amplitudes of reflection and transmission of layers in air, the outermost first, on a substrate. What is below a layer counts as one
/// boundary, r = (r₀₁ + R X²) / (1 + r₀₁ R X²) and t = t₀₁ T X / (1 + r₀₁ R X²) with X = exp(2πi n d cos θ / λ), from the substrate up
/// (Azzam and Bashara, Ellipsometry and Polarized Light, 1977, section 4.3, equations 4.164 and 4.165, in this project's signs). The
/// squares of those of transmission are powers where the substrate is air.
pub(super) fn airy(layers: &[Layer], substrate: Complex64, nm: f64, degrees: f64) -> [Pair; 2] {
    let sine = degrees.to_radians().sin();
    let medium = |n: Complex64| [n, (1.0 - (sine / n).powi(2)).sqrt()];
    let above = |i: usize| match i {
        0 => medium(Complex64::ONE),
        _ => medium(layers[i - 1].index),
    };
    let [mut r, mut t] = boundary(above(layers.len()), medium(substrate));
    for (i, layer) in layers.iter().enumerate().rev() {
        let [n, cosine] = medium(layer.index);
        let x = (Complex64::I * TAU * n * cosine * layer.thickness_nm / nm).exp();
        let [r01, t01] = boundary(above(i), [n, cosine]);
        let sums = |r01: Complex64, r: Complex64| (r01 + r * x * x, 1.0 + r01 * r * x * x);
        let ((s_up, s), (p_up, p)) = (sums(r01.s, r.s), sums(r01.p, r.p));
        t = Pair {
            s: t01.s * t.s * x / s,
            p: t01.p * t.p * x / p,
        };
        r = Pair {
            s: s_up / s,
            p: p_up / p,
        };
    }
    [r, t]
}

/// Reflection of a bare surface.
pub(super) fn bare(index: Complex64, degrees: f64) -> Pair {
    airy(&[], index, 1.0, degrees)[0]
}
