//! Gamut mapping: what becomes of colors that the display cannot show.
//!
//! Interference colors are often more saturated than the primaries' triangle, and highlights brighter than the white. A display
//! shows red, green and blue from its black to its peak, and nothing else; what lies outside must become something inside.
//!
//! # Why Oklab
//!
//! [`GamutMapping::Perceptual`] takes chroma away along a line of constant hue and lightness of a perceptual space, so the space
//! is the one whose lines observers agree with. Two published experiments give colors that observers saw in the same hue: those
//! of Hung and Berns (Color Res. Appl. 20, 285 (1995), table III: 48 colors of 12 hues) and of Ebner and Fairchild (Proc. SPIE
//! 3300, 107 (1998): 321 colors of 15 hues). Each color was turned, in the space, to the mean hue of those seen alike; how far
//! that moves it, in ΔE₀₀, is the error of the space:
//!
//! | | Hung and Berns: mean | 95 % | blue | max | Ebner and Fairchild: mean | 95 % | max |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | CIELAB | 1.66 | 4.7 | 8.5 | 19.8 | 1.33 | 4.0 | 11.0 |
//! | CIECAM16-UCS | 1.03 | 3.4 | 3.3 | 6.7 | 1.10 | 3.0 | 5.2 |
//! | Oklab | **0.76** | **2.0** | **1.6** | **3.3** | **0.93** | **2.5** | **4.5** |
//!
//! CIELAB turns blues to purple. Oklab is best in every column, and cheap: a mapping is the smallest root of six cubics. (It was
//! fitted to the second data set, among others; the first is independent of it.)
//!
//! On interference colors: of 600 free films in D65, of index 4/3 and 2.4 and 5 to 1500 nm thick, 126 lie outside sRGB. By the
//! hue angle of CIECAM16, which none of the mappings was made with, clipping turns them by 3.7° on average (12° at most), mixing
//! with white by 1.1° (6.8°), Oklab by 0.7° (5.6°). Both are computed again by `tests/gamut` of this crate.

mod perceptual;
mod report;

use colorimetry::Display;
use colorimetry::matrix::times;

use super::{DevelopSettings, LinearImage};
use crate::develop::quantize::black_rgb;
use perceptual::Perceptual;

pub use report::GamutReport;

/// What becomes of colors that the display cannot show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GamutMapping {
    /// They stay as they are, for files that can hold them. In codes they are clipped.
    Keep,
    /// Each channel is clipped. Fast, and exact in what it can show of each channel; hues turn toward the primaries.
    Clip,
    /// Mixed with the gray of the same luminance until the display shows them. Chromaticity moves straight toward the
    /// display's white, which keeps luminance but not always hue: blues turn to purple.
    TowardWhite,
    /// Chroma is taken away along a line of constant hue and lightness in Oklab.
    #[default]
    Perceptual,
}

/// How far an amount may lie below the least, and above the largest, that a display gives, and count as inside: a third of an
/// 8-bit code of sRGB at the black, a ninth at the white. The white of D65 itself lies 3e-4 beside that of a display whose
/// standard rounds it to four decimals.
const BELOW: f64 = 1e-4;
/// See [`BELOW`].
const ABOVE: f64 = 1e-3;

/// What a display shows: amounts of red, green and blue, its black included, from `low` to `high`.
#[derive(Clone, Debug, PartialEq)]
pub struct Gamut {
    low: [f64; 3],
    high: [f64; 3],
    /// Luminance of an amount of each.
    luminance: [f64; 3],
    perceptual: Perceptual,
}

impl Gamut {
    /// What `display` shows.
    pub fn new(display: &Display) -> Self {
        let low = black_rgb(display);
        Self {
            low,
            high: low.map(|v| v + display.peak()),
            luminance: display.xyz_from_rgb()[1],
            perceptual: Perceptual::new(display),
        }
    }

    /// Whether the display shows this color. What is not a number is no color, and none that it shows.
    pub fn contains(&self, rgb: [f64; 3]) -> bool {
        (0..3).all(|i| rgb[i] >= self.low[i] - BELOW && rgb[i] <= self.high[i] + ABOVE)
    }

    /// The color that the display shows for `rgb`. A color that it can show is not changed.
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

    /// Each channel clipped; what is not a number is the least.
    fn clipped(&self, rgb: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| rgb[i].max(self.low[i]).min(self.high[i]))
    }

    /// The lowest and the highest gray that the display shows, as an amount of each channel.
    fn grays(&self) -> [f64; 2] {
        [
            self.low.into_iter().fold(f64::NEG_INFINITY, f64::max),
            self.high.into_iter().fold(f64::INFINITY, f64::min),
        ]
    }

    /// g + t (rgb − Y) with g the gray of luminance Y, or the nearest gray there is, and the largest t that the display shows.
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

/// Maps every pixel into the display's gamut, and marks those outside it where that is asked for.
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

/// Diagonal stripes, black and white, four pixels wide: no picture has them, whatever its colors.
fn stripe([x, y]: [usize; 2]) -> [f64; 3] {
    if (x + y) / 4 % 2 == 0 {
        [0.0; 3]
    } else {
        [1.0; 3]
    }
}

/// XYZ of amounts of a display's primaries.
fn xyz_of(display: &Display, rgb: [f64; 3]) -> [f64; 3] {
    times(display.xyz_from_rgb(), rgb)
}

#[cfg(test)]
mod tests;
