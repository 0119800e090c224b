// What a scene has. This file says that it has one of everything; a scene's own shader has the scene's values.
//
// Code for features that the scene lacks is removed: a processor that runs eight or more paths in lockstep pays for every
// branch that any of them might take. Conditions depend on these constants, never on a constant element of a uniform
// buffer: llvmpipe treats the value that it finds there as a constant and recompiles the pipeline for each dispatch.
//
// Generated from crates/gpu/src/features.rs and counts.rs: edit there, then run
//     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::

/// A sphere among the objects.
const HAS_SPHERES: bool = true;
/// A rectangle among the objects.
const HAS_RECTANGLES: bool = true;
/// A disk among the objects.
const HAS_DISKS: bool = true;
/// A sphere that is given by its curvature, because its center is too far away.
const HAS_LARGE_SPHERES: bool = true;
/// Objects that coincide.
const HAS_STACKED_SHAPES: bool = true;
/// A hierarchy of boxes around many objects.
const HAS_HIERARCHY: bool = true;
/// An emitter that is sampled.
const HAS_EMITTERS: bool = true;
/// Several emitters, of which each sample chooses one.
const HAS_EMITTER_CHOICE: bool = true;
/// A tree of many emitters.
const HAS_EMITTER_TREE: bool = true;
/// An object that emits and is a sphere.
const HAS_SPHERE_EMITTERS: bool = true;
/// An object that emits and is a disk.
const HAS_DISK_EMITTERS: bool = true;
/// A light with a single direction at each point.
const HAS_DELTA_EMITTERS: bool = true;
/// A disk in the sky.
const HAS_DISTANT_DISKS: bool = true;
/// An environment that emits.
const HAS_ENVIRONMENT: bool = true;
/// An environment that is a picture.
const HAS_ENVIRONMENT_PICTURE: bool = true;
/// A picture of the environment with a spectrum in each pixel.
const HAS_SPECTRAL_PICTURE: bool = true;
/// Direct light is found by emitter sampling.
const SAMPLES_EMITTERS: bool = true;
/// Direct light is found by BSDF sampling.
const SAMPLES_BSDF: bool = true;
/// Films that split a path.
const HAS_SPLITS: bool = true;
/// Russian roulette before the last segment.
const HAS_ROULETTE: bool = true;
/// A bound on the radiance of a sample.
const HAS_CLAMP: bool = true;
/// Samples by Sobol's sequence.
const HAS_SOBOL_SAMPLES: bool = true;
/// Light that is traced with its polarization.
const HAS_POLARIZATION: bool = true;
/// Emitters of polarized light.
const HAS_EMITTED_POLARIZATION: bool = true;
/// A polarizer in front of the camera.
const HAS_POLARIZER: bool = true;
/// A camera that sees all directions.
const HAS_PANORAMA: bool = true;
/// A camera with parallel directions of view.
const HAS_ORTHOGRAPHIC: bool = true;
/// A camera with a lens.
const HAS_LENS: bool = true;
/// A filter that distributes a pixel's samples unevenly.
const HAS_FILTER: bool = true;
/// A surface with a BSDF: neither black nor a film.
const HAS_BSDFS: bool = true;
/// A surface that scatters light in directions that are sampled by a density.
const HAS_SCATTERING: bool = true;
/// A surface that also scatters in a single direction.
const HAS_SPECULAR: bool = true;
/// A surface that both emits and reflects.
const HAS_GLOW: bool = true;
/// A body below a coat, or a Lambertian fraction beside facets.
const HAS_BASES: bool = true;
/// A reflectance that is a checker.
const HAS_CHECKERS: bool = true;
/// A reflectance that is a picture.
const HAS_TEXTURES: bool = true;
/// A conductor.
const HAS_INTERFACES: bool = true;
/// A smooth conductor.
const HAS_MIRRORS: bool = true;
/// A rough conductor.
const HAS_ROUGH_CONDUCTORS: bool = true;
/// Layers on a conductor.
const HAS_COATINGS: bool = true;
/// A diffuse body below a smooth coat.
const HAS_COATED_BODIES: bool = true;
/// A diffuse body below a rough coat.
const HAS_ROUGH_COATS: bool = true;
/// The model of Cook and Torrance.
const HAS_COOK: bool = true;
/// Facets of Beckmann's distribution.
const HAS_BECKMANN: bool = true;
/// Facets of the distribution of Trowbridge and Reitz.
const HAS_GGX: bool = true;
/// A brushed surface.
const HAS_GRAIN: bool = true;
/// A free film.
const HAS_FILMS: bool = true;
/// A free film of one layer of any index.
const HAS_LOSSY_FILMS: bool = true;
/// A free film of several layers.
const HAS_STACKS: bool = true;
/// A free film by two beams.
const HAS_TWO_BEAM_FILMS: bool = true;
/// A layer whose thickness varies over a surface.
const HAS_FIELDS: bool = true;
/// A thickness that is a sum or a product.
const HAS_COMBINED_FIELDS: bool = true;
/// A thickness that varies along the polar angle.
const HAS_POLAR_FIELDS: bool = true;
/// A thickness that varies along a line.
const HAS_LINE_FIELDS: bool = true;
/// A thickness in steps, or by a table.
const HAS_SAMPLED_FIELDS: bool = true;
/// A thickness with swirls.
const HAS_SWIRLS: bool = true;
/// A thickness that is a picture.
const HAS_PICTURES: bool = true;

/// Objects that rays meet.
const OBJECT_COUNT: u32 = 1u;
/// Rows of the hierarchy of boxes around the objects.
const HIERARCHY_ROWS: u32 = 1u;
/// Emitters that are chosen from.
const EMITTER_COUNT: u32 = 1u;
/// Parts of the environment, including disks in the sky.
const ENVIRONMENT_COUNT: u32 = 1u;
/// Groups of four bands; the last may be padded with dark bands.
const GROUPS: u32 = 1u;
/// Maximum number of segments of a path.
const MAX_PATH_SEGMENTS: u32 = 1u;
/// Segments after which Russian roulette may end a path.
const ROULETTE_AFTER: u32 = 1u;

/// Vertices of a path.
const MAX_VERTICES: u32 = 1u;
/// Films that all emitter samples of a path cross together.
const MAX_CROSSINGS: u32 = 1u;
/// Thicknesses of layers that vary over a surface, for all vertices and crossings together; 1 where none varies.
const MAX_THICKNESSES: u32 = 1u;
/// Light groups.
const LIGHT_GROUPS: u32 = 1u;
/// Films at which a path is split, 1 where it is never split.
const MAX_SPLITS: u32 = 1u;
