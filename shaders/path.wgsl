// Tracing a path and recording it. Nothing here depends on wavelength.

/// Traces the path of one sample into the record and returns its wavelengths. Where films split the path, one branch is followed to
/// its end, and then the other.
fn trace_path(sample: Sample) -> Wavelengths {
    begin_record();
    waiting_count = 0u;
    let first = numbers_of(sample, 0u);
    let ray = first_ray(sample, first.xy);
    if (HAS_POLARIZATION) {
        light_axis = axis_across(ray.direction, frame.camera_up);
    }
    var path = PathState(ray, NONE, vec3f(0.0), 0.0, vec3f(0.0), 0.0, 1u, true, frame.film_splits, 0u, 1.0);
    loop {
        path = extend_path(path, sample);
        write_vertex();
        var resumes = 0u;
        if (HAS_SPLITS && !path.alive && waiting_count > 0u) {
            resumes = waiting_count;
            path = resume();
        }
        begin_vertex(resumes);
        continuing {
            break if !path.alive;
        }
    }
    return wavelengths_at(select(0.5, first.z, frame.draws_wavelengths == 1u));
}

/// The dimension of the camera's lens: beyond those of all branches.
const LENS_DIMENSION: u32 = 0xffffu;

/// Returns the camera ray of a sample.
fn first_ray(sample: Sample, jitter: vec2f) -> Ray {
    if (HAS_LENS) {
        return camera_ray(sample.pixel, jitter, numbers_of(sample, LENS_DIMENSION).xy);
    }
    return camera_ray(sample.pixel, jitter, vec2f(0.0));
}

/// Follows the path to the next surface, and on from there.
fn extend_path(path: PathState, sample: Sample) -> PathState {
    let hit = nearest_hit(path.ray, path.from_object);
    var next = path;
    if (hit.object == NONE) {
        if (HAS_ENVIRONMENT) {
            shade_environment(path, sample);
        }
        next.alive = false;
        return next;
    }
    next = shade_object(path, sample, hit);
    next.alive = next.alive && path.segment < MAX_PATH_SEGMENTS;
    if (HAS_ROULETTE && next.alive && path.segment >= ROULETTE_AFTER) {
        next = russian_roulette(next, sample);
    }
    next.segment += 1u;
    return next;
}

/// Adds the radiance of the environment, part by part, where the path leaves the scene.
fn shade_environment(path: PathState, sample: Sample) {
    for (var i = 0u; i < ENVIRONMENT_COUNT; i++) {
        let part = environment_part(i);
        let strength = environment_strength(part, path.ray.direction);
        if (strength > 0.0) {
            if (is_pending) {
                write_vertex();
                begin_vertex(0u);
            }
            var texel = 0u;
            if (HAS_ENVIRONMENT_PICTURE && emitter_at(part).kind == EMITTER_PICTURE) {
                texel = environment_pixel(part, path.ray.direction, random_at(sample, path, FOR_EMITTER).w);
            }
            add_emission(emitter_at(part).emission, texel, emitter_at(part).scale * strength * mis_weight_of_hit(path, part));
            if (HAS_EMITTED_POLARIZATION) {
                pending_planes.emission = emitted_stokes(emitter_polarization(part), path.ray.direction, light_axis);
            }
        }
    }
}

/// Handles the hit of an object.
fn shade_object(path: PathState, sample: Sample, hit: Hit) -> PathState {
    let material = shape_at(hit.object).material;
    let head = material_at(material);
    let point = surface_point(hit.object, path.ray, hit.distance);
    if (head.emission_scale > 0.0) {
        var mis = 1.0;
        if (HAS_EMITTERS && shape_at(hit.object).emitter != NONE) {
            mis = mis_weight_of_hit(path, shape_at(hit.object).emitter);
        }
        add_emission(head.emission, 0u, head.emission_scale * mis);
        if (HAS_EMITTED_POLARIZATION) {
            pending_planes.emission = emitted_stokes(head.polarization, path.ray.direction, light_axis);
        }
    }
    if (head.surface == SURFACE_BLACK) {
        var ended = path;
        ended.alive = false;
        return ended;
    }
    if (HAS_GLOW && is_pending) {
        write_vertex();
        begin_vertex(0u);
    }
    is_pending = true;
    var random = vec4f(0.0);
    if (HAS_FILMS || HAS_SCATTERING) {
        random = random_at(sample, path, FOR_BSDF);
    }
    if (HAS_FILMS && head.surface == SURFACE_FILM) {
        return shade_film(path, hit.object, point, random);
    }
    if (HAS_BSDFS) {
        return shade_surface(path, sample, hit.object, point, random);
    }
    return path;
}

