//! Legends: for each curve its line, its name, and a color swatch.

use crate::picture::{Drawn, Scale};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A color next to the name of a curve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Swatch {
    /// The codes of the color.
    pub codes: [u8; 3],
    /// What is written after it.
    pub label: String,
}

/// Where the parts of a legend's rows are, in units.
pub(crate) struct Columns {
    /// Length of the lines, which start at the left.
    pub(crate) line: f64,
    /// Start of the names that stand before the swatches.
    pub(crate) name: f64,
    /// Left and right end of the swatches.
    pub(crate) swatch: (f64, f64),
    /// Half of their height.
    pub(crate) half: f64,
    /// Start of the texts that stand after the swatches.
    pub(crate) text: f64,
}

/// A row of a legend; what is `None` is left out.
pub(crate) struct Row<'a> {
    pub(crate) ink: RGBColor,
    /// The text before the swatch.
    pub(crate) name: Option<&'a str>,
    /// The codes of the swatch.
    pub(crate) codes: Option<[u8; 3]>,
    /// The text after the swatch.
    pub(crate) text: Option<&'a str>,
}

impl Columns {
    /// Draws a row around a height.
    pub(crate) fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
        y: f64,
        row: &Row<'_>,
    ) -> Drawn<B> {
        let ends = vec![scale.at(0.0, y), scale.at(self.line, y)];
        area.draw(&PathElement::new(ends, scale.line(row.ink, 2.5)))?;
        let write = |text: &str, x: f64, units: f64| {
            let style = scale.text_from(units);
            area.draw(&Text::new(text.to_owned(), scale.at(x, y), style))
        };
        if let Some(name) = row.name {
            write(name, self.name, 14.0)?;
        }
        if let Some([r, g, b]) = row.codes {
            let (left, right) = self.swatch;
            let corners = [
                scale.at(left, y - self.half),
                scale.at(right, y + self.half),
            ];
            area.draw(&Rectangle::new(corners, RGBColor(r, g, b).filled()))?;
        }
        row.text.map_or(Ok(()), |text| write(text, self.text, 13.0))
    }
}

/// Color of one of `count` curves: those of Okabe and Ito (2008), which color-blind people can distinguish, or from violet to yellow.
pub(crate) fn ink(index: usize, count: usize) -> RGBColor {
    const FEW: [RGBColor; 7] = [
        RGBColor(0, 114, 178),
        RGBColor(213, 94, 0),
        RGBColor(0, 158, 115),
        RGBColor(204, 121, 167),
        RGBColor(230, 159, 0),
        RGBColor(86, 180, 233),
        RGBColor(0, 0, 0),
    ];
    if count <= FEW.len() {
        return FEW[index];
    }
    let along = index as f64 / (count - 1) as f64;
    let HSLColor(h, s, l) = HSLColor(0.78 - 0.66 * along, 0.75, 0.42);
    let (r, g, b) = HSLColor(h, s, l).rgb();
    RGBColor(r, g, b)
}
