//! sin, cos and exp as polynomials (interpolated at Chebyshev nodes with 60 digits), without branches.

use super::Real;
use std::f64::consts::{LN_2, PI, TAU};

/// sin πx / x in powers of x², |x| ≤ 1/2: error below 1.3e-16.
const SINE: [f64; 9] = [
    PI,
    -5.167_712_780_049_969,
    2.550_164_039_877_300_7,
    -0.599_264_529_318_944_7,
    0.082_145_886_573_102_9,
    -0.007_370_430_505_916_944,
    0.000_466_299_816_189_839_4,
    -2.190_349_707_462_601_8e-5,
    7.697_826_768_224_191e-7,
];

/// cos πx in powers of x², |x| ≤ 1/2: error below 1e-16.
const COSINE: [f64; 9] = [
    1.0,
    -4.934_802_200_544_676,
    4.058_712_126_416_497,
    -1.335_262_768_843_447,
    0.235_330_630_129_532_84,
    -0.025_806_888_737_002_202,
    0.001_929_556_272_481_713_2,
    -0.000_104_566_553_387_487_38,
    4.149_564_353_942_586e-6,
];

/// (2⁻ˣ − 1) / x in powers of x, |x| ≤ 1/2: error below 3e-17.
const POWER: [f64; 12] = [
    -LN_2,
    0.240_226_506_959_100_72,
    -0.055_504_108_664_821_625,
    0.009_618_129_107_628_48,
    -0.001_333_355_814_640_647,
    0.000_154_035_303_933_707_34,
    -1.525_273_384_155_677_3e-5,
    1.321_548_680_870_556_3e-6,
    -1.017_805_708_773_394_1e-7,
    7.054_897_304_155_5e-9,
    -4.455_817_908_336_064_5e-10,
    2.572_932_417_736_230_5e-11,
];

/// Horner's rule for even and odd coefficients separately, so that half of the operations need not wait for the other half.
#[inline(always)]
fn polynomial<T: Real, const N: usize>(coefficients: &[f64; N], x: T) -> T {
    let square = x * x;
    let mut sums = [
        x.constant(coefficients[N - 1]),
        x.constant(coefficients[N - 2]),
    ];
    for place in (0..N - 2).rev() {
        let which = (N - 1 - place) % 2;
        sums[which] = sums[which].mul_add(square, x.constant(coefficients[place]));
    }
    let [even, odd] = if N % 2 == 1 { sums } else { [sums[1], sums[0]] };
    odd.mul_add(x, even)
}

/// Returns (sin πx, cos πx), both perhaps with the opposite sign, which does not matter for a matrix of which only powers are used.
/// Accurate to 4e-16, apart from the rounding of x itself; sin keeps its relative precision at 0.
#[inline(always)]
pub fn sin_cos_half_turns<T: Real>(x: T) -> (T, T) {
    let x = x - x.round();
    let square = x * x;
    (x * polynomial(&SINE, square), polynomial(&COSINE, square))
}

/// Returns sin πx, perhaps with the opposite sign; see [`sin_cos_half_turns`].
#[inline(always)]
pub fn sin_half_turns<T: Real>(x: T) -> T {
    let x = x - x.round();
    x * polynomial(&SINE, x * x)
}

/// Returns (sin 2πx, cos 2πx) for moderate x, like [`sin_cos_half_turns`] but with the right signs.
#[inline(always)]
pub fn sin_cos_turns(x: f64) -> (f64, f64) {
    let half_turns = 2.0 * x;
    let whole = Real::round(half_turns);
    let (sin, cos) = sin_cos_half_turns(half_turns);
    if whole as i64 & 1 == 0 {
        (sin, cos)
    } else {
        (-sin, -cos)
    }
}

/// 2π / ln 2.
const TURN: f64 = TAU / LN_2;

/// Smaller values than 2⁻¹⁰²⁰ are not distinguished from it.
const DARKEST: f64 = 1020.0;

