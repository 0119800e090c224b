// Intersections of rays with analytic shapes. A distance below 0 means that the ray misses.
//
// For a ray that starts on a surface (`from_surface`), the root at its start is left out exactly, so that no offset is needed.

/// Returns the distance to a sphere around the origin.
///
/// `from_surface`: the ray starts on this sphere. The discriminant is computed from the ray's distance to the center, and the roots
/// from the one that does not cancel (Haines et al., Ray Tracing Gems, chapter 7, 2019).
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

/// Returns the distance to a sphere through the origin with this unit normal there, for a center so far away that a distance from
/// it has no digits left.
///
/// `from_surface`: the ray starts on this sphere. A point p of the sphere satisfies p·n + |p|² curvature/2 = 0; the root of the
/// quadratic that does not cancel gives the other (Press et al., Numerical Recipes, equation 5.6.4).
fn intersect_large_sphere(origin: vec3f, direction: vec3f, normal: vec3f, curvature: f32, from_surface: bool) -> f32 {
    let slope = dot(direction, normal) + curvature * dot(direction, origin);
    if (from_surface) {
        return select(-1.0, -2.0 * slope / curvature, slope < 0.0);
    }
    let height = 2.0 * dot(origin, normal) + curvature * dot(origin, origin);
    let discriminant = slope * slope - curvature * height;
    if (discriminant < 0.0) {
        return -1.0;
    }
    let steep = abs(slope) + sqrt(discriminant);
    let near = height / steep;
    let far = steep / curvature;
    if (slope < 0.0) {
        return select(far, near, near > 0.0);
    }
    // The ray moves outward: from inside it meets the near surface, from outside nothing.
    return -near;
}

/// Returns the distance to a plane through the origin. A ray that starts on it or is parallel to it misses.
fn intersect_plane(origin: vec3f, direction: vec3f, normal: vec3f) -> f32 {
    let speed = dot(direction, normal);
    let height = dot(origin, normal);
    if (height * speed >= 0.0) {
        return -1.0;
    }
    return -height / speed;
}
