//! Checks of a batch before it is evaluated.

use super::{Media, StackBatch};
use rayon::prelude::*;

/// Why a batch cannot be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// The incident medium has no positive real index.
    #[error("the incident medium has the index {0}; it must be positive and finite")]
    Incident(f64),
    /// A wavelength is not positive.
    #[error("wavelength {place} is {found} nm; it must be positive and finite")]
    Wavelength {
        /// Its index, from 0.
        place: usize,
        /// Its value.
        found: f64,
    },
    /// A cosine is outside (0, 1].
    #[error("cosine {place} is {found}; it must be above 0 and at most 1")]
    Cosine {
        /// Its index, from 0.
        place: usize,
        /// Its value.
        found: f64,
    },
    /// The table of dispersive media does not hold a whole number of spectra.
    #[error(
        "{found} indices of dispersive media are not a multiple of the {wavelengths} wavelengths"
    )]
    Media {
        /// Number of indices.
        found: usize,
        /// Number of wavelengths.
        wavelengths: usize,
    },
    /// An index is not n + ik with n ≥ 0, k ≥ 0 and not both 0.
    #[error(
        "index {place} of the media is {found}; n and k must be finite and not negative, and not both 0"
    )]
    Index {
        /// Its index, from 0.
        place: usize,
        /// Its value.
        found: num_complex::Complex64,
    },
    /// A thickness is negative or not finite.
    #[error("layer {layer} has a thickness of {found} nm; it must be finite and not negative")]
    Thickness {
        /// Its index, from 0.
        layer: usize,
        /// Its value.
        found: f64,
    },
    /// A layer names a medium that does not exist.
    #[error("layer {layer} has medium {medium}, but there are only {media} media")]
    LayerMedium {
        /// Index of the layer, from 0.
        layer: usize,
        /// Its medium.
        medium: u32,
        /// Number of media.
        media: usize,
    },
    /// A stack names a substrate that does not exist.
    #[error("stack {stack} has substrate {medium}, but there are only {media} media")]
    Substrate {
        /// Index of the stack, from 0.
        stack: usize,
        /// Its substrate.
        medium: u32,
        /// Number of media.
        media: usize,
    },
    /// A stack names layers that do not exist.
    #[error(
        "stack {stack} has {count} layers starting at {first}, but there are only {layers} layers"
    )]
    Layers {
        /// Index of the stack, from 0.
        stack: usize,
        /// Its first layer.
        first: u32,
        /// Number of its layers.
        count: u32,
        /// Number of layers of the batch.
        layers: usize,
    },
    /// The slice for the results has the wrong length.
    #[error("the slice for the results has length {found}; the batch needs {expected}")]
    Output {
        /// Its length.
        found: usize,
        /// The length that is needed.
        expected: usize,
    },
}

/// Finds the first wrong item of a slice. As long as all are right, it searches on all cores and makes no error values, since a
/// batch may have millions of items.
fn first_wrong<T: Sync>(
    things: &[T],
    right: impl Fn(&T) -> bool + Sync,
    error: impl Fn(usize, &T) -> BatchError,
) -> Result<(), BatchError> {
    const TOGETHER: usize = 4096;
    let all_right = |group: &[T]| group.iter().fold(true, |all, thing| all & right(thing));
    // A few items are not worth waking another core.
    let well = if things.len() <= TOGETHER {
        all_right(things)
    } else {
        things.par_chunks(TOGETHER).all(all_right)
    };
    if well {
        return Ok(());
    }
    let wrong = |(place, thing)| (!right(thing)).then(|| error(place, thing));
    things
        .iter()
        .enumerate()
        .find_map(wrong)
        .map_or(Ok(()), Err)
}

/// Checks every number of a batch.
///
/// # Errors
/// Reports the first number outside its domain.
pub(super) fn check(batch: &StackBatch) -> Result<(), BatchError> {
    if !(batch.incident > 0.0 && batch.incident.is_finite()) {
        return Err(BatchError::Incident(batch.incident));
    }
    first_wrong(
        batch.wavelengths_nm,
        |&nm| nm > 0.0 && nm.is_finite(),
        |place, &found| BatchError::Wavelength { place, found },
    )?;
    first_wrong(
        batch.cosines,
        |&cosine| cosine > 0.0 && cosine <= 1.0,
        |place, &found| BatchError::Cosine { place, found },
    )?;
    let media = check_media(batch)?;
    first_wrong(
        batch.layers,
        |layer| layer.thickness_nm >= 0.0 && layer.thickness_nm.is_finite(),
        |layer, of| BatchError::Thickness {
            layer,
            found: of.thickness_nm,
        },
    )?;
    first_wrong(
        batch.layers,
        |layer| (layer.medium as usize) < media,
        |layer, of| BatchError::LayerMedium {
            layer,
            medium: of.medium,
            media,
        },
    )?;
    check_stacks(batch, media)
}

/// Checks the media and returns how many there are.
fn check_media(batch: &StackBatch) -> Result<usize, BatchError> {
    let wavelengths = batch.wavelengths_nm.len();
    let (indices, media) = match batch.media {
        Media::Constant(indices) => (indices, indices.len()),
        Media::Dispersive(indices) if indices.len().is_multiple_of(wavelengths) => {
            (indices, indices.len() / wavelengths.max(1))
        }
        Media::Dispersive(indices) => {
            let found = indices.len();
            return Err(BatchError::Media { found, wavelengths });
        }
    };
    first_wrong(
        indices,
        |n| n.re >= 0.0 && n.im >= 0.0 && n.re + n.im > 0.0 && (n.re + n.im).is_finite(),
        |place, &found| BatchError::Index { place, found },
    )?;
    Ok(media)
}

fn check_stacks(batch: &StackBatch, media: usize) -> Result<(), BatchError> {
    let layers = batch.layers.len();
    first_wrong(
        batch.stacks,
        |stack| (stack.substrate as usize) < media,
        |stack, of| BatchError::Substrate {
            stack,
            medium: of.substrate,
            media,
        },
    )?;
    first_wrong(
        batch.stacks,
        |stack| stack.first_layer as usize + stack.layer_count as usize <= layers,
        |stack, of| BatchError::Layers {
            stack,
            first: of.first_layer,
            count: of.layer_count,
            layers,
        },
    )
}
