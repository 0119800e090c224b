// Emitters: bounded objects that emit, parts of the environment, and lights that are not objects.

/// Whether an emitter is a single point or direction, so that BSDF sampling never finds it.
fn is_delta(emitter: u32) -> bool {
    return HAS_DELTA_EMITTERS && emitter_at(emitter).kind >= EMITTER_DIRECTION;
}

/// Returns the row of the polarization of an emitter's light, or NONE.
fn emitter_polarization(emitter: u32) -> u32 {
    let record = emitter_at(emitter).record;
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(emitter).kind == EMITTER_PICTURE) {
        return load_panorama(record).polarization;
    }
    return record;
}

/// Whether an emitter is a part of the environment.
fn is_environment(emitter: u32) -> bool {
    return HAS_ENVIRONMENT && emitter_at(emitter).kind >= EMITTER_EVERYWHERE && emitter_at(emitter).kind < EMITTER_DIRECTION;
}

/// Samples a direction from `point` toward an emitter: uniform in the solid angle of a sphere (over all directions from inside it),
/// uniform over the area of a rectangle or disk.
fn emitter_sample(emitter: u32, point: vec3f, u: f32, v: f32) -> vec3f {
    if (is_environment(emitter)) {
        return sample_environment(emitter, vec2f(u, v));
    }
    let toward = emitter_at(emitter).position - point;
    if (is_delta(emitter)) {
        if (emitter_at(emitter).kind == EMITTER_DIRECTION) {
            return emitter_at(emitter).axis;
        }
        return normalize(toward);
    }
    if (HAS_SPHERE_EMITTERS && emitter_at(emitter).kind == EMITTER_SPHERE) {
        let distance2 = dot(toward, toward);
        if (sphere_surrounds(emitter, distance2)) {
            return sample_cone(u, v, 2.0);
        }
        let height = cone_height(emitter_at(emitter).radius, distance2);
        return normalize(frame_of(normalize(toward)) * sample_cone(u, v, height));
    }
    var place = vec2f(2.0 * u - 1.0, 2.0 * v - 1.0);
    if (HAS_DISK_EMITTERS && emitter_at(emitter).kind == EMITTER_DISK) {
        place = sqrt(u) * direction_of_turn(v);
    }
    let aside = place.x * emitter_at(emitter).half_width * emitter_at(emitter).tangent;
    let above = place.y * emitter_at(emitter).half_height * emitter_at(emitter).bitangent;
    return normalize(toward + aside + above);
}

/// Returns the density with which emitter_sample samples a direction that hits the emitter, sr⁻¹; 0 for light from a single direction.
fn emitter_pdf(emitter: u32, point: vec3f, direction: vec3f) -> f32 {
    if (is_environment(emitter)) {
        return environment_pdf(emitter, direction);
    }
    if (is_delta(emitter)) {
        return 0.0;
    }
    let toward = emitter_at(emitter).position - point;
    if (HAS_SPHERE_EMITTERS && emitter_at(emitter).kind == EMITTER_SPHERE) {
        let distance2 = dot(toward, toward);
        if (sphere_surrounds(emitter, distance2)) {
            return 0.25 / PI;
        }
        return 0.5 / (PI * cone_height(emitter_at(emitter).radius, distance2));
    }
    // dω = cos dA / distance², with cos = |height| / distance along the direction.
    let speed = abs(dot(direction, emitter_at(emitter).axis));
    let height = abs(dot(toward, emitter_at(emitter).axis));
    if (speed <= 0.0 || height <= 0.0) {
        return 0.0;
    }
    let distance = height / speed;
    return distance * distance / (speed * plane_area(emitter));
}

/// Returns the area of a rectangle or disk.
fn plane_area(emitter: u32) -> f32 {
    let round = HAS_DISK_EMITTERS && emitter_at(emitter).kind == EMITTER_DISK;
    return select(4.0, PI, round) * emitter_at(emitter).half_width * emitter_at(emitter).half_height;
}

/// Returns the factor of the emission toward `point`: for a part of the environment, its relative radiance; for a point or a spot,
/// the factor that makes an irradiance of its intensity.
fn emitter_strength(emitter: u32, point: vec3f, direction: vec3f) -> f32 {
    if (is_environment(emitter)) {
        return environment_strength(emitter, direction);
    }
    if (!is_delta(emitter) || emitter_at(emitter).kind == EMITTER_DIRECTION) {
        return 1.0;
    }
    let toward = emitter_at(emitter).position - point;
    let falloff = 1.0 / dot(toward, toward);
    if (emitter_at(emitter).kind == EMITTER_SPOT) {
        return falloff * spot_falloff(emitter, direction);
    }
    return falloff;
}

