//! Mueller matrices: what becomes of a Stokes vector.

use crate::wide::PolarizedPowers;
use num_complex::Complex64;
use std::ops::Mul;

/// A Mueller matrix: row i of it gives component i of the Stokes vector that leaves, from the one that arrives.
///
/// The Stokes vector of light relative to a reference axis x, with y = d × x for the direction d of travel, is S₀ = |Eₓ|² + |E_y|²,
/// S₁ = |Eₓ|² − |E_y|², S₂ + iS₃ = 2 Eₓ E_y*. With waves that vary as exp(−iωt), S₃ > 0 is right-handed: the field turns clockwise for the
/// receiver (Born and Wolf, Principles of Optics, 7th ed., section 1.4.2).
///
/// ```
/// use pellicle_optics::{Mueller, stack};
///
/// // Unpolarized light on glass at Brewster's angle: the reflection is polarized in the direction of s.
/// let at_brewsters_angle = stack(1.0, &[], 1.5.into(), 550.0, 1.5_f64.atan().cos()).amplitudes;
/// let glass = Mueller::from_amplitudes(at_brewsters_angle.r_s, at_brewsters_angle.r_p);
/// let [s0, s1, ..] = glass.apply([1.0, 0.0, 0.0, 0.0]);
/// assert!((s0 - 0.0739645).abs() < 1e-7 && (s1 - s0).abs() < 1e-15);
///
/// // A camera whose axis is at 45° to s sees it in S₂ = −S₀.
/// let seen = (Mueller::rotation(45.0_f64.to_radians()) * glass).apply([1.0, 0.0, 0.0, 0.0]);
/// assert!((seen[2] + seen[0]).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mueller(pub [[f64; 4]; 4]);

impl Mueller {
    /// What multiplies the field along x by `a_s` and the field along y by `a_p`: an interface or a film, with s as the axis x on both sides
    /// and p = d × s as y. Amplitudes of transmission are those whose squares are powers.
    ///
    /// S₂ + iS₃ is multiplied by a_s a_p*, since it is 2 Eₓ E_y*.
    #[must_use]
    pub fn from_amplitudes(a_s: Complex64, a_p: Complex64) -> Self {
        let cross = a_s * a_p.conj();
        Self::from_powers(PolarizedPowers {
            s: a_s.norm_sqr(),
            p: a_p.norm_sqr(),
            re: cross.re,
            im: cross.im,
        })
    }

    /// The same from the powers of both fields and the product a_s a_p*.
    #[must_use]
    pub fn from_powers(powers: PolarizedPowers<f64>) -> Self {
        let PolarizedPowers { s, p, re, im } = powers;
        let (mean, half) = (0.5 * (s + p), 0.5 * (s - p));
        Self([
            [mean, half, 0.0, 0.0],
            [half, mean, 0.0, 0.0],
            [0.0, 0.0, re, -im],
            [0.0, 0.0, im, re],
        ])
    }

