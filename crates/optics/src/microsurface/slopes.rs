//! Sampling of visible facets, on surfaces of α = 1.

use super::erf::{erfc_and_gauss, inverse_erf_of_fraction};
use crate::wide::sin_cos_turns;
use std::f64::consts::PI;

/// Maximum number of steps of Halley's rule for a slope.
const STEPS: u32 = 4;
/// A step this small is the last: the next would be of the order of its third power, which is below rounding.
const LAST_STEP: f64 = 1e-6;
/// The smallest quantile of the slopes that is sampled.
const MIN_PROBABILITY: f64 = 1e-7;

/// Samples a visible facet of a GGX surface: the half vector of `wo` and a point of the spherical cap (Dupuy and Benyoub 2023,
/// listing 3).
pub(super) fn sample_visible_ggx(wo: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    let (sin_phi, cos_phi) = sin_cos_turns(u);
    let z = (1.0 - v) * (1.0 + wo[2]) - wo[2];
    let sine = (1.0 - z * z).max(0.0).sqrt();
    super::normalized([sine * cos_phi + wo[0], sine * sin_phi + wo[1], z + wo[2]])
}

/// Samples a visible facet of a Beckmann surface: its slope toward `wo` by [`visible_slope`], the perpendicular slope by the
/// normal distribution alone (Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs Using the Distribution of Visible
/// Normals, 2014, appendix).
pub(super) fn sample_visible_beckmann(wo: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    let sine = wo[0].hypot(wo[1]);
    let (cos_phi, sin_phi) = if sine > 0.0 {
        (wo[0] / sine, wo[1] / sine)
    } else {
        (1.0, 0.0)
    };
    let toward = visible_slope(wo[2], sine, u);
    let aside = inverse_erf_of_fraction(v.max(MIN_PROBABILITY));
    let x = cos_phi * toward - sin_phi * aside;
    let y = sin_phi * toward + cos_phi * aside;
    super::normalized([-x, -y, 1.0])
}

/// Returns the slope x below which a fraction u of the facets visible from θ lies. The density of x is proportional to
/// exp(−x²) (cos θ − x sin θ) up to x = cot θ, so the fraction is F(x) / F(cot θ) with
/// F(x) = cos θ erfc(−x) + sin θ exp(−x²) / √π.
///
/// Halley's rule improves an initial guess (Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014)
/// until nothing changes.
pub(super) fn visible_slope(cosine: f64, sine: f64, u: f64) -> f64 {
    let u = u.max(MIN_PROBABILITY);
    let steepest = if cosine < 6.0 * sine {
        cosine / sine
    } else {
        6.0
    };
    let of = |(erfc, gauss): (f64, f64)| cosine * erfc + sine / PI.sqrt() * gauss;
    let at_steepest = erfc_and_gauss(-steepest);
    let wanted = u * of(at_steepest);
    let theta = sine.atan2(cosine);
    let power = 1.0 + theta * (-0.876 + theta * (0.4265 - 0.0594 * theta));
    let guess = at_steepest.0 * (1.0 - (1.0 - u).powf(power));
    let mut x = rough_inverse_erf(guess).min(steepest);
    for _ in 0..STEPS {
        let seen = (cosine - x * sine).max(1e-9);
        let at_x = erfc_and_gauss(-x);
        let newton = (wanted - of(at_x)) * 0.5 * PI.sqrt() / (at_x.1 * seen);
        let bend = -x - 0.5 * sine / seen;
        let step = newton / (1.0 + newton * bend);
        x = (x + step).min(steepest);
        if step.abs() < LAST_STEP {
            break;
        }
    }
    x
}

/// Returns the x for which 1 + erf x is `share`, within 2e-3 (Winitzki 2008), from −4 to 4.
fn rough_inverse_erf(share: f64) -> f64 {
    const A: f64 = 0.147;
    let log = (share * (2.0 - share)).max(1e-8).ln();
    let half = 2.0 / (PI * A) + 0.5 * log;
    let root = ((half * half - log / A).sqrt() - half).max(0.0).sqrt();
    root.copysign(share - 1.0)
}
