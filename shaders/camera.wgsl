// From a place in the picture to a ray.

struct Ray {
    origin: vec3f,
    /// Unit vector.
    direction: vec3f,
}

/// The ray through a pixel of the whole picture; `jitter` in [0, 1)² is the place within the pixel, row 0 on top.
fn camera_ray(pixel: vec2u, jitter: vec2f) -> Ray {
    let size = vec2f(frame.image_size);
    let place = (vec2f(pixel) + jitter) / size;
    if (HAS_PANORAMA) {
        let longitude = direction_of_turn(place.x - 0.5);
        let latitude = direction_of_turn(0.25 - 0.5 * place.y);
        let around = latitude.x * (longitude.y * frame.camera_right - longitude.x * frame.camera_back);
        return Ray(frame.camera_origin, around + latitude.y * frame.camera_up);
    }
    let x = (2.0 * place.x - 1.0) * (size.x / size.y) * frame.half_height;
    let y = (1.0 - 2.0 * place.y) * frame.half_height;
    let aside = x * frame.camera_right + y * frame.camera_up;
    if (frame.projection == PROJECTION_ORTHOGRAPHIC) {
        return Ray(frame.camera_origin + aside, -frame.camera_back);
    }
    return Ray(frame.camera_origin, normalize(aside - frame.camera_back));
}
