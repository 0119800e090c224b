//! White adaptation: the scene's white becomes the display's.

use colorimetry::Matrix3;
use colorimetry::adaptation::Adaptation;
use colorimetry::chromaticity::{xy_of_xyz, xyz_of_xy};
use rayon::prelude::*;

use super::DevelopError;

/// The white that the eye is taken to be adapted to in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SceneWhite {
    /// This chromaticity x, y.
    Chromaticity([f64; 2]),
    /// That of the image's mean XYZ, which is grey for a world that is grey on average (Buchsbaum, A spatial processor model for
    /// object colour perception, J. Franklin Inst. 310, 1 (1980)). A picture of one strong colour is no such world.
    Mean,
}

/// Complete adaptation from a scene's white to the display's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteAdaptation {
    /// How.
    pub method: Adaptation,
    /// From which white.
    pub from: SceneWhite,
}

impl WhiteAdaptation {
    /// The matrix on XYZ that takes the scene's white to `to_white`, both with Y = 1.
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

/// Chromaticity of the mean XYZ of the pixels that are finite.
fn mean_chromaticity(xyz: &[[f32; 3]]) -> Option<[f64; 2]> {
    // In chunks of fixed size, so that the sum does not depend on the number of cores.
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
