// The spectrum along a recorded path, four bands at a time.

/// The value of a factor that is no film's, in the four bands of a group.
fn surface_value(factor: Factor, group: u32, at: Wavelengths) -> vec4f {
    if (HAS_TEXTURES && factor.kind == FACTOR_SMOOTH) {
        return smooth_value(texel_at(factor.spectrum).xyz, group, at);
    }
    if (HAS_COATINGS && factor.kind == FACTOR_COATED) {
        return coating_value(factor, group, at);
    }
    let first = spectrum_at(factor.spectrum, group, at);
    if ((HAS_MIRRORS || HAS_ROUGH_CONDUCTORS || HAS_COOK || HAS_BASES) && factor.kind == FACTOR_CONDUCTOR) {
        let k = spectrum_at(factor.spectrum + 1u, group, at);
        return reflectance_unpolarised(first, k, factor.cosine);
    }
    return first; // a reflectance
}

/// The reflectance or transmittance of a film, in the four bands of a group.
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

/// Cosines and weights of a mean over a hemisphere: Gauss's rule of three points for the weight x (Abramowitz and Stegun,
/// table 25.8).
const MEAN_COSINES: vec3f = vec3f(0.2123405382, 0.5905331356, 0.9114120405);
const MEAN_WEIGHTS: vec3f = vec3f(0.1396539598, 0.4584822127, 0.4018638275);

/// The colour of light that met several facets of a vertex's surface: F² E / (1 − F (1 − E)) with F the mean of its reflectance
/// over a hemisphere and E that of the facets' albedo (Kulla and Conty 2017).
fn multiple_colour(vertex: Vertex, group: u32, at: Wavelengths) -> vec4f {
    var factor = vertex.scatter;
    var mean = vec4f(0.0);
    // In a loop, so that the layers' code is there once.
    for (var i = 0u; i < 3u; i++) {
        factor.cosine = MEAN_COSINES[i];
        mean += MEAN_WEIGHTS[i] * surface_value(factor, group, at);
    }
    let energy = materials[vertex.material].mean_energy;
    return mean * mean * energy / (1.0 - mean * (1.0 - energy));
}

/// What lobes make of the spectra of a vertex that scatters; `multiple` is its multiple_colour.
fn lobes_value(vertex: Vertex, lobes: Lobes, multiple: vec4f, group: u32, at: Wavelengths) -> vec4f {
    var factor = vertex.scatter;
    factor.cosine = lobes.cosine;
    var value = lobes.single * surface_value(factor, group, at);
    if (HAS_ROUGH_CONDUCTORS) {
        value += lobes.multiple * multiple;
    }
    if (HAS_BASES && lobes.body > 0.0) {
        value += lobes.body * body_value(vertex, lobes.light_cosine, group, at);
    }
    return value;
}

/// The colour of a base beside facets, or below a coat with what the coat keeps of it.
fn body_value(vertex: Vertex, light_cosine: f32, group: u32, at: Wavelengths) -> vec4f {
    let base = surface_value(Factor(vertex.base_kind, vertex.base, 1.0, 0.0, 0u), group, at);
    let surface = materials[vertex.material].surface;
    if (!(HAS_COATED_BODIES || HAS_ROUGH_COATS) || surface < SURFACE_COATED_BODY) {
        return base;
    }
    let n = spectrum_at(vertex.scatter.spectrum, group, at);
    let outer = spectrum_at(materials[vertex.material].mean_reflectance, group, at);
    let inside = base * coated_albedo_factor(base, n, outer);
    if (HAS_ROUGH_COATS && surface == SURFACE_ROUGH_COATED_BODY) {
        let enters = rough_coat_passes(vertex.material, light_cosine, group, at);
        return enters * rough_coat_passes(vertex.material, vertex.eye_cosine, group, at) * inside;
    }
    return coat_passes(n, vertex.eye_cosine) * coat_passes(n, light_cosine) * inside;
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
fn connection_value(vertex: Vertex, multiple: vec4f, group: u32, at: Wavelengths) -> vec4f {
    var light = light_value(vertex.connection, vertex.connection_texel, group, at);
    if (HAS_FILMS) {
        for (var i = vertex.first_crossing; i < vertex.end_crossing; i++) {
            light *= film_value(crossings[i], group, at);
        }
    }
    return light * lobes_value(vertex, vertex.connected, multiple, group, at);
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

/// The factor of what a film transmits, from that of what it reflects.
fn transmitting(reflecting: Factor) -> Factor {
    var factor = reflecting;
    factor.kind += select(1u, 2u, HAS_STACKS && factor.kind == FACTOR_STACK_REFLECTS);
    return factor;
}

/// The light that waits where films split the path.
var<private> waiting_light: array<vec4f, MAX_SPLITS>;

/// By how much a sample is dimmed, so that its radiance is at most `frame.clamp` in every band.
fn dimming(at: Wavelengths) -> f32 {
    if (!HAS_CLAMP) {
        return 1.0;
    }
    var brightest = vec4f(frame.clamp);
    for (var group = 0u; group < GROUPS; group++) {
        let radiance = path_radiance(group, at);
        var total = vec4f(0.0);
        for (var i = 0u; i < LIGHT_GROUPS; i++) {
            total += radiance[i];
        }
        let is_band = 4u * group + vec4u(0u, 1u, 2u, 3u) < vec4u(frame.bands);
        brightest = max(brightest, select(vec4f(0.0), total, is_band));
    }
    return frame.clamp / max(max(brightest.x, brightest.y), max(brightest.z, brightest.w));
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
            if (HAS_SPLITS && vertex.waiting != NONE) {
                throughput = waiting_light[vertex.waiting];
            }
            continue;
        }
        if (HAS_SPLITS && vertex.waiting != NONE) {
            waiting_light[vertex.waiting] = throughput * film_value(transmitting(vertex.scatter), group, at);
        }
        var multiple = vec4f(0.0);
        if (HAS_ROUGH_CONDUCTORS && vertex.onward.multiple + vertex.connected.multiple > 0.0) {
            multiple = multiple_colour(vertex, group, at);
        }
        if (is_lit(vertex.connected)) {
            let arrived = throughput * connection_value(vertex, multiple, group, at);
            radiance = with_light(radiance, light_group_of(vertex.connection), arrived);
        }
        if (HAS_FILMS && vertex.scatter.kind >= FACTOR_FILM_REFLECTS) {
            throughput *= vertex.onward.single * film_value(vertex.scatter, group, at);
        } else {
            throughput *= lobes_value(vertex, vertex.onward, multiple, group, at);
        }
    }
    return radiance;
}
