//! The mean of renders of different samples of the same pixels.

use spectra::{SpectralImage, variance_of_mean};
use std::ops::Range;

/// The image of all samples together: means weighted by the numbers of samples, and the variance of the mean of all samples (Chan,
/// Golub and LeVeque, Updating formulae and a pairwise algorithm for computing sample variances, COMPSTAT 1982).
///
/// # Panics
/// When there are no images, or they differ in size, bands or light groups.
pub(super) fn mean(images: &[SpectralImage]) -> SpectralImage {
    let first = &images[0];
    let (width, height, grid) = (first.width(), first.height(), *first.bands());
    let groups = first.light_groups().to_vec();
    let bands = grid.count() as usize;
    let mut image = SpectralImage::with_light_groups(width, height, grid, groups.clone());
    let mut radiance = vec![0.0; groups.len() * bands];
    let (mut variance, mut xyz) = (vec![0.0; bands], vec![[0.0; 3]; groups.len()]);
    for pixel in 0..first.samples().len() {
        let counts: Vec<u32> = images.iter().map(|image| image.samples()[pixel]).collect();
        let all = counts.iter().sum::<u32>();
        let weights: Vec<f64> = counts
            .iter()
            .map(|&n| f64::from(n) / f64::from(all.max(1)))
            .collect();
        let weighted = |value: &dyn Fn(&SpectralImage) -> f32| {
            let each = images.iter().zip(&weights);
            each.map(|(image, weight)| weight * f64::from(value(image)))
                .sum::<f64>()
        };
        for group in 0..groups.len() {
            for band in 0..bands {
                let value =
                    |image: &SpectralImage| image.group_radiance(group)[pixel * bands + band];
                radiance[group * bands + band] = weighted(&value) as f32;
            }
            for (axis, to) in xyz[group].iter_mut().enumerate() {
                let value = |image: &SpectralImage| image.group_xyz(group)[pixel][axis];
                *to = weighted(&value) as f32;
            }
        }
        for (band, variance) in variance.iter_mut().enumerate() {
            let at = pixel * bands + band;
            let mean = weighted(&|image| image.radiance()[at]);
            let deviations = images.iter().zip(&counts).map(|(image, &count)| {
                let n = f64::from(count);
                let own = f64::from(image.variance()[at]) * n * (n - 1.0).max(0.0);
                own + n * (f64::from(image.radiance()[at]) - mean).powi(2)
            });
            *variance = (deviations.sum::<f64>() * variance_of_mean(all)) as f32;
        }
        let at = (pixel as u32 % width, pixel as u32 / width);
        image.set_pixel_by_light(at, &radiance, &variance, &xyz, all);
    }
    image
}

/// Some columns of an image.
pub(super) fn columns(image: &SpectralImage, columns: Range<u32>) -> SpectralImage {
    let groups = image.light_groups().to_vec();
    let (count, height) = (columns.end - columns.start, image.height());
    let (bands, lights) = (image.bands().count() as usize, groups.len());
    let mut own = SpectralImage::with_light_groups(count, height, *image.bands(), groups);
    for y in 0..height {
        for x in 0..count {
            let pixel = (y * image.width() + columns.start + x) as usize;
            let of_bands = pixel * bands..(pixel + 1) * bands;
            let each = |group| image.group_radiance(group)[of_bands.clone()].to_vec();
            let radiance: Vec<f32> = (0..lights).flat_map(each).collect();
            let xyz: Vec<[f32; 3]> = (0..lights)
                .map(|group| image.group_xyz(group)[pixel])
                .collect();
            let variance = &image.variance()[of_bands];
            own.set_pixel_by_light((x, y), &radiance, variance, &xyz, image.samples()[pixel]);
        }
    }
    own
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::{BandGrid, LightGroup};

    /// An image of one pixel, one band and two light groups, from samples of each group.
    fn image(samples: &[[f64; 2]]) -> SpectralImage {
        let groups = ["a", "b"].map(|name| LightGroup {
            name: name.to_owned(),
            lamp: None,
        });
        let n = samples.len() as f64;
        let mean = |group: usize| samples.iter().map(|s| s[group]).sum::<f64>() / n;
        let total = mean(0) + mean(1);
        let squares = samples
            .iter()
            .map(|s| (s[0] + s[1] - total).powi(2))
            .sum::<f64>();
        let variance = squares * variance_of_mean(samples.len() as u32);
        let bands = BandGrid::visible(1).unwrap();
        let mut image = SpectralImage::with_light_groups(1, 1, bands, groups.to_vec());
        let radiance = [mean(0), mean(1)].map(|v| v as f32);
        let xyz = radiance.map(|value| [value; 3]);
        image.set_pixel_by_light(
            (0, 0),
            &radiance,
            &[variance as f32],
            &xyz,
            samples.len() as u32,
        );
        image
    }

    #[test]
    fn the_mean_of_ranges_is_that_of_all_samples() {
        let samples: Vec<[f64; 2]> = (0..23)
            .map(|i| [f64::from(i).sin().abs(), f64::from(i * i % 7)])
            .collect();
        let whole = image(&samples);
        let ranges = [&samples[..9], &samples[9..10], &samples[10..]].map(image);
        let found = mean(&ranges);
        let near = |a: f32, b: f32| (a - b).abs() <= 2.0 * f32::EPSILON * b;
        assert!(near(found.pixel(0, 0)[0], whole.pixel(0, 0)[0]));
        assert!(near(found.group_radiance(1)[0], whole.group_radiance(1)[0]));
        assert!(near(found.xyz()[0][2], whole.xyz()[0][2]));
        assert!((found.variance()[0] / whole.variance()[0] - 1.0).abs() < 1e-5);
        assert_eq!(found.samples(), [23]);
    }

    #[test]
    fn columns_are_cut_out() {
        let bands = BandGrid::visible(2).unwrap();
        let mut image = SpectralImage::new(3, 2, bands);
        image.set_pixel((1, 1), &[1.0, 2.0], &[0.5, 0.25], [3.0; 3], 7);
        let cut = columns(&image, 1..2);
        assert_eq!((cut.width(), cut.height()), (1, 2));
        assert_eq!(
            (cut.pixel(0, 1), cut.samples()),
            (&[1.0, 2.0][..], &[0, 7][..])
        );
    }
}
