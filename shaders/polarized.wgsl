// Interfaces and free films for polarized light: the twins of fresnel.wgsl, film.wgsl, two_beam.wgsl and stack.wgsl, with phases kept.

/// Returns what a half space of index n + ik reflects, seen from vacuum.
///
/// With q = √((n + ik)² − sin²θ): r_s = (cos θ − q) / (cos θ + q) and r_p = −r_s (q cos θ − sin²θ) / (q cos θ + sin²θ) (Born and Wolf, 7th ed.,
/// section 14.4.1, with r_p = −r_s at normal incidence). `cosine` in (0, 1].
fn interface_polarized(n: vec4f, k: vec4f, cosine: f32) -> PolarizedPowers {
    let sin2 = (1.0 - cosine) * (1.0 + cosine);
    let root = complex_sqrt(Complex4((n * n - k * k - 1.0) + cosine * cosine, 2.0 * n * k));
    let a = root.re;
    let b = root.im;
    let less = a - cosine;
    let more = a + cosine;
    let r_s = (less * less + b * b) / max(more * more + b * b, vec4f(1e-30));
    let along = a * cosine;
    let across = b * cosine;
    let below = along - sin2;
    let above = along + sin2;
    let steep = across * across;
    let scale = r_s / max(above * above + steep, vec4f(1e-30));
    return PolarizedPowers(
        r_s,
        scale * (below * below + steep),
        -scale * (below * above + steep),
        scale * (2.0 * sin2 * across),
    );
}

/// Returns what a non-absorbing film with n ≥ 1 reflects and transmits.
///
/// With δ = 2π n d cos θ₂ / λ, q = n cos θ₂ and c = cos θ: r = i f sin δ / D, t = 1 / D, D = cos δ − i e sin δ, where f = (q² − c²) / 2cq and
/// e = (q² + c²) / 2cq for s; for p the same with q / n² in place of q (Born and Wolf, 7th ed., section 1.6.4, equations 58 to 60).
fn clear_film_polarized(n: vec4f, thickness_nm: f32, inverse_wavelength: vec4f, cosine: f32) -> PolarizedFilm {
    let c = max(cosine, GRAZING);
    let n2 = n * n;
    let q2 = (n2 - 1.0) + c * c;
    let half_turns = 2.0 * thickness_nm * sqrt(q2) * inverse_wavelength;
    let rest = half_turns - round(half_turns);
    let sine = sin_pi4(rest);
    let cosine_of_phase = sin_pi4(0.5 - abs(rest));
    let over = 0.5 / (c * sqrt(q2));
    let f_s = (n2 - 1.0) * over;
    let f_p = (q2 / n2 - n2 * c * c) * over;
    let e_s = (q2 + c * c) * over;
    let e_p = (q2 / n2 + n2 * c * c) * over;
    let s = f_s * sine;
    let p = f_p * sine;
    let t_s = 1.0 / (1.0 + s * s);
    let t_p = 1.0 / (1.0 + p * p);
    let both = t_s * t_p;
    // 1 / (D_s D_p*), with e_s sin δ and e_p sin δ from the same sine.
    let re = both * (cosine_of_phase * cosine_of_phase + (e_s * sine) * (e_p * sine));
    let im = both * ((e_s - e_p) * sine * cosine_of_phase);
    let reflects = s * p;
    return PolarizedFilm(
        PolarizedPowers(s * s * t_s, p * p * t_p, reflects * re, reflects * im),
        PolarizedPowers(t_s, t_p, re, im),
    );
}

/// Returns what a film of any index reflects and transmits: r = r₁ (1 − β²) / (1 − r₁² β²) and t = (1 − r₁²) β / (1 − r₁² β²), as in film_powers.
fn film_polarized(n: vec4f, k: vec4f, thickness_nm: f32, inverse_wavelength: vec4f, cosine: f32) -> PolarizedFilm {
    let c = max(cosine, GRAZING);
    let index2 = Complex4(n * n - k * k, 2.0 * n * k);
    let n_cos = complex_sqrt(Complex4((index2.re - 1.0) + c * c, index2.im));
    let half_turns = 4.0 * thickness_nm * inverse_wavelength;
    let beta2 = phase_factor(n_cos.re * half_turns, n_cos.im * half_turns);
    let here = Complex4(vec4f(c), vec4f(0.0));
    let r_s = complex_div(complex_sub(here, n_cos), complex_add(here, n_cos));
    let n2c = Complex4(index2.re * c, index2.im * c);
    let r_p = complex_div(complex_sub(n2c, n_cos), complex_add(n2c, n_cos));
    let one = Complex4(vec4f(1.0), vec4f(0.0));
    let rest = complex_sub(one, beta2);
    let s = boundary_amplitudes(r_s, beta2);
    let p = boundary_amplitudes(r_p, beta2);
    let reflected = amplitude_powers(complex_mul(r_s, s.over), complex_mul(r_p, p.over));
    let transmitted = amplitude_powers(complex_mul(s.through, s.over), complex_mul(p.through, p.over));
    let mirrored = complex_norm_sqr(rest);
    let passed = sqrt(complex_norm_sqr(beta2));
    return PolarizedFilm(scaled_powers(reflected, mirrored), scaled_powers(transmitted, passed));
}

