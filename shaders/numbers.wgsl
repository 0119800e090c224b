// Tables of numbers.

/// One of the numbers that the host uploads for look-up.
fn number_at(index: u32) -> f32 {
    return textureLoad(numbers, vec2u(index % NUMBERS_WIDTH, index / NUMBERS_WIDTH), 0).x;
}
