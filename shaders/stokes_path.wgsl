// The polarized light along a recorded path, four bands at a time: the second evaluation of the record that spectral_path.wgsl evaluates
// for unpolarized light. It follows the path as light goes, from its end to the camera, so that a Stokes vector is carried and not a matrix.

/// The light of the branches that films split off.
var<private> waiting_light: array<Stokes4, WAITING_LIGHT>;

const WAITING_LIGHT: u32 = MAX_SPLITS * LIGHT_GROUPS;

/// Returns the light that reaches the camera along the recorded path, in the four bands of a group, by light group.
fn path_stokes(group: u32, wavelengths: Wavelengths) -> array<Stokes4, LIGHT_GROUPS> {
    var light: array<Stokes4, LIGHT_GROUPS>;
    if (HAS_SPLITS) {
        // A branch that found nothing is not in the record.
        for (var i = 0u; i < WAITING_LIGHT; i++) {
            waiting_light[i] = Stokes4();
        }
    }
    var i = vertex_count;
    loop {
        if (i == 0u) {
            break;
        }
        i -= 1u;
        let vertex = vertices[i];
        let at = At(i, group, wavelengths);
        let first = factor_value(vertex.factor, at);
        let tag = factor_tag(vertex.factor);
        let planes = vertex_planes[i];
        let weight = mueller_depolarizer(vec4f(vertex.weight));
        var values = MuellerValues(weight, weight);
        if (HAS_BSDFS && tag != FACTOR_ONE && (!HAS_FILMS || tag < FACTOR_FILM)) {
            values = bsdf_mueller(at, vertex, first);
            light = lights_through(values.onward, planes.turn, light);
        }
        if (HAS_FILMS && tag >= FACTOR_FILM) {
            light = lights_from_film(at, vertex, first, light);
        }
        let joining = emission_stokes(at, vertex, values.lit);
        for (var k = 0u; k < LIGHT_GROUPS; k++) {
            if (k == light_group_of(vertex.emission)) {
                light[k] = stokes_sum(light[k], joining);
            }
        }
        if (HAS_SPLITS) {
            let resumes = (vertex.marks >> RESUMES_FROM) & 0xffu;
            if (resumes > 0u) {
                for (var k = 0u; k < LIGHT_GROUPS; k++) {
                    waiting_light[(resumes - 1u) * LIGHT_GROUPS + k] = light[k];
                    light[k] = Stokes4();
                }
            }
        }
    }
    return light;
}

/// Returns the light of all groups after a matrix and a turn of its axis.
fn lights_through(matrix: Mueller, turn: vec2f, light: array<Stokes4, LIGHT_GROUPS>) -> array<Stokes4, LIGHT_GROUPS> {
    var after = light;
    for (var k = 0u; k < LIGHT_GROUPS; k++) {
        after[k] = stokes_turned(turn, mueller_apply(matrix, after[k]));
    }
    return after;
}

/// Returns the light that leaves a film toward the camera. Where the film splits the path, `light` is what it reflects, and what it transmits
/// has waited.
fn lights_from_film(at: At, vertex: Vertex, first: vec4f, light: array<Stokes4, LIGHT_GROUPS>) -> array<Stokes4, LIGHT_GROUPS> {
    var film = FilmAt(vertex.factor, vertex.cosine, vertex.thickness_nm, 0u);
    if (RECORDS_THICKNESSES) {
        film.first_thickness = first_thicknesses[at.vertex];
    }
    let both = film_polarized_value(film, first, at);
    let reflected = mueller_of(both.reflected, vertex.weight);
    let turn = vertex_planes[at.vertex].turn;
    if ((vertex.marks & TRANSMITS) != 0u) {
        return lights_through(mueller_of(both.transmitted, vertex.weight), turn, light);
    }
    var after = lights_through(reflected, turn, light);
    if (HAS_SPLITS) {
        let splits = (vertex.marks >> SPLITS_TO) & 0xffu;
        if (splits > 0u) {
            for (var k = 0u; k < LIGHT_GROUPS; k++) {
                let through = mueller_apply(mueller_of(both.transmitted, 1.0), waiting_light[(splits - 1u) * LIGHT_GROUPS + k]);
                after[k] = stokes_sum(after[k], stokes_turned(turn, through));
            }
        }
    }
    return after;
}

/// Returns the light of an emitter that joins the path at a vertex; `lit` is the matrix of the surface where that scatters it.
fn emission_stokes(at: At, vertex: Vertex, lit: Mueller) -> Stokes4 {
    let radiance = emission_value(vertex.emission, at);
    let planes = vertex_planes[at.vertex];
    var light = Stokes4(radiance, vec4f(0.0), vec4f(0.0), vec4f(0.0));
    if (HAS_EMITTED_POLARIZATION) {
        light.s1 = planes.emission.x * radiance;
        light.s2 = planes.emission.y * radiance;
        light.s3 = planes.emission.z * radiance;
    }
    if (HAS_SCATTERING && (vertex.marks & SCATTERS_EMISSION) != 0u) {
        if (HAS_FILMS) {
            light = light_through_crossings(at, vertex, light);
        }
        return stokes_turned(planes.emission_turn, mueller_apply(lit, light));
    }
    let weight = vertex.emission_weight;
    return Stokes4(weight * light.s0, weight * light.s1, weight * light.s2, weight * light.s3);
}

/// Returns the light of an emitter after the films between it and a vertex, the one beside the emitter first.
fn light_through_crossings(at: At, vertex: Vertex, from_emitter: Stokes4) -> Stokes4 {
    var light = from_emitter;
    let first = vertex.crossings >> CROSSING_BITS;
    var i = first + (vertex.crossings & ((1u << CROSSING_BITS) - 1u));
    loop {
        if (i <= first) {
            break;
        }
        i -= 1u;
        let crossing = crossings[i];
        var film = FilmAt(crossing.factor, crossing.cosine, crossing.thickness_nm, 0u);
        if (RECORDS_THICKNESSES) {
            film.first_thickness = crossing_thicknesses[i];
        }
        let both = film_polarized_value(film, factor_value(crossing.factor, at), at);
        light = stokes_turned(crossing_turns[i], mueller_apply(mueller_of(both.transmitted, 1.0), light));
    }
    return light;
}

/// Returns the light that the camera measures: behind its polarizer, radiance alone.
fn sensed(light: Stokes4, group: u32, wavelengths: Wavelengths) -> vec4f {
    if (!HAS_POLARIZER) {
        return light.s0;
    }
    let phase = phase_factor(2.0 * frame.retarder_nm * inverse_wavelengths(group, wavelengths), vec4f(0.0));
    let w1 = frame.analyzer.x + frame.analyzer_cosine.x * phase.re + frame.analyzer_sine.x * phase.im;
    let w2 = frame.analyzer.y + frame.analyzer_cosine.y * phase.re + frame.analyzer_sine.y * phase.im;
    let w3 = frame.analyzer.z + frame.analyzer_cosine.z * phase.re + frame.analyzer_sine.z * phase.im;
    return 0.5 * (light.s0 + w1 * light.s1 + w2 * light.s2 + w3 * light.s3);
}

/// Returns the radiance by light group that the camera measures along the recorded path, in the four bands of a group.
fn sensed_radiance(group: u32, wavelengths: Wavelengths) -> array<vec4f, LIGHT_GROUPS> {
    let light = path_stokes(group, wavelengths);
    var radiance: array<vec4f, LIGHT_GROUPS>;
    for (var k = 0u; k < LIGHT_GROUPS; k++) {
        radiance[k] = sensed(light[k], group, wavelengths);
    }
    return radiance;
}
