//! Lanes filled with consecutive results, for batches of few wavelengths.

use super::{LayerOf, Powers, StackBatch, write};
use crate::wide::{Index, Lanes, MAX, Real, SCALED_AFTER, Sweep, Wave};
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Some consecutive results.
pub(super) struct Part<'a> {
    pub(super) batch: &'a StackBatch<'a>,
    /// Index of the first among the batch's results.
    pub(super) first: usize,
    pub(super) powers: &'a mut [Powers],
}

/// What one lane computes.
#[derive(Clone, Copy)]
struct Item<'a> {
    layers: &'a [LayerOf],
    substrate: Complex64,
    cosine: f64,
    wavelength: usize,
}

impl<'a> Item<'a> {
    #[inline(always)]
    fn new(batch: &'a StackBatch, place: usize) -> Self {
        let wavelengths = batch.wavelengths_nm.len();
        let (row, wavelength) = (place / wavelengths, place % wavelengths);
        let stack = batch.stacks[row / batch.cosines.len()];
        Self {
            layers: batch.layers_of(stack),
            substrate: batch.index(stack.substrate, wavelength),
            cosine: batch.cosines[row % batch.cosines.len()],
            wavelength,
        }
    }
}

/// Light in every lane while a group of items is evaluated.
struct Light<S: Simd> {
    simd: S,
    incident: Lanes<S>,
    q0_squared: Lanes<S>,
    least_q0_squared: f64,
    half_waves_per_nm: Lanes<S>,
}

impl<S: Simd> Light<S> {
    #[inline(always)]
    fn wave(&self, n: &[f64; MAX], k: &[f64; MAX]) -> Wave<Lanes<S>> {
        let clear = k[..Lanes::<S>::COUNT].iter().all(|k| *k == 0.0);
        let (n, k) = (Lanes::load(self.simd, n), Lanes::load(self.simd, k));
        let index = Index::new(n, k, clear, self.incident);
        index.wave(
            self.q0_squared,
            self.least_q0_squared,
            self.half_waves_per_nm,
        )
    }
}

impl WithSimd for Part<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            batch,
            first,
            powers,
        } = self;
        let last = first + powers.len() - 1;
        for (group, powers) in powers.chunks_mut(Lanes::<S>::COUNT).enumerate() {
            let start = first + group * Lanes::<S>::COUNT;
            // Lanes beyond the last result repeat it.
            let mut items = [Item::new(batch, start); MAX];
            for (lane, item) in items.iter_mut().enumerate() {
                *item = Item::new(batch, (start + lane).min(last));
            }
            evaluate(simd, batch, &items, powers);
        }
    }
}

#[inline(always)]
fn evaluate<S: Simd>(simd: S, batch: &StackBatch, items: &[Item; MAX], powers: &mut [Powers]) {
    let (mut cosines, mut half_waves) = ([0.0; MAX], [0.0; MAX]);
    let (mut n, mut k) = ([0.0; MAX], [0.0; MAX]);
    for (lane, item) in items.iter().enumerate() {
        cosines[lane] = item.cosine;
        half_waves[lane] = 2.0 / batch.wavelengths_nm[item.wavelength];
        (n[lane], k[lane]) = (item.substrate.re, item.substrate.im);
    }
    let incident = Lanes::splat(simd, batch.incident);
    let cosines = Lanes::load(simd, &cosines);
    let q0 = incident * cosines;
    let light = Light {
        simd,
        incident,
        q0_squared: q0 * q0,
        least_q0_squared: (q0 * q0).least(),
        half_waves_per_nm: Lanes::load(simd, &half_waves),
    };
    let mut sweep = Sweep::new(&light.wave(&n, &k));
    let mut highest = 0;
    for item in items {
        highest = highest.max(item.layers.len());
    }
    for step in 0..highest {
        if step > 0 && step % SCALED_AFTER == 0 {
            sweep.rescale();
        }
        let thickness_nm = gather(batch, items, step, &mut n, &mut k);
        sweep.pass(&light.wave(&n, &k), Lanes::load(simd, &thickness_nm));
    }
    write(sweep.powers(q0, cosines * incident.recip()), powers);
}

/// Thickness and index of each lane's layer `step` steps above its substrate. A stack that has ended repeats the index with
/// zero thickness, which changes nothing.
#[inline(always)]
fn gather(
    batch: &StackBatch,
    items: &[Item; MAX],
    step: usize,
    n: &mut [f64; MAX],
    k: &mut [f64; MAX],
) -> [f64; MAX] {
    let mut thickness_nm = [0.0; MAX];
    for (lane, item) in items.iter().enumerate() {
        if step < item.layers.len() {
            let layer = item.layers[item.layers.len() - 1 - step];
            let index = batch.index(layer.medium, item.wavelength);
            (n[lane], k[lane]) = (index.re, index.im);
            thickness_nm[lane] = layer.thickness_nm;
        }
    }
    thickness_nm
}
