// The spectrum along a recorded path, four bands at a time.

/// The value of a factor in the four bands of a group.
fn factor_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    if (HAS_TEXTURES && factor.kind == FACTOR_SMOOTH) {
        return smooth_value(texel_at(factor.spectrum).xyz, group, at);
    }
    if (HAS_FILMS && factor.kind >= FACTOR_FILM_REFLECTS) {
        return film_value(factor, group, at);
    }
    if (HAS_COATINGS && factor.kind == FACTOR_COATED) {
        return coating_value(factor, group, at);
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
    if (HAS_STACKS && factor.kind >= FACTOR_STACK_REFLECTS && factor.kind <= FACTOR_STACK_TRANSMITS) {
        return free_stack_value(factor, group, at);
    }
    let inverse = inverse_wavelengths(group, at);
    if (HAS_TWO_BEAM_FILMS && factor.kind >= FACTOR_TWO_BEAM_REFLECTS) {
        let n = spectrum_at(layers[materials[factor.spectrum].first_layer].spectrum, group, at);
        if (factor.kind == FACTOR_TWO_BEAM_TRANSMITS) {
            return two_beam_transmittance(n, factor.cosine);
        }
        let as_printed = materials[factor.spectrum].film == FILM_TWO_BEAM_AS_PRINTED;
        return two_beam_reflectance(n, factor.thickness_nm, inverse, factor.cosine, as_printed);
    }
    let n = spectrum_at(factor.spectrum, group, at);
    if (HAS_LOSSY_FILMS && factor.kind >= FACTOR_LOSSY_FILM_REFLECTS) {
        let k = spectrum_at(factor.spectrum + 1u, group, at);
        let powers = film_powers(n, k, factor.thickness_nm, inverse, factor.cosine);
        let reflects = factor.kind == FACTOR_LOSSY_FILM_REFLECTS;
        return select(powers.transmittance, powers.reflectance, reflects);
    }
    let reflectance = film_reflectance(n, factor.thickness_nm, inverse, factor.cosine);
    return select(1.0 - reflectance, reflectance, factor.kind == FACTOR_FILM_REFLECTS);
}

/// Air at the cosine of a factor.
fn air_above(factor: Factor) -> Incident {
    let cosine = max(factor.cosine, GRAZING);
    return Incident(1.0, cosine * cosine);
}

/// All layers of a material put onto what lies below them, the last one first, or the first one first.
fn with_layers(below: Stack, factor: Factor, last_first: bool, group: u32, at: Wavelengths) -> Stack {
    let first = materials[factor.spectrum].first_layer;
    let count = materials[factor.spectrum].layer_count;
    let inverse = inverse_wavelengths(group, at);
    let incident = air_above(factor);
    var stack = below;
    var place = factor.first_thickness;
    if (last_first) {
        place += materials[factor.spectrum].varying_layers;
    }
    for (var i = 0u; i < count; i++) {
        let layer = first + select(i, count - 1u - i, last_first);
        var thickness_nm = layers[layer].thickness_nm;
        if (layer_varies(layer)) {
            place -= select(0u, 1u, last_first);
            thickness_nm = thicknesses[place];
            place += select(1u, 0u, last_first);
        }
        let n = spectrum_at(layers[layer].spectrum, group, at);
        let k = spectrum_at(layers[layer].spectrum + 1u, group, at);
        stack = stack_layer(stack, n, k, thickness_nm * inverse, incident);
    }
    return stack;
}

/// Reflectance of layers on a conductor.
fn coating_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    let spectrum = materials[factor.spectrum].spectrum;
    let incident = air_above(factor);
    let n = spectrum_at(spectrum, group, at);
    let substrate = substrate_admittances(n, spectrum_at(spectrum + 1u, group, at), incident);
    let stack = with_layers(stack_on(substrate), factor, true, group, at);
    let powers = stack_powers(stack, substrate, incident);
    return 0.5 * (powers.reflectance_s + powers.reflectance_p);
}

/// Reflectance or transmittance of a free film of several layers.
fn free_stack_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    let incident = air_above(factor);
    let substrate = substrate_admittances(vec4f(1.0), vec4f(0.0), incident);
    let from_front = factor.kind != FACTOR_STACK_REFLECTS_BACK;
    let stack = with_layers(stack_on(substrate), factor, from_front, group, at);
    let powers = stack_powers(stack, substrate, incident);
    if (factor.kind == FACTOR_STACK_TRANSMITS) {
        return 0.5 * (powers.transmittance_s + powers.transmittance_p);
    }
    return 0.5 * (powers.reflectance_s + powers.reflectance_p);
}

/// What lobes make of the spectra of a vertex.
fn lobes_value(vertex: Vertex, lobes: Lobes, group: u32, at: Wavelengths) -> vec4f {
    var factor = vertex.scatter;
    factor.cosine = lobes.cosine;
    return lobes.single * factor_value(factor, group, at);
}

/// The spectrum of a light, times that of a texel of its picture. Texel 0 is none: a head stands there.
fn light_value(light: u32, texel: u32, group: u32, at: Wavelengths) -> vec4f {
    let lamp = spectrum_at(light_spectrum(light), group, at);
    if (!HAS_ENVIRONMENT_PICTURE || texel == 0u) {
        return lamp;
    }
    if (HAS_SPECTRAL_PICTURE) {
        return lamp * texel_at(texel + group);
    }
    let pixel = texel_at(texel);
    return lamp * pixel.w * smooth_value(pixel.xyz, group, at);
}

/// Radiance that a vertex receives straight from a light and scatters, before the path's throughput.
fn connection_value(vertex: Vertex, group: u32, at: Wavelengths) -> vec4f {
    var light = light_value(vertex.connection, vertex.connection_texel, group, at);
    if (HAS_FILMS) {
        for (var i = vertex.first_crossing; i < vertex.end_crossing; i++) {
            light *= film_value(crossings[i], group, at);
        }
    }
    return light * lobes_value(vertex, vertex.connected, group, at);
}

/// Radiance by light group with more of one of them. The loop has a fixed length, so that it is unrolled and the array stays in
/// registers: an index that differs between invocations would put it into memory.
fn with_light(
    before: array<vec4f, LIGHT_GROUPS>,
    light_group: u32,
    more: vec4f,
) -> array<vec4f, LIGHT_GROUPS> {
    var radiance = before;
    for (var i = 0u; i < LIGHT_GROUPS; i++) {
        radiance[i] += select(vec4f(0.0), more, i == light_group);
    }
    return radiance;
}

/// Radiance of the recorded path in the four bands of a group, by light group.
fn path_radiance(group: u32, at: Wavelengths) -> array<vec4f, LIGHT_GROUPS> {
    var throughput = vec4f(1.0);
    var radiance: array<vec4f, LIGHT_GROUPS>;
    for (var i = 0u; i < vertex_count; i++) {
        let vertex = vertices[i];
        if (vertex.emission_weight > 0.0) {
            let emission = light_value(vertex.emission, vertex.emission_texel, group, at);
            let arrived = throughput * vertex.emission_weight * emission;
            radiance = with_light(radiance, light_group_of(vertex.emission), arrived);
        }
        if (vertex.scatter.kind == FACTOR_ONE) {
            continue;
        }
        if (is_lit(vertex.connected)) {
            let arrived = throughput * connection_value(vertex, group, at);
            radiance = with_light(radiance, light_group_of(vertex.connection), arrived);
        }
        throughput *= lobes_value(vertex, vertex.onward, group, at);
    }
    return radiance;
}
