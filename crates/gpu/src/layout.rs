//! What lies in the buffers that host and shader share, written once.
//!
//! The macros below take documented Rust types, prove at compile time that Rust places every field
//! where WGSL expects it, and give the text of `shaders/layout.wgsl` and `shaders/records.wgsl`. Those files are committed, and a test
//! proves them fresh.

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
    /// A struct of whole rows of the list of records, with a function that reads it there.
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
    /// Invocations of a workgroup along each side of the picture.
    pub const WORKGROUP_SIDE = 8;
    /// No object, no light.
    pub const NONE = 0xffff_ffff;

    /// A light is the number of its spectrum, with its light group from this bit on.
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
    /// Emitter: environment of the same radiance from everywhere. Those of the environment are greater.
    pub const EMITTER_EVERYWHERE = 16;
    /// Emitter: environment by 1 − |h|, with h the height of the direction.
    pub const EMITTER_HORIZON = 17;
    /// Emitter: environment by the cosine with `axis`, where it is above 0.
    pub const EMITTER_POLE = 18;
    /// Emitter: environment by a picture, its middle toward `axis`, its right half toward `tangent`.
    pub const EMITTER_PICTURE = 19;
    /// Emitter: a disk in the sky about `axis`.
    pub const EMITTER_DISTANT_DISK = 24;
    /// Emitter: light from the direction `axis` alone. Those of a single direction at each place are greater.
    pub const EMITTER_DIRECTION = 25;
    /// Emitter: a point that shines to all sides. Those that lie at a place are greater.
    pub const EMITTER_POINT = 26;
    /// Emitter: a point that shines about `axis`.
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
    /// Grain: a surface alike in all directions.
    pub const GRAIN_NONE = 0;
    /// Grain: along a direction in space.
    pub const GRAIN_ALONG = 1;
    /// Grain: around an axis through the object's center.
    pub const GRAIN_AROUND = 2;
    /// Cosines for which a rough coat has its reflectance, even in their roots.
    pub const COAT_COSINES = CoatedBody::COSINES as u32;
    /// Knots of a table over facets' directions over the root of the cosine.
    pub const FACET_COSINES = FacetTable::COSINES as u32;
    /// Knots of a table over facets' directions over the width of the slopes, where that differs.
    pub const FACET_WIDTHS = FacetTable::WIDTHS as u32;

    /// Field: the same everywhere.
    pub const FIELD_CONSTANT = 0;
    /// Field: linear in what it runs along.
    pub const FIELD_LINEAR = 1;
    /// Field: steps of equal width.
    pub const FIELD_STEPS = 2;
    /// Field: the root of a table.
    pub const FIELD_PROFILE = 3;
    /// Field: noise carried along by a flow.
    pub const FIELD_SWIRLS = 4;
    /// Field: a picture.
    pub const FIELD_PICTURE = 5;
    /// Field: the sum of the two values before it.
    pub const FIELD_SUM = 6;
    /// Field: the product of the two values before it.
    pub const FIELD_PRODUCT = 7;
    /// A field runs along the polar angle about a sphere's center.
    pub const ALONG_POLAR_ANGLE = 0;
    /// A field runs along a line in space.
    pub const ALONG_LINE = 1;
    /// The most values that wait for a sum or product.
    pub const FIELD_STACK = MAX_FIELD_DEPTH as u32 + 1;
    /// Rows of a list that stand side by side in a texture.
    pub const LIST_WIDTH = 4096;
    /// Numbers in a row of the texture of tables.
    pub const NUMBERS_WIDTH = 4096;
    /// Texels in a row of the texture of pictures.
    pub const TEXELS_WIDTH = 4096;
    /// No layer is thicker, nm.
    pub const MAX_THICKNESS_NM = THICKNESS_NM.high as u32;

    /// Numbers of the table that spreads a pixel's samples by its filter.
    pub const FILTER_KNOTS = PixelFilter::KNOTS as u32;
    /// Numbers of a film's table of what it reflects, over the cosine.
    pub const REFLECTED_KNOTS = Estimate::KNOTS as u32;

    /// A factor is a number (of a spectrum, a texel or a row), with its tag from this bit on.
    pub const FACTOR_SHIFT = 28;
    /// Factor of a path's vertex: 1.
    pub const FACTOR_ONE = 0;
    /// Factor: a diffuse reflectance, by the number of its spectrum.
    pub const FACTOR_DIFFUSE = 1;
    /// Factor: a diffuse reflectance, by the number of the texel that has its coefficients.
    pub const FACTOR_TEXTURE = 2;
    /// Factor: a bare conductor, by the number of its n.
    pub const FACTOR_INTERFACE = 3;
    /// Factor: layers on a conductor, by the row of the interface.
    pub const FACTOR_COATING = 4;
    /// Factor: a body below a coat, by the number of the coat's n.
    pub const FACTOR_COATED = 5;
    /// Factor: Cook's model, by the number of the facets' n.
    pub const FACTOR_COOK = 6;
    /// Factor: a film of one layer without absorption and with n ≥ 1, by the number of n. Those of films are greater.
    pub const FACTOR_FILM = 7;
    /// Factor: a film of one layer of any index, by the number of n.
    pub const FACTOR_LOSSY_FILM = 8;
    /// Factor: a film of one layer by two beams, by the number of n.
    pub const FACTOR_TWO_BEAM = 9;
    /// Factor: the same with the path difference that the paper prints.
    pub const FACTOR_TWO_BEAM_AS_PRINTED = 10;
    /// Factor: a film of several layers seen from the first, by the row of the film.
    pub const FACTOR_STACK = 11;
    /// Factor: a film of several layers seen from the last, by the row of the film.
    pub const FACTOR_STACK_BACK = 12;
}

