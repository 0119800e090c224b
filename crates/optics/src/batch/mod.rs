//! Many stacks at many angles and wavelengths in one call, on all cores and in all lanes of their SIMD registers.
//!
//! The data are plain arrays: tables of media, layers and stacks that refer to one another by index.
//!
//! ```
//! use pellicle_optics::batch::{LayerOf, Media, StackBatch, StackOf, evaluate};
//! use pellicle_optics::Complex64;
//!
//! // Silica of 100, 200 and 300 nm on silicon, at three wavelengths, at normal incidence and at 60°.
//! let index = |n, k| Complex64::new(n, k);
//! let media = [
//!     index(1.4701, 0.0), index(1.4599, 0.0), index(1.4553, 0.0), // silica at 400, 550 and 700 nm
//!     index(5.570, 0.387), index(4.084, 0.041), index(3.783, 0.012), // silicon
//! ];
//! let layer = |thickness_nm| LayerOf { medium: 0, thickness_nm };
//! let stack = |layer| StackOf { substrate: 1, first_layer: layer, layer_count: 1 };
//! let batch = StackBatch {
//!     wavelengths_nm: &[400.0, 550.0, 700.0],
//!     cosines: &[1.0, 0.5],
//!     incident: 1.0,
//!     media: Media::Dispersive(&media),
//!     layers: &[layer(100.0), layer(200.0), layer(300.0)],
//!     stacks: &[stack(0), stack(1), stack(2)],
//! };
//! let powers = evaluate(&batch)?;
//! assert_eq!(powers.len(), 3 * 2 * 3);
//! let at = |stack: usize, angle: usize, wavelength: usize| powers[(stack * 2 + angle) * 3 + wavelength];
//! // At 550 nm, 94 nm of silica are a quarter wave, which suppresses silicon's 0.37, and 188 nm change nothing.
//! assert!(at(0, 0, 1).reflectance.unpolarized() < 0.11);
//! assert!(at(1, 0, 1).reflectance.unpolarized() > 0.35);
//! # Ok::<(), pellicle_optics::batch::BatchError>(())
//! ```

#![expect(
    clippy::inline_always,
    reason = "code that works on lanes must be inlined into the caller that was compiled for them"
)]

mod check;
mod mixed;
mod spectra;
#[cfg(test)]
mod tests;

pub use check::BatchError;

use crate::Polarized;
use crate::wide::{Lanes, MAX};
use bytemuck::{Pod, Zeroable};
use num_complex::Complex64;
use pulp::Arch;
use rayon::prelude::*;

/// Stacks to evaluate at each of `cosines` and each of `wavelengths_nm`.
#[derive(Clone, Copy, Debug)]
pub struct StackBatch<'a> {
    /// Wavelengths in vacuum, nm, > 0.
    pub wavelengths_nm: &'a [f64],
    /// Cosines of the angle of incidence, in the incident medium, in (0, 1].
    pub cosines: &'a [f64],
    /// Index of the incident medium, real, > 0.
    pub incident: f64,
    /// Indices of the other media.
    pub media: Media<'a>,
    /// The layers of all stacks.
    pub layers: &'a [LayerOf],
    /// The stacks.
    pub stacks: &'a [StackOf],
}

/// Indices n + ik (n ≥ 0, k ≥ 0, not both 0) of media, which are numbered from 0.
#[derive(Clone, Copy, Debug)]
pub enum Media<'a> {
    /// One index per medium, the same at every wavelength.
    Constant(&'a [Complex64]),
    /// `[medium][wavelength]`: one index per medium and wavelength.
    Dispersive(&'a [Complex64]),
}

/// A layer of one medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerOf {
    /// Number of its medium among the batch's media.
    pub medium: u32,
    /// Thickness, nm, ≥ 0.
    pub thickness_nm: f64,
}

/// A stack: some of the batch's layers on a substrate. The first layer touches the incident medium. Stacks may share layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StackOf {
    /// Number of the substrate among the batch's media.
    pub substrate: u32,
    /// Number of its first layer among the batch's layers.
    pub first_layer: u32,
    /// Number of its layers; may be 0.
    pub layer_count: u32,
}

