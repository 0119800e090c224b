// Directions and points sampled from uniform numbers.

/// Returns a right-handed orthonormal frame whose third column is `normal`, a unit vector (Duff et al., Building an Orthonormal
/// Basis, Revisited, JCGT 6(1), 2017).
fn frame_of(normal: vec3f) -> mat3x3f {
    let side = select(-1.0, 1.0, normal.z >= 0.0);
    let a = -1.0 / (side + normal.z);
    let b = normal.x * normal.y * a;
    return mat3x3f(
        vec3f(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x),
        vec3f(b, side + normal.y * normal.y * a, -normal.y),
        normal,
    );
}

/// Samples a direction about +z with density cos θ / π.
fn sample_cosine_hemisphere(u: f32, v: f32) -> vec3f {
    return vec3f(sqrt(u) * direction_of_turn(v), sqrt(1.0 - u));
}

/// Samples a direction about +z, uniform in the cone whose half angle has 1 − cos = `height` (0 < height ≤ 2).
fn sample_cone(u: f32, v: f32, height: f32) -> vec3f {
    let drop = u * height; // 1 − cos θ
    return vec3f(sqrt(drop * (2.0 - drop)) * direction_of_turn(v), 1.0 - drop);
}

/// Returns 1 − cos of the half angle that a sphere subtends at a point outside; `distance2` is the squared distance of its center.
fn cone_height(radius: f32, distance2: f32) -> f32 {
    let sin2 = min(radius * radius / distance2, 1.0);
    return sin2 / (1.0 + sqrt(1.0 - sin2));
}
