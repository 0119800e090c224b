//! Differences of two spectral images in each band.

use rayon::prelude::*;
use spectra::{BandGrid, LayerKey, SpectralImage, Stokes};

use super::CompareError;

/// The difference of two images in one band, second minus first, over all pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandDifference {
    /// The wavelength in the middle of the band, nm.
    pub center_nm: f64,
    /// Mean radiance of the first image.
    pub reference_mean: f64,
    /// Root mean square difference.
    pub rmse: f64,
    /// Mean difference: above 0 if the second image is brighter.
    pub bias: f64,
    /// How much of the difference is noise; `None` unless both images have a variance.
    pub noise: Option<Noise>,
    /// Number of values left out because one of the pair was not finite.
    pub left_out: usize,
}

/// The noise that the variances of two images predict for their difference, if their noise is independent (different seeds).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The root mean square difference that noise alone causes, √(mean of the sum of both variances).
    pub rmse: f64,
    /// The bias over its standard error: within ±3 it may be noise.
    pub bias_sigmas: f64,
}

/// Sums over the pixels of a band.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: usize,
    reference: f64,
    difference: f64,
    squared: f64,
    variance: f64,
}

/// The [`bands()`] of two images that come in strips of rows, from the top. The differences are those of the whole images to the last
/// bit.
#[derive(Clone, Debug)]
pub struct BandSums {
    grid: BandGrid,
    /// The component of the Stokes vector that is compared.
    stokes: Stokes,
    sums: Vec<Sums>,
    pixels: usize,
    /// Whether the first and the second have a variance.
    has_noise: [bool; 2],
}

/// Compares the images band by band.
///
/// # Errors
/// When they differ in size or bands, or have no pixels.
pub fn bands(
    reference: &SpectralImage,
    test: &SpectralImage,
) -> Result<Vec<BandDifference>, CompareError> {
    let mut sums = BandSums::new(*reference.bands());
    sums.add(reference, test)?;
    sums.finish()
}

impl BandSums {
    /// Starts without any rows, for two images of these bands.
    pub fn new(bands: BandGrid) -> Self {
        Self::of_component(bands, Stokes::S0)
    }

    /// As [`Self::new`], for a component of the Stokes vector. The noise of S1, S2 and S3 is not known: that of S0 is given, which theirs
    /// is like where light is fully polarized, and which is larger where it is not. Images without the component do not count.
    pub fn of_component(bands: BandGrid, stokes: Stokes) -> Self {
        Self {
            stokes,
            sums: vec![Sums::default(); bands.count() as usize],
            grid: bands,
            pixels: 0,
            has_noise: [false; 2],
        }
    }

    /// Adds the next rows of both images.
    ///
    /// # Errors
    /// When they differ in size or in bands.
    pub fn add(
        &mut self,
        reference: &SpectralImage,
        test: &SpectralImage,
    ) -> Result<(), CompareError> {
        let size = |image: &SpectralImage| [image.width() as usize, image.height() as usize];
        check_sizes(size(reference), size(test))?;
        for image in [reference, test] {
            check_bands(&self.grid, image.bands())?;
        }
        self.pixels += reference.xyz().len();
        for (known, image) in self.has_noise.iter_mut().zip([reference, test]) {
            *known = *known || image.variance().iter().any(|&v| v > 0.0);
        }
        for row in sums_of_rows(reference, test, self.stokes) {
            for (total, sums) in self.sums.iter_mut().zip(row) {
                total.add_all(sums);
            }
        }
        Ok(())
    }

    /// Returns the differences over all rows.
    ///
    /// # Errors
    /// When there are no pixels.
    pub fn finish(self) -> Result<Vec<BandDifference>, CompareError> {
        if self.pixels == 0 {
            return Err(CompareError::Empty);
        }
        let knows_noise = self.has_noise == [true; 2];
        let of_band = |(band, sums): (u32, &Sums)| {
            sums.difference(self.grid.center_nm(band), self.pixels, knows_noise)
        };
        Ok((0..).zip(&self.sums).map(of_band).collect())
    }
}

