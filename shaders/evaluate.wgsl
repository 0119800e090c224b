// The spectrum along a recorded path, four bands at a time.

/// The value of a factor in the four bands of a group.
fn factor_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    if (HAS_FILMS && factor.kind >= FACTOR_FILM_REFLECTS) {
        return film_value(factor, group, at);
    }
    let first = spectrum_at(factor.spectrum, group, at);
    if ((HAS_MIRRORS || HAS_ROUGH_CONDUCTORS) && factor.kind == FACTOR_CONDUCTOR) {
        let k = spectrum_at(factor.spectrum + 1u, group, at);
        return reflectance_unpolarised(first, k, factor.cosine);
    }
    return first; // a reflectance
}

/// The reflectance or transmittance of a film.
fn film_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    let n = spectrum_at(factor.spectrum, group, at);
    let inverse = inverse_wavelengths(group, at);
    if (HAS_LOSSY_FILMS && factor.kind >= FACTOR_LOSSY_FILM_REFLECTS) {
        let k = spectrum_at(factor.spectrum + 1u, group, at);
        let powers = film_powers(n, k, factor.thickness_nm, inverse, factor.cosine);
        let reflects = factor.kind == FACTOR_LOSSY_FILM_REFLECTS;
        return select(powers.transmittance, powers.reflectance, reflects);
    }
    let reflectance = film_reflectance(n, factor.thickness_nm, inverse, factor.cosine);
    return select(1.0 - reflectance, reflectance, factor.kind == FACTOR_FILM_REFLECTS);
}

/// Radiance that a vertex receives straight from a light and scatters, before the path's throughput. `scatter` is
/// the vertex's own factor, which is also that of a diffuse surface towards the light.
fn connection_value(vertex: Vertex, scatter: vec4f, group: u32, at: Wavelengths) -> vec4f {
    var light = vertex.connection_weight * spectrum_at(vertex.connection, group, at);
    if (HAS_FILMS) {
        for (var i = vertex.first_crossing; i < vertex.end_crossing; i++) {
            light *= film_value(crossings[i], group, at);
        }
    }
    if (HAS_ROUGH_CONDUCTORS && vertex.scatter.kind == FACTOR_CONDUCTOR) {
        var facet = vertex.scatter;
        facet.cosine = vertex.connection_cosine;
        return light * factor_value(facet, group, at);
    }
    return light * scatter;
}

/// Radiance of the recorded path in the four bands of a group.
fn path_radiance(group: u32, at: Wavelengths) -> vec4f {
    var throughput = vec4f(1.0);
    var radiance = vec4f(0.0);
    for (var i = 0u; i < vertex_count; i++) {
        let vertex = vertices[i];
        if (vertex.emission_weight > 0.0) {
            radiance += throughput * vertex.emission_weight * spectrum_at(vertex.emission, group, at);
        }
        if (vertex.scatter.kind == FACTOR_ONE) {
            continue;
        }
        let scatter = factor_value(vertex.scatter, group, at);
        if (vertex.connection_weight > 0.0) {
            radiance += throughput * connection_value(vertex, scatter, group, at);
        }
        throughput *= vertex.weight * scatter;
    }
    return radiance;
}
