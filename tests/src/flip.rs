//! FLIP: how different two pictures look when one flips between them, 0 (alike) to 1.
//!
//! LDR-FLIP of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for
//! Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; the constants are those of the paper. In `f64`.

use color::RgbImage8;
use colorimetry::srgb::{from_u8, linear_from_xyz, rgb_from_xyz};
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::path::Path;
use std::sync::OnceLock;

/// Pixels per degree of a 0.7 m wide screen of 3840 pixels at 0.7 m, the paper's default.
const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// An 8-bit sRGB picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Red, green and blue of each pixel, row by row.
    pub codes: Vec<[u8; 3]>,
}

impl Picture {
    /// Of a developed image.
    pub fn of(image: &RgbImage8) -> Self {
        Self {
            size: [image.width() as usize, image.height() as usize],
            codes: image
                .data()
                .chunks_exact(3)
                .map(|p| [p[0], p[1], p[2]])
                .collect(),
        }
    }

    /// From a PNG file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn read(path: &Path) -> Result<Self, image::ImageError> {
        let image = image::open(path)?.into_rgb8();
        Ok(Self {
            size: [image.width() as usize, image.height() as usize],
            codes: image.pixels().map(|p| p.0).collect(),
        })
    }
}

/// The mean of [`flip`] over all pixels.
///
/// # Errors
/// When the pictures differ in size or are empty.
pub fn mean_flip(reference: &Picture, test: &Picture) -> Result<f64, String> {
    let values = flip(reference, test)?;
    Ok(values.iter().sum::<f64>() / values.len() as f64)
}

/// The difference at each pixel: ΔE_c^(1 − ΔE_f), of colour and of features (equation 15 of the paper).
///
/// # Errors
/// When the pictures differ in size or are empty.
pub fn flip(reference: &Picture, test: &Picture) -> Result<Vec<f64>, String> {
    if reference.size != test.size {
        return Err(format!(
            "{:?} pixels against {:?}",
            test.size, reference.size
        ));
    }
    if reference.codes.is_empty() || reference.codes.len() != reference.size[0] * reference.size[1]
    {
        return Err("there are no pixels, or not as many as the size says".to_owned());
    }
    let planes = [reference, test].map(opponent_planes);
    let seen = planes.each_ref().map(|p| as_seen(p, reference.size));
    let features = planes.each_ref().map(|p| features(&p[0], reference.size));
    let at = |i: usize| {
        let colour = redistributed(hyab(seen[0][i], seen[1][i]).powf(0.7));
        let edge = (features[0][i][0] - features[1][i][0]).abs();
        let point = (features[0][i][1] - features[1][i][1]).abs();
        let feature = (edge.max(point) / 2.0_f64.sqrt()).sqrt();
        colour.powf(1.0 - feature)
    };
    Ok((0..reference.codes.len()).map(at).collect())
}

/// XYZ of linear sRGB: the inverse of the matrix in `colorimetry::srgb`, whose white differs from the authors' by 3e-5.
fn xyz_from_linear(linear: [f64; 3]) -> [f64; 3] {
    static INVERSE: OnceLock<DMat3> = OnceLock::new();
    let inverse = INVERSE.get_or_init(|| {
        let rows = rgb_from_xyz().map(DVec3::from_array);
        DMat3::from_cols(rows[0], rows[1], rows[2])
            .transpose()
            .inverse()
    });
    (*inverse * DVec3::from_array(linear)).to_array()
}

/// XYZ over the display's white.
fn relative_xyz(linear: [f64; 3]) -> [f64; 3] {
    let (xyz, white) = (xyz_from_linear(linear), xyz_from_linear([1.0; 3]));
    [xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]]
}

/// The planes Y, Cx and Cz of a linearised L*a*b* (section 4.1.1).
fn opponent_planes(picture: &Picture) -> [Vec<f64>; 3] {
    let pixels: Vec<[f64; 3]> = picture
        .codes
        .iter()
        .map(|codes| {
            let [x, y, z] = relative_xyz(codes.map(from_u8));
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
        })
        .collect();
    std::array::from_fn(|plane| pixels.iter().map(|p| p[plane]).collect())
}

