//! Constants of both languages.

use super::declare::{Body, Declaration};
use scene::limits::{MAX_FIELD_DEPTH, THICKNESS_NM};
use scene::{CoatedBody, Estimate, FacetTable, PixelFilter};

constants! { CONSTANTS;
    /// Width and height of a workgroup, in invocations.
    pub const WORKGROUP_SIDE = 8;
    /// Invocations of a workgroup that evaluates stacks.
    pub const STACK_WORKGROUP = 64;
    /// Number of copies of a dispatch's batch.
    pub const BATCH_COPIES = 2;
    /// No object or emitter.
    pub const NONE = 0xffff_ffff;

    /// An emission is the index of its spectrum, with its light group from this bit on.
    pub const LIGHT_GROUP_SHIFT = 24;

    /// Shape: a sphere.
    pub const SHAPE_SPHERE = 0;
    /// Shape: an unbounded plane.
    pub const SHAPE_PLANE = 1;
    /// Shape: a plane bounded to a rectangle.
    pub const SHAPE_RECTANGLE = 2;
    /// Shape: a plane bounded to a disk.
    pub const SHAPE_DISK = 3;

    /// Polarization of emitted light: the same Stokes vector in all directions.
    pub const POLARIZED_STOKES = 0;
    /// Polarization of emitted light: a clear sky.
    pub const POLARIZED_SKY = 1;

    /// Emitter: a sphere.
    pub const EMITTER_SPHERE = 0;
    /// Emitter: a rectangle.
    pub const EMITTER_RECTANGLE = 1;
    /// Emitter: a disk.
    pub const EMITTER_DISK = 2;
    /// Emitter: environment of the same radiance from everywhere. Environment emitters have the tags from this to EMITTER_DISTANT_DISK.
    pub const EMITTER_EVERYWHERE = 16;
    /// Emitter: environment by 1 − |h|, with h the height of the direction.
    pub const EMITTER_HORIZON = 17;
    /// Emitter: environment by the cosine with `axis`, where it is above 0.
    pub const EMITTER_POLE = 18;
    /// Emitter: environment by a picture, its center toward `axis`, its right half toward `tangent`.
    pub const EMITTER_PICTURE = 19;
    /// Emitter: a disk in the sky about `axis`.
    pub const EMITTER_DISTANT_DISK = 24;
    /// Emitter: light from the direction `axis` only. The tags of emitters with a single direction at each point are this and above.
    pub const EMITTER_DIRECTION = 25;
    /// Emitter: a point that emits in all directions. The tags of emitters with a position are this and above.
    pub const EMITTER_POINT = 26;
    /// Emitter: a point that emits in a cone about `axis`.
    pub const EMITTER_SPOT = 27;

    /// Surface: nothing is reflected.
    pub const SURFACE_BLACK = 0;
    /// Surface: a free film.
    pub const SURFACE_FILM = 1;
    /// Surface: Lambertian.
    pub const SURFACE_DIFFUSE = 2;
    /// Surface: a conductor, bare or coated, smooth or rough.
    pub const SURFACE_INTERFACE = 3;
    /// Surface: a diffuse body below a coat, smooth or rough.
    pub const SURFACE_COATED = 4;
    /// Surface: the model of Cook and Torrance.
    pub const SURFACE_COOK = 5;

    /// Distribution of Cook's facets: a Gaussian of their angle (D1).
    pub const COOK_GAUSSIAN = 0;
    /// Distribution of Cook's facets: Beckmann's (D2).
    pub const COOK_BECKMANN = 1;

    /// Facets: Beckmann's distribution of slopes.
    pub const FACETS_BECKMANN = 0;
    /// Facets: the distribution of Trowbridge and Reitz.
    pub const FACETS_GGX = 1;
    /// Grain: none; the surface is isotropic.
    pub const GRAIN_NONE = 0;
    /// Grain: along a direction in space.
    pub const GRAIN_ALONG = 1;
    /// Grain: around an axis through the object's center.
    pub const GRAIN_AROUND = 2;
    /// Number of cosines for which a rough coat has its reflectance, equally spaced in their square roots.
    pub const COAT_COSINES = CoatedBody::COSINES as u32;
    /// Knots of a table over facets' directions, in the square root of the cosine.
    pub const FACET_COSINES = FacetTable::COSINES as u32;
    /// Knots of a table over facets' directions, in the width of the slopes, where that varies.
    pub const FACET_WIDTHS = FacetTable::WIDTHS as u32;

    /// Field: the same everywhere.
    pub const FIELD_CONSTANT = 0;
    /// Field: linear in its coordinate.
    pub const FIELD_LINEAR = 1;
    /// Field: steps of equal width.
    pub const FIELD_STEPS = 2;
    /// Field: the square root of a table.
    pub const FIELD_PROFILE = 3;
    /// Field: noise carried by a flow.
    pub const FIELD_SWIRLS = 4;
    /// Field: a picture.
    pub const FIELD_PICTURE = 5;
    /// Field: the sum of the two values before it.
    pub const FIELD_SUM = 6;
    /// Field: the product of the two values before it.
    pub const FIELD_PRODUCT = 7;
    /// A field varies along the polar angle about a sphere's center.
    pub const ALONG_POLAR_ANGLE = 0;
    /// A field varies along a line in space.
    pub const ALONG_LINE = 1;
    /// The maximum number of values that wait for a sum or product.
    pub const FIELD_STACK = MAX_FIELD_DEPTH as u32 + 1;
    /// Rows of a list that are side by side in a texture.
    pub const LIST_WIDTH = 4096;
    /// Numbers in a row of the texture of tables.
    pub const NUMBERS_WIDTH = 4096;
    /// Texels in a row of the texture of pictures.
    pub const TEXELS_WIDTH = 4096;
    /// Maximum thickness of a layer, nm.
    pub const MAX_THICKNESS_NM = THICKNESS_NM.high as u32;

    /// Steps of the flow that carries the streaks of swirls.
    pub const WARP_STEPS = 3;
    /// Points of the integer lattice around a point, by which noise is computed.
    pub const LATTICE_CORNERS = 8;
    /// Steps of Halley's method for a facet's slope.
    pub const SLOPE_STEPS = 4;
    /// Terms of the series for thin layers.
    pub const EXPONENTIAL_TERMS = 7;
    /// Most cosines at which layers on a conductor are evaluated for a vertex: the path's, the emission's, and three for a mean.
    pub const COATING_COSINES = 5;

    /// Size of the table that distributes a pixel's samples by its filter.
    pub const FILTER_KNOTS = PixelFilter::KNOTS as u32;
    /// Size of a film's table of its reflected fraction, over the cosine.
    pub const REFLECTED_KNOTS = Estimate::KNOTS as u32;

    /// A factor is an index (of a spectrum, a texel or a row), with its tag from this bit on.
    pub const FACTOR_SHIFT = 28;
    /// Factor of a path's vertex: 1.
    pub const FACTOR_ONE = 0;
    /// Factor: a diffuse reflectance, by the index of its spectrum.
    pub const FACTOR_DIFFUSE = 1;
    /// Factor: a diffuse reflectance, by the index of the texel that has its coefficients.
    pub const FACTOR_TEXTURE = 2;
    /// Factor: a bare conductor, by the index of its n.
    pub const FACTOR_INTERFACE = 3;
    /// Factor: layers on a conductor, by the row of the interface.
    pub const FACTOR_COATING = 4;
    /// Factor: a body below a coat, by the index of the coat's n.
    pub const FACTOR_COATED = 5;
    /// Factor: Cook's model, by the index of the facets' n.
    pub const FACTOR_COOK = 6;
    /// Factor: a film of one non-absorbing layer with n ≥ 1, by the index of n. The tags of films are this and above.
    pub const FACTOR_FILM = 7;
    /// Factor: a film of one layer of any index, by the index of n.
    pub const FACTOR_LOSSY_FILM = 8;
    /// Factor: a film of one layer by two beams, by the index of n.
    pub const FACTOR_TWO_BEAM = 9;
    /// Factor: the same with the path difference that the paper prints.
    pub const FACTOR_TWO_BEAM_AS_PRINTED = 10;
    /// Factor: a film of several layers seen from the first, by the row of the film.
    pub const FACTOR_STACK = 11;
    /// Factor: a film of several layers seen from the last, by the row of the film.
    pub const FACTOR_STACK_BACK = 12;
}
