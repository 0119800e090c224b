//! The division of the picture: tiles within the adapter's limits, batches under half a second.

use spectra::Window;
use std::time::Duration;

/// Width of the widest tile, pixels.
const WIDTH: u32 = 512;
/// Maximum number of pixels of a tile: enough to fill any GPU.
const MAX_PIXELS: u32 = WIDTH * 512;
/// Rows of the first tile, before the speed is known: 8192 pixels take a tenth of a second on a slow software driver.
const FIRST_ROWS: u32 = 16;
/// Maximum number of passes of loops of an invocation in a batch: llvmpipe silently ends all loops of an invocation after 65535.
const MAX_PASSES: u64 = 60_000;
/// Target time of a batch.
const TARGET: Duration = Duration::from_millis(200);

/// A division of a picture among dispatches that replaces the one by measured times. The rendered picture does not depend on it,
/// and a test renders the same picture with several divisions to prove that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// Rows of a tile, at least 1.
    pub rows: u32,
    /// Samples of a batch, at least 1.
    pub samples: u32,
}

/// Hands out the tiles of a window, column by column, and adapts their height and the number of samples of a batch to the time that batches took.
/// The sum of a pixel's samples does not depend on either.
#[derive(Debug)]
pub(crate) struct Planner {
    window: Window,
    /// The place of the next tile in the window.
    next: [u32; 2],
    /// Width of the widest tile.
    width: u32,
    max_rows: u32,
    max_samples: u32,
    rows: u32,
    target: Duration,
    fixed: Option<Division>,
    last_batch: u32,
    seconds_per_sample: Option<f64>,
}

impl Planner {
    /// `bytes_per_pixel` is the size of one pixel in the largest buffer, `max_bytes` the maximum size of that buffer,
    /// `passes_per_sample` the maximum number of passes of loops in a sample. `caution` 1 asks for tiles and batches of a quarter of
    /// the usual size, 2 for a sixteenth, and so on.
    pub(crate) fn new(
        image: [u32; 2],
        (bytes_per_pixel, max_bytes): (u64, u64),
        passes_per_sample: u64,
        (fixed, caution): (Option<Division>, u32),
    ) -> Self {
        let width = image[0].min(WIDTH);
        let by_memory = (max_bytes / bytes_per_pixel).min(u64::from(MAX_PIXELS)) as u32;
        let less = 4_u32.saturating_pow(caution);
        let max_rows = (by_memory / less / width).clamp(1, image[1]);
        Self {
            window: Window::whole([0, 0]),
            next: [0, 0],
            width,
            max_rows,
            max_samples: (MAX_PASSES / passes_per_sample.max(1)).max(1) as u32,
            rows: fixed
                .map_or(FIRST_ROWS, |fixed| fixed.rows)
                .clamp(1, max_rows),
            target: TARGET / less,
            fixed,
            last_batch: 0,
            seconds_per_sample: None,
        }
    }

    /// Returns the number of pixels of the largest tile that will be handed out.
    pub(crate) fn max_pixels(&self) -> u32 {
        self.width * self.max_rows
    }

    /// Begins with a window. What was learned of others is kept.
    pub(crate) fn begin(&mut self, window: Window) {
        self.window = window;
        self.next = [0, 0];
    }

    /// Returns the next tile, or `None` when the window is covered.
    pub(crate) fn next_tile(&mut self) -> Option<Window> {
        let ([x, y], all) = (self.next, self.window);
        if x >= all.size[0] || y >= all.size[1] {
            return None;
        }
        let tile = Window {
            origin: [all.origin[0] + x, all.origin[1] + y],
            size: [
                self.width.min(all.size[0] - x),
                self.rows.min(all.size[1] - y),
            ],
        };
        self.last_batch = 0;
        let below = y + tile.size[1];
        self.next = if below < all.size[1] {
            [x, below]
        } else {
            [x + tile.size[0], 0]
        };
        Some(tile)
    }

    /// Says that earlier rounds took this many samples of the tile, so that its cost is no surprise.
    pub(crate) fn goes_on(&mut self, taken: u32) {
        self.last_batch = taken;
    }

    /// Returns how many samples the next batch of a tile takes, out of `left`: one at first, then at most four times as many as
    /// before, because the next tile may cost many times as much as this one.
    pub(crate) fn batch(&mut self, tile: Window, left: u32) -> u32 {
        if let Some(fixed) = self.fixed {
            return fixed.samples.clamp(1, left);
        }
        let fitting = self.seconds_per_sample.map_or(1.0, |seconds| {
            let per_pass = seconds * tile.pixels() as f64;
            self.target.as_secs_f64() / per_pass.max(1e-9)
        });
        let bounded = fitting.min(4.0 * f64::from(self.last_batch)).max(1.0);
        self.last_batch = (bounded as u32).min(self.max_samples).min(left);
        self.last_batch
    }

