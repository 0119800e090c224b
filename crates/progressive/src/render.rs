//! A render in progress: which round is next, and when it ends.

use crate::checkpoint::{self, CheckpointError, State};
use crate::{End, Goal, Identity, NoiseEstimator, adaptive};
use spectra::{Accumulation, Round, variance_of_mean};
use std::path::Path;

/// Seconds that a round takes at most, if its pixels take more than one sample in it. Each round reads and writes the state of all
/// pixels, so short rounds cost time.
const ROUND_S: f64 = 4.0;
/// The number of samples of the first round, and of a larger picture, whose first round shows how fast it is.
const FIRST_ROUND: u32 = 4;
const LARGE_PIXELS: usize = 1 << 20;
/// The number of samples from which on the noise estimate may end a render.
const LEAST_JUDGED: u32 = 16;

/// A render in progress.
///
/// Its rounds end at powers of two, where the noise estimate looks at the picture, and before [`Render::limit_rounds`] seconds. Their
/// bits do not depend on that.
#[derive(Clone, Debug)]
pub struct Render {
    accumulation: Accumulation,
    goal: Goal,
    noise: NoiseEstimator,
    /// The number of samples of each tile; empty if all pixels have as many.
    plan: Vec<u32>,
    /// The samples that all pixels have, or as many as their tile's.
    level: u32,
    /// Whether the CPU has continued what a GPU began.
    is_mixed: bool,
    /// The number of samples at which the noise is judged next.
    stop: u32,
    /// What was spent since the render began or was resumed.
    seconds: f64,
    samples_per_s: Option<f64>,
    round_s: f64,
    end: Option<End>,
}

impl Render {
    /// Begins with an accumulation without samples.
    pub fn new(accumulation: Accumulation, goal: Goal) -> Self {
        let bands = accumulation.bands().count() as usize;
        let noise = NoiseEstimator::new(accumulation.window().pixels(), bands);
        Self {
            accumulation,
            goal,
            noise,
            plan: Vec::new(),
            level: 0,
            is_mixed: false,
            stop: LEAST_JUDGED.min(goal.samples),
            seconds: 0.0,
            samples_per_s: None,
            round_s: ROUND_S,
            end: None,
        }
    }

    /// Goes on from a checkpoint of the same render.
    ///
    /// # Errors
    /// When the file cannot be read, is damaged, or is of another render.
    pub fn resume(
        (accumulation, goal): (Accumulation, Goal),
        path: &Path,
        identity: &Identity,
    ) -> Result<Self, CheckpointError> {
        let mut own = Self::new(accumulation, goal);
        let state = checkpoint::read(path, identity, &mut own.accumulation)?;
        let window = own.accumulation.window();
        let bands = own.accumulation.bands().count() as usize;
        let damaged = |reason| CheckpointError::Damaged {
            path: path.to_owned(),
            reason,
        };
        own.noise = NoiseEstimator::from_bytes(window.pixels(), bands, &state.noise)
            .ok_or_else(|| damaged("its noise estimate cannot be read"))?;
        if !state.plan.is_empty() && state.plan.len() != adaptive::tiles(window).count() {
            return Err(damaged("its plan has not as many tiles as its picture"));
        }
        (own.plan, own.stop, own.is_mixed) = (state.plan, state.stop, state.is_mixed);
        own.level = own.reached();
        own.judge();
        if let (Some(goal), None) = (goal.noise, own.end)
            && own.stop <= own.level
        {
            // It had another goal.
            own.stop = own
                .noise
                .next_stop(goal)
                .max(own.level + 1)
                .max(LEAST_JUDGED);
        }
        Ok(own)
    }

    /// The least number of samples of a pixel that lacks some. A round that was broken off has advanced others further.
    fn reached(&self) -> u32 {
        let all = &self.accumulation;
        if !self.is_adaptive() {
            return all.counts().iter().copied().min().unwrap_or(0);
        }
        let tiles = adaptive::tiles(all.window()).zip(&self.plan);
        let counts = tiles.flat_map(|(tile, &planned)| {
            let counts = all
                .row_indices(tile)
                .flatten()
                .map(|pixel| all.counts()[pixel]);
            counts.filter(move |&count| count < planned)
        });
        counts.min().unwrap_or_else(|| self.last_level())
    }

