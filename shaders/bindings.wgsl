// What the host uploads for a scene.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> objects: array<Object>;
@group(0) @binding(2) var<storage, read> materials: array<Material>;
/// Layers of films, a material's own one after another.
@group(0) @binding(3) var<storage, read> layers: array<Layer>;
/// Spectra as the host resampled them: [spectrum][knot within a band][group of four bands].
@group(0) @binding(4) var<storage, read> spectra: array<vec4f>;
/// What thicknesses that vary are made of, those of a layer one after another in postfix order.
@group(0) @binding(5) var<storage, read> fields: array<Field>;
/// Tables that anything looks numbers up in, row by row.
@group(0) @binding(6) var numbers: texture_2d<f32>;
/// Pictures with four numbers in each place, a head before each, row by row.
@group(0) @binding(7) var texels: texture_2d<f32>;
