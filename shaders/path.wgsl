// Tracing a path and recording it. Nothing here depends on wavelength.

/// Traces the path of one sample into the record and returns its wavelengths.
fn trace_path(sample: Sample) -> Wavelengths {
    begin_record();
    let first = random4(sample.pixel, sample.index, 0u, frame.seed);
    var walk = Walk(camera_ray(sample.pixel, first.xy), NONE, vec3f(0.0), 0.0, 1u, true);
    while (walk.alive) {
        let hit = nearest_hit(walk.ray, walk.from_object);
        if (hit.object == NONE) {
            if (HAS_ENVIRONMENT) {
                record_environment(walk.ray.direction);
            }
            break;
        }
        walk = meet_surface(walk, sample, hit);
        walk.segment += 1u;
        walk.alive = walk.alive && walk.segment <= frame.max_path_segments;
    }
    return wavelengths_at(select(0.5, first.z, frame.draws_wavelengths == 1u));
}

/// The radiance of the surroundings: zenith, horizon and ground, linear in the height of the direction.
fn record_environment(direction: vec3f) {
    let height = clamp(direction.y, -1.0, 1.0);
    let level = 1.0 - abs(height);
    let upper = height >= 0.0;
    let away = select(frame.ground, frame.zenith, upper);
    let away_scale = select(frame.ground_scale, frame.zenith_scale, upper);
    if (away == frame.horizon && away_scale == frame.horizon_scale) {
        push_emission(away, away_scale); // the same from everywhere
        return;
    }
    push_emission(frame.horizon, frame.horizon_scale * level);
    push_emission(away, away_scale * abs(height));
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
    if (HAS_FILMS && surface == SURFACE_FILM) {
        return meet_film(walk, sample, hit.object, point, vertex);
    }
    if (HAS_MIRRORS && surface == SURFACE_MIRROR) {
        return meet_mirror(walk, hit.object, point, vertex);
    }
    if (HAS_ROUGH_CONDUCTORS && surface == SURFACE_ROUGH_CONDUCTOR) {
        return meet_rough_conductor(walk, sample, hit.object, point, vertex);
    }
    if (HAS_DIFFUSE) {
        return meet_diffuse(walk, sample, hit.object, point, vertex);
    }
    return walk;
}

/// Weight of an emitter that a scattered path happens to hit, by the balance heuristic (Veach 1997, equation 9.8):
/// the rest is what connections to that light bring.
fn emission_share(walk: Walk, object: u32) -> f32 {
    let has_lights = HAS_SPHERE_LIGHTS || HAS_RECTANGLE_LIGHTS;
    if (!has_lights || walk.scatter_pdf <= 0.0 || objects[object].is_light == 0u) {
        return 1.0;
    }
    let sent = light_pdf(object, walk.scattered_at, walk.ray.direction) / f32(frame.light_count);
    return walk.scatter_pdf / (walk.scatter_pdf + sent);
}

/// Share of the paths that follow the reflection of a film rather than its transmission. What is bright behind a film is
/// dimmed little, what is bright before it much; halves serve both. It steers noise only: the weight undoes it.
const REFLECTED_SHARE: f32 = 0.5;

fn meet_film(walk: Walk, sample: Sample, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    let reflects = random_at(sample, walk, 1u).x < REFLECTED_SHARE;
    vertex.scatter = film_factor(object, point, reflects);
    vertex.weight = 1.0 / select(1.0 - REFLECTED_SHARE, REFLECTED_SHARE, reflects);
    push_vertex(vertex);
    if (reflects) {
        return walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0);
    }
    var through = walk;
    through.ray.origin = point.position;
    through.from_object = object;
    return through;
}

fn meet_mirror(walk: Walk, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    let spectrum = materials[objects[object].material].spectrum;
    vertex.scatter = Factor(FACTOR_CONDUCTOR, spectrum, point.cosine, 0.0);
    vertex.weight = 1.0;
    push_vertex(vertex);
    return walk_on(walk, object, point, mirrored(walk.ray.direction, point.normal), 0.0);
}

fn meet_rough_conductor(walk: Walk, sample: Sample, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    let material = objects[object].material;
    let slope = materials[material].roughness;
    let world_from_local = frame_of(point.normal);
    let eye = -walk.ray.direction * world_from_local;

    let sent = send_to_light(walk, sample, point);
    if (sent.pdf > 0.0) {
        let facet = cook_torrance(eye, sent.direction * world_from_local, slope);
        let cosine = dot(sent.direction, point.normal);
        vertex = connect(vertex, walk, object, point, sent, facet.reflection * cosine, facet.pdf);
        vertex.connection_cosine = facet.cosine;
    }

    let random = random_at(sample, walk, 1u);
    let normal = sample_beckmann(random.x, random.y, slope);
    let light = reflect(-eye, normal);
    let facet = cook_torrance(eye, normalize(light), slope);
    vertex.scatter = Factor(FACTOR_CONDUCTOR, materials[material].spectrum, facet.cosine, 0.0);
    var next = walk_on(walk, object, point, normalize(world_from_local * light), facet.pdf);
    if (facet.pdf > 0.0) {
        vertex.weight = facet.reflection * light.z / facet.pdf;
    } else {
        next.alive = false;
    }
    push_vertex(vertex);
    return next;
}

fn meet_diffuse(walk: Walk, sample: Sample, object: u32, point: SurfacePoint, vertex_in: Vertex) -> Walk {
    var vertex = vertex_in;
    let spectrum = reflectance_spectrum(objects[object].material, object, point.position);
    vertex.scatter = Factor(FACTOR_REFLECTANCE, spectrum, 1.0, 0.0);
    vertex.weight = 1.0;

    let sent = send_to_light(walk, sample, point);
    if (sent.pdf > 0.0) {
        let lambert = max(dot(sent.direction, point.normal), 0.0) / PI;
        vertex = connect(vertex, walk, object, point, sent, lambert, lambert);
    }

    let random = random_at(sample, walk, 1u);
    let local = sample_cosine_hemisphere(random.x, random.y);
    push_vertex(vertex);
    return walk_on(walk, object, point, normalize(frame_of(point.normal) * local), local.z / PI);
}
