//! Lanes along the spectrum: what depends on a medium is computed once for all layers of all stacks of a part.

use super::{Powers, StackBatch, write};
use crate::wide::{Index, Lanes, MAX, SCALED_AFTER, Sweep, Wave};
use pulp::{Simd, WithSimd};
use std::ops::Range;

/// Some stacks at some angles, and the slice for their results.
pub(super) struct Part<'a> {
    batch: &'a StackBatch<'a>,
    stacks: Range<usize>,
    angles: Range<usize>,
    /// `[stack][angle][wavelength]` of these stacks and angles.
    powers: &'a mut [Powers],
}

/// Stacks that are evaluated together share their media, as long as the media fit into the L1 cache.
const SHARED_MEDIA: usize = 16;
const SHARED_STACKS: usize = 16;
/// Number of results that are worth another core.
const WORTHWHILE: usize = 1024;

/// Cuts the batch into parts whose results are contiguous.
pub(super) fn parts<'a>(
    batch: &'a StackBatch<'a>,
    powers: &'a mut [Powers],
) -> Box<dyn Iterator<Item = Part<'a>> + 'a> {
    let (angles, wavelengths) = (batch.cosines.len(), batch.wavelengths_nm.len());
    let threads = rayon::current_num_threads();
    if batch.stacks.len() >= 4 * threads {
        let media: usize = media_count(batch);
        let together = if media <= SHARED_MEDIA {
            SHARED_STACKS.min(batch.stacks.len() / (4 * threads))
        } else {
            1
        };
        let chunks = powers.chunks_mut(together * angles * wavelengths);
        return Box::new(chunks.enumerate().map(move |(place, powers)| {
            let first = place * together;
            let stacks = first..(first + together).min(batch.stacks.len());
            Part {
                batch,
                stacks,
                angles: 0..angles,
                powers,
            }
        }));
    }
    let pieces = (2 * threads).min((angles * wavelengths).div_ceil(WORTHWHILE));
    let together = angles.div_ceil(pieces);
    let of_stacks = powers.chunks_mut(angles * wavelengths).enumerate();
    Box::new(of_stacks.flat_map(move |(stack, powers)| {
        let chunks = powers.chunks_mut(together * wavelengths).enumerate();
        chunks.map(move |(place, powers)| {
            let first = place * together;
            Part {
                batch,
                stacks: stack..stack + 1,
                angles: first..(first + together).min(angles),
                powers,
            }
        })
    }))
}

fn media_count(batch: &StackBatch) -> usize {
    match batch.media {
        super::Media::Constant(indices) => indices.len(),
        super::Media::Dispersive(indices) => indices.len() / batch.wavelengths_nm.len(),
    }
}

/// The steps of each stack: its substrate, then its layers from the bottom up, each with the slot of its medium.
struct Plan {
    /// The media that the part needs, in the order of their slots.
    media: Vec<u32>,
    substrates: Vec<usize>,
    /// End of each stack's steps.
    ends: Vec<usize>,
    steps: Vec<(usize, f64)>,
}

impl Plan {
    fn new(batch: &StackBatch, stacks: Range<usize>) -> Self {
        let stacks = &batch.stacks[stacks];
        let used = |stack: &super::StackOf| {
            let layers = batch.layers_of(*stack).iter().map(|layer| layer.medium);
            layers.chain([stack.substrate])
        };
        let mut media: Vec<u32> = stacks.iter().flat_map(used).collect();
        media.sort_unstable();
        media.dedup();
        let slot = |medium: u32| media.partition_point(|&other| other < medium);
        let (mut steps, mut ends) = (Vec::new(), Vec::new());
        for stack in stacks {
            let layers = batch.layers_of(*stack).iter().rev();
            steps.extend(layers.map(|layer| (slot(layer.medium), layer.thickness_nm)));
            ends.push(steps.len());
        }
        let substrates = stacks.iter().map(|stack| slot(stack.substrate)).collect();
        Self {
            media,
            substrates,
            ends,
            steps,
        }
    }
}

