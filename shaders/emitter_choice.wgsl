// The choice of an emitter at a point of a surface by estimates of the contributions; among many emitters, by a tree of groups.

struct EmitterChoice {
    /// The emitter, NONE where none contributes at the point.
    emitter: u32,
    /// Probability with which it was chosen.
    pmf: f32,
    /// The sum of all weights.
    weight_sum: f32,
}

/// Fraction of the variance of the positions that is added to the squared distance, and 2/(3π), the square of the width of a
/// group's heights relative to the variance, for positions with the same spread along all axes (the reference's choice of emitters
/// has the reasons).
const SOFTENING: f32 = 0.4;
const HORIZON: f32 = 0.212206590789;
/// Tolerance of the cosine at the edge of a cone.
const EDGE: f32 = 1e-4;

/// Returns roughly the contribution of a group of emitters at a point, in the unit of emitter_weight; 0 only where no light of the
/// group can arrive: its power times the cosine over the squared distance (Pharr, Jakob and Humphreys, Physically Based Rendering,
/// 4th edition, section 12.6.3), but with the mean in place of the largest cosine.
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
    let directional = sqrt(node.even + node.along * square);
    return node.power * directional * mean_above(height, HORIZON * node.variance) / (soft * sqrt(soft));
}

/// Returns roughly the mean of max(0, h) over heights h with a mean and a squared width, without a difference of nearly equal numbers.
fn mean_above(mean: f32, width2: f32) -> f32 {
    let root = sqrt(mean * mean + width2);
    return select(0.5 * width2 / (root - mean), 0.5 * (root + mean), mean > 0.0);
}

/// Whether no direction toward a point lies in the group's cone of emission, widened by the angle that the group subtends.
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

/// Whether a point is so near to a group that its children are weighted instead.
fn is_near(node: EmitterNode, point: vec3f) -> bool {
    let toward = node.center - point;
    return dot(toward, toward) < node.near * node.near;
}

/// Returns roughly the contribution of a node of the tree of emitters at a point.
fn node_weight(node: EmitterNode, point: vec3f, normal: vec3f) -> f32 {
    if (node.emitter == NONE) {
        return group_weight(node, point, normal);
    }
    return emitter_weight(node.emitter, point, normal);
}

/// Returns the sum of the weights of the groups and emitters that a point is not near to; together they contain each emitter once.
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

/// Chooses one of those groups and emitters, and then one of the two children of a group until an emitter is reached.
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
        let fraction = weights.x / both;
        let is_first = weights.y <= 0.0 || random < fraction;
        let step = select(weights.y / both, fraction, is_first);
        random = rest_of(random, select(fraction, 0.0, is_first), step);
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

/// Returns the position of a number within the interval that begins at `before` and is `width` wide, rescaled to [0, 1).
fn rest_of(random: f32, before: f32, width: f32) -> f32 {
    return clamp((random - before) / width, 0.0, 0.99999994);
}

/// Returns the probability with which choose_in_tree chooses an emitter; `weight_sum` is the value that it returned.
fn tree_pmf(emitter: u32, point: vec3f, normal: vec3f, weight_sum: f32) -> f32 {
    // The node that is weighted for it: the outermost group around it that is not near, or the node itself.
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

/// Returns the sum of the weights of all emitters.
fn weigh_emitters(point: vec3f, normal: vec3f) -> f32 {
    var weight_sum = 0.0;
    for (var i = 0u; i < EMITTER_COUNT; i++) {
        weight_sum += emitter_weight(i, point, normal);
    }
    return weight_sum;
}

/// Chooses an emitter with a probability in proportion to its weight.
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

/// Returns the probability with which choose_emitter chooses an emitter, where the sum of all weights is known.
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
