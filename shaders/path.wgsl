// Tracing a path and recording it. Nothing here depends on wavelength.

/// Traces the path of one sample into the record and returns its wavelengths.
fn trace_path(sample: Sample) -> Wavelengths {
    begin_record();
    let first = numbers_of(sample, 0u);
    var walk = Walk(camera_ray(sample.pixel, first.xy), NONE, vec3f(0.0), 0.0, vec3f(0.0), 0.0, 1u, true);
    while (walk.alive) {
        let hit = nearest_hit(walk.ray, walk.from_object);
        if (hit.object == NONE) {
            if (HAS_ENVIRONMENT) {
                record_environment(walk, sample);
            }
            break;
        }
        walk = meet_surface(walk, sample, hit);
        walk.segment += 1u;
        walk.alive = walk.alive && walk.segment <= frame.max_path_segments;
    }
    return wavelengths_at(select(0.5, first.z, frame.draws_wavelengths == 1u));
}

/// The radiance of the surroundings, part by part.
fn record_environment(walk: Walk, sample: Sample) {
    for (var i = 0u; i < frame.environment_count; i++) {
        let part = frame.first_environment + i;
        let share = environment_share(part, walk.ray.direction);
        if (share > 0.0) {
            let material = objects[part].material;
            let weight = share * emission_share(walk, part);
            var texel = 0u;
            if (HAS_ENVIRONMENT_PICTURE && objects[part].shape == SHAPE_PICTURE) {
                texel = environment_texel(part, walk.ray.direction, random_at(sample, walk, 0u).w);
            }
            push_emission(materials[material].emission, texel, materials[material].emission_scale * weight);
        }
    }
}

/// Records what the surface adds and does, and sends the walk on.
fn meet_surface(walk: Walk, sample: Sample, hit: Hit) -> Walk {
    let material = objects[hit.object].material;
    let point = surface_point(hit.object, walk.ray, hit.distance);
    var vertex = plain_vertex();
    if (materials[material].emission_scale > 0.0) {
        vertex.emission = materials[material].emission;
        vertex.emission_weight = materials[material].emission_scale * emission_share(walk, hit.object);
    }
    if (materials[material].is_black == 1u) {
        push_vertex(vertex);
        var ended = walk;
        ended.alive = false;
        return ended;
    }
    let surface = materials[material].surface;
    if (HAS_DIFFUSE && surface == SURFACE_DIFFUSE) {
        vertex.scatter = diffuse_factor(hit.object, point.position, random_at(sample, walk, 1u).w);
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    let reflects = !HAS_FILMS || surface != SURFACE_FILM || random_at(sample, walk, 1u).x < REFLECTED_SHARE;
    vertex.scatter = layered_factor(hit.object, point, reflects);
    if ((HAS_COOK || HAS_BASES) && surface >= SURFACE_COOK_D1) {
        if (HAS_BASES) {
            let base = diffuse_factor(hit.object, point.position, random_at(sample, walk, 1u).w);
            vertex.base = base.spectrum;
            vertex.base_kind = base.kind;
        }
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    if (HAS_ROUGH_CONDUCTORS && surface == SURFACE_ROUGH_CONDUCTOR) {
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    return meet_smooth(walk, hit.object, point, vertex, reflects);
}

/// Weight of a light that a scattered path happens to meet: the rest is what connections to that light bring.
fn emission_share(walk: Walk, light: u32) -> f32 {
    if (!HAS_LIGHTS || walk.scatter_pdf <= 0.0 || objects[light].is_light == 0u) {
        return 1.0;
    }
    if (!MEETS_LIGHT || !SENDS_LIGHT) {
        return select(0.0, 1.0, MEETS_LIGHT);
    }
    let chosen = choice_probability(light, walk.scattered_at, walk.scattered_normal, walk.estimates);
    return mis_share(walk.scatter_pdf, chosen * light_pdf(light, walk.scattered_at, walk.ray.direction));
}

/// Share of the paths that follow the reflection of a film rather than its transmission. What is bright behind a film is
/// dimmed little, what is bright before it much; halves serve both. It steers noise only: the weight undoes it.
const REFLECTED_SHARE: f32 = 0.5;

/// A film or a smooth conductor: the path is mirrored or goes straight on.
fn meet_smooth(walk: Walk, object: u32, point: SurfacePoint, vertex_in: Vertex, reflects: bool) -> Walk {
    var vertex = vertex_in;
    var weight = 1.0;
    if (HAS_FILMS && vertex.scatter.kind >= FACTOR_FILM_REFLECTS) {
        weight = 1.0 / select(1.0 - REFLECTED_SHARE, REFLECTED_SHARE, reflects);
    }
    vertex.onward = single_lobe(weight, vertex.scatter.cosine);
    push_vertex(vertex);
    if (reflects) {
        return walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0, 0.0);
    }
    var through = walk;
    through.ray.origin = point.position;
    through.from_object = object;
    return through;
}

/// A diffuse or rough surface: light is sent to it, and the path is scattered.
fn meet_scattering(walk: Walk, sample: Sample, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    let scatterer = Scatterer(objects[object].material, vertex.scatter.kind);
    vertex.material = scatterer.material;
    let world_from_local = surface_frame(object, point);
    let eye = -walk.ray.direction * world_from_local;
    vertex.eye_cosine = eye.z;

    let sent = send_to_light(walk, sample, point);
    if (sent.pdf > 0.0) {
        vertex = connect(vertex, walk, object, point, sent, scattering(scatterer, eye, sent.direction * world_from_local));
    }

    let random = random_at(sample, walk, 1u);
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        let share = coat_share(scatterer.material, eye.z);
        if (random.z < share) {
            vertex.onward = single_lobe(1.0 / share, eye.z);
            push_vertex(vertex);
            return walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0, 0.0);
        }
    }
    let light = sample_scattering(scatterer, eye, random);
    let onward = scattering(scatterer, eye, light);
    var next = walk_on(walk, object, point, normalize(world_from_local * light), onward.pdf, sent.total);
    if (onward.pdf > 0.0) {
        vertex.onward = scaled(onward.lobes, 1.0 / onward.pdf);
    } else {
        next.alive = false;
    }
    push_vertex(vertex);
    return next;
}
