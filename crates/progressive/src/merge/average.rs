//! The mean of renders of different samples of the same pixels.

use spectra::{SpectralImage, Stokes, variance_of_mean};
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
    let mut image = empty(first, [width, height]);
    let components = components(first);
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
        let take = |stokes, radiance: &mut [f32], xyz: &mut [[f32; 3]]| {
            for (i, to) in radiance.iter_mut().enumerate() {
                let (group, at) = (i / bands, pixel * bands + i % bands);
                let value = |image: &SpectralImage| image.group_component(group, stokes)[at];
                *to = weighted(&value) as f32;
            }
            for (i, to) in xyz.as_flattened_mut().iter_mut().enumerate() {
                let (group, axis) = (i / 3, i % 3);
                let value =
                    |image: &SpectralImage| image.group_component_xyz(group, stokes)[pixel][axis];
                *to = weighted(&value) as f32;
            }
        };
        let at = (pixel as u32 % width, pixel as u32 / width);
        for &stokes in components {
            take(stokes, &mut radiance, &mut xyz);
            image.set_component_by_light(at, stokes, &radiance, &xyz);
        }
        take(Stokes::S0, &mut radiance, &mut xyz);
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
        image.set_pixel_by_light(at, &radiance, &variance, &xyz, all);
    }
    image
}

/// A black image of another size with the same content.
fn empty(like: &SpectralImage, [width, height]: [u32; 2]) -> SpectralImage {
    let groups = like.light_groups().to_vec();
    let image = SpectralImage::with_light_groups(width, height, *like.bands(), groups);
    if like.is_polarized() {
        image.with_polarization()
    } else {
        image
    }
}

/// The components beyond S0 that an image holds.
fn components(image: &SpectralImage) -> &'static [Stokes] {
    if image.is_polarized() {
        &Stokes::POLARIZED
    } else {
        &[]
    }
}

/// Some columns of an image.
pub(super) fn columns(image: &SpectralImage, columns: Range<u32>) -> SpectralImage {
    let (count, height) = (columns.end - columns.start, image.height());
    let (bands, lights) = (image.bands().count() as usize, image.light_groups().len());
    let mut own = empty(image, [count, height]);
    for y in 0..height {
        for x in 0..count {
            let pixel = (y * image.width() + columns.start + x) as usize;
            let of_bands = pixel * bands..(pixel + 1) * bands;
            let component = |stokes| -> (Vec<f32>, Vec<[f32; 3]>) {
                let each = |group| image.group_component(group, stokes)[of_bands.clone()].to_vec();
                let xyz = |group| image.group_component_xyz(group, stokes)[pixel];
                let groups = 0..lights;
                (
                    groups.clone().flat_map(each).collect(),
                    groups.map(xyz).collect(),
                )
            };
            for &stokes in components(image) {
                let (radiance, xyz) = component(stokes);
                own.set_component_by_light((x, y), stokes, &radiance, &xyz);
            }
            let (radiance, xyz) = component(Stokes::S0);
            let variance = &image.variance()[of_bands.clone()];
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

    /// Components are weighted by samples, in total and by light group, and are cut out with their pixels.
    #[test]
    fn components_are_averaged_and_cut_like_s0() {
        let piece = |samples: u32, value: f32| {
            let samples = vec![[f64::from(value), 1.0]; samples as usize];
            let mut image = image(&samples).with_polarization();
            for (stokes, factor) in Stokes::POLARIZED.into_iter().zip([1.0, -2.0, 4.0]) {
                let values = [factor * value, 0.5];
                image.set_component_by_light((0, 0), stokes, &values, &values.map(|v| [v; 3]));
            }
            image
        };
        let found = mean(&[piece(3, 1.0), piece(1, 5.0)]);
        for image in [&found, &columns(&found, 0..1)] {
            assert!(image.is_polarized() && image.samples() == [4]);
            for (stokes, expected) in Stokes::ALL.into_iter().zip([2.0, 2.0, -4.0, 8.0]) {
                assert_eq!(image.group_component(0, stokes), [expected], "{stokes:?}");
                assert_eq!(image.group_component_xyz(0, stokes), [[expected; 3]]);
                let rest = if stokes == Stokes::S0 { 1.0 } else { 0.5 };
                let total = image.layer(spectra::LayerKey::RADIANCE.component(stokes));
                assert_eq!(total.unwrap().floats(), [expected + rest]);
            }
        }
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