    /// Gives tiles different numbers of samples, as [`adaptive::plan`] decides.
    #[must_use]
    pub fn with_plan(mut self, plan: Vec<u32>) -> Self {
        self.plan = plan;
        self
    }

    /// Whether tiles have different numbers of samples.
    pub fn is_adaptive(&self) -> bool {
        !self.plan.is_empty()
    }

    /// Records that the CPU continues what a GPU began.
    pub fn mix(&mut self) {
        self.is_mixed = true;
    }

    /// Whether the CPU has continued what a GPU began.
    pub fn is_mixed(&self) -> bool {
        self.is_mixed
    }

    /// Makes rounds shorter, so that what is done between them is done more often.
    pub fn limit_rounds(&mut self, seconds: f64) {
        self.round_s = self.round_s.min(seconds);
    }

    /// Writes a checkpoint, from which [`Render::resume`] goes on. It appears under its name when it is complete.
    ///
    /// # Errors
    /// When the file cannot be written; the one before it is then still there.
    pub fn write_checkpoint(
        &self,
        path: &Path,
        identity: &Identity,
    ) -> Result<(), CheckpointError> {
        let state = State {
            noise: self.noise.to_bytes(),
            stop: self.stop,
            plan: self.plan.clone(),
            is_mixed: self.is_mixed,
        };
        checkpoint::write(path, identity, &self.accumulation, &state)
    }

    /// The pixels.
    pub fn accumulation(&self) -> &Accumulation {
        &self.accumulation
    }

    /// The pixels, to be advanced by the rounds of [`Render::next_rounds`].
    pub fn accumulation_mut(&mut self) -> &mut Accumulation {
        &mut self.accumulation
    }

    /// The samples that every pixel has; if sampling is adaptive, the larger of those of two tiles.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// The noise of the picture; `None` before it can be estimated, and if sampling is adaptive.
    pub fn noise(&self) -> Option<f64> {
        if self.is_adaptive() {
            None
        } else {
            self.noise.noise()
        }
    }

    /// Why the render has ended, if it has.
    pub fn end(&self) -> Option<End> {
        self.end
    }

    /// The number of samples of all pixels, at the end, if nothing but their number ends the render.
    pub fn work(&self) -> u64 {
        let window = self.accumulation.window();
        if self.is_adaptive() {
            let tiles = adaptive::tiles(window).zip(&self.plan);
            let of_tile =
                |(tile, &count): (spectra::Window, &u32)| tile.pixels() as u64 * u64::from(count);
            tiles.map(of_tile).sum()
        } else {
            window.pixels() as u64 * u64::from(self.goal.samples)
        }
    }

    /// The number of samples that all pixels have together.
    pub fn done(&self) -> u64 {
        self.accumulation
            .counts()
            .iter()
            .map(|&count| u64::from(count))
            .sum()
    }

    /// The number of samples of all pixels until the render ends, as far as can be told: its goal may be a time or a noise.
    pub fn work_left(&self) -> u64 {
        if self.end.is_some() {
            return 0;
        }
        let by_samples = (self.work() - self.done().min(self.work())) as f64;
        let by_noise = self.goal.noise.zip(self.noise()).map(|(goal, now)| {
            // Noise falls at least like the root of the samples.
            self.done() as f64 * ((now / goal).powi(2) - 1.0).max(0.0)
        });
        let by_time = self.goal.seconds.zip(self.samples_per_s);
        let by_time = by_time.map(|(seconds, rate)| (seconds - self.seconds).max(0.0) * rate);
        let all = [Some(by_samples), by_noise, by_time];
        all.into_iter().flatten().fold(f64::INFINITY, f64::min) as u64
    }

