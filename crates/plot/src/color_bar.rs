//! A picture in false colors with the scale of its colors below it.

use crate::picture::{self, Drawing, Drawn, INK, Scale};
use crate::sheet::Sheet;
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Height of the scale with its labels, in units; a unit is two pixels.
const UNITS: u32 = 56;
/// The least width of the scale, in units: less has no room for the labels.
const LEAST: u32 = 170;
/// Space at both sides of the bar, for half a label.
const MARGIN: f64 = 22.0;
/// Top and bottom of the bar.
const BAR: [f64; 2] = [20.0, 36.0];

/// The scale of the colors of a picture.
pub struct ColorBar<'a> {
    /// What the colors mean, with the unit; above the bar.
    pub title: &'a str,
    /// Labels at places from 0 at the left to 1 at the right; below the bar.
    pub labels: &'a [(f64, String)],
    /// Codes of the color at a place from 0 at the left to 1 at the right, and from 0 at the bottom to 1 at the top.
    pub color: &'a dyn Fn(f64, f64) -> [u8; 3],
}

/// Returns the picture with the scale below it, on white. The codes of the picture do not change; a picture that is narrower than the scale
/// is at the left.
pub fn with_color_bar(picture: &RgbImage8, bar: &ColorBar<'_>) -> Option<RgbImage8> {
    let width = picture.width().div_ceil(2).max(LEAST);
    let drawn = picture::pixels(&Strip { bar, width });
    let height = picture.height().checked_add(drawn.height())?;
    let whole = picture.width().max(drawn.width());
    let mut sheet = Sheet::new(whole, height, [255; 3]);
    sheet.put(picture, (0, 0), picture.width());
    sheet.put(&drawn, (0, picture.height()), whole);
    sheet.finish()
}

/// The scale, this many units wide.
struct Strip<'a> {
    bar: &'a ColorBar<'a>,
    width: u32,
}

impl Drawing for Strip<'_> {
    fn size(&self) -> (u32, u32) {
        (self.width, UNITS)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        area.fill(&WHITE)?;
        let title = Text::new(
            self.bar.title,
            scale.at(MARGIN, 10.0),
            scale.text_from(11.0),
        );
        area.draw(&title)?;
        let length = f64::from(self.width) - 2.0 * MARGIN;
        self.paint(area, scale, length)?;
        let below = scale.text(11.0).pos(Pos::new(HPos::Center, VPos::Top));
        for (share, label) in self.bar.labels {
            let x = MARGIN + share * length;
            let tick = vec![scale.at(x, BAR[1]), scale.at(x, BAR[1] + 4.0)];
            area.draw(&PathElement::new(tick, scale.line(INK, 1.0)))?;
            let place = scale.at(x, BAR[1] + 5.0);
            area.draw(&Text::new(label.clone(), place, below.clone()))?;
        }
        Ok(())
    }
}

impl Strip<'_> {
    /// Paints the colors in squares of half a unit.
    fn paint<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
        length: f64,
    ) -> Drawn<B> {
        let (columns, rows) = ((2.0 * length) as u32, (2.0 * (BAR[1] - BAR[0])) as u32);
        let middle = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
        for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
            let [r, g, b] = (self.bar.color)(middle(i, columns), 1.0 - middle(j, rows));
            let corner =
                |i: u32, j: u32| scale.at(MARGIN + 0.5 * f64::from(i), BAR[0] + 0.5 * f64::from(j));
            let square = [corner(i, j), corner(i + 1, j + 1)];
            area.draw(&Rectangle::new(square, RGBColor(r, g, b).filled()))?;
        }
        let ends = [scale.at(MARGIN, BAR[0]), scale.at(MARGIN + length, BAR[1])];
        area.draw(&Rectangle::new(ends, scale.line(INK, 0.5)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_is_below_the_picture_with_its_labels() {
        let labels = [(0.0, "-1".to_owned()), (1.0, "1".to_owned())];
        let bar = ColorBar {
            title: "S1",
            labels: &labels,
            color: &|x, y| [(255.0 * x).round() as u8, (255.0 * y).round() as u8, 7],
        };
        for (width, whole) in [(801, 802), (31, 340)] {
            let picture = RgbImage8::new(width, 40, vec![9; 3 * 40 * width as usize]).unwrap();
            let found = with_color_bar(&picture, &bar).unwrap();
            assert_eq!((found.width(), found.height()), (whole, 40 + 112));
            assert_eq!(found.pixel(width - 1, 39), Some([9; 3]));
            let at = |x: u32, y: u32| found.pixel(x, 40 + y).unwrap();
            // Inside the bar red rises to the right, green to the top.
            let (left, right, low) = (at(50, 50), at(whole - 50, 50), at(50, 68));
            assert!(
                left[0] + 150 < right[0] && low[1] + 80 < left[1],
                "{left:?} {low:?}"
            );
            assert_eq!(left[2], 7);
            // There is ink in the title, and in a label at each end, on white.
            let has_ink = |x: [u32; 2], y: [u32; 2]| {
                (x[0]..x[1]).any(|x| (y[0]..y[1]).any(|y| at(x, y)[0] < 100))
            };
            assert!(has_ink([40, 80], [8, 32]), "title");
            assert!(has_ink([30, 60], [84, 108]) && has_ink([whole - 60, whole - 30], [84, 108]));
            assert!(!has_ink([100, whole - 100], [84, 108]));
            assert_eq!(at(2, 2), [255; 3]);
        }
    }
}
