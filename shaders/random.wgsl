// Random numbers as a function of (pixel, sample, dimension, seed): integer arithmetic, the same bits in Rust and on every device,
// independent of the order of work.

/// The generator pcg4d (Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020).
fn pcg4d(key: vec4u) -> vec4u {
    var v = key * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// Returns the upper 24 bits as a multiple of 2⁻²⁴ in [0, 1): exact in f32.
fn unit_interval(bits: vec4u) -> vec4f {
    return vec4f(bits >> vec4u(8u)) * 0x1p-24f;
}

/// Returns four numbers in [0, 1) for a pixel of the whole picture, a sample and a dimension.
fn random4(pixel: vec2u, sample: u32, dimension: u32, seed: u32) -> vec4f {
    let place = pixel.x | (pixel.y << 16u);
    return unit_interval(pcg4d(vec4u(place, sample, dimension, seed)));
}
