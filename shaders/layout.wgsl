// Generated from crates/gpu/src/layout.rs: edit there, then run
//     PELLICLE_BLESS=1 cargo test -p pellicle-tests --test layout

/// Invocations of a workgroup along each side of the picture.
const WORKGROUP_SIDE: u32 = 8u;

/// No object, no light.
const NONE: u32 = 4294967295u;

/// A light is the number of its spectrum, with its light group from this bit on.
const LIGHT_GROUP_SHIFT: u32 = 24u;

/// Shape: a sphere.
const SHAPE_SPHERE: u32 = 0u;

/// Shape: an unbounded plane.
const SHAPE_PLANE: u32 = 1u;

/// Shape: a plane bounded to a rectangle.
const SHAPE_RECTANGLE: u32 = 2u;

/// Shape: a plane bounded to a disk.
const SHAPE_DISK: u32 = 3u;

/// Shape that no ray meets: surroundings of the same radiance from everywhere. Those that no ray meets are greater.
const SHAPE_EVERYWHERE: u32 = 16u;

/// Shape that no ray meets: surroundings by 1 − |h|, with h the height of the direction.
const SHAPE_HORIZON: u32 = 17u;

/// Shape that no ray meets: surroundings by the cosine with `normal`, where it is above 0.
const SHAPE_POLE: u32 = 18u;

/// Shape that no ray meets: surroundings by a picture, its middle towards `normal`, its right half towards `tangent`.
const SHAPE_PICTURE: u32 = 19u;

/// Shape that no ray meets: a disc in the sky about `normal`, with 1 − cos of its half angle for `radius`.
const SHAPE_DISC: u32 = 24u;

/// Shape that no ray meets: light from the direction `normal` alone. Those of a single direction at each place are greater.
const SHAPE_DIRECTION: u32 = 25u;

/// Shape that no ray meets: a point that shines to all sides. Those that lie at a place are greater.
const SHAPE_POINT: u32 = 26u;

/// Shape that no ray meets: a point that shines about `normal`: fully up to the height 1 − cos `half_width`, not beyond `half_height`.
const SHAPE_SPOT: u32 = 27u;

/// Surface: Lambertian.
const SURFACE_DIFFUSE: u32 = 0u;

/// Surface: a smooth conductor, bare or coated.
const SURFACE_MIRROR: u32 = 1u;

/// Surface: a rough conductor, bare or coated.
const SURFACE_ROUGH_CONDUCTOR: u32 = 2u;

/// Surface: a free film.
const SURFACE_FILM: u32 = 3u;

/// Surface: Cook's model with the distribution D1.
const SURFACE_COOK_D1: u32 = 4u;

/// Surface: Cook's model with the distribution D2.
const SURFACE_COOK_D2: u32 = 5u;

/// Surface: a diffuse body below a smooth coat.
const SURFACE_COATED_BODY: u32 = 6u;

/// Surface: a diffuse body below a rough coat.
const SURFACE_ROUGH_COATED_BODY: u32 = 7u;

/// Facets: Beckmann's distribution of slopes.
const FACETS_BECKMANN: u32 = 0u;

/// Facets: the distribution of Trowbridge and Reitz.
const FACETS_GGX: u32 = 1u;

/// Grain: a surface alike in all directions.
const GRAIN_NONE: u32 = 0u;

/// Grain: along a direction in space.
const GRAIN_ALONG: u32 = 1u;

/// Grain: around an axis through the object's centre.
const GRAIN_AROUND: u32 = 2u;

/// Cosines for which a rough coat has its reflectance, even in their roots.
const COAT_COSINES: u32 = 32u;

/// Knots of a table over facets' directions over the root of the cosine.
const FACET_COSINES: u32 = 32u;

/// Knots of a table over facets' directions over the width of the slopes, where that differs.
const FACET_WIDTHS: u32 = 17u;

/// Field: the same everywhere.
const FIELD_CONSTANT: u32 = 0u;

/// Field: linear in what it runs along.
const FIELD_LINEAR: u32 = 1u;

/// Field: steps of equal width.
const FIELD_STEPS: u32 = 2u;

/// Field: the root of a table.
const FIELD_PROFILE: u32 = 3u;

/// Field: noise carried along by a flow.
const FIELD_SWIRLS: u32 = 4u;

/// Field: a picture.
const FIELD_PICTURE: u32 = 5u;

/// Field: the sum of the two values before it.
const FIELD_SUM: u32 = 6u;

/// Field: the product of the two values before it.
const FIELD_PRODUCT: u32 = 7u;

/// A field runs along the polar angle about a sphere's centre.
const ALONG_POLAR_ANGLE: u32 = 0u;

/// A field runs along a line in space.
const ALONG_LINE: u32 = 1u;

/// The most values that wait for a sum or product.
const FIELD_STACK: u32 = 5u;