    /// Updates the measured speed after a batch. Tiles grow while a single sample of all their pixels is far below the target, and
    /// shrink above it.
    pub(crate) fn learn(&mut self, tile: Window, samples: u32, took: Duration) {
        if self.fixed.is_some() {
            return;
        }
        let measured = took.as_secs_f64() / (tile.pixels() as f64 * f64::from(samples));
        self.seconds_per_sample = Some(match self.seconds_per_sample {
            // A slowdown takes effect at once, a speedup gradually.
            Some(before) if measured < before => 0.5 * (before + measured),
            _ => measured,
        });
        let pass = measured * f64::from(self.width) * f64::from(self.rows);
        if pass > self.target.as_secs_f64() {
            self.rows = (self.rows / 2).max(1);
        } else if pass < 0.25 * self.target.as_secs_f64() {
            self.rows = (self.rows * 2).min(self.max_rows);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A planner with buffers of 128 MiB, at the beginning of a picture.
    fn planner(image: [u32; 2], bytes_per_pixel: u64, passes: u64) -> Planner {
        let mut planner = Planner::new(image, (bytes_per_pixel, 128 << 20), passes, (None, 0));
        planner.begin(Window::whole(image));
        planner
    }

    #[test]
    fn caution_makes_tiles_and_batches_smaller() {
        let sizes = [0, 1, 2, 20].map(|caution| {
            let sizes = (160, 128 << 20);
            Planner::new([512, 512], sizes, 1, (None, caution)).max_pixels()
        });
        assert_eq!(sizes, [512 * 512, 512 * 128, 512 * 32, 512]);
        let mut careful = Planner::new([512, 64], (160, 128 << 20), 1, (None, 1));
        careful.begin(Window::whole([512, 64]));
        let tile = careful.next_tile().unwrap();
        assert_eq!(careful.batch(tile, 1000), 1);
        careful.learn(tile, 1, Duration::from_millis(10));
        assert_eq!(careful.batch(tile, 1000), 4);
        careful.learn(tile, 4, Duration::from_millis(40));
        assert_eq!(careful.batch(tile, 1000), 5, "the target is 50 ms");
    }

    #[test]
    fn tiles_cover_every_pixel_once_whatever_the_times() {
        let image = [1300, 700];
        let mut planner = planner(image, 160, 1);
        let mut covered = vec![0; (image[0] * image[1]) as usize];
        let mut slow = true;
        while let Some(tile) = planner.next_tile() {
            assert!(tile.pixels() <= planner.max_pixels() as usize);
            for y in tile.origin[1]..tile.origin[1] + tile.size[1] {
                for x in tile.origin[0]..tile.origin[0] + tile.size[0] {
                    covered[(y * image[0] + x) as usize] += 1;
                }
            }
            planner.learn(tile, 1, Duration::from_millis(if slow { 900 } else { 3 }));
            slow = !slow;
        }
        assert!(covered.iter().all(|&count| count == 1));
    }

    #[test]
    fn a_tile_stays_within_the_buffer() {
        // 256 bands, 128 MiB.
        let planner = planner([16384, 16384], 1024, 1);
        assert!(u64::from(planner.max_pixels()) * 1024 <= 128 << 20);
        assert!(planner.max_pixels() > 100_000);
    }

    #[test]
    fn batches_grow_by_and_by_and_react_at_once() {
        let mut planner = planner([512, 64], 160, 1);
        let tile = planner.next_tile().unwrap();
        let ms = Duration::from_millis;
        assert_eq!(planner.batch(tile, 1000), 1);
        planner.learn(tile, 1, ms(10));
        assert_eq!(planner.batch(tile, 1000), 4);
        planner.learn(tile, 4, ms(40));
        assert_eq!(planner.batch(tile, 7), 7);
        planner.learn(tile, 7, ms(70));
        assert_eq!(planner.batch(tile, 1000), 20, "the target is 200 ms");
        // A tile that goes on begins at the target, too.
        planner.goes_on(20);
        assert_eq!(planner.batch(tile, 1000), 20);
        // Twenty times slower: the next batch is back at the target.
        planner.learn(tile, 20, ms(4000));
        assert_eq!(planner.batch(tile, 1000), 1);
    }

    #[test]
    fn a_batch_ends_before_the_driver_ends_its_loops() {
        for (passes, most) in [(700, 85), (60_001, 1)] {
            let mut planner = planner([8, 8], 160, passes);
            let tile = planner.next_tile().unwrap();
            let mut largest = 0;
            for _ in 0..20 {
                let samples = planner.batch(tile, 1 << 20);
                planner.learn(tile, samples, Duration::from_micros(1));
                largest = largest.max(samples);
            }
            assert_eq!(largest, most);
        }
    }
}
