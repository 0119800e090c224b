// Next-event estimation through the free films between a surface and an emitter, combined with paths that hit an emitter by BSDF
// sampling (multiple importance sampling).

struct EmitterSample {
    emitter: u32,
    direction: vec3f,
    /// Probability with which the emitter was chosen; 0 where no light can arrive.
    pmf: f32,
    /// Density of the direction, sr⁻¹; 1 for light from a single direction.
    density: f32,
    /// The sum of the weights of all emitters.
    emitter_weight_sum: f32,
    /// The texel of the emitter's picture, 0 where it has none.
    texel: u32,
}

/// Chooses an emitter and a direction toward it.
fn sample_emitter(path: PathState, sample: Sample, point: SurfacePoint) -> EmitterSample {
    if (!HAS_EMITTERS || !SAMPLES_EMITTERS || path.segment + 1u > MAX_PATH_SEGMENTS) {
        return EmitterSample(NONE, point.normal, 0.0, 0.0, 0.0, 0u);
    }
    let random = random_at(sample, path, FOR_EMITTER);
    let choice = choose_emitter(point.position, point.normal, random.x);
    if (choice.emitter == NONE) {
        return EmitterSample(NONE, point.normal, 0.0, 0.0, choice.weight_sum, 0u);
    }
    let direction = emitter_sample(choice.emitter, point.position, random.y, random.z);
    if (dot(direction, point.normal) <= 0.0) {
        return EmitterSample(choice.emitter, direction, 0.0, 0.0, choice.weight_sum, 0u);
    }
    var density = 1.0;
    if (!is_delta(choice.emitter)) {
        density = emitter_pdf(choice.emitter, point.position, direction);
    }
    var texel = 0u;
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(choice.emitter).kind == EMITTER_PICTURE) {
        texel = environment_pixel(choice.emitter, direction, random.w);
    }
    return EmitterSample(choice.emitter, direction, choice.pmf, density, choice.weight_sum, texel);
}

/// Adds the contribution of the emitter, with its weight, to the pending vertex.
fn connect(path: PathState, object: u32, point: SurfacePoint, sampled: EmitterSample, eval: BsdfEval) {
    let emitter = sampled.emitter;
    let strength = emitter_strength(emitter, point.position, sampled.direction);
    if (lobes_sum(eval.lobes) <= 0.0 || strength <= 0.0) {
        return;
    }
    let first_crossing = crossing_count;
    let first_thickness = thickness_count;
    let allowed = MAX_PATH_SEGMENTS - path.segment - 1u;
    if (!is_visible(Ray(point.position, sampled.direction), object, emitter, allowed)) {
        crossing_count = first_crossing;
        thickness_count = first_thickness;
        return;
    }
    var mis = 1.0;
    if (SAMPLES_BSDF && !is_delta(emitter)) {
        mis = mis_weight_emitter(emitter, eval.pdf, sampled.pmf, sampled.density);
    }
    pending.crossings = (first_crossing << CROSSING_BITS) | (crossing_count - first_crossing);
    pending.emission = emitter_at(emitter).emission;
    pending.marks |= SCATTERS_EMISSION;
    if (HAS_ENVIRONMENT_PICTURE) {
        pending_texel = sampled.texel;
    }
    if (HAS_POLARIZATION) {
        let axes = scattering_axes(shape_at(object).material, -path.ray.direction, sampled.direction, point.normal);
        pending_planes.emission_turn = turn_between(axes.toward_camera, light_axis, -path.ray.direction);
        pending_planes.emission = emission_behind_films(emitter, first_crossing, axes.toward_light, sampled.direction);
    }
    record_lit(eval.lobes, mis * strength * emitter_at(emitter).scale / (sampled.pmf * sampled.density));
}

/// Records the turns of light from an emitter in this direction, from each film that it crosses to the one before, beginning with the axis at the
/// surface. Returns S1, S2 and S3 of the emission, over S0, about the last axis.
fn emission_behind_films(emitter: u32, first_crossing: u32, at_surface: vec3f, direction: vec3f) -> vec3f {
    var axis = at_surface;
    for (var i = first_crossing; i < crossing_count; i++) {
        let across = crossing_axes[i];
        crossing_turns[i] = turn_between(across, axis, -direction);
        axis = across;
    }
    if (HAS_EMITTED_POLARIZATION) {
        return emitted_stokes(emitter_polarization(emitter), direction, axis);
    }
    return vec3f(0.0);
}

/// Writes to the pending vertex how the surface scatters the emission that joins it.
fn record_lit(lobes: Lobes, factor: f32) {
    pending.emission_weight = lobes.single * factor;
    pending.emission_cosine = lobes.cosine;
    if (HAS_MULTIPLE_SCATTERING) {
        pending_multiple.emission_weight = lobes.multiple * factor;
    }
    if (HAS_BASES) {
        pending_body.emission_weight = lobes.body * factor;
        pending_body.emission_wi_cosine = lobes.wi_cosine;
    }
}

/// Follows a ray to an emitter and records the films that it crosses; returns false where something opaque or more than `allowed`
/// films are in the way.
fn is_visible(ray_in: Ray, from_object: u32, emitter: u32, allowed: u32) -> bool {
    if (!HAS_FILMS) {
        return has_arrived(ray_in, emitter, nearest_hit(ray_in, from_object));
    }
    var ray = ray_in;
    var from_now = from_object;
    for (var crossed = 0u; crossed <= allowed; crossed++) {
        let hit = nearest_hit(ray, from_now);
        if (has_arrived(ray, emitter, hit)) {
            return true;
        }
        if (hit.object == NONE || crossed == allowed) {
            return false;
        }
        if (material_at(shape_at(hit.object).material).surface != SURFACE_FILM) {
            return false;
        }
        let point = surface_point(hit.object, ray, hit.distance);
        let film = film_at(hit.object, point);
        if (HAS_POLARIZATION && crossing_count < MAX_CROSSINGS) {
            crossing_axes[crossing_count] = axis_across(ray.direction, point.normal);
        }
        push_crossing(Crossing(film.factor, film.cosine, film.thickness_nm), film.first_thickness);
        ray.origin = point.position;
        from_now = hit.object;
    }
    return false;
}

/// Whether a ray to an emitter meets nothing in front of it, given what it hits.
fn has_arrived(ray: Ray, emitter: u32, hit: Hit) -> bool {
    if (emitter_at(emitter).object != NONE) {
        return hit.object == emitter_at(emitter).object;
    }
    if (HAS_DELTA_EMITTERS && emitter_at(emitter).kind >= EMITTER_POINT) {
        // A lamp may lie on a surface: a hit just in front of it, within rounding, does not hide it.
        return hit.object == NONE || hit.distance >= 0.99999 * length(emitter_at(emitter).position - ray.origin);
    }
    return hit.object == NONE;
}

/// Returns the MIS weight of a path that hits an emitter by BSDF sampling; next-event estimation has the rest.
fn mis_weight_of_hit(path: PathState, emitter: u32) -> f32 {
    if (!HAS_EMITTERS || path.scatter_pdf <= 0.0 || emitter_at(emitter).brightness <= 0.0) {
        return 1.0;
    }
    if (!SAMPLES_BSDF || !SAMPLES_EMITTERS) {
        return select(0.0, 1.0, SAMPLES_BSDF);
    }
    let pmf = emitter_pmf(emitter, path.scattered_at, path.scattered_normal, path.emitter_weight_sum);
    let density = emitter_pdf(emitter, path.scattered_at, path.ray.direction);
    return 1.0 - mis_weight_emitter(emitter, path.scatter_pdf, pmf, density);
}
