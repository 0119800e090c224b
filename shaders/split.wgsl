// Where paths divide: at a film into reflection and transmission, both or one of them; and where they end by chance.

/// About the part of a film's light that it reflects, linear between the knots of its table.
fn reflected_at(material: u32, cosine: f32) -> f32 {
    let steps = REFLECTED_KNOTS - 1u;
    let place = clamp(cosine, 0.0, 1.0) * f32(steps);
    let knot = min(u32(place), steps - 1u);
    let first = load_film(material_at(material).record).first_reflected + knot;
    return mix(number_at(first), number_at(first + 1u), place - f32(knot));
}

/// The least share of the paths that follow the reflection of a film, and the least that follow its transmission: what is seen
/// faintly may be bright all the same.
const LEAST_PROBABILITY: f32 = 0.25;

/// A part of the light that is a rounding of none.
const NOTHING: f32 = 1e-9;

/// Share of the paths that follow the reflection of a film. It steers noise only: the weight undoes it. Nothing is drawn for a reflection
/// that there is none of.
fn reflection_probability(reflected: f32) -> f32 {
    if (reflected <= NOTHING) {
        return 0.0;
    }
    return clamp(reflected, LEAST_PROBABILITY, 1.0 - LEAST_PROBABILITY);
}

/// Paths that wait for the present one to end.
var<private> waiting_paths: array<PathState, MAX_SPLITS>;
var<private> waiting_count: u32;

/// Puts a path aside and returns its place.
fn wait(path: PathState) -> u32 {
    waiting_paths[waiting_count] = path;
    waiting_count += 1u;
    return waiting_count - 1u;
}

/// The path that was put aside last.
fn resume() -> PathState {
    waiting_count -= 1u;
    return waiting_paths[waiting_count];
}

/// The least chance that a path has to go on at Russian roulette, which bounds its weight.
const LEAST_SURVIVAL: f32 = 0.05;

/// Chance that a path goes on. The same for all its wavelengths, so that each is right on average.
fn rr_survival_probability(throughput: f32) -> f32 {
    return clamp(throughput, LEAST_SURVIVAL, 1.0);
}
