// From a position in the picture to a ray.

struct Ray {
    origin: vec3f,
    /// Unit direction.
    direction: vec3f,
}

/// Returns the offset of a sample from a pixel's center, in pixels, by a uniform number: linear between the knots of the filter's table.
fn filter_offset(u: f32) -> f32 {
    if (!HAS_FILTER) {
        return u - 0.5;
    }
    // Knots are dense where the filter has little weight.
    let t = 2.0 * u - 1.0;
    let place = (0.5 + 0.5 * sign(t) * (1.0 - sqrt(1.0 - abs(t)))) * f32(FILTER_KNOTS - 1u);
    let knot = min(u32(place), FILTER_KNOTS - 2u);
    let first = frame.first_filter + knot;
    return mix(number_at(first), number_at(first + 1u), place - f32(knot));
}

/// Returns the camera ray of a pixel of the whole picture; `jitter` in [0, 1)² distributes the samples by the pixel's filter, row 0
/// on top, and `on_lens` in [0, 1)² over the lens.
fn camera_ray(pixel: vec2u, jitter: vec2f, on_lens: vec2f) -> Ray {
    let size = vec2f(frame.image_size);
    let place = (vec2f(pixel) + 0.5 + vec2f(filter_offset(jitter.x), filter_offset(jitter.y))) / size;
    if (HAS_PANORAMA) {
        let longitude = direction_of_turn(place.x - 0.5);
        let latitude = direction_of_turn(0.25 - 0.5 * place.y);
        let around = latitude.x * (longitude.y * frame.camera_right - longitude.x * frame.camera_back);
        return Ray(frame.camera_origin, around + latitude.y * frame.camera_up);
    }
    let x = (2.0 * place.x - 1.0) * (size.x / size.y) * frame.half_height;
    let y = (1.0 - 2.0 * place.y) * frame.half_height;
    let aside = x * frame.camera_right + y * frame.camera_up;
    if (HAS_ORTHOGRAPHIC) {
        return Ray(frame.camera_origin + aside, -frame.camera_back);
    }
    let ahead = aside - frame.camera_back;
    if (!HAS_LENS) {
        return Ray(frame.camera_origin, normalize(ahead));
    }
    // Uniform over the lens. All rays of a position in the picture meet where the pinhole's ray reaches the plane of focus.
    let at = frame.lens_radius * sqrt(on_lens.x) * direction_of_turn(on_lens.y);
    let from_middle = at.x * frame.camera_right + at.y * frame.camera_up;
    return Ray(frame.camera_origin + from_middle, normalize(frame.focus_distance * ahead - from_middle));
}
