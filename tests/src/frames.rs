//! Comparing pictures band by band.

use crate::tolerances::{FrameTolerance, VarianceTolerance, Z_MEAN, Z_OVER_3};
use spectra::{LayerKey, SpectralImage, Stokes};

/// Values of an image, pixel by pixel, `bands` per pixel.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// Number of bands per pixel.
    pub bands: usize,
    /// The values.
    pub values: &'a [f32],
}

impl<'a> Values<'a> {
    /// The radiance of an image.
    pub fn of(image: &'a SpectralImage) -> Self {
        Self {
            bands: image.bands().count() as usize,
            values: image.radiance(),
        }
    }

    /// The XYZ of an image, as three bands.
    pub fn of_xyz(image: &'a SpectralImage) -> Self {
        Self {
            bands: 3,
            values: bytemuck::cast_slice(image.xyz()),
        }
    }

    /// The radiance of one light group of an image.
    pub fn of_light(image: &'a SpectralImage, light_group: usize) -> Self {
        Self {
            values: image.group_radiance(light_group),
            ..Self::of(image)
        }
    }

    /// The XYZ of one light group of an image.
    pub fn of_light_xyz(image: &'a SpectralImage, light_group: usize) -> Self {
        Self {
            bands: 3,
            values: bytemuck::cast_slice(image.group_xyz(light_group)),
        }
    }

    /// The variance of an image.
    fn of_variance(image: &'a SpectralImage) -> Self {
        Self {
            values: image.variance(),
            ..Self::of(image)
        }
    }

    fn band(self, band: usize) -> impl Iterator<Item = f64> + 'a {
        self.values
            .iter()
            .skip(band)
            .step_by(self.bands)
            .map(|&x| f64::from(x))
    }
}

/// Compares two pictures rendered with the same random numbers.
///
/// # Errors
/// A report of what exceeds the tolerance: 99th percentile and signed bias of every band, fraction of outliers. A value that is
/// not finite, shapes that differ, and a reference that is all black are errors too.
pub fn same_numbers(
    actual: Values,
    expected: Values,
    tolerance: &FrameTolerance,
) -> Result<String, String> {
    if actual.bands != expected.bands || actual.values.len() != expected.values.len() {
        return Err("the pictures have different shapes".to_owned());
    }
    if let Some(i) = actual.values.iter().position(|x| !x.is_finite()) {
        return Err(format!("value {i} is {}", actual.values[i]));
    }
    let pixels = actual.values.len() / actual.bands.max(1);
    let mut is_outlier = vec![false; pixels];
    let mut worst_p99 = (0.0, 0);
    for band in 0..actual.bands {
        let mean = expected.band(band).sum::<f64>() / pixels as f64;
        if mean <= 0.0 {
            return Err(format!("band {band} of the reference is black"));
        }
        let errors = actual
            .band(band)
            .zip(expected.band(band))
            .map(|(a, e)| (a - e).abs() / (e.abs() + tolerance.floor * mean));
        let mut errors: Vec<f64> = errors.collect();
        for (outlier, &error) in is_outlier.iter_mut().zip(&errors) {
            *outlier |= error > tolerance.outlier;
        }
        errors.sort_by(f64::total_cmp);
        let p99 = errors[(pixels - 1) * 99 / 100];
        if p99 > worst_p99.0 {
            worst_p99 = (p99, band);
        }
    }
    let share = is_outlier.iter().filter(|&&o| o).count() as f64 / pixels as f64;
    let (bias, bias_band) = worst_bias(actual, expected, &is_outlier);
    let report = format!(
        "p99 {:.1e} (band {}), bias {bias:.1e} (band {bias_band}), outliers {:.3} %",
        worst_p99.0,
        worst_p99.1,
        100.0 * share
    );
    let good = worst_p99.0 <= tolerance.p99
        && bias.abs() <= tolerance.bias
        && share <= tolerance.outlier_fraction;
    if good { Ok(report) } else { Err(report) }
}

