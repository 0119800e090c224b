//! The state of an estimator in a checkpoint: little-endian, first the numbers of pixels, bands, samples, the last power of two and
//! the steps, then the floats.

use super::{NoiseEstimator, STEPS};

impl NoiseEstimator {
    /// The state, for a checkpoint.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for count in [self.pixels, self.bands] {
            bytes.extend((count as u64).to_le_bytes());
        }
        for count in [self.samples, self.octave, self.steps.len() as u32] {
            bytes.extend(count.to_le_bytes());
        }
        let arrays = [&self.snapshot, &self.radiance, &self.deviation];
        let values = arrays.into_iter().chain(&self.steps).flatten();
        bytes.extend(values.flat_map(|value| value.to_le_bytes()));
        bytes
    }

    /// The estimator with a state from [`NoiseEstimator::to_bytes`], exactly. `None` if it is damaged, or is not of a window with so
    /// many pixels and bands.
    pub fn from_bytes(pixels: usize, bands: usize, bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes;
        let found = [take_u64(&mut rest)?, take_u64(&mut rest)?];
        if found != [pixels as u64, bands as u64] {
            return None;
        }
        let samples = u32::from_le_bytes(take(&mut rest)?);
        let octave = u32::from_le_bytes(take(&mut rest)?);
        let steps = u32::from_le_bytes(take(&mut rest)?) as usize;
        let is_octave = octave == 0 || octave.is_power_of_two();
        // The step from 1 sample to 2 is not kept.
        let doublings = octave.checked_ilog2().unwrap_or(0) as usize;
        if !is_octave || octave > samples || steps > STEPS.min(doublings.saturating_sub(1)) {
            return None;
        }
        let watched = super::watched(pixels);
        let count = watched.len();
        let total = count.checked_mul(bands.checked_add(2 + steps)?)?;
        if rest.len() != total.checked_mul(4)? {
            return None;
        }
        Some(Self {
            pixels,
            bands,
            watched,
            samples,
            octave,
            snapshot: take_floats(&mut rest, count * bands)?,
            radiance: take_floats(&mut rest, count)?,
            deviation: take_floats(&mut rest, count)?,
            steps: (0..steps)
                .map(|_| take_floats(&mut rest, count))
                .collect::<Option<_>>()?,
        })
    }
}

fn take<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (bytes, after) = rest.split_first_chunk()?;
    *rest = after;
    Some(*bytes)
}

fn take_u64(rest: &mut &[u8]) -> Option<u64> {
    take(rest).map(u64::from_le_bytes)
}

/// Floats, all of them finite.
fn take_floats(rest: &mut &[u8], count: usize) -> Option<Vec<f32>> {
    let float = |_| take(rest).map(f32::from_le_bytes);
    let floats: Vec<f32> = (0..count).map(float).collect::<Option<_>>()?;
    floats
        .iter()
        .all(|value| value.is_finite())
        .then_some(floats)
}
