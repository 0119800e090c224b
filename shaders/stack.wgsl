// Stacks of any number of layers between two half spaces: exact interference, built from the substrate up.
//
// Sign convention: n + ik with exp(−iωt); k ≥ 0 absorbs. All lengths are in units of the vacuum wavelength. A medium enters by its
// index squared and by q = n cos θ, which Snell's law gives from n² − (n₀ sin θ₀)² without any angle.

/// The fields at the upper end of the layers so far: for s the electric and the magnetic field, for p the magnetic and the electric
/// field, both along the boundary. Only their quotient matters, and their size as given by `passed`.
struct Stack {
    s: TangentialFields,
    p: TangentialFields,
}

struct TangentialFields {
    first: Complex4,
    second: Complex4,
    /// Squared ratio of the first field at the substrate to the first field here, with all scaling undone.
    passed: vec4f,
}

/// The incident medium. It does not absorb.
struct Incident {
    /// Index squared.
    index2: f32,
    /// n₀ cos θ₀ squared; kept, because n₀² − (n₀ sin θ₀)² would have no digits left near grazing.
    q2: f32,
}

/// The admittances of a half space: q for s, q / n² for p, so that second = η · first in a wave that propagates down.
struct Admittances {
    s: Complex4,
    p: Complex4,
}

/// Returns (n cos θ)² = n² − (n₀ sin θ₀)².
fn medium_q2(index2: Complex4, incident: Incident) -> Complex4 {
    return Complex4((index2.re - incident.index2) + incident.q2, index2.im);
}

/// Returns the substrate's admittances. The root in the first quadrant propagates forward and decays.
fn substrate_admittances(n: vec4f, k: vec4f, incident: Incident) -> Admittances {
    let index = Complex4(n, k);
    let index2 = complex_mul(index, index);
    let q = complex_sqrt(medium_q2(index2, incident));
    return Admittances(q, complex_mul(q, complex_recip(index2)));
}

/// Returns a substrate without layers.
fn stack_on(substrate: Admittances) -> Stack {
    let one = Complex4(vec4f(1.0), vec4f(0.0));
    return Stack(TangentialFields(one, substrate.s, vec4f(1.0)), TangentialFields(one, substrate.p, vec4f(1.0)));
}

/// Returns the stack with a layer of index n + ik on top; `thickness` is in wavelengths.
///
/// Abelès' matrix (1950; Born and Wolf, 7th ed., section 1.6.2, equations 38 to 41) times exp(iδ), δ = 2π q d / λ, whose modulus is at most 1:
/// first ← C first − i A second, second ← C second − i B first, with C = cos δ exp(iδ), A = sin δ exp(iδ) / η and
/// B = η sin δ exp(iδ). There is no division by q, so that a layer at its critical angle needs no special case, and an opaque layer
/// only makes the fields smaller.
fn stack_layer(below: Stack, n: vec4f, k: vec4f, thickness: vec4f, incident: Incident) -> Stack {
    let index = Complex4(n, k);
    let index2 = complex_mul(index, index);
    let q2 = medium_q2(index2, incident);
    let phase = layer_phase(complex_sqrt(q2), thickness);
    let b = complex_mul(phase.sine_over_q, q2);
    let s = fields_above(below.s, phase, phase.sine_over_q, b);
    let p = fields_above(
        below.p,
        phase,
        complex_mul(phase.sine_over_q, index2),
        complex_mul(b, complex_recip(index2)),
    );
    return Stack(s, p);
}

struct LayerPhase {
    /// cos δ exp(iδ).
    cosine: Complex4,
    /// sin δ exp(iδ) / q.
    sine_over_q: Complex4,
    /// |exp(iδ)|².
    modulus2: vec4f,
}

