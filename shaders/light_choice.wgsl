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
    let brightness = emitter_at(light).brightness;
    if (is_surrounding(light)) {
        return brightness * environment_estimate(light, normal);
    }
    if (is_single_direction(light)) {
        let direction = sample_light(light, point, 0.0, 0.0);
        return brightness * light_share(light, point, direction) * max(dot(direction, normal), 0.0);
    }
    let toward = emitter_at(light).position - point;
    let distance2 = dot(toward, toward);
    if (HAS_SPHERE_LIGHTS && emitter_at(light).kind == EMITTER_SPHERE) {
        if (sphere_surrounds(light, distance2)) {
            return brightness * PI;
        }
        let radius = emitter_at(light).radius;
        let axis = dot(toward, normal) / sqrt(distance2);
        let solid_angle = 2.0 * PI * cone_height(radius, distance2);
        return brightness * solid_angle * most_cosine(axis, radius * radius / distance2);
    }
    return brightness * plane_estimate(light, toward, distance2, normal);
}

/// Solid angle of a rectangle or disk times the largest cosine, both from the sphere that holds it.
fn plane_estimate(light: u32, toward: vec3f, distance2: f32, normal: vec3f) -> f32 {
    let width = emitter_at(light).half_width;
    let height = emitter_at(light).half_height;
    let round = HAS_DISK_LIGHTS && emitter_at(light).kind == EMITTER_DISK;
    let reach2 = select(width * width + height * height, width * width, round);
    let area = plane_area(light);
    // Cosine at the light, at most as if it were turned by the angle under which half of it is seen.
    let facing = abs(dot(toward, emitter_at(light).axis)) * sqrt(distance2) + reach2;
    let solid_angle = area * min(facing / max(distance2, 1e-20), 1.0) / (distance2 + area * (0.5 / PI));
    if (distance2 <= reach2) {
        return solid_angle;
    }
    return solid_angle * most_cosine(dot(toward, normal) / sqrt(distance2), reach2 / distance2);
}

/// ∫ share cos dω of a part of the surroundings, about.
fn environment_estimate(light: u32, normal: vec3f) -> f32 {
    if (emitter_at(light).kind == EMITTER_DISTANT_DISK) {
        let height = emitter_at(light).edge_height;
        return 2.0 * PI * height * most_cosine(dot(emitter_at(light).axis, normal), height * (2.0 - height));
    }
    if (emitter_at(light).kind == EMITTER_POLE) {
        return (PI / 3.0) * max(1.0 + dot(emitter_at(light).axis, normal), 0.0);
    }
    return select(PI, 0.5 * PI, emitter_at(light).kind == EMITTER_HORIZON);
}

/// Part of the variance of places that counts as squared distance, and the square of the width of the heights of a group, which scatter
/// along all axes alike, relative to it: 2/(3π) (see the reference's choice of emitters, which has the reasons).
const SOFTENING: f32 = 0.4;
const HORIZON: f32 = 0.212206590789;
/// Cosines are compared with the edge of a cone up to this.
const EDGE: f32 = 1e-4;

/// About what a group of emitters brings to a point, in the unit of light_estimate; 0 only where nothing of it can arrive: its power times
/// the cosine over the squared distance (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, section 12.6.3), with
/// the mean in place of the largest cosine.
fn group_estimate(node: LightNode, point: vec3f, normal: vec3f) -> f32 {
    let toward = node.center - point;
    let height = dot(toward, normal);
    let distance2 = dot(toward, toward);
    if (height + node.reach <= 0.0 || is_outside_cone(node, toward, distance2)) {
        return 0.0;
    }
    let soft = distance2 + SOFTENING * node.variance;
    let along = dot(toward, node.axis);
    let square = (along * along + node.variance / 3.0) / (distance2 + node.variance);
    let sent = sqrt(node.even + node.along * square);
    return node.power * sent * mean_above(height, HORIZON * node.variance) / (soft * sqrt(soft));
}

/// About the mean of max(0, h) over heights h with a mean and a squared width, without a difference of like numbers.
fn mean_above(mean: f32, width2: f32) -> f32 {
    let root = sqrt(mean * mean + width2);
    return select(0.5 * width2 / (root - mean), 0.5 * (root + mean), mean > 0.0);
}

/// Whether the cone in which a group shines, as wide as the group is seen, holds no direction toward a point.
fn is_outside_cone(node: LightNode, toward: vec3f, distance2: f32) -> bool {
    let reach2 = node.reach * node.reach;
    if (node.cone <= -1.0 || distance2 <= reach2) {
        return false;
    }
    let sine = sqrt(reach2 / distance2);
    let cosine = sqrt(1.0 - reach2 / distance2);
    let cone_sine = sqrt(max(1.0 - node.cone * node.cone, 0.0));
    if (cosine <= -node.cone) {
        return false;
    }
    let edge = node.cone * cosine - cone_sine * sine;
    return -dot(toward, node.axis) < (edge - EDGE) * sqrt(distance2);
}

