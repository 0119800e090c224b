//! The error function, together with its integrand, the Gaussian.

use std::f64::consts::FRAC_1_SQRT_2;

/// Returns (erfc x, exp(−x²)), both with a relative error of some 1e-16 where they are normal numbers (Cody, Rational Chebyshev
/// Approximations for the Error Function, Math. Comp. 23, 1969, with the coefficients of his CALERF).
pub(super) fn erfc_and_gauss(x: f64) -> (f64, f64) {
    let y = x.abs();
    let square = x * x;
    let gauss = (-square).exp();
    if y <= 0.468_75 {
        let above = polynomial(&ERF.0, square);
        return (1.0 - x * above / polynomial(&ERF.1, square), gauss);
    }
    let of_y = if y <= 4.0 {
        gauss * polynomial(&ERFC.0, y) / polynomial(&ERFC.1, y)
    } else {
        let inverse = square.recip();
        let rest = inverse * polynomial(&TAIL.0, inverse) / polynomial(&TAIL.1, inverse);
        gauss * (std::f64::consts::FRAC_2_SQRT_PI * 0.5 - rest) / y
    };
    (if x < 0.0 { 2.0 - of_y } else { of_y }, gauss)
}

/// Returns the x for which (1 + erf x) / 2 is `p`, in (0, 1): the quantile of the normal distribution (Wichura, Algorithm AS 241,
/// Appl. Statist. 37, 1988) over √2, with a relative error of some 1e-16.
pub(super) fn inverse_erf_of_fraction(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return FRAC_1_SQRT_2 * q * polynomial(&CENTER.0, r) / polynomial(&CENTER.1, r);
    }
    let r = (-p.min(1.0 - p).ln()).sqrt();
    let size = if r <= 5.0 {
        polynomial(&SIDE.0, r - 1.6) / polynomial(&SIDE.1, r - 1.6)
    } else {
        polynomial(&FAR.0, r - 5.0) / polynomial(&FAR.1, r - 5.0)
    };
    (FRAC_1_SQRT_2 * size).copysign(q)
}

/// Horner's rule, highest power first.
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().fold(0.0, |sum, c| sum * x + c)
}

type Quotient<const N: usize> = ([f64; N], [f64; N]);

/// erf x / x in powers of x², x ≤ 0.46875.
const ERF: Quotient<5> = (
    [
        1.857_777_061_846_031_5e-1,
        3.161_123_743_870_565_6,
        1.138_641_541_510_501_6e2,
        3.774_852_376_853_02e2,
        3.209_377_589_138_469_5e3,
    ],
    [
        1.0,
        2.360_129_095_234_412_1e1,
        2.440_246_379_344_441_7e2,
        1.282_616_526_077_372_3e3,
        2.844_236_833_439_171e3,
    ],
);

/// exp(x²) erfc x in powers of x, to 4.
const ERFC: Quotient<9> = (
    [
        2.153_115_354_744_038_5e-8,
        5.641_884_969_886_701e-1,
        8.883_149_794_388_375,
        6.611_919_063_714_163e1,
        2.986_351_381_974_001e2,
        8.819_522_212_417_69e2,
        1.712_047_612_634_070_6e3,
        2.051_078_377_826_071_5e3,
        1.230_339_354_797_997_3e3,
    ],
    [
        1.0,
        1.574_492_611_070_983_5e1,
        1.176_939_508_913_125e2,
        5.371_811_018_620_099e2,
        1.621_389_574_566_690_2e3,
        3.290_799_235_733_459_6e3,
        4.362_619_090_143_247e3,
        3.439_367_674_143_721_6e3,
        1.230_339_354_803_749_4e3,
    ],
);