/// Checks that two images have the same bands.
///
/// # Errors
/// When they do not.
pub fn check_bands(first: &BandGrid, second: &BandGrid) -> Result<(), CompareError> {
    if first == second {
        return Ok(());
    }
    Err(CompareError::Bands {
        first: *first,
        second: *second,
    })
}

/// Checks that two images have the same width and height.
///
/// # Errors
/// When they do not.
pub fn check_sizes(first: [usize; 2], second: [usize; 2]) -> Result<(), CompareError> {
    if first == second {
        return Ok(());
    }
    Err(CompareError::Sizes { first, second })
}

/// Sums each row of pixels on any core, to be added in order, so the results are the same on every machine.
fn sums_of_rows(reference: &SpectralImage, test: &SpectralImage, stokes: Stokes) -> Vec<Vec<Sums>> {
    let key = LayerKey::RADIANCE.component(stokes);
    let (Some(first), Some(second)) = (reference.layer(key), test.layer(key)) else {
        return Vec::new();
    };
    let (first, second) = (first.floats(), second.floats());
    let bands = reference.bands().count() as usize;
    let row = bands * reference.width() as usize;
    let of_row = |row: &[f32], other: &[f32], variance: &[f32], other_variance: &[f32]| {
        let mut sums = vec![Sums::default(); bands];
        for (i, (&a, &b)) in row.iter().zip(other).enumerate() {
            let (a, b) = (f64::from(a), f64::from(b));
            if a.is_finite() && b.is_finite() {
                let noise = f64::from(variance[i]) + f64::from(other_variance[i]);
                sums[i % bands].add(a, b - a, noise);
            }
        }
        sums
    };
    (0..reference.height() as usize)
        .into_par_iter()
        .map(|y| {
            let values = y * row..(y + 1) * row;
            of_row(
                &first[values.clone()],
                &second[values.clone()],
                &reference.variance()[values.clone()],
                &test.variance()[values],
            )
        })
        .collect()
}

impl Sums {
    fn add(&mut self, reference: f64, difference: f64, variance: f64) {
        self.count += 1;
        self.reference += reference;
        self.difference += difference;
        self.squared += difference * difference;
        self.variance += variance;
    }

    fn add_all(&mut self, other: Self) {
        self.count += other.count;
        self.reference += other.reference;
        self.difference += other.difference;
        self.squared += other.squared;
        self.variance += other.variance;
    }

