// What the host uploads for a scene.

@group(0) @binding(0) var<uniform> frame: Frame;
/// What rays meet.
@group(0) @binding(1) var<storage, read> shapes: array<Shape>;
/// What light is sent from.
@group(0) @binding(2) var<storage, read> emitters: array<Emitter>;
/// Materials, and what they are made of; each a whole number of rows.
@group(0) @binding(3) var<storage, read> records: array<vec4u>;
/// Spectra as the host resampled them: [spectrum][knot within a band][group of four bands].
@group(0) @binding(4) var<storage, read> spectra: array<vec4f>;
/// Tables that anything looks numbers up in, row by row.
@group(0) @binding(5) var numbers: texture_2d<f32>;
/// Pictures with four numbers in each place, a head before each, row by row.
@group(0) @binding(6) var texels: texture_2d<f32>;
