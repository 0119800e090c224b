// The phase that a wave gains along its path, in half turns.

/// Returns exp(iπ (re + i·im)) for im ≥ 0 and re of moderate size.
fn phase_factor(re: vec4f, im: vec4f) -> Complex4 {
    let turns = 0.5 * re;
    let rest = turns - round(turns); // exact, in [−1/2, 1/2]
    let sine = sin_pi4(rest);
    let cosine = sin_pi4(0.5 - abs(rest));
    // Beyond exp(−80) nothing returns; the bound keeps the argument where exp is accurate.
    let modulus = exp(-min(PI * im, vec4f(80.0)));
    return Complex4((1.0 - 2.0 * sine * sine) * modulus, 2.0 * sine * cosine * modulus);
}
