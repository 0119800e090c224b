// The body below a clear coat.

/// Returns P/ρ of a body of reflectance ρ below a coat of index n whose reflectance for diffuse light is `outer`:
/// 1 / (n² − ρ (n² − 1 + Ē)).
fn coated_albedo_factor(base: vec4f, n: vec4f, outer: vec4f) -> vec4f {
    let n2 = n * n;
    return 1.0 / (n2 - base * (n2 - 1.0 + outer));
}
