// The environment, in parts that are sampled separately. A part is an emitter; its radiance in a direction is its emission times
// its relative radiance there.

/// Returns the emitter of a part of the environment.
fn environment_part(part: u32) -> u32 {
    return u32(number_at(frame.first_environment + part));
}

/// Returns the relative radiance of a part of the environment in a direction; a picture has its own values.
fn environment_strength(emitter: u32, direction: vec3f) -> f32 {
    if (emitter_at(emitter).kind == EMITTER_EVERYWHERE || (HAS_ENVIRONMENT_PICTURE && emitter_at(emitter).kind == EMITTER_PICTURE)) {
        return 1.0;
    }
    if (emitter_at(emitter).kind == EMITTER_HORIZON) {
        return max(1.0 - abs(direction.y), 0.0);
    }
    if (HAS_DISTANT_DISKS && emitter_at(emitter).kind == EMITTER_DISTANT_DISK) {
        let aside = direction - emitter_at(emitter).axis;
        return select(0.0, 1.0, dot(aside, aside) <= 2.0 * emitter_at(emitter).edge_height);
    }
    return clamp(dot(direction, emitter_at(emitter).axis), 0.0, 1.0);
}

/// Samples a direction toward a part of the environment, by the density of environment_pdf.
fn sample_environment(emitter: u32, random: vec2f) -> vec3f {
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(emitter).kind == EMITTER_PICTURE) {
        return sample_environment_picture(emitter, random);
    }
    if (emitter_at(emitter).kind == EMITTER_EVERYWHERE) {
        return sample_cone(random.x, random.y, 2.0);
    }
    if (emitter_at(emitter).kind == EMITTER_HORIZON) {
        // |h| with density 2 (1 − |h|), above the horizon for the lower half of the numbers.
        let upward = random.x < 0.5;
        let t = 2.0 * random.x - select(1.0, 0.0, upward);
        let height = t / (1.0 + sqrt(1.0 - t));
        let around = sqrt((1.0 - height) * (1.0 + height)) * direction_of_turn(random.y);
        return vec3f(around.x, select(-height, height, upward), around.y);
    }
    if (HAS_DISTANT_DISKS && emitter_at(emitter).kind == EMITTER_DISTANT_DISK) {
        return normalize(frame_of(emitter_at(emitter).axis) * sample_cone(random.x, random.y, emitter_at(emitter).edge_height));
    }
    return frame_of(emitter_at(emitter).axis) * sample_cosine_hemisphere(random.x, random.y);
}

/// Returns the density with which sample_environment samples a direction, sr⁻¹: the relative radiance over its integral.
fn environment_pdf(emitter: u32, direction: vec3f) -> f32 {
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(emitter).kind == EMITTER_PICTURE) {
        return environment_picture_pdf(emitter, direction);
    }
    let strength = environment_strength(emitter, direction);
    if (emitter_at(emitter).kind == EMITTER_EVERYWHERE) {
        return strength * (0.25 / PI);
    }
    if (emitter_at(emitter).kind == EMITTER_HORIZON) {
        return strength * (0.5 / PI);
    }
    if (HAS_DISTANT_DISKS && emitter_at(emitter).kind == EMITTER_DISTANT_DISK) {
        return strength * (0.5 / PI) / emitter_at(emitter).edge_height;
    }
    return strength / PI;
}
