// What a traced path records until its spectrum is evaluated.
//
// A vertex has what every path needs. Data that only some scenes need is in separate arrays, at the same index; an array that
// nothing reads is removed.

/// A point where a path met a surface, or where it ended.
struct Vertex {
    /// Factor of the throughput: a FACTOR_ tag and an index.
    factor: u32,
    /// Weight of the factor.
    weight: f32,
    /// Cosine at which the factor is evaluated: at the facet, or at a smooth surface.
    cosine: f32,
    /// Thickness of a film's only layer, nm.
    thickness_nm: f32,
    /// Emission that joins the path here: its spectrum and its light group.
    emission: u32,
    /// Weight of the emission: 0 where there is none.
    emission_weight: f32,
    /// Cosine at which the factor is evaluated where the surface scatters that emission.
    emission_cosine: f32,
    /// Films that the emission crosses on its way: their number, and from bit 12 on the index of the first.
    crossings: u32,
    /// Bits: SCATTERS_EMISSION, TRANSMITS; and the indices of waiting throughputs (`splits_to`, `resumes_from`).
    marks: u32,
}

/// The surface scatters the emission; otherwise it joins before the factor.
const SCATTERS_EMISSION: u32 = 1u;
/// The film transmits the path; otherwise it reflects the path.
const TRANSMITS: u32 = 2u;
/// One more than the index where the transmitted throughput of a film waits, from this bit on.
const SPLITS_TO: u32 = 8u;
/// One more than the index of the throughput with which the path continues, from this bit on.
const RESUMES_FROM: u32 = 16u;
/// Number of bits of the number of crossings.
const CROSSING_BITS: u32 = 12u;

/// Multiple scattering between the facets of a rough surface.
struct MultipleScattering {
    /// Weight along the path that continues.
    weight: f32,
    /// Weight of the emission that joins here.
    emission_weight: f32,
    /// Mean of the facets' albedo.
    mean_energy: f32,
}

/// The body below a coat or the base beside facets.
struct Body {
    /// Its reflectance: a FACTOR_ tag and an index.
    base: u32,
    /// The material.
    material: u32,
    /// Weights along the path that continues, and of the emission that joins here.
    weight: f32,
    emission_weight: f32,
    /// Cosines with the normal: toward the camera, toward the path's next vertex, toward the emitter sample.
    wo_cosine: f32,
    wi_cosine: f32,
    emission_wi_cosine: f32,
}

/// The reference axes of polarized light at a vertex.
struct Planes {
    /// The turn of light that continues to the camera, from the plane of incidence to the axis of the segment before: cos 2φ and sin 2φ.
    turn: vec2f,
    /// The same of emission that the surface scatters.
    emission_turn: vec2f,
    /// S1, S2 and S3, over S0, of the emission that joins here, about the axis of the segment beside the emitter.
    emission: vec3f,
}

/// A film that emission crosses on its way to a vertex.
struct Crossing {
    factor: u32,
    cosine: f32,
    thickness_nm: f32,
}

/// The path of this invocation. The sizes follow from the scene, so that none can overflow.
var<private> vertices: array<Vertex, MAX_VERTICES>;
var<private> vertex_count: u32;
var<private> multiples: array<MultipleScattering, MAX_VERTICES>;
var<private> bodies: array<Body, MAX_VERTICES>;
/// The texel of a vertex's emission, 0 where it has none.
var<private> emission_texels: array<u32, MAX_VERTICES>;
/// For a vertex with layers whose thicknesses vary, the first of them.
var<private> first_thicknesses: array<u32, MAX_VERTICES>;

/// The reference axes of the vertices, for polarized light.
var<private> vertex_planes: array<Planes, MAX_VERTICES>;

var<private> crossings: array<Crossing, MAX_CROSSINGS>;
var<private> crossing_count: u32;
var<private> crossing_thicknesses: array<u32, MAX_CROSSINGS>;
/// The axes across the planes of incidence at the crossings.
var<private> crossing_axes: array<vec3f, MAX_CROSSINGS>;
/// Turns of light from the plane of incidence at a crossing to the axis of the segment toward the vertex.
var<private> crossing_turns: array<vec2f, MAX_CROSSINGS>;

/// Thicknesses of layers where they vary over a surface, at the points of the path, nm.
var<private> thicknesses: array<f32, MAX_THICKNESSES>;
var<private> thickness_count: u32;

/// The pending vertex. All vertices are written at one place in the code: a store at an index that differs between paths compiles
/// to long code.
var<private> pending: Vertex;
var<private> pending_multiple: MultipleScattering;
var<private> pending_body: Body;
var<private> pending_texel: u32;
var<private> pending_thickness: u32;
var<private> pending_planes: Planes;
/// The reference axis of light on the current segment, toward the camera.
var<private> light_axis: vec3f;
/// Whether it contributes anything and has to be written.
var<private> is_pending: bool;

