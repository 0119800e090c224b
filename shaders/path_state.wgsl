// Where a path is, and what steers it.

/// A path on its way.
struct PathState {
    ray: Ray,
    /// The object that the ray starts on, or NONE.
    from_object: u32,
    /// Where a surface last scattered it, and with what density; 0 after the camera or a mirror, where no light could have been sampled.
    /// Films that are passed straight through change neither.
    scattered_at: vec3f,
    scatter_pdf: f32,
    /// The normal there, and the sum of all emitters' estimates.
    scattered_normal: vec3f,
    emitter_weight_sum: f32,
    /// Segments so far; the camera ray is the first.
    segment: u32,
    alive: bool,
    /// Films at which it will still be split.
    splits: u32,
    /// Which of the ways that splits made of the path it is.
    branch: u32,
    /// About what part of the light comes through, in the wavelength where it is largest: steers Russian roulette.
    rr_throughput: f32,
}

struct Sample {
    pixel: vec2u,
    index: u32,
}

/// Four numbers in [0, 1) for a dimension of a sample.
fn numbers_of(sample: Sample, dimension: u32) -> vec4f {
    if (HAS_SOBOL_SAMPLES) {
        return sobol4(sample.pixel, sample.index, dimension, frame.seed);
    }
    return random4(sample.pixel, sample.index, dimension, frame.seed);
}

/// Dimensions of a branch of a path: more than three for each of its segments.
const BRANCH_DIMENSIONS: u32 = 128u;
/// What random numbers of a vertex are for.
const FOR_EMITTER: u32 = 0u;
const FOR_BSDF: u32 = 1u;
const FOR_ROULETTE: u32 = 2u;

/// Four random numbers for one use (`FOR_…`) at the path's present vertex.
fn random_at(sample: Sample, path: PathState, use_of: u32) -> vec4f {
    return numbers_of(sample, BRANCH_DIMENSIONS * path.branch + 3u * path.segment - 2u + use_of);
}

/// The path as a surface sends it on in a new direction, drawn with density `pdf`, or mirrored, where that is 0.
fn scatter(path: PathState, object: u32, point: SurfacePoint, direction: vec3f, pdf: f32, emitter_weight_sum: f32) -> PathState {
    var next = path;
    next.ray = Ray(point.position, direction);
    next.from_object = object;
    next.scattered_at = point.position;
    next.scatter_pdf = pdf;
    next.scattered_normal = point.normal;
    next.emitter_weight_sum = emitter_weight_sum;
    return next;
}

/// The path as it goes straight on through a film.
fn pass_through(path: PathState, object: u32, point: SurfacePoint) -> PathState {
    var through = path;
    through.ray.origin = point.position;
    through.from_object = object;
    return through;
}

/// Mirrors a direction that runs against `normal`.
fn mirrored_at(direction: vec3f, normal: vec3f) -> vec3f {
    return normalize(reflect(direction, normal));
}