    /// Seconds until the render ends, as far as can be told.
    pub fn seconds_left(&self) -> Option<f64> {
        Some(self.work_left() as f64 / self.samples_per_s?)
    }

    /// The next round, as rectangles of pixels that have the same number of samples; `None` at the end.
    pub fn next_rounds(&self) -> Option<Vec<Round>> {
        if self.end.is_some() {
            return None;
        }
        let level = self.next_level();
        let window = self.accumulation.window();
        if !self.is_adaptive() {
            return Some(self.accumulation.rounds_to(window, level));
        }
        let tiles = adaptive::tiles(window).zip(&self.plan);
        let rounds =
            tiles.flat_map(|(tile, &count)| self.accumulation.rounds_to(tile, level.min(count)));
        Some(rounds.collect())
    }

    fn last_level(&self) -> u32 {
        let planned = self.plan.iter().copied().max();
        planned.unwrap_or(self.goal.samples)
    }

    fn next_level(&self) -> u32 {
        let is_first_of_large =
            self.level == 0 && self.accumulation.window().pixels() > LARGE_PIXELS;
        let power = (self.level + 1).next_power_of_two().max(FIRST_ROUND);
        let mut next = if is_first_of_large { 1 } else { power }.min(self.last_level());
        if self.goal.noise.is_some() && self.level < self.stop {
            next = next.min(self.stop);
        }
        let seconds_left = self.goal.seconds.map(|seconds| seconds - self.seconds);
        let seconds = seconds_left.map_or(self.round_s, |left| left.min(self.round_s));
        match self.samples_per_s {
            // The first round shows how fast the scene is.
            None => next.min(self.level + FIRST_ROUND),
            Some(_) => next.min(self.level + self.fitting(seconds).max(1)),
        }
    }

    /// The number of samples that all pixels can take in some seconds; 0 before the speed is known.
    fn fitting(&self, seconds: f64) -> u32 {
        let per_s = self.samples_per_s.unwrap_or(0.0) / self.accumulation.window().pixels() as f64;
        (seconds * per_s) as u32
    }

    /// Records that the round of [`Render::next_rounds`] is done, and how long it took.
    pub fn finish_round(&mut self, work: u64, seconds: f64) {
        self.level = self.next_level();
        self.seconds += seconds;
        let measured = work as f64 / seconds.max(1e-9);
        self.samples_per_s = Some(
            self.samples_per_s
                .map_or(measured, |before| 0.5 * (before + measured)),
        );
        if !self.is_adaptive() {
            self.record_noise();
        }
        self.judge();
    }

    fn record_noise(&mut self) {
        let all = &self.accumulation;
        let layout = all.layout();
        let to_variance = variance_of_mean(self.level);
        let judged = self.level == self.stop;
        self.noise.record(self.level, &mut |pixel, mean, variance| {
            let values = all.pixel(pixel);
            mean.copy_from_slice(&values[layout.mean()]);
            for (to, squares) in variance.iter_mut().zip(&values[layout.deviation()]) {
                *to = squares * to_variance;
            }
        });
        if let (true, Some(goal)) = (judged, self.goal.noise) {
            let is_reached = self.noise.noise().is_some_and(|noise| noise <= goal);
            if !is_reached {
                self.stop = self.noise.next_stop(goal).max(self.level + 1);
            }
        }
    }

    /// Decides whether the render has ended.
    fn judge(&mut self) {
        let no_time = self.goal.seconds.is_some_and(|seconds| {
            self.level > 0
                && self.fitting(seconds - self.seconds) == 0
                && self.samples_per_s.is_some()
        });
        // The noise is judged only where a render that is not interrupted judges it too.
        let is_quiet = self.level > 0
            && self.level == self.stop
            && self
                .goal
                .noise
                .zip(self.noise())
                .is_some_and(|(goal, noise)| noise <= goal);
        self.end = if is_quiet {
            Some(End::Noise)
        } else if self.level >= self.last_level() {
            Some(End::Samples)
        } else if no_time {
            Some(End::Time)
        } else {
            None
        };
    }
}
