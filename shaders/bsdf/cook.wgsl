// The model of Cook and Torrance for metals, as printed by Suzuki, Yokoi and Toriwaki (section 3-1). Directions are unit vectors in
// a local frame whose z is the cosine with the macroscopic normal.

struct CookFacets {
    /// G Σ wⱼ Dⱼ / (cos θi cos θo): the reflection function without its Fresnel factor, sr⁻¹.
    reflection: f32,
    /// Density with which a reflection at a facet of sample_cook_facet has this direction, sr⁻¹.
    pdf: f32,
    /// Cosine at the facet.
    cosine: f32,
}

fn cook_of(material: u32) -> Cook {
    return load_cook(material_at(material).record);
}

/// Returns the reflection from `wi` to `wo`; black when either direction is below the surface.
fn cook_facets(material: u32, wo: vec3f, wi: vec3f) -> CookFacets {
    if (wo.z <= 0.0 || wi.z <= 0.0) {
        return CookFacets(0.0, 0.0, 1.0);
    }
    let facet = normalize(wo + wi);
    let cosine = dot(wo, facet);
    if (cosine <= 0.0) {
        return CookFacets(0.0, 0.0, 1.0);
    }
    let cook = cook_of(material);
    let is_gaussian = cook.distribution == COOK_GAUSSIAN;
    let first = cook.first_slope;
    var distribution = 0.0;
    var density = 0.0;
    for (var i = 0u; i < cook.slope_count; i++) {
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
    let g = v_groove_g(facet.z, wo.z, wi.z, cosine);
    return CookFacets(distribution * g / (wo.z * wi.z), density / (4.0 * cosine), cosine);
}

/// Samples a facet normal for one of the slopes, chosen by `pick`.
fn sample_cook_facet(material: u32, u: f32, v: f32, pick: f32) -> vec3f {
    let cook = cook_of(material);
    let first = cook.first_slope;
    let last = cook.slope_count - 1u;
    var chosen = 0u;
    var below = number_at(first + 2u);
    while (chosen < last && pick >= below) {
        chosen++;
        below += number_at(first + 3u * chosen + 2u);
    }
    let slope = number_at(first + 3u * chosen);
    if (cook.distribution == COOK_GAUSSIAN) {
        return sample_gaussian(u, v, slope);
    }
    return sample_beckmann(u, v, slope);
}

fn cook_eval(material: u32, wo: vec3f, wi: vec3f) -> BsdfEval {
    let cook = cook_of(material);
    let lambert = max(wi.z, 0.0) / PI;
    let facet = cook_facets(material, wo, wi);
    let pdf = mix(facet.pdf, lambert, cook.base_probability);
    return BsdfEval(Lobes(facet.reflection * wi.z, 0.0, cook.base_fraction * lambert, facet.cosine, wi.z), pdf);
}

fn cook_sample(material: u32, wo: vec3f, random: vec4f) -> vec3f {
    if (random.z < cook_of(material).base_probability) {
        return sample_cosine_hemisphere(random.x, random.y);
    }
    return normalize(reflect(-wo, sample_cook_facet(material, random.x, random.y, random.w)));
}

fn cook_factor(material: u32) -> u32 {
    let cook = cook_of(material);
    if (HAS_BASES) {
        pending_body.base = factor_of(FACTOR_DIFFUSE, cook.base);
    }
    return factor_of(FACTOR_COOK, cook.spectrum);
}

fn cook_value(at: At, vertex: Vertex, n: vec4f) -> Values {
    let k = spectrum_at(factor_number(vertex.factor) + 1u, at.group, at.wavelengths);
    var values = Values(
        vertex.weight * reflectance_unpolarized(n, k, vertex.cosine),
        vertex.emission_weight * reflectance_unpolarized(n, k, vertex.emission_cosine),
    );
    if (HAS_BASES) {
        let body = bodies[at.vertex];
        let base = spectrum_at(factor_number(body.base), at.group, at.wavelengths);
        values.onward += body.weight * base;
        values.lit += body.emission_weight * base;
    }
    return values;
}

/// Returns the matrices: facets act by their amplitudes, the Lambertian fraction depolarizes.
fn cook_mueller(at: At, vertex: Vertex, n: vec4f) -> MuellerValues {
    let k = spectrum_at(factor_number(vertex.factor) + 1u, at.group, at.wavelengths);
    var values = MuellerValues(
        mueller_of(interface_polarized(n, k, vertex.cosine), vertex.weight),
        mueller_of(interface_polarized(n, k, vertex.emission_cosine), vertex.emission_weight),
    );
    if (HAS_BASES) {
        let body = bodies[at.vertex];
        let base = spectrum_at(factor_number(body.base), at.group, at.wavelengths);
        values.onward = mueller_and_depolarizer(values.onward, body.weight * base);
        values.lit = mueller_and_depolarizer(values.lit, body.emission_weight * base);
    }
    return values;
}
