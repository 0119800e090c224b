// One boundary between vacuum and an opaque medium.

/// Returns the reflectance for unpolarized light of a half space of index n + ik, seen from vacuum.
///
/// With a + ib = √((n + ik)² − sin²θ): R_s = |(cos θ − (a + ib)) / (cos θ + (a + ib))|² and
/// R_p = R_s |((a + ib) cos θ − sin²θ) / ((a + ib) cos θ + sin²θ)|² (Born and Wolf, 7th ed., section 14.4.1).
/// `cosine` in (0, 1].
fn reflectance_unpolarized(n: vec4f, k: vec4f, cosine: f32) -> vec4f {
    let sin2 = (1.0 - cosine) * (1.0 + cosine);
    // n² − k² − sin²θ, without the cancellation near grazing.
    let root = complex_sqrt(Complex4((n * n - k * k - 1.0) + cosine * cosine, 2.0 * n * k));
    let a = root.re;
    let b2 = root.im * root.im;
    let less = a - cosine;
    let more = a + cosine;
    let r_s = (less * less + b2) / max(more * more + b2, vec4f(1e-30));
    let steep = b2 * cosine * cosine;
    let below = a * cosine - sin2;
    let above = a * cosine + sin2;
    // At normal incidence and index 0 both vanish; the tiny number turns that 0/0 into 0.
    let ratio = (below * below + steep) / max(above * above + steep, vec4f(1e-30));
    return 0.5 * r_s * (1.0 + ratio);
}