    /// Refers light to an axis x that is turned by `angle`, radians, counterclockwise for the receiver:
    /// S₁' = S₁ cos 2φ + S₂ sin 2φ, S₂' = −S₁ sin 2φ + S₂ cos 2φ.
    #[must_use]
    pub fn rotation(angle: f64) -> Self {
        let (sin, cos) = (2.0 * angle).sin_cos();
        Self([
            [1.0, 0.0, 0.0, 0.0],
            [0.0, cos, sin, 0.0],
            [0.0, -sin, cos, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ])
    }

    /// The Stokes vector that leaves when `stokes` arrives.
    #[must_use]
    pub fn apply(&self, stokes: [f64; 4]) -> [f64; 4] {
        self.0
            .map(|row| row.iter().zip(stokes).map(|(m, s)| m * s).sum())
    }

    /// The coherency matrix H = ¼ Σ mᵢⱼ σᵢ ⊗ σⱼ* (Cloude, Optik 75, 26–36, 1986).
    ///
    /// The σᵢ are those by which ½ Σ Sᵢ σᵢ is the matrix of the products Eₐ E_b*: 1, diag(1, −1), ((0, 1), (1, 0)) and ((0, i), (−i, 0)).
    /// The trace of H is m₀₀. For a matrix that has amplitudes, Jones' matrix J, H is ½ v v† with v = (Jₓₓ, Jₓᵧ, Jᵧₓ, Jᵧᵧ). Sums of such
    /// matrices, which are all that a linear medium can be, have eigenvalues ≥ 0.
    #[must_use]
    pub fn coherency(&self) -> [[Complex64; 4]; 4] {
        let element = |row: usize, column: usize| {
            let mut sum = Complex64::ZERO;
            for (left, m_of_left) in PAULI.iter().zip(&self.0) {
                for (right, m) in PAULI.iter().zip(m_of_left) {
                    let tensor = left[row / 2][column / 2] * right[row % 2][column % 2].conj();
                    sum += 0.25 * m * tensor;
                }
            }
            sum
        };
        std::array::from_fn(|row| std::array::from_fn(|column| element(row, column)))
    }

    /// Whether a linear medium can have this matrix: whether the smallest eigenvalue of [`coherency`](Self::coherency) is at least
    /// −`tolerance` · m₀₀ (Cloude 1986). A matrix that is not finite is not physical.
    ///
    /// Matrices made of amplitudes are physical within 1e-15, and products of a few of them within 1e-15 of the product of their m₀₀. The
    /// test does not limit m₀₀: it finds a wrong polarization, not a gain.
    #[must_use]
    pub fn is_physical(&self, tolerance: f64) -> bool {
        let finite = self.0.as_flattened().iter().all(|m| m.is_finite());
        finite && smallest_eigenvalue(&self.coherency()) >= -tolerance * self.0[0][0]
    }
}

/// The matrix of what happens on the right first, then on the left.
impl Mul for Mueller {
    type Output = Self;
    fn mul(self, right: Self) -> Self {
        let element = |row: &[f64; 4], column: usize| {
            let below = right.0.iter().map(|row| row[column]);
            row.iter().zip(below).map(|(a, b)| a * b).sum()
        };
        Self(
            self.0
                .map(|row| std::array::from_fn(|column| element(&row, column))),
        )
    }
}

const O: Complex64 = Complex64::ZERO;
const ONE: Complex64 = Complex64::ONE;
const I: Complex64 = Complex64::I;

/// Pauli's matrices in the order of Stokes' components.
const PAULI: [[[Complex64; 2]; 2]; 4] = [
    [[ONE, O], [O, ONE]],
    [[ONE, O], [O, Complex64::new(-1.0, 0.0)]],
    [[O, ONE], [ONE, O]],
    [[O, I], [Complex64::new(0.0, -1.0), O]],
];

/// Sweeps of Jacobi's iteration, which converges quadratically: for 8 by 8 elements five suffice.
const SWEEPS: usize = 12;

/// The smallest eigenvalue of a Hermitian matrix A + iB, as that of the symmetric ((A, −B), (B, A)), by Jacobi's rotations (Golub and Van
/// Loan, Matrix Computations, 4th ed., section 8.5).
fn smallest_eigenvalue(hermitian: &[[Complex64; 4]; 4]) -> f64 {
    let mut a: [[f64; 8]; 8] = std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let element = hermitian[row % 4][column % 4];
            match (row < 4, column < 4) {
                (true, true) | (false, false) => element.re,
                (true, false) => -element.im,
                (false, true) => element.im,
            }
        })
    });
    for _ in 0..SWEEPS {
        for p in 0..8 {
            for q in p + 1..8 {
                rotate(&mut a, p, q);
            }
        }
    }
    (0..8).map(|i| a[i][i]).fold(f64::INFINITY, f64::min)
}

