// Constants and structs of host and shader.
//
// Generated from crates/gpu/src/layout: edit there, then run
//     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::

/// Width and height of a workgroup, in invocations.
const WORKGROUP_SIDE: u32 = 8u;

/// Invocations of a workgroup that evaluates stacks.
const STACK_WORKGROUP: u32 = 64u;

/// Number of copies of a dispatch's batch.
const BATCH_COPIES: u32 = 2u;

/// No object or emitter.
const NONE: u32 = 4294967295u;

/// An emission is the index of its spectrum, with its light group from this bit on.
const LIGHT_GROUP_SHIFT: u32 = 24u;

/// Shape: a sphere.
const SHAPE_SPHERE: u32 = 0u;

/// Shape: an unbounded plane.
const SHAPE_PLANE: u32 = 1u;

/// Shape: a plane bounded to a rectangle.
const SHAPE_RECTANGLE: u32 = 2u;

/// Shape: a plane bounded to a disk.
const SHAPE_DISK: u32 = 3u;

/// Polarization of emitted light: the same Stokes vector in all directions.
const POLARIZED_STOKES: u32 = 0u;

/// Polarization of emitted light: a clear sky.
const POLARIZED_SKY: u32 = 1u;

/// Emitter: a sphere.
const EMITTER_SPHERE: u32 = 0u;

/// Emitter: a rectangle.
const EMITTER_RECTANGLE: u32 = 1u;

/// Emitter: a disk.
const EMITTER_DISK: u32 = 2u;

/// Emitter: environment of the same radiance from everywhere. Environment emitters have the tags from this to EMITTER_DISTANT_DISK.
const EMITTER_EVERYWHERE: u32 = 16u;

/// Emitter: environment by 1 − |h|, with h the height of the direction.
const EMITTER_HORIZON: u32 = 17u;

/// Emitter: environment by the cosine with `axis`, where it is above 0.
const EMITTER_POLE: u32 = 18u;

/// Emitter: environment by a picture, its center toward `axis`, its right half toward `tangent`.
const EMITTER_PICTURE: u32 = 19u;

/// Emitter: a disk in the sky about `axis`.
const EMITTER_DISTANT_DISK: u32 = 24u;

/// Emitter: light from the direction `axis` only. The tags of emitters with a single direction at each point are this and above.
const EMITTER_DIRECTION: u32 = 25u;

/// Emitter: a point that emits in all directions. The tags of emitters with a position are this and above.
const EMITTER_POINT: u32 = 26u;

/// Emitter: a point that emits in a cone about `axis`.
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

/// Grain: none; the surface is isotropic.
const GRAIN_NONE: u32 = 0u;

/// Grain: along a direction in space.
const GRAIN_ALONG: u32 = 1u;

/// Grain: around an axis through the object's center.
const GRAIN_AROUND: u32 = 2u;

/// Number of cosines for which a rough coat has its reflectance, equally spaced in their square roots.
const COAT_COSINES: u32 = 32u;

/// Knots of a table over facets' directions, in the square root of the cosine.
const FACET_COSINES: u32 = 32u;

/// Knots of a table over facets' directions, in the width of the slopes, where that varies.
const FACET_WIDTHS: u32 = 17u;

/// Field: the same everywhere.
const FIELD_CONSTANT: u32 = 0u;

/// Field: linear in its coordinate.
const FIELD_LINEAR: u32 = 1u;

/// Field: steps of equal width.
const FIELD_STEPS: u32 = 2u;

/// Field: the square root of a table.
const FIELD_PROFILE: u32 = 3u;

/// Field: noise carried by a flow.
const FIELD_SWIRLS: u32 = 4u;

/// Field: a picture.
const FIELD_PICTURE: u32 = 5u;

/// Field: the sum of the two values before it.
const FIELD_SUM: u32 = 6u;

/// Field: the product of the two values before it.
const FIELD_PRODUCT: u32 = 7u;

/// A field varies along the polar angle about a sphere's center.
const ALONG_POLAR_ANGLE: u32 = 0u;

/// A field varies along a line in space.
const ALONG_LINE: u32 = 1u;

/// The maximum number of values that wait for a sum or product.
const FIELD_STACK: u32 = 5u;

/// Rows of a list that are side by side in a texture.
const LIST_WIDTH: u32 = 4096u;

/// Numbers in a row of the texture of tables.
const NUMBERS_WIDTH: u32 = 4096u;

/// Texels in a row of the texture of pictures.
const TEXELS_WIDTH: u32 = 4096u;

/// Maximum thickness of a layer, nm.
const MAX_THICKNESS_NM: u32 = 100000u;

/// Steps of the flow that carries the streaks of swirls.
const WARP_STEPS: u32 = 3u;

/// Points of the integer lattice around a point, by which noise is computed.
const LATTICE_CORNERS: u32 = 8u;

/// Steps of Halley's method for a facet's slope.
const SLOPE_STEPS: u32 = 4u;

/// Terms of the series for thin layers.
const EXPONENTIAL_TERMS: u32 = 7u;

/// Most cosines at which layers on a conductor are evaluated for a vertex: the path's, the emission's, and three for a mean.
const COATING_COSINES: u32 = 5u;

