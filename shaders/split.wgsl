// Where paths divide: at a film into reflection and transmission, both or one of them; and where they end by chance.

/// About the part of a film's light that it reflects, linear between the knots of its table.
fn reflected_part(material: u32, cosine: f32) -> f32 {
    let steps = REFLECTED_KNOTS - 1u;
    let place = clamp(cosine, 0.0, 1.0) * f32(steps);
    let knot = min(u32(place), steps - 1u);
    let first = materials[material].first_reflected + knot;
    return mix(number_at(first), number_at(first + 1u), place - f32(knot));
}

/// The least share of the paths that follow the reflection of a film, and the least that follow its transmission: what is seen
/// faintly may be bright all the same.
const LEAST_SHARE: f32 = 0.25;

/// Share of the paths that follow the reflection of a film. It steers noise only: the weight undoes it.
fn reflected_share(reflected: f32) -> f32 {
    return clamp(reflected, LEAST_SHARE, 1.0 - LEAST_SHARE);
}

/// Walks that wait for the present one to end.
var<private> waiting_walks: array<Walk, MAX_SPLITS>;
var<private> waiting_count: u32;

/// Puts a walk aside and returns its place.
fn wait(walk: Walk) -> u32 {
    waiting_walks[waiting_count] = walk;
    waiting_count += 1u;
    return waiting_count - 1u;
}

/// The least chance that a path has to go on at Russian roulette, which bounds its weight.
const LEAST_CHANCE: f32 = 0.05;

/// Chance that a path goes on. The same for all its wavelengths, so that each is right on average.
fn chance_to_go_on(throughput: f32) -> f32 {
    return clamp(throughput, LEAST_CHANCE, 1.0);
}

/// Russian roulette: ends the walk by chance, or lets its last vertex count for more.
fn play_roulette(walk: Walk, sample: Sample) -> Walk {
    let chance = chance_to_go_on(walk.throughput);
    var next = walk;
    if (chance < 1.0) {
        next.alive = random_at(sample, walk, FOR_ROULETTE).x < chance;
        next.throughput /= chance;
        let last = vertex_count - 1u;
        vertices[last].onward = scaled(vertices[last].onward, 1.0 / chance);
    }
    return next;
}
