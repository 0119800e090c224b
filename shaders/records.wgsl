// The records of a scene, and how they are read. Generated from crates/gpu/src/layout.rs: edit there, then run
//     PELLICLE_BLESS=1 cargo test -p pellicle-tests --test layout

/// What rays meet: a shape made of a material.
struct Shape {
    /// Center of a sphere, rectangle or disk, a point of a plane.
    center: vec3f,
    /// Radius of a sphere or disk.
    radius: f32,
    /// Unit normal of a plane, rectangle or disk; of a large sphere that at its `bitangent`.
    normal: vec3f,
    /// A `SHAPE_` tag.
    kind: u32,
    /// First axis of a plane, rectangle or disk.
    tangent: vec3f,
    /// Half the width of a rectangle, along `tangent`; a disk's radius; of a large sphere its curvature, 1/radius.
    half_width: f32,
    /// Second axis of a plane, rectangle or disk; of a large sphere its point nearest to the camera.
    bitangent: vec3f,
    /// Half the height of a rectangle, along `bitangent`; a disk's radius.
    half_height: f32,
    /// Number of its material.
    material: u32,
    /// Number of the emitter that it is, or NONE.
    emitter: u32,
    /// Number of the stack of coincident surfaces that it lies in, or NONE.
    stack: u32,
    /// How many surfaces of the stack lie outside it, times 2, and 1 where its normal points into the stack.
    sheet: u32,
}
const SHAPE_ROWS: u32 = 5u;
fn load_shape(row: u32) -> Shape {
    let row_0 = shapes_row(row + 0u);
    let row_1 = shapes_row(row + 1u);
    let row_2 = shapes_row(row + 2u);
    let row_3 = shapes_row(row + 3u);
    let row_4 = shapes_row(row + 4u);
    return Shape(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        bitcast<f32>(row_0.w),
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        row_1.w,
        vec3f(bitcast<f32>(row_2.x), bitcast<f32>(row_2.y), bitcast<f32>(row_2.z)),
        bitcast<f32>(row_2.w),
        vec3f(bitcast<f32>(row_3.x), bitcast<f32>(row_3.y), bitcast<f32>(row_3.z)),
        bitcast<f32>(row_3.w),
        row_4.x,
        row_4.y,
        row_4.z,
        row_4.w,
    );
}

/// What light is sampled from, or comes from where a path leaves the scene. Those that are sampled stand first.
struct Emitter {
    /// Center of a sphere, rectangle or disk; where a point or spot stands.
    position: vec3f,
    /// An `EMITTER_` tag.
    kind: u32,
    /// Unit vector: normal of a rectangle or disk, toward a pole, a disk, a direction or a picture's middle, where a spot shines to.
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
    /// Its light: spectrum and light group.
    emission: u32,
    /// Factor of its light.
    scale: f32,
    /// How bright it is to the eye, which steers the choice among emitters; 0 where it is not sampled.
    brightness: f32,
    /// The object that it is, or NONE.
    object: u32,
    /// 1 − cos of the angle with `axis` within which a spot shines fully.
    full_height: f32,
    /// 1 − cos of the angle with `axis` beyond which a spot does not shine, or a disk in the sky ends.
    edge_height: f32,
    /// The row of its node in the tree of emitters.
    node: u32,
    /// The row of a picture of the environment among the records: a `Panorama`. NONE where it is no picture.
    picture: u32,
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

/// What a surface is made of: those of all materials stand first among the records, in the materials' order.
struct Material {
    /// A `SURFACE_` tag.
    surface: u32,
    /// The row of what that surface has: a `Diffuse`, `Interface`, `Coated`, `Cook` or `Film`.
    record: u32,
    /// The row of its facets; NONE where it is smooth.
    facets: u32,
    /// About the part of the light that goes on from it.
    albedo: f32,
    /// Light that it emits.
    emission: u32,
    /// Factor of what it emits; 0 where it emits nothing.
    emission_scale: f32,
    /// Fills the last row.
    padding: vec2u,
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
        vec2u(row_1.z, row_1.w),
    );
}