/// Size of the table that distributes a pixel's samples by its filter.
const FILTER_KNOTS: u32 = 257u;

/// Size of a film's table of its reflected fraction, over the cosine.
const REFLECTED_KNOTS: u32 = 33u;

/// A factor is an index (of a spectrum, a texel or a row), with its tag from this bit on.
const FACTOR_SHIFT: u32 = 28u;

/// Factor of a path's vertex: 1.
const FACTOR_ONE: u32 = 0u;

/// Factor: a diffuse reflectance, by the index of its spectrum.
const FACTOR_DIFFUSE: u32 = 1u;

/// Factor: a diffuse reflectance, by the index of the texel that has its coefficients.
const FACTOR_TEXTURE: u32 = 2u;

/// Factor: a bare conductor, by the index of its n.
const FACTOR_INTERFACE: u32 = 3u;

/// Factor: layers on a conductor, by the row of the interface.
const FACTOR_COATING: u32 = 4u;

/// Factor: a body below a coat, by the index of the coat's n.
const FACTOR_COATED: u32 = 5u;

/// Factor: Cook's model, by the index of the facets' n.
const FACTOR_COOK: u32 = 6u;

/// Factor: a film of one non-absorbing layer with n ≥ 1, by the index of n. The tags of films are this and above.
const FACTOR_FILM: u32 = 7u;

/// Factor: a film of one layer of any index, by the index of n.
const FACTOR_LOSSY_FILM: u32 = 8u;

/// Factor: a film of one layer by two beams, by the index of n.
const FACTOR_TWO_BEAM: u32 = 9u;

/// Factor: the same with the path difference that the paper prints.
const FACTOR_TWO_BEAM_AS_PRINTED: u32 = 10u;

/// Factor: a film of several layers seen from the first, by the row of the film.
const FACTOR_STACK: u32 = 11u;

/// Factor: a film of several layers seen from the last, by the row of the film.
const FACTOR_STACK_BACK: u32 = 12u;

/// Values for a whole render.
struct Frame {
    /// Position of the camera.
    camera_origin: vec3f,
    /// Chooses the sequence of random numbers.
    seed: u32,
    /// +X of camera space: to the right in the picture.
    camera_right: vec3f,
    /// Half the picture's height: at distance 1, or in scene units when orthographic.
    half_height: f32,
    /// +Y of camera space: up in the picture.
    camera_up: vec3f,
    /// Lower end of the first band, nm.
    band_min_nm: f32,
    /// +Z of camera space: opposite to the direction of view.
    camera_back: vec3f,
    /// Width of a band, nm.
    band_width_nm: f32,
    /// Width and height of the picture in pixels.
    image_size: vec2u,
    /// Number of steps between the spectra's knots in a band.
    steps: u32,
    /// 1 where each sample draws its wavelengths, 0 where they are at the bands' centers.
    draws_wavelengths: u32,
    /// First of the numbers that are the emitter indices of the parts of the environment, including disks in the sky.
    first_environment: u32,
    /// Index of the first of the observer's three spectra.
    observer: u32,
    /// Number of film hits, the first of a path, at which it is split.
    film_splits: u32,
    /// The largest radiance of a sample in any band.
    clamp: f32,
    /// Number of bands.
    bands: u32,
    /// Radius of the camera's lens.
    lens_radius: f32,
    /// Distance of the plane in focus, along the direction of view.
    focus_distance: f32,
    /// First of the numbers that distribute a pixel's samples by its filter.
    first_filter: u32,
    /// Row of the first node of the tree of emitters.
    first_emitter_node: u32,
    /// Row after the last node of the tree of emitters.
    end_emitter_node: u32,
    /// Padding to the alignment.
    padding_1: vec2u,
    /// Weights of S1, S2 and S3 in what the camera's polarizer transmits, without those that depend on the retarder's phase.
    analyzer: vec3f,
    /// Path difference of the retarder, nm: its phase is 2π times this over the wavelength.
    retarder_nm: f32,
    /// The weights times the cosine of that phase.
    analyzer_cosine: vec3f,
    /// Padding to the alignment.
    padding_2: u32,
    /// The weights times its sine.
    analyzer_sine: vec3f,
    /// Padding to the alignment.
    padding_3: u32,
}

/// Values for one dispatch: a run of samples of one tile.
struct Batch {
    /// The tile's first pixel in the picture.
    tile_origin: vec2u,
    /// Width and height of the tile.
    tile_size: vec2u,
    /// The number of the first sample to take now.
    first_sample: u32,
    /// Samples to take now.
    sample_count: u32,
    /// Passes of the loop by which an invocation detects whether the driver has ended its loops.
    passes: u32,
    /// How many samples the sums hold already.
    taken: u32,
}

/// Values for one run over a part of a batch of stacks.
struct StackRun {
    /// Number of wavelengths.
    wavelength_count: u32,
    /// Groups of four wavelengths for which each medium has its index: all of them, or 1.
    media_groups: u32,
    /// First stack of this run.
    first_stack: u32,
    /// Number of stacks of this run.
    stack_count: u32,
    /// Index of the incident medium.
    incident: f32,
    /// Padding to the size that a uniform buffer requires.
    padding_1: u32,
    /// Padding.
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