/// One register of wavelengths.
struct Band<S: Simd> {
    wavelengths: Range<usize>,
    half_waves_per_nm: Lanes<S>,
    /// By slot.
    indices: Vec<Index<Lanes<S>>>,
}

impl<S: Simd> Band<S> {
    /// Fills lanes beyond the last wavelength with the last one.
    #[inline(always)]
    fn new(simd: S, batch: &StackBatch, media: &[u32], first: usize) -> Self {
        let count = batch.wavelengths_nm.len();
        let wavelengths = first..(first + Lanes::<S>::COUNT).min(count);
        let place = |lane: usize| (first + lane).min(count - 1);
        let mut half_waves = [0.0; MAX];
        for (lane, number) in half_waves.iter_mut().enumerate() {
            *number = 2.0 / batch.wavelengths_nm[place(lane)];
        }
        let incident = Lanes::splat(simd, batch.incident);
        let mut indices = Vec::with_capacity(media.len());
        for &medium in media {
            let (mut n, mut k) = ([0.0; MAX], [0.0; MAX]);
            for lane in 0..MAX {
                let index = batch.index(medium, place(lane));
                (n[lane], k[lane]) = (index.re, index.im);
            }
            let clear = k == [0.0; MAX];
            let (n, k) = (Lanes::load(simd, &n), Lanes::load(simd, &k));
            indices.push(Index::new(n, k, clear, incident));
        }
        Self {
            wavelengths,
            half_waves_per_nm: Lanes::load(simd, &half_waves),
            indices,
        }
    }

    #[inline(always)]
    fn waves(&self, simd: S, q0: f64, waves: &mut Vec<Wave<Lanes<S>>>) {
        let q0_squared = Lanes::splat(simd, q0 * q0);
        waves.clear();
        for index in &self.indices {
            waves.push(index.wave(q0_squared, q0 * q0, self.half_waves_per_nm));
        }
    }
}

impl WithSimd for Part<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            batch,
            stacks,
            angles,
            powers,
        } = self;
        let plan = Plan::new(batch, stacks);
        let count = batch.wavelengths_nm.len();
        let per_stack = angles.len() * count;
        let mut waves = Vec::with_capacity(plan.media.len());
        for first in (0..count).step_by(Lanes::<S>::COUNT) {
            let band = Band::new(simd, batch, &plan.media, first);
            for (row, angle) in angles.clone().enumerate() {
                let cosine = batch.cosines[angle];
                band.waves(simd, batch.incident * cosine, &mut waves);
                let q0 = Lanes::splat(simd, batch.incident * cosine);
                let p0 = Lanes::splat(simd, cosine / batch.incident);
                let mut first_step = 0;
                for (stack, &end) in plan.ends.iter().enumerate() {
                    let substrate = &waves[plan.substrates[stack]];
                    let sweep = climb(simd, substrate, &plan.steps[first_step..end], &waves);
                    first_step = end;
                    let place = stack * per_stack + row * count;
                    let here = place + band.wavelengths.start..place + band.wavelengths.end;
                    write(sweep.powers(q0, p0), &mut powers[here]);
                }
            }
        }
    }
}

/// Follows the fields from the substrate up through all layers.
#[inline(always)]
fn climb<S: Simd>(
    simd: S,
    substrate: &Wave<Lanes<S>>,
    steps: &[(usize, f64)],
    waves: &[Wave<Lanes<S>>],
) -> Sweep<Lanes<S>> {
    let mut sweep = Sweep::new(substrate);
    for (place, group) in steps.chunks(SCALED_AFTER).enumerate() {
        if place > 0 {
            sweep.rescale();
        }
        for &(slot, thickness_nm) in group {
            sweep.pass(&waves[slot], Lanes::splat(simd, thickness_nm));
        }
    }
    sweep
}
