//! How many pixels of a picture a display cannot show, and how far they are outside its gamut.

use colorimetry::Lab;
use colorimetry::lab::delta_e_2000;
use rayon::prelude::*;

use super::{Gamut, xyz_of};
use crate::develop::DevelopSettings;
use picture_file::LinearImage;

/// The pixels of a picture that lie outside the gamut of its display, and how far the mapping moves them: ΔE₀₀ between the
/// wanted color and the color shown, under the display's white.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GamutReport {
    /// Number of pixels of the picture.
    pub pixels: usize,
    /// Number of pixels that the display cannot show.
    pub outside: usize,
    /// Number of pixels outside that are brighter than the lightest gray of the display: too bright at any saturation.
    pub too_bright: usize,
    /// Number of pixels outside that are not finite; the figures below exclude them.
    pub not_finite: usize,
    /// Mean ΔE₀₀ of the pixels outside; 0 if there are none.
    pub mean: f64,
    /// Median ΔE₀₀.
    pub median: f64,
    /// 95th percentile of ΔE₀₀.
    pub p95: f64,
    /// Largest ΔE₀₀.
    pub max: f64,
}

impl GamutReport {
    /// Creates the report of a picture that is exposed but not yet mapped.
    pub fn of(image: &LinearImage, settings: &DevelopSettings) -> Self {
        let gamut = Gamut::new(&settings.display);
        let outside: Vec<Outside> = image
            .rgb()
            .par_iter()
            .with_min_len(4096)
            .map(|rgb| rgb.map(f64::from))
            .filter(|&rgb| !gamut.contains(rgb))
            .map(|rgb| Outside::of(rgb, &gamut, settings))
            .collect();
        let mut differences: Vec<f64> = outside.iter().filter_map(|o| o.delta_e).collect();
        differences.sort_by(f64::total_cmp);
        let rank = |share: f64| {
            let last = differences.len().saturating_sub(1) as f64;
            differences
                .get((share * last).round() as usize)
                .copied()
                .unwrap_or_default()
        };
        Self {
            pixels: image.rgb().len(),
            outside: outside.len(),
            too_bright: outside.iter().filter(|o| o.too_bright).count(),
            not_finite: outside.len() - differences.len(),
            mean: differences.iter().sum::<f64>() / differences.len().max(1) as f64,
            median: rank(0.5),
            p95: rank(0.95),
            max: rank(1.0),
        }
    }

    /// The fraction of the pixels that lies outside, 0 to 1.
    pub fn share(&self) -> f64 {
        self.outside as f64 / self.pixels.max(1) as f64
    }
}

/// A pixel outside the gamut.
struct Outside {
    too_bright: bool,
    /// `None` if it is not finite.
    delta_e: Option<f64>,
}

impl Outside {
    fn of(rgb: [f64; 3], gamut: &Gamut, settings: &DevelopSettings) -> Self {
        let display = &settings.display;
        let white = display.white_xyz();
        let lab = |rgb| Lab::from_xyz(xyz_of(display, rgb), white);
        let luminance: f64 = (0..3).map(|i| gamut.luminance[i] * rgb[i]).sum();
        let shown = gamut.clipped(gamut.map(settings.gamut, rgb));
        let delta_e = delta_e_2000(lab(rgb), lab(shown));
        Self {
            too_bright: luminance > gamut.grays()[1],
            delta_e: delta_e.is_finite().then_some(delta_e),
        }
    }
}
