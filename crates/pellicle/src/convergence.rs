//! How far a picture is from the one that it converges to, from renders that differ only in their seeds.

use spectra::SpectralImage;

/// Fraction of the pixels, those with the largest errors, that [`error_between_seeds`] leaves out.
pub const TRIMMED: f64 = 0.01;
/// A pixel's error is relative to its own radiance and to this fraction of the picture's mean.
pub const FLOOR: f64 = 0.05;

/// The trimmed relative error of a render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// The root mean square of the bands' errors.
    pub mean: f64,
    /// The error of the worst band.
    pub worst: f64,
}

/// Returns the error of one render, from several renders of the same scene with different seeds.
///
/// Per band it is the root of the mean over pixels of (I − R)² / (R² + (0.05 R̄)²), without the hundredth of the pixels where that is
/// largest: fireflies would dominate it. I is the radiance of a render, R is what it converges to, and R̄ is the mean of R over the picture.
/// The average of (I − R)² is the variance between renders, so no converged picture is needed. The mean of the renders is used for R: where
/// errors are large, this makes them look larger (for the benchmark's bubble 0.147 instead of 0.138 at 4 samples and three seeds, 0.0345
/// instead of 0.0337 at 64).
///
/// # Panics
/// When there are fewer than two images, or they differ in size or bands.
pub fn error_between_seeds(images: &[SpectralImage]) -> Error {
    assert!(images.len() > 1, "one image has no variance");
    let first = &images[0];
    let size = |image: &SpectralImage| (image.width(), image.height(), *image.bands());
    assert!(images.iter().all(|image| size(image) == size(first)));
    let bands = first.bands().count() as usize;
    let errors: Vec<f64> = (0..bands).map(|band| of_band(images, band)).collect();
    Error {
        mean: root_mean_square(&errors),
        worst: errors.iter().copied().fold(0.0, f64::max),
    }
}

fn of_band(images: &[SpectralImage], band: usize) -> f64 {
    let bands = images[0].bands().count() as usize;
    let n = images.len() as f64;
    let of_pixel = |pixel: usize| {
        let values = || {
            images
                .iter()
                .map(|i| f64::from(i.radiance()[pixel * bands + band]))
        };
        let mean = values().sum::<f64>() / n;
        let squares = values().map(|value| (value - mean) * (value - mean));
        (mean, squares.sum::<f64>() / (n - 1.0))
    };
    let pixels: Vec<_> = (0..images[0].samples().len()).map(of_pixel).collect();
    let picture = pixels.iter().map(|(mean, _)| mean).sum::<f64>() / pixels.len() as f64;
    let floor = (FLOOR * picture).powi(2);
    let relative = |(mean, variance): &(f64, f64)| match mean * mean + floor {
        0.0 => 0.0,
        scale => variance / scale,
    };
    let mut relative: Vec<f64> = pixels.iter().map(relative).collect();
    relative.sort_by(f64::total_cmp);
    relative.truncate(relative.len() - (TRIMMED * relative.len() as f64) as usize);
    (relative.iter().sum::<f64>() / relative.len() as f64).sqrt()
}

fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len() as f64).sqrt()
}

/// Returns the seconds to an error, from seconds and errors at increasing numbers of samples, the first of which is the smallest possible.
/// Interpolates linearly between the logarithms of the measurements, and extrapolates from the last one as if the error fell with the root
/// of the time. `None` if there are no measurements.
pub fn seconds_to(error: f64, measured: &[(f64, f64)]) -> Option<f64> {
    let (first, last) = (*measured.first()?, *measured.last()?);
    if error >= first.1 {
        return Some(first.0);
    }
    if error < last.1 {
        let (seconds, found) = last;
        return Some(seconds * (found / error).powi(2));
    }
    let mut pairs = measured.windows(2);
    let [(s0, e0), (s1, e1)] = *pairs.find(|pair| pair[1].1 <= error)? else {
        return None;
    };
    let part = (e0 / error).ln() / (e0 / e1).ln();
    Some((s0.ln() + part * (s1 / s0).ln()).exp())
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::BandGrid;

    /// Two images of radiance 2 in each band, off by + and − `relative` of it, with `bright` pixels of noise at the end.
    fn images(relative: [f64; 2], bright: u32) -> Vec<SpectralImage> {
        let side = 100;
        let image = |sign: f64| {
            let mut image = SpectralImage::new(side, side, BandGrid::visible(2).unwrap());
            for place in 0..side * side {
                let is_bright = place >= side * side - bright;
                let value = |relative: f64| match is_bright {
                    true if sign > 0.0 => 1e4,
                    true => 0.0,
                    false => 2.0 * (1.0 + sign * relative),
                };
                let radiance = relative.map(|relative| value(relative) as f32);
                let at = (place % side, place / side);
                image.set_pixel(at, &radiance, &[0.0; 2], [0.0; 3], 1);
            }
            image
        };
        vec![image(1.0), image(-1.0)]
    }

    /// Two values at ± d have the variance 2 d²: the error is √2 d / 2 · 1/√(1 + 0.05²) of the radiance 2.
    #[test]
    fn the_error_is_that_of_known_noise() {
        let found = error_between_seeds(&images([0.01, 0.02], 0));
        let exact = |d: f64| (2.0 * d * d / (1.0 + FLOOR * FLOOR)).sqrt();
        assert!((found.worst - exact(0.02)).abs() < 1e-6, "{found:?}");
        let mean = root_mean_square(&[exact(0.01), exact(0.02)]);
        assert!((found.mean - mean).abs() < 1e-6, "{found:?}");
    }

    /// Fireflies in a hundredth of the pixels are left out; more are not.
    #[test]
    fn few_fireflies_do_not_count() {
        let few = error_between_seeds(&images([0.01; 2], 100)).mean;
        assert!(few < 0.0142, "{few}");
        let more = error_between_seeds(&images([0.01; 2], 150)).mean;
        assert!(more > 0.05, "{more}");
    }

    #[test]
    fn seconds_lie_between_and_beyond_what_was_measured() {
        let measured = [(1.0, 0.2), (4.0, 0.1), (8.0, 0.025)];
        let near = |found: Option<f64>, expected: f64| {
            assert!((found.unwrap() / expected - 1.0).abs() < 1e-12, "{found:?}");
        };
        near(seconds_to(0.1, &measured), 4.0);
        near(seconds_to(0.05, &measured), 4.0 * 2.0_f64.sqrt());
        near(seconds_to(0.4, &measured), 1.0);
        near(seconds_to(0.1, &[(1.0, 0.0)]), 1.0);
        near(seconds_to(0.0125, &measured), 32.0);
        assert_eq!(seconds_to(0.1, &[]), None);
    }
}
