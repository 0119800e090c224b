// Stacks of any number of layers between two half spaces: exact interference, built from the substrate upwards.
//
// Sign convention: n + ik with exp(−iωt); k ≥ 0 absorbs. All lengths over the vacuum wavelength. A medium enters by its
// index n + ik and by q = n cos θ, which Snell's law gives from n² − (n₀ sin θ₀)² without any angle.

/// What lies below a boundary: the medium just below it and the amplitudes of everything further down.
struct Stack {
    index: Complex4,
    /// The index squared.
    index2: Complex4,
    /// n cos θ.
    q: Complex4,
    /// Reflection and transmission of what lies below, for s and p.
    r_s: Complex4,
    r_p: Complex4,
    t_s: Complex4,
    t_p: Complex4,
}

/// The medium that light comes from. It does not absorb.
struct Incident {
    /// Its index squared.
    index2: f32,
    /// n₀ cos θ₀ squared; carried, since n₀² − (n₀ sin θ₀)² would have no digits left near grazing.
    q2: f32,
}

/// A substrate with nothing below it.
fn stack_on(n: vec4f, k: vec4f, incident: Incident) -> Stack {
    let index = Complex4(n, k);
    let index2 = complex_mul(index, index);
    let zero = Complex4(vec4f(0.0), vec4f(0.0));
    let one = Complex4(vec4f(1.0), vec4f(0.0));
    return Stack(index, index2, medium_q(index2, incident), zero, zero, one, one);
}

/// n cos θ = √(n² − (n₀ sin θ₀)²): the root in the first quadrant runs forward and decays.
fn medium_q(index2: Complex4, incident: Incident) -> Complex4 {
    return complex_sqrt(Complex4((index2.re - incident.index2) + incident.q2, index2.im));
}

/// The stack with a layer of index n + ik on top, as seen from inside that layer's upper end.
///
/// `thickness` is in wavelengths. Each layer adds its lower boundary to what lies below,
/// r ← (r_j + r) / (1 + r_j r), t ← t_j t / (1 + r_j r), and then its own length, r ← r β², t ← t β with
/// β = exp(2πi q d / λ), |β| ≤ 1 (Rouard 1937; Heavens, Optical Properties of Thin Solid Films, 1955, section 4.2).
fn stack_layer(below: Stack, n: vec4f, k: vec4f, thickness: vec4f, incident: Incident) -> Stack {
    let index = Complex4(n, k);
    let index2 = complex_mul(index, index);
    var above = stack_boundary(below, index, index2, medium_q(index2, incident));
    // In half turns: 2 q d / λ.
    let beta = phase_factor(2.0 * thickness * above.q.re, 2.0 * thickness * above.q.im);
    let beta2 = complex_mul(beta, beta);
    above.r_s = complex_mul(above.r_s, beta2);
    above.r_p = complex_mul(above.r_p, beta2);
    above.t_s = complex_mul(above.t_s, beta);
    above.t_p = complex_mul(above.t_p, beta);
    return above;
}

/// The stack as seen from just above the boundary to a medium that lies on it.
///
/// Fresnel's r_j = u / v with u = q − q′, v = q + q′ for s and u = n′² q − n² q′, v = n′² q + n² q′ for p, so that
/// r = (u + v r) / (v + u r) takes a single division.
fn stack_boundary(below: Stack, index: Complex4, index2: Complex4, q: Complex4) -> Stack {
    let near = complex_mul(below.index2, q);
    let far = complex_mul(index2, below.q);
    let s = stack_join(complex_sub(q, below.q), complex_add(q, below.q), below.r_s, below.t_s);
    let p = stack_join(complex_sub(near, far), complex_add(near, far), below.r_p, below.t_p);
    let step_s = complex_scale(2.0, q);
    let step_p = complex_mul(step_s, complex_mul(index, below.index));
    return Stack(index, index2, q, s.r, p.r, complex_mul(step_s, s.t), complex_mul(step_p, p.t));
}

/// Reflection and transmission of one polarisation.
struct Joined {
    r: Complex4,
    t: Complex4,
}

/// (u + v r) / (v + u r) and t / (v + u r).
fn stack_join(u: Complex4, v: Complex4, r: Complex4, t: Complex4) -> Joined {
    let inverse = complex_inverse(complex_add(v, complex_mul(u, r)));
    return Joined(
        complex_mul(complex_add(u, complex_mul(v, r)), inverse),
        complex_mul(t, inverse),
    );
}

/// Powers of both polarisations.
struct StackPowers {
    reflectance_s: vec4f,
    reflectance_p: vec4f,
    transmittance_s: vec4f,
    transmittance_p: vec4f,
}

/// The powers of a whole stack seen from the incident medium, on the substrate that the stack began with:
/// R = |r|², T_s = |t|² Re q / q₀ and T_p = |t|² Re(n cos* θ) / q₀
/// (Byrnes, arXiv:1603.02720, equations 19 to 22).
fn stack_powers(below: Stack, substrate: Stack, incident: Incident) -> StackPowers {
    let zero = vec4f(0.0);
    let index = Complex4(vec4f(sqrt(incident.index2)), zero);
    let index2 = Complex4(vec4f(incident.index2), zero);
    let q0 = vec4f(sqrt(incident.q2));
    let whole = stack_boundary(below, index, index2, Complex4(q0, zero));
    let n2 = substrate.index2;
    // Re(n cos* θ) = Re(n² q*) / |n|².
    let leaves_s = substrate.q.re;
    let leaves_p = (n2.re * substrate.q.re + n2.im * substrate.q.im) / sqrt(complex_norm2(n2));
    return StackPowers(
        complex_norm2(whole.r_s),
        complex_norm2(whole.r_p),
        complex_norm2(whole.t_s) * leaves_s / q0,
        complex_norm2(whole.t_p) * leaves_p / q0,
    );
}
