//! The noise of a picture, estimated while it is rendered.
//!
//! # What is estimated
//!
//! The noise of a pixel is √(mean over its bands of Var(band's mean)) / (mean over its bands of the radiance), and the noise of a
//! picture is the median over its pixels. A pixel is left out while no light at all was found in it: it has no noise to speak of.
//! Variance is meant between renders with other seeds.
//!
//! # Why not from the spread of the samples
//!
//! The samples' own variance, divided by their number, is right for independent samples only. Scrambled Sobol points spread
//! evenly, so that errors cancel (Owen, Randomly permuted (t, m, s)-nets and (t, s)-sequences, 1995; Scrambled net variance for
//! integrals of smooth functions, Ann. Statist. 25, 1997), and that number is too large by a factor which grows with every sample.
//!
//! # What is measured instead
//!
//! Let V(n) be the variance of the mean of an aligned block of n = 2ᵏ samples, and A and B the means of two that are halves of an
//! aligned block of 2n. Nested scrambling of the points and of their order swaps the halves of every aligned block with probability
//! ½, so A and B have one mean, one variance V(n) and a covariance C(n), and
//!
//! - V(2n) = Var((A + B) / 2) = (V(n) + C(n)) / 2, so C(n) = 2 V(2n) − V(n);
//! - E\[((A − B) / 2)²\] = (V(n) − C(n)) / 2 = V(n) − V(2n).
//!
//! The second identity holds however the samples depend on each other. If A is the mean of the first n samples, (A − B) / 2 is the
//! step that the pixel's mean makes from n to 2n samples. Thus the steps of a single render measure how the variance falls.
//!
//! What they cannot measure is the variance that is left, and here is the one assumption: from octave to octave it falls like
//! n^−α. Then V(2n) = (V(n) − V(2n)) / (2^α − 1), and α comes from the steps of the last octaves, over the whole picture. Independent
//! samples have α = 1. For other numbers of samples, N is a sum of aligned blocks of falling size, one for each of its binary digits;
//! V(N) follows from V and C. (C also holds between a block and any aligned part of its other half, because the parts are exchangeable.)
//!
//! # Few steps, many pixels
//!
//! The step of one pixel says little: its bands rise and fall together, so a squared step is spread almost like χ² with one degree
//! of freedom, whose median is less than half its mean. Neighbors see alike integrands. So squared steps, relative to the pixels'
//! squared radiance, are averaged over short runs of neighbors, and for the size (not for α) over the last steps as well, each
//! scaled by α to the newest. The median over runs stands for that over pixels. Long runs would mix pixels of unlike noise, and
//! rare bright samples would be in every run.
//!
//! The samples' own variance is a bound, as scrambled points are hardly ever worse than independent ones, and the fallback while there
//! are too few steps.
//!
//! In scenes of films, metals and rooms, at 16 to 1024 samples, the estimate is by its mean within 20 % of the noise between 16
//! seeds, and a single one mostly. What no sample has met yet it cannot know: where rare bright samples make most of the noise, it was
//! a quarter too low below 32 samples.

mod bytes;
mod power_law;
#[cfg(test)]
mod tests;

use power_law::PowerLaw;

/// Number of pixels that are watched at most.
const MOST_WATCHED: usize = 8192;
/// Watched pixels come in runs of neighbors, whose steps are taken together.
const RUN: usize = 4;
/// Number of the last steps that are kept.
const STEPS: usize = 4;
/// Number of the last steps whose sizes are taken together.
const STEPS_OF_SIZE: usize = 3;
/// Weight of a step relative to that of the step after it.
const OLDER: f64 = 0.6;
/// The steps are trusted from this number of samples on.
const FEWEST_SAMPLES: u32 = 8;

/// Tells the state of a pixel: receives its index, and fills in, for each band, the mean and the variance of the mean as it were if
/// the samples were independent.
pub type PixelValues<'a> = dyn FnMut(usize, &mut [f64], &mut [f64]) + 'a;

