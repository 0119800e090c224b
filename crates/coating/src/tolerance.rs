//! Scatter of the color due to errors of thickness.

use crate::response::Angle;
use crate::stack_color::{Color, StackColor};
use colorimetry::Lab;
use colorimetry::lab::delta_e_2000;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use thiserror::Error;

/// Errors of thickness: independent for each layer and normally distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Standard deviation of a thickness relative to the thickness.
    pub relative_sigma: f64,
    /// Number of stacks that are drawn.
    pub trials: u32,
    /// Seed; the same seed draws the same stacks on any machine and number of threads.
    pub seed: u64,
}

/// Why the scatter cannot be computed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ToleranceError {
    /// The deviation is invalid.
    #[error("a tolerance of {} %; it must be more than 0 and at most 100 %", 100.0 * .0)]
    Sigma(f64),
    /// There are too few or too many trials.
    #[error("{0} trials; there must be from 1 to {max}", max = Tolerance::MAX_TRIALS)]
    Trials(u32),
    /// There is nothing to vary.
    #[error("the stack has no layer whose thickness can vary")]
    NoLayers,
}

/// Color differences ΔE₀₀ from the nominal color, by the fraction of trials that stay below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantiles {
    /// Median of the trials.
    pub p50: f64,
    /// 90 % of the trials.
    pub p90: f64,
    /// 95 % of the trials.
    pub p95: f64,
    /// 99 % of the trials.
    pub p99: f64,
    /// The largest difference.
    pub max: f64,
}

/// Scatter of the color.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    /// The color with the nominal thicknesses.
    pub nominal: Color,
    /// The mean of the trials' XYZ.
    pub mean: Color,
    /// Color difference of the mean from the nominal color.
    pub mean_delta_e: f64,
    /// Differences when all layers vary.
    pub all: Quantiles,
    /// Differences for each layer when it alone varies, from the first [`Tolerance::ALONE`] trials.
    pub alone: Vec<Quantiles>,
}

impl Spread {
    /// Index from 0 of the layer that matters most: the one with the largest 95th percentile when it varies alone.
    pub fn worst_layer(&self) -> Option<usize> {
        let largest =
            |a: &(usize, &Quantiles), b: &(usize, &Quantiles)| a.1.p95.total_cmp(&b.1.p95);
        self.alone
            .iter()
            .enumerate()
            .max_by(largest)
            .map(|(layer, _)| layer)
    }
}

impl Tolerance {
    /// Maximum number of trials for the effect of each layer alone, since they are drawn for every layer.
    pub const ALONE: u32 = 2000;
    /// Maximum number of trials.
    pub const MAX_TRIALS: u32 = 10_000_000;

    fn check(&self, layers: usize) -> Result<(), ToleranceError> {
        if !(self.relative_sigma > 0.0 && self.relative_sigma <= 1.0) {
            return Err(ToleranceError::Sigma(self.relative_sigma));
        }
        if !(1..=Self::MAX_TRIALS).contains(&self.trials) {
            return Err(ToleranceError::Trials(self.trials));
        }
        if layers == 0 {
            return Err(ToleranceError::NoLayers);
        }
        Ok(())
    }

    /// Draws the thicknesses of a trial: each is d (1 + σ z) with its own normal z, and at least 0.
    fn drawn(&self, trial: u32, thicknesses_nm: &[f64]) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(u64::from(trial));
        let error = |&nm: &f64| {
            let z: f64 = StandardNormal.sample(&mut random);
            (nm * (1.0 + self.relative_sigma * z)).max(0.0)
        };
        thicknesses_nm.iter().map(error).collect()
    }
}

/// Maximum number of thicknesses in memory at a time.
const MAX_THICKNESSES: usize = 1 << 16;

/// Draws stacks with wrong thicknesses and evaluates their colors.
///
/// # Errors
/// If the tolerance makes no sense.
///
/// # Panics
/// If there is not one thickness per layer.
pub fn tolerance(
    stack: &StackColor,
    thicknesses_nm: &[f64],
    angle: Angle,
    tolerance: Tolerance,
) -> Result<Spread, ToleranceError> {
    tolerance.check(thicknesses_nm.len())?;
    let nominal = stack.at(thicknesses_nm, angle);
    let drawn = |trial: u32| tolerance.drawn(trial, thicknesses_nm);
    let all = scatter(stack, &nominal, angle, tolerance.trials, drawn);
    let mean = stack.color(all.mean);
    let alone = (0..thicknesses_nm.len()).map(|layer| {
        let one_wrong = |trial: u32| {
            let mut thicknesses = thicknesses_nm.to_vec();
            thicknesses[layer] = drawn(trial)[layer];
            thicknesses
        };
        let trials = tolerance.trials.min(Tolerance::ALONE);
        scatter(stack, &nominal, angle, trials, one_wrong).quantiles
    });
    Ok(Spread {
        nominal,
        mean,
        mean_delta_e: delta_e_2000(nominal.lab(), mean.lab()),
        all: all.quantiles,
        alone: alone.collect(),
    })
}

/// Results of the trials.
struct Scatter {
    /// The mean of their XYZ.
    mean: [f64; 3],
    quantiles: Quantiles,
}

/// Evaluates trials part by part and keeps only their color differences.
fn scatter(
    stack: &StackColor,
    nominal: &Color,
    angle: Angle,
    trials: u32,
    drawn: impl Fn(u32) -> Vec<f64>,
) -> Scatter {
    let lab = nominal.lab();
    let mut mean = [0.0; 3];
    let mut differences = Vec::with_capacity(trials as usize);
    for part in parts(trials, stack.sampled().layers().len()) {
        let sets: Vec<Vec<f64>> = part.map(&drawn).collect();
        for xyz in stack.xyz_of_all(&sets, &[angle]) {
            mean = std::array::from_fn(|i| mean[i] + xyz[i] / f64::from(trials));
            differences.push(delta_e_2000(lab, Lab::from_xyz(xyz, nominal.white)));
        }
    }
    Scatter {
        mean,
        quantiles: quantiles(differences),
    }
}

