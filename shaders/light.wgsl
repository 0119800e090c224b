// What light is sent from: emitting objects with bounds, what surrounds the scene, and lights that are no objects.

/// Whether light comes from a single point or direction, so that no scattered ray ever meets it.
fn is_single_direction(light: u32) -> bool {
    return HAS_DELTA_LIGHTS && emitter_at(light).kind >= EMITTER_DIRECTION;
}

/// Whether a light is a part of what surrounds the scene.
fn is_surrounding(light: u32) -> bool {
    return HAS_ENVIRONMENT && emitter_at(light).kind >= EMITTER_EVERYWHERE && emitter_at(light).kind < EMITTER_DIRECTION;
}

/// A direction from `point` toward a light: uniform in the solid angle of a sphere (over all
/// directions from inside it), uniform over the area of a rectangle or disk.
fn sample_light(light: u32, point: vec3f, u: f32, v: f32) -> vec3f {
    if (is_surrounding(light)) {
        return sample_environment(light, vec2f(u, v));
    }
    let toward = emitter_at(light).position - point;
    if (is_single_direction(light)) {
        if (emitter_at(light).kind == EMITTER_DIRECTION) {
            return emitter_at(light).axis;
        }
        return normalize(toward);
    }
    if (HAS_SPHERE_LIGHTS && emitter_at(light).kind == EMITTER_SPHERE) {
        let distance2 = dot(toward, toward);
        if (sphere_surrounds(light, distance2)) {
            return sample_cone(u, v, 2.0);
        }
        let height = cone_height(emitter_at(light).radius, distance2);
        return normalize(frame_of(normalize(toward)) * sample_cone(u, v, height));
    }
    var place = vec2f(2.0 * u - 1.0, 2.0 * v - 1.0);
    if (HAS_DISK_LIGHTS && emitter_at(light).kind == EMITTER_DISK) {
        place = sqrt(u) * direction_of_turn(v);
    }
    let aside = place.x * emitter_at(light).half_width * emitter_at(light).tangent;
    let above = place.y * emitter_at(light).half_height * emitter_at(light).bitangent;
    return normalize(toward + aside + above);
}

/// Density with which sample_light draws a direction that hits the light, sr⁻¹; 0 for light from a single direction.
fn light_pdf(light: u32, point: vec3f, direction: vec3f) -> f32 {
    if (is_surrounding(light)) {
        return environment_pdf(light, direction);
    }
    if (is_single_direction(light)) {
        return 0.0;
    }
    let toward = emitter_at(light).position - point;
    if (HAS_SPHERE_LIGHTS && emitter_at(light).kind == EMITTER_SPHERE) {
        let distance2 = dot(toward, toward);
        if (sphere_surrounds(light, distance2)) {
            return 0.25 / PI;
        }
        return 0.5 / (PI * cone_height(emitter_at(light).radius, distance2));
    }
    // dω = cos dA / distance², with cos = |height| / distance along the direction.
    let speed = abs(dot(direction, emitter_at(light).axis));
    let height = abs(dot(toward, emitter_at(light).axis));
    if (speed <= 0.0 || height <= 0.0) {
        return 0.0;
    }
    let distance = height / speed;
    return distance * distance / (speed * plane_area(light));
}

/// The area of a rectangle or disk.
fn plane_area(light: u32) -> f32 {
    let round = HAS_DISK_LIGHTS && emitter_at(light).kind == EMITTER_DISK;
    return select(4.0, PI, round) * emitter_at(light).half_width * emitter_at(light).half_height;
}

/// Factor of a light's emission toward `point`: the share of a part of the surroundings; of a point and of a spot what makes their
/// intensity an irradiance.
fn light_share(light: u32, point: vec3f, direction: vec3f) -> f32 {
    if (is_surrounding(light)) {
        return environment_share(light, direction);
    }
    if (!is_single_direction(light) || emitter_at(light).kind == EMITTER_DIRECTION) {
        return 1.0;
    }
    let toward = emitter_at(light).position - point;
    let falloff = 1.0 / dot(toward, toward);
    if (emitter_at(light).kind == EMITTER_SPOT) {
        return falloff * spot_share(light, direction);
    }
    return falloff;
}

/// A spot's intensity against a direction, relative to that on its axis: 1 within the inner cone, 0 outside the outer one, between
/// them the cubic 3t² − 2t³ in the cosine (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, section 12.2.3).
fn spot_share(light: u32, direction: vec3f) -> f32 {
    let full = emitter_at(light).full_height;
    let edge = emitter_at(light).edge_height;
    // 1 − cos in a form that keeps its digits where it is small.
    let off = direction + emitter_at(light).axis;
    let t = clamp((edge - 0.5 * dot(off, off)) / (edge - full), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Whether a point at this squared distance from the center lies in or on the sphere.
fn sphere_surrounds(light: u32, distance2: f32) -> bool {
    let radius = emitter_at(light).radius;
    // A point on the surface was put there with rounding; from just outside the cone would be all but a hemisphere.
    return distance2 <= radius * radius * 1.00001;
}