/// Compares S1, S2 and S3 of two pictures rendered with the same random numbers, in total and of each light group, in the bands and as XYZ. Errors
/// are relative to S0, with the tolerances of a frame.
///
/// # Errors
/// A report of the first component that is missing in either, has a value that is not finite, or differs too much. Polarization of less than a
/// thousandth in every pixel is an error too, if `must_be_polarized`: it would prove nothing.
pub fn same_polarization(
    actual: &SpectralImage,
    expected: &SpectralImage,
    must_be_polarized: bool,
    tolerance: &FrameTolerance,
) -> Result<String, String> {
    let mut worst = (0.0, String::new());
    let mut strongest = 0.0_f64;
    for key in LayerKey::polarized(expected.light_groups().len()) {
        let of = |image: &SpectralImage, key| image.layer(key).map(|layer| layer.floats().to_vec());
        let (Some(found), Some(sought)) = (of(actual, key), of(expected, key)) else {
            return Err(format!("{key:?} is missing"));
        };
        let all = of(expected, key.component(Stokes::S0)).unwrap_or_default();
        if found.len() != sought.len() || sought.len() != all.len() {
            return Err("the pictures have different shapes".to_owned());
        }
        let mean = all.iter().map(|&x| f64::from(x)).sum::<f64>() / all.len().max(1) as f64;
        let floor = tolerance.floor * mean;
        let mut errors = Vec::with_capacity(found.len());
        for ((a, e), s0) in found.iter().zip(&sought).zip(&all) {
            let [a, e, s0] = [a, e, s0].map(|&x| f64::from(x));
            let error = (a - e).abs() / (s0.abs() + floor);
            if !error.is_finite() && s0.abs() + floor > 0.0 {
                return Err(format!("{key:?} has the value {a}"));
            }
            // Where there is no light at all, both are 0.
            errors.push(if a == e { 0.0 } else { error });
            if s0 > floor {
                strongest = strongest.max(e.abs() / s0);
            }
        }
        let outliers = errors.iter().filter(|&&e| e > tolerance.outlier).count();
        let share = outliers as f64 / errors.len().max(1) as f64;
        errors.sort_by(f64::total_cmp);
        let p99 = errors[(errors.len() - 1) * 99 / 100];
        if !(p99 <= tolerance.p99 && share <= tolerance.outlier_fraction) {
            return Err(format!(
                "{key:?}: p99 {p99:.1e}, outliers {:.3} %",
                100.0 * share
            ));
        }
        if p99 >= worst.0 {
            worst = (p99, format!("{key:?}"));
        }
    }
    if must_be_polarized && strongest < 1e-3 {
        return Err(format!(
            "no light is polarized to more than {strongest:.1e}"
        ));
    }
    let (p99, key) = worst;
    Ok(format!(
        "polarization: p99 {p99:.1e} ({key}), up to {strongest:.2} polarized"
    ))
}

/// The largest mean signed error divided by the mean, and its band, without the outliers.
fn worst_bias(actual: Values, expected: Values, is_outlier: &[bool]) -> (f64, usize) {
    let mut worst = (0.0_f64, 0);
    for band in 0..actual.bands {
        let (mut difference, mut total) = (0.0, 0.0);
        for ((a, e), &outlier) in actual.band(band).zip(expected.band(band)).zip(is_outlier) {
            if !outlier {
                difference += a - e;
                total += e;
            }
        }
        let bias = difference / total;
        if bias.abs() > worst.0.abs() || bias.is_nan() {
            worst = (bias, band);
        }
    }
    worst
}

/// Compares the variances of two pictures rendered with the same random numbers, pixel by pixel.
///
/// # Errors
/// A report of the largest 99th percentile of any band. A variance that is negative or not finite, and shapes that differ, are
/// errors too.
pub fn same_variances(
    actual: &SpectralImage,
    expected: &SpectralImage,
    tolerance: &VarianceTolerance,
) -> Result<String, String> {
    if actual.bands() != expected.bands() || actual.variance().len() != expected.variance().len() {
        return Err("the pictures have different shapes".to_owned());
    }
    let is_wrong = |x: &f32| !x.is_finite() || *x < 0.0;
    if let Some(i) = actual.variance().iter().position(is_wrong) {
        return Err(format!("variance {i} is {}", actual.variance()[i]));
    }
    let (found, sought) = (Values::of_variance(actual), Values::of_variance(expected));
    let mut worst = (0.0, 0);
    for band in 0..sought.bands {
        let pixels = sought.band(band).count();
        let mean = sought.band(band).sum::<f64>() / pixels as f64;
        let radiance = Values::of(expected).band(band);
        let errors = found.band(band).zip(sought.band(band)).zip(radiance);
        let error = |((a, e), radiance): ((f64, f64), f64)| {
            let rounding = tolerance.rounding * radiance * radiance;
            match (a - e).abs() {
                0.0 => 0.0,
                off => off / (e + tolerance.floor * mean + rounding / tolerance.p99),
            }
        };
        let mut errors: Vec<f64> = errors.map(error).collect();
        errors.sort_by(f64::total_cmp);
        let p99 = errors[(pixels - 1) * 99 / 100];
        if p99 > worst.0 {
            worst = (p99, band);
        }
    }
    let report = format!("variance p99 {:.1e} (band {})", worst.0, worst.1);
    if worst.0 <= tolerance.p99 {
        Ok(report)
    } else {
        Err(report)
    }
}

