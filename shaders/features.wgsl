// What a scene has. A pipeline is created for each scene with these constants set, so that code for features that the scene lacks
// is removed: a processor that runs eight or more paths in lockstep pays for every branch that any of them might take.
//
// Constants that only one kind of surface needs are declared in its own file.

override HAS_SPHERES: bool = true;
override HAS_RECTANGLES: bool = true;
override HAS_DISKS: bool = true;
override HAS_LARGE_SPHERES: bool = true;
override HAS_STACKED_SHAPES: bool = true;
override HAS_HIERARCHY: bool = true;
override HAS_EMITTER_TREE: bool = true;
override HAS_BSDFS: bool = true;
override HAS_SCATTERING: bool = true;
override HAS_SPECULAR: bool = true;
override HAS_GLOW: bool = true;
override HAS_BASES: bool = true;
override HAS_BECKMANN: bool = true;
override HAS_GGX: bool = true;
override HAS_GRAIN: bool = true;
override HAS_FILMS: bool = true;
override HAS_LOSSY_FILMS: bool = true;
override HAS_STACKS: bool = true;
override HAS_TWO_BEAM_FILMS: bool = true;
override HAS_FIELDS: bool = true;
override HAS_COMBINED_FIELDS: bool = true;
override HAS_POLAR_FIELDS: bool = true;
override HAS_LINE_FIELDS: bool = true;
override HAS_SAMPLED_FIELDS: bool = true;
override HAS_SWIRLS: bool = true;
override HAS_PICTURES: bool = true;
override HAS_SPHERE_EMITTERS: bool = true;
override HAS_DISK_EMITTERS: bool = true;
override HAS_DELTA_EMITTERS: bool = true;
override HAS_DISTANT_DISKS: bool = true;
override HAS_EMITTERS: bool = true;
override HAS_EMITTER_CHOICE: bool = true;
override HAS_ENVIRONMENT: bool = true;
override HAS_ENVIRONMENT_PICTURE: bool = true;
override HAS_SPECTRAL_PICTURE: bool = true;
override HAS_PANORAMA: bool = true;
override HAS_ORTHOGRAPHIC: bool = true;
override HAS_SOBOL_SAMPLES: bool = true;
override HAS_SPLITS: bool = true;
override HAS_ROULETTE: bool = true;
override HAS_CLAMP: bool = true;
override HAS_LENS: bool = true;
override HAS_FILTER: bool = true;
// How direct light is found: by emitter sampling, by BSDF sampling, or both.
override SAMPLES_EMITTERS: bool = true;
override SAMPLES_BSDF: bool = true;
// Counts. Conditions depend on these, never on a constant element of a uniform buffer: llvmpipe treats the value that it finds
// there as a constant and recompiles the pipeline for each dispatch.
/// Objects that rays meet.
override OBJECT_COUNT: u32 = 1u;
/// Rows of the hierarchy of boxes around the objects.
override HIERARCHY_ROWS: u32 = 1u;
/// Emitters that are chosen from.
override EMITTER_COUNT: u32 = 1u;
/// Parts of the environment, including disks in the sky.
override ENVIRONMENT_COUNT: u32 = 1u;
/// Groups of four bands; the last may be padded with dark bands.
override GROUPS: u32 = 1u;
/// Maximum number of segments of a path.
override MAX_PATH_SEGMENTS: u32 = 1u;
/// Segments after which Russian roulette may end a path.
override ROULETTE_AFTER: u32 = 1u;
