//! Pictures of polarization in false colors.

use colorimetry::srgb;
use picture_file::RgbImage8;
use rayon::prelude::*;
use spectra::stokes::{
    angle_of_linear_polarization_deg, degree_of_circular_polarization,
    degree_of_linear_polarization, degree_of_polarization,
};

use crate::compare::{NOT_A_NUMBER, magma};

/// What a picture shows of light with the Stokes vector (S0, S1, S2, S3).
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Polarization {
    /// Degree of polarization, 0 to 1.
    Degree,
    /// Degree of linear polarization, 0 to 1.
    Linear,
    /// Degree of circular polarization, −1 (left) to 1 (right).
    Circular,
    /// Angle of linear polarization, 0 to 180°.
    Angle,
    /// S1 / S0, −1 to 1.
    S1,
    /// S2 / S0, −1 to 1.
    S2,
    /// S3 / S0, −1 to 1: the same as [`Self::Circular`].
    S3,
}

/// The codes of no light.
const DARK: [u8; 3] = [0; 3];

impl Polarization {
    /// The values at the ends of the scale of colors.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::Degree | Self::Linear => [0.0, 1.0],
            Self::Angle => [0.0, 180.0],
            Self::Circular | Self::S1 | Self::S2 | Self::S3 => [-1.0, 1.0],
        }
    }

    /// The value of a Stokes vector; `None` where there is no light, S0 ≤ 0.
    pub fn value(self, stokes: [f64; 4]) -> Option<f64> {
        let value = match self {
            Self::Degree => degree_of_polarization(stokes),
            Self::Linear => degree_of_linear_polarization(stokes),
            Self::Circular | Self::S3 => degree_of_circular_polarization(stokes),
            Self::Angle => angle_of_linear_polarization_deg(stokes),
            Self::S1 => stokes[1] / stokes[0],
            Self::S2 => stokes[2] / stokes[0],
        };
        // A NaN is a value that is shown as such.
        (stokes[0].is_nan() || stokes[0] > 0.0).then_some(value)
    }

    /// The sRGB codes of a place on the scale, from 0 at its start to 1 at its end.
    ///
    /// Degrees from 0 to 1 are magma, from black to pale yellow (S. van der Walt and N. Smith, 2015). Values with a sign go from blue over
    /// white at 0 to red. An angle is a hue, red at 0° and 180°, yellow at 30°, cyan at 90°; `degree` is the degree of linear polarization,
    /// to which the brightness of the linear light is proportional: unpolarized light is black. The others ignore it.
    pub fn color(self, share: f64, degree: f64) -> [u8; 3] {
        if share.is_nan() || degree.is_nan() {
            return NOT_A_NUMBER;
        }
        match self {
            Self::Degree | Self::Linear => magma(share),
            Self::Angle => hue(share).map(|v| srgb::to_u8(v * degree.clamp(0.0, 1.0))),
            Self::Circular | Self::S1 | Self::S2 | Self::S3 => blue_white_red(share),
        }
    }

    /// The sRGB codes of a Stokes vector: black where there is no light, green where a component is not a number.
    pub fn color_of(self, stokes: [f64; 4]) -> [u8; 3] {
        let [from, to] = self.range();
        if stokes.iter().any(|v| v.is_nan()) {
            return NOT_A_NUMBER;
        }
        self.value(stokes).map_or(DARK, |value| {
            let degree = degree_of_linear_polarization(stokes);
            self.color((value - from) / (to - from), degree)
        })
    }

    /// A picture of one Stokes vector for each pixel, row by row; `None` unless there are `width` × `height`.
    pub fn picture(self, [width, height]: [u32; 2], vectors: &[[f32; 4]]) -> Option<RgbImage8> {
        let codes = vectors.par_iter().with_min_len(4096);
        let codes: Vec<[u8; 3]> = codes
            .map(|vector| self.color_of(vector.map(f64::from)))
            .collect();
        RgbImage8::new(width, height, codes.into_flattened())
    }
}

