// A free film by two beams (Suzuki, Yokoi and Toriwaki, section 4-2): the light that the first boundary reflects, and the light
// that the second reflects once. Kept to reproduce the paper; energy is not conserved, least of all near grazing.

/// Returns the reflectance of a non-absorbing film with n ≥ 1, for unpolarized light.
///
/// With Fresnel's r and t t′ = 1 − r², the sum r² + (t r t′)² + 2 r (t r t′) cos(2π l / λ − π) is
/// r² (r⁴ + 4 (1 − r²) sin²(π l / λ)); l = 2 n d cos θ₂, or 2 d cos θ₂ as the paper prints it.
fn two_beam_reflectance(
    n: vec4f,
    thickness_nm: f32,
    inverse_wavelength: vec4f,
    cosine: f32,
    as_printed: bool,
) -> vec4f {
    let boundary = two_beam_boundary(n, cosine);
    let path = select(boundary.n_cos, boundary.n_cos / n, as_printed);
    let half_turns = 2.0 * thickness_nm * path * inverse_wavelength;
    let sine = sin_pi4(half_turns - round(half_turns));
    let s = two_beams(boundary.r2_s, sine);
    let p = two_beams(boundary.r2_p, sine);
    return 0.5 * (s + p);
}

fn two_beams(r2: vec4f, sine: vec4f) -> vec4f {
    return r2 * (r2 * r2 + 4.0 * (1.0 - r2) * sine * sine);
}

/// Returns the transmittance of the same film, without interference: (t t′)² = (1 − r²)².
fn two_beam_transmittance(n: vec4f, cosine: f32) -> vec4f {
    let boundary = two_beam_boundary(n, cosine);
    let s = 1.0 - boundary.r2_s;
    let p = 1.0 - boundary.r2_p;
    return 0.5 * (s * s + p * p);
}

struct TwoBeamBoundary {
    /// n cos θ₂.
    n_cos: vec4f,
    /// Fresnel's r² of the boundary to air.
    r2_s: vec4f,
    r2_p: vec4f,
}

fn two_beam_boundary(n: vec4f, cosine: f32) -> TwoBeamBoundary {
    let c = max(cosine, GRAZING);
    let n2 = n * n;
    let n_cos = sqrt((n2 - 1.0) + c * c); // √(n² − sin²θ), which would cancel near grazing
    let r_s = (c - n_cos) / (c + n_cos);
    let r_p = (n2 * c - n_cos) / (n2 * c + n_cos);
    return TwoBeamBoundary(n_cos, r_s * r_s, r_p * r_p);
}