/// Estimates the noise of a picture from some of its pixels, watched while their samples grow in number.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseEstimator {
    pixels: usize,
    bands: usize,
    watched: Vec<usize>,
    /// Number of samples recorded last.
    samples: u32,
    /// The last power of two recorded.
    octave: u32,
    /// Band means of the watched pixels at that number.
    snapshot: Vec<f32>,
    /// For each of the last doublings up to that number, the newest first, and each watched pixel: the root mean square over bands
    /// of the step of its mean.
    steps: Vec<Vec<f32>>,
    /// Radiance of each watched pixel, the mean over its bands.
    radiance: Vec<f32>,
    /// Root mean square over bands of each watched pixel's standard deviation, were its samples independent.
    deviation: Vec<f32>,
}

impl NoiseEstimator {
    /// An estimator for a window of so many pixels (its width × its height), each with so many bands.
    pub fn new(pixels: usize, bands: usize) -> Self {
        let watched = watched(pixels);
        Self {
            pixels,
            bands,
            samples: 0,
            octave: 0,
            snapshot: vec![0.0; watched.len() * bands],
            steps: Vec::new(),
            radiance: vec![0.0; watched.len()],
            deviation: vec![0.0; watched.len()],
            watched,
        }
    }

    /// Indices of the watched pixels, counted row by row, ascending: all of a small picture, 8192 of a large one, in runs of 4
    /// neighbors spread over it.
    pub fn watched(&self) -> &[usize] {
        &self.watched
    }

    /// The number of samples recorded last.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Records the state of the watched pixels when each has so many samples, more than before.
    ///
    /// The estimate needs all powers of two: it learns from the steps between them. Nothing is recorded if the number of samples has
    /// not grown.
    pub fn record(&mut self, samples: u32, values: &mut PixelValues<'_>) {
        if samples <= self.samples {
            return;
        }
        let is_octave = samples.is_power_of_two();
        let is_next = is_octave && samples / 2 == self.octave;
        let (mut mean, mut variance) = (vec![0.0; self.bands], vec![0.0; self.bands]);
        let mut step = Vec::new();
        for (i, &pixel) in self.watched.iter().enumerate() {
            values(pixel, &mut mean, &mut variance);
            self.radiance[i] = finite(mean_of(mean.iter().copied()));
            self.deviation[i] = finite(mean_of(variance.iter().copied()).sqrt());
            if is_octave {
                let before = &mut self.snapshot[i * self.bands..][..self.bands];
                let steps = mean.iter().zip(&*before);
                let squares = steps.map(|(now, &before)| (now - f64::from(before)).powi(2));
                step.push(finite(mean_of(squares).sqrt()));
                for (before, &now) in before.iter_mut().zip(&mean) {
                    *before = finite(now);
                }
            }
        }
        if is_octave {
            self.keep_step(samples, is_next, step);
        }
        self.samples = samples;
    }

    /// Keeps the step to a power of two. That from 1 sample to 2 says nothing about the steps after it: it is where points in two
    /// halves gain most over independent ones.
    fn keep_step(&mut self, octave: u32, is_next: bool, step: Vec<f32>) {
        if !is_next {
            self.steps.clear();
        } else if octave > 2 {
            self.steps.insert(0, step);
            self.steps.truncate(STEPS);
        }
        self.octave = octave;
    }

    /// The estimated noise: 0.01 is 1 %. `None` before two samples, and while no watched pixel has any light.
    ///
    /// Below 8 samples this is the noise of independent samples, which is too high for those of Sobol's sequence.
    pub fn noise(&self) -> Option<f64> {
        Some(self.prediction()?.noise(self.samples))
    }

    /// The number of samples at which to ask again: the smallest above the present one whose predicted noise is at most `target`,
    /// out of 1¼, 1½, 1¾ and 2 times the last power of two; the next power of two if none suffices.
    pub fn next_stop(&self, target: f64) -> u32 {
        let Some(octave) = self.samples.checked_ilog2().map(|digit| 1_u32 << digit) else {
            return 1;
        };
        let next = octave.saturating_mul(2);
        let Some(prediction) = self.prediction() else {
            return next;
        };
        let quarters = (5..8).map(|quarters| u64::from(octave) * quarters);
        quarters
            .filter(|quarters| quarters % 4 == 0)
            .filter_map(|quarters| u32::try_from(quarters / 4).ok())
            .filter(|&samples| samples > self.samples)
            .find(|&samples| prediction.noise(samples) <= target)
            .unwrap_or(next)
    }