/// Whether a group is looked into from a point.
fn is_near(node: LightNode, point: vec3f) -> bool {
    let toward = node.center - point;
    return dot(toward, toward) < node.near * node.near;
}

/// About what a node of the tree of emitters brings to a point.
fn node_estimate(node: LightNode, point: vec3f, normal: vec3f) -> f32 {
    if (node.emitter == NONE) {
        return group_estimate(node, point, normal);
    }
    return light_estimate(node.emitter, point, normal);
}

/// The sum of the estimates of the groups and emitters that a point is not near to, which hold each emitter once.
fn tree_total(point: vec3f, normal: vec3f) -> f32 {
    var total = 0.0;
    var row = frame.first_light_node;
    loop {
        let node = load_lightnode(row);
        let near = is_near(node, point);
        if (!near) {
            total += node_estimate(node, point, normal);
        }
        row = select(node.next, row + LIGHTNODE_ROWS, near);
        continuing {
            break if row >= frame.end_light_node;
        }
    }
    return total;
}

/// Chooses one of those groups and emitters, and then one of the two nodes of a group until it is an emitter.
fn choose_in_tree(point: vec3f, normal: vec3f, random_in: f32) -> EmitterChoice {
    let total = tree_total(point, normal);
    var random = random_in;
    var chosen = NONE;
    var weight = 0.0;
    var before = 0.0;
    var sum = 0.0;
    var row = frame.first_light_node;
    loop {
        let node = load_lightnode(row);
        let near = is_near(node, point);
        if (!near) {
            let estimate = node_estimate(node, point, normal);
            if (estimate > 0.0) {
                chosen = row;
                weight = estimate;
                before = sum;
            }
            sum += estimate;
        }
        row = select(node.next, row + LIGHTNODE_ROWS, near);
        continuing {
            break if row >= frame.end_light_node || random * total < sum;
        }
    }
    let none = EmitterChoice(NONE, 0.0, total);
    if (chosen == NONE) {
        return none;
    }
    var pmf = weight / total;
    random = rest_of(random * total, before, weight);
    var node = load_lightnode(chosen);
    while (node.emitter == NONE) {
        let first = load_lightnode(chosen + LIGHTNODE_ROWS);
        let second = load_lightnode(first.next);
        let weights = vec2f(node_estimate(first, point, normal), node_estimate(second, point, normal));
        let both = weights.x + weights.y;
        if (both <= 0.0) {
            return none;
        }
        let share = weights.x / both;
        let is_first = weights.y <= 0.0 || random < share;
        let step = select(weights.y / both, share, is_first);
        random = rest_of(random, select(share, 0.0, is_first), step);
        pmf *= step;
        chosen = select(first.next, chosen + LIGHTNODE_ROWS, is_first);
        if (is_first) {
            node = first;
        } else {
            node = second;
        }
    }
    return EmitterChoice(node.emitter, pmf, total);
}

/// Where in a part of [0, 1) that begins at `before` and is `width` wide a number lies: again in [0, 1).
fn rest_of(random: f32, before: f32, width: f32) -> f32 {
    return clamp((random - before) / width, 0.0, 0.99999994);
}

/// The probability with which choose_in_tree finds an emitter, `total` being what that returned.
fn tree_pmf(emitter: u32, point: vec3f, normal: vec3f, total: f32) -> f32 {
    // The node that is weighed for it: the outermost group around it that is not looked into, or itself.
    var row = emitter_at(emitter).node;
    var top = row;
    var parent = load_lightnode(row).parent;
    while (parent != NONE) {
        let group = load_lightnode(parent);
        if (!is_near(group, point)) {
            top = parent;
        }
        parent = group.parent;
    }
    var pmf = 1.0;
    var node = load_lightnode(row);
    var weight = node_estimate(node, point, normal);
    while (row != top && weight > 0.0) {
        let first_row = node.parent + LIGHTNODE_ROWS;
        let other_row = select(first_row, load_lightnode(first_row).next, row == first_row);
        let other = node_estimate(load_lightnode(other_row), point, normal);
        pmf *= weight / (weight + other);
        row = node.parent;
        node = load_lightnode(row);
        weight = node_estimate(node, point, normal);
    }
    return pmf * (weight / total);
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
    if (HAS_LIGHT_TREE) {
        return choose_in_tree(point, normal, random);
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
    if (HAS_LIGHT_TREE) {
        return tree_pmf(light, point, normal, total);
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
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(light).kind == EMITTER_PICTURE) {
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
