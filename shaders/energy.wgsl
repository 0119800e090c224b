// Tables over the directions from which facets are seen.

/// A number of a material's facets over direction, from the table at `first`: over the cosine and, where the surface is brushed, over the
/// width of the slopes in the direction's azimuth.
fn over_facets(first: u32, material: u32, direction: vec3f) -> f32 {
    let place = sqrt(clamp(direction.z, 0.0, 1.0)) * f32(FACET_COSINES - 1u);
    let row = min(u32(place), FACET_COSINES - 2u);
    let down = place - f32(row);
    let alpha = materials[material].alpha;
    if (!HAS_GRAIN || alpha.x == alpha.y) {
        return mix(number_at(first + row), number_at(first + row + 1u), down);
    }
    let width = length(alpha * direction.xy) / max(length(direction.xy), 1e-12);
    let across = clamp((width - alpha.x) / (alpha.y - alpha.x), 0.0, 1.0) * f32(FACET_WIDTHS - 1u);
    let column = min(u32(across), FACET_WIDTHS - 2u);
    let left = first + column * FACET_COSINES + row;
    let right = left + FACET_COSINES;
    let here = mix(number_at(left), number_at(left + 1u), down);
    let beside = mix(number_at(right), number_at(right + 1u), down);
    return mix(here, beside, across - f32(column));
}

/// The directional albedo E of a material's facets, were they to reflect everything. 1 − E of the light meets another facet.
fn facet_albedo(material: u32, direction: vec3f) -> f32 {
    return over_facets(materials[material].first_energy, material, direction);
}

/// By how much more a rough coat lets through in a direction than its reflectances tell: 1 but for a brushed one.
fn coat_passage(material: u32, direction: vec3f) -> f32 {
    let alpha = materials[material].alpha;
    if (!HAS_GRAIN || alpha.x == alpha.y) {
        return 1.0;
    }
    return over_facets(materials[material].first_passage, material, direction);
}
