// The thickness of a layer at a point of its surface.

/// Whether a layer's thickness varies over its surface.
fn layer_varies(layer: u32) -> bool {
    return load_layer(layer).field_count > 0u;
}

/// Returns the thickness of a layer at a point of an object's surface, nm.
fn layer_thickness(layer: u32, object: u32, position: vec3f) -> f32 {
    let even = load_layer(layer);
    let count = even.field_count;
    if (!HAS_FIELDS || count == 0u) {
        return even.thickness_nm;
    }
    let first = even.first_field;
    if (!HAS_COMBINED_FIELDS || count == 1u) {
        return clamp(field_value(first, object, position), 0.0, f32(MAX_THICKNESS_NM));
    }
    return clamp(combined_fields(first, count, object, position), 0.0, f32(MAX_THICKNESS_NM));
}

/// Returns the value of fields in postfix order: a sum or product takes the two values before it.
fn combined_fields(first: u32, count: u32, object: u32, position: vec3f) -> f32 {
    var stack: array<f32, FIELD_STACK>;
    var height = 0u;
    for (var field = first; field < first + count * FIELD_ROWS; field += FIELD_ROWS) {
        let kind = load_field(field).kind;
        if (kind == FIELD_SUM || kind == FIELD_PRODUCT) {
            height -= 1u;
            let a = stack[height - 1u];
            let b = stack[height];
            stack[height - 1u] = select(a * b, a + b, kind == FIELD_SUM);
        } else {
            stack[height] = field_value(field, object, position);
            height += 1u;
        }
    }
    return stack[0];
}

/// Returns the value of a field that is not a sum or product.
fn field_value(field: u32, object: u32, position: vec3f) -> f32 {
    let kind = load_field(field).kind;
    if (HAS_SWIRLS && kind == FIELD_SWIRLS) {
        return swirls(field, object, position);
    }
    if (HAS_PICTURES && kind == FIELD_PICTURE) {
        return picture_value(field, object, position);
    }
    if (HAS_COMBINED_FIELDS && kind == FIELD_CONSTANT) {
        return load_field(field).base;
    }
    let along = field_coordinate(field, object, position);
    if (HAS_SAMPLED_FIELDS && kind == FIELD_STEPS) {
        let count = load_field(field).sample_count;
        return number_at(load_field(field).first_number + min(u32(along * f32(count)), count - 1u));
    }
    if (HAS_SAMPLED_FIELDS && kind == FIELD_PROFILE) {
        return profile_value(field, along);
    }
    return load_field(field).base + load_field(field).swing * along;
}

/// Returns the coordinate along which a field varies, from 0 to 1: the polar angle, or the position along a line.
fn field_coordinate(field: u32, object: u32, position: vec3f) -> f32 {
    let origin = load_field(field).origin;
    if (HAS_POLAR_FIELDS && (!HAS_LINE_FIELDS || load_field(field).runs_along == ALONG_POLAR_ANGLE)) {
        let radial = position - shape_at(object).center;
        return polar_angle(dot(radial, origin), length(cross(radial, origin))) / PI;
    }
    return clamp(dot(position - origin, load_field(field).along), 0.0, 1.0);
}

/// Returns the root of a table of squares, or the thickness of a black film where the root is below the threshold.
fn profile_value(field: u32, along: f32) -> f32 {
    let steps = load_field(field).sample_count - 1u;
    let place = along * f32(steps);
    let knot = min(u32(place), steps - 1u);
    let first = load_field(field).first_number + knot;
    let square = mix(number_at(first), number_at(first + 1u), place - f32(knot));
    let thickness = min(sqrt(square), load_field(field).most_nm);
    return select(thickness, load_field(field).black_nm, thickness < load_field(field).black_below_nm);
}

/// Returns the value of a picture, by longitude and latitude on spheres, by the surface's two axes elsewhere.
fn picture_value(field: u32, object: u32, position: vec3f) -> f32 {
    let value = bilinear(field, picture_uv(load_field(field).size, object, position), shape_at(object).kind == SHAPE_SPHERE);
    return load_field(field).base + load_field(field).swing * value;
}

/// Returns the value of a picture, interpolated linearly between the centers of its pixels.
fn bilinear(field: u32, place: vec2f, wraps: bool) -> f32 {
    let width = i32(load_field(field).columns);
    let height = i32(load_field(field).rows);
    let x = clamp(place.x * f32(width) - 0.5, -1.0, f32(width));
    let y = clamp(place.y * f32(height) - 0.5, 0.0, f32(height - 1));
    let left = i32(floor(x));
    let above = i32(y);
    // In [−1, width + 1]: adding or subtracting one width brings it inside.
    let columns = vec2i(left, left + 1);
    let wrapped = (columns + width) % width;
    let inside = select(clamp(columns, vec2i(0), vec2i(width - 1)), wrapped, wraps);
    let rows = load_field(field).first_number + u32(width) * vec2u(vec2i(above, min(above + 1, height - 1)));
    let part = x - floor(x);
    let upper = mix(number_at(rows.x + u32(inside.x)), number_at(rows.x + u32(inside.y)), part);
    let lower = mix(number_at(rows.y + u32(inside.x)), number_at(rows.y + u32(inside.y)), part);
    return mix(upper, lower, y - f32(above));
}
