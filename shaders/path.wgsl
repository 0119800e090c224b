// Tracing a path and recording it. Nothing here depends on wavelength.

/// Traces the path of one sample into the record and returns its wavelengths. Where films split it, one way is followed to its
/// end, and then the other.
fn trace_path(sample: Sample) -> Wavelengths {
    begin_record();
    waiting_count = 0u;
    let first = numbers_of(sample, 0u);
    var walk = Walk(first_ray(sample, first.xy), NONE, vec3f(0.0), 0.0, vec3f(0.0), 0.0, 1u, true, frame.film_splits, 0u, 1.0);
    while (walk.alive) {
        walk = advance(walk, sample);
        if (HAS_SPLITS && !walk.alive && waiting_count > 0u) {
            waiting_count -= 1u;
            walk = waiting_walks[waiting_count];
            push_return(waiting_count);
        }
    }
    return wavelengths_at(select(0.5, first.z, frame.draws_wavelengths == 1u));
}

/// The dimension of the camera's lens: beyond those of all branches.
const LENS_DIMENSION: u32 = 0xffffu;

/// The ray that a sample starts with.
fn first_ray(sample: Sample, jitter: vec2f) -> Ray {
    if (HAS_LENS) {
        return camera_ray(sample.pixel, jitter, numbers_of(sample, LENS_DIMENSION).xy);
    }
    return camera_ray(sample.pixel, jitter, vec2f(0.0));
}

/// Follows the walk to the next surface, and sends it on from there.
fn advance(walk: Walk, sample: Sample) -> Walk {
    let hit = nearest_hit(walk.ray, walk.from_object);
    var next = walk;
    if (hit.object == NONE) {
        if (HAS_ENVIRONMENT) {
            record_environment(walk, sample);
        }
        next.alive = false;
        return next;
    }
    next = meet_surface(walk, sample, hit);
    next.alive = next.alive && walk.segment < MAX_PATH_SEGMENTS;
    if (HAS_ROULETTE && next.alive && walk.segment >= ROULETTE_AFTER) {
        next = play_roulette(next, sample);
    }
    next.segment += 1u;
    return next;
}

/// The radiance of the surroundings, part by part.
fn record_environment(walk: Walk, sample: Sample) {
    for (var i = 0u; i < ENVIRONMENT_COUNT; i++) {
        let part = frame.first_environment + i;
        let share = environment_share(part, walk.ray.direction);
        if (share > 0.0) {
            let material = objects[part].material;
            let weight = share * emission_share(walk, part);
            var texel = 0u;
            if (HAS_ENVIRONMENT_PICTURE && objects[part].shape == SHAPE_PICTURE) {
                texel = environment_texel(part, walk.ray.direction, random_at(sample, walk, FOR_LIGHT).w);
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
        vertex.scatter = diffuse_factor(hit.object, point.position, random_at(sample, walk, FOR_SCATTERING).w);
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    if (HAS_FILMS && surface == SURFACE_FILM) {
        return meet_film(walk, sample, hit.object, point, vertex);
    }
    vertex.scatter = layered_factor(hit.object, point, true);
    if ((HAS_COOK || HAS_BASES) && surface >= SURFACE_COOK_D1) {
        if (HAS_BASES) {
            let base = diffuse_factor(hit.object, point.position, random_at(sample, walk, FOR_SCATTERING).w);
            vertex.base = base.spectrum;
            vertex.base_kind = base.kind;
        }
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    if (HAS_ROUGH_CONDUCTORS && surface == SURFACE_ROUGH_CONDUCTOR) {
        return meet_scattering(walk, sample, hit.object, point, vertex);
    }
    return meet_mirror(walk, hit.object, point, vertex);
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
    let density = light_pdf(light, walk.scattered_at, walk.ray.direction);
    return 1.0 - sending_share(light, walk.scatter_pdf, chosen, density);
}

/// A smooth conductor: the path is mirrored.
fn meet_mirror(walk: Walk, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    vertex.onward = single_lobe(1.0, vertex.scatter.cosine);
    push_vertex(vertex);
    var next = walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0, 0.0);
    next.throughput *= materials[objects[object].material].albedo;
    return next;
}

/// A film: the path is mirrored or goes straight on, or does both.
fn meet_film(walk: Walk, sample: Sample, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    let material = objects[object].material;
    let reflected = reflected_part(material, point.cosine);
    var vertex = vertex_in;
    var mirror = walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0, 0.0);
    var through = walk_through(walk, object, point);
    mirror.throughput *= materials[material].albedo * reflected;
    through.throughput *= materials[material].albedo * (1.0 - reflected);
    if (HAS_SPLITS && walk.splits > 0u && walk.segment < MAX_PATH_SEGMENTS) {
        vertex.scatter = layered_factor(object, point, true);
        vertex.onward = single_lobe(1.0, vertex.scatter.cosine);
        mirror.splits -= 1u;
        through.splits -= 1u;
        through.branch += 1u << through.splits;
        through.segment += 1u;
        vertex.waiting = wait(through);
        push_vertex(vertex);
        return mirror;
    }
    let share = reflected_share(reflected);
    let reflects = random_at(sample, walk, FOR_SCATTERING).x < share;
    let chance = select(1.0 - share, share, reflects);
    vertex.scatter = layered_factor(object, point, reflects);
    vertex.onward = single_lobe(1.0 / chance, vertex.scatter.cosine);
    push_vertex(vertex);
    if (reflects) {
        mirror.throughput /= chance;
        return mirror;
    }
    through.throughput /= chance;
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
    if (sent.probability * sent.density > 0.0) {
        vertex = connect(vertex, walk, object, point, sent, scattering(scatterer, eye, sent.direction * world_from_local));
    }

    let random = random_at(sample, walk, FOR_SCATTERING);
    if (HAS_COATED_BODIES && materials[scatterer.material].surface == SURFACE_COATED_BODY) {
        let share = coat_share(scatterer.material, eye.z);
        if (random.z < share) {
            vertex.onward = single_lobe(1.0 / share, eye.z);
            push_vertex(vertex);
            var mirror = walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0, 0.0);
            mirror.throughput *= materials[scatterer.material].albedo;
            return mirror;
        }
    }
    let light = sample_scattering(scatterer, eye, random);
    let onward = scattering(scatterer, eye, light);
    var next = walk_on(walk, object, point, normalize(world_from_local * light), onward.pdf, sent.total);
    next.splits = 0u;
    if (onward.pdf > 0.0) {
        vertex.onward = scaled(onward.lobes, 1.0 / onward.pdf);
        next.throughput *= weight_of(vertex.onward) * materials[scatterer.material].albedo;
    } else {
        next.alive = false;
    }
    push_vertex(vertex);
    return next;
}
