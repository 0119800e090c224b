//! Multiple importance sampling: what emitter sampling counts for against BSDF sampling.

use crate::Emitter;
use scene::EnvironmentShape;
use std::f64::consts::PI;

/// BSDF sampling is left out where its density is less than this part of the other's.
const CUTOFF: f64 = 0.1875;

/// MIS weight of emitter sampling in a direction that it finds with `pmf` times `density`, and BSDF sampling with density `pdf_bsdf`,
/// which has the rest.
///
/// Of a picture only what is brighter than the mean is sampled (MIS compensation, Karlík et al. 2019), and no more of the light than that
/// belongs to emitter sampling. Against BSDF sampling counts the density with which all of the picture's light would be sampled: a mirror
/// that finds an even picture without noise shall not leave the rim of what it mirrors to a few rays.
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

/// MIS weight of BSDF sampling against emitter sampling: the power heuristic (Veach 1997, section 9.2.2), with a cutoff of BSDF sampling
/// alone.
pub fn mis_weight_bsdf(pdf_bsdf: f64, pdf_emitter: f64) -> f64 {
    if pdf_bsdf < CUTOFF * pdf_emitter {
        return 0.0;
    }
    pdf_bsdf * pdf_bsdf / (pdf_bsdf * pdf_bsdf + pdf_emitter * pdf_emitter)
}