fn layer_phase(q: Complex4, thickness: vec4f) -> LayerPhase {
    let half_turns = 4.0 * thickness;
    let beta2 = phase_factor(half_turns * q.re, half_turns * q.im); // exp(2iδ)
    let cosine = Complex4(0.5 * (1.0 + beta2.re), 0.5 * beta2.im);
    // (exp(2x) − 1) / (2x) · 2π d / λ with x = iδ.
    let along = 2.0 * PI * thickness;
    let two_x = Complex4(-2.0 * along * q.im, 2.0 * along * q.re);
    var shape = complex_mul(Complex4(beta2.re - 1.0, beta2.im), complex_recip(two_x));
    let is_small = complex_norm_sqr(two_x) < vec4f(0.25);
    if (any(is_small)) {
        let series = exponential_quotient(two_x);
        shape = Complex4(select(shape.re, series.re, is_small), select(shape.im, series.im, is_small));
    }
    return LayerPhase(cosine, Complex4(along * shape.re, along * shape.im), sqrt(complex_norm_sqr(beta2)));
}

/// Returns (exp(z) − 1) / z = Σ zⁿ / (n + 1)! for |z| < 1/2; the remainder after z⁷ is below 2e-8.
fn exponential_quotient(z: Complex4) -> Complex4 {
    var sum = Complex4(vec4f(1.0 / 40320.0), vec4f(0.0));
    for (var divisor = f32(EXPONENTIAL_TERMS); divisor > 0.0; divisor -= 1.0) {
        sum = complex_mul(sum, z);
        sum.re += INVERSE_FACTORIALS[u32(divisor) - 1u];
    }
    return sum;
}

/// 1/n! from n = 1 on.
const INVERSE_FACTORIALS = array<f32, EXPONENTIAL_TERMS>(1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0);

/// Returns the fields of one polarization at the upper end of a layer, scaled to a size near 1.
fn fields_above(below: TangentialFields, phase: LayerPhase, a: Complex4, b: Complex4) -> TangentialFields {
    let from_second = complex_mul(a, below.second);
    let from_first = complex_mul(b, below.first);
    let own_first = complex_mul(phase.cosine, below.first);
    let own_second = complex_mul(phase.cosine, below.second);
    let first = Complex4(own_first.re + from_second.im, own_first.im - from_second.re);
    let second = Complex4(own_second.re + from_first.im, own_second.im - from_first.re);
    let scale = inverseSqrt(max(complex_norm_sqr(first) + complex_norm_sqr(second), vec4f(1e-30)));
    return TangentialFields(
        Complex4(scale * first.re, scale * first.im),
        Complex4(scale * second.re, scale * second.im),
        below.passed * phase.modulus2 * scale * scale,
    );
}

/// Powers of both polarizations.
struct StackPowers {
    reflectance_s: vec4f,
    reflectance_p: vec4f,
    transmittance_s: vec4f,
    transmittance_p: vec4f,
}

/// Returns the powers of a whole stack seen from the incident medium.
fn stack_powers(stack: Stack, substrate: Admittances, incident: Incident) -> StackPowers {
    let q0 = sqrt(incident.q2);
    let s = powers_of(stack.s, substrate.s, q0);
    let p = powers_of(stack.p, substrate.p, q0 / incident.index2);
    return StackPowers(s.reflectance, p.reflectance, s.transmittance, p.transmittance);
}

struct Powers {
    reflectance: vec4f,
    transmittance: vec4f,
}

/// Returns R = |η₀ F − G|² / |η₀ F + G|² and T = 4 η₀ Re η_substrate |F_substrate|² / |η₀ F + G|² of the fields F and G at the top.
fn powers_of(at_top: TangentialFields, substrate: Complex4, incident: f32) -> Powers {
    let first = complex_scale(incident, at_top.first);
    let sum = max(complex_norm_sqr(complex_add(first, at_top.second)), vec4f(1e-30));
    let reflected = complex_norm_sqr(complex_sub(first, at_top.second));
    return Powers(reflected / sum, 4.0 * incident * substrate.re * at_top.passed / sum);
}
