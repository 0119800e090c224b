//! Which tiles of a picture get more samples than others.
//!
//! A pilot with another seed decides, and its samples do not count. So the number of samples of a pixel does not depend on their
//! values, and the mean stays unbiased (a rule that looks at the samples that it counts is biased: Kirk and Arvo, Unbiased sampling
//! techniques for image synthesis, SIGGRAPH 1991).

use spectra::{Accumulation, Window, variance_of_mean};

/// Side of a tile in pixels.
const TILE: u32 = 16;
/// A tile gets at least this fraction of the mean number of samples, whatever a pilot of a few samples has missed,
const LEAST: f64 = 0.25;
/// and at most this multiple.
const MOST: f64 = 8.0;
/// Dark pixels count relative to this fraction of the picture's mean.
const FLOOR: f64 = 0.05;

/// Samples per pixel of the pilot for this number of samples: an eighth, from 4 to 32.
pub fn pilot_samples(samples: u32) -> u32 {
    (samples / 8).clamp(4, 32)
}

/// The seed of the pilot of a render with this seed.
pub fn pilot_seed(seed: u32) -> u32 {
    seed ^ 0x5eed_9110
}

/// The tiles of a window, row by row.
pub(crate) fn tiles(window: Window) -> impl Iterator<Item = Window> {
    let [columns, rows] = window.size.map(|pixels| pixels.div_ceil(TILE));
    let corners = (0..rows).flat_map(move |y| (0..columns).map(move |x| [x, y]));
    corners.map(move |corner| Window {
        origin: [0, 1].map(|i| window.origin[i] + corner[i] * TILE),
        size: [0, 1].map(|i| TILE.min(window.size[i] - corner[i] * TILE)),
    })
}

/// Decides from a pilot how many samples the pixels of each tile get, `samples` in the mean over the picture.
///
/// The sum over tiles of the relative variance is smallest, at a given number of samples, if a tile's samples are proportional to the root of
/// its variance (Neyman, On the two different aspects of the representative method, 1934).
pub fn plan(pilot: &Accumulation, samples: u32) -> Vec<u32> {
    let window = pilot.window();
    let floor = FLOOR * mean(pilot, window);
    let noise: Vec<f64> = tiles(window)
        .map(|tile| deviation(pilot, tile, floor))
        .collect();
    let pixels: Vec<f64> = tiles(window).map(|tile| tile.pixels() as f64).collect();
    let mean = f64::from(samples);
    let bounded = |wanted: f64| wanted.clamp((LEAST * mean).max(1.0), MOST * mean);
    let budget = mean * pixels.iter().sum::<f64>();
    let spent = |factor: f64| {
        let each = noise.iter().zip(&pixels);
        each.map(|(noise, pixels)| pixels * bounded(factor * noise))
            .sum::<f64>()
    };
    let factor = bisected(|factor| spent(factor) < budget);
    noise
        .iter()
        .map(|noise| bounded(factor * noise).round() as u32)
        .collect()
}

/// The factor at which a condition that holds for small ones fails, to 2⁻⁵² of it.
fn bisected(is_small: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (-100.0_f64, 100.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if is_small(middle.exp2()) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low.exp2()
}

fn indices(of: &Accumulation, window: Window) -> impl Iterator<Item = usize> {
    of.row_indices(window).flatten()
}

/// The mean radiance of the pixels of a window.
fn mean(of: &Accumulation, window: Window) -> f64 {
    let each = indices(of, window).map(|pixel| mean_of_pixel(of, pixel));
    each.sum::<f64>() / window.pixels() as f64
}

fn mean_of_pixel(of: &Accumulation, pixel: usize) -> f64 {
    let values = &of.pixel(pixel)[of.layout().mean()];
    values.iter().sum::<f64>() / values.len() as f64
}

/// The root mean square, over the pixels of a tile, of the relative standard error.
fn deviation(of: &Accumulation, tile: Window, floor: f64) -> f64 {
    let relative = |pixel: usize| {
        let squares = &of.pixel(pixel)[of.layout().deviation()];
        let squares = squares.iter().sum::<f64>() / squares.len() as f64;
        let mean = mean_of_pixel(of, pixel);
        match mean * mean + floor * floor {
            0.0 => 0.0,
            scale => squares * variance_of_mean(of.counts()[pixel]) / scale,
        }
    };
    (indices(of, tile).map(relative).sum::<f64>() / tile.pixels() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::{BandGrid, LightGroup};

    /// A pilot of 40×16 pixels, whose tiles have this noise.
    fn pilot(noise: [f64; 3]) -> Accumulation {
        let groups = vec![LightGroup::unknown()];
        let bands = BandGrid::visible(2).unwrap();
        let mut all = Accumulation::new(Window::whole([40, 16]), 0, bands, groups, false);
        let layout = all.layout();
        for (tile, noise) in tiles(all.window()).zip(noise).collect::<Vec<_>>() {
            let mut values = vec![0.0; layout.len()];
            values[layout.mean()].fill(2.0);
            values[layout.deviation()].fill(12.0 * (2.0 * noise).powi(2));
            all.store(tile, &values.repeat(tile.pixels()), 4);
        }
        all
    }

    #[test]
    fn samples_follow_the_noise_and_keep_the_budget() {
        let found = plan(&pilot([1.0, 2.0, 4.0]), 64);
        // 16×16, 16×16 and 8×16 pixels, so 2 a + 2·2a + 4a = 5·64.
        assert_eq!(found, [32, 64, 128]);
        // The noisiest gets what the least numbers of the others leave: 16, 16 and (5·64 − 2·16 − 2·16).
        assert_eq!(plan(&pilot([0.0, 1.0, 1000.0]), 64), [16, 16, 256]);
        assert_eq!(plan(&pilot([0.0; 3]), 64), [16; 3], "nothing to gain");
        assert_eq!(plan(&pilot([1.0; 3]), 1), [1; 3]);
    }

    #[test]
    fn a_pilot_is_a_fraction() {
        assert_eq!([1, 64, 100_000].map(pilot_samples), [4, 8, 32]);
    }
}
