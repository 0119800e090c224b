//! How R and T change with the thickness of each layer.

use super::absorptance::Boundaries;
use super::fields::{Field, Medium, Polarization, Slab};
use super::incident_admittance;
use crate::{Layer, Polarized};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// The derivatives of a stack's powers with respect to the thickness of one layer, per nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThicknessDerivative {
    /// ∂R/∂d, nm⁻¹.
    pub reflectance: Polarized,
    /// ∂T/∂d, nm⁻¹.
    pub transmittance: Polarized,
}

/// ∂R/∂d and ∂T/∂d for the thickness d of every layer, in the order of `layers`, from one sweep up and one down.
///
/// A layer's matrix M obeys ∂M/∂d = −ik ((0, q/η), (qη, 0)) M with k = 2π/λ. Hence, with (U, V) the field on top of the
/// layer, D = η₀U + V at the top of the stack, and determinants of 1 above the layer,
/// ∂r/∂d = −2ik η₀ ((q/η) V² − qη U²) / D², and ∂ ln t/∂d = ik ((q/η) L₁V + qη L₂U) / (L₁U + L₂V), where
/// L = (η₀, 1) M₁ … M_{j−1} is carried down. (Derived from Abelès' matrices, for which see Macleod, Thin-Film Optical Filters,
/// chapter 2. Furman and Tikhonravov, Basics of Optics of Multilayer Systems, 1992, give equivalent forms.)
/// The first form has no cancellation beneath an opaque layer.
///
/// The derivative of a color is the sum of ∂R/∂d over the wavelengths, with the weights that give the color from R.
///
/// Arguments and domain as for [`stack`](crate::stack).
pub fn thickness_derivatives(
    incident: f64,
    layers: &[Layer],
    substrate: Complex64,
    wavelength_nm: f64,
    cos_incident: f64,
) -> Vec<ThicknessDerivative> {
    let bottom = Medium::new(substrate, incident, cos_incident);
    let slab = |layer| Slab::new(layer, incident, cos_incident, wavelength_nm);
    let slabs: Vec<Slab> = layers.iter().map(slab).collect();
    let of = |polarization| {
        let light = Light {
            polarization,
            eta: incident_admittance(polarization, incident, cos_incident),
            wave_number: TAU / wavelength_nm,
        };
        light.derivatives(&slabs, &bottom)
    };
    let both = |((r_s, t_s), (r_p, t_p)): ((f64, f64), (f64, f64))| ThicknessDerivative {
        reflectance: Polarized { s: r_s, p: r_p },
        transmittance: Polarized { s: t_s, p: t_p },
    };
    let pairs = of(Polarization::S).into_iter().zip(of(Polarization::P));
    pairs.map(both).collect()
}

struct Light {
    polarization: Polarization,
    eta: f64,
    /// 2π/λ, nm⁻¹.
    wave_number: f64,
}

impl Light {
    /// (∂R/∂d, ∂T/∂d) of each layer.
    fn derivatives(&self, slabs: &[Slab], substrate: &Medium) -> Vec<(f64, f64)> {
        let boundaries = Boundaries::new(self.polarization, slabs, substrate);
        let whole = boundaries.incident(self.eta);
        let top = boundaries.fields[0];
        let r = (self.eta * top.u - top.v) / whole;
        let scale: f64 = boundaries.factors.iter().product();
        let leaving = self.polarization.admittance(substrate).re;
        let transmittance = 4.0 * self.eta * leaving * (scale / whole.norm()).powi(2);

        let mut row = Field {
            u: self.eta.into(),
            v: Complex64::ONE,
        };
        let mut above = 1.0;
        let mut found = Vec::with_capacity(slabs.len());
        for ((slab, field), factor) in slabs
            .iter()
            .zip(&boundaries.fields)
            .zip(&boundaries.factors)
        {
            let reaching = above / whole;
            let of_r = self.of_r(slab, *field, reaching);
            let of_ln_t = self.of_ln_t(slab, *field, row);
            found.push((2.0 * (r.conj() * of_r).re, 2.0 * transmittance * of_ln_t.re));
            row = slab.lower(self.polarization, row);
            above *= factor;
        }
        found
    }

    /// ∂r/∂d, from the field on top of the layer and 1/D in its units.
    fn of_r(&self, slab: &Slab, field: Field, reaching: Complex64) -> Complex64 {
        let (over, times) = self.polarization.regular(&slab.medium);
        let (u, v) = (field.u * reaching, field.v * reaching);
        -2.0 * self.eta * self.wave_number * Complex64::I * (over * v * v - times * u * u)
    }

