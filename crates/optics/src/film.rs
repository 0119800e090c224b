//! Thin films: exact interference in a stack of layers.

use crate::{Amplitudes, Polarised, cos_refracted, fresnel};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// One layer of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Complex index n + ik, n > 0, k ≥ 0.
    pub index: Complex64,
    /// Thickness, nm, ≥ 0.
    pub thickness_nm: f64,
}

/// Amplitudes and powers of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StackAmplitudes {
    /// Amplitude reflection and transmission of the whole.
    pub amplitudes: Amplitudes,
    /// Reflectance: share of the power that returns.
    pub reflectance: Polarised,
    /// Transmittance: share of the power that enters the substrate.
    pub transmittance: Polarised,
}

/// A stack of `layers`, the first beside the incident medium, between two half spaces.
///
/// From the substrate upwards each layer j adds its upper boundary to what lies below it:
/// r ← (r_j + r β²) / (1 + r_j r β²), t ← t_j t β / (1 + r_j r β²), with β = exp(2πi n d cos θ / λ)
/// (Rouard 1937; Heavens, Optical Properties of Thin Solid Films, 1955, section 4.2). |β| ≤ 1, so that an opaque layer
/// cannot overflow.
///
/// `incident` must be real and positive; `cos_incident` in (0, 1]; `wavelength_nm` > 0 in vacuum.
pub fn stack(
    incident: f64,
    layers: &[Layer],
    substrate: Complex64,
    wavelength_nm: f64,
    cos_incident: f64,
) -> StackAmplitudes {
    let n0 = Complex64::from(incident);
    let cos0 = Complex64::from(cos_incident);
    let sine = ((1.0 - cos_incident) * (1.0 + cos_incident)).sqrt();
    let n_sin = n0 * sine;

    let cos_substrate = cos_refracted(substrate, n_sin);
    let mut below = (substrate, cos_substrate);
    let mut whole: Option<Amplitudes> = None;
    for layer in layers.iter().rev() {
        let cosine = cos_refracted(layer.index, n_sin);
        let boundary = fresnel(layer.index, cosine, below.0, below.1);
        let turns = layer.index * cosine * (layer.thickness_nm / wavelength_nm);
        let beta = (Complex64::I * TAU * turns).exp();
        let under = match whole {
            None => boundary,
            Some(rest) => join(boundary, rest),
        };
        whole = Some(delayed(under, beta));
        below = (layer.index, cosine);
    }
    let top = fresnel(n0, cos0, below.0, below.1);
    let amplitudes = whole.map_or(top, |rest| join(top, rest));
    powers(amplitudes, (n0, cos0), (substrate, cos_substrate))
}

/// What a boundary and everything below it do together. `rest` already holds the way through the layer between.
fn join(boundary: Amplitudes, rest: Amplitudes) -> Amplitudes {
    let s = 1.0 + boundary.r_s * rest.r_s;
    let p = 1.0 + boundary.r_p * rest.r_p;
    Amplitudes {
        r_s: (boundary.r_s + rest.r_s) / s,
        r_p: (boundary.r_p + rest.r_p) / p,
        t_s: boundary.t_s * rest.t_s / s,
        t_p: boundary.t_p * rest.t_p / p,
    }
}

/// The amplitudes as seen through a layer of phase factor β: twice for the reflected wave, once for the transmitted.
fn delayed(a: Amplitudes, beta: Complex64) -> Amplitudes {
    Amplitudes {
        r_s: a.r_s * beta * beta,
        r_p: a.r_p * beta * beta,
        t_s: a.t_s * beta,
        t_p: a.t_p * beta,
    }
}

