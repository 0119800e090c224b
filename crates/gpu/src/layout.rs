//! The contents of the buffers that host and shader share, defined once.
//!
//! The macros below take documented Rust types, prove at compile time that Rust places every field where WGSL expects it, and
//! generate the text of `shaders/layout.wgsl` and `shaders/records.wgsl`. Those files are committed, and a test checks that they
//! are up to date.

use scene::limits::{MAX_FIELD_DEPTH, THICKNESS_NM};
use scene::{CoatedBody, Estimate, FacetTable, PixelFilter};

/// A type with the same bytes in Rust and in WGSL (WGSL specification, section 14.4.1).
trait Shared {
    const NAME: &'static str;
    const ALIGN: usize;
    const SIZE: usize;
    /// Whether a record's loader turns the bits of its words into floats.
    const IS_FLOAT: bool;
}

macro_rules! shared {
    ($($rust:ty = $name:literal, $align:literal, $size:literal, $is_float:literal;)*) => {
        $(impl Shared for $rust {
            const NAME: &'static str = $name;
            const ALIGN: usize = $align;
            const SIZE: usize = $size;
            const IS_FLOAT: bool = $is_float;
        })*
    };
}

shared! {
    u32 = "u32", 4, 4, false;
    f32 = "f32", 4, 4, true;
    [u32; 2] = "vec2u", 8, 8, false;
    [f32; 2] = "vec2f", 8, 8, true;
    [f32; 3] = "vec3f", 16, 12, true;
    [f32; 4] = "vec4f", 16, 16, true;
}

/// A member of a struct as WGSL declares it.
struct Member {
    doc: &'static str,
    name: &'static str,
    wgsl_type: &'static str,
    words: usize,
    is_float: bool,
}

/// A declaration of `layout.wgsl`.
struct Declaration {
    doc: &'static str,
    name: &'static str,
    body: Body,
}

