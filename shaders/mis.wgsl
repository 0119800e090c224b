// Multiple importance sampling: the weights of emitter sampling and BSDF sampling.

/// BSDF sampling has weight 0 where its density is less than this fraction of the density of emitter sampling.
const CUTOFF: f32 = 0.1875;

/// Returns the MIS weight of emitter sampling in a direction that it finds with `pmf` times `density`; BSDF sampling, with density
/// `pdf_bsdf`, has the rest. For a picture, only radiance above the mean is sampled (MIS compensation, Karlík et al. 2019; see the
/// reference).
fn mis_weight_emitter(emitter: u32, pdf_bsdf: f32, pmf: f32, density: f32) -> f32 {
    if (HAS_ENVIRONMENT_PICTURE && emitter_at(emitter).kind == EMITTER_PICTURE) {
        let even = direction_table(emitter).even_density;
        if (even > 0.0) {
            let excess = density / even;
            return excess / (1.0 + excess) * (1.0 - mis_weight_bsdf(pdf_bsdf, pmf * excess * (0.25 / PI)));
        }
    }
    return 1.0 - mis_weight_bsdf(pdf_bsdf, pmf * density);
}

/// Returns the MIS weight of BSDF sampling against emitter sampling: the power heuristic (Veach 1997, section 9.2.2), with a cutoff
/// for BSDF sampling only.
fn mis_weight_bsdf(pdf_bsdf: f32, pdf_emitter: f32) -> f32 {
    if (pdf_bsdf < CUTOFF * pdf_emitter) {
        return 0.0;
    }
    let ratio = pdf_emitter / pdf_bsdf;
    return 1.0 / (1.0 + ratio * ratio);
}
