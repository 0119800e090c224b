// Rough surfaces as a distribution of small specular facets. Directions are unit vectors in a local frame whose z is the cosine
// with the macroscopic normal.

/// Returns Beckmann's distribution of facet normals, sr⁻¹: exp(−tan²α / m²) / (π m² cos⁴α)
/// (Cook and Torrance 1982, equation 5, normalized so that ∫ D cos α dω = 1).
fn beckmann_d(cos_facet: f32, slope: f32) -> f32 {
    if (cos_facet <= 0.0) {
        return 0.0;
    }
    let cos2 = cos_facet * cos_facet;
    let m2 = slope * slope;
    let tan2 = (1.0 - cos2) / cos2;
    return exp(-min(tan2 / m2, 80.0)) / (PI * m2 * cos2 * cos2);
}

/// Returns the shadowing and masking of a symmetric V-shaped groove (Torrance and Sparrow 1967; Cook and Torrance 1982).
fn v_groove_g(cos_facet: f32, cos_wo: f32, cos_wi: f32, wo_dot_facet: f32) -> f32 {
    if (cos_wo <= 0.0 || cos_wi <= 0.0 || wo_dot_facet <= 0.0) {
        return 0.0;
    }
    let groove = 2.0 * cos_facet / wo_dot_facet;
    return min(1.0, groove * min(cos_wo, cos_wi));
}

/// Samples a facet normal with density D cos α from two uniform numbers: tan²α = −m² ln(1 − u).
fn sample_beckmann(u: f32, v: f32, slope: f32) -> vec3f {
    let tan2 = -slope * slope * log_one_minus(u);
    let cosine = 1.0 / sqrt(1.0 + tan2);
    let sine = sqrt(tan2) * cosine;
    return vec3f(sine * direction_of_turn(v), cosine);
}

/// Returns ln(1 − u) for u in [0, 1), accurate near 0, where WGSL's log has only a bounded absolute error.
fn log_one_minus(u: f32) -> f32 {
    if (u > 0.03125) {
        return log(1.0 - u);
    }
    // −u − u²/2 − u³/3 …; the remainder after u⁵ is below 2e-8 of the whole.
    return -u * (1.0 + u * (0.5 + u * (1.0 / 3.0 + u * (0.25 + u * 0.2))));
}