enum Body {
    Struct(&'static [Member]),
    /// A struct of whole rows of the list of records, with a function that reads it from there.
    Record(&'static [Member]),
    Constant(u32),
}

const fn larger(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

macro_rules! structs {
    ($list:ident, $body:ident; $(
        #[doc = $doc:literal]
        pub struct $name:ident {
            $(#[doc = $field_doc:literal] pub $field:ident: $type:ty,)*
        }
    )*) => {
        $(
            #[doc = $doc]
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
            pub struct $name {
                $(#[doc = $field_doc] pub $field: $type,)*
            }

            const _: () = {
                let mut end = 0;
                let mut align = 4;
                $(
                    let start = usize::next_multiple_of(end, <$type as Shared>::ALIGN);
                    assert!(
                        std::mem::offset_of!($name, $field) == start,
                        concat!("WGSL places ", stringify!($name), ".", stringify!($field), " elsewhere"),
                    );
                    end = start + <$type as Shared>::SIZE;
                    align = larger(align, <$type as Shared>::ALIGN);
                )*
                assert!(
                    std::mem::size_of::<$name>() == usize::next_multiple_of(end, align),
                    concat!("WGSL gives ", stringify!($name), " another size"),
                );
            };
        )*
        const $list: &[Declaration] = &[$(Declaration {
            doc: $doc,
            name: stringify!($name),
            body: Body::$body(&[$(Member {
                doc: $field_doc,
                name: stringify!($field),
                wgsl_type: <$type as Shared>::NAME,
                words: <$type as Shared>::SIZE / 4,
                is_float: <$type as Shared>::IS_FLOAT,
            }),*]),
        }),*];
    };
}

macro_rules! constants {
    ($list:ident; $(#[doc = $doc:literal] pub const $name:ident = $value:expr;)*) => {
        $(#[doc = $doc] pub const $name: u32 = $value;)*
        const $list: &[Declaration] = &[$(Declaration {
            doc: $doc,
            name: stringify!($name),
            body: Body::Constant($name),
        }),*];
    };
}

constants! { CONSTANTS;
    /// Width and height of a workgroup, in invocations.
    pub const WORKGROUP_SIDE = 8;
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

structs! { STRUCTS, Struct;
    /// Values for a whole render.
    pub struct Frame {
        /// Position of the camera.
        pub camera_origin: [f32; 3],
        /// Chooses the sequence of random numbers.
        pub seed: u32,
        /// +X of camera space: to the right in the picture.
        pub camera_right: [f32; 3],
        /// Half the picture's height: at distance 1, or in scene units when orthographic.
        pub half_height: f32,
        /// +Y of camera space: up in the picture.
        pub camera_up: [f32; 3],
        /// Lower end of the first band, nm.
        pub band_min_nm: f32,
        /// +Z of camera space: opposite to the direction of view.
        pub camera_back: [f32; 3],
        /// Width of a band, nm.
        pub band_width_nm: f32,
        /// Width and height of the picture in pixels.
        pub image_size: [u32; 2],
        /// Number of steps between the spectra's knots in a band.
        pub steps: u32,
        /// 1 where each sample draws its wavelengths, 0 where they are at the bands' centers.
        pub draws_wavelengths: u32,
        /// First of the numbers that are the emitter indices of the parts of the environment, including disks in the sky.
        pub first_environment: u32,
        /// Index of the first of the observer's three spectra.
        pub observer: u32,
        /// Number of film hits, the first of a path, at which it is split.
        pub film_splits: u32,
        /// The largest radiance of a sample in any band.
        pub clamp: f32,
        /// Number of bands.
        pub bands: u32,
        /// Radius of the camera's lens.
        pub lens_radius: f32,
        /// Distance of the plane in focus, along the direction of view.
        pub focus_distance: f32,
        /// First of the numbers that distribute a pixel's samples by its filter.
        pub first_filter: u32,
        /// Row of the first node of the tree of emitters.
        pub first_emitter_node: u32,
        /// Row after the last node of the tree of emitters.
        pub end_emitter_node: u32,
        /// Padding to the alignment.
        pub padding: [u32; 2],
    }

    /// Values for one dispatch: a run of samples of one tile.
    pub struct Batch {
        /// The tile's first pixel in the picture.
        pub tile_origin: [u32; 2],
        /// Width and height of the tile.
        pub tile_size: [u32; 2],
        /// Samples that were taken before.
        pub first_sample: u32,
        /// Samples to take now.
        pub sample_count: u32,
        /// Passes of the loop by which an invocation detects whether the driver has ended its loops.
        pub passes: u32,
        /// Padding to the size that a uniform buffer requires.
        pub padding: u32,
    }

    /// Values for one run over a part of a batch of stacks.
    pub struct StackRun {
        /// Number of wavelengths.
        pub wavelength_count: u32,
        /// Groups of four wavelengths for which each medium has its index: all of them, or 1.
        pub media_groups: u32,
        /// First stack of this run.
        pub first_stack: u32,
        /// Number of stacks of this run.
        pub stack_count: u32,
        /// Index of the incident medium.
        pub incident: f32,
        /// Padding to the size that a uniform buffer requires.
        pub padding_1: u32,
        /// Padding.
        pub padding_2: [u32; 2],
    }

    /// A layer of a stack of a batch.
    pub struct RunLayer {
        /// Its medium.
        pub medium: u32,
        /// Its thickness, nm.
        pub thickness_nm: f32,
    }

    /// A stack of a batch.
    pub struct RunStack {
        /// The medium below its layers.
        pub substrate: u32,
        /// First of its layers, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
    }
}

/// A record that can be in the list of records.
pub trait Record: bytemuck::Pod {
    /// Number of rows of four words.
    const ROWS: u32 = (size_of::<Self>() / 16) as u32;
}

macro_rules! records {
    ($list:ident; $($(#[doc = $doc:literal])* pub struct $name:ident $body:tt)*) => {
        structs! { $list, Record; $($(#[doc = $doc])* pub struct $name $body)* }
        $(impl Record for $name {}
        const _: () = assert!(size_of::<$name>().is_multiple_of(16), "a record takes whole rows");)*
    };
}

records! { SHAPES;
    /// An object that rays meet: a shape with a material.
    pub struct Shape {
        /// Center of a sphere, rectangle or disk, or a point of a plane.
        pub center: [f32; 3],
        /// Radius of a sphere or disk.
        pub radius: f32,
        /// Unit normal of a plane, rectangle or disk; for a large sphere, the normal at `nearest`.
        pub normal: [f32; 3],
        /// A `SHAPE_` tag.
        pub kind: u32,
        /// First axis of a plane, rectangle or disk.
        pub tangent: [f32; 3],
        /// Half the width of a rectangle, along `tangent`; a disk's radius.
        pub half_width: f32,
        /// Second axis of a plane, rectangle or disk.
        pub bitangent: [f32; 3],
        /// Half the height of a rectangle, along `bitangent`; a disk's radius.
        pub half_height: f32,
        /// Point of a large sphere that is nearest to the camera.
        pub nearest: [f32; 3],
        /// Curvature of a large sphere, 1/radius; 0 for other shapes.
        pub curvature: f32,
        /// Index of its material.
        pub material: u32,
        /// Index of its emitter, or NONE.
        pub emitter: u32,
        /// Index of the stack of coincident surfaces that it belongs to, or NONE.
        pub stack: u32,
        /// Number of surfaces of the stack outside it, times 2, plus 1 where its normal points into the stack.
        pub sheet: u32,
    }
}

records! { EMITTERS;
    /// An emitter, sampled or visible to paths that leave the scene. Those that are sampled come first.
    pub struct Emitter {
        /// Center of a sphere, rectangle or disk; position of a point or spot.
        pub position: [f32; 3],
        /// An `EMITTER_` tag.
        pub kind: u32,
        /// Unit vector: normal of a rectangle or disk; toward a pole, a disk, a direction or a picture's center; direction of a spot.
        pub axis: [f32; 3],
        /// Radius of a sphere or disk.
        pub radius: f32,
        /// First axis of a rectangle or disk; toward a picture's right half.
        pub tangent: [f32; 3],
        /// Half the width of a rectangle, along `tangent`; a disk's radius.
        pub half_width: f32,
        /// Second axis of a rectangle or disk.
        pub bitangent: [f32; 3],
        /// Half the height of a rectangle, along `bitangent`; a disk's radius.
        pub half_height: f32,
        /// Its emission: spectrum and light group.
        pub emission: u32,
        /// Factor of its emission.
        pub scale: f32,
        /// Luminance, which steers the choice among emitters; 0 where it is not sampled.
        pub brightness: f32,
        /// Index of its object, or NONE.
        pub object: u32,
        /// 1 − cos of the angle with `axis` within which a spot emits fully.
        pub full_height: f32,
        /// 1 − cos of the angle with `axis` beyond which a spot does not emit, or at which a disk in the sky ends.
        pub edge_height: f32,
        /// Row of its node in the tree of emitters.
        pub node: u32,
        /// Row of the record of its picture, a [`Panorama`]; NONE where it has none.
        pub picture: u32,
    }
}

records! { RECORDS;
    /// A material. The materials come first among the records, in their order.
    pub struct Material {
        /// A `SURFACE_` tag.
        pub surface: u32,
        /// Row of the record of that surface: a [`Diffuse`], [`Interface`], [`Coated`], [`Cook`] or [`Film`].
        pub record: u32,
        /// Row of its facets; NONE where it is smooth.
        pub facets: u32,
        /// Roughly the fraction of light that continues from it.
        pub albedo: f32,
        /// Its emission: spectrum and light group.
        pub emission: u32,
        /// Factor of its emission; 0 where it emits nothing.
        pub emission_scale: f32,
        /// Padding to whole rows.
        pub padding: [u32; 2],
    }

    /// A reflectance that may vary over a surface.
    pub struct Diffuse {
        /// Spectrum: the reflectance, or that of the even squares of a checker.
        pub spectrum: u32,
        /// Spectrum: the reflectance of the odd squares; the same as `spectrum` without a checker.
        pub odd_spectrum: u32,
        /// Side of a checker's squares.
        pub checker_size: f32,
        /// Index of the header of the reflectance's picture; NONE where it has none.
        pub picture: u32,
    }

    /// The facets of a rough surface.
    pub struct Facets {
        /// Direction of the grain, or of the axis around which it runs.
        pub grain: [f32; 3],
        /// A `GRAIN_` tag.
        pub grain_kind: u32,
        /// Width of the distribution of slopes along and across the grain.
        pub alpha: [f32; 2],
        /// A `FACETS_` tag.
        pub distribution: u32,
        /// First number of the table of their directional albedo.
        pub first_energy: u32,
        /// Mean of that table over all directions.
        pub mean_energy: f32,
        /// First number of the table of a brushed coat's transmittance scale over direction.
        pub first_transmittance_scale: u32,
        /// Padding to whole rows.
        pub padding: [u32; 2],
    }

    /// The boundary of a conductor, bare or below layers.
    pub struct Interface {
        /// Spectrum: n of the conductor; its k is the next spectrum.
        pub spectrum: u32,
        /// Row of its first layer, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
        /// Number of layers whose thickness varies over the surface.
        pub varying_layers: u32,
    }

    /// A diffuse body below a clear coat.
    pub struct Coated {
        /// Row of the body's reflectance.
        pub base: u32,
        /// Spectrum: n of the coat; its k is the next spectrum.
        pub spectrum: u32,
        /// Spectrum: reflectance of the coat for diffuse light from outside.
        pub mean_reflectance: u32,
        /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
        pub coat_reflectances: u32,
        /// Representative index of the coat, by which a path chooses between coat and body.
        pub coat_estimate: f32,
        /// Representative reflectance of the body, for the same choice.
        pub base_estimate: f32,
        /// Padding to whole rows.
        pub padding: [u32; 2],
    }

    /// A surface by the model of Cook and Torrance.
    pub struct Cook {
        /// Spectrum: n of the facets; their k is the next spectrum.
        pub spectrum: u32,
        /// A `COOK_` tag.
        pub distribution: u32,
        /// First of the numbers of the slopes: m, weight and part of each.
        pub first_slope: u32,
        /// Number of slopes.
        pub slope_count: u32,
        /// Spectrum: the Lambertian reflectance.
        pub base: u32,
        /// Fraction of the Lambertian reflection.
        pub base_fraction: f32,
        /// Probability with which a path is scattered by the Lambertian fraction.
        pub base_probability: f32,
        /// Padding to whole rows.
        pub padding: u32,
    }

    /// A free film.
    pub struct Film {
        /// The `FACTOR_` tag for light from the front.
        pub factor: u32,
        /// Row of its first layer, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
        /// Number of layers whose thickness varies over the surface.
        pub varying_layers: u32,
        /// First number of the table of its reflected fraction.
        pub first_reflected: u32,
        /// Padding to whole rows.
        pub padding_1: u32,
        /// Padding to whole rows.
        pub padding_2: [u32; 2],
    }

    /// A layer of a film or of a coating.
    pub struct Layer {
        /// Spectrum: n; its k is the next spectrum.
        pub spectrum: u32,
        /// Thickness where it has no fields, nm.
        pub thickness_nm: f32,
        /// Row of the first of the fields of its thickness.
        pub first_field: u32,
        /// Number of its fields; 0 where the thickness is the same everywhere.
        pub field_count: u32,
    }

    /// A part of a thickness that varies.
    pub struct Field {
        /// Direction of the pole, or start of a line.
        pub origin: [f32; 3],
        /// A `FIELD_` tag.
        pub kind: u32,
        /// From start to end of a line, over the square of its length.
        pub along: [f32; 3],
        /// An `ALONG_` tag.
        pub runs_along: u32,
        /// Value at 0: at the pole, at the start, of black; the mean of swirls.
        pub base: f32,
        /// Added to `base` at 1: at the other pole, at the end, of white; the amplitude of swirls.
        pub swing: f32,
        /// Largest value of a profile.
        pub most_nm: f32,
        /// Value below which a profile is a black film.
        pub black_below_nm: f32,
        /// Thickness of that black film.
        pub black_nm: f32,
        /// Cells of swirls per unit.
        pub cells_per_unit: f32,
        /// Octaves of swirls.
        pub octaves: u32,
        /// Distance by which the flow carries swirls, in cells.
        pub warp: f32,
        /// Width and height of a picture on a plane; 0 for its natural size.
        pub size: [f32; 2],
        /// Time of swirls within its cell.
        pub phase: f32,
        /// Cells that the time of swirls has passed.
        pub cells: u32,
        /// Selects the pattern of swirls.
        pub seed: u32,
        /// First of the numbers for its lookups.
        pub first_number: u32,
        /// Number of steps, or of knots of a profile.
        pub sample_count: u32,
        /// Columns of a picture.
        pub columns: u32,
        /// Rows of a picture.
        pub rows: u32,
        /// Padding to whole rows.
        pub padding_1: u32,
        /// Padding to whole rows.
        pub padding_2: [u32; 2],
    }

    /// A picture of the environment, and the table by which directions are sampled.
    pub struct Panorama {
        /// Index of its header among the texels; its pixels follow.
        pub head: u32,
        /// Number of texels of a pixel.
        pub per_pixel: u32,
        /// Number of columns of the table.
        pub columns: u32,
        /// Number of rows of the table.
        pub rows: u32,
        /// First number of the table: heights of the rows' edges from the top, cumulative probabilities of the rows, and of the cells of each row.
        pub first_number: u32,
        /// Density of light at the picture's mean brightness, on the scale of the density of the sampled light; 0 where all light is sampled.
        pub even_density: f32,
        /// Padding to whole rows.
        pub padding: [u32; 2],
    }
}

records! { TREES;
    /// A node of the hierarchy of boxes around objects. Nodes are in depth-first order: the contents of a box follow it.
    pub struct Node {
        /// The box's corner with the smallest coordinates.
        pub low: [f32; 3],
        /// Row of the node after all contents of the box.
        pub next: u32,
        /// The box's corner with the largest coordinates.
        pub high: [f32; 3],
        /// The object in it; NONE where it contains other nodes.
        pub object: u32,
    }

    /// A node of the tree of emitters, in depth-first order: a group as seen from afar; or an emitter, for which only the last four fields count.
    pub struct EmitterNode {
        /// Mean of the positions of the group's emitters.
        pub center: [f32; 3],
        /// The whole group is within this distance of the center.
        pub reach: f32,
        /// Unit vector about which the group emits.
        pub axis: [f32; 3],
        /// Cosine of the angle with `axis` beyond which nothing is emitted; −1 where the group emits in all directions.
        pub cone: f32,
        /// Power that the group emits into one of the directions in `cone`.
        pub power: f32,
        /// Mean square of the distance from the center.
        pub variance: f32,
        /// The fraction of the power that is emitted in a direction is √(`even` + `along` c²), where c is its cosine with `axis`.
        pub even: f32,
        /// See `even`.
        pub along: f32,
        /// A point nearer to the center than this weights the children of the group instead; 0 for an emitter.
        pub near: f32,
        /// Row of the node after all contents of the group.
        pub next: u32,
        /// Row of the parent group, or NONE.
        pub parent: u32,
        /// The emitter, or NONE for a group.
        pub emitter: u32,
    }
}

/// Returns the text of `shaders/layout.wgsl`.
pub fn wgsl() -> String {
    let mut text = String::from(
        "// Generated from crates/gpu/src/layout.rs: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test layout\n",
    );
    for declaration in CONSTANTS.iter().chain(STRUCTS) {
        text += &declare(declaration);
    }
    text
}

/// Returns the text of `shaders/records.wgsl`.
pub fn records_wgsl() -> String {
    let mut text = String::from(
        "// The records of a scene, and how they are read. Generated from crates/gpu/src/layout.rs: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test layout\n",
    );
    let lists = [
        ("shapes", SHAPES),
        ("emitters", EMITTERS),
        ("records", RECORDS),
        ("trees", TREES),
    ];
    for (list, records) in lists {
        for record in records {
            text += &declare(record).replace("LIST", list);
        }
    }
    for (function, record, what) in [
        ("shape_at", "Shape", "Returns a shape by its index"),
        ("emitter_at", "Emitter", "Returns an emitter by its index"),
        (
            "material_at",
            "Material",
            "Returns a material by its index: materials come first among the records",
        ),
    ] {
        let [lower, upper] = [record.to_lowercase(), record.to_uppercase()];
        text += &format!(
            "\n/// {what}.\nfn {function}(number: u32) -> {record} {{\n    return load_{lower}(number * {upper}_ROWS);\n}}\n"
        );
    }
    text
}

fn declare(declaration: &Declaration) -> String {
    let (name, doc) = (declaration.name, declaration.doc.replace(['[', ']'], ""));
    let mut text = format!("\n///{doc}\n");
    match declaration.body {
        Body::Constant(value) => text += &format!("const {name}: u32 = {value}u;\n"),
        Body::Struct(members) => text += &declare_struct(name, members),
        Body::Record(members) => {
            text += &declare_struct(name, members);
            text += &declare_loader(name, members);
        }
    }
    text
}

fn declare_struct(name: &str, members: &[Member]) -> String {
    let mut text = format!("struct {name} {{\n");
    for member in members {
        let doc = member.doc.replace(['[', ']'], "");
        text += &format!("    ///{doc}\n    {}: {},\n", member.name, member.wgsl_type);
    }
    text + "}\n"
}

/// Returns a function that reads a record, word by word of its rows.
fn declare_loader(name: &str, members: &[Member]) -> String {
    let mut next = 0;
    let values = members.iter().map(|member| {
        let words = (next..next + member.words).map(|word| {
            let word = format!("row_{}.{}", word / 4, ["x", "y", "z", "w"][word % 4]);
            if member.is_float {
                format!("bitcast<f32>({word})")
            } else {
                word
            }
        });
        let words: Vec<_> = words.collect();
        next += member.words;
        match member.words {
            1 => words.concat(),
            _ => format!("{}({})", member.wgsl_type, words.join(", ")),
        }
    });
    let values = values.collect::<Vec<_>>().join(",\n        ");
    let row = |row| format!("    let row_{row} = LIST_row(row + {row}u);\n");
    let rows = (0..next / 4).map(row).collect::<Vec<_>>().concat();
    format!(
        "const {}_ROWS: u32 = {}u;\nfn load_{}(row: u32) -> {name} {{\n{rows}    return {name}(\n        {values},\n    );\n}}\n",
        name.to_uppercase(),
        next / 4,
        name.to_lowercase(),
    )
}
