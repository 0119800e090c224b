// Rough surfaces as specular facets: distributions of slopes with Smith's masking.
//
// Directions are unit vectors in a local frame whose z is the cosine with the macroscopic normal; x runs along the grain of a
// brushed surface. `alpha` is the width of the distribution along and across the grain.

struct Microsurface {
    /// A FACETS_ tag.
    distribution: u32,
    alpha: vec2f,
}

/// Returns exp(x²) erfc(x) for x ≥ 0 by Chebyshev polynomials (Press et al., Numerical Recipes, 2nd ed., section 6.2; relative
/// error below 1.2e-7).
fn scaled_erfc(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.5 * x);
    var p = t * 0.17087277 - 0.82215223;
    p = t * p + 1.48851587;
    p = t * p - 1.13520398;
    p = t * p + 0.27886807;
    p = t * p - 0.18628806;
    p = t * p + 0.09678418;
    p = t * p + 0.37409196;
    p = t * p + 1.00002368;
    return t * exp(t * p - 1.26551223);
}

/// Returns the density D of facet normals, sr⁻¹: with s² = (x/αx)² + (y/αy)² and c the cosine, exp(−s²/c²) / (π αx αy c⁴) for Beckmann
/// and 1 / (π αx αy (s² + c²)²) for GGX.
fn microsurface_density(surface: Microsurface, facet: vec3f) -> f32 {
    if (facet.z <= 0.0) {
        return 0.0;
    }
    let s = facet.xy / surface.alpha;
    let slope2 = dot(s, s);
    let cos2 = facet.z * facet.z;
    let area = PI * surface.alpha.x * surface.alpha.y;
    if (HAS_GGX && (!HAS_BECKMANN || surface.distribution == FACETS_GGX)) {
        return 1.0 / (area * (slope2 + cos2) * (slope2 + cos2));
    }
    return exp(-min(slope2 / cos2, 80.0)) / (area * cos2 * cos2);
}

/// Returns Smith's Λ: the fraction 1 / (1 + Λ) of the facets that face a direction is visible from there. With a = cot θ over the width
/// in the direction's azimuth, Λ is (exp(−a²) / (a √π) − erfc a) / 2 for Beckmann and (√(1 + 1/a²) − 1) / 2 for GGX
/// (Heitz 2014, equations 68 and 72).
fn microsurface_lambda(surface: Microsurface, direction: vec3f) -> f32 {
    let width = length(surface.alpha * direction.xy);
    let a = abs(direction.z) / max(width, 1e-12);
    if (HAS_GGX && (!HAS_BECKMANN || surface.distribution == FACETS_GGX)) {
        return 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    }
    if (a > 6.0) {
        return 0.0;
    }
    let rest = 0.5641895835 / a - scaled_erfc(a); // 1 / √π
    return 0.5 * exp(-a * a) * max(rest, 0.0);
}

struct Reflection {
    /// D G / (4 cos θo): the reflection function of perfectly reflecting facets times cos θi, sr⁻¹.
    value: f32,
    /// Density with which a facet of microsurface_sample reflects `wo` to `wi`, sr⁻¹.
    pdf: f32,
    /// Cosine at the facet.
    cosine: f32,
}

/// Returns the reflection by facets from `wi` to `wo`, both above the surface: G = 1 / (1 + Λ(wo) + Λ(wi)), the density
/// D / (4 cos θo (1 + Λ(wo))) (Heitz 2014, equations 99 and 17).
fn microsurface_reflection(surface: Microsurface, wo: vec3f, wi: vec3f) -> Reflection {
    let facet = normalize(wo + wi);
    let density = microsurface_density(surface, facet) / (4.0 * wo.z);
    let lambda = microsurface_lambda(surface, wo);
    let seen = 1.0 + lambda + microsurface_lambda(surface, wi);
    return Reflection(density / seen, density / (1.0 + lambda), dot(wo, facet));
}

