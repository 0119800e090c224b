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

/// Emitter: a sphere.
const EMITTER_SPHERE: u32 = 0u;

/// Emitter: a rectangle.
const EMITTER_RECTANGLE: u32 = 1u;

/// Emitter: a disk.
const EMITTER_DISK: u32 = 2u;

/// Emitter: environment of the same radiance from everywhere. Those of the environment are greater.
const EMITTER_EVERYWHERE: u32 = 16u;

/// Emitter: environment by 1 − |h|, with h the height of the direction.
const EMITTER_HORIZON: u32 = 17u;

/// Emitter: environment by the cosine with `axis`, where it is above 0.
const EMITTER_POLE: u32 = 18u;

/// Emitter: environment by a picture, its middle toward `axis`, its right half toward `tangent`.
const EMITTER_PICTURE: u32 = 19u;

/// Emitter: a disk in the sky about `axis`.
const EMITTER_DISTANT_DISK: u32 = 24u;

/// Emitter: light from the direction `axis` alone. Those of a single direction at each place are greater.
const EMITTER_DIRECTION: u32 = 25u;

/// Emitter: a point that shines to all sides. Those that lie at a place are greater.
const EMITTER_POINT: u32 = 26u;

/// Emitter: a point that shines about `axis`.
const EMITTER_SPOT: u32 = 27u;

/// Surface: nothing is reflected.
const SURFACE_BLACK: u32 = 0u;

/// Surface: a free film.
const SURFACE_FILM: u32 = 1u;

/// Surface: Lambertian.
const SURFACE_DIFFUSE: u32 = 2u;

/// Surface: a conductor, bare or coated, smooth or rough.
const SURFACE_INTERFACE: u32 = 3u;

/// Surface: a diffuse body below a coat, smooth or rough.
const SURFACE_COATED: u32 = 4u;

/// Surface: the model of Cook and Torrance.
const SURFACE_COOK: u32 = 5u;

/// Distribution of Cook's facets: a Gaussian of their angle (D1).
const COOK_GAUSSIAN: u32 = 0u;

/// Distribution of Cook's facets: Beckmann's (D2).
const COOK_BECKMANN: u32 = 1u;

/// Facets: Beckmann's distribution of slopes.
const FACETS_BECKMANN: u32 = 0u;

/// Facets: the distribution of Trowbridge and Reitz.
const FACETS_GGX: u32 = 1u;

/// Grain: a surface alike in all directions.
const GRAIN_NONE: u32 = 0u;

/// Grain: along a direction in space.
const GRAIN_ALONG: u32 = 1u;

/// Grain: around an axis through the object's center.
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

/// A field runs along the polar angle about a sphere's center.
const ALONG_POLAR_ANGLE: u32 = 0u;

/// A field runs along a line in space.
const ALONG_LINE: u32 = 1u;

/// The most values that wait for a sum or product.
const FIELD_STACK: u32 = 5u;

/// Rows of a list that stand side by side in a texture.
const LIST_WIDTH: u32 = 4096u;

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

/// A factor is a number (of a spectrum, a texel or a row), with its tag from this bit on.
const FACTOR_SHIFT: u32 = 28u;

/// Factor of a path's vertex: 1.
const FACTOR_ONE: u32 = 0u;

/// Factor: a diffuse reflectance, by the number of its spectrum.
const FACTOR_DIFFUSE: u32 = 1u;

/// Factor: a diffuse reflectance, by the number of the texel that has its coefficients.
const FACTOR_TEXTURE: u32 = 2u;

/// Factor: a bare conductor, by the number of its n.
const FACTOR_INTERFACE: u32 = 3u;

/// Factor: layers on a conductor, by the row of the interface.
const FACTOR_COATING: u32 = 4u;

/// Factor: a body below a coat, by the number of the coat's n.
const FACTOR_COATED: u32 = 5u;

/// Factor: Cook's model, by the number of the facets' n.
const FACTOR_COOK: u32 = 6u;

/// Factor: a film of one layer without absorption and with n ≥ 1, by the number of n. Those of films are greater.
const FACTOR_FILM: u32 = 7u;

/// Factor: a film of one layer of any index, by the number of n.
const FACTOR_LOSSY_FILM: u32 = 8u;

/// Factor: a film of one layer by two beams, by the number of n.
const FACTOR_TWO_BEAM: u32 = 9u;

/// Factor: the same with the path difference that the paper prints.
const FACTOR_TWO_BEAM_AS_PRINTED: u32 = 10u;

/// Factor: a film of several layers seen from the first, by the row of the film.
const FACTOR_STACK: u32 = 11u;

/// Factor: a film of several layers seen from the last, by the row of the film.
const FACTOR_STACK_BACK: u32 = 12u;

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
    /// 1 where each sample draws its wavelengths, 0 where they lie at the bands' centers.
    draws_wavelengths: u32,
    /// First of the numbers of the emitters that are parts of the environment, disks in the sky among them.
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
    /// The row of the first node of the tree of emitters.
    first_emitter_node: u32,
    /// The row after its last one.
    end_emitter_node: u32,
    /// Fills the size up to that of its alignment.
    padding: vec2u,
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
