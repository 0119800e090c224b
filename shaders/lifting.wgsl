// Smooth spectra for colors (Jakob and Hanika, Computer Graphics Forum 38 (2), 2019).

/// Returns S(c₀ t² + c₁ t + c₂) in the four bands of a group, S(x) = 1/2 + x / (2 √(1 + x²)) (equations 4 and 5), t = (λ − 580 nm) / 200 nm.
fn smooth_value(coefficients: vec3f, group: u32, at: Wavelengths) -> vec4f {
    let band = f32(4u * group) + at.offset + vec4f(0.0, 1.0, 2.0, 3.0);
    let t = (frame.band_min_nm - 580.0 + band * frame.band_width_nm) / 200.0;
    let x = (coefficients.x * t + coefficients.y) * t + coefficients.z;
    // 1 − S(|x|), without the cancellation of a small difference.
    let root = sqrt(1.0 + x * x);
    let tail = 0.5 / (root * (root + abs(x)));
    return select(1.0 - tail, tail, x < vec4f(0.0));
}