/// Returns a spot's intensity in a direction, relative to that on its axis: 1 within the inner cone, 0 outside the outer one, and
/// the cubic 3t² − 2t³ in the cosine in between (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, section
/// 12.2.3).
fn spot_falloff(emitter: u32, direction: vec3f) -> f32 {
    let full = emitter_at(emitter).full_height;
    let edge = emitter_at(emitter).edge_height;
    // 1 − cos in a form that keeps its digits where it is small.
    let off = direction + emitter_at(emitter).axis;
    let t = clamp((edge - 0.5 * dot(off, off)) / (edge - full), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Whether a point at this squared distance from the center is in or on the sphere.
fn sphere_surrounds(emitter: u32, distance2: f32) -> bool {
    let radius = emitter_at(emitter).radius;
    // A point on the surface has a rounding error; from just outside, the cone would be almost a hemisphere.
    return distance2 <= radius * radius * 1.00001;
}

/// Returns the largest cosine with a normal within a cone, whose axis has the cosine `axis` with the normal; `sine2` is the square
/// of the sine of the half angle.
fn most_cosine(axis: f32, sine2: f32) -> f32 {
    let cosine = sqrt(max(1.0 - sine2, 0.0));
    if (axis >= cosine) {
        return 1.0;
    }
    return max(axis * cosine + sqrt(max(1.0 - axis * axis, 0.0) * sine2), 0.0);
}

/// Returns roughly the luminance that an emitter gives a white surface; 0 only where no light can arrive.
fn emitter_weight(emitter: u32, point: vec3f, normal: vec3f) -> f32 {
    let brightness = emitter_at(emitter).brightness;
    if (is_environment(emitter)) {
        return brightness * environment_weight(emitter, normal);
    }
    if (is_delta(emitter)) {
        let direction = emitter_sample(emitter, point, 0.0, 0.0);
        return brightness * emitter_strength(emitter, point, direction) * max(dot(direction, normal), 0.0);
    }
    let toward = emitter_at(emitter).position - point;
    let distance2 = dot(toward, toward);
    if (HAS_SPHERE_EMITTERS && emitter_at(emitter).kind == EMITTER_SPHERE) {
        if (sphere_surrounds(emitter, distance2)) {
            return brightness * PI;
        }
        let radius = emitter_at(emitter).radius;
        let axis = dot(toward, normal) / sqrt(distance2);
        let solid_angle = 2.0 * PI * cone_height(radius, distance2);
        return brightness * solid_angle * most_cosine(axis, radius * radius / distance2);
    }
    return brightness * plane_weight(emitter, toward, distance2, normal);
}

/// Returns the solid angle of a rectangle or disk times the largest cosine, both from its bounding sphere.
fn plane_weight(emitter: u32, toward: vec3f, distance2: f32, normal: vec3f) -> f32 {
    let width = emitter_at(emitter).half_width;
    let height = emitter_at(emitter).half_height;
    let round = HAS_DISK_EMITTERS && emitter_at(emitter).kind == EMITTER_DISK;
    let reach2 = select(width * width + height * height, width * width, round);
    let area = plane_area(emitter);
    // Cosine at the emitter, at most as if it were turned by the angle that half of it subtends.
    let facing = abs(dot(toward, emitter_at(emitter).axis)) * sqrt(distance2) + reach2;
    let solid_angle = area * min(facing / max(distance2, 1e-20), 1.0) / (distance2 + area * (0.5 / PI));
    if (distance2 <= reach2) {
        return solid_angle;
    }
    return solid_angle * most_cosine(dot(toward, normal) / sqrt(distance2), reach2 / distance2);
}

/// Returns roughly the integral of the relative radiance of a part of the environment times the cosine, over directions.
fn environment_weight(emitter: u32, normal: vec3f) -> f32 {
    if (emitter_at(emitter).kind == EMITTER_DISTANT_DISK) {
        let height = emitter_at(emitter).edge_height;
        return 2.0 * PI * height * most_cosine(dot(emitter_at(emitter).axis, normal), height * (2.0 - height));
    }
    if (emitter_at(emitter).kind == EMITTER_POLE) {
        return (PI / 3.0) * max(1.0 + dot(emitter_at(emitter).axis, normal), 0.0);
    }
    return select(PI, 0.5 * PI, emitter_at(emitter).kind == EMITTER_HORIZON);
}
