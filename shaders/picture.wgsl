// How pictures are mapped to surfaces, and which of their pixels a path uses.

/// Returns the position in a picture, from its upper left corner, in units of its width and height; `size_in` is its size on
/// planes, 0 for the size of the surface.
fn picture_uv(size_in: vec2f, object: u32, position: vec3f) -> vec2f {
    let local = position - shape_at(object).center;
    if (HAS_SPHERES && shape_at(object).kind == SHAPE_SPHERE) {
        let aside = length(local.xz);
        // At the poles, any longitude is right.
        let angle = polar_angle(local.z, max(abs(local.x), 1e-30));
        let longitude = select(angle, -angle, local.x < 0.0) / (2.0 * PI);
        return vec2f(0.5 + longitude, polar_angle(local.y, aside) / PI);
    }
    var size = size_in;
    if (size.x == 0.0) {
        let whole = 2.0 * vec2f(shape_at(object).half_width, shape_at(object).half_height);
        size = select(whole, vec2f(1.0), shape_at(object).kind == SHAPE_PLANE);
    }
    let place = vec2f(dot(local, shape_at(object).tangent), -dot(local, shape_at(object).bitangent));
    return 0.5 + place / size;
}

/// Returns the index of the pixel that a path uses at a position in a picture: one of the four whose centers surround it, with the
/// weights of bilinear interpolation as probabilities (`random` in [0, 1)).
fn chosen_pixel(head: u32, place: vec2f, wraps: bool, random: f32) -> u32 {
    let size = texel_at(head).xy;
    let x = clamp(place.x * size.x - 0.5, -1.0, size.x);
    let y = clamp(place.y * size.y - 0.5, 0.0, size.y - 1.0);
    let to_right = x - floor(x);
    let is_right = random < to_right;
    let rest = select((random - to_right) / (1.0 - to_right), random / to_right, is_right);
    let is_below = rest < y - floor(y);
    // In [−1, width + 1]: adding or subtracting one width brings it inside.
    let width = i32(size.x);
    let column = i32(floor(x)) + select(0, 1, is_right);
    let inside = select(clamp(column, 0, width - 1), (column + width) % width, wraps);
    let row = min(i32(y) + select(0, 1, is_below), i32(size.y) - 1);
    return u32(row * width + inside);
}
