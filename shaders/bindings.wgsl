// What the host uploads for a scene.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> objects: array<Object>;
@group(0) @binding(2) var<storage, read> materials: array<Material>;
/// Indices of the objects that light can be sent from.
@group(0) @binding(3) var<storage, read> lights: array<u32>;
/// Spectra as the host resampled them: [spectrum][knot within a band][group of four bands].
@group(0) @binding(4) var<storage, read> spectra: array<vec4f>;
