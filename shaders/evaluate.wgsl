// The spectrum along a recorded path, four bands at a time.

/// The spectrum of a vertex's light, times that of the texel of its picture. Texel 0 is none: a head stands there.
fn light_value(light: u32, at: Place) -> vec4f {
    let lamp = spectrum_at(light_spectrum(light), at.group, at.wavelengths);
    if (!HAS_ENVIRONMENT_PICTURE) {
        return lamp;
    }
    let texel = light_texels[at.vertex];
    if (texel == 0u) {
        return lamp;
    }
    if (HAS_SPECTRAL_PICTURE) {
        return lamp * texel_at(texel + at.group);
    }
    let pixel = texel_at(texel);
    return lamp * pixel.w * smooth_value(pixel.xyz, at.group, at.wavelengths);
}

/// What the films let through that a vertex's light passes.
fn crossings_value(vertex: Vertex, at: Place) -> vec4f {
    var passes = vec4f(1.0);
    let first = vertex.crossings >> CROSSING_BITS;
    let end = first + (vertex.crossings & ((1u << CROSSING_BITS) - 1u));
    for (var i = first; i < end; i++) {
        let crossing = crossings[i];
        var film = FilmAt(crossing.factor, crossing.cosine, crossing.thickness_nm, 0u);
        if (RECORDS_THICKNESSES) {
            film.first_thickness = crossing_thicknesses[i];
        }
        passes *= film_spectrum(film, number_spectrum(crossing.factor, at), at).transmittance;
    }
    return passes;
}

/// The spectrum of a factor's number, where it is one.
fn number_spectrum(factor: u32, at: Place) -> vec4f {
    var number = factor_number(factor);
    let tag = factor_tag(factor);
    if ((HAS_STACKS && tag >= FACTOR_STACK) || (HAS_COATINGS && tag == FACTOR_COATING) || (HAS_TEXTURES && tag == FACTOR_TEXTURE)) {
        number = 0u;
    }
    return spectrum_at(number, at.group, at.wavelengths);
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

/// Radiance of the recorded path in the four bands of a group, by light group. Each vertex reads its spectrum and its light once, and works
/// out its film once.
fn path_radiance(group: u32, wavelengths: Wavelengths) -> array<vec4f, LIGHT_GROUPS> {
    var throughput = vec4f(1.0);
    var radiance: array<vec4f, LIGHT_GROUPS>;
    var i = 0u;
    loop {
        let vertex = vertices[i];
        let at = Place(i, group, wavelengths);
        let first = number_spectrum(vertex.factor, at);
        let tag = factor_tag(vertex.factor);
        if (HAS_SPLITS) {
            let resumes = (vertex.marks >> RESUMES_FROM) & 0xffu;
            throughput = select(throughput, waiting_light[max(resumes, 1u) - 1u], resumes > 0u);
        }
        var values = Values(vec4f(vertex.weight), vec4f(vertex.light_weight));
        if (HAS_BSDFS && tag != FACTOR_ONE && (!HAS_FILMS || tag < FACTOR_FILM)) {
            values = bsdf_spectrum(at, vertex, first);
        }
        if (HAS_FILMS && tag >= FACTOR_FILM) {
            values.onward *= film_passes(at, vertex, first, throughput);
        }
        var light = throughput * light_value(vertex.light, at);
        if (HAS_SCATTERING) {
            if (HAS_FILMS) {
                light *= crossings_value(vertex, at);
            }
            light *= select(vec4f(vertex.light_weight), values.lit, (vertex.marks & SCATTERS_LIGHT) != 0u);
        } else {
            light *= vertex.light_weight;
        }
        radiance = with_light(radiance, light_group_of(vertex.light), light);
        throughput *= values.onward;
        continuing {
            i++;
            break if i >= vertex_count;
        }
    }
    return radiance;
}

/// What a film makes of the path that goes on from it. What it transmits of `throughput` waits, where it splits the path.
fn film_passes(at: Place, vertex: Vertex, first: vec4f, throughput: vec4f) -> vec4f {
    var film = FilmAt(vertex.factor, vertex.cosine, vertex.thickness_nm, 0u);
    if (RECORDS_THICKNESSES) {
        film.first_thickness = first_thicknesses[at.vertex];
    }
    let powers = film_spectrum(film, first, at);
    if (HAS_SPLITS) {
        let splits = (vertex.marks >> SPLITS_TO) & 0xffu;
        if (splits > 0u) {
            waiting_light[splits - 1u] = throughput * powers.transmittance;
        }
    }
    return select(powers.reflectance, powers.transmittance, (vertex.marks & TRANSMITS) != 0u);
}