/// A square filter of side 2 · radius + 1.
struct Filter {
    radius: isize,
    weights: Vec<f64>,
}

impl Filter {
    fn new(radius: isize, weight: impl Fn(f64, f64) -> f64) -> Self {
        let side = -radius..=radius;
        let weights = side
            .clone()
            .flat_map(|y| side.clone().map(move |x| (x as f64, y as f64)))
            .map(|(x, y)| weight(x, y))
            .collect();
        Self { radius, weights }
    }

    /// Positive weights add up to 1, negative ones to −1.
    fn balanced(mut self) -> Self {
        let positive: f64 = self.weights.iter().filter(|&&w| w > 0.0).sum();
        let negative: f64 = self.weights.iter().filter(|&&w| w < 0.0).sum();
        for w in &mut self.weights {
            *w /= if *w > 0.0 { positive } else { -negative };
        }
        self
    }

    /// A plane filtered; beyond the border its last value goes on.
    fn over(&self, plane: &[f64], [width, height]: [usize; 2]) -> Vec<f64> {
        let at = |i: usize| {
            let (x0, y0) = ((i % width) as isize, (i / width) as isize);
            let mut weights = self.weights.iter();
            let mut sum = 0.0;
            for dy in -self.radius..=self.radius {
                let y = (y0 + dy).clamp(0, height as isize - 1) as usize;
                for (dx, weight) in (-self.radius..=self.radius).zip(&mut weights) {
                    let x = (x0 + dx).clamp(0, width as isize - 1) as usize;
                    sum += weight * plane[y * width + x];
                }
            }
            sum
        };
        (0..plane.len()).into_par_iter().map(at).collect()
    }
}

/// The contrast sensitivity of a plane as a sum of two Gaussians a √(π/b) exp(−π² x²/b), x in degrees (table 1, equation 3).
fn sensitivity(terms: [(f64, f64); 2]) -> Filter {
    use std::f64::consts::PI;
    // Three standard deviations of the widest of all: b = 0.04.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil();
    let mut filter = Filter::new(radius as isize, |x, y| {
        let degrees2 = (x * x + y * y) / (PIXELS_PER_DEGREE * PIXELS_PER_DEGREE);
        let term = |(a, b): (f64, f64)| a * (PI / b).sqrt() * (-PI * PI * degrees2 / b).exp();
        term(terms[0]) + term(terms[1])
    });
    let total: f64 = filter.weights.iter().sum();
    for w in &mut filter.weights {
        *w /= total;
    }
    filter
}

/// The picture blurred as the eye does it, in L*a*b* with Hunt's adjustment (sections 4.1.1 and 4.1.2).
fn as_seen(planes: &[Vec<f64>; 3], size: [usize; 2]) -> Vec<[f64; 3]> {
    let filters = [
        [(1.0, 0.0047), (0.0, 1e-5)],
        [(1.0, 0.0053), (0.0, 1e-5)],
        [(34.1, 0.04), (13.5, 0.025)],
    ]
    .map(sensitivity);
    let [y, cx, cz] = std::array::from_fn(|i| filters[i].over(&planes[i], size));
    (0..y.len())
        .map(|i| hunt_lab(linear_of_opponents([y[i], cx[i], cz[i]])))
        .collect()
}