    /// What is known about the noise at any number of samples.
    fn prediction(&self) -> Option<Prediction> {
        if self.samples < 2 {
            return None;
        }
        let of_independent = self.lit().map(|i| self.relative(i, self.deviation[i]));
        let of_independent = median(of_independent.collect())?;
        Some(Prediction {
            samples: self.samples,
            of_independent,
            law: self.law(),
        })
    }

    /// The law by which the variance falls in the middle of the picture.
    fn law(&self) -> Option<PowerLaw> {
        if self.samples < FEWEST_SAMPLES || self.steps.is_empty() {
            return None;
        }
        let of_step = |step: &Vec<f32>| self.typical_square(|i| self.relative(i, step[i]).powi(2));
        let squares: Option<Vec<f64>> = self.steps.iter().map(of_step).collect();
        let exponent = power_law::exponent(&squares?, OLDER);
        // The steps as large as the newest would be, by the law.
        let weights: Vec<f64> = (0..STEPS_OF_SIZE as i32)
            .map(|age| OLDER.powi(age) * (-exponent * f64::from(age)).exp2())
            .take(self.steps.len())
            .collect();
        let total: f64 = (0..weights.len() as i32).map(|age| OLDER.powi(age)).sum();
        let square = self.typical_square(|i| {
            let steps = self.steps.iter().zip(&weights);
            let squares = steps.map(|(step, weight)| weight * self.relative(i, step[i]).powi(2));
            squares.sum::<f64>() / total
        })?;
        Some(PowerLaw::after_step(self.octave, square, exponent))
    }

    /// The places, among the watched pixels, of those with any light.
    fn lit(&self) -> impl Iterator<Item = usize> {
        (0..self.watched.len()).filter(|&i| self.radiance[i] > 0.0)
    }

    /// A deviation of a lit pixel relative to its radiance.
    fn relative(&self, i: usize, deviation: f32) -> f64 {
        f64::from(deviation) / f64::from(self.radiance[i])
    }

    /// The median over runs of lit pixels of the mean of a square that is noisy in each.
    fn typical_square(&self, square: impl Fn(usize) -> f64) -> Option<f64> {
        let lit: Vec<usize> = self.lit().collect();
        let of_run = |run: &[usize]| mean_of(run.iter().map(|&i| square(i)));
        median(lit.chunks(RUN).map(of_run).collect())
    }
}

/// The noise at any number of samples.
struct Prediction {
    samples: u32,
    /// Noise at that number, were the samples independent: no more than this.
    of_independent: f64,
    law: Option<PowerLaw>,
}

impl Prediction {
    fn noise(&self, samples: u32) -> f64 {
        let fewer = f64::from(self.samples) / f64::from(samples);
        let of_independent = self.of_independent * fewer.sqrt();
        let by_law = self.law.as_ref().map(|law| law.variance(samples).sqrt());
        by_law.map_or(of_independent, |noise| noise.min(of_independent))
    }
}

/// Chooses pixels: all if there are few, or runs of neighbors, one at a random place in each of many equal parts of the picture.
fn watched(pixels: usize) -> Vec<usize> {
    if pixels <= MOST_WATCHED {
        return (0..pixels).collect();
    }
    let (runs, parts) = (pixels / RUN, MOST_WATCHED / RUN);
    let first = |part: usize| (part as u128 * runs as u128 / parts as u128) as usize;
    let run = |part: usize| {
        let length = first(part + 1) - first(part);
        first(part) + (hash(part as u64) % length.max(1) as u64) as usize
    };
    (0..parts)
        .flat_map(|part| (0..RUN).map(move |i| (part, i)))
        .map(|(part, i)| run(part) * RUN + i)
        .collect()
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
fn hash(key: u64) -> u64 {
    let mut x = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The mean; 0 for no values.
fn mean_of(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    values.sum::<f64>() / count
}

/// Stores a number; one that cannot be stored is 0.
fn finite(value: f64) -> f32 {
    let stored = value as f32;
    if stored.is_finite() { stored } else { 0.0 }
}

/// The median, the upper of the two in the middle; `None` of no values.
fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    if values.is_empty() {
        return None;
    }
    let (_, median, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*median)
}
