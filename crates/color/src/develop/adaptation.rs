//! White adaptation: the scene's white becomes the display's.

use colorimetry::Matrix3;
use colorimetry::adaptation::Adaptation;
use colorimetry::chromaticity::{xy_of_xyz, xyz_of_xy};
use rayon::prelude::*;
use spectra::{Observer, SpectralImage};

use super::DevelopError;

/// The white to which the eye is assumed to be adapted in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneWhite {
    /// This chromaticity x, y.
    Chromaticity([f64; 2]),
    /// The chromaticity of the image's mean XYZ, which is right for a world that is gray on average (Buchsbaum, A spatial processor
    /// model for object color perception, J. Franklin Inst. 310, 1 (1980)). A picture of one strong color is not gray on average.
    Mean,
}

impl SceneWhite {
    /// The lamp of the light group that contributes the most luminance to the image; `None` if that lamp is unknown.
    pub fn of_lamps(image: &SpectralImage, observer: Observer) -> Option<Self> {
        let mut luminances = LampLuminances::default();
        luminances.add(image);
        luminances.white(image, observer)
    }
}

/// The luminances that the light groups contribute to an image, which may come in strips of rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LampLuminances(Vec<f64>);

impl LampLuminances {
    /// Adds the luminances of an image, or of the next strip of it.
    pub fn add(&mut self, image: &SpectralImage) {
        self.0.resize(image.light_groups().len(), 0.0);
        for (group, sum) in self.0.iter_mut().enumerate() {
            let luminances = image.group_xyz(group).iter();
            let luminances = luminances.map(|xyz| f64::from(xyz[1]));
            *sum = luminances
                .filter(|y| y.is_finite())
                .fold(*sum, |sum, y| sum + y);
        }
    }

    /// The white of the brightest lamp; `None` if it is unknown. `image` has the light groups and the bands; its pixels do not count.
    pub fn white(&self, image: &SpectralImage, observer: Observer) -> Option<SceneWhite> {
        let groups = 0..self.0.len().min(image.light_groups().len());
        let brightest = groups.max_by(|&a, &b| self.0[a].total_cmp(&self.0[b]))?;
        let lamp = image.light_groups()[brightest].lamp.as_ref()?;
        // A lamp's spectrum may extend arbitrarily far beyond the bands.
        let (grid, (from_nm, to_nm)) = (image.bands(), lamp.range_nm());
        let (from_nm, to_nm) = (from_nm.max(grid.min_nm()), to_nm.min(grid.max_nm()));
        let sum = (from_nm.ceil() as u32..=to_nm.floor() as u32)
            .map(f64::from)
            .map(|nm| observer.at(nm).map(|v| v * lamp.clamped_at(nm)))
            .fold([0.0; 3], add);
        (sum[1] > 0.0).then(|| SceneWhite::Chromaticity(xy_of_xyz(sum)))
    }
}

/// Complete adaptation from a scene's white to the display's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteAdaptation {
    /// The adaptation transform.
    pub method: Adaptation,
    /// The scene's white.
    pub from: SceneWhite,
}

impl WhiteAdaptation {
    /// Returns the matrix on XYZ that maps the scene's white to `to_white`, both with Y = 1.
    pub(super) fn matrix(
        &self,
        xyz: &[[f32; 3]],
        to_white: [f64; 3],
    ) -> Result<Matrix3, DevelopError> {
        let from = match self.from {
            SceneWhite::Chromaticity(xy) => xy,
            SceneWhite::Mean => mean_chromaticity(xyz).ok_or(DevelopError::NoWhite)?,
        };
        let y = to_white[1];
        let to_white = to_white.map(|v| v / y);
        Ok(self.method.matrix(xyz_of_xy(from), to_white))
    }
}

/// Chromaticity of the mean XYZ of all finite pixels.
fn mean_chromaticity(xyz: &[[f32; 3]]) -> Option<[f64; 2]> {
    // Chunks of fixed size: the sum does not depend on the number of cores.
    let sums: Vec<[f64; 3]> = xyz
        .par_chunks(4096)
        .map(|pixels| {
            let finite = pixels.iter().filter(|v| v.iter().all(|v| v.is_finite()));
            finite.fold([0.0; 3], |sum, v| add(sum, v.map(f64::from)))
        })
        .collect();
    let sum = sums.into_iter().fold([0.0; 3], add);
    sum.iter().all(|&v| v > 0.0).then(|| xy_of_xyz(sum))
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use colorimetry::matrix::times;
    use spectra::{BandGrid, LightGroup};

    #[test]
    fn the_brightest_lamp_is_the_white() {
        let grid = BandGrid::visible(4).unwrap();
        let lamp = |name: &str| LightGroup {
            name: name.to_owned(),
            lamp: grid.lamp(&spectra::illuminant(name).unwrap().data),
        };
        let groups = vec![lamp("D65"), lamp("A"), LightGroup::unknown()];
        let mut image = SpectralImage::with_light_groups(1, 1, grid, groups);
        let mut lit = |y: [f32; 3]| {
            let xyz = y.map(|y| [1.0, y, 1.0]);
            image.set_pixel_by_light((0, 0), &[1.0; 12], &[0.0; 4], &xyz, 1);
            SceneWhite::of_lamps(&image, Observer::Cie1931Deg2)
        };
        let Some(SceneWhite::Chromaticity([x, y])) = lit([1.0, 2.0, f32::NAN]) else {
            panic!("A is known");
        };
        // CIE 015:2018 gives 0.44758, 0.40745 from sums at 5 nm.
        assert!(
            (x - 0.44758).abs() < 5e-5 && (y - 0.40745).abs() < 5e-5,
            "{x} {y}"
        );
        assert_eq!(lit([1.0, 2.0, 3.0]), None);
    }

    #[test]
    fn a_lamp_is_walked_over_the_bands_alone() {
        let grid = BandGrid::visible(4).unwrap();
        let white = |points: &[(f64, f64)]| {
            let groups = vec![LightGroup {
                name: "key".to_owned(),
                lamp: spectra::Tabulated::new(points.to_vec()).ok(),
            }];
            let image = SpectralImage::with_light_groups(1, 1, grid, groups);
            SceneWhite::of_lamps(&image, Observer::Cie1931Deg2)
        };
        let over_the_bands = white(&[(380.0, 1.0), (780.0, 1.0)]);
        assert!(over_the_bands.is_some());
        assert_eq!(white(&[(1.0, 1.0), (1e12, 1.0)]), over_the_bands);
    }

    #[test]
    fn the_mean_becomes_the_white() {
        let xyz = [[2.0, 1.0, 0.1], [0.2, 1.0, 0.3], [f32::NAN; 3]];
        let white = xyz_of_xy([0.3127, 0.3290]);
        for method in [Adaptation::Bradford, Adaptation::Cat16] {
            let adaptation = WhiteAdaptation {
                method,
                from: SceneWhite::Mean,
            };
            let matrix = adaptation.matrix(&xyz, white).unwrap();
            let found = times(&matrix, [1.1, 1.0, 0.2]);
            for (found, white) in found.into_iter().zip(white) {
                assert!((found - white).abs() < 1e-7, "{found} {white}");
            }
            let black = adaptation.matrix(&[[0.0; 3]], white);
            assert_eq!(black, Err(DevelopError::NoWhite));
        }
    }
}