/// Compares two pictures rendered with different random numbers: the mean of every band, and of every block of 8×8 pixels,
/// must differ by no more than both variances explain.
///
/// # Errors
/// A report of the largest z of a mean and the fraction of blocks beyond 3.
pub fn same_expectation(a: &SpectralImage, b: &SpectralImage) -> Result<String, String> {
    const SIDE: u32 = 8;
    let bands = a.bands().count() as usize;
    let mut worst: f64 = 0.0;
    let (mut beyond, mut blocks) = (0, 0);
    for band in 0..bands {
        let mut whole = (0.0, 0.0);
        for y in (0..a.height()).step_by(SIDE as usize) {
            for x in (0..a.width()).step_by(SIDE as usize) {
                let block = block_difference((a, b), band, (x, y), SIDE);
                whole.0 += block.0;
                whole.1 += block.1;
                let z = standardized(block);
                blocks += 1;
                beyond += u32::from(z.is_nan() || z.abs() > 3.0);
            }
        }
        let z = standardized(whole);
        worst = if z.is_nan() {
            f64::INFINITY
        } else {
            worst.max(z.abs())
        };
    }
    let share = f64::from(beyond) / f64::from(blocks);
    let report = format!(
        "largest z of a mean {worst:.2}, blocks beyond 3: {:.2} %",
        100.0 * share
    );
    if worst <= Z_MEAN && share <= Z_OVER_3 {
        Ok(report)
    } else {
        Err(report)
    }
}

/// z of a difference with its variance; without noise, 0 where the values agree to f32 and infinity where they do not.
fn standardized((difference, variance): (f64, f64)) -> f64 {
    if variance > 0.0 {
        difference / variance.sqrt()
    } else if difference.abs() < 1e-4 {
        0.0
    } else {
        f64::INFINITY
    }
}

