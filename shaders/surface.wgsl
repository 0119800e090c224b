// Geometry of a surface at a point.

/// The point that a ray hits and the unit normal there, on the ray's side.
struct SurfacePoint {
    position: vec3f,
    normal: vec3f,
    /// Cosine between the ray and the normal, ≥ 0.
    cosine: f32,
    /// Whether the ray comes from the side of the shape's own normal: the outside of a sphere.
    is_front: bool,
}

fn surface_point(index: u32, ray: Ray, distance: f32) -> SurfacePoint {
    let center = shape_at(index).center;
    var position = ray.origin + distance * ray.direction;
    var normal = shape_at(index).normal;
    if (HAS_SPHERES && shape_at(index).kind == SHAPE_SPHERE) {
        // Put back onto the sphere, so that rounding of the distance does not accumulate along a path.
        if (HAS_LARGE_SPHERES && shape_at(index).curvature > 0.0) {
            let place = position - shape_at(index).nearest;
            let height = dot(place, normal) + 0.5 * shape_at(index).curvature * dot(place, place);
            normal = normalize(normal + shape_at(index).curvature * place);
            position -= height * normal;
        } else {
            normal = normalize(position - center);
            position = center + shape_at(index).radius * normal;
        }
    }
    let cosine = dot(normal, ray.direction);
    return SurfacePoint(position, select(normal, -normal, cosine > 0.0), abs(cosine), cosine <= 0.0);
}

/// Returns the frame of a surface at a point. The third column is the normal on the ray's side; where the surface is brushed, the
/// first column runs along the grain.
fn surface_frame(object: u32, point: SurfacePoint) -> mat3x3f {
    let row = material_at(shape_at(object).material).facets;
    if (!HAS_GRAIN || row == NONE) {
        return frame_of(point.normal);
    }
    let facets = load_facets(row);
    if (facets.grain_kind == GRAIN_NONE) {
        return frame_of(point.normal);
    }
    var grain = facets.grain;
    if (facets.grain_kind == GRAIN_AROUND) {
        grain = cross(grain, point.position - shape_at(object).center);
    }
    let along = grain - dot(grain, point.normal) * point.normal;
    let length2 = dot(along, along);
    if (length2 <= 1e-10 * dot(grain, grain)) {
        return frame_of(point.normal); // the grain runs into the surface, or the point lies on the axis
    }
    let tangent = along * inverseSqrt(length2);
    return mat3x3f(tangent, cross(point.normal, tangent), point.normal);
}
