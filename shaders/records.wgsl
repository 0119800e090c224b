// The records of a scene, and how they are read.
//
// Generated from crates/gpu/src/layout/records.rs: edit there, then run
//     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::

/// An object that rays meet: a shape with a material.
struct Shape {
    /// Center of a sphere, rectangle or disk, or a point of a plane.
    center: vec3f,
    /// Radius of a sphere or disk.
    radius: f32,
    /// Unit normal of a plane, rectangle or disk; for a large sphere, the normal at `nearest`.
    normal: vec3f,
    /// A `SHAPE_` tag.
    kind: u32,
    /// First axis of a plane, rectangle or disk.
    tangent: vec3f,
    /// Half the width of a rectangle, along `tangent`; a disk's radius.
    half_width: f32,
    /// Second axis of a plane, rectangle or disk.
    bitangent: vec3f,
    /// Half the height of a rectangle, along `bitangent`; a disk's radius.
    half_height: f32,
    /// Point of a large sphere that is nearest to the camera.
    nearest: vec3f,
    /// Curvature of a large sphere, 1/radius; 0 for other shapes.
    curvature: f32,
    /// Index of its material.
    material: u32,
    /// Index of its emitter, or NONE.
    emitter: u32,
    /// Index of the stack of coincident surfaces that it belongs to, or NONE.
    stack: u32,
    /// Number of surfaces of the stack outside it, times 2, plus 1 where its normal points into the stack.
    sheet: u32,
}
const SHAPE_ROWS: u32 = 6u;
fn load_shape(row: u32) -> Shape {
    let row_0 = shapes_row(row + 0u);
    let row_1 = shapes_row(row + 1u);
    let row_2 = shapes_row(row + 2u);
    let row_3 = shapes_row(row + 3u);
    let row_4 = shapes_row(row + 4u);
    let row_5 = shapes_row(row + 5u);
    return Shape(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        bitcast<f32>(row_0.w),
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        row_1.w,
        vec3f(bitcast<f32>(row_2.x), bitcast<f32>(row_2.y), bitcast<f32>(row_2.z)),
        bitcast<f32>(row_2.w),
        vec3f(bitcast<f32>(row_3.x), bitcast<f32>(row_3.y), bitcast<f32>(row_3.z)),
        bitcast<f32>(row_3.w),
        vec3f(bitcast<f32>(row_4.x), bitcast<f32>(row_4.y), bitcast<f32>(row_4.z)),
        bitcast<f32>(row_4.w),
        row_5.x,
        row_5.y,
        row_5.z,
        row_5.w,
    );
}

/// An emitter, sampled or visible to paths that leave the scene. Those that are sampled come first.
struct Emitter {
    /// Center of a sphere, rectangle or disk; position of a point or spot.
    position: vec3f,
    /// An `EMITTER_` tag.
    kind: u32,
    /// Unit vector: normal of a rectangle or disk; toward a pole, a disk, a direction or a picture's center; direction of a spot.
    axis: vec3f,
    /// Radius of a sphere or disk.
    radius: f32,
    /// First axis of a rectangle or disk; toward a picture's right half.
    tangent: vec3f,
    /// Half the width of a rectangle, along `tangent`; a disk's radius.
    half_width: f32,
    /// Second axis of a rectangle or disk.
    bitangent: vec3f,
    /// Half the height of a rectangle, along `bitangent`; a disk's radius.
    half_height: f32,
    /// Its emission: spectrum and light group.
    emission: u32,
    /// Factor of its emission.
    scale: f32,
    /// Luminance, which steers the choice among emitters; 0 where it is not sampled.
    brightness: f32,
    /// Index of its object, or NONE.
    object: u32,
    /// 1 − cos of the angle with `axis` within which a spot emits fully.
    full_height: f32,
    /// 1 − cos of the angle with `axis` beyond which a spot does not emit, or at which a disk in the sky ends.
    edge_height: f32,
    /// Row of its node in the tree of emitters.
    node: u32,
    /// Row of the record of its picture, a `Panorama`; without a picture, that of its polarization, an `Polarization`, or NONE.
    record: u32,
}
const EMITTER_ROWS: u32 = 6u;
fn load_emitter(row: u32) -> Emitter {
    let row_0 = emitters_row(row + 0u);
    let row_1 = emitters_row(row + 1u);
    let row_2 = emitters_row(row + 2u);
    let row_3 = emitters_row(row + 3u);
    let row_4 = emitters_row(row + 4u);
    let row_5 = emitters_row(row + 5u);
    return Emitter(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        bitcast<f32>(row_1.w),
        vec3f(bitcast<f32>(row_2.x), bitcast<f32>(row_2.y), bitcast<f32>(row_2.z)),
        bitcast<f32>(row_2.w),
        vec3f(bitcast<f32>(row_3.x), bitcast<f32>(row_3.y), bitcast<f32>(row_3.z)),
        bitcast<f32>(row_3.w),
        row_4.x,
        bitcast<f32>(row_4.y),
        bitcast<f32>(row_4.z),
        row_4.w,
        bitcast<f32>(row_5.x),
        bitcast<f32>(row_5.y),
        row_5.z,
        row_5.w,
    );
}

