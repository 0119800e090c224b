// Light sources that directions are drawn towards: emitting spheres and rectangles.

/// A direction from `point` towards a light: uniform in the solid angle of a sphere (over all
/// directions from inside it), uniform over the area of a rectangle.
fn sample_light(light: u32, point: vec3f, u: f32, v: f32) -> vec3f {
    let towards = objects[light].center - point;
    if (HAS_SPHERE_LIGHTS && objects[light].shape == SHAPE_SPHERE) {
        let distance2 = dot(towards, towards);
        if (sphere_surrounds(light, distance2)) {
            return sample_cone(u, v, 2.0);
        }
        let height = cone_height(objects[light].radius, distance2);
        return normalize(frame_of(normalize(towards)) * sample_cone(u, v, height));
    }
    let aside = (2.0 * u - 1.0) * objects[light].half_width * objects[light].tangent;
    let above = (2.0 * v - 1.0) * objects[light].half_height * objects[light].bitangent;
    return normalize(towards + aside + above);
}

/// Density with which sample_light draws a direction that hits the light, sr⁻¹.
fn light_pdf(light: u32, point: vec3f, direction: vec3f) -> f32 {
    let towards = objects[light].center - point;
    if (HAS_SPHERE_LIGHTS && objects[light].shape == SHAPE_SPHERE) {
        let distance2 = dot(towards, towards);
        if (sphere_surrounds(light, distance2)) {
            return 0.25 / PI;
        }
        return 0.5 / (PI * cone_height(objects[light].radius, distance2));
    }
    // dω = cos dA / distance², with cos = |height| / distance along the direction.
    let speed = abs(dot(direction, objects[light].normal));
    let height = abs(dot(towards, objects[light].normal));
    if (speed <= 0.0 || height <= 0.0) {
        return 0.0;
    }
    let distance = height / speed;
    let area = 4.0 * objects[light].half_width * objects[light].half_height;
    return distance * distance / (speed * area);
}

/// Whether a point at this squared distance from the centre lies in or on the sphere.
fn sphere_surrounds(light: u32, distance2: f32) -> bool {
    let radius = objects[light].radius;
    // A point on the surface was put there with rounding; from just outside the cone would be all but a hemisphere.
    return distance2 <= radius * radius * 1.00001;
}
