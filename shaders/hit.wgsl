// The nearest surface along a ray.

struct Hit {
    /// Index of the object, NONE where the ray leaves the scene.
    object: u32,
    distance: f32,
}

/// Distance along a ray to one object, below 0 where it misses. `from_object` is the object that the ray starts on, or NONE.
fn distance_to(index: u32, ray: Ray, from_object: u32) -> f32 {
    let origin = ray.origin - shape_at(index).center;
    if (HAS_SPHERES && shape_at(index).kind == SHAPE_SPHERE) {
        return intersect_sphere(origin, ray.direction, shape_at(index).radius, index == from_object);
    }
    if (index == from_object) {
        return -1.0;
    }
    let distance = intersect_plane(origin, ray.direction, shape_at(index).normal);
    if (HAS_RECTANGLES && shape_at(index).kind == SHAPE_RECTANGLE && distance > 0.0) {
        let place = origin + distance * ray.direction;
        let inside = abs(dot(place, shape_at(index).tangent)) <= shape_at(index).half_width
            && abs(dot(place, shape_at(index).bitangent)) <= shape_at(index).half_height;
        return select(-1.0, distance, inside);
    }
    if (HAS_DISKS && shape_at(index).kind == SHAPE_DISK && distance > 0.0) {
        let place = origin + distance * ray.direction;
        return select(-1.0, distance, dot(place, place) <= shape_at(index).radius * shape_at(index).radius);
    }
    return distance;
}

/// Whether a ray meets the box of a node before a distance. `inverse` is 1 over its direction.
fn meets_box(node: Node, origin: vec3f, inverse: vec3f, before: f32) -> bool {
    let a = (node.low - origin) * inverse;
    let b = (node.high - origin) * inverse;
    let enters = min(a, b);
    let leaves = max(a, b);
    let near = max(max(enters.x, enters.y), max(enters.z, 0.0));
    let far = min(min(leaves.x, leaves.y), min(leaves.z, before));
    // Three roundings on either side (Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013).
    return near <= far * 1.0000008;
}

/// The nearest object along a ray, by the hierarchy of boxes: what a box holds follows it, and is skipped where the ray misses it.
fn nearest_in_hierarchy(ray: Ray, from_object: u32) -> Hit {
    var nearest = Hit(NONE, 3.0e38);
    let inverse = select(1.0 / ray.direction, vec3f(1e30), abs(ray.direction) < vec3f(1e-30));
    var row = 0u;
    loop {
        let node = load_node(row);
        let enters = meets_box(node, ray.origin, inverse, nearest.distance);
        if (enters && node.object != NONE) {
            let distance = distance_to(node.object, ray, from_object);
            // Of two at the same distance the first counts.
            let is_first = distance == nearest.distance && node.object < nearest.object;
            if (distance > 0.0 && (distance < nearest.distance || is_first)) {
                nearest = Hit(node.object, distance);
            }
        }
        row = select(node.next, row + NODE_ROWS, enters);
        continuing {
            break if row >= HIERARCHY_ROWS;
        }
    }
    return nearest;
}

/// The nearest object along a ray.
fn nearest_hit(ray: Ray, from_object: u32) -> Hit {
    if (HAS_HIERARCHY) {
        return nearest_in_hierarchy(ray, from_object);
    }
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
