//! The estimate against the noise of pixels whose samples are known.

use super::*;

const PIXELS: usize = 1500;
const BANDS: usize = 3;
const SEEDS: u32 = 40;

/// Uniform in [0, 1).
fn uniform(key: [u32; 3]) -> f64 {
    let [a, b, c] = key.map(u64::from);
    (hash(hash(hash(a) ^ b) ^ c) >> 11) as f64 / 2_f64.powi(53)
}

/// Owen's nested scrambling of a number by hashing: each bit is flipped by a hash of those above it (Laine and Karras, Comput. Graph.
/// Forum 30, 2011, with the steps of Vegdahl, 2021).
fn scrambled(x: u32, key: [u32; 2]) -> u32 {
    let seed = (hash(hash(u64::from(key[0])) ^ u64::from(key[1])) >> 32) as u32;
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// A point of the first two dimensions of Sobol's sequence, in a random order and scrambled.
fn point(pixel: u32, sample: u32, seed: u32) -> [f64; 2] {
    let key = |lane: u32| [pixel, (seed << 2) | lane];
    let mut index = scrambled(sample, key(0));
    let (mut second, mut direction) = (0_u32, 1_u32 << 31);
    let first = index.reverse_bits();
    while index > 0 {
        second ^= if index & 1 == 1 { direction } else { 0 };
        direction ^= direction >> 1;
        index >>= 1;
    }
    let scrambled = [scrambled(first, key(1)), scrambled(second, key(2))];
    scrambled.map(|x| f64::from(x) / 2_f64.powi(32))
}

/// What a sample of a pixel is worth: an integrand with its own parameters in each pixel, at points which are chosen by seed.
type Sample = fn(u32, u32, u32) -> f64;

/// Independent samples with the standard deviation 1 / √12 about 1.
fn independent(pixel: u32, sample: u32, seed: u32) -> f64 {
    0.5 + uniform([pixel, sample, seed])
}

/// An edge in one dimension: V ~ n⁻².
fn step(pixel: u32, sample: u32, seed: u32) -> f64 {
    let place = uniform([pixel, 1, 2]);
    1.0 + f64::from(point(pixel, sample, seed)[0] < place)
}

/// An edge across two dimensions: V ~ n^−1.5.
fn edge(pixel: u32, sample: u32, seed: u32) -> f64 {
    let [x, y] = point(pixel, sample, seed);
    let [place, slope] = [3, 4].map(|which| 0.3 + 0.7 * uniform([pixel, which, 5]));
    1.0 + f64::from(x + slope * y < place)
}

/// A smooth function of one dimension: V ~ n⁻³.
fn smooth(pixel: u32, sample: u32, seed: u32) -> f64 {
    let slope = 0.5 + uniform([pixel, 6, 7]);
    1.0 + slope * point(pixel, sample, seed)[0].powi(2)
}

/// The state of a pixel after so many samples: its mean, and the variance of it as if they were independent.
#[derive(Clone, Copy, Default)]
struct Welford {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Welford {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.squares += before * (value - self.mean);
    }

    fn variance(&self) -> f64 {
        self.squares / (self.count * (self.count - 1.0).max(1.0))
    }
}

/// Band factors: bands of a pixel rise and fall together.
const BAND: [f64; BANDS] = [0.5, 1.0, 1.5];

/// An estimator that has seen the powers of two up to a number of samples, and that number.
fn watching(sample: Sample, samples: u32, seed: u32) -> (NoiseEstimator, Vec<Welford>) {
    let mut estimator = NoiseEstimator::new(PIXELS, BANDS);
    let mut pixels = vec![Welford::default(); PIXELS];
    for n in 0..samples {
        for (i, pixel) in (0..).zip(&mut pixels) {
            pixel.add(sample(i, n, seed));
        }
        if (n + 1).is_power_of_two() || n + 1 == samples {
            record(&mut estimator, n + 1, &pixels);
        }
    }
    (estimator, pixels)
}

fn record(estimator: &mut NoiseEstimator, samples: u32, pixels: &[Welford]) {
    estimator.record(samples, &mut |pixel, mean, variance| {
        for (band, factor) in BAND.iter().enumerate() {
            mean[band] = factor * pixels[pixel].mean;
            variance[band] = factor * factor * pixels[pixel].variance();
        }
    });
}

/// √(mean of squares) / mean of the band factors.
fn of_bands() -> f64 {
    let squares: f64 = BAND.iter().map(|factor| factor * factor).sum();
    (squares / BANDS as f64).sqrt() / (BAND.iter().sum::<f64>() / BANDS as f64)
}

/// The noise over many seeds at each of some numbers of samples.
fn measured(sample: Sample, counts: &[u32]) -> Vec<f64> {
    let mut noises = vec![Vec::new(); counts.len()];
    for pixel in 0..PIXELS as u32 {
        let mut seeds = vec![Welford::default(); counts.len()];
        for seed in 100..100 + SEEDS {
            let mut sum = 0.0;
            for n in 0..counts[counts.len() - 1] {
                sum += sample(pixel, n, seed);
                if let Some(place) = counts.iter().position(|&count| count == n + 1) {
                    seeds[place].add(sum / f64::from(n + 1));
                }
            }
        }
        for (noises, seeds) in noises.iter_mut().zip(seeds) {
            let deviation = (seeds.squares / (seeds.count - 1.0)).sqrt();
            noises.push(of_bands() * deviation / seeds.mean);
        }
    }
    let medians = noises.into_iter().map(median);
    medians.collect::<Option<_>>().unwrap()
}

#[test]
fn independent_noise_is_found() {
    for samples in [16, 20, 48, 64, 112, 128] {
        let known = of_bands() / (12.0 * f64::from(samples)).sqrt();
        let (estimator, _) = watching(independent, samples, 3);
        let found = estimator.noise().unwrap() / known;
        assert!((found - 1.0).abs() < 0.1, "{samples} samples: {found}");
    }
}

/// At any number of samples, where the samples' own variance is far from it.
#[test]
fn noise_of_scrambled_nets_is_found() {
    let counts = [16, 32, 40, 48, 56, 64];
    for (name, sample) in [("step", step as Sample), ("edge", edge), ("smooth", smooth)] {
        for (samples, noise) in counts.into_iter().zip(measured(sample, &counts)) {
            let (estimator, pixels) = watching(sample, samples, 7);
            let of_independent =
                |pixel: &Welford| of_bands() * pixel.variance().sqrt() / pixel.mean;
            let naive = median(pixels.iter().map(of_independent).collect()).unwrap() / noise;
            let found = estimator.noise().unwrap() / noise;
            assert!((found - 1.0).abs() < 0.2, "{name}, {samples}: {found}");
            assert!(naive > 1.5, "{name}, {samples}: {naive}");
        }
    }
}

/// Squared steps are V(n) − V(2n) for points that are far from independent, with no law assumed.
#[test]
fn steps_are_differences_of_variances() {
    for samples in [4, 8, 16] {
        let (mut square, mut variances) = (0.0, [0.0; 2]);
        for pixel in 0..PIXELS as u32 {
            let mut seeds = [Welford::default(); 2];
            for seed in 0..SEEDS {
                let mean = |count: u32| {
                    let sum: f64 = (0..count).map(|n| edge(pixel, n, seed)).sum();
                    sum / f64::from(count)
                };
                let means = [mean(samples), mean(2 * samples)];
                square += (means[0] - means[1]).powi(2) / f64::from(SEEDS);
                seeds[0].add(means[0]);
                seeds[1].add(means[1]);
            }
            for (sum, of_seeds) in variances.iter_mut().zip(seeds) {
                *sum += of_seeds.squares / (of_seeds.count - 1.0);
            }
        }
        let ratio = square / (variances[0] - variances[1]);
        assert!((ratio - 1.0).abs() < 0.05, "{samples}: {ratio}");
    }
}

#[test]
fn a_checkpoint_continues_exactly() {
    let (_, pixels) = watching(edge, 64, 1);
    for samples in [0, 1, 7, 48, 64] {
        let (mut before, _) = watching(edge, samples, 1);
        let bytes = before.to_bytes();
        let mut after = NoiseEstimator::from_bytes(PIXELS, BANDS, &bytes).unwrap();
        assert_eq!(after, before);
        for estimator in [&mut before, &mut after] {
            record(estimator, 128, &pixels);
        }
        assert_eq!(after.noise(), before.noise());
        assert_eq!(after.next_stop(0.01), before.next_stop(0.01));
        let foreign = [
            NoiseEstimator::from_bytes(PIXELS + 1, BANDS, &bytes),
            NoiseEstimator::from_bytes(PIXELS, BANDS + 1, &bytes),
            NoiseEstimator::from_bytes(PIXELS, BANDS, &bytes[1..]),
            NoiseEstimator::from_bytes(PIXELS, BANDS, &bytes[..bytes.len() - 1]),
            NoiseEstimator::from_bytes(PIXELS, BANDS, &[&bytes[..], &[0]].concat()),
            NoiseEstimator::from_bytes(PIXELS, BANDS, &[]),
        ];
        assert_eq!(foreign, [const { None }; 6]);
    }
}

#[test]
fn damaged_counts_are_refused() {
    let (estimator, _) = watching(edge, 24, 1);
    let bytes = estimator.to_bytes();
    // The last power of two is not one, is above the samples, or has fewer steps to it; more steps than are
    // kept; a number that is none.
    for (place, value) in [
        (20, 3),
        (20, 32),
        (20, 8),
        (24, 5),
        (24, 2),
        (28, f32::NAN.to_bits()),
    ] {
        let mut damaged = bytes.clone();
        damaged[place..place + 4].copy_from_slice(&value.to_le_bytes());
        let found = NoiseEstimator::from_bytes(PIXELS, BANDS, &damaged);
        assert_eq!(found, None, "{value} at {place}");
    }
}

#[test]
fn stops_are_at_quarters_of_an_octave() {
    assert_eq!(NoiseEstimator::new(9, 1).next_stop(0.1), 1);
    for (samples, first) in [
        (1, 2),
        (2, 3),
        (4, 5),
        (64, 80),
        (80, 96),
        (100, 112),
        (112, 128),
    ] {
        let (estimator, _) = watching(independent, samples, 1);
        let stops = [f64::INFINITY, 0.0].map(|target| estimator.next_stop(target));
        let next = (samples + 1).next_power_of_two();
        let first = if samples == 1 { next } else { first };
        assert_eq!(stops, [first, next], "{samples}");
    }
    // Independent samples: a target 20 % lower needs 1.56 times the samples.
    let (estimator, _) = watching(independent, 64, 1);
    assert_eq!(estimator.next_stop(0.8 * estimator.noise().unwrap()), 112);
}

#[test]
fn pixels_without_light_do_not_count() {
    let mut estimator = NoiseEstimator::new(100, 1);
    assert_eq!(estimator.noise(), None);
    let mut record = |samples: u32, light: f64| {
        estimator.record(samples, &mut |pixel, mean, variance| {
            let is_lit = pixel % 4 == 0;
            mean[0] = if is_lit { light } else { 0.0 };
            variance[0] = if is_lit { light * light / 16.0 } else { 0.0 };
        });
        estimator.noise()
    };
    assert_eq!(record(1, 1.0), None);
    assert_eq!(record(2, 0.0), None);
    assert_eq!(record(3, 2.0), Some(0.25));
    assert_eq!(record(3, 1e9), Some(0.25), "nothing new");
    // Without noise, and with values that are none.
    assert_eq!(record(4, f64::INFINITY), None);
    assert_eq!(NoiseEstimator::new(0, 0).noise(), None);
}

#[test]
fn watched_pixels_are_spread_in_runs() {
    assert_eq!(watched(5), [0, 1, 2, 3, 4]);
    for pixels in [8192, 8193, 8199, 10_000, 307_200, 1 << 30] {
        let found = watched(pixels);
        assert_eq!(found.len(), MOST_WATCHED);
        assert!(found.is_sorted_by(|a, b| a < b) && found[MOST_WATCHED - 1] < pixels);
        let mut runs = found.chunks(RUN);
        assert!(runs.all(|run| run[RUN - 1] == run[0] + RUN - 1));
        let parts = (0..4).map(|i| {
            let part = i * pixels / 4..(i + 1) * pixels / 4;
            found.iter().filter(|i| part.contains(i)).count()
        });
        for count in parts {
            assert!(
                count.abs_diff(MOST_WATCHED / 4) <= 4 * RUN,
                "{pixels}: {count}"
            );
        }
    }
}
