// The facets of a rough surface: single and multiple scattering.

/// Returns a property of facets in a direction, from the table at `first`: over the cosine and, where the surface is brushed, over
/// the width of the slopes in the direction's azimuth.
fn over_facets(first: u32, alpha: vec2f, direction: vec3f) -> f32 {
    let place = sqrt(clamp(direction.z, 0.0, 1.0)) * f32(FACET_COSINES - 1u);
    let row = min(u32(place), FACET_COSINES - 2u);
    let down = place - f32(row);
    if (!HAS_GRAIN || alpha.x == alpha.y) {
        return mix(number_at(first + row), number_at(first + row + 1u), down);
    }
    let width = length(alpha * direction.xy) / max(length(direction.xy), 1e-12);
    let across = clamp((width - alpha.x) / (alpha.y - alpha.x), 0.0, 1.0) * f32(FACET_WIDTHS - 1u);
    let column = min(u32(across), FACET_WIDTHS - 2u);
    let left = first + column * FACET_COSINES + row;
    let right = left + FACET_COSINES;
    let here = mix(number_at(left), number_at(left + 1u), down);
    let beside = mix(number_at(right), number_at(right + 1u), down);
    return mix(here, beside, across - f32(column));
}

/// Returns the directional albedo E of perfectly reflecting facets. The fraction 1 − E of the light meets another facet.
fn facets_albedo(facets: Facets, direction: vec3f) -> f32 {
    return over_facets(facets.first_energy, facets.alpha, direction);
}

fn microsurface_of(facets: Facets) -> Microsurface {
    return Microsurface(facets.distribution, facets.alpha);
}

/// Returns single and multiple scattering, without their colors. The light that met several facets leaves as
/// (1 − E(wo)) (1 − E(wi)) / (π (1 − E mean)), so that no energy is lost (Kelemen and Szirmay-Kalos 2001; Kulla and Conty 2017).
///
/// Directions are sampled by visible facets and, with probability 1 − E(wo), uniformly over the hemisphere.
fn facets_eval(facets: Facets, wo: vec3f, wi: vec3f) -> BsdfEval {
    if (wo.z <= 0.0 || wi.z <= 0.0) {
        return dark(wi);
    }
    let once = microsurface_reflection(microsurface_of(facets), wo, wi);
    let fraction = 1.0 - facets_albedo(facets, wo);
    let lost = max(1.0 - facets.mean_energy, 1e-6);
    let again = fraction * (1.0 - facets_albedo(facets, wi)) / (PI * lost);
    let lobes = Lobes(once.value, again * wi.z, 0.0, once.cosine, wi.z);
    return BsdfEval(lobes, mix(once.pdf, 0.5 / PI, fraction));
}

/// Samples a direction by the density of facets_eval.
fn facets_sample(facets: Facets, wo: vec3f, random: vec4f) -> vec3f {
    if (random.z < 1.0 - facets_albedo(facets, wo)) {
        return sample_cone(random.x, random.y, 1.0);
    }
    let facet = microsurface_sample(microsurface_of(facets), wo, random.x, random.y);
    return normalize(reflect(-wo, facet));
}

/// Cosines and weights of a mean over a hemisphere: Gauss's rule of three points for the weight x (Abramowitz and Stegun, table 25.8).
const MEAN_COSINES: vec3f = vec3f(0.2123405382, 0.5905331356, 0.9114120405);
const MEAN_WEIGHTS: vec3f = vec3f(0.1396539598, 0.4584822127, 0.4018638275);

/// Returns the color of light that met several facets: F² E / (1 − F (1 − E)), with F the mean of the reflectance over a hemisphere
/// and E the mean of the facets' albedo (Kulla and Conty 2017).
fn multiple_color(mean: vec4f, mean_energy: f32) -> vec4f {
    return mean * mean * mean_energy / (1.0 - mean * (1.0 - mean_energy));
}
