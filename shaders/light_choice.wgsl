// The choice among lights, by an estimate of what each of them brings to a point.

struct EmitterChoice {
    /// The emitter, NONE where none can shine on the point.
    emitter: u32,
    /// With what probability it was chosen.
    pmf: f32,
    /// The sum of all estimates.
    total: f32,
}

/// The largest cosine with a normal within a cone whose axis has the cosine `axis` with it; `sine2` is the square of the sine of
/// the half angle.
fn most_cosine(axis: f32, sine2: f32) -> f32 {
    let cosine = sqrt(max(1.0 - sine2, 0.0));
    if (axis >= cosine) {
        return 1.0;
    }
    return max(axis * cosine + sqrt(max(1.0 - axis * axis, 0.0) * sine2), 0.0);
}

/// About the luminance that a light gives to a white surface; 0 only where nothing of it can arrive.
fn light_estimate(light: u32, point: vec3f, normal: vec3f) -> f32 {
    let brightness = emitters[light].brightness;
    if (is_surrounding(light)) {
        return brightness * environment_estimate(light, normal);
    }
    if (is_single_direction(light)) {
        let direction = sample_light(light, point, 0.0, 0.0);
        return brightness * light_share(light, point, direction) * max(dot(direction, normal), 0.0);
    }
    let towards = emitters[light].position - point;
    let distance2 = dot(towards, towards);
    if (HAS_SPHERE_LIGHTS && emitters[light].kind == EMITTER_SPHERE) {
        if (sphere_surrounds(light, distance2)) {
            return brightness * PI;
        }
        let radius = emitters[light].radius;
        let axis = dot(towards, normal) / sqrt(distance2);
        let solid_angle = 2.0 * PI * cone_height(radius, distance2);
        return brightness * solid_angle * most_cosine(axis, radius * radius / distance2);
    }
    return brightness * plane_estimate(light, towards, distance2, normal);
}

/// Solid angle of a rectangle or disk times the largest cosine, both from the sphere that holds it.
fn plane_estimate(light: u32, towards: vec3f, distance2: f32, normal: vec3f) -> f32 {
    let width = emitters[light].half_width;
    let height = emitters[light].half_height;
    let round = HAS_DISK_LIGHTS && emitters[light].kind == EMITTER_DISK;
    let reach2 = select(width * width + height * height, width * width, round);
    let area = plane_area(light);
    // Cosine at the light, at most as if it were turned by the angle under which half of it is seen.
    let facing = abs(dot(towards, emitters[light].axis)) * sqrt(distance2) + reach2;
    let solid_angle = area * min(facing / max(distance2, 1e-20), 1.0) / (distance2 + area * (0.5 / PI));
    if (distance2 <= reach2) {
        return solid_angle;
    }
    return solid_angle * most_cosine(dot(towards, normal) / sqrt(distance2), reach2 / distance2);
}

/// ∫ share cos dω of a part of the surroundings, about.
fn environment_estimate(light: u32, normal: vec3f) -> f32 {
    if (emitters[light].kind == EMITTER_DISC) {
        let height = emitters[light].cap_height;
        return 2.0 * PI * height * most_cosine(dot(emitters[light].axis, normal), height * (2.0 - height));
    }
    if (emitters[light].kind == EMITTER_POLE) {
        return (PI / 3.0) * max(1.0 + dot(emitters[light].axis, normal), 0.0);
    }
    return select(PI, 0.5 * PI, emitters[light].kind == EMITTER_HORIZON);
}

/// The sum of all lights' estimates.
fn light_total(point: vec3f, normal: vec3f) -> f32 {
    var total = 0.0;
    for (var i = 0u; i < LIGHT_COUNT; i++) {
        total += light_estimate(i, point, normal);
    }
    return total;
}

/// Chooses a light with a probability in proportion to its estimate.
fn choose_emitter(point: vec3f, normal: vec3f, random: f32) -> EmitterChoice {
    if (!HAS_LIGHT_CHOICE) {
        return EmitterChoice(0u, 1.0, 1.0);
    }
    let total = light_total(point, normal);
    var choice = EmitterChoice(NONE, 0.0, total);
    var left = random * total;
    for (var i = 0u; i < LIGHT_COUNT && left >= 0.0; i++) {
        let estimate = light_estimate(i, point, normal);
        left -= estimate;
        if (estimate > 0.0) {
            choice.emitter = i;
            choice.pmf = estimate / total;
        }
    }
    return choice;
}

/// The probability with which choose_emitter finds a light, where the sum of all estimates is known.
fn emitter_pmf(light: u32, point: vec3f, normal: vec3f, total: f32) -> f32 {
    if (!HAS_LIGHT_CHOICE) {
        return 1.0;
    }
    if (total <= 0.0) {
        return 0.0;
    }
    return light_estimate(light, point, normal) / total;
}

/// Scattering is left out where its density is less than this part of the other's.
const CUTOFF: f32 = 0.1875;

/// Share of sending in a direction to a light that it finds with `probability` times `density`, and scattering with density `scattered`;
/// scattering has the rest.
///
/// Of a picture only what is brighter than the mean is sent for (MIS compensation, Karlík et al. 2019), and no more of the light than
/// that belongs to sending. Against scattering counts the density with which all of the picture's light would be sent for: a mirror
/// that finds an even picture without noise shall not leave the rim of what it mirrors to a few rays.
fn mis_weight_emitter(light: u32, scattered: f32, probability: f32, density: f32) -> f32 {
    if (HAS_ENVIRONMENT_PICTURE && emitters[light].kind == EMITTER_PICTURE) {
        let even = direction_table(light).even_density;
        if (even > 0.0) {
            let excess = density / even;
            return excess / (1.0 + excess) * (1.0 - mis_weight_bsdf(scattered, probability * excess * (0.25 / PI)));
        }
    }
    return 1.0 - mis_weight_bsdf(scattered, probability * density);
}

/// Share of scattering in a direction that it finds with density `scattered` and sending with density `sent`, 1 less the share of
/// sending: the power heuristic (Veach 1997, section 9.2.2), with a cutoff of scattering alone.
fn mis_weight_bsdf(scattered: f32, sent: f32) -> f32 {
    if (scattered < CUTOFF * sent) {
        return 0.0;
    }
    let ratio = sent / scattered;
    return 1.0 / (1.0 + ratio * ratio);
}
