// A free film: one layer with vacuum on both sides, exact interference, unpolarized light.
//
// Sign convention: n + ik with exp(−iωt); k ≥ 0 absorbs. `cosine` in vacuum, in (0, 1];
// `inverse_wavelength` in 1/nm.

/// Smaller cosines are not visible, and f32 keeps all its digits above this one.
const GRAZING: f32 = 1e-6;

/// Returns the reflectance of a non-absorbing film with n ≥ 1; the transmittance is the rest.
///
/// Airy's sum R = F sin²φ / (1 + F sin²φ), φ = 2π n d cos θ₂ / λ (Born and Wolf, 7th ed., section 7.6,
/// equation 15), with F written out, where everything but sin² φ cancels:
/// R_s = (n² − 1)² S / (4 cos²θ (n² − sin²θ) + (n² − 1)² S), and for p with n² cos²θ − cos²θ₂ in place of n² − 1.
fn clear_film_reflectance(n: vec4f, thickness_nm: f32, inverse_wavelength: vec4f, cosine: f32) -> vec4f {
    let c = max(cosine, GRAZING);
    let n2 = n * n;
    let n2_cos2 = (n2 - 1.0) + c * c; // (n cos θ₂)² = n² − sin²θ, which would cancel near grazing
    // φ in half turns, reduced before any sine is computed.
    let half_turns = 2.0 * thickness_nm * sqrt(n2_cos2) * inverse_wavelength;
    let sine = sin_pi4(half_turns - round(half_turns));
    let base = 4.0 * c * c * n2_cos2;
    let s = (n2 - 1.0) * sine;
    let p = (n2 * c * c - n2_cos2 / n2) * sine;
    let s2 = s * s;
    let p2 = p * p;
    // With n = 1 at grazing everything vanishes; the tiny number turns that 0/0 into 0.
    return 0.5 * (s2 / max(base + s2, vec4f(1e-30)) + p2 / max(base + p2, vec4f(1e-30)));
}

struct FilmPowers {
    reflectance: vec4f,
    transmittance: vec4f,
}

/// Returns the reflectance and transmittance of a film of any index.
///
/// r = r₁ (1 − β²) / (1 − r₁² β²), t = (1 − r₁²) β / (1 − r₁² β²), β = exp(2πi n d cos θ₂ / λ)
/// (Born and Wolf, 7th ed., section 7.6, with r₂ = −r₁).
fn film_powers(n: vec4f, k: vec4f, thickness_nm: f32, inverse_wavelength: vec4f, cosine: f32) -> FilmPowers {
    let c = max(cosine, GRAZING);
    let index2 = Complex4(n * n - k * k, 2.0 * n * k);
    // n cos θ₂ = √(n² − sin²θ): the root in the first quadrant propagates forward and decays. 1 − cos² for sin² would cancel.
    let n_cos = complex_sqrt(Complex4((index2.re - 1.0) + c * c, index2.im));
    // β² turns by 2 n d cos θ₂ / λ: twice as many half turns.
    let half_turns = 4.0 * thickness_nm * inverse_wavelength;
    let beta2 = phase_factor(n_cos.re * half_turns, n_cos.im * half_turns);
    let here = Complex4(vec4f(c), vec4f(0.0));
    let r_s = complex_div(complex_sub(here, n_cos), complex_add(here, n_cos));
    let n2c = Complex4(index2.re * c, index2.im * c);
    let r_p = complex_div(complex_sub(n2c, n_cos), complex_add(n2c, n_cos));
    let s = film_of_boundary(r_s, beta2);
    let p = film_of_boundary(r_p, beta2);
    return FilmPowers(
        0.5 * (s.reflectance + p.reflectance),
        0.5 * (s.transmittance + p.transmittance),
    );
}

/// Returns the powers of a film whose two boundaries have amplitudes r₁ and −r₁, for one polarization.
fn film_of_boundary(r: Complex4, beta2: Complex4) -> FilmPowers {
    let one = Complex4(vec4f(1.0), vec4f(0.0));
    let r2 = complex_mul(r, r);
    let denominator = max(complex_norm_sqr(complex_sub(one, complex_mul(r2, beta2))), vec4f(1e-30));
    let reflected = complex_norm_sqr(r) * complex_norm_sqr(complex_sub(one, beta2));
    let beta_norm2 = sqrt(complex_norm_sqr(beta2));
    let transmitted = complex_norm_sqr(complex_sub(one, r2)) * beta_norm2;
    return FilmPowers(reflected / denominator, transmitted / denominator);
}
