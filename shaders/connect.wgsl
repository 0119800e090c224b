// Sending light from a source straight to a surface, through the free films in between.

struct Sent {
    light: u32,
    direction: vec3f,
    /// Density of the direction, the choice among the lights included; 0 where nothing can arrive.
    pdf: f32,
}

/// Chooses a light and a direction towards it.
fn send_to_light(walk: Walk, sample: Sample, point: SurfacePoint) -> Sent {
    let has_lights = HAS_SPHERE_LIGHTS || HAS_RECTANGLE_LIGHTS;
    if (!has_lights || walk.segment + 1u > frame.max_path_segments) {
        return Sent(NONE, point.normal, 0.0);
    }
    let random = random_at(sample, walk, FOR_LIGHT);
    let count = f32(frame.light_count);
    let light = objects[min(u32(random.x * count), frame.light_count - 1u)].light;
    let direction = sample_light(light, point.position, random.y, random.z);
    if (dot(direction, point.normal) <= 0.0) {
        return Sent(light, direction, 0.0);
    }
    return Sent(light, direction, light_pdf(light, point.position, direction) / count);
}

/// Adds to the vertex what arrives from the light. Balance heuristic: value / pdf × pdf / (pdf + pdf of the scattering).
fn connect(
    vertex_in: Vertex,
    walk: Walk,
    object: u32,
    point: SurfacePoint,
    sent: Sent,
    towards: Scattering,
) -> Vertex {
    var vertex = vertex_in;
    if (!is_lit(towards.lobes)) {
        return vertex;
    }
    vertex.first_crossing = crossing_count;
    let first_thickness = thickness_count;
    let allowed = frame.max_path_segments - walk.segment - 1u;
    if (!arrives(Ray(point.position, sent.direction), object, sent.light, allowed)) {
        crossing_count = vertex.first_crossing;
        thickness_count = first_thickness;
        return vertex;
    }
    vertex.end_crossing = crossing_count;
    let material = objects[sent.light].material;
    vertex.connection = materials[material].emission;
    vertex.connected = scaled(towards.lobes, materials[material].emission_scale / (sent.pdf + towards.pdf));
    return vertex;
}

/// Follows a ray to a light, recording the films that it crosses; false where something opaque is in the way
/// or more films than `allowed`.
fn arrives(ray_in: Ray, from_object: u32, light: u32, allowed: u32) -> bool {
    var ray = ray_in;
    var from_now = from_object;
    for (var crossed = 0u; crossed <= allowed; crossed++) {
        let hit = nearest_hit(ray, from_now);
        if (hit.object == light) {
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
