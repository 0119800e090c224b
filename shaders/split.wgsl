// Where paths split or end: reflection, transmission or both at a film, and Russian roulette.

/// Returns roughly the fraction of light that a film reflects, linear between the knots of its table.
fn reflected_at(material: u32, cosine: f32) -> f32 {
    let steps = REFLECTED_KNOTS - 1u;
    let place = clamp(cosine, 0.0, 1.0) * f32(steps);
    let knot = min(u32(place), steps - 1u);
    let first = load_film(material_at(material).record).first_reflected + knot;
    return mix(number_at(first), number_at(first + 1u), place - f32(knot));
}

/// The least probability of following the reflection of a film, and of following its transmission: even a weak reflection may show
/// something bright.
const MIN_PROBABILITY: f32 = 0.25;

/// A fraction of the light that is 0 up to rounding.
const NOTHING: f32 = 1e-9;

/// Returns the probability of following the reflection of a film that reflects roughly the fraction `reflected`. It affects noise
/// only: the weight divides by it. A reflection of 0 is never sampled.
fn reflection_probability(reflected: f32) -> f32 {
    if (reflected <= NOTHING) {
        return 0.0;
    }
    return clamp(reflected, MIN_PROBABILITY, 1.0 - MIN_PROBABILITY);
}

/// Paths that wait for the current one to end.
var<private> waiting_paths: array<PathState, MAX_SPLITS>;
var<private> waiting_count: u32;
/// Their reference axes of polarized light.
var<private> waiting_axes: array<vec3f, MAX_SPLITS>;

/// Puts a path aside and returns its index.
fn wait(path: PathState) -> u32 {
    waiting_paths[waiting_count] = path;
    if (HAS_POLARIZATION) {
        waiting_axes[waiting_count] = light_axis;
    }
    waiting_count += 1u;
    return waiting_count - 1u;
}

/// Returns the path that was put aside last.
fn resume() -> PathState {
    waiting_count -= 1u;
    if (HAS_POLARIZATION) {
        light_axis = waiting_axes[waiting_count];
    }
    return waiting_paths[waiting_count];
}

/// The least survival probability of a path in Russian roulette, which bounds its weight.
const MIN_SURVIVAL: f32 = 0.05;

/// Returns the survival probability of a path with the estimated throughput `throughput`. It is the same for all its wavelengths,
/// so that each is unbiased.
fn rr_survival_probability(throughput: f32) -> f32 {
    return clamp(throughput, MIN_SURVIVAL, 1.0);
}
