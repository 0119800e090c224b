// The data that the host uploads.
//
// Each list of a scene is an array of rows of four words, read by its own function. It is in a storage buffer, as written here,
// or in a uniform buffer or a texture, as a scene's own shader has it.
//
// Generated from crates/gpu/src/layout/bindings.rs: edit there, then run
//     PELLICLE_BLESS=1 cargo test --release -p pellicle-tests --test shader layout::

/// Values for the whole render.
@group(0) @binding(0) var<uniform> frame: Frame;

/// The objects that rays meet.
@group(0) @binding(1) var<storage, read> shapes: array<vec4u>;
fn shapes_row(row: u32) -> vec4u {
    return shapes[row];
}

/// The emitters.
@group(0) @binding(2) var<storage, read> emitters: array<vec4u>;
fn emitters_row(row: u32) -> vec4u {
    return emitters[row];
}

/// Materials and their parts.
@group(0) @binding(3) var<storage, read> records: array<vec4u>;
fn records_row(row: u32) -> vec4u {
    return records[row];
}

/// The hierarchy of boxes around objects, then the tree of emitters.
@group(0) @binding(4) var<storage, read> trees: array<vec4u>;
fn trees_row(row: u32) -> vec4u {
    return trees[row];
}

/// Spectra as the host resampled them: `[spectrum][knot within a band][group of four bands]`.
@group(0) @binding(5) var<storage, read> spectra: array<vec4f>;
fn spectra_row(row: u32) -> vec4f {
    return spectra[row];
}

/// Tables of numbers for lookups, row by row.
@group(0) @binding(6) var numbers: texture_2d<f32>;

/// Pictures with four numbers per texel, with a header before each, row by row.
@group(0) @binding(7) var texels: texture_2d<f32>;

/// The batch, several times. An invocation reads the one at its own layer, which is always the first, at an index that is not a
/// constant. At a constant index, llvmpipe treats values on which conditions depend as constants too, and recompiles the
/// pipeline for each batch.
@group(1) @binding(0) var<uniform> batches: array<Batch, BATCH_COPIES>;

/// Running statistics of each pixel, one after the other:
/// mean radiance, `[light group][group of four bands][pixel of the tile]`;
/// sum of squared deviations of the light of all groups from its mean, `[group of four bands][pixel of the tile]`;
/// mean X, Y, Z, and in w of the first light group the number of samples, `[light group][pixel of the tile]`.
@group(1) @binding(1) var<storage, read_write> sums: array<vec4f>;

/// Values for a run over a batch of stacks.
@group(0) @binding(0) var<uniform> stack_run: StackRun;

/// Wavelengths, four at a time, nm; the last group is padded.
@group(0) @binding(1) var<storage, read> run_wavelengths: array<vec4f>;

/// Cosines in the incident medium.
@group(0) @binding(2) var<storage, read> run_cosines: array<f32>;

/// Indices: n of a medium for each group of wavelengths, then k in the same way; a single group where they are constant.
@group(0) @binding(3) var<storage, read> run_media: array<vec4f>;

/// Layers of all stacks.
@group(0) @binding(4) var<storage, read> run_layers: array<RunLayer>;

/// The stacks.
@group(0) @binding(5) var<storage, read> run_stacks: array<RunStack>;

/// R_s, R_p, T_s, T_p: `[stack of this run][angle][wavelength]`.
@group(0) @binding(6) var<storage, read_write> run_powers: array<vec4f>;
