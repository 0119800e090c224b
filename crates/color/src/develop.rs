//! A spectral image developed into a picture.

use rayon::prelude::*;
use spectra::SpectralImage;

use crate::xyz::exposure_scale;
use colorimetry::srgb;

/// An 8-bit sRGB picture, row 0 on top.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct RgbImage8 {
    width: u32,
    height: u32,
    data: Vec<u8>,
}

impl RgbImage8 {
    /// A picture of these codes, red, green and blue of each pixel in turn, row by row; `None` unless there are
    /// 3 × `width` × `height` of them.
    pub fn new(width: u32, height: u32, data: Vec<u8>) -> Option<Self> {
        let expected = 3 * width as usize * height as usize;
        (data.len() == expected).then_some(Self {
            width,
            height,
            data,
        })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The codes, red, green and blue of each pixel in turn, row by row.
    pub fn data(&self) -> &[u8] {
        &self.data
    }

    /// Red, green and blue of pixel (x, y); `None` outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let start = 3 * (y as usize * self.width as usize + x as usize);
        self.data[start..start + 3].try_into().ok()
    }
}

/// Develops an image for an sRGB display.
///
/// XYZ is taken relative to an equal-energy radiance of 1 (see [`exposure_scale`]), times 2^`exposure_ev`.
/// Colours that the display cannot show are clipped channel by channel; a channel that is not a number is 0.
pub fn develop(image: &SpectralImage, exposure_ev: f64) -> RgbImage8 {
    let scale = exposure_scale(exposure_ev);
    let mut data = vec![0; 3 * image.xyz().len()];
    data.par_chunks_exact_mut(3)
        .zip(image.xyz())
        .with_min_len(4096)
        .for_each(|(codes, &xyz)| {
            let rgb = linear_rgb(xyz, scale);
            codes.copy_from_slice(&rgb.map(srgb::to_u8));
        });
    RgbImage8 {
        width: image.width(),
        height: image.height(),
        data,
    }
}

/// Linear sRGB, not clipped, of XYZ in cd/m² times `scale`.
pub(crate) fn linear_rgb(xyz: [f32; 3], scale: f64) -> [f64; 3] {
    srgb::linear_from_xyz(xyz.map(|value| f64::from(value) * scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::xyz::equal_energy_luminance;
    use spectra::BandGrid;

    /// An image of one row with these colours, XYZ relative to the white's Y = 1.
    fn row(colours: &[[f64; 3]]) -> SpectralImage {
        let grid = BandGrid::visible(1).unwrap();
        let mut image = SpectralImage::new(colours.len() as u32, 1, grid);
        for (x, colour) in colours.iter().enumerate() {
            let xyz = colour.map(|v| (v * equal_energy_luminance()) as f32);
            image.set_pixel((x as u32, 0), &[0.0], &[0.0], xyz, 1);
        }
        image
    }

    const D65: [f64; 3] = [0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290];

    #[test]
    fn white_black_and_grey_get_their_codes() {
        let grey = D65.map(|v| v * srgb::from_u8(119));
        let picture = develop(&row(&[D65, [0.0; 3], grey]), 0.0);
        assert_eq!((picture.width(), picture.height()), (3, 1));
        assert_eq!(picture.data(), [255, 255, 255, 0, 0, 0, 119, 119, 119]);
        assert_eq!(picture.pixel(2, 0), Some([119; 3]));
        assert_eq!(picture.pixel(3, 0), None);
    }

    #[test]
    fn a_stop_doubles_the_light() {
        let half = D65.map(|v| v * 0.25);
        assert_eq!(develop(&row(&[half]), 2.0), develop(&row(&[D65]), 0.0));
        assert_ne!(develop(&row(&[half]), 1.0), develop(&row(&[D65]), 0.0));
    }

    #[test]
    fn what_is_not_a_number_is_black_and_stays_alone() {
        let picture = develop(&row(&[[f64::NAN; 3], D65, [f64::INFINITY; 3]]), 0.0);
        assert_eq!(picture.pixel(0, 0), Some([0; 3]));
        assert_eq!(picture.pixel(1, 0), Some([255; 3]));
    }
}
