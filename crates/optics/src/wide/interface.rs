//! One boundary between vacuum and a medium.

use super::Real;

/// Reflectance for unpolarized light of a half space of index n + ik seen from vacuum: Fresnel's equations in real arithmetic.
///
/// With c the cosine, s² = 1 − c² and q = a + ib, q² = (n + ik)² − s²: R_s = ((c − a)² + b²) / ((c + a)² + b²) and
/// R_p = R_s ((a − s²/c)² + b²) / ((a + s²/c)² + b²) (König 1928, in Born and Wolf, Principles of Optics, 7th ed.,
/// section 14.2). Their mean is R_s t / (t + u) with t = c²|q|² + s⁴ and u = 2ac s².
///
/// Domain: n ≥ 0, k ≥ 0, not both 0; `cosine` in (0, 1]. It agrees with [`stack`](crate::stack) without layers within 1e-14.
#[inline(always)]
pub fn interface_reflectance<T: Real>(n: T, k: T, cosine: f64) -> T {
    let cos2 = cosine * cosine;
    let sin2 = (1.0 - cosine) * (1.0 + cosine);
    let one = n.constant(1.0);
    let re = k.negate_mul_add(k, (n - one).mul_add(n + one, n.constant(cos2)));
    let im = (n * k).times(2.0);
    let size = re.mul_add(re, im * im).sqrt();
    let a2 = (size + re).times(0.5).at_least(0.0);
    let (a, b2) = (a2.sqrt(), size - a2);
    let (down, up) = (n.constant(cosine) - a, n.constant(cosine) + a);
    let t = size.mul_add(n.constant(cos2), n.constant(sin2 * sin2));
    let u = a.times(2.0 * cosine * sin2);
    down.mul_add(down, b2) * t / (up.mul_add(up, b2) * (t + u))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Complex64, stack};

    #[test]
    fn the_real_form_is_fresnels() {
        let mut worst = 0.0_f64;
        for (n, k) in [
            (1.5, 0.0),
            (1.0, 0.0),
            (0.7, 0.0),
            (0.13, 3.3),
            (0.05, 9.0),
            (2.7, 3.8),
            (1.0, 1e-3),
            (4.1, 0.04),
        ] {
            for cosine in [1e-6, 1e-3, 0.1, 0.3, 0.555, 0.8, 1.0] {
                let expected = stack(1.0, &[], Complex64::new(n, k), 500.0, cosine).reflectance;
                let off = interface_reflectance(n, k, cosine) - expected.unpolarized();
                worst = worst.max(off.abs());
            }
        }
        assert!(worst < 1e-14, "{worst:e}");
        let other = interface_reflectance(0.13, 3.3 * (1.0 + 1e-9), 0.5);
        assert!((other - interface_reflectance(0.13, 3.3, 0.5)).abs() > 1e-13);
    }
}