/// Returns (exp(−2πx), 1 − exp(−2πx)) for x ≥ 0, both with a relative error of a few 1e-16 times 1 + x.
#[inline(always)]
pub fn decay<T: Real>(x: T) -> (T, T) {
    let halvings = (x * x.constant(TURN)).at_most(DARKEST);
    let whole = halvings.round();
    let rest = halvings - whole;
    let scale = (-whole).exp2_of_whole();
    let less = rest * polynomial(&POWER, rest) * scale;
    let one = x.constant(1.0);
    (scale + less, (one - scale) - less)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::Lanes;
    use pulp::{Arch, Simd, WithSimd};

    /// Applies both functions to numbers, eight at a time.
    struct Both<'a>(&'a [f64], &'a mut Vec<[f64; 4]>);

    impl WithSimd for Both<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let mut found = [[0.0; 8]; 4];
            for eight in self.0.chunks_exact(8) {
                for first in (0..8).step_by(S::F64_LANES) {
                    let x = Lanes::load(simd, &eight[first..]);
                    let (sin, cos) = sin_cos_half_turns(x);
                    let (decay, less) = decay(x.abs());
                    for (row, lanes) in found.iter_mut().zip([sin, cos, decay, less]) {
                        lanes.store(&mut row[first..]);
                    }
                }
                let columns = (0..8).map(|i| std::array::from_fn(|row| found[row][i]));
                self.1.extend(columns);
            }
        }
    }

    fn of(numbers: &[f64]) -> Vec<[f64; 4]> {
        let mut found = Vec::new();
        Arch::new().dispatch(Both(numbers, &mut found));
        found
    }

    /// Numbers over many sizes, each with both signs, and the edges.
    fn numbers() -> Vec<f64> {
        let sizes = (0..4000).map(|i| 1e-9 * 1.0063_f64.powi(i));
        let mut numbers: Vec<f64> = sizes.flat_map(|x| [x, -x]).collect();
        numbers.extend([0.0, 0.25, 0.5, -0.5, 1.0, 1.5, 100.0, 99.5]);
        numbers
    }

    #[test]
    fn sine_and_cosine_hold_4e_16() {
        let numbers = numbers();
        for (x, [sin, cos, ..]) in numbers.iter().zip(of(&numbers)) {
            // The argument is reduced exactly, so that the expected values are accurate enough.
            let rest = x - x.round_ties_even();
            let (true_sin, true_cos) = (PI * rest).sin_cos();
            assert!((sin - true_sin).abs() < 4e-16, "{x}: {sin} {true_sin}");
            assert!((cos - true_cos).abs() < 4e-16, "{x}: {cos} {true_cos}");
            assert!(
                (sin - true_sin).abs() <= 6e-16 * true_sin.abs(),
                "{x}: relative"
            );
        }
    }

    #[test]
    fn the_decay_keeps_its_relative_precision() {
        let numbers: Vec<f64> = numbers().iter().map(|x| x.abs().min(110.0)).collect();
        for (x, [.., found, less]) in numbers.iter().zip(of(&numbers)) {
            let (truth, true_less) = ((-2.0 * PI * x).exp(), -(-2.0 * PI * x).exp_m1());
            let allowed = 5e-16 * (1.0 + 2.0 * x);
            assert!(
                (found / truth - 1.0).abs() < 2.0 * allowed,
                "{x}: {found:e} {truth:e}"
            );
            assert!(
                (less - true_less).abs() <= allowed * true_less,
                "{x}: {less:e} {true_less:e}"
            );
        }
    }

    #[test]
    fn turns_have_their_signs() {
        for i in -4000..=4000 {
            let x = f64::from(i) / 1000.0 + 1e-7;
            let (sin, cos) = sin_cos_turns(x);
            let (true_sin, true_cos) = (TAU * (x - x.round())).sin_cos();
            assert!((sin - true_sin).abs() < 1e-15, "{x}: {sin} {true_sin}");
            assert!((cos - true_cos).abs() < 1e-15, "{x}: {cos} {true_cos}");
        }
    }

    /// The decay is never 0 or negative, however large x is.
    #[test]
    fn the_deepest_decay_is_tiny_and_positive() {
        for [.., found, less] in of(&[112.0, 200.0, 1e3, 1e6, 1e9, 1e12, 1e15, 1e300]) {
            assert!(
                found > 0.0 && found < 1e-300 && less == 1.0,
                "{found:e} {less}"
            );
        }
    }

    /// The bounds above are tight enough to detect a coefficient changed in its twelfth digit.
    #[test]
    fn a_wrong_coefficient_would_be_seen() {
        let mut wrong = SINE;
        wrong[1] *= 1.0 + 1e-12;
        let found: f64 = wrong.iter().rev().fold(0.0, |sum, c| sum * 0.16 + c) * 0.4;
        assert!((found - (0.4 * PI).sin()).abs() > 4e-16);
    }
}