/// Whether any thickness can be in the record.
const RECORDS_THICKNESSES: bool = MAX_THICKNESSES > 1u;
/// Whether any surface has facets: their light has a part that met several of them.
const HAS_MULTIPLE_SCATTERING: bool = HAS_ROUGH_CONDUCTORS || HAS_ROUGH_COATS;

fn factor_of(tag: u32, number: u32) -> u32 {
    return (tag << FACTOR_SHIFT) | number;
}

fn factor_tag(factor: u32) -> u32 {
    return factor >> FACTOR_SHIFT;
}

fn factor_number(factor: u32) -> u32 {
    return factor & ((1u << FACTOR_SHIFT) - 1u);
}

/// Returns the spectrum of an emission, which has its light group in the bits above.
fn emission_spectrum(emission: u32) -> u32 {
    return emission & ((1u << LIGHT_GROUP_SHIFT) - 1u);
}

/// Returns the light group of an emission.
fn light_group_of(emission: u32) -> u32 {
    if (LIGHT_GROUPS == 1u) {
        return 0u;
    }
    return emission >> LIGHT_GROUP_SHIFT;
}

fn begin_record() {
    vertex_count = 0u;
    crossing_count = 0u;
    thickness_count = 0u;
    begin_vertex(0u);
    // A path that meets nothing is evaluated as one that ends at once.
    vertices[0] = pending;
}

/// Turns the axis of the current segment to another one, for light that leaves toward `wo`, and records the turn back.
fn turn_axis(axis: vec3f, wo: vec3f) {
    pending_planes.turn = turn_between(axis, light_axis, wo);
    light_axis = axis;
}

/// Begins a vertex without any effect yet; `resumes` is its RESUMES_FROM.
fn begin_vertex(resumes: u32) {
    is_pending = false;
    pending = Vertex(FACTOR_ONE, 1.0, 1.0, 0.0, 0u, 0.0, 1.0, 0u, resumes << RESUMES_FROM);
    if (HAS_MULTIPLE_SCATTERING) {
        // As for no facets, so that the color is finite for any reflectance.
        pending_multiple = MultipleScattering(0.0, 0.0, 1.0);
    }
    if (HAS_BASES) {
        pending_body = Body(FACTOR_ONE, 0u, 0.0, 0.0, 1.0, 1.0, 1.0);
    }
    if (HAS_ENVIRONMENT_PICTURE) {
        pending_texel = 0u;
    }
    if (HAS_POLARIZATION) {
        pending_planes = Planes(vec2f(1.0, 0.0), vec2f(1.0, 0.0), vec3f(0.0));
    }
}

/// Appends the pending vertex to the record, if it has any effect.
fn write_vertex() {
    if (!is_pending) {
        return;
    }
    vertices[vertex_count] = pending;
    if (HAS_MULTIPLE_SCATTERING) {
        multiples[vertex_count] = pending_multiple;
    }
    if (HAS_BASES) {
        bodies[vertex_count] = pending_body;
    }
    if (HAS_ENVIRONMENT_PICTURE) {
        emission_texels[vertex_count] = pending_texel;
    }
    if (RECORDS_THICKNESSES) {
        first_thicknesses[vertex_count] = pending_thickness;
    }
    if (HAS_POLARIZATION) {
        vertex_planes[vertex_count] = pending_planes;
    }
    vertex_count += 1u;
}

/// Adds radiance `weight` × the spectrum of `emission` to the path before the pending vertex, times the texel of its picture where
/// that is not 0.
fn add_emission(emission: u32, texel: u32, weight: f32) {
    if (weight > 0.0) {
        pending.emission = emission;
        pending.emission_weight = weight;
        is_pending = true;
        if (HAS_ENVIRONMENT_PICTURE) {
            pending_texel = texel;
        }
    }
}

fn push_crossing(crossing: Crossing, first_thickness: u32) {
    // Rounding can make a ray meet the edge of two touching films once too often; that crossing is left out.
    if (crossing_count < MAX_CROSSINGS) {
        crossings[crossing_count] = crossing;
        if (RECORDS_THICKNESSES) {
            crossing_thicknesses[crossing_count] = first_thickness;
        }
        crossing_count += 1u;
    }
}

fn push_thickness(thickness_nm: f32) {
    if (thickness_count < MAX_THICKNESSES) {
        thicknesses[thickness_count] = thickness_nm;
        thickness_count += 1u;
    }
}