/// Numbers in a row of the texture of tables.
const NUMBERS_WIDTH: u32 = 4096u;

/// Texels in a row of the texture of pictures.
const TEXELS_WIDTH: u32 = 4096u;

/// No layer is thicker, nm.
const MAX_THICKNESS_NM: u32 = 100000u;

/// Numbers of the table that spreads a pixel's samples by its filter.
const FILTER_KNOTS: u32 = 257u;

/// Numbers of a film's table of what it reflects, over the cosine.
const REFLECTED_KNOTS: u32 = 33u;

/// Spectral factor of a path's vertex: 1.
const FACTOR_ONE: u32 = 0u;

/// Spectral factor: a reflectance from a table.
const FACTOR_REFLECTANCE: u32 = 1u;

/// Spectral factor: Fresnel reflectance of a conductor.
const FACTOR_CONDUCTOR: u32 = 2u;

/// Spectral factor: reflectance of layers on a conductor.
const FACTOR_COATED: u32 = 3u;

/// Spectral factor: a smooth reflectance, by the number of a texel.
const FACTOR_SMOOTH: u32 = 4u;

/// Spectral factor: reflectance of a film of one layer without absorption. Those of films are greater.
const FACTOR_FILM_REFLECTS: u32 = 5u;

/// Spectral factor: transmittance of a film of one layer without absorption.
const FACTOR_FILM_TRANSMITS: u32 = 6u;

/// Spectral factor: reflectance of a film of one layer of any index.
const FACTOR_LOSSY_FILM_REFLECTS: u32 = 7u;

/// Spectral factor: transmittance of a film of one layer of any index.
const FACTOR_LOSSY_FILM_TRANSMITS: u32 = 8u;

/// Spectral factor: reflectance of a film of several layers, seen from the first.
const FACTOR_STACK_REFLECTS: u32 = 9u;

/// Spectral factor: reflectance of a film of several layers, seen from the last.
const FACTOR_STACK_REFLECTS_BACK: u32 = 10u;

/// Spectral factor: transmittance of a film of several layers, the same from both sides.
const FACTOR_STACK_TRANSMITS: u32 = 11u;

/// Spectral factor: reflectance of a film by two beams.
const FACTOR_TWO_BEAM_REFLECTS: u32 = 12u;

/// Spectral factor: transmittance of a film without interference.
const FACTOR_TWO_BEAM_TRANSMITS: u32 = 13u;

/// Film: one layer without absorption and with n ≥ 1 everywhere, for which the short formula holds.
const FILM_TRANSPARENT: u32 = 0u;

/// Film: one layer of any index.
const FILM_LOSSY: u32 = 1u;

/// Film: several layers.
const FILM_STACK: u32 = 2u;

/// Film: one layer, by two beams.
const FILM_TWO_BEAM: u32 = 3u;

/// Film: one layer, by two beams with the path difference that the paper prints.
const FILM_TWO_BEAM_AS_PRINTED: u32 = 4u;

/// What holds for a whole render.
struct Frame {
    /// Where the camera stands.
    camera_origin: vec3f,
    /// Chooses the sequence of random numbers.
    seed: u32,
    /// +X of camera space: to the right in the picture.
    camera_right: vec3f,
    /// Half the picture's height: at distance 1, or in scene units when orthographic.
    half_height: f32,
    /// +Y of camera space: upwards in the picture.
    camera_up: vec3f,
    /// Lower end of the first band, nm.
    band_min_nm: f32,
    /// +Z of camera space: away from what is looked at.
    camera_back: vec3f,
    /// Width of a band, nm.
    band_width_nm: f32,
    /// Width and height of the picture in pixels.
    image_size: vec2u,
    /// Steps that a band is divided into by the spectra's knots.
    steps: u32,
    /// 1 where each sample draws its wavelengths, 0 where they lie at the bands' centres.
    draws_wavelengths: u32,
    /// First of the objects that are parts of the surroundings, discs in the sky among them.
    first_environment: u32,
    /// First of the observer's three spectra.
    observer: u32,
    /// Film hits, the first of a path, at which it is split.
    film_splits: u32,
    /// The largest radiance that a sample may bring in any band.
    clamp: f32,
    /// Number of bands.
    bands: u32,
    /// Radius of the camera's lens.
    lens_radius: f32,
    /// Distance of the plane that the lens shows sharply, along the direction of view.
    focus_distance: f32,
    /// First of the numbers that spread a pixel's samples by its filter.
    first_filter: u32,
}

/// What holds for one dispatch: a run of samples of one tile.
struct Batch {
    /// The tile's first pixel in the picture.
    tile_origin: vec2u,
    /// Width and height of the tile.
    tile_size: vec2u,
    /// Samples that were taken before.
    first_sample: u32,
    /// Samples to take now.
    sample_count: u32,
    /// Passes of the loop by which an invocation finds out whether the driver has ended its loops.
    passes: u32,
    /// Fills the size up to what a uniform buffer asks for.
    padding: u32,
}

