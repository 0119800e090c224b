// What a scene's surface is at a point.

/// The point that a ray hits and the unit normal there, on the ray's side.
struct SurfacePoint {
    position: vec3f,
    normal: vec3f,
    /// Cosine between the ray and the normal, ≥ 0.
    cosine: f32,
    /// Whether the ray comes from the side that the shape's own normal points to: a sphere's outside.
    is_front: bool,
}

fn surface_point(index: u32, ray: Ray, distance: f32) -> SurfacePoint {
    let center = objects[index].center;
    var position = ray.origin + distance * ray.direction;
    var normal = objects[index].normal;
    if (HAS_SPHERES && objects[index].shape == SHAPE_SPHERE) {
        // Put back onto the sphere: what the distance lost does not add up along a path.
        normal = normalize(position - center);
        position = center + objects[index].radius * normal;
    }
    let cosine = dot(normal, ray.direction);
    return SurfacePoint(position, select(normal, -normal, cosine > 0.0), abs(cosine), cosine <= 0.0);
}

/// The frame of a surface at a point, its third column the normal on the ray's side: where the surface is brushed the first runs
/// along the grain.
fn surface_frame(object: u32, point: SurfacePoint) -> mat3x3f {
    let material = objects[object].material;
    if (!HAS_GRAIN || materials[material].grain_kind == GRAIN_NONE) {
        return frame_of(point.normal);
    }
    var grain = materials[material].grain;
    if (materials[material].grain_kind == GRAIN_AROUND) {
        grain = cross(grain, point.position - objects[object].center);
    }
    let along = grain - dot(grain, point.normal) * point.normal;
    let length2 = dot(along, along);
    if (length2 <= 1e-10 * dot(grain, grain)) {
        return frame_of(point.normal); // the grain runs into the surface, or the point lies on the axis
    }
    let tangent = along * inverseSqrt(length2);
    return mat3x3f(tangent, cross(point.normal, tangent), point.normal);
}

/// Spectrum of a diffuse reflectance at a point: one of the two of a checker, or the only one.
fn reflectance_spectrum(material: u32, index: u32, position: vec3f) -> u32 {
    let even = materials[material].spectrum;
    let odd = materials[material].odd_spectrum;
    if (!HAS_CHECKERS || even == odd) {
        return even;
    }
    let local = (position - objects[index].center) / materials[material].checker_size;
    var squares = floor(local);
    if (objects[index].shape != SHAPE_SPHERE) {
        let axes = vec2f(dot(local, objects[index].tangent), dot(local, objects[index].bitangent));
        squares = vec3f(floor(axes), 0.0);
    }
    let half = 0.5 * (squares.x + squares.y + squares.z);
    return select(odd, even, half == floor(half));
}
