// Complex numbers, four at a time: one per band of a group.

struct Complex4 {
    re: vec4f,
    im: vec4f,
}

fn complex_add(a: Complex4, b: Complex4) -> Complex4 {
    return Complex4(a.re + b.re, a.im + b.im);
}

fn complex_sub(a: Complex4, b: Complex4) -> Complex4 {
    return Complex4(a.re - b.re, a.im - b.im);
}

fn complex_mul(a: Complex4, b: Complex4) -> Complex4 {
    return Complex4(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

/// Returns a / b; b must not be 0.
fn complex_div(a: Complex4, b: Complex4) -> Complex4 {
    let scale = 1.0 / (b.re * b.re + b.im * b.im);
    return Complex4(
        (a.re * b.re + a.im * b.im) * scale,
        (a.im * b.re - a.re * b.im) * scale,
    );
}

/// Returns 1 / a; where a is 0, a large number.
fn complex_recip(a: Complex4) -> Complex4 {
    let scale = 1.0 / max(a.re * a.re + a.im * a.im, vec4f(1e-37));
    return Complex4(a.re * scale, -a.im * scale);
}

fn complex_scale(factor: f32, a: Complex4) -> Complex4 {
    return Complex4(factor * a.re, factor * a.im);
}

/// Returns |a|².
fn complex_norm_sqr(a: Complex4) -> vec4f {
    return a.re * a.re + a.im * a.im;
}

/// Returns the root with real part ≥ 0; where that is 0, with imaginary part ≥ 0.
fn complex_sqrt(a: Complex4) -> Complex4 {
    let modulus = sqrt(complex_norm_sqr(a));
    // The larger of the two parts is computed without cancellation; the other follows from 2 re·im = Im a.
    let large = sqrt(max(0.5 * (modulus + abs(a.re)), vec4f(1e-36)));
    let small = 0.5 * a.im / large;
    let positive = a.re >= vec4f(0.0);
    let upper = a.im >= vec4f(0.0);
    let re = select(abs(small), large, positive);
    let im = select(select(-large, large, upper), small, positive);
    return Complex4(re, im);
}
