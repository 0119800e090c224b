//! What lies in the buffers that host and shader share, written once.
//!
//! The macros below take documented Rust types, prove at compile time that Rust places every field
//! where WGSL expects it, and give the text of `shaders/layout.wgsl`. That file is committed, and a test proves it fresh.

use scene::limits::{MAX_FIELD_DEPTH, THICKNESS_NM};
use scene::{CoatedBody, Estimate, FacetTable, PixelFilter};

/// A type with the same bytes in Rust and in WGSL (WGSL specification, section 14.4.1).
trait Shared {
    const NAME: &'static str;
    const ALIGN: usize;
    const SIZE: usize;
}

macro_rules! shared {
    ($($rust:ty = $name:literal, $align:literal, $size:literal;)*) => {
        $(impl Shared for $rust {
            const NAME: &'static str = $name;
            const ALIGN: usize = $align;
            const SIZE: usize = $size;
        })*
    };
}

shared! {
    u32 = "u32", 4, 4;
    f32 = "f32", 4, 4;
    [u32; 2] = "vec2u", 8, 8;
    [f32; 2] = "vec2f", 8, 8;
    [f32; 3] = "vec3f", 16, 12;
    [f32; 4] = "vec4f", 16, 16;
}

/// A member of a struct as WGSL declares it.
struct Member {
    doc: &'static str,
    name: &'static str,
    wgsl_type: &'static str,
}

/// A declaration of `layout.wgsl`.
struct Declaration {
    doc: &'static str,
    name: &'static str,
    body: Body,
}

