// The geometry of polarized light: reference axes of Stokes vectors, and turns between them.
//
// Light travels along d, away from its source. Its Stokes vector refers to an axis x across d, with y = d × x. Where light meets a
// surface, x is s, across the plane of incidence.

/// Returns the unit vector across two unit vectors; where they are parallel, any one across both.
fn axis_across(a: vec3f, b: vec3f) -> vec3f {
    let across = cross(a, b);
    let size2 = dot(across, across);
    if (size2 < 1e-12) {
        return frame_of(a)[0];
    }
    return across * inverseSqrt(size2);
}

/// Returns cos 2φ and sin 2φ of the turn of light along `direction` from one axis to another, by the angle φ.
fn turn_between(before: vec3f, after: vec3f, direction: vec3f) -> vec2f {
    let cosine = dot(before, after);
    let sine = dot(direction, cross(before, after));
    // Rounding must not change the degree of polarization.
    let size = max(cosine * cosine + sine * sine, 1e-30);
    return vec2f(cosine * cosine - sine * sine, 2.0 * cosine * sine) / size;
}

/// Returns S1 and S2 about the axis after a turn.
fn turned_axis(turn: vec2f, s: vec2f) -> vec2f {
    return vec2f(turn.x * s.x + turn.y * s.y, turn.x * s.y - turn.y * s.x);
}

/// Returns S1, S2 and S3, over S0, of emitted light that comes from `toward`, about an axis across that unit vector; `row` is that of its
/// polarization, or NONE.
fn emitted_stokes(row: u32, toward: vec3f, axis: vec3f) -> vec3f {
    if (row == NONE) {
        return vec3f(0.0);
    }
    let light = load_polarization(row);
    let side = axis_across(toward, light.axis);
    if (light.kind == POLARIZED_SKY) {
        let cosine = dot(toward, light.axis);
        let sine = cross(toward, light.axis);
        // The ground is not polarized.
        let degree = select(light.degree * dot(sine, sine) / (1.0 + cosine * cosine), 0.0, toward.y < 0.0);
        return vec3f(turned_axis(turn_between(side, axis, -toward), vec2f(degree, 0.0)), 0.0);
    }
    // Across the ray, in the plane of the ray and the reference.
    let own = cross(side, toward);
    return vec3f(turned_axis(turn_between(own, axis, -toward), light.stokes.xy), light.stokes.z);
}
