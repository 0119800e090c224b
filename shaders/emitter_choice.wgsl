// The choice among lights, by an estimate of what each of them brings to a point.

struct EmitterChoice {
    /// The emitter, NONE where none can shine on the point.
    emitter: u32,
    /// With what probability it was chosen.
    pmf: f32,
    /// The sum of all estimates.
    weight_sum: f32,
}

/// Part of the variance of places that counts as squared distance, and the square of the width of the heights of a group, which scatter
/// along all axes alike, relative to it: 2/(3π) (see the reference's choice of emitters, which has the reasons).
const SOFTENING: f32 = 0.4;
const HORIZON: f32 = 0.212206590789;
/// Cosines are compared with the edge of a cone up to this.
const EDGE: f32 = 1e-4;

/// About what a group of emitters brings to a point, in the unit of emitter_weight; 0 only where nothing of it can arrive: its power times
/// the cosine over the squared distance (Pharr, Jakob and Humphreys, Physically Based Rendering, 4th edition, section 12.6.3), with
/// the mean in place of the largest cosine.
fn group_weight(node: EmitterNode, point: vec3f, normal: vec3f) -> f32 {
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
fn is_outside_cone(node: EmitterNode, toward: vec3f, distance2: f32) -> bool {
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
fn is_near(node: EmitterNode, point: vec3f) -> bool {
    let toward = node.center - point;
    return dot(toward, toward) < node.near * node.near;
}

/// About what a node of the tree of emitters brings to a point.
fn node_weight(node: EmitterNode, point: vec3f, normal: vec3f) -> f32 {
    if (node.emitter == NONE) {
        return group_weight(node, point, normal);
    }
    return emitter_weight(node.emitter, point, normal);
}

/// The sum of the estimates of the groups and emitters that a point is not near to, which hold each emitter once.
fn weigh_tree(point: vec3f, normal: vec3f) -> f32 {
    var weight_sum = 0.0;
    var row = frame.first_emitter_node;
    loop {
        let node = load_emitternode(row);
        let near = is_near(node, point);
        if (!near) {
            weight_sum += node_weight(node, point, normal);
        }
        row = select(node.next, row + EMITTERNODE_ROWS, near);
        continuing {
            break if row >= frame.end_emitter_node;
        }
    }
    return weight_sum;
}

/// Chooses one of those groups and emitters, and then one of the two nodes of a group until it is an emitter.
fn choose_in_tree(point: vec3f, normal: vec3f, random_in: f32) -> EmitterChoice {
    let weight_sum = weigh_tree(point, normal);
    var random = random_in;
    var chosen = NONE;
    var weight = 0.0;
    var before = 0.0;
    var sum = 0.0;
    var row = frame.first_emitter_node;
    loop {
        let node = load_emitternode(row);
        let near = is_near(node, point);
        if (!near) {
            let here = node_weight(node, point, normal);
            if (here > 0.0) {
                chosen = row;
                weight = here;
                before = sum;
            }
            sum += here;
        }
        row = select(node.next, row + EMITTERNODE_ROWS, near);
        continuing {
            break if row >= frame.end_emitter_node || random * weight_sum < sum;
        }
    }
    let none = EmitterChoice(NONE, 0.0, weight_sum);
    if (chosen == NONE) {
        return none;
    }
    var pmf = weight / weight_sum;
    random = rest_of(random * weight_sum, before, weight);
    var node = load_emitternode(chosen);
    while (node.emitter == NONE) {
        let first = load_emitternode(chosen + EMITTERNODE_ROWS);
        let second = load_emitternode(first.next);
        let weights = vec2f(node_weight(first, point, normal), node_weight(second, point, normal));
        let both = weights.x + weights.y;
        if (both <= 0.0) {
            return none;
        }
        let share = weights.x / both;
        let is_first = weights.y <= 0.0 || random < share;
        let step = select(weights.y / both, share, is_first);
        random = rest_of(random, select(share, 0.0, is_first), step);
        pmf *= step;
        chosen = select(first.next, chosen + EMITTERNODE_ROWS, is_first);
        if (is_first) {
            node = first;
        } else {
            node = second;
        }
    }
    return EmitterChoice(node.emitter, pmf, weight_sum);
}

/// Where in a part of [0, 1) that begins at `before` and is `width` wide a number lies: again in [0, 1).
fn rest_of(random: f32, before: f32, width: f32) -> f32 {
    return clamp((random - before) / width, 0.0, 0.99999994);
}

/// The probability with which choose_in_tree finds an emitter, `total` being what that returned.
fn tree_pmf(emitter: u32, point: vec3f, normal: vec3f, weight_sum: f32) -> f32 {
    // The node that is weighed for it: the outermost group around it that is not looked into, or itself.
    var row = emitter_at(emitter).node;
    var top = row;
    var parent = load_emitternode(row).parent;
    while (parent != NONE) {
        let group = load_emitternode(parent);
        if (!is_near(group, point)) {
            top = parent;
        }
        parent = group.parent;
    }
    var pmf = 1.0;
    var node = load_emitternode(row);
    var weight = node_weight(node, point, normal);
    while (row != top && weight > 0.0) {
        let first_row = node.parent + EMITTERNODE_ROWS;
        let other_row = select(first_row, load_emitternode(first_row).next, row == first_row);
        let other = node_weight(load_emitternode(other_row), point, normal);
        pmf *= weight / (weight + other);
        row = node.parent;
        node = load_emitternode(row);
        weight = node_weight(node, point, normal);
    }
    return pmf * (weight / weight_sum);
}

/// The sum of all lights' estimates.
fn weigh_emitters(point: vec3f, normal: vec3f) -> f32 {
    var weight_sum = 0.0;
    for (var i = 0u; i < EMITTER_COUNT; i++) {
        weight_sum += emitter_weight(i, point, normal);
    }
    return weight_sum;
}

/// Chooses a light with a probability in proportion to its estimate.
fn choose_emitter(point: vec3f, normal: vec3f, random: f32) -> EmitterChoice {
    if (!HAS_EMITTER_CHOICE) {
        return EmitterChoice(0u, 1.0, 1.0);
    }
    if (HAS_EMITTER_TREE) {
        return choose_in_tree(point, normal, random);
    }
    let weight_sum = weigh_emitters(point, normal);
    var choice = EmitterChoice(NONE, 0.0, weight_sum);
    var left = random * weight_sum;
    for (var i = 0u; i < EMITTER_COUNT && left >= 0.0; i++) {
        let weight = emitter_weight(i, point, normal);
        left -= weight;
        if (weight > 0.0) {
            choice.emitter = i;
            choice.pmf = weight / weight_sum;
        }
    }
    return choice;
}

/// The probability with which choose_emitter finds a light, where the sum of all estimates is known.
fn emitter_pmf(emitter: u32, point: vec3f, normal: vec3f, weight_sum: f32) -> f32 {
    if (!HAS_EMITTER_CHOICE) {
        return 1.0;
    }
    if (weight_sum <= 0.0) {
        return 0.0;
    }
    if (HAS_EMITTER_TREE) {
        return tree_pmf(emitter, point, normal, weight_sum);
    }
    return emitter_weight(emitter, point, normal) / weight_sum;
}
