//! The rows of a scene's lists: shapes, emitters, materials and their parts, and trees.

use super::declare::{Body, Declaration, Member, Shared, larger};

/// A record that can be in the list of records.
pub trait Record: bytemuck::Pod {
    /// Number of rows of four words.
    const ROWS: u32 = (size_of::<Self>() / 16) as u32;
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
        /// Row of the record of its picture, a [`Panorama`]; without a picture, that of its polarization, an [`Polarization`], or NONE.
        pub record: u32,
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
        /// Row of the polarization of its emission, an [`Polarization`]; NONE where that is unpolarized.
        pub polarization: u32,
        /// Padding to whole rows.
        pub padding: u32,
    }

    /// How emitted light is polarized.
    pub struct Polarization {
        /// S1, S2 and S3 over S0.
        pub stokes: [f32; 3],
        /// A `POLARIZED_` tag.
        pub kind: u32,
        /// The reference axis, or the direction toward the sun: a unit vector.
        pub axis: [f32; 3],
        /// The degree of polarization of the sky at 90° from the sun.
        pub degree: f32,
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
        /// Row of the polarization of its light, an [`Polarization`]; NONE where that is unpolarized.
        pub polarization: u32,
        /// Padding to whole rows.
        pub padding: u32,
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

/// All records, by the list that they are in.
pub(super) const LISTS: [(&str, &[Declaration]); 4] = [
    ("shapes", SHAPES),
    ("emitters", EMITTERS),
    ("records", RECORDS),
    ("trees", TREES),
];
