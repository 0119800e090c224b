//! A diffuse body below a clear coat.

use crate::reflectance_unpolarized;
use crate::wide::Real;
use num_complex::Complex64;

/// Reflectance of a smooth surface of `index` for diffuse unpolarized light from vacuum: ∫ F(θ) 2 cos θ sin θ dθ, by Gauss's rule of
/// order 16 on eight equal intervals of √cos θ, which resolves the steep rise at grazing incidence.
///
/// For glass (1.5) it is 0.0918 (Judd 1942, J. Res. NBS 29, 329, table 1). The internal reflectance follows from it:
/// 1 − (1 − Ē) / n².
pub fn hemispherical_reflectance(index: Complex64) -> f64 {
    const PARTS: u32 = 8;
    let mut sum = 0.0;
    for part in 0..PARTS {
        for (x, weight) in GAUSS_16.iter().flat_map(|&(x, w)| [(x, w), (-x, w)]) {
            // cos θ = t²: 2 c dc = 4 t³ dt.
            let t = (f64::from(part) + 0.5 + 0.5 * x) / f64::from(PARTS);
            sum += weight * 4.0 * t.powi(3) * reflectance_unpolarized(index, (t * t).max(1e-9));
        }
    }
    0.5 * sum / f64::from(PARTS)
}

/// Positive half of Gauss's points and weights of order 16 on \[−1, 1\] (Abramowitz and Stegun, table 25.4).
const GAUSS_16: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_5),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// P/ρ of a body of diffuse reflectance `base` ρ below a clear coat of real index n: the BRDF of the light that has entered the
/// coat and left it again is f = (1 − E(θᵢ)) (1 − E(θₒ)) P / π with P = ρ / (n² − ρ (n² − 1 + Ē)).
///
/// E(θ) is the external reflectance of the coat's surface, smooth or rough, and `outer` its mean Ē over diffuse light. The base
/// reflects the light that has entered diffusely, and the surface reflects a fraction Rᵢ of it back internally:
/// ρ / (n² (1 − ρ Rᵢ)), with 1 − Rᵢ = (1 − Ē) / n², since the surface transmits as much diffuse light in either direction
/// (Saunderson 1942; Duntley 1942; Elias, Simonot and Menu 2001 for the angles). A body without loss has (1 − Ē) P = 1 at any index.
///
/// Domain: n > 0, 0 ≤ ρ ≤ 1, 0 ≤ Ē < 1.
#[inline]
pub fn coated_albedo_factor<T: Real>(base: T, n: T, outer: T) -> T {
    let n2 = n * n;
    (n2 - base * (n2 - outer.complement())).recip()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// External diffuse reflectance and, by 1 − Rᵢ = (1 − Ē) / n², the internal one (Judd 1942, J. Res. NBS 29, 329: 0.0918 and
    /// 0.596 for 1.5; Duntley's closed form gives the other digits).
    #[test]
    fn diffuse_reflectance_is_as_published() {
        for n in [1.2, 1.333, 1.5, 1.6, 2.0, 3.0] {
            let found = hemispherical_reflectance(n.into());
            let expected = duntley(n);
            assert!((found - expected).abs() < 1e-9, "{n}: {found} {expected}");
        }
        let glass = hemispherical_reflectance(1.5.into());
        assert!((glass - 0.0918).abs() < 5e-5, "{glass}");
        let inside = 1.0 - (1.0 - glass) / 2.25;
        assert!((inside - 0.596).abs() < 5e-4, "{inside}");
    }

    /// Closed form of the external diffuse reflectance (Walsh 1926; Duntley 1942, J. Opt. Soc. Am. 32, 61).
    fn duntley(n: f64) -> f64 {
        let n2 = n * n;
        0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0).powi(2))
            + n2 * (n2 - 1.0).powi(2) / (n2 + 1.0).powi(3) * ((n - 1.0) / (n + 1.0)).ln()
            - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0))
            + 8.0 * n2 * n2 * (n2 * n2 + 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0).powi(2)) * n.ln()
    }

    /// Follows light back and forth between base and surface, pass by pass.
    #[test]
    fn the_factor_is_the_sum_of_all_passes() {
        let (n, base, outer): (f64, f64, f64) = (1.5, 0.7, 0.0918);
        let inner = 1.0 - (1.0 - outer) / (n * n);
        let passes = (0..200).map(|i| base * (base * inner).powi(i)).sum::<f64>();
        // What leaves in all directions together: (1 − Rᵢ) of what the base reflects upward, per unit of light that entered.
        let leaves = (1.0 - inner) * passes;
        let by_factor = base * coated_albedo_factor(base, n, outer) * (1.0 - outer);
        assert!((leaves - by_factor).abs() < 1e-12, "{leaves} {by_factor}");
        assert!(by_factor < base);
    }

    #[test]
    fn a_white_body_returns_everything() {
        for n in [0.8, 1.0, 1.5, 3.0] {
            let outer = hemispherical_reflectance(n.into());
            let returned = (1.0 - outer) * coated_albedo_factor(1.0, n, outer);
            assert!((returned - 1.0).abs() < 1e-12, "{n}");
        }
    }
}