/// Powers from amplitudes: R = |r|², T_s = |t|² Re(n cos θ) / Re(n₀ cos θ₀) and
/// T_p = |t|² Re(n cos θ*) / Re(n₀ cos θ₀) (Byrnes, arXiv:1603.02720, equations 19 to 22).
fn powers(
    a: Amplitudes,
    (n0, cos0): (Complex64, Complex64),
    (n, cosine): (Complex64, Complex64),
) -> StackAmplitudes {
    let in_front = (n0 * cos0).re;
    StackAmplitudes {
        amplitudes: a,
        reflectance: Polarised {
            s: a.r_s.norm_sqr(),
            p: a.r_p.norm_sqr(),
        },
        transmittance: Polarised {
            s: a.t_s.norm_sqr() * (n * cosine).re / in_front,
            p: a.t_p.norm_sqr() * (n * cosine.conj()).re / in_front,
        },
    }
}

/// A free film: one layer with vacuum on both sides.
pub fn film(
    index: Complex64,
    thickness_nm: f64,
    wavelength_nm: f64,
    cos_incident: f64,
) -> StackAmplitudes {
    let layer = Layer {
        index,
        thickness_nm,
    };
    stack(1.0, &[layer], Complex64::ONE, wavelength_nm, cos_incident)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-13
    }

    /// Airy 1833; Born and Wolf, section 7.6, equation 15: R = F sin²(δ/2) / (1 + F sin²(δ/2)).
    #[test]
    fn a_free_film_follows_airys_formula() {
        let (n, d, wavelength, cos1) = (1.333_f64, 457.0, 551.0, 0.6_f64);
        let sin2 = 1.0 - cos1 * cos1;
        let cos2 = (1.0 - sin2 / (n * n)).sqrt();
        let rho = ((cos1 - n * cos2) / (cos1 + n * cos2)).powi(2);
        let phase = TAU * n * d * cos2 / wavelength;
        let f = 4.0 * rho / (1.0 - rho).powi(2);
        let airy = f * phase.sin().powi(2) / (1.0 + f * phase.sin().powi(2));
        let found = film(n.into(), d, wavelength, cos1);
        assert!(close(found.reflectance.s, airy));
        assert!(close(found.transmittance.s, 1.0 - airy));
    }

    #[test]
    fn without_thickness_there_is_no_film() {
        let gone = film(Complex64::new(1.5, 0.2), 0.0, 500.0, 0.3);
        assert!(gone.reflectance.s < 1e-30 && gone.reflectance.p < 1e-30);
        assert!(close(gone.transmittance.s, 1.0) && close(gone.transmittance.p, 1.0));
    }

    /// MgF2 (1.38) of a quarter wave on glass (1.52): R = ((n₀n_s − n₁²)/(n₀n_s + n₁²))² = 0.012601.
    #[test]
    fn a_quarter_wave_of_magnesium_fluoride_reflects_as_published() {
        let layer = Layer {
            index: 1.38.into(),
            thickness_nm: 550.0 / (4.0 * 1.38),
        };
        let r = stack(1.0, &[layer], 1.52.into(), 550.0, 1.0).reflectance;
        assert!((r.s - 0.012_601).abs() < 5e-7 && close(r.s, r.p));
    }

    #[test]
    fn a_split_layer_equals_the_whole() {
        let index = Complex64::new(1.8, 0.05);
        let part = |thickness_nm| Layer {
            index,
            thickness_nm,
        };
        let silicon = Complex64::new(4.1, 0.04);
        let whole = stack(1.0, &[part(90.0)], silicon, 540.0, 0.7);
        let split = stack(1.0, &[part(30.0), part(60.0)], silicon, 540.0, 0.7);
        assert!(close(whole.reflectance.s, split.reflectance.s));
        assert!(close(whole.transmittance.p, split.transmittance.p));
    }

    #[test]
    fn an_opaque_layer_stays_finite() {
        let gold = Complex64::new(0.4, 2.6);
        let thick = film(gold, 1e6, 550.0, 0.5);
        let bulk = crate::reflectance_unpolarised(gold, 0.5);
        assert!(close(thick.reflectance.unpolarised(), bulk));
        assert!(thick.transmittance.s.abs() < 1e-300);
    }
}