    fn difference(&self, center_nm: f64, pixels: usize, knows_noise: bool) -> BandDifference {
        let count = self.count as f64;
        let noise = Noise {
            rmse: (self.variance / count).sqrt(),
            bias_sigmas: self.difference / self.variance.sqrt(),
        };
        BandDifference {
            center_nm,
            reference_mean: self.reference / count,
            rmse: (self.squared / count).sqrt(),
            bias: self.difference / count,
            noise: (knows_noise && self.variance > 0.0).then_some(noise),
            left_out: pixels - self.count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two pixels of two bands.
    fn image(values: [[f32; 2]; 2], variance: f32) -> SpectralImage {
        let mut image = SpectralImage::new(2, 1, BandGrid::visible(2).unwrap());
        for (x, values) in (0..).zip(&values) {
            image.set_pixel((x, 0), values, &[variance; 2], [0.0; 3], 8);
        }
        image
    }

    #[test]
    fn differences_are_those_of_a_computation_by_hand() {
        let reference = image([[1.0, 2.0], [3.0, 4.0]], 0.02);
        let test = image([[1.1, 2.0], [3.3, 4.0]], 0.03);
        let found = bands(&reference, &test).unwrap();
        let first = found[0];
        assert_eq!((first.center_nm, first.reference_mean), (480.0, 2.0));
        assert!((first.bias - 0.2).abs() < 1e-6);
        assert!((first.rmse - 0.05_f64.sqrt()).abs() < 1e-6);
        let noise = first.noise.unwrap();
        assert!((noise.rmse - 0.05_f64.sqrt()).abs() < 1e-6);
        assert!((noise.bias_sigmas - 0.4 / 0.1_f64.sqrt()).abs() < 1e-5);
        assert_eq!((found[1].bias, found[1].rmse), (0.0, 0.0));
        // Swapping the images changes the sign.
        assert!((bands(&test, &reference).unwrap()[0].bias + 0.2).abs() < 1e-6);
    }

    #[test]
    fn strips_have_the_differences_of_the_whole() {
        let rows = [[[1.0, 2.0], [3.0, 0.1]], [[0.7, 1e6], [1e-3, 4.0]]];
        let column = |variance: f32| {
            let mut image = SpectralImage::new(2, 2, BandGrid::visible(2).unwrap());
            for (y, row) in (0..).zip(&rows) {
                for (x, values) in (0..).zip(row) {
                    let values = values.map(|v: f32| v + 3.0 * variance);
                    image.set_pixel((x, y), &values, &[variance * y as f32; 2], [0.0; 3], 8);
                }
            }
            image
        };
        let strip = |y: usize, variance: f32| {
            let values = rows[y].map(|values| values.map(|v| v + 3.0 * variance));
            image(values, variance * y as f32)
        };
        let whole = bands(&column(0.1), &column(0.3)).unwrap();
        assert!(whole[0].noise.is_some());
        let mut sums = BandSums::new(BandGrid::visible(2).unwrap());
        for y in 0..2 {
            sums.add(&strip(y, 0.1), &strip(y, 0.3)).unwrap();
        }
        assert_eq!(sums.finish().unwrap(), whole);
    }

    #[test]
    fn components_are_compared_by_themselves() {
        let with = |s2: f32| {
            let mut image = image([[1.0; 2]; 2], 0.02).with_polarization();
            image.set_component_by_light((1, 0), Stokes::S2, &[s2, -s2], &[[0.0; 3]]);
            image
        };
        let of = |stokes| {
            let mut sums = BandSums::of_component(BandGrid::visible(2).unwrap(), stokes);
            sums.add(&with(0.5), &with(0.25)).unwrap();
            sums.finish().unwrap()
        };
        let s2 = of(Stokes::S2);
        assert_eq!((s2[0].reference_mean, s2[0].bias), (0.25, -0.125));
        assert_eq!((s2[1].reference_mean, s2[1].bias), (-0.25, 0.125));
        assert!((s2[0].rmse - 0.25 / 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((s2[0].noise.unwrap().rmse - 0.2).abs() < 1e-6);
        for other in [Stokes::S0, Stokes::S1, Stokes::S3] {
            assert_eq!(of(other)[0].rmse, 0.0, "{other:?}");
        }
    }

    #[test]
    fn without_variance_nothing_is_said_of_noise() {
        let (known, unknown) = (image([[1.0; 2]; 2], 0.1), image([[1.0; 2]; 2], 0.0));
        assert!(bands(&known, &unknown).unwrap()[0].noise.is_none());
    }

    #[test]
    fn what_is_not_a_number_is_left_out() {
        let (reference, broken) = (
            image([[1.0; 2]; 2], 0.1),
            image([[f32::NAN, 2.0], [1.5, 2.0]], 0.1),
        );
        let found = bands(&reference, &broken).unwrap();
        assert_eq!((found[0].left_out, found[1].left_out), (1, 0));
        assert_eq!((found[0].bias, found[1].bias), (0.5, 1.0));
    }

    #[test]
    fn images_that_are_not_alike_do_not_compare() {
        let image = |width, bands| SpectralImage::new(width, 1, BandGrid::visible(bands).unwrap());
        let sizes = bands(&image(2, 3), &image(3, 3)).unwrap_err();
        assert!(matches!(sizes, CompareError::Sizes { .. }), "{sizes}");
        let other = bands(&image(2, 3), &image(2, 4)).unwrap_err();
        assert_eq!(
            other.to_string(),
            "the first image has 3 bands from 380 to 780 nm, the second 4 bands from 380 to 780 nm"
        );
        assert_eq!(bands(&image(0, 3), &image(0, 3)), Err(CompareError::Empty));
    }
}
