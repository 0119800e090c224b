// Sending light from a source straight to a surface, through the free films in between.

struct Sent {
    light: u32,
    direction: vec3f,
    /// Probability of the choice among the lights; 0 where nothing can arrive.
    probability: f32,
    /// Density of the direction, 1 where light comes from a single one.
    density: f32,
    /// The sum of all lights' estimates.
    total: f32,
    /// The texel of the light's picture, 0 where it has none.
    texel: u32,
}

/// Chooses a light and a direction towards it.
fn send_to_light(walk: Walk, sample: Sample, point: SurfacePoint) -> Sent {
    if (!HAS_LIGHTS || walk.segment + 1u > MAX_PATH_SEGMENTS) {
        return Sent(NONE, point.normal, 0.0, 0.0, 0.0, 0u);
    }
    let random = random_at(sample, walk, FOR_LIGHT);
    let choice = choose_light(point.position, point.normal, random.x);
    if (choice.light == NONE) {
        return Sent(NONE, point.normal, 0.0, 0.0, choice.total, 0u);
    }
    let direction = sample_light(choice.light, point.position, random.y, random.z);
    if (!SENDS_LIGHT || dot(direction, point.normal) <= 0.0) {
        return Sent(choice.light, direction, 0.0, 0.0, choice.total, 0u);
    }
    var density = 1.0;
    if (!is_single_direction(choice.light)) {
        density = light_pdf(choice.light, point.position, direction);
    }
    var texel = 0u;
    if (HAS_ENVIRONMENT_PICTURE && objects[choice.light].shape == SHAPE_PICTURE) {
        texel = environment_texel(choice.light, direction, random.w);
    }
    return Sent(choice.light, direction, choice.probability, density, choice.total, texel);
}

/// Adds to the vertex what arrives from the light, by its share.
fn connect(
    vertex_in: Vertex,
    walk: Walk,
    object: u32,
    point: SurfacePoint,
    sent: Sent,
    towards: Scattering,
) -> Vertex {
    var vertex = vertex_in;
    let strength = light_share(sent.light, point.position, sent.direction);
    if (!is_lit(towards.lobes) || strength <= 0.0) {
        return vertex;
    }
    vertex.first_crossing = crossing_count;
    let first_thickness = thickness_count;
    let allowed = MAX_PATH_SEGMENTS - walk.segment - 1u;
    if (!arrives(Ray(point.position, sent.direction), object, sent.light, allowed)) {
        crossing_count = vertex.first_crossing;
        thickness_count = first_thickness;
        return vertex;
    }
    vertex.end_crossing = crossing_count;
    var share = 1.0;
    if (MEETS_LIGHT && !is_single_direction(sent.light)) {
        share = sending_share(sent.light, towards.pdf, sent.probability, sent.density);
    }
    let material = objects[sent.light].material;
    vertex.connection = materials[material].emission;
    vertex.connection_texel = sent.texel;
    vertex.connected = scaled(towards.lobes, share * strength * materials[material].emission_scale / (sent.probability * sent.density));
    return vertex;
}

/// Follows a ray to a light, recording the films that it crosses; false where something opaque is in the way
/// or more films than `allowed`.
fn arrives(ray_in: Ray, from_object: u32, light: u32, allowed: u32) -> bool {
    var ray = ray_in;
    var from_now = from_object;
    for (var crossed = 0u; crossed <= allowed; crossed++) {
        let hit = nearest_hit(ray, from_now);
        if (hit.object == light || is_before(ray, light, hit)) {
            return true;
        }
        if (hit.object == NONE || crossed == allowed) {
            return false;
        }
        let material = objects[hit.object].material;
        if (!HAS_FILMS || materials[material].surface != SURFACE_FILM) {
            return false;
        }
        let point = surface_point(hit.object, ray, hit.distance);
        push_crossing(layered_factor(hit.object, point, false));
        ray.origin = point.position;
        from_now = hit.object;
    }
    return false;
}

/// Whether a light that is no object lies before what the ray hits.
fn is_before(ray: Ray, light: u32, hit: Hit) -> bool {
    if (light < OBJECT_COUNT) {
        return false;
    }
    if (HAS_DELTA_LIGHTS && objects[light].shape >= SHAPE_POINT) {
        // A lamp may lie on a surface: what is hit just before it, within rounding, does not hide it.
        return hit.object == NONE || hit.distance >= 0.99999 * length(objects[light].center - ray.origin);
    }
    return hit.object == NONE;
}