/// A material. The materials come first among the records, in their order.
struct Material {
    /// A `SURFACE_` tag.
    surface: u32,
    /// Row of the record of that surface: a `Diffuse`, `Interface`, `Coated`, `Cook` or `Film`.
    record: u32,
    /// Row of its facets; NONE where it is smooth.
    facets: u32,
    /// Roughly the fraction of light that continues from it.
    albedo: f32,
    /// Its emission: spectrum and light group.
    emission: u32,
    /// Factor of its emission; 0 where it emits nothing.
    emission_scale: f32,
    /// Row of the polarization of its emission, an `Polarization`; NONE where that is unpolarized.
    polarization: u32,
    /// Padding to whole rows.
    padding: u32,
}
const MATERIAL_ROWS: u32 = 2u;
fn load_material(row: u32) -> Material {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Material(
        row_0.x,
        row_0.y,
        row_0.z,
        bitcast<f32>(row_0.w),
        row_1.x,
        bitcast<f32>(row_1.y),
        row_1.z,
        row_1.w,
    );
}

/// How emitted light is polarized.
struct Polarization {
    /// S1, S2 and S3 over S0.
    stokes: vec3f,
    /// A `POLARIZED_` tag.
    kind: u32,
    /// The reference axis, or the direction toward the sun: a unit vector.
    axis: vec3f,
    /// The degree of polarization of the sky at 90° from the sun.
    degree: f32,
}
const POLARIZATION_ROWS: u32 = 2u;
fn load_polarization(row: u32) -> Polarization {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Polarization(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        bitcast<f32>(row_1.w),
    );
}

/// A reflectance that may vary over a surface.
struct Diffuse {
    /// Spectrum: the reflectance, or that of the even squares of a checker.
    spectrum: u32,
    /// Spectrum: the reflectance of the odd squares; the same as `spectrum` without a checker.
    odd_spectrum: u32,
    /// Side of a checker's squares.
    checker_size: f32,
    /// Index of the header of the reflectance's picture; NONE where it has none.
    picture: u32,
}
const DIFFUSE_ROWS: u32 = 1u;
fn load_diffuse(row: u32) -> Diffuse {
    let row_0 = records_row(row + 0u);
    return Diffuse(
        row_0.x,
        row_0.y,
        bitcast<f32>(row_0.z),
        row_0.w,
    );
}

/// The facets of a rough surface.
struct Facets {
    /// Direction of the grain, or of the axis around which it runs.
    grain: vec3f,
    /// A `GRAIN_` tag.
    grain_kind: u32,
    /// Width of the distribution of slopes along and across the grain.
    alpha: vec2f,
    /// A `FACETS_` tag.
    distribution: u32,
    /// First number of the table of their directional albedo.
    first_energy: u32,
    /// Mean of that table over all directions.
    mean_energy: f32,
    /// First number of the table of a brushed coat's transmittance scale over direction.
    first_transmittance_scale: u32,
    /// Padding to whole rows.
    padding: vec2u,
}
const FACETS_ROWS: u32 = 3u;
fn load_facets(row: u32) -> Facets {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    let row_2 = records_row(row + 2u);
    return Facets(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec2f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y)),
        row_1.z,
        row_1.w,
        bitcast<f32>(row_2.x),
        row_2.y,
        vec2u(row_2.z, row_2.w),
    );
}

/// The boundary of a conductor, bare or below layers.
struct Interface {
    /// Spectrum: n of the conductor; its k is the next spectrum.
    spectrum: u32,
    /// Row of its first layer, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
    /// Number of layers whose thickness varies over the surface.
    varying_layers: u32,
}
const INTERFACE_ROWS: u32 = 1u;
fn load_interface(row: u32) -> Interface {
    let row_0 = records_row(row + 0u);
    return Interface(
        row_0.x,
        row_0.y,
        row_0.z,
        row_0.w,
    );
}

