// Mueller matrices of interfaces, films and surfaces, in four bands.

/// What an interface or a film does to polarized light, about the axis s: |a_s|², |a_p|², and the real and imaginary part of a_s a_p*, with
/// the amplitudes a of reflection or of transmission.
struct PolarizedPowers {
    s: vec4f,
    p: vec4f,
    re: vec4f,
    im: vec4f,
}

/// Those of reflected and of transmitted light.
struct PolarizedFilm {
    reflected: PolarizedPowers,
    transmitted: PolarizedPowers,
}

/// The elements of a Mueller matrix that are not 0, for reference axes in the planes of incidence. M33 = M22 and M32 = −M23.
struct Mueller {
    m00: vec4f,
    m01: vec4f,
    m10: vec4f,
    m11: vec4f,
    m22: vec4f,
    m23: vec4f,
}

/// A Stokes vector in four bands.
struct Stokes4 {
    s0: vec4f,
    s1: vec4f,
    s2: vec4f,
    s3: vec4f,
}

/// The matrices of a vertex in four bands, with their weights.
struct MuellerValues {
    /// For the path that continues.
    onward: Mueller,
    /// For the emission that joins here.
    lit: Mueller,
}

/// Returns the matrix of amplitudes for s and p, times a weight.
fn mueller_of(powers: PolarizedPowers, weight: f32) -> Mueller {
    let mean = (0.5 * weight) * (powers.s + powers.p);
    let half = (0.5 * weight) * (powers.s - powers.p);
    return Mueller(mean, half, half, mean, weight * powers.re, -weight * powers.im);
}

/// Returns the powers of one of two sides.
fn selected_powers(a: PolarizedPowers, b: PolarizedPowers, is_second: bool) -> PolarizedPowers {
    return PolarizedPowers(
        select(a.s, b.s, is_second),
        select(a.p, b.p, is_second),
        select(a.re, b.re, is_second),
        select(a.im, b.im, is_second),
    );
}

/// Returns the matrix that changes nothing.
fn mueller_identity() -> Mueller {
    let one = vec4f(1.0);
    let zero = vec4f(0.0);
    return Mueller(one, zero, zero, one, one, zero);
}

/// Returns the matrix of a surface that only depolarizes.
fn mueller_depolarizer(value: vec4f) -> Mueller {
    let zero = vec4f(0.0);
    return Mueller(value, zero, zero, zero, zero, zero);
}

/// Returns a matrix that takes the powers of s and p of what arrives and gives those of what leaves, without phases.
fn mueller_product(out_s: vec4f, out_p: vec4f, in_s: vec4f, in_p: vec4f, weight: vec4f) -> Mueller {
    let out_mean = 0.5 * weight * (out_s + out_p);
    let out_half = 0.5 * weight * (out_s - out_p);
    let in_mean = 0.5 * (in_s + in_p);
    let in_half = 0.5 * (in_s - in_p);
    return Mueller(out_mean * in_mean, out_mean * in_half, out_half * in_mean, out_half * in_half, vec4f(0.0), vec4f(0.0));
}

/// Returns the sum of two matrices.
fn mueller_sum(a: Mueller, b: Mueller) -> Mueller {
    return Mueller(a.m00 + b.m00, a.m01 + b.m01, a.m10 + b.m10, a.m11 + b.m11, a.m22 + b.m22, a.m23 + b.m23);
}

/// Returns the matrix with a depolarizing part added.
fn mueller_and_depolarizer(matrix: Mueller, more: vec4f) -> Mueller {
    var sum = matrix;
    sum.m00 += more;
    return sum;
}

/// Returns a Stokes vector multiplied by a matrix.
fn mueller_apply(m: Mueller, light: Stokes4) -> Stokes4 {
    return Stokes4(
        m.m00 * light.s0 + m.m01 * light.s1,
        m.m10 * light.s0 + m.m11 * light.s1,
        m.m22 * light.s2 + m.m23 * light.s3,
        m.m22 * light.s3 - m.m23 * light.s2,
    );
}

/// Returns a Stokes vector about its axis after a turn.
fn stokes_turned(turn: vec2f, light: Stokes4) -> Stokes4 {
    return Stokes4(
        light.s0,
        turn.x * light.s1 + turn.y * light.s2,
        turn.x * light.s2 - turn.y * light.s1,
        light.s3,
    );
}

/// Returns the sum of two Stokes vectors.
fn stokes_sum(a: Stokes4, b: Stokes4) -> Stokes4 {
    return Stokes4(a.s0 + b.s0, a.s1 + b.s1, a.s2 + b.s2, a.s3 + b.s3);
}

/// Returns a Stokes vector times a factor.
fn stokes_scaled(light: Stokes4, factor: f32) -> Stokes4 {
    return Stokes4(factor * light.s0, factor * light.s1, factor * light.s2, factor * light.s3);
}
