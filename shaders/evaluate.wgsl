// The spectrum along a recorded path, four bands at a time.

/// The value of a factor in the four bands of a group.
fn factor_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    if (factor.kind == FACTOR_ONE) {
        return vec4f(1.0);
    }
    let first = spectrum_at(factor.spectrum, group, at);
    if (factor.kind == FACTOR_REFLECTANCE) {
        return first;
    }
    let inverse = inverse_wavelengths(group, at);
    if (factor.kind == FACTOR_FILM_REFLECTS || factor.kind == FACTOR_FILM_TRANSMITS) {
        let reflectance = film_reflectance(first, factor.thickness_nm, inverse, factor.cosine);
        return select(1.0 - reflectance, reflectance, factor.kind == FACTOR_FILM_REFLECTS);
    }
    let k = spectrum_at(factor.spectrum + 1u, group, at);
    if (factor.kind == FACTOR_CONDUCTOR) {
        return reflectance_unpolarised(first, k, factor.cosine);
    }
    let powers = film_powers(first, k, factor.thickness_nm, inverse, factor.cosine);
    if (factor.kind == FACTOR_LOSSY_FILM_REFLECTS) {
        return powers.reflectance;
    }
    return powers.transmittance;
}

/// Radiance that a vertex receives straight from a light, before the path's throughput.
fn connection_value(vertex: Vertex, group: u32, at: Wavelengths) -> vec4f {
    var factor = vertex.scatter;
    factor.cosine = vertex.connection_cosine;
    var light = vertex.connection_weight * spectrum_at(vertex.connection, group, at);
    light *= factor_value(factor, group, at);
    for (var i = vertex.first_crossing; i < vertex.end_crossing; i++) {
        light *= factor_value(crossings[i], group, at);
    }
    return light;
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
        if (vertex.connection_weight > 0.0) {
            radiance += throughput * connection_value(vertex, group, at);
        }
        if (i + 1u < vertex_count) {
            throughput *= vertex.weight * factor_value(vertex.scatter, group, at);
        }
    }
    return radiance;
}
