// The state of a path, and what steers it.

/// A path at its current end.
struct PathState {
    ray: Ray,
    /// The object on which the ray starts, or NONE.
    from_object: u32,
    /// Position and density of the last scattering by a surface; the density is 0 after the camera or a specular reflection, where
    /// no emitter could have been sampled. Films that transmit the path straight change neither.
    scattered_at: vec3f,
    scatter_pdf: f32,
    /// The normal there, and the sum of the weights of all emitters.
    scattered_normal: vec3f,
    emitter_weight_sum: f32,
    /// Segments so far; the camera ray is the first.
    segment: u32,
    alive: bool,
    /// Number of films at which the path will still be split.
    splits: u32,
    /// Index of the branch, among those that splits made of the path.
    branch: u32,
    /// Rough estimate of the throughput, at the wavelength where it is largest; steers Russian roulette.
    rr_throughput: f32,
}

struct Sample {
    pixel: vec2u,
    index: u32,
}

/// Returns four numbers in [0, 1) for a dimension of a sample.
fn numbers_of(sample: Sample, dimension: u32) -> vec4f {
    if (HAS_SOBOL_SAMPLES) {
        return sobol4(sample.pixel, sample.index, dimension, frame.seed);
    }
    return random4(sample.pixel, sample.index, dimension, frame.seed);
}

/// Dimensions of a branch of a path: more than three for each of its segments.
const BRANCH_DIMENSIONS: u32 = 128u;
/// The purposes of the random numbers at a vertex.
const FOR_EMITTER: u32 = 0u;
const FOR_BSDF: u32 = 1u;
const FOR_ROULETTE: u32 = 2u;

/// Returns four random numbers for one purpose (`FOR_…`) at the path's current vertex.
fn random_at(sample: Sample, path: PathState, use_of: u32) -> vec4f {
    return numbers_of(sample, BRANCH_DIMENSIONS * path.branch + 3u * path.segment - 2u + use_of);
}

/// Returns the path after scattering by a surface in a new direction, sampled with density `pdf`, or after specular reflection,
/// where that is 0.
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

/// Returns the path after straight transmission by a film.
fn pass_through(path: PathState, object: u32, point: SurfacePoint) -> PathState {
    var through = path;
    through.ray.origin = point.position;
    through.from_object = object;
    return through;
}

/// Returns a direction reflected at `normal`, which points against it.
fn mirrored_at(direction: vec3f, normal: vec3f) -> vec3f {
    return normalize(reflect(direction, normal));
}