fn block_difference(
    (a, b): (&SpectralImage, &SpectralImage),
    band: usize,
    (x0, y0): (u32, u32),
    side: u32,
) -> (f64, f64) {
    let bands = a.bands().count() as usize;
    let (mut difference, mut variance) = (0.0, 0.0);
    for y in y0..(y0 + side).min(a.height()) {
        for x in x0..(x0 + side).min(a.width()) {
            let i = (y * a.width() + x) as usize * bands + band;
            difference += f64::from(a.radiance()[i]) - f64::from(b.radiance()[i]);
            variance += f64::from(a.variance()[i]) + f64::from(b.variance()[i]);
        }
    }
    (difference, variance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerances::{FRAMES, VARIANCES};

    fn picture() -> Vec<f32> {
        (0..4000).map(|i| 0.5 + (i % 17) as f32 * 0.1).collect()
    }

    fn check(actual: &[f32]) -> Result<String, String> {
        let expected = picture();
        let (a, e) = (
            Values {
                bands: 4,
                values: actual,
            },
            Values {
                bands: 4,
                values: &expected,
            },
        );
        same_numbers(a, e, &FRAMES)
    }

    #[test]
    fn a_picture_agrees_with_itself() {
        assert!(check(&picture()).is_ok());
    }

    #[test]
    fn a_small_bias_is_noticed() {
        let biased: Vec<f32> = picture().iter().map(|x| x * 1.0005).collect();
        assert!(check(&biased).is_err());
    }

    #[test]
    fn swapped_bands_are_noticed() {
        let swapped: Vec<f32> = picture()
            .chunks(4)
            .flat_map(|p| [p[1], p[0], p[2], p[3]])
            .collect();
        assert!(check(&swapped).is_err());
    }

    /// A picture of 20×20 pixels with some polarization, changed in one component.
    fn polarized(change: impl Fn(Stokes, usize, f32) -> f32) -> SpectralImage {
        let mut image = SpectralImage::new(20, 20, spectra::BandGrid::visible(2).unwrap());
        for i in 0..400 {
            image.set_pixel((i % 20, i / 20), &[1.0; 2], &[0.0; 2], [1.0; 3], 1);
        }
        let mut image = image.with_polarization();
        for row in image.rows_mut() {
            for (key, values) in row.layers {
                if key.stokes != Stokes::S0 {
                    for (i, value) in values.iter_mut().enumerate() {
                        *value = change(key.stokes, i, 0.1 * (i % 5) as f32);
                    }
                }
            }
        }
        image
    }

    #[test]
    fn a_wrong_component_is_noticed() {
        let expected = polarized(|_, _, value| value);
        let compare = |actual: &SpectralImage| same_polarization(actual, &expected, true, &FRAMES);
        assert!(compare(&expected).is_ok());
        let unpolarized = SpectralImage::new(20, 20, *expected.bands());
        assert!(compare(&unpolarized).is_err());
        let wrong: [fn(Stokes, usize, f32) -> f32; 4] = [
            |s, _, value| if s == Stokes::S3 { -value } else { value },
            |s, _, value| {
                if s == Stokes::S1 {
                    value + 0.002
                } else {
                    value
                }
            },
            |s, i, value| {
                if s == Stokes::S2 && i == 7 {
                    f32::NAN
                } else {
                    value
                }
            },
            |_, _, _| 0.0,
        ];
        for wrong in wrong {
            assert!(compare(&polarized(wrong)).is_err());
        }
        let dark = polarized(|_, _, _| 0.0);
        assert!(same_polarization(&dark, &dark, true, &FRAMES).is_err());
        assert!(same_polarization(&dark, &dark, false, &FRAMES).is_ok());
    }

    #[test]
    fn one_nan_is_noticed() {
        let mut broken = picture();
        broken[1234] = f32::NAN;
        assert!(check(&broken).is_err());
    }

    #[test]
    fn dead_pixels_are_noticed() {
        let mut broken = picture();
        broken[400..424].fill(0.0); // six pixels of a thousand: 0.6 %
        assert!(check(&broken).is_err());
    }

    #[test]
    fn a_black_reference_proves_nothing() {
        let black = vec![0.0; 4000];
        let values = Values {
            bands: 4,
            values: &black,
        };
        assert!(same_numbers(values, values, &FRAMES).is_err());
    }

    #[test]
    fn a_shift_beyond_the_noise_is_noticed() {
        let grid = spectra::BandGrid::visible(2).unwrap();
        let image = |level: f32| {
            let mut image = SpectralImage::new(16, 16, grid);
            for y in 0..16 {
                for x in 0..16 {
                    image.set_pixel((x, y), &[level; 2], &[1e-4; 2], [0.0; 3], 16);
                }
            }
            image
        };
        assert!(same_expectation(&image(1.0), &image(1.0005)).is_ok());
        assert!(same_expectation(&image(1.0), &image(1.02)).is_err());
        assert!(same_expectation(&image(1.0), &image(f32::NAN)).is_err());
    }

    /// A picture whose variance and XYZ differ from pixel to pixel, each mapped by a function.
    fn uneven(variance: impl Fn(f32) -> f32, xyz: impl Fn([f32; 3]) -> [f32; 3]) -> SpectralImage {
        let mut image = SpectralImage::new(20, 20, spectra::BandGrid::visible(2).unwrap());
        for i in 0..400 {
            let level = 0.5 + (i % 17) as f32 * 0.1;
            let color = xyz([level, 1.1 * level, 1.3 * level]);
            let variance = [variance(1e-3 * level), variance(2e-3 * level)];
            image.set_pixel((i % 20, i / 20), &[level; 2], &variance, color, 16);
        }
        image
    }

    #[test]
    fn a_wrong_variance_is_noticed() {
        let right = uneven(|v| v, |c| c);
        let compare = |wrong: &SpectralImage| same_variances(wrong, &right, &VARIANCES);
        assert!(compare(&right).is_ok());
        assert!(compare(&uneven(|v| v * 1.001, |c| c)).is_ok());
        assert!(compare(&uneven(|v| v * 2.0, |c| c)).is_err());
        assert!(compare(&uneven(|v| v * 1.02, |c| c)).is_err());
        assert!(compare(&uneven(|_| 0.0, |c| c)).is_err());
        assert!(compare(&uneven(|v| -v, |c| c)).is_err());
        assert!(compare(&uneven(|_| f32::NAN, |c| c)).is_err());
    }

    #[test]
    fn a_wrong_color_is_noticed() {
        let right = uneven(|v| v, |c| c);
        let compare = |wrong: &SpectralImage| {
            same_numbers(Values::of_xyz(wrong), Values::of_xyz(&right), &FRAMES)
        };
        assert!(compare(&right).is_ok());
        assert!(compare(&uneven(|v| v, |[x, y, z]| [z, y, x])).is_err());
        assert!(compare(&uneven(|v| v, |c| c.map(|x| x * 1.01))).is_err());
    }
}
