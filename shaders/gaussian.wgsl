// Facets whose angle with the normal has a Gaussian distribution: D₁ of Cook and Torrance's model.

/// Returns D₁ = exp(−a² / m²), with a the angle between facet and normal, without its constant.
fn gaussian_d1(cos_facet: f32, slope: f32) -> f32 {
    if (cos_facet <= 0.0) {
        return 0.0;
    }
    let x = facet_angle(cos_facet) / slope;
    return exp(-min(x * x, 80.0));
}

/// Returns the angle in [0, π/2] of a cosine ≥ 0.
fn facet_angle(cosine: f32) -> f32 {
    return polar_angle(cosine, sqrt(max((1.0 - cosine) * (1.0 + cosine), 0.0)));
}

/// Returns Z = 1 − exp(−π² / 4m²): the fraction of a Gaussian in the plane that is above the horizon.
fn gaussian_fraction(slope: f32) -> f32 {
    return 1.0 - exp(-0.25 * PI * PI / (slope * slope));
}

/// Samples a facet normal from two uniform numbers: a² = −m² ln(1 − u Z).
fn sample_gaussian(u: f32, v: f32, slope: f32) -> vec3f {
    // 1 − u Z, without the cancellation where both Z and u are almost 1.
    let rest = (1.0 - u) + u * exp(-0.25 * PI * PI / (slope * slope));
    let logarithm = select(log(rest), log_one_minus(u * gaussian_fraction(slope)), u < 0.03125);
    let angle = min(slope * sqrt(-logarithm), 0.5 * PI);
    let polar = direction_of_turn(angle * (0.5 / PI));
    return vec3f(polar.y * direction_of_turn(v), polar.x);
}

/// Returns the density of a facet normal of sample_gaussian, sr⁻¹: exp(−a²/m²) a / (π m² Z sin a).
fn gaussian_pdf(cos_facet: f32, slope: f32) -> f32 {
    if (cos_facet <= 0.0) {
        return 0.0;
    }
    let angle = facet_angle(cos_facet);
    let sine = sqrt(max((1.0 - cos_facet) * (1.0 + cos_facet), 0.0));
    let widening = select(1.0, angle / max(sine, 1e-30), sine > 1e-6);
    return gaussian_d1(cos_facet, slope) * widening / (PI * slope * slope * gaussian_fraction(slope));
}