structs! { STRUCTS, Struct;
    /// What holds for a whole render.
    pub struct Frame {
        /// Where the camera stands.
        pub camera_origin: [f32; 3],
        /// Chooses the sequence of random numbers.
        pub seed: u32,
        /// +X of camera space: to the right in the picture.
        pub camera_right: [f32; 3],
        /// Half the picture's height: at distance 1, or in scene units when orthographic.
        pub half_height: f32,
        /// +Y of camera space: upwards in the picture.
        pub camera_up: [f32; 3],
        /// Lower end of the first band, nm.
        pub band_min_nm: f32,
        /// +Z of camera space: away from what is looked at.
        pub camera_back: [f32; 3],
        /// Width of a band, nm.
        pub band_width_nm: f32,
        /// Width and height of the picture in pixels.
        pub image_size: [u32; 2],
        /// Steps that a band is divided into by the spectra's knots.
        pub steps: u32,
        /// 1 where each sample draws its wavelengths, 0 where they lie at the bands' centers.
        pub draws_wavelengths: u32,
        /// First of the numbers of the emitters that are parts of the environment, disks in the sky among them.
        pub first_environment: u32,
        /// First of the observer's three spectra.
        pub observer: u32,
        /// Film hits, the first of a path, at which it is split.
        pub film_splits: u32,
        /// The largest radiance that a sample may bring in any band.
        pub clamp: f32,
        /// Number of bands.
        pub bands: u32,
        /// Radius of the camera's lens.
        pub lens_radius: f32,
        /// Distance of the plane that the lens shows sharply, along the direction of view.
        pub focus_distance: f32,
        /// First of the numbers that spread a pixel's samples by its filter.
        pub first_filter: u32,
        /// The row of the first node of the tree of emitters.
        pub first_emitter_node: u32,
        /// The row after its last one.
        pub end_emitter_node: u32,
        /// Fills the size up to that of its alignment.
        pub padding: [u32; 2],
    }

    /// What holds for one dispatch: a run of samples of one tile.
    pub struct Batch {
        /// The tile's first pixel in the picture.
        pub tile_origin: [u32; 2],
        /// Width and height of the tile.
        pub tile_size: [u32; 2],
        /// Samples that were taken before.
        pub first_sample: u32,
        /// Samples to take now.
        pub sample_count: u32,
        /// Passes of the loop by which an invocation finds out whether the driver has ended its loops.
        pub passes: u32,
        /// Fills the size up to what a uniform buffer asks for.
        pub padding: u32,
    }

    /// What holds for one run over a part of a batch of stacks.
    pub struct StackRun {
        /// Number of wavelengths.
        pub wavelength_count: u32,
        /// Groups of four wavelengths for which each medium has its index: all of them, or 1.
        pub media_groups: u32,
        /// First stack of this run.
        pub first_stack: u32,
        /// Number of stacks of this run.
        pub stack_count: u32,
        /// Index of the medium that light comes from.
        pub incident: f32,
        /// Fills the size up to what a uniform buffer asks for.
        pub padding_1: u32,
        /// Fills the size up.
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

/// What can stand in the list of records.
pub trait Record: bytemuck::Pod {
    /// Rows of four words that it takes.
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
    /// What rays meet: a shape made of a material.
    pub struct Shape {
        /// Center of a sphere, rectangle or disk, a point of a plane.
        pub center: [f32; 3],
        /// Radius of a sphere or disk.
        pub radius: f32,
        /// Unit normal of a plane, rectangle or disk; of a large sphere that at its `bitangent`.
        pub normal: [f32; 3],
        /// A `SHAPE_` tag.
        pub kind: u32,
        /// First axis of a plane, rectangle or disk.
        pub tangent: [f32; 3],
        /// Half the width of a rectangle, along `tangent`; a disk's radius; of a large sphere its curvature, 1/radius.
        pub half_width: f32,
        /// Second axis of a plane, rectangle or disk; of a large sphere its point nearest to the camera.
        pub bitangent: [f32; 3],
        /// Half the height of a rectangle, along `bitangent`; a disk's radius.
        pub half_height: f32,
        /// Number of its material.
        pub material: u32,
        /// Number of the emitter that it is, or NONE.
        pub emitter: u32,
        /// Number of the stack of coincident surfaces that it lies in, or NONE.
        pub stack: u32,
        /// How many surfaces of the stack lie outside it, times 2, and 1 where its normal points into the stack.
        pub sheet: u32,
    }
}

records! { EMITTERS;
    /// What light is sampled from, or comes from where a path leaves the scene. Those that are sampled stand first.
    pub struct Emitter {
        /// Center of a sphere, rectangle or disk; where a point or spot stands.
        pub position: [f32; 3],
        /// An `EMITTER_` tag.
        pub kind: u32,
        /// Unit vector: normal of a rectangle or disk, toward a pole, a disk, a direction or a picture's middle, where a spot shines to.
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
        /// Its light: spectrum and light group.
        pub emission: u32,
        /// Factor of its light.
        pub scale: f32,
        /// How bright it is to the eye, which steers the choice among emitters; 0 where it is not sampled.
        pub brightness: f32,
        /// The object that it is, or NONE.
        pub object: u32,
        /// 1 − cos of the angle with `axis` within which a spot shines fully.
        pub full_height: f32,
        /// 1 − cos of the angle with `axis` beyond which a spot does not shine, or a disk in the sky ends.
        pub edge_height: f32,
        /// The row of its node in the tree of emitters.
        pub node: u32,
        /// The row of a picture of the environment among the records: a [`Panorama`]. NONE where it is no picture.
        pub picture: u32,
    }
}

records! { RECORDS;
    /// What a surface is made of: those of all materials stand first among the records, in the materials' order.
    pub struct Material {
        /// A `SURFACE_` tag.
        pub surface: u32,
        /// The row of what that surface has: a [`Diffuse`], [`Interface`], [`Coated`], [`Cook`] or [`Film`].
        pub record: u32,
        /// The row of its facets; NONE where it is smooth.
        pub facets: u32,
        /// About the part of the light that goes on from it.
        pub albedo: f32,
        /// Light that it emits.
        pub emission: u32,
        /// Factor of what it emits; 0 where it emits nothing.
        pub emission_scale: f32,
        /// Fills the last row.
        pub padding: [u32; 2],
    }

    /// A reflectance that may vary over a surface.
    pub struct Diffuse {
        /// Spectrum: the reflectance, of the even squares of a checker.
        pub spectrum: u32,
        /// Spectrum: the reflectance of the odd squares; the same as `spectrum` without a checker.
        pub odd_spectrum: u32,
        /// Side of a checker's squares.
        pub checker_size: f32,
        /// The head of the picture of the reflectance; NONE where that is no picture.
        pub picture: u32,
    }

    /// The facets of a rough surface.
    pub struct Facets {
        /// Direction of the grain, or of the axis that it runs around.
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
        /// First number of the table by which a brushed coat lets more through in some directions.
        pub first_transmittance_scale: u32,
        /// Fills the last row.
        pub padding: [u32; 2],
    }

    /// The boundary of a conductor, bare or below layers.
    pub struct Interface {
        /// Spectrum: n of the conductor, whose k is the next one.
        pub spectrum: u32,
        /// The row of its first layer, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
        /// Number of those whose thickness varies over the surface.
        pub varying_layers: u32,
    }

    /// A diffuse body below a clear coat.
    pub struct Coated {
        /// The row of the body's reflectance.
        pub base: u32,
        /// Spectrum: n of the coat, whose k is the next one.
        pub spectrum: u32,
        /// Spectrum: reflectance of the coat for diffuse light from outside.
        pub mean_reflectance: u32,
        /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
        pub coat_reflectances: u32,
        /// What stands for the coat's index where a path chooses its way.
        pub coat_estimate: f32,
        /// What stands for the body's reflectance there.
        pub base_estimate: f32,
        /// Fills the last row.
        pub padding: [u32; 2],
    }

    /// A surface by the model of Cook and Torrance.
    pub struct Cook {
        /// Spectrum: n of the facets, whose k is the next one.
        pub spectrum: u32,
        /// A `COOK_` tag.
        pub distribution: u32,
        /// First of the numbers of the slopes: m, weight and part of each.
        pub first_slope: u32,
        /// Number of slopes.
        pub slope_count: u32,
        /// Spectrum: what is reflected evenly.
        pub base: u32,
        /// The part of the light that is reflected so.
        pub base_share: f32,
        /// Probability with which a path is scattered so.
        pub base_probability: f32,
        /// Fills the last row.
        pub padding: u32,
    }

    /// A free film.
    pub struct Film {
        /// The `FACTOR_` tag of what it does to light from the front.
        pub factor: u32,
        /// The row of its first layer, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
        /// Number of those whose thickness varies over the surface.
        pub varying_layers: u32,
        /// First of the numbers that tell about what it reflects.
        pub first_reflected: u32,
        /// Fills the last row.
        pub padding_1: u32,
        /// Fills the last row.
        pub padding_2: [u32; 2],
    }

    /// A layer of a film or of a coating.
    pub struct Layer {
        /// Spectrum: n of its index, whose k is the next one.
        pub spectrum: u32,
        /// Thickness where it has no fields, nm.
        pub thickness_nm: f32,
        /// The row of the first of the fields that its thickness is made of.
        pub first_field: u32,
        /// Number of its fields; 0 where the thickness is the same everywhere.
        pub field_count: u32,
    }

    /// A part of a thickness that varies.
    pub struct Field {
        /// The pole's direction, or where a line starts.
        pub origin: [f32; 3],
        /// A `FIELD_` tag.
        pub kind: u32,
        /// From start to end of a line, over the square of its length.
        pub along: [f32; 3],
        /// An `ALONG_` tag.
        pub runs_along: u32,
        /// Value at 0: at the pole, at the start, of black, the mean of swirls; thickness of the black film of a profile.
        pub base: f32,
        /// Added to it at 1: at the other pole, at the end, of white, the amplitude of swirls; the largest value of a profile.
        pub swing: f32,
        /// A profile is a black film below it; cells of swirls per unit.
        pub threshold: f32,
        /// Distance by which swirls are carried, in cells.
        pub warp: f32,
        /// Width and height of a picture on a plane; 0 for its natural size.
        pub size: [f32; 2],
        /// Time of swirls within its cell.
        pub phase: f32,
        /// Cells that the time of swirls has passed through.
        pub cells: u32,
        /// Chooses the pattern of swirls.
        pub seed: u32,
        /// First of the numbers that it looks up.
        pub first_number: u32,
        /// Steps, knots of a profile, pixels of a row; octaves of swirls.
        pub sample_count: u32,
        /// Rows of a picture.
        pub rows: u32,
    }

    /// A picture of the environment, and the table by which directions are drawn.
    pub struct Panorama {
        /// Where it is among the texels: the head, then its pixels.
        pub head: u32,
        /// Texels of a pixel.
        pub per_pixel: u32,
        /// Columns of the table.
        pub columns: u32,
        /// Rows of the table.
        pub rows: u32,
        /// First of the numbers of the table: heights of the rows' edges from the top, running probability of the rows, and of the cells of each row.
        pub first_number: u32,
        /// The density that light as bright as the picture's mean would have beside the light that is sent for; 0 where that is all light.
        pub even_density: f32,
        /// Fills the last row.
        pub padding: [u32; 2],
    }
}

records! { TREES;
    /// A node of the hierarchy of boxes around objects. Nodes stand depth first: what a box holds follows it.
    pub struct Node {
        /// The box's corner with the smallest coordinates.
        pub low: [f32; 3],
        /// The row of the node after all that the box holds.
        pub next: u32,
        /// The box's corner with the largest coordinates.
        pub high: [f32; 3],
        /// The object that it holds; NONE where that is other nodes.
        pub object: u32,
    }

    /// A node of the tree of emitters, depth first: a group as seen from afar; or an emitter, of which only the last four count.
    pub struct EmitterNode {
        /// Mean of the places of what the group holds.
        pub center: [f32; 3],
        /// All that the group holds is within this distance of the center.
        pub reach: f32,
        /// Unit vector about which the group shines.
        pub axis: [f32; 3],
        /// Cosine of the angle with `axis` beyond which nothing shines; −1 where the group shines to all sides.
        pub cone: f32,
        /// What the group sends into one of the directions in `cone`.
        pub power: f32,
        /// Mean square of the distance from the center.
        pub variance: f32,
        /// The share of the power that is sent into a direction is √(`even` + `along` c²), where c is its cosine with `axis`.
        pub even: f32,
        /// See `even`.
        pub along: f32,
        /// From points nearer to the center than this the group is looked into; 0 of an emitter.
        pub near: f32,
        /// The row of the node after all that the group holds.
        pub next: u32,
        /// The row of the group that holds it, or NONE.
        pub parent: u32,
        /// The emitter, or NONE of a group.
        pub emitter: u32,
    }
}

/// The text of `shaders/layout.wgsl`.
pub fn wgsl() -> String {
    let mut text = String::from(
        "// Generated from crates/gpu/src/layout.rs: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test -p pellicle-tests --test layout\n",
    );
    for declaration in CONSTANTS.iter().chain(STRUCTS) {
        text += &declare(declaration);
    }
    text
}

/// The text of `shaders/records.wgsl`.
pub fn records_wgsl() -> String {
    let mut text = String::from(
        "// The records of a scene, and how they are read. Generated from crates/gpu/src/layout.rs: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test -p pellicle-tests --test layout\n",
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
        ("shape_at", "Shape", "What rays meet, by its number"),
        ("emitter_at", "Emitter", "An emitter by its number"),
        (
            "material_at",
            "Material",
            "A material by its number: they come first among the records",
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

/// A function that reads a record, word by word of its rows.
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