    /// ∂ ln t/∂d.
    fn of_ln_t(&self, slab: &Slab, field: Field, row: Field) -> Complex64 {
        let (over, times) = self.polarization.regular(&slab.medium);
        let change = over * row.u * field.v + times * row.v * field.u;
        Complex64::I * self.wave_number * change / (row.u * field.u + row.v * field.v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stack;

    fn layer(n: f64, k: f64, thickness_nm: f64) -> Layer {
        let index = Complex64::new(n, k);
        Layer {
            index,
            thickness_nm,
        }
    }

    /// R_s, R_p, T_s and T_p.
    fn powers(incident: f64, layers: &[Layer], substrate: Complex64, cosine: f64) -> [f64; 4] {
        let found = stack(incident, layers, substrate, 550.0, cosine);
        let (r, t) = (found.reflectance, found.transmittance);
        [r.s, r.p, t.s, t.p]
    }

    /// Central differences over h and h/2, extrapolated (Richardson 1911): error h⁴ ∂⁵R/120 ≈ 1e-12 and rounding 1e-15/h.
    fn differences(
        incident: f64,
        layers: &[Layer],
        substrate: Complex64,
        cosine: f64,
    ) -> Vec<[f64; 4]> {
        let central = |j: usize, h: f64| {
            let at = |change: f64| {
                let mut layers = layers.to_vec();
                layers[j].thickness_nm += change;
                powers(incident, &layers, substrate, cosine)
            };
            let (above, below) = (at(h), at(-h));
            std::array::from_fn::<f64, 4, _>(|i| (above[i] - below[i]) / (2.0 * h))
        };
        let extrapolated = |j| {
            let (coarse, fine) = (central(j, 0.2), central(j, 0.1));
            std::array::from_fn(|i| (4.0 * fine[i] - coarse[i]) / 3.0)
        };
        (0..layers.len()).map(extrapolated).collect()
    }

    /// The largest deviation of the derivatives from the differences, relative to the largest derivative.
    fn worst(incident: f64, layers: &[Layer], substrate: Complex64, cosine: f64) -> f64 {
        let found = thickness_derivatives(incident, layers, substrate, 550.0, cosine);
        let expected = differences(incident, layers, substrate, cosine);
        assert_eq!(found.len(), layers.len());
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        for (found, expected) in found.iter().zip(expected) {
            let (r, t) = (found.reflectance, found.transmittance);
            for (a, b) in [r.s, r.p, t.s, t.p].into_iter().zip(expected) {
                error = error.max((a - b).abs());
                largest = largest.max(a.abs());
            }
        }
        assert!(largest > 1e-6, "{largest:e}: nothing changes");
        error / largest
    }

    const SILICON: Complex64 = Complex64::new(4.08, 0.041);

    #[test]
    fn derivatives_follow_differences() {
        let clear = [
            layer(1.46, 0.0, 120.0),
            layer(2.4, 0.0, 57.0),
            layer(1.38, 0.0, 310.0),
        ];
        let lossy = [
            layer(1.46, 0.0, 80.0),
            layer(0.4, 2.4, 15.0),
            layer(2.1, 0.02, 200.0),
        ];
        let gap = [
            layer(2.4, 0.0, 60.0),
            layer(1.0, 0.0, 90.0),
            layer(1.7, 0.1, 90.0),
        ];
        for cosine in [1.0, 0.7, 0.3] {
            for (incident, layers, substrate) in [
                (1.0, &clear, Complex64::from(1.52)),
                (1.0, &lossy, SILICON),
                (1.52, &lossy, Complex64::ONE),
                (1.52, &gap, Complex64::from(1.52)),
            ] {
                let worst = worst(incident, layers, substrate, cosine);
                assert!(worst < 1e-8, "{incident} {cosine}: {worst:e}");
            }
        }
    }

    /// The comparison above detects derivatives of a stack with one layer that differs by a nanometer.
    #[test]
    fn the_comparison_can_fail() {
        let mut layers = [layer(1.46, 0.0, 120.0), layer(2.4, 0.0, 57.0)];
        let there = differences(1.0, &layers, SILICON, 0.7);
        layers[1].thickness_nm += 1.0;
        let found = thickness_derivatives(1.0, &layers, SILICON, 550.0, 0.7);
        assert!((found[0].reflectance.s - there[0][0]).abs() > 1e-6);
    }

    /// ∂R/∂d of a free film from Airy's formula R = F s² / (1 + F s²), s = sin(2πnd cos θ / λ):
    /// ∂R/∂d = 2 F s c (2πn cos θ / λ) / (1 + F s²)².
    #[test]
    fn a_free_film_follows_airys_derivative() {
        let (n, d, wavelength) = (1.333_f64, 457.0, 551.0);
        let rho = ((1.0 - n) / (1.0 + n)).powi(2);
        let f = 4.0 * rho / (1.0 - rho).powi(2);
        let rate = TAU * n / wavelength;
        let (sin, cos) = (rate * d).sin_cos();
        let expected = 2.0 * f * sin * cos * rate / (1.0 + f * sin * sin).powi(2);
        let found =
            thickness_derivatives(1.0, &[layer(n, 0.0, d)], Complex64::ONE, wavelength, 1.0)[0];
        assert!((found.reflectance.s - expected).abs() < 1e-15);
        assert!((found.transmittance.p + expected).abs() < 1e-15);
    }

    /// A layer beneath an opaque one changes R by exp(−4 Im δ) of its change without the opaque one, not by rounding errors.
    #[test]
    fn beneath_an_opaque_layer_the_derivative_is_small_and_right() {
        let (cover, beneath) = (layer(0.06, 3.6, 700.0), layer(1.5, 0.0, 100.0));
        let found = thickness_derivatives(1.0, &[cover, beneath], SILICON, 550.0, 1.0)[1];
        let thicker = Layer {
            thickness_nm: 800.0,
            ..cover
        };
        let deeper = thickness_derivatives(1.0, &[thicker, beneath], SILICON, 550.0, 1.0)[1];
        // The amplitude crosses the cover twice: 100 nm more attenuate by exp(−2 · 2π k 100 / λ), and n shifts the phase.
        let least = (-2.0 * TAU * 3.6 * 100.0 / 550.0_f64).exp();
        let ratio = deeper.reflectance.s.abs() / found.reflectance.s.abs();
        assert!(found.reflectance.s.abs() < 1e-20 && found.reflectance.s != 0.0);
        assert!(
            ratio < 3.0 * least && ratio > least / 3.0,
            "{ratio:e} {least:e}"
        );
    }
}
