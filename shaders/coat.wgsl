// A diffuse body below a clear coat.

/// Share of the paths that are mirrored by a smooth coat rather than sent on by the body below it: by an estimate of what either
/// brings. It steers noise only: the weights undo it.
fn coat_share(material: u32, cosine: f32) -> f32 {
    let n = vec4f(materials[material].coat_estimate);
    let reflected = reflectance_unpolarised(n, vec4f(0.0), max(cosine, 1e-6)).x;
    let share = reflected / max(reflected + (1.0 - reflected) * materials[material].base_chance, 1e-6);
    // A rough coat reflects less near grazing than a smooth one: both must stay within reach.
    return select(share, clamp(share, 0.1, 0.9), materials[material].surface == SURFACE_ROUGH_COATED_BODY);
}

/// The part of light in a direction that a clear coat of index n lets in, or out of the body that way.
fn coat_passes(n: vec4f, cosine: f32) -> vec4f {
    return 1.0 - reflectance_unpolarised(n, vec4f(0.0), max(cosine, 1e-6));
}

/// The part of light in a direction that a rough coat lets in, or out of the body that way: 1 less the reflectance of its table.
fn rough_coat_passes(material: u32, cosine: f32, group: u32, at: Wavelengths) -> vec4f {
    let place = sqrt(clamp(cosine, 0.0, 1.0)) * f32(COAT_COSINES - 1u);
    let knot = min(u32(place), COAT_COSINES - 2u);
    let first = materials[material].coat_reflectances + knot;
    return 1.0 - mix(spectrum_at(first, group, at), spectrum_at(first + 1u, group, at), place - f32(knot));
}

/// P/ρ of a body of reflectance ρ below a coat of index n whose reflectance for diffuse light is `outer`:
/// 1 / (n² − ρ (n² − 1 + Ē)).
fn coated_albedo_factor(base: vec4f, n: vec4f, outer: vec4f) -> vec4f {
    let n2 = n * n;
    return 1.0 / (n2 - base * (n2 - 1.0 + outer));
}