struct BoundaryAmplitudes {
    /// 1 / (1 − r₁² β²).
    over: Complex4,
    /// 1 − r₁².
    through: Complex4,
}

fn boundary_amplitudes(r: Complex4, beta2: Complex4) -> BoundaryAmplitudes {
    let one = Complex4(vec4f(1.0), vec4f(0.0));
    let r2 = complex_mul(r, r);
    let over = complex_recip(complex_sub(one, complex_mul(r2, beta2)));
    return BoundaryAmplitudes(over, complex_sub(one, r2));
}

/// Returns |a_s|², |a_p|² and a_s a_p* of two amplitudes.
fn amplitude_powers(s: Complex4, p: Complex4) -> PolarizedPowers {
    return PolarizedPowers(complex_norm_sqr(s), complex_norm_sqr(p), s.re * p.re + s.im * p.im, s.im * p.re - s.re * p.im);
}

fn scaled_powers(powers: PolarizedPowers, factor: vec4f) -> PolarizedPowers {
    return PolarizedPowers(factor * powers.s, factor * powers.p, factor * powers.re, factor * powers.im);
}

/// Returns what a film reflects and transmits by two beams: the amplitude r − (1 − r²) r exp(2πi l / λ), whose square is the printed
/// reflectance, and 1 − r², with Fresnel's real r of a boundary.
fn two_beam_polarized(n: vec4f, thickness_nm: f32, inverse_wavelength: vec4f, cosine: f32, as_printed: bool) -> PolarizedFilm {
    let c = max(cosine, GRAZING);
    let n2 = n * n;
    let n_cos = sqrt((n2 - 1.0) + c * c);
    let r_s = (c - n_cos) / (c + n_cos);
    let r_p = (n2 * c - n_cos) / (n2 * c + n_cos);
    let path = select(n_cos, n_cos / n, as_printed);
    let turn = phase_factor(4.0 * thickness_nm * path * inverse_wavelength, vec4f(0.0));
    let through_s = 1.0 - r_s * r_s;
    let through_p = 1.0 - r_p * r_p;
    let s = Complex4(r_s * (1.0 - through_s * turn.re), -r_s * through_s * turn.im);
    let p = Complex4(r_p * (1.0 - through_p * turn.re), -r_p * through_p * turn.im);
    let zero = vec4f(0.0);
    return PolarizedFilm(
        amplitude_powers(s, p),
        PolarizedPowers(through_s * through_s, through_p * through_p, through_s * through_p, zero),
    );
}

/// Returns what a whole stack reflects and transmits, seen from the incident medium: r = (η₀ F − G) / (η₀ F + G), and t with the phase of
/// 1 / (η₀ F + G), as the layers' phases are those of both polarizations.
fn stack_polarized(stack: Stack, substrate: Admittances, incident: Incident) -> PolarizedFilm {
    let q0 = sqrt(incident.q2);
    let s = top_amplitudes(stack.s, substrate.s, q0);
    let p = top_amplitudes(stack.p, substrate.p, q0 / incident.index2);
    return PolarizedFilm(amplitude_powers(s.reflected, p.reflected), amplitude_powers(s.transmitted, p.transmitted));
}

struct TopAmplitudes {
    reflected: Complex4,
    /// Its square is the transmittance.
    transmitted: Complex4,
}

fn top_amplitudes(at_top: TangentialFields, substrate: Complex4, incident: f32) -> TopAmplitudes {
    let first = complex_scale(incident, at_top.first);
    let over = complex_recip(complex_add(first, at_top.second));
    let reflected = complex_mul(complex_sub(first, at_top.second), over);
    let through = sqrt(max(4.0 * incident * substrate.re * at_top.passed, vec4f(0.0)));
    return TopAmplitudes(reflected, Complex4(through * over.re, through * over.im));
}

/// Returns what a free film reflects and transmits, in the four bands of a group; `first` is the spectrum with the factor's index.
fn film_polarized_value(film: FilmAt, first: vec4f, at: At) -> PolarizedFilm {
    let tag = factor_tag(film.factor);
    if (HAS_STACKS && tag >= FACTOR_STACK) {
        let record = load_film(factor_number(film.factor));
        let layers = Layers(record.first_layer, record.layer_count, record.varying_layers, film.first_thickness);
        let incident = air_above(film.cosine);
        let substrate = substrate_admittances(vec4f(1.0), vec4f(0.0), incident);
        let stack = with_layers(stack_on(substrate), layers, incident, tag == FACTOR_STACK, at);
        return stack_polarized(stack, substrate, incident);
    }
    let inverse = inverse_wavelengths(at.group, at.wavelengths);
    if (HAS_TWO_BEAM_FILMS && tag >= FACTOR_TWO_BEAM) {
        return two_beam_polarized(first, film.thickness_nm, inverse, film.cosine, tag == FACTOR_TWO_BEAM_AS_PRINTED);
    }
    if (HAS_LOSSY_FILMS && tag == FACTOR_LOSSY_FILM) {
        let k = spectrum_at(factor_number(film.factor) + 1u, at.group, at.wavelengths);
        return film_polarized(first, k, film.thickness_nm, inverse, film.cosine);
    }
    return clear_film_polarized(first, film.thickness_nm, inverse, film.cosine);
}