/// A shape made of a material.
struct Object {
    /// Centre of a sphere, rectangle or disk, a point of a plane.
    center: vec3f,
    /// Radius of a sphere or disk.
    radius: f32,
    /// Unit normal of a plane, rectangle or disk.
    normal: vec3f,
    /// A `SHAPE_` tag.
    shape: u32,
    /// First axis of a plane, rectangle or disk.
    tangent: vec3f,
    /// Half the width of a rectangle, along `tangent`; a disk's radius.
    half_width: f32,
    /// Second axis of a plane, rectangle or disk.
    bitangent: vec3f,
    /// Half the height of a rectangle, along `bitangent`; a disk's radius.
    half_height: f32,
    /// Index of its material.
    material: u32,
    /// Whether light can be sent from it: 1 or 0.
    is_light: u32,
    /// The light that has this object's number is the object `light`; NONE past the last light.
    light: u32,
    /// How bright its light is to the eye; steers the choice among lights.
    brightness: f32,
}

/// What a surface is made of.
struct Material {
    /// Direction of a surface's grain, or of the axis that it runs around.
    grain: vec3f,
    /// A `GRAIN_` tag.
    grain_kind: u32,
    /// Width of the distribution of slopes along and across the grain.
    alpha: vec2f,
    /// A `FACETS_` tag.
    facets: u32,
    /// First number of the table of energy of its facets.
    first_energy: u32,
    /// A `SURFACE_` tag.
    surface: u32,
    /// Spectrum: reflectance (even squares of a checker), or n of an index, whose k is the next one.
    spectrum: u32,
    /// Spectrum: reflectance of the odd squares; the same as `spectrum` without a checker.
    odd_spectrum: u32,
    /// Side of a checker's squares.
    checker_size: f32,
    /// Mean of that table over all directions.
    mean_energy: f32,
    /// A `FILM_` tag, of a film.
    film: u32,
    /// Light that it emits.
    emission: u32,
    /// Factor of what it emits; 0 where it emits nothing.
    emission_scale: f32,
    /// First of its layers, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
    /// 1 where it reflects nothing, so that a path ends.
    is_black: u32,
    /// Number of its layers whose thickness varies over the surface.
    varying_layers: u32,
    /// The head of the picture of its reflectance; NONE where that is no picture.
    picture: u32,
    /// Spectrum: n of the index above a diffuse base, whose k is the next one.
    coat: u32,
    /// The part of the light that a base reflects beside the facets of Cook's model.
    base_share: f32,
    /// Share of the paths that follow what the base reflects; of a coated body, what stands for its reflectance there.
    base_chance: f32,
    /// First of the numbers of the slopes of Cook's model: m, weight and part of each.
    first_slope: u32,
    /// Number of these slopes.
    slope_count: u32,
    /// Spectrum: reflectance of a coat for diffuse light from outside.
    mean_reflectance: u32,
    /// What stands for the index of a coat where a path chooses its way.
    coat_estimate: f32,
    /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
    coat_reflectances: u32,
    /// First of a film's numbers that tell what it reflects.
    first_reflected: u32,
    /// About the part of the light that goes on from it.
    albedo: f32,
    /// First number of the table by which a brushed coat lets more through in some directions.
    first_passage: u32,
}

/// A layer of a film or of a coating.
struct Layer {
    /// Spectrum: n of its index, whose k is the next one.
    spectrum: u32,
    /// Thickness where it has no fields, nm.
    thickness_nm: f32,
    /// First of the fields that its thickness is made of.
    first_field: u32,
    /// Number of its fields; 0 where the thickness is the same everywhere.
    field_count: u32,
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

/// What holds for one run over a part of a batch of stacks.
struct StackRun {
    /// Number of wavelengths.
    wavelength_count: u32,
    /// Groups of four wavelengths for which each medium has its index: all of them, or 1.
    media_groups: u32,
    /// First stack of this run.
    first_stack: u32,
    /// Number of stacks of this run.
    stack_count: u32,
    /// Index of the medium that light comes from.
    incident: f32,
    /// Fills the size up to what a uniform buffer asks for.
    padding_1: u32,
    /// Fills the size up.
    padding_2: vec2u,
}

/// A layer of a stack of a batch.
struct RunLayer {
    /// Its medium.
    medium: u32,
    /// Its thickness, nm.
    thickness_nm: f32,
}

/// A stack of a batch.
struct RunStack {
    /// The medium below its layers.
    substrate: u32,
    /// First of its layers, the outermost.
    first_layer: u32,
    /// Number of its layers.
    layer_count: u32,
}
