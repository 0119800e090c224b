//! Exact interference in stacks of layers.

mod absorptance;
mod derivative;
mod fields;

pub use absorptance::absorptance;
pub use derivative::{ThicknessDerivative, thickness_derivatives};

use crate::{Amplitudes, Polarized};
use fields::{Field, Medium, Polarization, Slab};
use num_complex::Complex64;

/// One layer of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Complex index n + ik, n ≥ 0, k ≥ 0, not both 0.
    pub index: Complex64,
    /// Thickness, nm, ≥ 0.
    pub thickness_nm: f64,
}

/// Amplitudes and powers of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StackAmplitudes {
    /// Amplitude coefficients of the whole stack.
    pub amplitudes: Amplitudes,
    /// Reflectance: fraction of the power that is reflected.
    pub reflectance: Polarized,
    /// Transmittance: fraction of the power that enters the substrate.
    pub transmittance: Polarized,
}

/// Amplitudes and powers of a stack of `layers` between two half spaces. The first layer touches the incident medium.
///
/// The tangential field is carried from the substrate up, layer by layer, by Abelès' characteristic matrix times
/// exp(−Im δ) (Abelès 1950; Born and Wolf, Principles of Optics, 7th ed., section 1.6.2). Then
/// r = (η₀U − V) / (η₀U + V) and t = 2η₀ exp(−Σ Im δ) / (η₀U + V), with η = n cos θ for s and cos θ / n for p, and
/// T = |t|² Re η_s / η₀ (Macleod, Thin-Film Optical Filters, chapter 2). Nothing can overflow in an opaque layer, and
/// nothing is divided by 0 at a critical angle.
///
/// Domain: `incident` real and positive; `cos_incident` in (0, 1] (1.7e-4 is 89.99°); `wavelength_nm` > 0, in vacuum; the
/// substrate's index like that of a [`Layer`]. Any number of layers, including none, of any thickness. Within the domain every
/// result is finite. Compared with 50-digit arithmetic, R and T of random stacks are off by at most 4e-15, including 89.99° and
/// denser incident media, and by 3e-14 for films of 30 µm and mirrors of 21 layers.
///
/// Light in a denser medium is totally reflected beyond the critical angle (T = 0), or tunnels through a thin gap (frustrated
/// total reflection). T is the power that enters the substrate, even an absorbing one.
///
/// ```
/// use pellicle_optics::{Layer, stack};
///
/// // A quarter wave of MgF2 on glass at its design wavelength: R = ((n₀n_s − n₁²)/(n₀n_s + n₁²))².
/// let layer = Layer { index: 1.38.into(), thickness_nm: 550.0 / (4.0 * 1.38) };
/// let found = stack(1.0, &[layer], 1.52.into(), 550.0, 1.0);
/// assert!((found.reflectance.unpolarized() - 0.012_601).abs() < 1e-6);
/// ```
pub fn stack(
    incident: f64,
    layers: &[Layer],
    substrate: Complex64,
    wavelength_nm: f64,
    cos_incident: f64,
) -> StackAmplitudes {
    let bottom = Medium::new(substrate, incident, cos_incident);
    let mut s = Sweep::new(Polarization::S, &bottom);
    let mut p = Sweep::new(Polarization::P, &bottom);
    for layer in layers.iter().rev() {
        let slab = Slab::new(layer, incident, cos_incident, wavelength_nm);
        s.pass(&slab);
        p.pass(&slab);
    }
    let s = s.ratios(incident, cos_incident);
    let p = p.ratios(incident, cos_incident);
    StackAmplitudes {
        amplitudes: Amplitudes {
            r_s: s.r,
            r_p: p.r,
            t_s: s.t,
            // The p equations give the ratio of magnetic fields, and H = n E.
            t_p: p.t * incident / substrate,
        },
        reflectance: Polarized {
            s: s.r.norm_sqr(),
            p: p.r.norm_sqr(),
        },
        transmittance: Polarized {
            s: s.transmittance,
            p: p.transmittance,
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

/// The field of one polarization, carried from the substrate up.
struct Sweep {
    polarization: Polarization,
    substrate: Complex64,
    field: Field,
    /// Factor by which the field is smaller than in units in which U is 1 at the substrate.
    scale: f64,
}

/// The result of a sweep: r, and t of U.
struct Ratios {
    r: Complex64,
    t: Complex64,
    transmittance: f64,
}

impl Sweep {
    fn new(polarization: Polarization, substrate: &Medium) -> Self {
        let substrate = polarization.admittance(substrate);
        Self {
            polarization,
            substrate,
            field: Field::leaving(substrate),
            scale: 1.0,
        }
    }

    fn pass(&mut self, slab: &Slab) {
        let (field, factor) = slab.lift(self.polarization, self.field);
        self.field = field;
        self.scale *= factor;
    }

    fn ratios(&self, incident: f64, cos_incident: f64) -> Ratios {
        let eta = incident_admittance(self.polarization, incident, cos_incident);
        let Field { u, v } = self.field;
        let whole = eta * u + v;
        let t = 2.0 * eta * self.scale / whole;
        Ratios {
            r: (eta * u - v) / whole,
            t,
            transmittance: t.norm_sqr() * self.substrate.re / eta,
        }
    }
}

/// η of the incident medium.
fn incident_admittance(polarization: Polarization, incident: f64, cos_incident: f64) -> f64 {
    match polarization {
        Polarization::S => incident * cos_incident,
        Polarization::P => cos_incident / incident,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

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
        let bulk = crate::reflectance_unpolarized(gold, 0.5);
        assert!(close(thick.reflectance.unpolarized(), bulk));
        assert!(thick.transmittance.s.abs() < 1e-300);
    }
}