/// Handles a film: the path is reflected or transmitted, or both.
fn shade_film(path: PathState, object: u32, point: SurfacePoint, random: vec4f) -> PathState {
    let material = shape_at(object).material;
    let albedo = material_at(material).albedo;
    let reflected = reflected_at(material, point.cosine);
    var mirror = scatter(path, object, point, mirrored_at(path.ray.direction, point.normal), 0.0, 0.0);
    var through = pass_through(path, object, point);
    mirror.rr_throughput *= albedo * reflected;
    through.rr_throughput *= albedo * (1.0 - reflected);
    let film = film_at(object, point);
    pending.factor = film.factor;
    pending.cosine = film.cosine;
    pending.thickness_nm = film.thickness_nm;
    if (RECORDS_THICKNESSES) {
        pending_thickness = film.first_thickness;
    }
    if (HAS_POLARIZATION) {
        turn_axis(axis_across(path.ray.direction, point.normal), -path.ray.direction);
    }
    if (HAS_SPLITS && path.splits > 0u && path.segment < MAX_PATH_SEGMENTS) {
        mirror.splits -= 1u;
        through.splits -= 1u;
        through.branch += 1u << through.splits;
        through.segment += 1u;
        pending.marks |= (wait(through) + 1u) << SPLITS_TO;
        return mirror;
    }
    let reflects_with = reflection_probability(reflected);
    let reflects = random.x < reflects_with;
    let probability = select(1.0 - reflects_with, reflects_with, reflects);
    pending.weight = 1.0 / probability;
    if (reflects) {
        mirror.rr_throughput /= probability;
        return mirror;
    }
    pending.marks |= TRANSMITS;
    through.rr_throughput /= probability;
    return through;
}

/// Handles a specular or scattering surface: an emitter is sampled, and the path continues in a direction sampled from the BSDF.
fn shade_surface(path: PathState, sample: Sample, object: u32, point: SurfacePoint, random: vec4f) -> PathState {
    let material = shape_at(object).material;
    pending.factor = bsdf_factor(object, point, random.w);
    pending.cosine = point.cosine;
    let world_from_local = surface_frame(object, point);
    let wo = -path.ray.direction * world_from_local;
    let specular = bsdf_specular_probability(material, wo);
    if (HAS_BASES) {
        pending_body.wo_cosine = wo.z;
    }

    var emitter_weight_sum = 0.0;
    if (HAS_SCATTERING && specular < 1.0) {
        let sampled = sample_emitter(path, sample, point);
        emitter_weight_sum = sampled.emitter_weight_sum;
        if (sampled.pmf * sampled.density > 0.0) {
            connect(path, object, point, sampled, bsdf_eval(material, wo, sampled.direction * world_from_local));
        }
    }

    if (HAS_SPECULAR && (!HAS_SCATTERING || random.z < specular)) {
        pending.weight = 1.0 / specular;
        var mirror = scatter(path, object, point, mirrored_at(path.ray.direction, point.normal), 0.0, 0.0);
        mirror.rr_throughput *= material_at(material).albedo;
        if (HAS_POLARIZATION) {
            turn_axis(axis_across(path.ray.direction, point.normal), -path.ray.direction);
        }
        return mirror;
    }
    let wi = bsdf_sample(material, wo, random);
    let onward = bsdf_eval(material, wo, wi);
    var next = scatter(path, object, point, normalize(world_from_local * wi), onward.pdf, emitter_weight_sum);
    next.splits = 0u;
    next.alive = onward.pdf > 0.0;
    let inverse_pdf = select(0.0, 1.0 / onward.pdf, next.alive);
    record_onward(onward.lobes, inverse_pdf);
    if (HAS_POLARIZATION) {
        let axes = scattering_axes(material, -path.ray.direction, next.ray.direction, point.normal);
        turn_axis(axes.toward_camera, -path.ray.direction);
        light_axis = axes.toward_light;
    }
    next.rr_throughput *= lobes_sum(onward.lobes) * inverse_pdf * material_at(material).albedo;
    return next;
}

/// Writes to the pending vertex how the path continues from a scattering surface.
fn record_onward(lobes: Lobes, factor: f32) {
    pending.weight = lobes.single * factor;
    pending.cosine = lobes.cosine;
    if (HAS_MULTIPLE_SCATTERING) {
        pending_multiple.weight = lobes.multiple * factor;
    }
    if (HAS_BASES) {
        pending_body.weight = lobes.body * factor;
        pending_body.wi_cosine = lobes.wi_cosine;
    }
}

/// Plays Russian roulette: ends the path at random, or increases the weight of the pending vertex.
fn russian_roulette(path: PathState, sample: Sample) -> PathState {
    let probability = rr_survival_probability(path.rr_throughput);
    var next = path;
    if (probability < 1.0) {
        next.alive = random_at(sample, path, FOR_ROULETTE).x < probability;
        next.rr_throughput /= probability;
        pending.weight /= probability;
        if (HAS_MULTIPLE_SCATTERING) {
            pending_multiple.weight /= probability;
        }
        if (HAS_BASES) {
            pending_body.weight /= probability;
        }
    }
    return next;
}
