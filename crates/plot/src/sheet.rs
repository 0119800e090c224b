//! Contact sheets: pictures side by side, each with a label above it.

use crate::picture::{self, Drawing, Drawn, Scale};
use colorimetry::Display;
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;

/// The largest number of pictures on a sheet on which each can still be seen.
pub const MAX_PICTURES: usize = 36;
/// Pixels around and between pictures.
const GAP: u32 = 12;
/// Height of a label in units; a unit is two pixels.
const LABEL_UNITS: u32 = 20;

/// Codes of the colors around the pictures, for the same display as the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheetColors {
    /// Background of pictures and labels.
    pub ground: [u8; 3],
    /// Text of the labels.
    pub text: [u8; 3],
}

impl SheetColors {
    /// Returns the colors for pictures on a display: white text on a dark ground.
    pub fn on(display: &Display) -> Self {
        Self {
            ground: shade(display, 0.02),
            text: shade(display, 1.0),
        }
    }
}

/// Returns the codes of a fraction of a display's white.
fn shade(display: &Display, share: f64) -> [u8; 3] {
    let responses = display.responses().each_ref();
    responses.map(|response| (255.0 * response.code(share).clamp(0.0, 1.0)).round() as u8)
}

struct Label<'a> {
    text: &'a str,
    width: u32,
    colors: SheetColors,
}

impl Drawing for Label<'_> {
    fn size(&self) -> (u32, u32) {
        (self.width, LABEL_UNITS)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        let rgb = |[r, g, b]: [u8; 3]| RGBColor(r, g, b);
        area.fill(&rgb(self.colors.ground))?;
        let ink = rgb(self.colors.text);
        let style = scale.text_from(13.0).color(&ink);
        let middle = scale.px(0.5 * f64::from(LABEL_UNITS));
        area.draw(&Text::new(self.text, (0, middle), style))
    }
}

/// Makes a contact sheet of pictures of the same size with their labels, in rows from the left, as nearly square as their
/// number allows. The codes of the pictures do not change.
///
/// Returns `None` if there are no pictures, or they differ in size.
pub fn contact_sheet(pictures: &[(String, RgbImage8)], colors: SheetColors) -> Option<RgbImage8> {
    let (_, first) = pictures.first()?;
    let (width, height) = (first.width(), first.height());
    if pictures
        .iter()
        .any(|(_, p)| (p.width(), p.height()) != (width, height))
    {
        return None;
    }
    let columns = (pictures.len() as f64).sqrt().ceil() as u32;
    let rows = (pictures.len() as u32).div_ceil(columns);
    let label = 2 * LABEL_UNITS;
    let (cell_width, cell_height) = (width + GAP, label + height + GAP);
    let mut sheet = Sheet::new(
        columns * cell_width + GAP,
        rows * cell_height + GAP,
        colors.ground,
    );
    for (index, (text, picture)) in (0..).zip(pictures) {
        let x = GAP + (index % columns) * cell_width;
        let y = GAP + (index / columns) * cell_height;
        let units = width.div_ceil(2);
        sheet.put(
            &picture::pixels(&Label {
                text,
                width: units,
                colors,
            }),
            (x, y),
            width,
        );
        sheet.put(picture, (x, y + label), width);
    }
    sheet.finish()
}

/// A picture onto which others are put.
pub(crate) struct Sheet {
    width: u32,
    height: u32,
    codes: Vec<u8>,
}

impl Sheet {
    pub(crate) fn new(width: u32, height: u32, ground: [u8; 3]) -> Self {
        Self {
            width,
            height,
            codes: ground.repeat(width as usize * height as usize),
        }
    }

    /// Copies the left `width` pixels of a picture.
    pub(crate) fn put(&mut self, picture: &RgbImage8, (x, y): (u32, u32), width: u32) {
        let rows = picture.data().chunks(3 * picture.width() as usize);
        for (row, codes) in (y as usize..).zip(rows) {
            let start = 3 * (row * self.width as usize + x as usize);
            let length = 3 * width.min(picture.width()) as usize;
            self.codes[start..start + length].copy_from_slice(&codes[..length]);
        }
    }

    pub(crate) fn finish(self) -> Option<RgbImage8> {
        RgbImage8::new(self.width, self.height, self.codes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: u8 = 40;
    const COLORS: SheetColors = SheetColors {
        ground: [GROUND; 3],
        text: [255; 3],
    };

    fn filled(width: u32, height: u32, code: u8) -> RgbImage8 {
        RgbImage8::new(width, height, vec![code; 3 * (width * height) as usize]).unwrap()
    }

    #[test]
    fn pictures_stand_in_rows_below_their_labels() {
        let pictures: Vec<(String, RgbImage8)> = (1..=3)
            .map(|i| (format!("D{i}5"), filled(61, 30, 100 + i)))
            .collect();
        let sheet = contact_sheet(&pictures, COLORS).unwrap();
        assert_eq!((sheet.width(), sheet.height()), (2 * 73 + 12, 2 * 82 + 12));
        for (index, (x, y)) in [(12, 52), (85, 52), (12, 134)].into_iter().enumerate() {
            let code = 101 + index as u8;
            for (dx, dy) in [(0, 0), (60, 29)] {
                assert_eq!(sheet.pixel(x + dx, y + dy), Some([code; 3]));
            }
            assert_eq!(sheet.pixel(x + 61, y), Some([GROUND; 3]));
            // The label is above the picture.
            let bright = |x, y| sheet.pixel(x, y).is_some_and(|p| p[0] > 200);
            assert!((x..x + 61).any(|x| (y - 40..y).any(|y| bright(x, y))));
        }
        assert_eq!(
            sheet.pixel(85 + 5, 134 + 5),
            Some([GROUND; 3]),
            "an empty position"
        );
    }

    #[test]
    fn the_ground_is_dark_and_the_text_is_white() {
        for name in ["srgb", "crt_1997"] {
            let colors = SheetColors::on(&Display::open(name).unwrap());
            assert_eq!(colors.text, [255; 3]);
            assert!(colors.ground.iter().all(|&code| 0 < code && code < 64));
        }
    }

    #[test]
    fn pictures_of_different_sizes_make_no_sheet() {
        let named = |p| (String::new(), p);
        assert!(contact_sheet(&[], COLORS).is_none());
        assert!(contact_sheet(&[named(filled(4, 4, 0)), named(filled(4, 5, 0))], COLORS).is_none());
        assert!(contact_sheet(&[named(filled(1, 1, 0))], COLORS).is_some());
    }
}
