//! Multiple importance sampling: the weights of emitter sampling and BSDF sampling.

use crate::Emitter;
use scene::EnvironmentShape;
use std::f64::consts::PI;

/// BSDF sampling has weight 0 where its density is less than this fraction of the density of emitter sampling.
const CUTOFF: f64 = 0.1875;

/// Returns the MIS weight of emitter sampling in a direction that it finds with `pmf` times `density`; BSDF sampling, with density
/// `pdf_bsdf`, has the rest.
///
/// For a picture, only radiance above the mean is sampled (MIS compensation, Karlík et al. 2019), and emitter sampling accounts for
/// no more of the light than that. The weight against BSDF sampling uses the density with which all of the picture's light would be
/// sampled: where a mirror finds a uniform picture without noise, the rim of the reflection should not be left to a few rays.
pub fn mis_weight_emitter(emitter: Emitter<'_>, pdf_bsdf: f64, pmf: f64, density: f64) -> f64 {
    if let Emitter::Environment(EnvironmentShape::Picture(picture)) = emitter {
        let even = f64::from(picture.table.even_density);
        if even > 0.0 {
            let excess = density / even;
            let pdf_emitter = pmf * excess / (4.0 * PI);
            return excess / (1.0 + excess) * (1.0 - mis_weight_bsdf(pdf_bsdf, pdf_emitter));
        }
    }
    1.0 - mis_weight_bsdf(pdf_bsdf, pmf * density)
}

/// Returns the MIS weight of BSDF sampling against emitter sampling: the power heuristic (Veach 1997, section 9.2.2), with a cutoff
/// for BSDF sampling only.
pub fn mis_weight_bsdf(pdf_bsdf: f64, pdf_emitter: f64) -> f64 {
    if pdf_bsdf < CUTOFF * pdf_emitter {
        return 0.0;
    }
    pdf_bsdf * pdf_bsdf / (pdf_bsdf * pdf_bsdf + pdf_emitter * pdf_emitter)
}
