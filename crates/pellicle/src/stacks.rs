//! Film stacks without a scene, on the CPU in `f64` or on a GPU in `f32`.

use crate::Renderer;
use optics::Polarized;
use optics::batch::{self, BatchError, Media, Powers, StackBatch};
use thiserror::Error;

/// Why a batch of stacks was not evaluated.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StacksError {
    /// A number of the batch is outside its domain.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] gpu::StackError),
}

/// R and T of every stack at every angle and wavelength, as `[stack][angle][wavelength]`.
///
/// The CPU computes in `f64` on all cores ([`optics::batch::evaluate`]), a GPU in `f32`. On a GPU, R and T of ordinary stacks seen
/// from air are accurate to 5e-5 up to 88° and to 3e-4 beyond ([`gpu::evaluate_stacks`] says where errors are larger).
///
/// # Errors
/// When a number of the batch is outside its domain, or the GPU fails.
pub fn evaluate(renderer: &Renderer, batch: &StackBatch<'_>) -> Result<Vec<Powers>, StacksError> {
    let Renderer::Gpu(gpu) = renderer else {
        return Ok(batch::evaluate(batch)?);
    };
    batch.check()?;
    let (media, is_dispersive) = match batch.media {
        Media::Constant(media) => (media, false),
        Media::Dispersive(media) => (media, true),
    };
    let media: Vec<[f64; 2]> = media.iter().map(|index| [index.re, index.im]).collect();
    let layers: Vec<(u32, f64)> = batch
        .layers
        .iter()
        .map(|layer| (layer.medium, layer.thickness_nm))
        .collect();
    let stacks: Vec<gpu::RunStack> = batch
        .stacks
        .iter()
        .map(|stack| gpu::RunStack {
            substrate: stack.substrate,
            first_layer: stack.first_layer,
            layer_count: stack.layer_count,
        })
        .collect();
    let found = gpu::evaluate_stacks(
        gpu,
        &gpu::StackBatch {
            wavelengths_nm: batch.wavelengths_nm,
            cosines: batch.cosines,
            incident: batch.incident,
            media: &media,
            is_dispersive,
            layers: &layers,
            stacks: &stacks,
        },
    )?;
    Ok(found.into_iter().map(widened).collect())
}

fn widened([r_s, r_p, t_s, t_p]: gpu::StackPowers) -> Powers {
    let pair = |s: f32, p: f32| Polarized {
        s: f64::from(s),
        p: f64::from(p),
    };
    Powers {
        reflectance: pair(r_s, r_p),
        transmittance: pair(t_s, t_p),
    }
}