/// Samples a facet normal from two uniform numbers, in proportion to the area visible from `wo`.
fn microsurface_sample(surface: Microsurface, wo: vec3f, u: f32, v: f32) -> vec3f {
    // The same surface stretched to α = 1.
    let stretched = normalize(vec3f(surface.alpha * wo.xy, wo.z));
    var facet: vec3f;
    if (HAS_GGX && (!HAS_BECKMANN || surface.distribution == FACETS_GGX)) {
        facet = sample_visible_ggx(stretched, u, v);
    } else {
        facet = sample_visible_beckmann(stretched, u, v);
    }
    return normalize(vec3f(surface.alpha * facet.xy, max(facet.z, 0.0)));
}

/// Samples a visible facet of a GGX surface of α = 1: the half vector of `wo` and a point of the sphere's lit cap (Dupuy and
/// Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023, listing 3).
fn sample_visible_ggx(wo: vec3f, u: f32, v: f32) -> vec3f {
    // The fraction v of the cap's height is above the point, the rest below it, and 1 − cos θ of the sphere is below the cap: no
    // digits are lost where the sphere is flat, at the top and at the bottom. The facet's height is the part below the point.
    let above = v * (1.0 + wo.z);
    let below = (1.0 - v) * (1.0 + wo.z);
    let sine = sqrt(above * (below + max(1.0 - wo.z, 0.0)));
    return vec3f(sine * direction_of_turn(u) + wo.xy, below);
}

/// Samples a visible facet of a Beckmann surface of α = 1: the slope toward `wo` by visible_slope, the perpendicular slope by the
/// normal distribution alone (Heitz and d'Eon, Importance Sampling Microfacet-Based BSDFs Using the Distribution of Visible
/// Normals, 2014, appendix).
fn sample_visible_beckmann(wo: vec3f, u: f32, v: f32) -> vec3f {
    let sine = length(wo.xy);
    let along = select(vec2f(1.0, 0.0), wo.xy / max(sine, 1e-30), sine > 0.0);
    let toward = visible_slope(wo.z, sine, u);
    let aside = visible_slope(1.0, 0.0, v);
    return vec3f(-along * toward - vec2f(-along.y, along.x) * aside, 1.0);
}

/// Returns the slope x below which the fraction u of the area visible from θ lies: the density of x is proportional to exp(−x²)
/// (cos θ − x sin θ) up to x = cot θ, so the fraction is F(x) / F(cot θ) with F(x) = cos θ erfc(−x) + sin θ exp(−x²) / √π.
///
/// A guess (Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014) is improved by a fixed number
/// of steps of Halley's method.
fn visible_slope(cosine: f32, sine: f32, u_in: f32) -> f32 {
    let u = max(u_in, 1e-7);
    var steepest = 6.0;
    if (cosine < 6.0 * sine) {
        steepest = cosine / sine;
    }
    let wanted = u * visible_cdf(cosine, sine, steepest);
    let theta = polar_angle(cosine, sine);
    let power = 1.0 + theta * (-0.876 + theta * (0.4265 - 0.0594 * theta));
    let guess = visible_cdf(1.0, 0.0, steepest) * (1.0 - pow(1.0 - u, power));
    var x = min(rough_inverse_erf(guess), steepest);
    for (var i = 0u; i < SLOPE_STEPS; i++) {
        let seen = max(cosine - x * sine, 1e-9);
        // √π / 2
        let newton = (wanted - visible_cdf(cosine, sine, x)) * 0.8862269255 * exp(x * x) / seen;
        let bend = -x - 0.5 * sine / seen;
        x = min(x + newton / (1.0 + newton * bend), steepest);
    }
    return x;
}

/// Returns cos θ erfc(−x) + sin θ exp(−x²) / √π.
fn visible_cdf(cosine: f32, sine: f32, x: f32) -> f32 {
    let gauss = exp(-x * x);
    let tail = gauss * scaled_erfc(abs(x));
    return cosine * select(tail, 2.0 - tail, x > 0.0) + sine * 0.5641895835 * gauss;
}

/// Returns the x with 1 + erf x = `share`, within 2e-3 (Winitzki 2008), from −4 to 4.
fn rough_inverse_erf(fraction: f32) -> f32 {
    let logarithm = log(max(fraction * (2.0 - fraction), 1e-8));
    let half = 4.3307467508 + 0.5 * logarithm; // 2 / (0.147 π)
    let root = sqrt(max(sqrt(half * half - logarithm / 0.147) - half, 0.0));
    return select(root, -root, fraction < 1.0);
}
