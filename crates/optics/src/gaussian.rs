//! Facets whose angle with the normal has a Gaussian distribution (Blinn 1977), for the model of Cook and Torrance.

use std::f64::consts::PI;

/// D₁ = exp(−a² / m²), Gaussian in the angle a between facet and normal in radians, without its constant c (Blinn 1977).
///
/// Domain: `slope` m > 0, a root mean square slope without a unit. Cosines of 0 and less give 0.
pub fn gaussian_d1(cos_facet: f64, slope: f64) -> f64 {
    if cos_facet <= 0.0 {
        return 0.0;
    }
    let angle = facet_angle(cos_facet);
    (-(angle / slope).powi(2)).exp()
}

/// The constant c for which c D₁ covers the surface once: c ∫ exp(−a²/m²) cos a dω = 1, that is
/// 1 / c = π ∫₀^{π/2} exp(−a²/m²) sin 2a da, by Simpson's rule.
///
/// Domain: `slope` m > 0.
pub fn gaussian_constant(slope: f64) -> f64 {
    const STEPS: u32 = 2000;
    let end = (0.5 * PI).min(8.0 * slope);
    let step = end / f64::from(STEPS);
    let integrand = |i: u32| {
        let angle = f64::from(i) * step;
        (-(angle / slope).powi(2)).exp() * (2.0 * angle).sin()
    };
    let inner = (1..STEPS).map(|i| integrand(i) * if i % 2 == 1 { 4.0 } else { 2.0 });
    let sum = integrand(0) + inner.sum::<f64>() + integrand(STEPS);
    1.0 / (PI * sum * step / 3.0)
}

/// Samples a facet normal from two uniform numbers in [0, 1), with the squared angle distributed according to D₁:
/// a² = −m² ln(1 − u Z) with Z = 1 − exp(−π² / 4m²), which cuts it off at the horizon.
///
/// Domain: `slope` m > 0. The normal is a unit vector whose third component is the cosine with the surface normal.
pub fn sample_gaussian(u: f64, v: f64, slope: f64) -> [f64; 3] {
    let angle = slope * (-(-u * gaussian_fraction(slope)).ln_1p()).sqrt();
    let (sine, cosine) = angle.min(0.5 * PI).sin_cos();
    let (sin_phi, cos_phi) = (2.0 * PI * v).sin_cos();
    [sine * cos_phi, sine * sin_phi, cosine]
}

/// Density of a facet normal sampled by [`sample_gaussian`], sr⁻¹: exp(−a²/m²) a / (π m² Z sin a).
///
/// Domain: `slope` m > 0. Cosines of 0 and less give 0.
pub fn gaussian_pdf(cos_facet: f64, slope: f64) -> f64 {
    if cos_facet <= 0.0 {
        return 0.0;
    }
    let angle = facet_angle(cos_facet);
    let sine = angle.sin();
    let widening = if sine > 0.0 { angle / sine } else { 1.0 };
    gaussian_d1(cos_facet, slope) * widening / (PI * slope * slope * gaussian_fraction(slope))
}

/// Z = 1 − exp(−π² / 4m²): the fraction of a Gaussian in the plane that is above the horizon.
pub fn gaussian_fraction(slope: f64) -> f64 {
    -(-0.25 * PI * PI / (slope * slope)).exp_m1()
}

/// Returns the angle of a cosine; small angles lose no digits.
fn facet_angle(cosine: f64) -> f64 {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
    sine.atan2(cosine)
}
