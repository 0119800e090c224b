// The polarized light along a recorded path, four bands at a time: the second evaluation of the record that spectral_path.wgsl evaluates
// for unpolarized light. It follows the path as light goes, from its end to the camera, so that a Stokes vector is carried and not a matrix.

/// The light of the branches that films split off, and 0 where none waits: a branch that finds nothing is not in the record. What the first
/// vertex of a branch writes, the vertex of the film reads and clears.
var<private> waiting_light: array<Stokes4, WAITING_LIGHT>;

const WAITING_LIGHT: u32 = MAX_SPLITS * LIGHT_GROUPS;

/// Returns the light that reaches the camera along the recorded path, in the four bands of a group, by light group.
///
/// Branches decide over matrices alone, and each vertex changes the light at one place: a software driver pays for every value that a branch
/// may change.
fn path_stokes(group: u32, wavelengths: Wavelengths) -> array<Stokes4, LIGHT_GROUPS> {
    var light: array<Stokes4, LIGHT_GROUPS>;
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
        var values = MuellerValues(mueller_identity(), mueller_identity());
        if (HAS_BSDFS && tag != FACTOR_ONE && (!HAS_FILMS || tag < FACTOR_FILM)) {
            values = bsdf_mueller(at, vertex, first);
        }
        var through = PolarizedPowers();
        if (HAS_FILMS && tag >= FACTOR_FILM) {
            let film = film_of_vertex(at, vertex, first);
            let transmits = (vertex.marks & TRANSMITS) != 0u;
            values.onward = mueller_of(selected_powers(film.reflected, film.transmitted, transmits), vertex.weight);
            through = film.transmitted;
        }
        let step = Step(
            values.onward,
            mueller_of(through, 1.0),
            vertex_planes[i].turn,
            emission_stokes(at, vertex, values.lit),
            light_group_of(vertex.emission),
            (vertex.marks >> SPLITS_TO) & 0xffu,
            (vertex.marks >> RESUMES_FROM) & 0xffu,
        );
        light[0] = light_after(step, light[0], 0u);
        if (LIGHT_GROUPS > 1u) {
            light[GROUP_1] = light_after(step, light[GROUP_1], 1u);
        }
        if (LIGHT_GROUPS > 2u) {
            light[GROUP_2] = light_after(step, light[GROUP_2], 2u);
        }
        if (LIGHT_GROUPS > 3u) {
            light[GROUP_3] = light_after(step, light[GROUP_3], 3u);
        }
        if (LIGHT_GROUPS > 4u) {
            light[GROUP_4] = light_after(step, light[GROUP_4], 4u);
        }
        if (LIGHT_GROUPS > 5u) {
            light[GROUP_5] = light_after(step, light[GROUP_5], 5u);
        }
        if (LIGHT_GROUPS > 6u) {
            light[GROUP_6] = light_after(step, light[GROUP_6], 6u);
        }
        if (LIGHT_GROUPS > 7u) {
            light[GROUP_7] = light_after(step, light[GROUP_7], 7u);
        }
        if (LIGHT_GROUPS > 8u) {
            for (var k = 8u; k < LIGHT_GROUPS; k++) {
                light[k] = light_after(step, light[k], k);
            }
        }
    }
    return light;
}

/// The places of the first light groups, written out: at an index that is not a constant, the driver of a processor keeps the array in memory and
/// reads it one path after the other. A place that is not there is the last one, and is not used.
const GROUP_1: u32 = min(1u, LIGHT_GROUPS - 1u);
const GROUP_2: u32 = min(2u, LIGHT_GROUPS - 1u);
const GROUP_3: u32 = min(3u, LIGHT_GROUPS - 1u);
const GROUP_4: u32 = min(4u, LIGHT_GROUPS - 1u);
const GROUP_5: u32 = min(5u, LIGHT_GROUPS - 1u);
const GROUP_6: u32 = min(6u, LIGHT_GROUPS - 1u);
const GROUP_7: u32 = min(7u, LIGHT_GROUPS - 1u);

/// What a vertex does to the light of each group.
struct Step {
    onward: Mueller,
    /// What a film transmits.
    through: Mueller,
    turn: vec2f,
    joining: Stokes4,
    light_group: u32,
    /// See `Vertex.marks`.
    splits: u32,
    resumes: u32,
}

/// Returns the light of a group after a vertex; where another branch is to follow, it waits, and none is returned.
fn light_after(step: Step, light: Stokes4, group: u32) -> Stokes4 {
    var arriving = mueller_apply(step.onward, light);
    if (HAS_SPLITS) {
        // What the film transmits has waited; where it does not split the path, nothing is added.
        let place = (max(step.splits, 1u) - 1u) * LIGHT_GROUPS + group;
        let waited = waiting_light[place];
        let through = stokes_scaled(mueller_apply(step.through, waited), select(0.0, 1.0, step.splits > 0u));
        arriving = stokes_sum(arriving, through);
        if (step.splits > 0u) {
            waiting_light[place] = Stokes4();
        }
    }
    let joins = select(0.0, 1.0, group == step.light_group);
    let found = stokes_sum(stokes_turned(step.turn, arriving), stokes_scaled(step.joining, joins));
    if (!HAS_SPLITS) {
        return found;
    }
    if (step.resumes > 0u) {
        waiting_light[(step.resumes - 1u) * LIGHT_GROUPS + group] = found;
    }
    return stokes_scaled(found, select(1.0, 0.0, step.resumes > 0u));
}

/// Returns what the film of a vertex reflects and transmits.
fn film_of_vertex(at: At, vertex: Vertex, first: vec4f) -> PolarizedFilm {
    var film = FilmAt(vertex.factor, vertex.cosine, vertex.thickness_nm, 0u);
    if (RECORDS_THICKNESSES) {
        film.first_thickness = first_thicknesses[at.vertex];
    }
    return film_polarized_value(film, first, at);
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
    return stokes_scaled(light, vertex.emission_weight);
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
