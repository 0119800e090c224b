//! What a batch must be before it is evaluated.

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
        /// Which, from 0.
        place: usize,
        /// Its value.
        found: f64,
    },
    /// A cosine is outside (0, 1].
    #[error("cosine {place} is {found}; it must be above 0 and at most 1")]
    Cosine {
        /// Which, from 0.
        place: usize,
        /// Its value.
        found: f64,
    },
    /// The table of dispersive media is no whole number of spectra.
    #[error("{found} indices of dispersive media are no multiple of the {wavelengths} wavelengths")]
    Media {
        /// How many indices there are.
        found: usize,
        /// How many wavelengths there are.
        wavelengths: usize,
    },
    /// An index is not n + ik with n ≥ 0 and k ≥ 0, not 0.
    #[error(
        "index {place} of the media is {found}; n and k must be finite, not negative, and not both 0"
    )]
    Index {
        /// Which, from 0.
        place: usize,
        /// Its value.
        found: num_complex::Complex64,
    },
    /// A thickness is negative.
    #[error("layer {layer} has a thickness of {found} nm; it must be finite and not negative")]
    Thickness {
        /// Which, from 0.
        layer: usize,
        /// Its value.
        found: f64,
    },
    /// A layer is of a medium that is not there.
    #[error("layer {layer} is of medium {medium}, but there are only {media} media")]
    LayerMedium {
        /// Which layer, from 0.
        layer: usize,
        /// Its medium.
        medium: u32,
        /// How many media there are.
        media: usize,
    },
    /// A substrate is a medium that is not there.
    #[error("stack {stack} lies on medium {medium}, but there are only {media} media")]
    Substrate {
        /// Which stack, from 0.
        stack: usize,
        /// Its substrate.
        medium: u32,
        /// How many media there are.
        media: usize,
    },
    /// A stack has layers that are not there.
    #[error("stack {stack} has {count} layers from {first} on, but there are only {layers} layers")]
    Layers {
        /// Which stack, from 0.
        stack: usize,
        /// Its first layer.
        first: u32,
        /// How many layers it has.
        count: u32,
        /// How many layers there are.
        layers: usize,
    },
    /// The slice for the results has another length.
    #[error("the slice for the results has room for {found}, but the batch has {expected}")]
    Output {
        /// Its length.
        found: usize,
        /// The length needed.
        expected: usize,
    },
}

/// The first of many things that is not right; looked for on all cores and without error values while all are right, since a
/// batch may have millions.
fn first_wrong<T: Sync>(
    things: &[T],
    right: impl Fn(&T) -> bool + Sync,
    error: impl Fn(usize, &T) -> BatchError,
) -> Result<(), BatchError> {
    const TOGETHER: usize = 4096;
    let all_right = |group: &[T]| group.iter().fold(true, |all, thing| all & right(thing));
    // A few are not worth waking another core.
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

/// # Errors
/// The first number outside its domain.
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

/// How many media there are.
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