/// Linear sRGB, clipped to the display.
fn linear_of_opponents([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let white = xyz_from_linear([1.0; 3]);
    let xyz = [
        (y + cx / 500.0) * white[0],
        y * white[1],
        (y - cz / 200.0) * white[2],
    ];
    linear_from_xyz(xyz).map(|v| v.clamp(0.0, 1.0))
}

/// CIE L*a*b*, a* and b* times L*/100: colours of dark pixels count less (equation 7).
fn hunt_lab(linear: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = relative_xyz(linear).map(|t| {
        if t > DELTA.powi(3) {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    [
        lightness,
        5.0 * lightness * (x - y),
        2.0 * lightness * (y - z),
    ]
}

/// |ΔL*| + √(Δa*² + Δb*²) (equation 8).
fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Differences up to 0.4 of the largest (green to blue) use 0.95 of the scale (section 4.1.4).
fn redistributed(difference: f64) -> f64 {
    let largest = hyab(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])).powf(0.7);
    let knee = 0.4 * largest;
    if difference < knee {
        0.95 * difference / knee
    } else {
        0.95 + 0.05 * (difference - knee) / (largest - knee)
    }
}

/// Strength of edges and of points at each pixel of the plane Y (section 4.2).
fn features(y: &[f64], size: [usize; 2]) -> Vec<[f64; 2]> {
    let lightness: Vec<f64> = y.iter().map(|y| (y + 16.0) / 116.0).collect();
    // Half of the width 0.082° of a feature.
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as isize;
    let gauss = |x: f64, y: f64| (-(x * x + y * y) / (2.0 * deviation * deviation)).exp();
    let edge = |x: f64, y: f64| -x * gauss(x, y);
    let point = |x: f64, y: f64| (x * x / (deviation * deviation) - 1.0) * gauss(x, y);
    let strength = |weight: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        let across = Filter::new(radius, weight)
            .balanced()
            .over(&lightness, size);
        let down = Filter::new(radius, |x, y| weight(y, x))
            .balanced()
            .over(&lightness, size);
        across.iter().zip(down).map(|(a, d)| a.hypot(d)).collect()
    };
    let edges = strength(&edge);
    edges
        .into_iter()
        .zip(strength(&point))
        .map(|(e, p)| [e, p])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(code: [u8; 3]) -> Picture {
        Picture {
            size: [24, 16],
            codes: vec![code; 24 * 16],
        }
    }

    fn striped(codes: [[u8; 3]; 2]) -> Picture {
        Picture {
            size: [24, 16],
            codes: (0..24 * 16).map(|i| codes[(i / 6) % 2]).collect(),
        }
    }

    fn mean(a: &Picture, b: &Picture) -> f64 {
        mean_flip(a, b).unwrap()
    }

    #[test]
    fn a_picture_does_not_differ_from_itself() {
        let picture = striped([[20, 90, 200], [240, 180, 30]]);
        assert!(mean(&picture, &picture) < 1e-12);
    }

    #[test]
    fn the_largest_difference_is_from_green_to_blue() {
        let found = mean(&filled([0, 255, 0]), &filled([0, 0, 255]));
        assert!((found - 1.0).abs() < 1e-9, "{found}");
    }

    /// Without features FLIP is the redistributed colour difference alone: 100 in L* is 100^0.7 = 25.1189 of the largest
    /// 203.36^0.7 = 41.28, thus 0.95 + 0.05 (25.1189 − 16.51) / 24.77 = 0.9674.
    #[test]
    fn black_and_white_differ_as_computed_by_hand() {
        let found = mean(&filled([0; 3]), &filled([255; 3]));
        assert!((found - 0.9674).abs() < 5e-4, "{found}");
    }

    #[test]
    fn either_picture_may_be_the_reference() {
        let (a, b) = (
            striped([[20, 90, 200], [240, 180, 30]]),
            striped([[240, 60, 30], [20, 200, 90]]),
        );
        assert!((mean(&a, &b) - mean(&b, &a)).abs() < 1e-12);
        assert!(mean(&a, &b) > 0.1);
    }

    #[test]
    fn a_change_of_hue_is_noticed_and_more_of_it_more() {
        let base = filled([180, 120, 60]);
        let little = mean(&base, &filled([170, 125, 60]));
        let much = mean(&base, &filled([60, 120, 180]));
        assert!(little > 0.02 && much > 4.0 * little, "{little} {much}");
    }

    /// The same difference of colour counts more where it makes an edge (section 4.2).
    #[test]
    fn a_feature_raises_the_difference() {
        let base = filled([100; 3]);
        let mut lined = base.clone();
        for row in lined.codes.chunks_mut(24) {
            row[12] = [200; 3];
        }
        let values = flip(&base, &lined).unwrap();
        assert!(values[12] > 2.0 * values[1] && values[1] >= 0.0);
    }

    #[test]
    fn pictures_of_different_sizes_do_not_compare() {
        let mut other = filled([0; 3]);
        other.size = [16, 24];
        assert!(flip(&filled([0; 3]), &other).is_err());
        let none = Picture {
            size: [0, 0],
            codes: vec![],
        };
        assert!(flip(&none, &none).is_err());
    }
}
