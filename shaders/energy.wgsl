// How much of the light that falls onto facets leaves at once.

/// The directional albedo E of a material's facets, were they to reflect everything: a table over direction. 1 − E of the light
/// meets another facet.
fn facet_albedo(material: u32, direction: vec3f) -> f32 {
    let place = sqrt(clamp(direction.z, 0.0, 1.0)) * f32(ENERGY_COSINES - 1u);
    let row = min(u32(place), ENERGY_COSINES - 2u);
    let down = place - f32(row);
    let alpha = materials[material].alpha;
    let first = materials[material].first_energy + row;
    if (!HAS_GRAIN || alpha.x == alpha.y) {
        return mix(number_at(first), number_at(first + 1u), down);
    }
    let width = length(alpha * direction.xy) / max(length(direction.xy), 1e-12);
    let across = clamp((width - alpha.x) / (alpha.y - alpha.x), 0.0, 1.0) * f32(ENERGY_WIDTHS - 1u);
    let column = min(u32(across), ENERGY_WIDTHS - 2u);
    let left = first + column * ENERGY_COSINES;
    let right = left + ENERGY_COSINES;
    let here = mix(number_at(left), number_at(left + 1u), down);
    let beside = mix(number_at(right), number_at(right + 1u), down);
    return mix(here, beside, across - f32(column));
}
