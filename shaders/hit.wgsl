// The nearest surface along a ray.

struct Hit {
    /// Index of the object, NONE where the ray leaves the scene.
    object: u32,
    distance: f32,
}

/// Distance along a ray to one object, below 0 where it misses. `from_object` is the object that the ray starts on, or NONE.
fn distance_to(index: u32, ray: Ray, from_object: u32) -> f32 {
    let origin = ray.origin - shapes[index].center;
    if (HAS_SPHERES && shapes[index].kind == SHAPE_SPHERE) {
        return intersect_sphere(origin, ray.direction, shapes[index].radius, index == from_object);
    }
    if (index == from_object) {
        return -1.0;
    }
    let distance = intersect_plane(origin, ray.direction, shapes[index].normal);
    if (HAS_RECTANGLES && shapes[index].kind == SHAPE_RECTANGLE && distance > 0.0) {
        let place = origin + distance * ray.direction;
        let inside = abs(dot(place, shapes[index].tangent)) <= shapes[index].half_width
            && abs(dot(place, shapes[index].bitangent)) <= shapes[index].half_height;
        return select(-1.0, distance, inside);
    }
    if (HAS_DISKS && shapes[index].kind == SHAPE_DISK && distance > 0.0) {
        let place = origin + distance * ray.direction;
        return select(-1.0, distance, dot(place, place) <= shapes[index].radius * shapes[index].radius);
    }
    return distance;
}

/// The nearest object along a ray.
fn nearest_hit(ray: Ray, from_object: u32) -> Hit {
    var nearest = Hit(NONE, 3.0e38);
    // The condition stands at the end: some drivers pass once more through a loop that has it at its start.
    var index = 0u;
    loop {
        let distance = distance_to(index, ray, from_object);
        if (distance > 0.0 && distance < nearest.distance) {
            nearest = Hit(index, distance);
        }
        continuing {
            index++;
            break if index >= OBJECT_COUNT;
        }
    }
    return nearest;
}
