// A path on its way through the scene.

/// A path on its way.
struct Walk {
    ray: Ray,
    /// The object that the ray starts on, or NONE.
    from_object: u32,
    /// Where a surface last scattered it, and with what density; 0 after the camera or a mirror, where
    /// no light could have been sent to. Films that are passed straight through change neither.
    scattered_at: vec3f,
    scatter_pdf: f32,
    /// The normal there, and the sum of all lights' estimates.
    scattered_normal: vec3f,
    estimates: f32,
    /// Segments so far; the camera ray is the first.
    segment: u32,
    alive: bool,
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

/// Four random numbers for the light (`use_of` 0) or the scattering (1) at the walk's present vertex.
fn random_at(sample: Sample, walk: Walk, use_of: u32) -> vec4f {
    return numbers_of(sample, 2u * walk.segment - 1u + use_of);
}

/// The walk as it goes on from `point` in a new direction.
fn walk_on(walk: Walk, object: u32, point: SurfacePoint, direction: vec3f, pdf: f32, estimates: f32) -> Walk {
    let ray = Ray(point.position, direction);
    return Walk(ray, object, point.position, pdf, point.normal, estimates, walk.segment, true);
}

/// Mirrors a direction that runs against `normal`.
fn mirrored(direction: vec3f, normal: vec3f) -> vec3f {
    return normalize(reflect(direction, normal));
}