/// The linear red, green and blue of a hue, from 0 (red) over green and blue to 1 (red again).
fn hue(share: f64) -> [f64; 3] {
    let sixths = 6.0 * share.rem_euclid(1.0);
    let near = |center: f64| {
        let off = (sixths - center).abs();
        (2.0 - off.min(6.0 - off)).clamp(0.0, 1.0)
    };
    [near(0.0), near(2.0), near(4.0)]
}

/// Blue at 0, white at one half, red at 1: the ends of Moreland's map (Diverging Color Maps for Scientific Visualization, 2009), and
/// between them linear in codes.
fn blue_white_red(share: f64) -> [u8; 3] {
    const BLUE: [f64; 3] = [59.0, 76.0, 192.0];
    const RED: [f64; 3] = [180.0, 4.0, 38.0];
    let signed = 2.0 * share.clamp(0.0, 1.0) - 1.0;
    let end = if signed < 0.0 { BLUE } else { RED };
    end.map(|end| (255.0 + signed.abs() * (end - 255.0)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_ratios_to_the_radiance() {
        let vector = [2.0, 0.6, 0.8, -0.5];
        for (of, expected) in [
            (Polarization::Degree, 1.25_f64.sqrt() / 2.0),
            (Polarization::Linear, 0.5),
            (Polarization::Circular, -0.25),
            (Polarization::Angle, 26.565_051_177_077_99),
            (Polarization::S1, 0.3),
            (Polarization::S2, 0.4),
            (Polarization::S3, -0.25),
        ] {
            let found = of.value(vector).unwrap();
            assert!((found - expected).abs() < 1e-12, "{of:?}: {found}");
            assert_eq!(of.value([0.0; 4]), None);
        }
    }

    #[test]
    fn signs_are_blue_and_red_and_zero_is_white() {
        let of = |s1| Polarization::S1.color_of([1.0, s1, 0.0, 0.0]);
        assert_eq!(of(0.0), [255; 3]);
        assert_eq!((of(-1.0), of(1.0)), ([59, 76, 192], [180, 4, 38]));
        assert!(of(-0.5)[2] > of(-0.5)[0] && of(0.5)[0] > of(0.5)[2]);
    }

    #[test]
    fn an_angle_is_a_hue_and_its_degree_the_brightness() {
        let at = |deg: f64, degree: f64| {
            let (sin, cos) = (2.0 * deg).to_radians().sin_cos();
            Polarization::Angle.color_of([1.0, degree * cos, degree * sin, 0.0])
        };
        assert_eq!(at(0.0, 1.0), [255, 0, 0]);
        assert_eq!((at(60.0, 1.0), at(120.0, 1.0)), ([0, 255, 0], [0, 0, 255]));
        assert_eq!(
            (at(30.0, 1.0), at(90.0, 1.0)),
            ([255, 255, 0], [0, 255, 255])
        );
        assert_eq!(at(60.0, 0.5), [0, srgb::to_u8(0.5), 0]);
        assert_eq!(at(60.0, 0.0), [0; 3]);
        // The hue has no step at 180°.
        let (low, high) = (at(0.001, 1.0), at(179.999, 1.0));
        assert!(
            low.iter().zip(high).all(|(a, b)| a.abs_diff(b) < 3),
            "{low:?} {high:?}"
        );
    }

    #[test]
    fn no_light_is_black_and_what_is_not_a_number_is_green() {
        let vectors = [[0.0; 4], [1.0, f32::NAN, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0]];
        let picture = Polarization::S2.picture([3, 1], &vectors).unwrap();
        let codes: Vec<_> = (0..3).map(|x| picture.pixel(x, 0).unwrap()).collect();
        assert_eq!(codes, [[0; 3], NOT_A_NUMBER, [255; 3]]);
        assert!(Polarization::S2.picture([2, 1], &vectors).is_none());
        let whole = Polarization::Degree.color_of([1.0, 0.0, 1.0, 0.0]);
        assert_eq!(whole, magma(1.0));
    }
}
