// Metals by the model of Cook and Torrance as Suzuki, Yokoi and Toriwaki print it (section 3-1). Directions are unit vectors in
// a local frame whose z is the cosine with the macroscopic normal.

struct CookFacets {
    /// G Σ wⱼ Dⱼ / ((N·L) (N·E)): the reflection function without its Fresnel factor, sr⁻¹.
    reflection: f32,
    /// Density with which sample_cook_facet and a mirror give this direction, sr⁻¹.
    pdf: f32,
    /// E·H: the cosine at the facet.
    cosine: f32,
}

/// From `light` to `eye`; black where either is below the surface.
fn cook_facets(material: u32, eye: vec3f, light: vec3f) -> CookFacets {
    if (eye.z <= 0.0 || light.z <= 0.0) {
        return CookFacets(0.0, 0.0, 1.0);
    }
    let facet = normalize(eye + light);
    let cosine = dot(eye, facet);
    if (cosine <= 0.0) {
        return CookFacets(0.0, 0.0, 1.0);
    }
    let is_gaussian = materials[material].surface == SURFACE_COOK_D1;
    let first = materials[material].first_slope;
    var distribution = 0.0;
    var density = 0.0;
    for (var i = 0u; i < materials[material].slope_count; i++) {
        let slope = number_at(first + 3u * i);
        let weight = number_at(first + 3u * i + 1u);
        let part = number_at(first + 3u * i + 2u);
        if (is_gaussian) {
            distribution += weight * gaussian_d1(facet.z, slope);
            density += part * gaussian_pdf(facet.z, slope);
        } else {
            let d = beckmann_d(facet.z, slope);
            distribution += weight * PI * d;
            density += part * d * facet.z;
        }
    }
    let g = v_groove_g(facet.z, eye.z, light.z, cosine);
    return CookFacets(distribution * g / (eye.z * light.z), density / (4.0 * cosine), cosine);
}

/// A facet normal of one of the slopes, chosen by `pick`.
fn sample_cook_facet(material: u32, u: f32, v: f32, pick: f32) -> vec3f {
    let first = materials[material].first_slope;
    let last = materials[material].slope_count - 1u;
    var chosen = 0u;
    var below = number_at(first + 2u);
    while (chosen < last && pick >= below) {
        chosen++;
        below += number_at(first + 3u * chosen + 2u);
    }
    let slope = number_at(first + 3u * chosen);
    if (materials[material].surface == SURFACE_COOK_D1) {
        return sample_gaussian(u, v, slope);
    }
    return sample_beckmann(u, v, slope);
}
