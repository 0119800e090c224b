// Tables that the host uploads: of numbers, and pictures with four numbers per texel.

/// Returns one of the numbers that the host uploads for lookups.
fn number_at(index: u32) -> f32 {
    return textureLoad(numbers, vec2u(index % NUMBERS_WIDTH, index / NUMBERS_WIDTH), 0).x;
}

/// Returns one of the texels that the host uploads.
fn texel_at(index: u32) -> vec4f {
    return textureLoad(texels, vec2u(index % TEXELS_WIDTH, index / TEXELS_WIDTH), 0);
}
