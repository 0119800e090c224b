//! Drawing of pictures, identically as SVG and as pixels, with a bundled font.

use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{BoldPoints, Ranged};
use plotters::coord::types::RangedCoordf64;
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

/// Draws the stack above a picture.
pub(crate) fn draw_title<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: Scale,
    title: &str,
) -> Drawn<B> {
    let style = scale.text(16.0).pos(Pos::new(HPos::Left, VPos::Center));
    let place = (scale.px(16.0), scale.px(22.0));
    area.draw(&Text::new(shortened(title), place, style))
}

/// Shortens a stack to fit into a line: a long one keeps its first layers, their number, and the substrate.
fn shortened(title: &str) -> String {
    const MAX: usize = 90;
    let parts: Vec<&str> = title.split(" | ").collect();
    if title.chars().count() <= MAX || parts.len() < 3 {
        return title.chars().take(2 * MAX).collect();
    }
    let (start, layers, end) = (parts[0], parts.len() - 2, parts[parts.len() - 1]);
    let end = format!("… ({layers} layers) | {end}");
    let mut shown = start.to_owned();
    for part in &parts[1..=layers] {
        let length = shown.chars().count() + part.chars().count() + end.chars().count() + 6;
        if length > MAX {
            break;
        }
        shown += &format!(" | {part}");
    }
    format!("{shown} | {end}")
}

/// Returns an exposure in words.
pub(crate) fn exposure(ev: f64) -> String {
    if ev == 0.0 {
        "0 EV".to_owned()
    } else {
        format!("{ev:+} EV")
    }
}

/// Returns a range of round numbers around `low` to `high`, from 0 if the values come near it.
pub(crate) fn round_range(low: f64, high: f64) -> (f64, f64) {
    let low = if low < 0.4 * high { 0.0 } else { low };
    let span = (high - low).max(1e-3);
    let size = 10.0_f64.powf((span / 5.0).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|m| m * size)
        .into_iter()
        .find(|step| span / step <= 5.0)
        .unwrap_or(10.0 * size);
    let first = (low / step + 1e-9).floor() * step;
    let last = (high / step - 1e-9).ceil() * step;
    (first, last.max(first + step))
}

/// Returns the number of decimals for the labels of an axis, at least `least`: as many as their steps have. `most` is the maximum
/// number of labels.
pub(crate) fn decimals(from: f64, to: f64, most: usize, least: usize) -> usize {
    let ticks = RangedCoordf64::from(from..to).key_points(BoldPoints(most));
    let step = ticks
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .fold(to - from, f64::min);
    let is_distinct = |decimals: &usize| {
        let unit = 10.0_f64.powi(*decimals as i32);
        let is_exact = |tick: &f64| ((tick * unit).round() / unit - tick).abs() < 1e-3 * step;
        ticks.iter().all(is_exact)
    };
    (least..12).find(is_distinct).unwrap_or(12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_stack_is_shortened() {
        let many = "1 | ".to_owned() + &"titania 57 nm | silica 94 nm | ".repeat(7) + "bk7";
        let found = shortened(&many);
        assert!(
            found.starts_with("1 | titania 57 nm | silica 94 nm | "),
            "{found}"
        );
        assert!(found.ends_with("… (14 layers) | bk7"), "{found}");
        assert!(found.chars().count() <= 90, "{found}");
        assert_eq!(shortened("1 | 1.5 3 nm | 1"), "1 | 1.5 3 nm | 1");
    }

    #[test]
    fn labels_differ() {
        assert_eq!(decimals(380.0, 780.0, 9, 0), 0);
        assert_eq!(decimals(0.0, 1.0, 6, 2), 2);
        for (from, to) in [(500.0, 502.0), (0.0, 1e-3), (0.92, 0.93), (380.0, 380.001)] {
            let decimals = decimals(from, to, 6, 0);
            let ticks = RangedCoordf64::from(from..to).key_points(BoldPoints(6));
            let labels: std::collections::BTreeSet<String> = ticks
                .iter()
                .map(|tick| format!("{tick:.decimals$}"))
                .collect();
            assert!(labels.len() == ticks.len() && ticks.len() > 2, "{labels:?}");
        }
    }

    #[test]
    fn ranges_are_round_and_hold_their_values() {
        assert_eq!(round_range(0.0, 0.078), (0.0, 0.08));
        assert_eq!(round_range(0.921, 1.0), (0.92, 1.0));
        assert_eq!(round_range(0.0, 0.0).0, 0.0);
        for (low, high) in [(0.3, 0.31), (0.0, 1e-6), (0.5, 0.5), (0.02, 0.97)] {
            let (first, last) = round_range(low, high);
            assert!(
                first <= low && high <= last && first < last,
                "{first} {last}"
            );
        }
    }
}