/// A diffuse body below a clear coat.
struct Coated {
    /// Row of the body's reflectance.
    base: u32,
    /// Spectrum: n of the coat; its k is the next spectrum.
    spectrum: u32,
    /// Spectrum: reflectance of the coat for diffuse light from outside.
    mean_reflectance: u32,
    /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
    coat_reflectances: u32,
    /// Representative index of the coat, by which a path chooses between coat and body.
    coat_estimate: f32,
    /// Representative reflectance of the body, for the same choice.
    base_estimate: f32,
    /// Padding to whole rows.
    padding: vec2u,
}
const COATED_ROWS: u32 = 2u;
fn load_coated(row: u32) -> Coated {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Coated(
        row_0.x,
        row_0.y,
        row_0.z,
        row_0.w,
        bitcast<f32>(row_1.x),
        bitcast<f32>(row_1.y),
        vec2u(row_1.z, row_1.w),
    );
}

/// A surface by the model of Cook and Torrance.
struct Cook {
    /// Spectrum: n of the facets; their k is the next spectrum.
    spectrum: u32,
    /// A `COOK_` tag.
    distribution: u32,
    /// First of the numbers of the slopes: m, weight and part of each.
    first_slope: u32,
    /// Number of slopes.
    slope_count: u32,
    /// Spectrum: the Lambertian reflectance.
    base: u32,
    /// Fraction of the Lambertian reflection.
    base_fraction: f32,
    /// Probability with which a path is scattered by the Lambertian fraction.
    base_probability: f32,
    /// Padding to whole rows.
    padding: u32,
}
const COOK_ROWS: u32 = 2u;
fn load_cook(row: u32) -> Cook {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Cook(
        row_0.x,
        row_0.y,
        row_0.z,
        row_0.w,
        row_1.x,
        bitcast<f32>(row_1.y),
        bitcast<f32>(row_1.z),
        row_1.w,
    );
}

/// A free film.
struct Film {
    /// The `FACTOR_` tag for light from the front.
    factor: u32,
    /// Row of its first layer, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
    /// Number of layers whose thickness varies over the surface.
    varying_layers: u32,
    /// First number of the table of its reflected fraction.
    first_reflected: u32,
    /// Padding to whole rows.
    padding_1: u32,
    /// Padding to whole rows.
    padding_2: vec2u,
}
const FILM_ROWS: u32 = 2u;
fn load_film(row: u32) -> Film {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Film(
        row_0.x,
        row_0.y,
        row_0.z,
        row_0.w,
        row_1.x,
        row_1.y,
        vec2u(row_1.z, row_1.w),
    );
}

/// A layer of a film or of a coating.
struct Layer {
    /// Spectrum: n; its k is the next spectrum.
    spectrum: u32,
    /// Thickness where it has no fields, nm.
    thickness_nm: f32,
    /// Row of the first of the fields of its thickness.
    first_field: u32,
    /// Number of its fields; 0 where the thickness is the same everywhere.
    field_count: u32,
}
const LAYER_ROWS: u32 = 1u;
fn load_layer(row: u32) -> Layer {
    let row_0 = records_row(row + 0u);
    return Layer(
        row_0.x,
        bitcast<f32>(row_0.y),
        row_0.z,
        row_0.w,
    );
}

/// A part of a thickness that varies.
struct Field {
    /// Direction of the pole, or start of a line.
    origin: vec3f,
    /// A `FIELD_` tag.
    kind: u32,
    /// From start to end of a line, over the square of its length.
    along: vec3f,
    /// An `ALONG_` tag.
    runs_along: u32,
    /// Value at 0: at the pole, at the start, of black; the mean of swirls.
    base: f32,
    /// Added to `base` at 1: at the other pole, at the end, of white; the amplitude of swirls.
    swing: f32,
    /// Largest value of a profile.
    most_nm: f32,
    /// Value below which a profile is a black film.
    black_below_nm: f32,
    /// Thickness of that black film.
    black_nm: f32,
    /// Cells of swirls per unit.
    cells_per_unit: f32,
    /// Octaves of swirls.
    octaves: u32,
    /// Distance by which the flow carries swirls, in cells.
    warp: f32,
    /// Width and height of a picture on a plane; 0 for its natural size.
    size: vec2f,
    /// Time of swirls within its cell.
    phase: f32,
    /// Cells that the time of swirls has passed.
    cells: u32,
    /// Selects the pattern of swirls.
    seed: u32,
    /// First of the numbers for its lookups.
    first_number: u32,
    /// Number of steps, or of knots of a profile.
    sample_count: u32,
    /// Columns of a picture.
    columns: u32,
    /// Rows of a picture.
    rows: u32,
    /// Padding to whole rows.
    padding_1: u32,
    /// Padding to whole rows.
    padding_2: vec2u,
}
const FIELD_ROWS: u32 = 7u;
fn load_field(row: u32) -> Field {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    let row_2 = records_row(row + 2u);
    let row_3 = records_row(row + 3u);
    let row_4 = records_row(row + 4u);
    let row_5 = records_row(row + 5u);
    let row_6 = records_row(row + 6u);
    return Field(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        row_1.w,
        bitcast<f32>(row_2.x),
        bitcast<f32>(row_2.y),
        bitcast<f32>(row_2.z),
        bitcast<f32>(row_2.w),
        bitcast<f32>(row_3.x),
        bitcast<f32>(row_3.y),
        row_3.z,
        bitcast<f32>(row_3.w),
        vec2f(bitcast<f32>(row_4.x), bitcast<f32>(row_4.y)),
        bitcast<f32>(row_4.z),
        row_4.w,
        row_5.x,
        row_5.y,
        row_5.z,
        row_5.w,
        row_6.x,
        row_6.y,
        vec2u(row_6.z, row_6.w),
    );
}

