// Rays against analytic shapes. A distance below 0 means that the ray misses.
//
// A ray that starts on a surface says so: the root at its start is then left out exactly, so that no offset is needed.

/// Distance to a sphere around the origin.
///
/// `from_surface`: the ray starts on this sphere. The discriminant is taken from the ray's distance to the
/// centre, and roots by the one that does not cancel (Haines et al., Ray Tracing Gems, chapter 7, 2019).
fn intersect_sphere(origin: vec3f, direction: vec3f, radius: f32, from_surface: bool) -> f32 {
    let along = dot(origin, direction);
    if (from_surface) {
        return select(-1.0, -2.0 * along, along < 0.0);
    }
    let off_axis = origin - along * direction;
    let discriminant = radius * radius - dot(off_axis, off_axis);
    if (discriminant < 0.0) {
        return -1.0;
    }
    let root = sqrt(discriminant);
    let outside = (length(origin) - radius) * (length(origin) + radius);
    if (outside > 0.0) {
        return select(-1.0, outside / (root - along), along < 0.0);
    }
    return select(root - along, -outside / (along + root), along > 0.0);
}

/// Distance to a plane through the origin. A ray that starts on it or runs along it misses.
fn intersect_plane(origin: vec3f, direction: vec3f, normal: vec3f) -> f32 {
    let speed = dot(direction, normal);
    let height = dot(origin, normal);
    if (height * speed >= 0.0) {
        return -1.0;
    }
    return -height / speed;
}
