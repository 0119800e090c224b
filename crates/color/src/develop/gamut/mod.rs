//! Gamut mapping: replacing colors that the display cannot show.
//!
//! Interference colors are often more saturated than the triangle of the primaries, and highlights are brighter than the white.
//! A display shows red, green and blue from its black to its peak, and nothing else; colors outside must be mapped to colors
//! inside.
//!
//! # Why Oklab
//!
//! [`GamutMapping::Perceptual`] reduces chroma along a line of constant hue and lightness of a perceptual space. The space should
//! be the one whose lines of constant hue agree best with observers. Two published experiments give colors that observers saw as
//! the same hue: Hung and Berns (Color Res. Appl. 20, 285 (1995), table III: 48 colors of 12 hues) and Ebner and Fairchild (Proc.
//! SPIE 3300, 107 (1998): 321 colors of 15 hues). Each color was rotated, in the space, to the mean hue of the colors seen as the
//! same hue; the distance that this moves it, in ΔE₀₀, is the error of the space:
//!
//! | | Hung and Berns: mean | 95 % | blue | max | Ebner and Fairchild: mean | 95 % | max |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | CIELAB | 1.66 | 4.7 | 8.5 | 19.8 | 1.33 | 4.0 | 11.0 |
//! | CIECAM16-UCS | 1.03 | 3.4 | 3.3 | 6.7 | 1.10 | 3.0 | 5.2 |
//! | Oklab | **0.76** | **2.0** | **1.6** | **3.3** | **0.93** | **2.5** | **4.5** |
//!
//! CIELAB turns blues to purple. Oklab is best in every column, and cheap: a mapping is the smallest root of six cubics. (Oklab
//! was fitted to the second data set, among others; the first is independent of it.)
//!
//! Interference colors: of 600 free films in D65, of index 4/3 and 2.4 and 5 to 1500 nm thick, 126 lie outside sRGB. Measured by
//! the hue angle of CIECAM16, on which none of the mappings is based, clipping rotates their hue by 3.7° on average (12° at
//! most), mixing with white by 1.1° (6.8°), and Oklab by 0.7° (5.6°). `tests/tests/colors/gamut.rs` recompute both
//! results.

mod perceptual;
mod report;

use colorimetry::Display;
use colorimetry::matrix::times;

use super::DevelopSettings;
use crate::develop::quantize::black_rgb;
use perceptual::Perceptual;
use picture_file::LinearImage;

pub use report::GamutReport;

/// How colors that the display cannot show are mapped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GamutMapping {
    /// Colors are kept, for files that can hold them. In codes they are clipped.
    Keep,
    /// Each channel is clipped. This is fast and keeps channels that are in range exactly, but hues shift toward the primaries.
    Clip,
    /// Colors are mixed with the gray of the same luminance until the display can show them. Chromaticity moves straight toward
    /// the display's white, which keeps luminance but not always hue: blues turn to purple.
    TowardWhite,
    /// Chroma is reduced along a line of constant hue and lightness in Oklab.
    #[default]
    Perceptual,
}

/// How far below a display's minimum an amount still counts as inside the gamut: a third of an 8-bit code of sRGB at the black
/// ([`ABOVE`]: a ninth at the white). The white of D65 itself differs by 3e-4 from that of a display whose standard rounds it to
/// four decimals.
const BELOW: f64 = 1e-4;
/// How far above a display's maximum an amount still counts as inside the gamut; see [`BELOW`].
const ABOVE: f64 = 1e-3;

/// The colors that a display can show: amounts of red, green and blue, including its black, from `low` to `high`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gamut {
    low: [f64; 3],
    high: [f64; 3],
    /// Luminance of a unit amount of each primary.
    luminance: [f64; 3],
    perceptual: Perceptual,
}

impl Gamut {
    /// The gamut of `display`.
    pub fn new(display: &Display) -> Self {
        let low = black_rgb(display);
        Self {
            low,
            high: low.map(|v| v + display.peak()),
            luminance: display.xyz_from_rgb()[1],
            perceptual: Perceptual::new(display),
        }
    }

    /// Whether the display can show this color; false for NaN.
    pub fn contains(&self, rgb: [f64; 3]) -> bool {
        (0..3).all(|i| rgb[i] >= self.low[i] - BELOW && rgb[i] <= self.high[i] + ABOVE)
    }

    /// Returns the color that the display shows for `rgb`. A color that it can show is not changed.
    pub fn map(&self, mapping: GamutMapping, rgb: [f64; 3]) -> [f64; 3] {
        if mapping == GamutMapping::Keep || self.contains(rgb) {
            return rgb;
        }
        let mapped = match mapping {
            _ if !rgb.iter().all(|v| v.is_finite()) => rgb,
            GamutMapping::Keep | GamutMapping::Clip => rgb,
            GamutMapping::TowardWhite => self.toward_white(rgb),
            GamutMapping::Perceptual => self.perceptual.map(rgb, self),
        };
        self.clipped(mapped)
    }

    /// Clips each channel; NaN becomes the minimum.
    fn clipped(&self, rgb: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| rgb[i].max(self.low[i]).min(self.high[i]))
    }

    /// The darkest and the lightest gray that the display can show, as an amount of each channel.
    fn grays(&self) -> [f64; 2] {
        [
            self.low.into_iter().fold(f64::NEG_INFINITY, f64::max),
            self.high.into_iter().fold(f64::INFINITY, f64::min),
        ]
    }

    /// Returns g + t (rgb − Y), where g is the gray of luminance Y, or the nearest gray of the display, and t is the largest value
    /// for which the display can show the color, 1 at most.
    fn toward_white(&self, rgb: [f64; 3]) -> [f64; 3] {
        let [darkest, lightest] = self.grays();
        let luminance: f64 = (0..3).map(|i| self.luminance[i] * rgb[i]).sum();
        let gray = luminance.max(darkest).min(lightest);
        let mut t = 1.0_f64;
        for (i, value) in rgb.into_iter().enumerate() {
            let direction = value - luminance;
            let room = if direction > 0.0 {
                self.high[i] - gray
            } else {
                self.low[i] - gray
            };
            if direction != 0.0 {
                t = t.min(room / direction);
            }
        }
        rgb.map(|v| gray + t * (v - luminance))
    }
}

/// Maps every pixel into the display's gamut, and marks pixels outside it if the settings ask for that.
pub fn map(image: &mut LinearImage, settings: &DevelopSettings) {
    let mapping = settings.gamut;
    if mapping == GamutMapping::Keep && !settings.gamut_warning {
        return;
    }
    let gamut = Gamut::new(&settings.display);
    image.map(|place, rgb| {
        if settings.gamut_warning && !gamut.contains(rgb) {
            stripe(place)
        } else {
            gamut.map(mapping, rgb)
        }
    });
}

/// Diagonal stripes, black and white, four pixels wide, which cannot be mistaken for a picture of any color.
fn stripe([x, y]: [usize; 2]) -> [f64; 3] {
    if (x + y) / 4 % 2 == 0 {
        [0.0; 3]
    } else {
        [1.0; 3]
    }
}

/// Returns the XYZ of amounts of a display's primaries.
fn xyz_of(display: &Display, rgb: [f64; 3]) -> [f64; 3] {
    times(display.xyz_from_rgb(), rgb)
}

#[cfg(test)]
mod tests;