/// A picture of the environment, and the table by which directions are sampled.
struct Panorama {
    /// Index of its header among the texels; its pixels follow.
    head: u32,
    /// Number of texels of a pixel.
    per_pixel: u32,
    /// Number of columns of the table.
    columns: u32,
    /// Number of rows of the table.
    rows: u32,
    /// First number of the table: heights of the rows' edges from the top, cumulative probabilities of the rows, and of the cells of each row.
    first_number: u32,
    /// Density of light at the picture's mean brightness, on the scale of the density of the sampled light; 0 where all light is sampled.
    even_density: f32,
    /// Row of the polarization of its light, an `Polarization`; NONE where that is unpolarized.
    polarization: u32,
    /// Padding to whole rows.
    padding: u32,
}
const PANORAMA_ROWS: u32 = 2u;
fn load_panorama(row: u32) -> Panorama {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    return Panorama(
        row_0.x,
        row_0.y,
        row_0.z,
        row_0.w,
        row_1.x,
        bitcast<f32>(row_1.y),
        row_1.z,
        row_1.w,
    );
}

/// A node of the hierarchy of boxes around objects. Nodes are in depth-first order: the contents of a box follow it.
struct Node {
    /// The box's corner with the smallest coordinates.
    low: vec3f,
    /// Row of the node after all contents of the box.
    next: u32,
    /// The box's corner with the largest coordinates.
    high: vec3f,
    /// The object in it; NONE where it contains other nodes.
    object: u32,
}
const NODE_ROWS: u32 = 2u;
fn load_node(row: u32) -> Node {
    let row_0 = trees_row(row + 0u);
    let row_1 = trees_row(row + 1u);
    return Node(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        row_1.w,
    );
}

/// A node of the tree of emitters, in depth-first order: a group as seen from afar; or an emitter, for which only the last four fields count.
struct EmitterNode {
    /// Mean of the positions of the group's emitters.
    center: vec3f,
    /// The whole group is within this distance of the center.
    reach: f32,
    /// Unit vector about which the group emits.
    axis: vec3f,
    /// Cosine of the angle with `axis` beyond which nothing is emitted; −1 where the group emits in all directions.
    cone: f32,
    /// Power that the group emits into one of the directions in `cone`.
    power: f32,
    /// Mean square of the distance from the center.
    variance: f32,
    /// The fraction of the power that is emitted in a direction is √(`even` + `along` c²), where c is its cosine with `axis`.
    even: f32,
    /// See `even`.
    along: f32,
    /// A point nearer to the center than this weights the children of the group instead; 0 for an emitter.
    near: f32,
    /// Row of the node after all contents of the group.
    next: u32,
    /// Row of the parent group, or NONE.
    parent: u32,
    /// The emitter, or NONE for a group.
    emitter: u32,
}
const EMITTERNODE_ROWS: u32 = 4u;
fn load_emitternode(row: u32) -> EmitterNode {
    let row_0 = trees_row(row + 0u);
    let row_1 = trees_row(row + 1u);
    let row_2 = trees_row(row + 2u);
    let row_3 = trees_row(row + 3u);
    return EmitterNode(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        bitcast<f32>(row_0.w),
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        bitcast<f32>(row_1.w),
        bitcast<f32>(row_2.x),
        bitcast<f32>(row_2.y),
        bitcast<f32>(row_2.z),
        bitcast<f32>(row_2.w),
        bitcast<f32>(row_3.x),
        row_3.y,
        row_3.z,
        row_3.w,
    );
}

/// Returns a shape by its index.
fn shape_at(number: u32) -> Shape {
    return load_shape(number * SHAPE_ROWS);
}

/// Returns an emitter by its index.
fn emitter_at(number: u32) -> Emitter {
    return load_emitter(number * EMITTER_ROWS);
}

/// Returns a material by its index: materials come first among the records.
fn material_at(number: u32) -> Material {
    return load_material(number * MATERIAL_ROWS);
}
