//! How much of the light each layer absorbs.

use super::fields::{Field, Medium, Polarization, Slab};
use super::incident_admittance;
use crate::{Layer, Polarized};
use num_complex::Complex64;

/// Absorptance of each layer: the fraction of the incident power that turns to heat in it, in the order of `layers`.
/// R + T + ΣA = 1.
///
/// It is the power that enters a layer minus the power that leaves it, from the flux Re(U* V) at its two boundaries (Macleod,
/// Thin-Film Optical Filters, section 2.8). The flux is relative to what reaches the layer, so the absorptance of a layer
/// beneath an opaque one has full relative precision. A layer with k = 0 has exactly 0, even where light tunnels through it.
///
/// Arguments and domain as for [`stack`](crate::stack).
pub fn absorptance(
    incident: f64,
    layers: &[Layer],
    substrate: Complex64,
    wavelength_nm: f64,
    cos_incident: f64,
) -> Vec<Polarized> {
    let bottom = Medium::new(substrate, incident, cos_incident);
    let slab = |layer| Slab::new(layer, incident, cos_incident, wavelength_nm);
    let slabs: Vec<Slab> = layers.iter().map(slab).collect();
    let of = |polarization| {
        let boundaries = Boundaries::new(polarization, &slabs, &bottom);
        boundaries.absorbed(incident_admittance(polarization, incident, cos_incident))
    };
    let (s, p) = (of(Polarization::S), of(Polarization::P));
    let taken = |((layer, s), p): ((&Layer, f64), f64)| {
        let absorbs = if layer.index.im > 0.0 { 1.0 } else { 0.0 };
        Polarized {
            s: absorbs * s,
            p: absorbs * p,
        }
    };
    layers.iter().zip(s).zip(p).map(taken).collect()
}

/// The field of one polarization at every boundary of a stack.
pub(super) struct Boundaries {
    /// From the top to the substrate, one more than there are layers, each in its own units.
    pub(super) fields: Vec<Field>,
    /// For each layer, the field beneath it in units of the field on top of it.
    pub(super) factors: Vec<f64>,
}

impl Boundaries {
    pub(super) fn new(polarization: Polarization, slabs: &[Slab], substrate: &Medium) -> Self {
        let mut fields = vec![Field::leaving(polarization.admittance(substrate))];
        let mut factors = Vec::with_capacity(slabs.len());
        for slab in slabs.iter().rev() {
            let (field, factor) = slab.lift(polarization, fields[fields.len() - 1]);
            fields.push(field);
            factors.push(factor);
        }
        fields.reverse();
        factors.reverse();
        Self { fields, factors }
    }

    /// η₀U + V at the top: twice η₀ times the incident field.
    pub(super) fn incident(&self, eta: f64) -> Complex64 {
        eta * self.fields[0].u + self.fields[0].v
    }

    /// The power that enters each layer minus the power that leaves it, for an incident power of 1.
    fn absorbed(&self, eta: f64) -> Vec<f64> {
        let mut arriving = 4.0 * eta / self.incident(eta).norm_sqr();
        let layer = |(pair, factor): (&[Field], &f64)| {
            let passing = factor * factor;
            let taken = arriving * (pair[0].flux() - passing * pair[1].flux());
            arriving *= passing;
            taken
        };
        self.fields
            .windows(2)
            .zip(&self.factors)
            .map(layer)
            .collect()
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

    /// An absorbing slab between equal media with negligible reflection (n = 1, k small): A = 1 − exp(−4πkd/λ) (Beer and Lambert).
    /// Its boundaries reflect (k/2)² = 1e-12.
    #[test]
    fn a_faint_slab_absorbs_by_beers_law() {
        let k = 2e-6;
        let depth_nm: f64 = 3e7;
        let found = absorptance(1.0, &[layer(1.0, k, depth_nm)], Complex64::ONE, 500.0, 1.0)[0];
        let expected = -(-4.0 * std::f64::consts::PI * k * depth_nm / 500.0).exp_m1();
        assert!((found.s - expected).abs() < 1e-11 && (found.p - expected).abs() < 1e-11);
    }

    /// One metal layer above another: the second absorbs all that the first transmits, down to 1e-60.
    #[test]
    fn a_layer_beneath_an_opaque_one_keeps_its_digits() {
        let silver = Complex64::new(0.05, 3.5);
        let layers = [layer(0.05, 3.5, 1500.0), layer(0.05, 3.5, 1000.0)];
        let found = absorptance(1.0, &layers, silver, 500.0, 0.6);
        let through = stack(1.0, &layers[..1], silver, 500.0, 0.6).transmittance;
        assert!(through.s < 1e-50, "{through:?}");
        // The lower layer is opaque too, so it absorbs all that enters the silver below the first.
        assert!(
            (found[1].s / through.s - 1.0).abs() < 1e-12,
            "{found:?} {through:?}"
        );
        assert!(
            (found[1].p / through.p - 1.0).abs() < 1e-12,
            "{found:?} {through:?}"
        );
    }

    /// A clear layer absorbs nothing, even as a gap through which light tunnels.
    #[test]
    fn a_clear_layer_takes_nothing() {
        let layers = [layer(1.0, 0.0, 90.0), layer(0.06, 3.6, 20.0)];
        let found = absorptance(1.52, &layers, 1.52.into(), 550.0, 0.5);
        assert_eq!(found[0], Polarized { s: 0.0, p: 0.0 });
        assert!(found[1].s > 1e-3 && found[1].p > 1e-3, "{found:?}");
    }
}