/// Makes the element (p, q) of a symmetric matrix 0 by a rotation.
fn rotate(a: &mut [[f64; 8]; 8], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let half_cot = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let tan = half_cot.signum() / (half_cot.abs() + half_cot.hypot(1.0));
    let cos = tan.hypot(1.0).recip();
    let sin = tan * cos;
    for row in a.iter_mut() {
        (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
    }
    let (above, below) = (a[p], a[q]);
    a[p] = std::array::from_fn(|k| cos * above[k] - sin * below[k]);
    a[q] = std::array::from_fn(|k| sin * above[k] + cos * below[k]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::{
        Index, Sweep, clear_film_polarized, interface_polarized, two_beam_polarized,
    };
    use crate::{Layer, PathDifference, stack};

    const UNPOLARIZED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

    /// The largest difference between the elements of two matrices.
    fn off(a: Mueller, b: Mueller) -> f64 {
        let pairs = a.0.as_flattened().iter().zip(b.0.as_flattened());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// What glass reflects to air inside it, by `stack`.
    fn inside(n: f64, degrees: f64) -> Mueller {
        let cosine = degrees.to_radians().cos();
        let a = stack(n, &[], Complex64::ONE, 550.0, cosine).amplitudes;
        Mueller::from_amplitudes(a.r_s, a.r_p)
    }

    /// At Brewster's angle on glass of n = 1.5, r_s = (1 − n²) / (1 + n²) = −5/13 and r_p = 0, hence T_s = 144/169 and T_p = 1
    /// (Born and Wolf, section 1.5.3).
    #[test]
    fn glass_at_brewsters_angle() {
        let cosine = 1.5_f64.atan().cos();
        let reflected = Mueller::from_powers(interface_polarized(1.5, 0.0, cosine));
        let half = 25.0 / 338.0;
        let expected = Mueller([
            [half, half, 0.0, 0.0],
            [half, half, 0.0, 0.0],
            [0.0; 4],
            [0.0; 4],
        ]);
        assert!(off(reflected, expected) < 1e-15, "{reflected:?}");
        assert!((half - 0.073_964_5).abs() < 1e-7);

        let wave =
            |n: f64| Index::new(n, 0.0, true, 1.0).wave(cosine * cosine, cosine * cosine, 0.004);
        let [_, transmitted] = Sweep::new(&wave(1.5)).polarized(cosine, cosine);
        let transmitted = Mueller::from_powers(transmitted);
        let (mean, half, cross) = (313.0 / 338.0, -25.0 / 338.0, 12.0 / 13.0);
        let expected = Mueller([
            [mean, half, 0.0, 0.0],
            [half, mean, 0.0, 0.0],
            [0.0, 0.0, cross, 0.0],
            [0.0, 0.0, 0.0, cross],
        ]);
        assert!(off(transmitted, expected) < 1e-15, "{transmitted:?}");
        assert!((mean - 0.926_035_5).abs() < 1e-7);
        assert!(reflected.is_physical(1e-15) && transmitted.is_physical(1e-15));
    }

    /// tan(Δ/2) = cos θ √(sin²θ − η²) / sin²θ, where Δ is the phase of r_s minus that of r_p (Born and Wolf, section 1.5.4, equation 60).
    fn retardance(eta: f64, degrees: f64) -> f64 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        2.0 * (cos * (sin * sin - eta * eta).sqrt()).atan2(sin * sin)
    }

    #[test]
    fn total_reflection_delays_p_against_s() {
        for degrees in [41.9, 43.0, 45.0, 51.0, 60.0, 75.0, 89.0, 89.999] {
            let (sin, cos) = retardance(1.0 / 1.5, degrees).sin_cos();
            let expected = Mueller([
                UNPOLARIZED,
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, cos, -sin],
                [0.0, 0.0, sin, cos],
            ]);
            let found = inside(1.5, degrees);
            assert!(
                sin > 1e-5 && off(found, expected) < 1e-13,
                "{degrees}: {found:?}"
            );
            assert!(found.is_physical(1e-14));
        }
    }

    /// Fresnel's rhomb, n = 1.51: at 54°37' and 48°37' two reflections delay by 45° each (Born and Wolf, section 1.5.4). Light with Eₓ = E_y
    /// leaves with E_y = Eₓ exp(−iπ/2), so that S₂ + iS₃ = 2 Eₓ E_y* = i |E|²: S₃ = +1, right-handed.
    #[test]
    fn fresnels_rhomb_makes_circular_light() {
        // (1 − x)(x − η²) = tan²(π/8) x² with x = sin²θ.
        let (eta2, tan2) = (1.51_f64.powi(-2), 22.5_f64.to_radians().tan().powi(2));
        let root = ((1.0 + eta2).powi(2) - 4.0 * (1.0 + tan2) * eta2).sqrt();
        for (sign, published) in [(1.0, 54.62), (-1.0, 48.62)] {
            let sin2: f64 = (1.0 + eta2 + sign * root) / (2.0 * (1.0 + tan2));
            let degrees = sin2.sqrt().asin().to_degrees();
            assert!((degrees - published).abs() < 0.005, "{degrees}");
            let rhomb = inside(1.51, degrees) * inside(1.51, degrees);
            let found = rhomb.apply([1.0, 0.0, 1.0, 0.0]);
            for (found, expected) in found.into_iter().zip([1.0, 0.0, 0.0, 1.0]) {
                assert!((found - expected).abs() < 1e-13, "{found} {expected}");
            }
            // At the published angle, to its last digit.
            let near = inside(1.51, published) * inside(1.51, published);
            assert!((near.apply([1.0, 0.0, 1.0, 0.0])[3] - 1.0).abs() < 1e-6);
            assert!(rhomb.is_physical(1e-14));
        }
    }

    /// A polarizer whose axis is at an angle to x, counterclockwise for the receiver.
    fn polarizer(angle: f64) -> Mueller {
        let along = Mueller::from_amplitudes(Complex64::ONE, Complex64::ZERO);
        Mueller::rotation(-angle) * along * Mueller::rotation(angle)
    }

    /// Two polarizers transmit ½ cos² of the angle between them (Malus 1809); a third one between crossed ones opens them again.
    #[test]
    fn polarizers_follow_malus() {
        for step in 0..36 {
            let angle = f64::from(step) * 5.0_f64.to_radians();
            let pair = polarizer(0.3 + angle) * polarizer(0.3);
            let [passed, ..] = pair.apply(UNPOLARIZED);
            assert!((passed - 0.5 * angle.cos().powi(2)).abs() < 1e-15);
            let [_, s1, s2, s3] = polarizer(angle).apply(UNPOLARIZED);
            let (sin, cos) = (2.0 * angle).sin_cos();
            assert!((s1 - 0.5 * cos).abs() < 1e-15 && (s2 - 0.5 * sin).abs() < 1e-15 && s3 == 0.0);
            let crossed = polarizer(90.0_f64.to_radians()) * polarizer(angle) * polarizer(0.0);
            let [passed, ..] = crossed.apply(UNPOLARIZED);
            assert!((passed - (2.0 * angle).sin().powi(2) / 8.0).abs() < 1e-15);
            // Crossed polarizers leave rounding errors of their factors' size, and no light to compare them with.
            for m in [pair, crossed] {
                assert!(m.0[0][0] < 1e-30 || m.is_physical(1e-14), "{m:?}");
            }
        }
    }

    /// Silver, n = 0.136 + 4.011i, at 45°. R_s, R_p and r_s r_p* are from r_s = −sin(θ₁ − θ₂) / sin(θ₁ + θ₂) and
    /// r_p = tan(θ₁ − θ₂) / tan(θ₁ + θ₂) with complex θ₂, computed with 40 digits. R_p is R_s² at 45° (Abelès' condition).
    #[test]
    fn silver_at_45_degrees() {
        let (s, p) = (0.978_095_833_345_880_6, 0.956_671_459_208_572_6);
        let (re, im) = (-0.910_829_703_633_955_5, 0.325_738_574_797_197);
        let cosine = 0.5_f64.sqrt();
        let silver = Complex64::new(0.136, 4.011);
        let a = stack(1.0, &[], silver, 550.0, cosine).amplitudes;
        let found = Mueller::from_amplitudes(a.r_s, a.r_p);
        let expected = Mueller::from_powers(PolarizedPowers { s, p, re, im });
        assert!(off(found, expected) < 1e-14, "{found:?}");
        let wide = Mueller::from_powers(interface_polarized(0.136, 4.011, cosine));
        assert!(off(wide, expected) < 1e-14, "{wide:?}");
        assert!((p - s * s).abs() < 1e-15 && found.is_physical(1e-15));

        // The index from ρ = r_p / r_s: n² = sin²θ (1 + tan²θ ((1 − ρ) / (1 + ρ))²) (Drude 1890; Azzam and Bashara, Ellipsometry and
        // Polarized Light, 1977).
        let Mueller(m) = found;
        let rho = Complex64::new(m[2][2], -m[3][2]) / (m[0][0] + m[0][1]);
        let ratio = (1.0 - rho) / (1.0 + rho);
        let squared = 0.5 * (1.0 + ratio * ratio);
        assert!((squared - silver * silver).norm() < 1e-13, "{squared}");
    }

    /// The matrix by which a wavelength passes a stack in `layers` and enters `substrate`.
    fn transmission(incident: f64, layers: &[Layer], substrate: f64, cosine: f64) -> Mueller {
        let q02 = (incident * cosine).powi(2);
        let wave = |index: Complex64| {
            let index = Index::new(index.re, index.im, index.im == 0.0, incident);
            index.wave(q02, q02, 2.0 / 550.0)
        };
        let mut sweep = Sweep::new(&wave(substrate.into()));
        for layer in layers.iter().rev() {
            sweep.pass(&wave(layer.index), layer.thickness_nm);
        }
        let [_, t] = sweep.polarized(incident * cosine, cosine / incident);
        Mueller::from_powers(t)
    }

    fn transposed(Mueller(m): Mueller) -> Mueller {
        Mueller(std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])))
    }

    /// Light that goes back along its path: M' = Q Mᵀ Q with Q = diag(1, 1, −1, 1), where each side keeps its axis x. Jones' matrix
    /// becomes its transpose for the same vectors x and y (Perrin, J. Chem. Phys. 10, 415, 1942), of which Mueller's matrix is
    /// diag(1, 1, 1, −1) Mᵀ diag(1, 1, 1, −1). The y of light that goes back has the opposite sign, which changes those of S₂ and S₃.
    #[test]
    fn a_lossy_stack_is_reciprocal() {
        let layer = |n, k, thickness_nm| Layer {
            index: Complex64::new(n, k),
            thickness_nm,
        };
        let layers = [
            layer(1.46, 0.0, 80.0),
            layer(0.06, 3.6, 25.0),
            layer(2.1, 0.2, 60.0),
        ];
        let back: Vec<Layer> = layers.iter().rev().copied().collect();
        let reversed = |m: Mueller| {
            let q = Mueller([
                UNPOLARIZED,
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, -1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
            ]);
            q * transposed(m) * q
        };
        for cosine in [0.9_f64, 0.6, 0.2] {
            let refracted = (1.0 - (1.0 - cosine * cosine) / (1.52 * 1.52)).sqrt();
            let there = transmission(1.0, &layers, 1.52, cosine);
            let and_back = transmission(1.52, &back, 1.0, refracted);
            assert!(there.0[3][2].abs() > 1e-3, "{there:?}");
            assert!(
                off(reversed(there), and_back) < 1e-14,
                "{there:?} {and_back:?}"
            );
            assert!(off(transposed(there), and_back) > 1e-3);

            // With any axes: at 0.3 and −0.8 to s for the light that goes in, which for light that goes back are −0.3 and 0.8.
            let there = Mueller::rotation(-0.8) * there * Mueller::rotation(-0.3);
            let and_back = Mueller::rotation(-0.3) * and_back * Mueller::rotation(-0.8);
            assert!(
                off(reversed(there), and_back) < 1e-14,
                "{there:?} {and_back:?}"
            );
            assert!(there.is_physical(1e-14) && and_back.is_physical(1e-14));
        }
    }

    /// The coherency matrix of a matrix with amplitudes is ½ v v†, and its trace m₀₀.
    #[test]
    fn coherency_is_that_of_the_amplitudes() {
        let (a_s, a_p) = (Complex64::new(0.3, -0.4), Complex64::new(-0.2, 0.7));
        // Turned by an angle, Jones' matrix is R(−φ) diag(a_s, a_p) R(φ).
        let (sin, cos) = 0.4_f64.sin_cos();
        let between = (a_s - a_p) * sin * cos;
        let v = [
            a_s * cos * cos + a_p * sin * sin,
            between,
            between,
            a_s * sin * sin + a_p * cos * cos,
        ];
        let turned =
            Mueller::rotation(-0.4) * Mueller::from_amplitudes(a_s, a_p) * Mueller::rotation(0.4);
        let h = turned.coherency();
        for (row, left) in h.iter().zip(v) {
            for (found, right) in row.iter().zip(v) {
                assert!((found - 0.5 * left * right.conj()).norm() < 1e-15, "{h:?}");
            }
        }
        let trace: Complex64 = (0..4).map(|i| h[i][i]).sum();
        assert!((trace - turned.0[0][0]).norm() < 1e-15);
    }

    /// The smallest eigenvalue of a matrix with known ones: Hadamard's columns, two of them times i, for the values −0.2, 1, 1 and 3.
    #[test]
    fn jacobi_finds_the_eigenvalue() {
        let (plus, minus) = (Complex64::new(0.5, 0.0), Complex64::new(-0.5, 0.0));
        let (i, j) = (0.5 * Complex64::I, -0.5 * Complex64::I);
        let vectors = [
            [plus, i, plus, i],
            [plus, j, plus, j],
            [plus, i, minus, j],
            [plus, j, minus, i],
        ];
        let values = [1.0, -0.2, 3.0, 1.0];
        let h = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let terms = vectors.iter().zip(values);
                terms.map(|(v, e)| e * v[row] * v[column].conj()).sum()
            })
        });
        let found = smallest_eigenvalue(&h);
        assert!((found + 0.2).abs() < 1e-15, "{found}");
    }

    /// What the formulas give is physical at all angles, and so are products with rotations and sums.
    #[test]
    fn what_films_do_is_physical() {
        for cosine in [1e-6, 1e-3, 0.1, 0.55, 0.9, 1.0] {
            let cos2 = cosine * cosine;
            let metal = Mueller::from_powers(interface_polarized(0.2, 3.4, cosine));
            let film =
                clear_film_polarized(1.5, 914.0, 1.0 / 551.0, cos2).map(Mueller::from_powers);
            let path = PathDifference::Optical;
            let beams =
                two_beam_polarized(1.5, 914.0, 1.0 / 551.0, cosine, path).map(Mueller::from_powers);
            for m in [[metal, metal], film, beams].concat() {
                assert!(m.is_physical(1e-14), "{m:?}");
                let many = metal * Mueller::rotation(0.7) * m * Mueller::rotation(-1.1);
                assert!(many.is_physical(1e-14), "{many:?}");
            }
            let sum =
                std::array::from_fn(|i| std::array::from_fn(|j| film[0].0[i][j] + metal.0[i][j]));
            assert!(Mueller(sum).is_physical(1e-14));
        }
    }

    #[test]
    fn impossible_matrices_are_found() {
        let good = Mueller::from_powers(interface_polarized(0.136, 4.011, 0.6));
        assert!(good.is_physical(1e-15));
        let spoiled = |change: fn(&mut [[f64; 4]; 4])| {
            let mut matrix = good;
            change(&mut matrix.0);
            matrix
        };
        for bad in [
            spoiled(|m| m[2][2] *= 1.001),
            spoiled(|m| m[2][3] = -m[2][3]),
            spoiled(|m| m[3][3] = -m[3][3]),
            spoiled(|m| m[1][1] = -m[1][1]),
            spoiled(|m| m[0][1] = 1.1 * m[0][0]),
            spoiled(|m| m[0][0] = -m[0][0]),
            spoiled(|m| m[3][0] = f64::NAN),
        ] {
            assert!(!bad.is_physical(1e-6), "{bad:?}");
        }
        // Light that only loses its polarization, and darkness.
        let mut depolarizer = Mueller([[0.0; 4]; 4]);
        assert!(depolarizer.is_physical(0.0));
        depolarizer.0[0][0] = 1.0;
        assert!(depolarizer.is_physical(0.0));
        // A mirror turns p around; a transposition that forgets S₃ does not exist.
        let reflected = Mueller::from_amplitudes(Complex64::ONE, Complex64::new(-1.0, 0.0));
        assert!(reflected.is_physical(1e-15));
        assert!(
            !spoiled(|m| *m = transposed(Mueller(*m)).0.map(|[a, b, c, d]| [a, b, c, -d]))
                .is_physical(1e-6)
        );
    }
}