/// x² (1/√π − x exp(x²) erfc x) in powers of 1/x², from 4.
const TAIL: Quotient<6> = (
    [
        1.631_538_713_730_209_8e-2,
        3.053_266_349_612_323_4e-1,
        3.603_448_999_498_044_4e-1,
        1.257_817_261_112_292_5e-1,
        1.608_378_514_874_228e-2,
        6.587_491_615_298_378e-4,
    ],
    [
        1.0,
        2.568_520_192_289_822,
        1.872_952_849_923_46,
        5.279_051_029_514_284e-1,
        6.051_834_131_244_132e-2,
        2.335_204_976_268_691_8e-3,
    ],
);

const CENTER: Quotient<8> = (
    [
        2.509_080_928_730_122_7e3,
        3.343_057_558_358_813e4,
        6.726_577_092_700_87e4,
        4.592_195_393_154_987e4,
        1.373_169_376_550_946e4,
        1.971_590_950_306_551_3e3,
        1.331_416_678_917_843_8e2,
        3.387_132_872_796_366_5,
    ],
    [
        5.226_495_278_852_854e3,
        2.872_908_573_572_194_3e4,
        3.930_789_580_009_271e4,
        2.121_379_430_158_659_7e4,
        5.394_196_021_424_751e3,
        6.871_870_074_920_579e2,
        4.231_333_070_160_091e1,
        1.0,
    ],
);

const SIDE: Quotient<8> = (
    [
        7.745_450_142_783_414e-4,
        2.272_384_498_926_918_4e-2,
        2.417_807_251_774_506e-1,
        1.270_458_252_452_368_4,
        3.647_848_324_763_204_5,
        5.769_497_221_460_691,
        4.630_337_846_156_546,
        1.423_437_110_749_683_5,
    ],
    [
        1.050_750_071_644_416_9e-9,
        5.475_938_084_995_345e-4,
        1.519_866_656_361_645_7e-2,
        1.481_039_764_274_800_8e-1,
        6.897_673_349_851e-1,
        1.676_384_830_183_803_8,
        2.053_191_626_637_759,
        1.0,
    ],
);

const FAR: Quotient<8> = (
    [
        2.010_334_399_292_288_1e-7,
        2.711_555_568_743_487_6e-5,
        1.242_660_947_388_078_4e-3,
        2.653_218_952_657_612_4e-2,
        2.965_605_718_285_048_7e-1,
        1.784_826_539_917_291_3,
        5.463_784_911_164_114,
        6.657_904_643_501_103,
    ],
    [
        2.044_263_103_389_939_8e-15,
        1.421_511_758_316_446e-7,
        1.846_318_317_510_054_8e-5,
        7.868_691_311_456_133e-4,
        1.487_536_129_085_061_5e-2,
        1.369_298_809_227_358e-1,
        5.998_322_065_558_88e-1,
        1.0,
    ],
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_are_those_of_the_library() {
        for i in -2600..=2600 {
            let x = f64::from(i) * 0.01 + 1e-4;
            let (erfc, gauss) = erfc_and_gauss(x);
            let (of_libm, of_std) = (libm::erfc(x), (-x * x).exp());
            // The square is rounded once before the exponential, which costs up to x² units in the last place.
            let allowed = (4e-16 + 2.5e-16 * x * x) * of_libm;
            assert!(
                (erfc - of_libm).abs() <= allowed,
                "{x}: {erfc:e} {of_libm:e}"
            );
            assert_eq!(gauss, of_std);
        }
    }

    #[test]
    fn the_inverse_is_that_of_the_error_function() {
        for i in 1..10_000 {
            let p = f64::from(i) * 1e-4;
            let x = inverse_erf_of_fraction(p);
            let back = 0.5 * libm::erfc(-x);
            assert!((back - p).abs() < 4e-16 + 1e-15 * p, "{p}: {back}");
        }
        for p in [1e-7, 1e-12, 1e-30, 1e-200] {
            let back = 0.5 * libm::erfc(-inverse_erf_of_fraction(p));
            assert!((back / p - 1.0).abs() < 1e-12, "{p:e}: {back:e}");
        }
    }
}
