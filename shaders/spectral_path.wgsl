// The spectrum along a recorded path, four bands at a time.

/// Returns the spectrum of a vertex's emission, times the spectrum of its texel. Texel 0 means none: it is a header.
fn emission_value(emission: u32, at: At) -> vec4f {
    let lamp = spectrum_at(emission_spectrum(emission), at.group, at.wavelengths);
    if (!HAS_ENVIRONMENT_PICTURE) {
        return lamp;
    }
    let texel = emission_texels[at.vertex];
    if (texel == 0u) {
        return lamp;
    }
    if (HAS_SPECTRAL_PICTURE) {
        return lamp * texel_at(texel + at.group);
    }
    let pixel = texel_at(texel);
    return lamp * pixel.w * smooth_value(pixel.xyz, at.group, at.wavelengths);
}

/// Returns the transmittance of the films that a vertex's emission crosses.
fn crossings_transmittance(vertex: Vertex, at: At) -> vec4f {
    var transmittance = vec4f(1.0);
    let first = vertex.crossings >> CROSSING_BITS;
    let end = first + (vertex.crossings & ((1u << CROSSING_BITS) - 1u));
    for (var i = first; i < end; i++) {
        let crossing = crossings[i];
        var film = FilmAt(crossing.factor, crossing.cosine, crossing.thickness_nm, 0u);
        if (RECORDS_THICKNESSES) {
            film.first_thickness = crossing_thicknesses[i];
        }
        transmittance *= film_value(film, factor_value(crossing.factor, at), at).transmittance;
    }
    return transmittance;
}

/// Returns the spectrum with a factor's index, where it is a spectrum.
fn factor_value(factor: u32, at: At) -> vec4f {
    var number = factor_number(factor);
    let tag = factor_tag(factor);
    if ((HAS_STACKS && tag >= FACTOR_STACK) || (HAS_COATINGS && tag == FACTOR_COATING) || (HAS_TEXTURES && tag == FACTOR_TEXTURE)) {
        number = 0u;
    }
    return spectrum_at(number, at.group, at.wavelengths);
}

/// Returns the radiance by light group after adding to one of them. The loop has a fixed length, so that it is unrolled and the
/// array stays in registers: an index that differs between invocations would put it into memory.
fn with_emission(
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

/// The throughputs that wait where films split the path.
var<private> waiting_throughput: array<vec4f, MAX_SPLITS>;

/// Returns the factor that reduces a sample's radiance to at most `frame.clamp` in every band.
fn dimming(at: Wavelengths) -> f32 {
    if (!HAS_CLAMP) {
        return 1.0;
    }
    var brightest = vec4f(frame.clamp);
    for (var group = 0u; group < GROUPS; group++) {
        var radiance: array<vec4f, LIGHT_GROUPS>;
        if (HAS_POLARIZATION) {
            radiance = sensed_radiance(group, at);
        } else {
            radiance = path_radiance(group, at);
        }
        var total = vec4f(0.0);
        for (var i = 0u; i < LIGHT_GROUPS; i++) {
            total += radiance[i];
        }
        let is_band = 4u * group + vec4u(0u, 1u, 2u, 3u) < vec4u(frame.bands);
        brightest = max(brightest, select(vec4f(0.0), total, is_band));
    }
    return frame.clamp / max(max(brightest.x, brightest.y), max(brightest.z, brightest.w));
}

/// Returns the radiance of the recorded path in the four bands of a group, by light group. Each vertex reads its spectrum and its
/// emission once, and computes its film once.
fn path_radiance(group: u32, wavelengths: Wavelengths) -> array<vec4f, LIGHT_GROUPS> {
    var throughput = vec4f(1.0);
    var radiance: array<vec4f, LIGHT_GROUPS>;
    var i = 0u;
    loop {
        let vertex = vertices[i];
        let at = At(i, group, wavelengths);
        let first = factor_value(vertex.factor, at);
        let tag = factor_tag(vertex.factor);
        if (HAS_SPLITS) {
            let resumes = (vertex.marks >> RESUMES_FROM) & 0xffu;
            throughput = select(throughput, waiting_throughput[max(resumes, 1u) - 1u], resumes > 0u);
        }
        var values = Values(vec4f(vertex.weight), vec4f(vertex.emission_weight));
        if (HAS_BSDFS && tag != FACTOR_ONE && (!HAS_FILMS || tag < FACTOR_FILM)) {
            values = bsdf_value(at, vertex, first);
        }
        if (HAS_FILMS && tag >= FACTOR_FILM) {
            values.onward *= film_factor(at, vertex, first, throughput);
        }
        var arriving = throughput * emission_value(vertex.emission, at);
        if (HAS_SCATTERING) {
            if (HAS_FILMS) {
                arriving *= crossings_transmittance(vertex, at);
            }
            arriving *= select(vec4f(vertex.emission_weight), values.lit, (vertex.marks & SCATTERS_EMISSION) != 0u);
        } else {
            arriving *= vertex.emission_weight;
        }
        radiance = with_emission(radiance, light_group_of(vertex.emission), arriving);
        throughput *= values.onward;
        continuing {
            i++;
            break if i >= vertex_count;
        }
    }
    return radiance;
}

/// Returns a film's factor for the path that continues from it. Where the film splits the path, the transmitted part of `throughput` waits.
fn film_factor(at: At, vertex: Vertex, first: vec4f, throughput: vec4f) -> vec4f {
    var film = FilmAt(vertex.factor, vertex.cosine, vertex.thickness_nm, 0u);
    if (RECORDS_THICKNESSES) {
        film.first_thickness = first_thicknesses[at.vertex];
    }
    let powers = film_value(film, first, at);
    if (HAS_SPLITS) {
        let splits = (vertex.marks >> SPLITS_TO) & 0xffu;
        if (splits > 0u) {
            waiting_throughput[splits - 1u] = throughput * powers.transmittance;
        }
    }
    return select(powers.reflectance, powers.transmittance, (vertex.marks & TRANSMITS) != 0u);
}
