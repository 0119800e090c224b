//! Facets drawn as often as they are seen, on surfaces of α = 1.

use std::f64::consts::{PI, TAU};

/// Steps of Halley's rule by which a slope is found.
const STEPS: u32 = 4;

/// A visible facet of a GGX surface: the half of a point of the sphere's lit cap and the eye (Dupuy and Benyoub 2023, listing 3).
pub(super) fn sample_ggx(eye: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    let (sin_phi, cos_phi) = (TAU * u).sin_cos();
    let z = (1.0 - v) * (1.0 + eye[2]) - eye[2];
    let sine = (1.0 - z * z).max(0.0).sqrt();
    super::normalised([sine * cos_phi + eye[0], sine * sin_phi + eye[1], z + eye[2]])
}

/// A visible facet of a Beckmann surface: its slope towards the eye by [`visible_slope`], that aside by the normal
/// distribution alone (Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs Using the Distribution of Visible Normals,
/// 2014, appendix).
pub(super) fn sample_beckmann(eye: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    let sine = eye[0].hypot(eye[1]);
    let (cos_phi, sin_phi) = if sine > 0.0 {
        (eye[0] / sine, eye[1] / sine)
    } else {
        (1.0, 0.0)
    };
    let towards = visible_slope(eye[2], sine, u);
    let aside = visible_slope(1.0, 0.0, v);
    let x = cos_phi * towards - sin_phi * aside;
    let y = sin_phi * towards + cos_phi * aside;
    super::normalised([-x, -y, 1.0])
}

/// The slope x below which the share u of what is seen from θ lies: the density of x is that of exp(−x²) (cos θ − x sin θ) up to
/// x = cot θ, so the share is F(x) / F(cot θ) with F(x) = cos θ erfc(−x) + sin θ exp(−x²) / √π.
///
/// A guess (Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014) is improved by Halley's rule,
/// always as often.
pub(super) fn visible_slope(cosine: f64, sine: f64, u: f64) -> f64 {
    let u = u.max(1e-7);
    let steepest = if cosine < 6.0 * sine {
        cosine / sine
    } else {
        6.0
    };
    let share = |x: f64| cosine * libm::erfc(-x) + sine / PI.sqrt() * (-x * x).exp();
    let wanted = u * share(steepest);
    let theta = sine.atan2(cosine);
    let power = 1.0 + theta * (-0.876 + theta * (0.4265 - 0.0594 * theta));
    let guess = libm::erfc(-steepest) * (1.0 - (1.0 - u).powf(power));
    let mut x = rough_inverse_erf(guess).min(steepest);
    for _ in 0..STEPS {
        let seen = (cosine - x * sine).max(1e-9);
        let newton = (wanted - share(x)) * 0.5 * PI.sqrt() * (x * x).exp() / seen;
        let bend = -x - 0.5 * sine / seen;
        x = (x + newton / (1.0 + newton * bend)).min(steepest);
    }
    x
}

/// The x of which 1 + erf x is `share`, within 2e-3 (Winitzki 2008), from −4 to 4.
fn rough_inverse_erf(share: f64) -> f64 {
    const A: f64 = 0.147;
    let log = (share * (2.0 - share)).max(1e-8).ln();
    let half = 2.0 / (PI * A) + 0.5 * log;
    let root = ((half * half - log / A).sqrt() - half).max(0.0).sqrt();
    root.copysign(share - 1.0)
}
