// The data that the host uploads for a scene.
//
// Each list is an array of rows of four words, read by its own function. It is in a storage buffer, as written here, or in a
// uniform buffer or a texture; in that case the host rewrites these lines.

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

/// Spectra as the host resampled them: [spectrum][knot within a band][group of four bands].
@group(0) @binding(5) var<storage, read> spectra: array<vec4f>;
fn spectra_row(row: u32) -> vec4f {
    return spectra[row];
}

/// Tables of numbers for lookups, row by row.
@group(0) @binding(6) var numbers: texture_2d<f32>;
/// Pictures with four numbers per texel, with a header before each, row by row.
@group(0) @binding(7) var texels: texture_2d<f32>;