enum Body {
    Struct(&'static [Member]),
    Constant(u32),
}

const fn larger(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

macro_rules! structs {
    ($list:ident; $(
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
            body: Body::Struct(&[$(Member {
                doc: $field_doc,
                name: stringify!($field),
                wgsl_type: <$type as Shared>::NAME,
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
    /// Shape that no ray meets: surroundings of the same radiance from everywhere. Those that no ray meets are greater.
    pub const SHAPE_EVERYWHERE = 16;
    /// Shape that no ray meets: surroundings by 1 − |h|, with h the height of the direction.
    pub const SHAPE_HORIZON = 17;
    /// Shape that no ray meets: surroundings by the cosine with `normal`, where it is above 0.
    pub const SHAPE_POLE = 18;
    /// Shape that no ray meets: surroundings by a picture, its middle towards `normal`, its right half towards `tangent`.
    pub const SHAPE_PICTURE = 19;
    /// Shape that no ray meets: a disc in the sky about `normal`, with 1 − cos of its half angle for `radius`.
    pub const SHAPE_DISC = 24;
    /// Shape that no ray meets: light from the direction `normal` alone. Those of a single direction at each place are greater.
    pub const SHAPE_DIRECTION = 25;
    /// Shape that no ray meets: a point that shines to all sides. Those that lie at a place are greater.
    pub const SHAPE_POINT = 26;
    /// Shape that no ray meets: a point that shines about `normal`: fully up to the height 1 − cos `half_width`, not beyond `half_height`.
    pub const SHAPE_SPOT = 27;

    /// Surface: Lambertian.
    pub const SURFACE_DIFFUSE = 0;
    /// Surface: a smooth conductor, bare or coated.
    pub const SURFACE_MIRROR = 1;
    /// Surface: a rough conductor, bare or coated.
    pub const SURFACE_ROUGH_CONDUCTOR = 2;
    /// Surface: a free film.
    pub const SURFACE_FILM = 3;
    /// Surface: Cook's model with the distribution D1.
    pub const SURFACE_COOK_D1 = 4;
    /// Surface: Cook's model with the distribution D2.
    pub const SURFACE_COOK_D2 = 5;
    /// Surface: a diffuse body below a smooth coat.
    pub const SURFACE_COATED_BODY = 6;
    /// Surface: a diffuse body below a rough coat.
    pub const SURFACE_ROUGH_COATED_BODY = 7;

    /// Facets: Beckmann's distribution of slopes.
    pub const FACETS_BECKMANN = 0;
    /// Facets: the distribution of Trowbridge and Reitz.
    pub const FACETS_GGX = 1;
    /// Grain: a surface alike in all directions.
    pub const GRAIN_NONE = 0;
    /// Grain: along a direction in space.
    pub const GRAIN_ALONG = 1;
    /// Grain: around an axis through the object's centre.
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
    /// A field runs along the polar angle about a sphere's centre.
    pub const ALONG_POLAR_ANGLE = 0;
    /// A field runs along a line in space.
    pub const ALONG_LINE = 1;
    /// The most values that wait for a sum or product.
    pub const FIELD_STACK = MAX_FIELD_DEPTH as u32 + 1;
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

    /// Spectral factor of a path's vertex: 1.
    pub const FACTOR_ONE = 0;
    /// Spectral factor: a reflectance from a table.
    pub const FACTOR_REFLECTANCE = 1;
    /// Spectral factor: Fresnel reflectance of a conductor.
    pub const FACTOR_CONDUCTOR = 2;
    /// Spectral factor: reflectance of layers on a conductor.
    pub const FACTOR_COATED = 3;
    /// Spectral factor: a smooth reflectance, by the number of a texel.
    pub const FACTOR_SMOOTH = 4;
    /// Spectral factor: reflectance of a film of one layer without absorption. Those of films are greater.
    pub const FACTOR_FILM_REFLECTS = 5;
    /// Spectral factor: transmittance of a film of one layer without absorption.
    pub const FACTOR_FILM_TRANSMITS = 6;
    /// Spectral factor: reflectance of a film of one layer of any index.
    pub const FACTOR_LOSSY_FILM_REFLECTS = 7;
    /// Spectral factor: transmittance of a film of one layer of any index.
    pub const FACTOR_LOSSY_FILM_TRANSMITS = 8;
    /// Spectral factor: reflectance of a film of several layers, seen from the first.
    pub const FACTOR_STACK_REFLECTS = 9;
    /// Spectral factor: reflectance of a film of several layers, seen from the last.
    pub const FACTOR_STACK_REFLECTS_BACK = 10;
    /// Spectral factor: transmittance of a film of several layers, the same from both sides.
    pub const FACTOR_STACK_TRANSMITS = 11;
    /// Spectral factor: reflectance of a film by two beams.
    pub const FACTOR_TWO_BEAM_REFLECTS = 12;
    /// Spectral factor: transmittance of a film without interference.
    pub const FACTOR_TWO_BEAM_TRANSMITS = 13;


    /// Film: one layer without absorption and with n ≥ 1 everywhere, for which the short formula holds.
    pub const FILM_TRANSPARENT = 0;
    /// Film: one layer of any index.
    pub const FILM_LOSSY = 1;
    /// Film: several layers.
    pub const FILM_STACK = 2;
    /// Film: one layer, by two beams.
    pub const FILM_TWO_BEAM = 3;
    /// Film: one layer, by two beams with the path difference that the paper prints.
    pub const FILM_TWO_BEAM_AS_PRINTED = 4;
}

structs! { STRUCTS;
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
        /// 1 where each sample draws its wavelengths, 0 where they lie at the bands' centres.
        pub draws_wavelengths: u32,
        /// First of the objects that are parts of the surroundings, discs in the sky among them.
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

    /// A shape made of a material.
    pub struct Object {
        /// Centre of a sphere, rectangle or disk, a point of a plane.
        pub center: [f32; 3],
        /// Radius of a sphere or disk.
        pub radius: f32,
        /// Unit normal of a plane, rectangle or disk.
        pub normal: [f32; 3],
        /// A `SHAPE_` tag.
        pub shape: u32,
        /// First axis of a plane, rectangle or disk.
        pub tangent: [f32; 3],
        /// Half the width of a rectangle, along `tangent`; a disk's radius.
        pub half_width: f32,
        /// Second axis of a plane, rectangle or disk.
        pub bitangent: [f32; 3],
        /// Half the height of a rectangle, along `bitangent`; a disk's radius.
        pub half_height: f32,
        /// Index of its material.
        pub material: u32,
        /// Whether light can be sent from it: 1 or 0.
        pub is_light: u32,
        /// The light that has this object's number is the object `light`; NONE past the last light.
        pub light: u32,
        /// How bright its light is to the eye; steers the choice among lights.
        pub brightness: f32,
    }

    /// What a surface is made of.
    pub struct Material {
        /// Direction of a surface's grain, or of the axis that it runs around.
        pub grain: [f32; 3],
        /// A `GRAIN_` tag.
        pub grain_kind: u32,
        /// Width of the distribution of slopes along and across the grain.
        pub alpha: [f32; 2],
        /// A `FACETS_` tag.
        pub facets: u32,
        /// First number of the table of energy of its facets.
        pub first_energy: u32,
        /// A `SURFACE_` tag.
        pub surface: u32,
        /// Spectrum: reflectance (even squares of a checker), or n of an index, whose k is the next one.
        pub spectrum: u32,
        /// Spectrum: reflectance of the odd squares; the same as `spectrum` without a checker.
        pub odd_spectrum: u32,
        /// Side of a checker's squares.
        pub checker_size: f32,
        /// Mean of that table over all directions.
        pub mean_energy: f32,
        /// A `FILM_` tag, of a film.
        pub film: u32,
        /// Light that it emits.
        pub emission: u32,
        /// Factor of what it emits; 0 where it emits nothing.
        pub emission_scale: f32,
        /// First of its layers, the outermost.
        pub first_layer: u32,
        /// Number of its layers.
        pub layer_count: u32,
        /// 1 where it reflects nothing, so that a path ends.
        pub is_black: u32,
        /// Number of its layers whose thickness varies over the surface.
        pub varying_layers: u32,
        /// The head of the picture of its reflectance; NONE where that is no picture.
        pub picture: u32,
        /// Spectrum: n of the index above a diffuse base, whose k is the next one.
        pub coat: u32,
        /// The part of the light that a base reflects beside the facets of Cook's model.
        pub base_share: f32,
        /// Share of the paths that follow what the base reflects; of a coated body, what stands for its reflectance there.
        pub base_chance: f32,
        /// First of the numbers of the slopes of Cook's model: m, weight and part of each.
        pub first_slope: u32,
        /// Number of these slopes.
        pub slope_count: u32,
        /// Spectrum: reflectance of a coat for diffuse light from outside.
        pub mean_reflectance: u32,
        /// What stands for the index of a coat where a path chooses its way.
        pub coat_estimate: f32,
        /// Spectra: the reflectance of a rough coat for COAT_COSINES cosines.
        pub coat_reflectances: u32,
        /// First of a film's numbers that tell what it reflects.
        pub first_reflected: u32,
        /// About the part of the light that goes on from it.
        pub albedo: f32,
        /// First number of the table by which a brushed coat lets more through in some directions.
        pub first_passage: u32,
    }

    /// A layer of a film or of a coating.
    pub struct Layer {
        /// Spectrum: n of its index, whose k is the next one.
        pub spectrum: u32,
        /// Thickness where it has no fields, nm.
        pub thickness_nm: f32,
        /// First of the fields that its thickness is made of.
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

/// The text of `shaders/layout.wgsl`.
pub fn wgsl() -> String {
    let mut text = String::from(
        "// Generated from crates/gpu/src/layout.rs: edit there, then run\n\
         //     PELLICLE_BLESS=1 cargo test -p pellicle-tests --test layout\n",
    );
    for declaration in CONSTANTS.iter().chain(STRUCTS) {
        text.push_str(&format!("\n///{}\n", declaration.doc));
        match declaration.body {
            Body::Constant(value) => {
                text.push_str(&format!("const {}: u32 = {value}u;\n", declaration.name));
            }
            Body::Struct(fields) => {
                text.push_str(&format!("struct {} {{\n", declaration.name));
                for field in fields {
                    text.push_str(&format!(
                        "    ///{}\n    {}: {},\n",
                        field.doc, field.name, field.wgsl_type
                    ));
                }
                text.push_str("}\n");
            }
        }
    }
    text
}