/// Divides the trials into parts whose thicknesses fit in memory together.
fn parts(trials: u32, layers: usize) -> impl Iterator<Item = std::ops::Range<u32>> {
    let step = (MAX_THICKNESSES / layers.max(1)).clamp(1, 1024);
    (0..trials)
        .step_by(step)
        .map(move |first| first..trials.min(first.saturating_add(step as u32)))
}

/// Quantiles by the nearest rank: the smallest difference that at least this fraction of the trials does not exceed.
fn quantiles(mut differences: Vec<f64>) -> Quantiles {
    differences.sort_by(f64::total_cmp);
    let at = |percent: usize| {
        let rank = (percent * differences.len()).div_ceil(100);
        differences[rank.saturating_sub(1)]
    };
    Quantiles {
        p50: at(50),
        p90: at(90),
        p95: at(95),
        p99: at(99),
        max: at(100),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Stack, View, sensitivity};

    fn color(line: &str) -> (StackColor, Vec<f64>) {
        let stack = Stack::parse(line).unwrap();
        let light = Light::named("D65").unwrap();
        let color = StackColor::new(&stack, light, View::default()).unwrap();
        (color, stack.thicknesses_nm().to_vec())
    }

    const SMALL: Tolerance = Tolerance {
        relative_sigma: 1e-4,
        trials: 2000,
        seed: 1,
    };

    /// With a small error of one thickness, ΔE is |z| σ d dE/dd, which has the quantiles of a folded normal distribution:
    /// 0.674, 1.645, 1.960 and 2.576 standard deviations.
    #[test]
    fn small_errors_scatter_as_the_derivative_says() {
        let (color, thicknesses) = color("1 | silica 300nm | silicon");
        let spread = tolerance(&color, &thicknesses, Angle::NORMAL, SMALL).unwrap();
        let rate = sensitivity(&color, &thicknesses, Angle::NORMAL).layers[0].delta_e_per_nm;
        let deviation = rate * SMALL.relative_sigma * thicknesses[0];
        let found = spread.all;
        for (found, expected) in [
            (found.p50, 0.674),
            (found.p90, 1.645),
            (found.p95, 1.960),
            (found.p99, 2.576),
        ] {
            // The standard error of these quantiles at 2000 trials is up to 5 %.
            assert!(
                (found / (expected * deviation) - 1.0).abs() < 0.1,
                "{found} {expected}"
            );
        }
        assert!(found.max >= found.p99 && spread.alone == [found]);
        assert!(spread.mean_delta_e < 0.1 * found.p50);
    }

    #[test]
    fn the_same_seed_draws_the_same_and_the_worst_layer_is_named() {
        let (color, thicknesses) = color("1 | 2.4 60nm | 1.46 90nm | 2.4 0.5nm | 1.52");
        let draw = |seed| {
            let few = Tolerance {
                trials: 200,
                seed,
                relative_sigma: 0.02,
            };
            tolerance(&color, &thicknesses, Angle::NORMAL, few).unwrap()
        };
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1).all, draw(2).all);
        let spread = draw(1);
        assert_ne!(
            spread.worst_layer(),
            Some(2),
            "half a nanometer matters least: {spread:?}"
        );
    }

    /// Every trial is evaluated once, however many there are, and never more at a time than fit in memory.
    #[test]
    fn memory_does_not_grow_with_trials_and_layers() {
        for (trials, layers) in [(1, 1), (1024, 1), (1025, 3), (100_001, 65), (9, 1 << 20)] {
            let mut next = 0;
            for part in parts(trials, layers) {
                assert!(part.start == next && part.end > next, "{part:?}");
                assert!(part.len() == 1 || part.len() * layers <= MAX_THICKNESSES);
                next = part.end;
            }
            assert_eq!(next, trials);
        }
    }

    /// The mean over several parts equals the mean over all trials.
    #[test]
    fn parts_make_up_the_whole() {
        let (color, thicknesses) = color("1 | 1.9 120nm | silicon");
        let found = tolerance(&color, &thicknesses, Angle::NORMAL, SMALL).unwrap();
        let drawn = (0..SMALL.trials).map(|trial| SMALL.drawn(trial, &thicknesses));
        let all = color.xyz_of_all(&drawn.collect::<Vec<_>>(), &[Angle::NORMAL]);
        for i in 0..3 {
            let mean = all.iter().map(|xyz| xyz[i]).sum::<f64>() / f64::from(SMALL.trials);
            assert!((found.mean.xyz[i] - mean).abs() < 1e-12);
        }
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let (color, thicknesses) = color("1 | 1.5 60nm | 1.52");
        let refused = |asked| tolerance(&color, &thicknesses, Angle::NORMAL, asked).unwrap_err();
        for relative_sigma in [0.0, -0.1, 1.5, f64::NAN] {
            let asked = Tolerance {
                relative_sigma,
                ..SMALL
            };
            assert!(matches!(refused(asked), ToleranceError::Sigma(_)));
        }
        let none = Tolerance { trials: 0, ..SMALL };
        assert_eq!(refused(none), ToleranceError::Trials(0));
        let bare = super::tests::color("1 | 1.5").0;
        assert_eq!(
            tolerance(&bare, &[], Angle::NORMAL, SMALL),
            Err(ToleranceError::NoLayers)
        );
    }
}
