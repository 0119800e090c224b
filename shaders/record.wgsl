// What a traced path remembers until its spectrum is evaluated.

/// A factor that depends on wavelength.
struct Factor {
    /// A FACTOR_ tag.
    kind: u32,
    /// Its spectrum: a reflectance, or n of an index, whose k is the next one. Of layers, the material that has them.
    spectrum: u32,
    /// Cosine at the surface or facet.
    cosine: f32,
    /// Thickness of a film's only layer.
    thickness_nm: f32,
    /// Of several layers: the first of the thicknesses that vary over the surface.
    first_thickness: u32,
}

/// How a surface scatters between two directions: weights of the spectra that it has.
struct Lobes {
    /// Of the vertex's factor at `cosine`: light that met the surface once.
    single: f32,
    /// Of the colour of light that met several facets of a rough surface.
    multiple: f32,
    /// Of the colour of the base below a coat.
    body: f32,
    /// Cosine at the facet, or at a smooth surface.
    cosine: f32,
    /// Cosine of the light with the surface's normal.
    light_cosine: f32,
}

/// A place where a path met a surface, or where it ended.
struct Vertex {
    /// What the path meets here; its cosine is that of `onward`.
    scatter: Factor,
    /// The material of what scatters.
    material: u32,
    /// Cosine of the path's arrival with the surface's normal.
    eye_cosine: f32,
    /// Reflectance of what lies below a coat or beside facets.
    base: u32,
    /// Its FACTOR_ tag.
    base_kind: u32,
    /// What the path is multiplied by here.
    onward: Lobes,
    /// Radiance that joins the path here, before the factor: a light, and its texel where it has a picture (0 where it has none).
    emission: u32,
    emission_texel: u32,
    emission_weight: f32,
    /// Radiance sent from a light, by `connected` and through the films in between.
    connection: u32,
    connection_texel: u32,
    connected: Lobes,
    first_crossing: u32,
    end_crossing: u32,
    /// Where a film splits the path, the place where the light that it transmits waits; of a vertex that does nothing, the
    /// place from which the path goes on; NONE elsewhere.
    waiting: u32,
}

const NO_LOBES: Lobes = Lobes(0.0, 0.0, 0.0, 1.0, 1.0);

/// What only the factor scatters.
fn single_lobe(weight: f32, cosine: f32) -> Lobes {
    return Lobes(weight, 0.0, 0.0, cosine, 1.0);
}

fn scaled(lobes: Lobes, factor: f32) -> Lobes {
    return Lobes(lobes.single * factor, lobes.multiple * factor, lobes.body * factor, lobes.cosine, lobes.light_cosine);
}

/// Sum of the weights.
fn weight_of(lobes: Lobes) -> f32 {
    return lobes.single + lobes.multiple + lobes.body;
}

/// Whether anything is scattered.
fn is_lit(lobes: Lobes) -> bool {
    return lobes.single > 0.0 || lobes.multiple > 0.0 || lobes.body > 0.0;
}

/// The spectrum of a light. A light has its light group in the bits above it.
fn light_spectrum(light: u32) -> u32 {
    return light & ((1u << LIGHT_GROUP_SHIFT) - 1u);
}

/// The light group of a light.
fn light_group_of(light: u32) -> u32 {
    if (LIGHT_GROUPS == 1u) {
        return 0u;
    }
    return light >> LIGHT_GROUP_SHIFT;
}

/// The path of this invocation. MAX_VERTICES and MAX_CROSSINGS follow from the scene, so that neither can overflow.
var<private> vertices: array<Vertex, MAX_VERTICES>;
var<private> vertex_count: u32;
/// Films that connections pass through.
var<private> crossings: array<Factor, MAX_CROSSINGS>;
var<private> crossing_count: u32;
/// Thicknesses of layers where they vary over a surface, at the points of the path, nm.
var<private> thicknesses: array<f32, MAX_THICKNESSES>;
var<private> thickness_count: u32;

fn begin_record() {
    vertex_count = 0u;
    crossing_count = 0u;
    thickness_count = 0u;
}

/// A vertex that does nothing yet.
fn plain_vertex() -> Vertex {
    let one = Factor(FACTOR_ONE, 0u, 1.0, 0.0, 0u);
    return Vertex(one, 0u, 1.0, 0u, FACTOR_ONE, NO_LOBES, 0u, 0u, 0.0, 0u, 0u, NO_LOBES, crossing_count, crossing_count, NONE);
}

fn push_vertex(vertex: Vertex) {
    vertices[vertex_count] = vertex;
    vertex_count += 1u;
}

/// Records that the path goes on from where it was split.
fn push_return(waiting: u32) {
    var vertex = plain_vertex();
    vertex.waiting = waiting;
    push_vertex(vertex);
}

fn push_crossing(crossing: Factor) {
    // Rounding can make a ray meet the edge of two touching films once too often; that crossing is left out.
    if (crossing_count < MAX_CROSSINGS) {
        crossings[crossing_count] = crossing;
        crossing_count += 1u;
    }
}

fn push_thickness(thickness_nm: f32) {
    if (thickness_count < MAX_THICKNESSES) {
        thicknesses[thickness_count] = thickness_nm;
        thickness_count += 1u;
    }
}

/// Radiance `weight` × the spectrum of `light`, and of a texel of its picture where that is not 0, that joins at the path's end.
fn push_emission(light: u32, texel: u32, weight: f32) {
    if (weight <= 0.0) {
        return;
    }
    var vertex = plain_vertex();
    vertex.emission = light;
    vertex.emission_texel = texel;
    vertex.emission_weight = weight;
    push_vertex(vertex);
}
