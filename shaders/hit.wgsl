// The nearest surface along a ray.

struct Hit {
    /// Index of the object, NONE where the ray leaves the scene.
    object: u32,
    distance: f32,
}

/// Whether a point in the plane of a shape, relative to the shape's center, lies in the shape.
fn covers(index: u32, place: vec3f) -> bool {
    if (HAS_RECTANGLES && shape_at(index).kind == SHAPE_RECTANGLE) {
        return abs(dot(place, shape_at(index).tangent)) <= shape_at(index).half_width
            && abs(dot(place, shape_at(index).bitangent)) <= shape_at(index).half_height;
    }
    if (HAS_DISKS && shape_at(index).kind == SHAPE_DISK) {
        return dot(place, place) <= shape_at(index).radius * shape_at(index).radius;
    }
    return true;
}

/// Returns the distance along a ray to one object, below 0 where the ray misses. `starts_here`: the ray starts on its surface.
fn distance_to_shape(index: u32, ray: Ray, starts_here: bool) -> f32 {
    let origin = ray.origin - shape_at(index).center;
    if (HAS_SPHERES && shape_at(index).kind == SHAPE_SPHERE) {
        if (HAS_LARGE_SPHERES && shape_at(index).curvature > 0.0) {
            let place = ray.origin - shape_at(index).nearest;
            return intersect_large_sphere(place, ray.direction, shape_at(index).normal, shape_at(index).curvature, starts_here);
        }
        return intersect_sphere(origin, ray.direction, shape_at(index).radius, starts_here);
    }
    if (starts_here) {
        return -1.0;
    }
    let distance = intersect_plane(origin, ray.direction, shape_at(index).normal);
    if (distance > 0.0) {
        return select(-1.0, distance, covers(index, origin + distance * ray.direction));
    }
    return distance;
}

/// Whether a ray leaves a stack of coincident surfaces where it meets one of them.
fn is_outward(index: u32, direction: vec3f, place: vec3f) -> bool {
    var normal = shape_at(index).normal;
    if (HAS_SPHERES && shape_at(index).kind == SHAPE_SPHERE) {
        normal = place - shape_at(index).center;
    }
    return (dot(direction, normal) > 0.0) != ((shape_at(index).sheet & 1u) == 1u);
}

/// Returns the distance along a ray to one object, below 0 where the ray misses. `from_object` is the object that the ray starts
/// on, or NONE: of the surfaces that coincide with it, those ahead are met at once, and the others are not met there.
fn distance_to(index: u32, ray: Ray, from_object: u32) -> f32 {
    if (HAS_STACKED_SHAPES && from_object != NONE && index != from_object) {
        let stack = shape_at(index).stack;
        if (stack != NONE && stack == shape_at(from_object).stack) {
            let is_ahead = (shape_at(index).sheet < shape_at(from_object).sheet) == is_outward(index, ray.direction, ray.origin);
            if (is_ahead && covers(index, ray.origin - shape_at(index).center)) {
                return 0.0;
            }
            return distance_to_shape(index, ray, true);
        }
    }
    let distance = distance_to_shape(index, ray, index == from_object);
    // Elsewhere a distance of 0 is a rounding error.
    return select(-1.0, distance, distance > 0.0);
}

/// Whether an object at a distance is nearer than the nearest one so far: of two objects at the same distance, the first counts; of
/// coincident ones, the one that the ray reaches first.
fn is_nearer(index: u32, distance: f32, nearest: Hit, ray: Ray) -> bool {
    if (HAS_STACKED_SHAPES && distance >= 0.0 && nearest.object != NONE) {
        let stack = shape_at(index).stack;
        let apart = abs(distance - nearest.distance);
        let is_same_crossing = (distance > 0.0) == (nearest.distance > 0.0) && apart <= 1e-5 * max(distance, nearest.distance);
        if (stack != NONE && stack == shape_at(nearest.object).stack && is_same_crossing) {
            let leaves = is_outward(index, ray.direction, ray.origin + distance * ray.direction);
            return (shape_at(index).sheet > shape_at(nearest.object).sheet) == leaves;
        }
    }
    let is_first = HAS_HIERARCHY && distance == nearest.distance && index < nearest.object;
    return is_met(distance) && (distance < nearest.distance || is_first);
}

/// Whether a distance is a hit: 0 is the distance of a surface in which the ray starts.
fn is_met(distance: f32) -> bool {
    if (HAS_STACKED_SHAPES) {
        return distance >= 0.0;
    }
    return distance > 0.0;
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

/// Returns the nearest object along a ray, by the hierarchy of boxes: the contents of a box follow it and are skipped where the ray
/// misses it.
fn nearest_in_hierarchy(ray: Ray, from_object: u32) -> Hit {
    var nearest = Hit(NONE, 3.0e38);
    let inverse = select(1.0 / ray.direction, vec3f(1e30), abs(ray.direction) < vec3f(1e-30));
    var row = 0u;
    loop {
        let node = load_node(row);
        let enters = meets_box(node, ray.origin, inverse, nearest.distance);
        if (enters && node.object != NONE) {
            let distance = distance_to(node.object, ray, from_object);
            if (is_nearer(node.object, distance, nearest, ray)) {
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

/// Returns the nearest object along a ray.
fn nearest_hit(ray: Ray, from_object: u32) -> Hit {
    if (HAS_HIERARCHY) {
        return nearest_in_hierarchy(ray, from_object);
    }
    var nearest = Hit(NONE, 3.0e38);
    // The condition is at the end: some drivers make an extra pass through a loop that has it at its start.
    var index = 0u;
    loop {
        let distance = distance_to(index, ray, from_object);
        if (is_nearer(index, distance, nearest, ray)) {
            nearest = Hit(index, distance);
        }
        continuing {
            index++;
            break if index >= OBJECT_COUNT;
        }
    }
    return nearest;
}
