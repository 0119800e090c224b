//! Convolution of a picture with an even kernel, with the picture mirrored at its edges.
//!
//! Nothing is known about the scene outside a picture. Mirroring at the edges keeps the sum of the values and leaves a uniform
//! picture uniform. The Fourier transform of a mirrored picture is its cosine transform, of the same size and real, and so is that
//! of an even kernel: if X is the transform of kind II of the picture and K the transform of kind I of the kernel's quadrant, the
//! transform of the convolved picture is K X (S. A. Martucci, Symmetric convolution and the discrete sine and cosine transforms,
//! IEEE Trans. Signal Process. 42, 1038 (1994)).
//!
//! Arithmetic is `f64`: the rounding error of a transform spreads over the whole picture, in proportion to its brightest lamp.

use rayon::prelude::*;
use rustdct::{Dct1, DctPlanner, TransformType2And3};
use std::sync::Arc;

/// The transforms for pictures of one size.
pub(super) struct Mirror {
    width: usize,
    height: usize,
    pictures: [Arc<dyn TransformType2And3<f64>>; 2],
    kernels: [Arc<dyn Dct1<f64>>; 2],
}

/// A cosine transform: `width` columns of `height` values.
pub(super) type Spectrum = Vec<f64>;

impl Mirror {
    pub(super) fn new(width: usize, height: usize) -> Self {
        let mut planner = DctPlanner::new();
        Self {
            width,
            height,
            pictures: [planner.plan_dct2(width), planner.plan_dct2(height)],
            kernels: [width, height].map(|n| planner.plan_dct1(n + 1)),
        }
    }

    /// Returns the transform of a picture, given row by row.
    pub(super) fn of_picture(&self, mut picture: Vec<f64>) -> Spectrum {
        let [rows, columns] = &self.pictures;
        lines(&mut picture, self.width, |row| rows.process_dct2(row));
        let mut spectrum = transposed(&picture, self.width, self.height);
        lines(&mut spectrum, self.height, |column| {
            columns.process_dct2(column);
        });
        spectrum
    }

    /// Returns the picture of a transform.
    pub(super) fn picture(&self, mut spectrum: Spectrum) -> Vec<f64> {
        let [rows, columns] = &self.pictures;
        let scale = 4.0 / (self.width * self.height) as f64;
        lines(&mut spectrum, self.height, |column| {
            columns.process_dct3(column);
            scale_by(column, scale);
        });
        let mut picture = transposed(&spectrum, self.height, self.width);
        lines(&mut picture, self.width, |row| rows.process_dct3(row));
        picture
    }

    /// Returns the sum of a kernel, given as for [`Self::of_kernel`]; it equals the first value of the transform.
    pub(super) fn sum_of_kernel(&self, value: impl Fn(usize, usize) -> f64 + Sync) -> f64 {
        let times = |at: usize, size: usize| if at == 0 || at == size { 1.0 } else { 2.0 };
        let row = |y: usize| -> f64 {
            let values = (0..=self.width).map(|x| times(x, self.width) * value(x, y));
            times(y, self.height) * values.sum::<f64>()
        };
        let rows: Vec<f64> = (0..=self.height).into_par_iter().map(row).collect();
        rows.iter().sum()
    }

    /// Returns the transform of an even kernel, given by its values at each distance from 0 to the width and the height inclusive.
    /// The kernel reaches no further. Pixels one full width away, on either side, coincide and count once.
    pub(super) fn of_kernel(&self, value: impl Fn(usize, usize) -> f64 + Sync) -> Spectrum {
        let (width, height) = (self.width + 1, self.height + 1);
        let [rows, columns] = &self.kernels;
        let mut kernel = vec![0.0; width * height];
        kernel
            .par_chunks_mut(width)
            .enumerate()
            .for_each(|(y, row)| {
                for (x, out) in row.iter_mut().enumerate() {
                    *out = value(x, y);
                }
                rows.process_dct1(row);
            });
        let mut spectrum = transposed(&kernel, width, height);
        spectrum.truncate(self.width * height);
        lines(&mut spectrum, height, |column| {
            columns.process_dct1(column);
            scale_by(column, 4.0);
        });
        // Drop the highest frequency, which pictures do not have.
        let columns = spectrum.chunks_exact(height);
        columns
            .flat_map(|column| &column[..self.height])
            .copied()
            .collect()
    }
}

fn scale_by(values: &mut [f64], factor: f64) {
    for value in values {
        *value *= factor;
    }
}

/// Transforms every line of `length` values.
fn lines(values: &mut [f64], length: usize, transform: impl Fn(&mut [f64]) + Send + Sync) {
    values.par_chunks_mut(length).for_each(transform);
}

/// Returns rows of `width` values as columns.
fn transposed(values: &[f64], width: usize, height: usize) -> Vec<f64> {
    let mut columns = vec![0.0; values.len()];
    // Eight columns at a time use a whole cache line of each row.
    columns
        .par_chunks_mut(8 * height)
        .enumerate()
        .for_each(|(block, columns)| {
            for y in 0..height {
                for (i, column) in columns.chunks_exact_mut(height).enumerate() {
                    column[y] = values[y * width + 8 * block + i];
                }
            }
        });
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(seed: u32) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            f64::from(state >> 8) / f64::from(1 << 24)
        }
    }

    /// Index of the pixel at a position that may lie beyond the edges, by up to the size.
    fn mirrored(at: isize, size: usize) -> usize {
        let size = size as isize;
        let at = at.rem_euclid(2 * size);
        at.min(2 * size - 1 - at) as usize
    }

    #[test]
    fn it_is_the_direct_sum_with_mirrors() {
        for (width, height) in [(7, 5), (8, 6), (1, 9), (12, 1)] {
            let mut next = noise(3);
            let picture: Vec<f64> = (0..width * height).map(|_| next()).collect();
            let kernel: Vec<f64> = (0..(width + 1) * (height + 1)).map(|_| next()).collect();
            let value = |x: usize, y: usize| kernel[y * (width + 1) + x];

            let mirror = Mirror::new(width, height);
            let first = mirror.of_kernel(value)[0];
            assert!((mirror.sum_of_kernel(value) / first - 1.0).abs() < 1e-13);
            let mut spectrum = mirror.of_picture(picture.clone());
            for (v, k) in spectrum.iter_mut().zip(mirror.of_kernel(value)) {
                *v *= k;
            }
            let found = mirror.picture(spectrum);

            let (w, h) = (width as isize, height as isize);
            for y in 0..h {
                for x in 0..w {
                    let mut expected = 0.0;
                    for dy in 1 - h..=h {
                        for dx in 1 - w..=w {
                            let at = mirrored(y + dy, height) * width + mirrored(x + dx, width);
                            expected += value(dx.unsigned_abs(), dy.unsigned_abs()) * picture[at];
                        }
                    }
                    let found = found[(y * w + x) as usize];
                    assert!(
                        (found - expected).abs() < 1e-12 * expected,
                        "{found} {expected}"
                    );
                }
            }
        }
    }
}