/// R and T of a stack at one angle and wavelength: four numbers R_s, R_p, T_s, T_p.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Powers {
    /// Fraction of the power that is reflected.
    pub reflectance: Polarized,
    /// Fraction of the power that enters the substrate.
    pub transmittance: Polarized,
}

impl StackBatch<'_> {
    /// Number of results: stacks × angles × wavelengths.
    pub fn len(&self) -> usize {
        self.stacks.len() * self.results_per_stack()
    }

    /// Returns whether the batch has no results.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Checks that every number of the batch is within its domain, as [`evaluate`] requires.
    ///
    /// # Errors
    /// [`BatchError`] says which number is not.
    pub fn check(&self) -> Result<(), BatchError> {
        check::check(self)
    }

    /// Number of results per stack.
    fn results_per_stack(&self) -> usize {
        self.cosines.len() * self.wavelengths_nm.len()
    }

    fn layers_of(&self, stack: StackOf) -> &[LayerOf] {
        let first = stack.first_layer as usize;
        &self.layers[first..first + stack.layer_count as usize]
    }

    fn index(&self, medium: u32, wavelength: usize) -> Complex64 {
        match self.media {
            Media::Constant(indices) => indices[medium as usize],
            Media::Dispersive(indices) => {
                indices[medium as usize * self.wavelengths_nm.len() + wavelength]
            }
        }
    }
}

/// R and T of every stack at every angle and wavelength, as `[stack][angle][wavelength]`.
///
/// The results equal those of [`stack`](crate::stack), with the same domain, to 1e-12 for ordinary stacks (layers of a few µm
/// in total, mirrors of some 20 layers; thicker ones amplify the rounding of the phase in both functions). Where nothing is
/// transmitted, T is below 1e-300 rather than 0.
///
/// # Errors
/// [`BatchError`] says which number of the batch is outside its domain.
pub fn evaluate(batch: &StackBatch) -> Result<Vec<Powers>, BatchError> {
    check::check(batch)?;
    let mut powers = bytemuck::zeroed_vec(batch.len());
    run(Arch::new(), batch, &mut powers);
    Ok(powers)
}

/// [`evaluate`] into an existing slice, which saves allocations when many batches follow one another.
///
/// # Errors
/// [`BatchError`] says which number of the batch is outside its domain, or that the length of the slice is not
/// [`StackBatch::len`]. Nothing is written then.
pub fn evaluate_into(batch: &StackBatch, powers: &mut [Powers]) -> Result<(), BatchError> {
    check::check(batch)?;
    if powers.len() != batch.len() {
        return Err(BatchError::Output {
            found: powers.len(),
            expected: batch.len(),
        });
    }
    run(Arch::new(), batch, powers);
    Ok(())
}

/// From this number of wavelengths on, lanes run along the spectrum, and what depends on a medium and an angle is computed
/// once for all layers. With fewer wavelengths, lanes are filled with consecutive results.
const SPECTRUM: usize = 4;

fn run(arch: Arch, batch: &StackBatch, powers: &mut [Powers]) {
    if powers.is_empty() {
        return;
    }
    if batch.wavelengths_nm.len() >= SPECTRUM {
        let parts: Vec<_> = spectra::parts(batch, powers).collect();
        parts.into_par_iter().for_each(|part| arch.dispatch(part));
    } else {
        const SHARE: usize = 2048;
        let shares = powers.par_chunks_mut(SHARE).enumerate();
        shares.for_each(|(share, powers)| {
            let first = share * SHARE;
            arch.dispatch(mixed::Part {
                batch,
                first,
                powers,
            });
        });
    }
}

/// Writes the powers of consecutive lanes to as many results.
#[inline(always)]
fn write<S: pulp::Simd>(lanes: [Lanes<S>; 4], powers: &mut [Powers]) {
    let mut rows = [[0.0; MAX]; 4];
    for (row, lanes) in rows.iter_mut().zip(lanes) {
        lanes.store(row);
    }
    for (place, power) in powers.iter_mut().enumerate() {
        *power = Powers {
            reflectance: Polarized {
                s: rows[0][place],
                p: rows[1][place],
            },
            transmittance: Polarized {
                s: rows[2][place],
                p: rows[3][place],
            },
        };
    }
}
