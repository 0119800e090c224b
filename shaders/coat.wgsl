// A diffuse body below a clear coat.

/// Share of the paths that are mirrored by a smooth coat rather than sent on by the body below it: by an estimate of what either
/// brings. It steers noise only: the weights undo it.
fn coat_share(material: u32, cosine: f32) -> f32 {
    let n = vec4f(materials[material].coat_estimate);
    let reflected = reflectance_unpolarised(n, vec4f(0.0), max(cosine, 1e-6)).x;
    return reflected / max(reflected + (1.0 - reflected) * materials[material].base_chance, 1e-6);
}

/// The part of light in a direction that a clear coat of index n lets in, or out of the body that way.
fn coat_passes(n: vec4f, cosine: f32) -> vec4f {
    return 1.0 - reflectance_unpolarised(n, vec4f(0.0), max(cosine, 1e-6));
}

/// P/ρ of a body of reflectance ρ below a coat of index n whose reflectance for diffuse light is `outer`:
/// 1 / (n² − ρ (n² − 1 + Ē)).
fn coated_albedo_factor(base: vec4f, n: vec4f, outer: vec4f) -> vec4f {
    let n2 = n * n;
    return 1.0 / (n2 - base * (n2 - 1.0 + outer));
}
