// Pictures with four numbers in each place.

/// One of the texels that the host uploads.
fn texel_at(index: u32) -> vec4f {
    return textureLoad(texels, vec2u(index % TEXELS_WIDTH, index / TEXELS_WIDTH), 0);
}
