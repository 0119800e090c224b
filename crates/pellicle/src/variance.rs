//! The noise of a way of rendering, from renders that differ only in their seeds, and what a change of it gains.

use spectra::SpectralImage;

/// Variance of the values of a picture between renders with different seeds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeedVariance {
    /// For each value of the picture, the mean and the sum of squared differences from it (Welford 1962).
    values: Vec<(f64, f64)>,
    bands: usize,
    images: usize,
}

impl SeedVariance {
    /// Adds a render.
    ///
    /// # Panics
    /// If it does not have as many pixels and bands as those before it.
    pub fn add(&mut self, image: &SpectralImage) {
        let radiance = image.radiance();
        if self.images == 0 {
            self.bands = image.bands().count() as usize;
            self.values = vec![(0.0, 0.0); radiance.len()];
        }
        let found = (image.bands().count() as usize, radiance.len());
        assert_eq!(
            found,
            (self.bands, self.values.len()),
            "renders of one size"
        );
        self.images += 1;
        let count = self.images as f64;
        for ((mean, squares), &value) in self.values.iter_mut().zip(radiance) {
            let before = f64::from(value) - *mean;
            *mean += before / count;
            *squares += before * (f64::from(value) - *mean);
        }
    }

    /// Returns the mean variance of the bands of each pixel; 0 for a single render.
    pub fn of_pixels(&self) -> Vec<f64> {
        let pixels = self.values.chunks(self.bands.max(1));
        let degrees = (self.images.max(2) - 1) as f64;
        let of_pixel = |values: &[(f64, f64)]| {
            let sum: f64 = values.iter().map(|(_, squares)| squares).sum();
            sum / (degrees * values.len() as f64)
        };
        pixels.map(of_pixel).collect()
    }
}

/// What a change gains: the variance before it divided by that after it, so higher is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gain {
    /// Ratio of the mean variances.
    pub of_mean: f64,
    /// Median of the ratios per pixel, where there is noise after the change.
    pub median: f64,
}

impl Gain {
    /// Compares over the pixels that count; NaN if there are none.
    pub fn new(before: &SeedVariance, after: &SeedVariance, counts: &[bool]) -> Self {
        let pairs = before.of_pixels().into_iter().zip(after.of_pixels());
        let counted: Vec<(f64, f64)> = pairs
            .zip(counts)
            .filter_map(|(pair, &counts)| counts.then_some(pair))
            .collect();
        let (a, b) = counted
            .iter()
            .fold((0.0, 0.0), |sum, pair| (sum.0 + pair.0, sum.1 + pair.1));
        let noisy = counted.iter().filter(|pair| pair.1 > 0.0);
        let ratios: Vec<f64> = noisy.map(|(a, b)| a / b).collect();
        Self {
            of_mean: a / b,
            median: median(&ratios),
        }
    }
}

/// Returns the median, the upper of the two in the middle; NaN if there are no values.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::BandGrid;

    /// Renders of three pixels with two bands; each value of a pixel is its base plus or minus its deviation.
    fn renders(deviations: [f32; 3], signs: &[f32]) -> SeedVariance {
        let mut found = SeedVariance::default();
        for sign in signs {
            let mut image = SpectralImage::new(3, 1, BandGrid::visible(2).unwrap());
            for (x, deviation) in (0..).zip(deviations) {
                let radiance = [8.0 + sign * deviation, 4.0 - sign * deviation];
                image.set_pixel((x, 0), &radiance, &[0.0; 2], [0.0; 3], 1);
            }
            found.add(&image);
        }
        found
    }

    /// Values at ± d have the variance 2 d² for two renders, and 4 d² / 3 for four.
    #[test]
    fn the_variance_is_that_of_known_noise() {
        let two = renders([0.0, 1.0, 2.0], &[1.0, -1.0]).of_pixels();
        assert_eq!(two, [0.0, 2.0, 8.0]);
        let four = renders([0.0, 1.0, 2.0], &[1.0, -1.0, -1.0, 1.0]).of_pixels();
        for (found, expected) in four.into_iter().zip([0.0, 4.0 / 3.0, 16.0 / 3.0]) {
            assert!((found - expected).abs() < 1e-12, "{found}");
        }
        assert_eq!(renders([1.0; 3], &[1.0]).of_pixels(), [0.0; 3]);
        assert!(SeedVariance::default().of_pixels().is_empty());
    }

    #[test]
    fn a_gain_is_the_ratio_of_variances() {
        let before = renders([2.0, 2.0, 3.0], &[1.0, -1.0]);
        let after = renders([1.0, 2.0, 1.0], &[1.0, -1.0]);
        let all = Gain::new(&before, &after, &[true; 3]);
        assert!((all.of_mean - 17.0 / 6.0).abs() < 1e-12, "{all:?}");
        assert!((all.median - 4.0).abs() < 1e-12, "{all:?}");
        let one = Gain::new(&before, &after, &[false, true, false]);
        assert_eq!((one.of_mean, one.median), (1.0, 1.0));
        let none = Gain::new(&before, &after, &[false; 3]);
        assert!(none.of_mean.is_nan() && none.median.is_nan());
        // A pixel without noise has no ratio of its own.
        let quiet = renders([0.0, 2.0, 0.0], &[1.0, -1.0]);
        assert_eq!(Gain::new(&before, &quiet, &[true; 3]).median, 1.0);
    }

    #[test]
    fn a_median_is_in_the_middle() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 3.0);
        assert!(median(&[]).is_nan());
    }
}