/// A reflectance that may vary over a surface.
struct Diffuse {
    /// Spectrum: the reflectance, of the even squares of a checker.
    spectrum: u32,
    /// Spectrum: the reflectance of the odd squares; the same as `spectrum` without a checker.
    odd_spectrum: u32,
    /// Side of a checker's squares.
    checker_size: f32,
    /// The head of the picture of the reflectance; NONE where that is no picture.
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
    /// Direction of the grain, or of the axis that it runs around.
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
    /// First number of the table by which a brushed coat lets more through in some directions.
    first_transmittance_scale: u32,
    /// Fills the last row.
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
    /// Spectrum: n of the conductor, whose k is the next one.
    spectrum: u32,
    /// The row of its first layer, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
    /// Number of those whose thickness varies over the surface.
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
    /// The row of the body's reflectance.
    base: u32,
    /// Spectrum: n of the coat, whose k is the next one.
    spectrum: u32,
    /// Spectrum: reflectance of the coat for diffuse light from outside.
    mean_reflectance: u32,
    /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
    coat_reflectances: u32,
    /// What stands for the coat's index where a path chooses its way.
    coat_estimate: f32,
    /// What stands for the body's reflectance there.
    base_estimate: f32,
    /// Fills the last row.
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
    /// Spectrum: n of the facets, whose k is the next one.
    spectrum: u32,
    /// A `COOK_` tag.
    distribution: u32,
    /// First of the numbers of the slopes: m, weight and part of each.
    first_slope: u32,
    /// Number of slopes.
    slope_count: u32,
    /// Spectrum: what is reflected evenly.
    base: u32,
    /// The part of the light that is reflected so.
    base_share: f32,
    /// Probability with which a path is scattered so.
    base_probability: f32,
    /// Fills the last row.
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
    /// The `FACTOR_` tag of what it does to light from the front.
    factor: u32,
    /// The row of its first layer, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
    /// Number of those whose thickness varies over the surface.
    varying_layers: u32,
    /// First of the numbers that tell about what it reflects.
    first_reflected: u32,
    /// Fills the last row.
    padding_1: u32,
    /// Fills the last row.
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
    /// Spectrum: n of its index, whose k is the next one.
    spectrum: u32,
    /// Thickness where it has no fields, nm.
    thickness_nm: f32,
    /// The row of the first of the fields that its thickness is made of.
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
    /// The pole's direction, or where a line starts.
    origin: vec3f,
    /// A `FIELD_` tag.
    kind: u32,
    /// From start to end of a line, over the square of its length.
    along: vec3f,
    /// An `ALONG_` tag.
    runs_along: u32,
    /// Value at 0: at the pole, at the start, of black, the mean of swirls; thickness of the black film of a profile.
    base: f32,
    /// Added to it at 1: at the other pole, at the end, of white, the amplitude of swirls; the largest value of a profile.
    swing: f32,
    /// A profile is a black film below it; cells of swirls per unit.
    threshold: f32,
    /// Distance by which swirls are carried, in cells.
    warp: f32,
    /// Width and height of a picture on a plane; 0 for its natural size.
    size: vec2f,
    /// Time of swirls within its cell.
    phase: f32,
    /// Cells that the time of swirls has passed through.
    cells: u32,
    /// Chooses the pattern of swirls.
    seed: u32,
    /// First of the numbers that it looks up.
    first_number: u32,
    /// Steps, knots of a profile, pixels of a row; octaves of swirls.
    sample_count: u32,
    /// Rows of a picture.
    rows: u32,
}
const FIELD_ROWS: u32 = 5u;
fn load_field(row: u32) -> Field {
    let row_0 = records_row(row + 0u);
    let row_1 = records_row(row + 1u);
    let row_2 = records_row(row + 2u);
    let row_3 = records_row(row + 3u);
    let row_4 = records_row(row + 4u);
    return Field(
        vec3f(bitcast<f32>(row_0.x), bitcast<f32>(row_0.y), bitcast<f32>(row_0.z)),
        row_0.w,
        vec3f(bitcast<f32>(row_1.x), bitcast<f32>(row_1.y), bitcast<f32>(row_1.z)),
        row_1.w,
        bitcast<f32>(row_2.x),
        bitcast<f32>(row_2.y),
        bitcast<f32>(row_2.z),
        bitcast<f32>(row_2.w),
        vec2f(bitcast<f32>(row_3.x), bitcast<f32>(row_3.y)),
        bitcast<f32>(row_3.z),
        row_3.w,
        row_4.x,
        row_4.y,
        row_4.z,
        row_4.w,
    );
}

/// A picture of the environment, and the table by which directions are drawn.
struct Panorama {
    /// Where it is among the texels: the head, then its pixels.
    head: u32,
    /// Texels of a pixel.
    per_pixel: u32,
    /// Columns of the table.
    columns: u32,
    /// Rows of the table.
    rows: u32,
    /// First of the numbers of the table: heights of the rows' edges from the top, running probability of the rows, and of the cells of each row.
    first_number: u32,
    /// The density that light as bright as the picture's mean would have beside the light that is sent for; 0 where that is all light.
    even_density: f32,
    /// Fills the last row.
    padding: vec2u,
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
        vec2u(row_1.z, row_1.w),
    );
}

/// A node of the hierarchy of boxes around objects. Nodes stand depth first: what a box holds follows it.
struct Node {
    /// The box's corner with the smallest coordinates.
    low: vec3f,
    /// The row of the node after all that the box holds.
    next: u32,
    /// The box's corner with the largest coordinates.
    high: vec3f,
    /// The object that it holds; NONE where that is other nodes.
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

/// A node of the tree of emitters, depth first: a group as seen from afar; or an emitter, of which only the last four count.
struct EmitterNode {
    /// Mean of the places of what the group holds.
    center: vec3f,
    /// All that the group holds is within this distance of the center.
    reach: f32,
    /// Unit vector about which the group shines.
    axis: vec3f,
    /// Cosine of the angle with `axis` beyond which nothing shines; −1 where the group shines to all sides.
    cone: f32,
    /// What the group sends into one of the directions in `cone`.
    power: f32,
    /// Mean square of the distance from the center.
    variance: f32,
    /// The share of the power that is sent into a direction is √(`even` + `along` c²), where c is its cosine with `axis`.
    even: f32,
    /// See `even`.
    along: f32,
    /// From points nearer to the center than this the group is looked into; 0 of an emitter.
    near: f32,
    /// The row of the node after all that the group holds.
    next: u32,
    /// The row of the group that holds it, or NONE.
    parent: u32,
    /// The emitter, or NONE of a group.
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

/// What rays meet, by its number.
fn shape_at(number: u32) -> Shape {
    return load_shape(number * SHAPE_ROWS);
}

/// An emitter by its number.
fn emitter_at(number: u32) -> Emitter {
    return load_emitter(number * EMITTER_ROWS);
}

/// A material by its number: they come first among the records.
fn material_at(number: u32) -> Material {
    return load_material(number * MATERIAL_ROWS);
}
