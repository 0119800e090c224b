//! Drawing of pictures, identically as SVG and as pixels, with a bundled font.

use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::sync::Once;

/// Font family of labels: DejaVu Sans, which comes with the program. Viewers of an SVG have it or something similar.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";
/// A pixel of a PNG is the mean of this many by this many, which smooths every edge.
const SUPERSAMPLING: u32 = 3;
/// Steps of the coordinates of an SVG, which are whole numbers, per unit of the drawing.
const SVG_STEPS: u32 = 10;
/// Pixels of a PNG per unit of the drawing.
const PIXELS_PER_UNIT: u32 = 2;

/// A drawing, described in units and drawn in pixels.
pub(crate) trait Drawing {
    /// Width and height in units.
    fn size(&self) -> (u32, u32);

    /// Draws on an area with `scale` pixels per unit.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B>;
}

pub(crate) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Pixels per unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale(pub(crate) u32);

impl Scale {
    /// Returns a length in pixels.
    pub(crate) fn px(self, units: f64) -> i32 {
        (units * f64::from(self.0)).round() as i32
    }

    /// Returns the style of text of this height.
    pub(crate) fn text(self, units: f64) -> TextStyle<'static> {
        TextStyle::from((FONT, units * f64::from(self.0)).into_font()).color(&INK)
    }

    /// Returns the style of text of this height that starts at its place and is centered vertically there.
    pub(crate) fn text_from(self, units: f64) -> TextStyle<'static> {
        self.text(units).pos(Pos::new(HPos::Left, VPos::Center))
    }

    /// Returns a place in pixels.
    pub(crate) fn at(self, x: f64, y: f64) -> (i32, i32) {
        (self.px(x), self.px(y))
    }

    /// Returns the style of a line of this width.
    pub(crate) fn line(self, color: RGBColor, units: f64) -> ShapeStyle {
        color.stroke_width(self.px(units).max(1) as u32)
    }
}

/// Color of lines and labels.
pub(crate) const INK: RGBColor = RGBColor(34, 34, 34);
/// Color of lines in the background.
pub(crate) const FAINT: RGBColor = RGBColor(222, 222, 222);

/// Draws as the text of an SVG file.
pub(crate) fn svg(drawing: &impl Drawing) -> String {
    register_font_once();
    let (width, height) = drawing.size();
    let fine = (width * SVG_STEPS, height * SVG_STEPS);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, fine).into_drawing_area();
        drawn(drawing.draw(&root, Scale(SVG_STEPS)));
        drawn(root.present());
    }
    // The view box keeps the fine steps.
    let size = |(width, height)| format!("width=\"{width}\" height=\"{height}\"");
    text.replacen(&size(fine), &size((width, height)), 1)
}

/// Draws as pixels.
pub(crate) fn pixels(drawing: &impl Drawing) -> RgbImage8 {
    register_font_once();
    let (width, height) = drawing.size();
    let fine = PIXELS_PER_UNIT * SUPERSAMPLING;
    let mut codes = vec![255; 3 * (width * fine) as usize * (height * fine) as usize];
    {
        let size = (width * fine, height * fine);
        let root = BitMapBackend::with_buffer(&mut codes, size).into_drawing_area();
        drawn(drawing.draw(&root, Scale(fine)));
        drawn(root.present());
    }
    smoothed(&codes, (width * PIXELS_PER_UNIT, height * PIXELS_PER_UNIT))
}

/// Unwraps the result of drawing. Drawing on a string or a buffer in memory cannot fail, and the font is registered.
fn drawn<E: std::error::Error + Send + Sync>(result: Result<(), DrawingAreaErrorKind<E>>) {
    if let Err(error) = result {
        unreachable!("a drawing in memory failed: {error}");
    }
}

/// Averages a square of fine pixels for each pixel.
fn smoothed(fine: &[u8], (width, height): (u32, u32)) -> RgbImage8 {
    let n = SUPERSAMPLING as usize;
    let stride = 3 * n * width as usize;
    let mut codes = Vec::with_capacity(3 * (width * height) as usize);
    for y in 0..height as usize {
        for x in 0..width as usize {
            for channel in 0..3 {
                let start = n * y * stride + 3 * n * x + channel;
                let square = (0..n).flat_map(|j| (0..n).map(move |i| start + j * stride + 3 * i));
                let sum: u32 = square.map(|at| u32::from(fine[at])).sum();
                let count = SUPERSAMPLING * SUPERSAMPLING;
                codes.push(((sum + count / 2) / count) as u8);
            }
        }
    }
    match RgbImage8::new(width, height, codes) {
        Some(image) => image,
        None => unreachable!("three codes were made for each pixel"),
    }
}

fn register_font_once() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let is_font = register_font(FONT, FontStyle::Normal, dejavu::sans::regular());
        assert!(is_font.is_ok(), "DejaVu Sans is a font");
    });
}
