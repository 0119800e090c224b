//! Curves over wavelength in panels, one above another.

use crate::axes::{Axes, Axis, Labels, round_range};
use crate::legend::{Columns, Row, Swatch, ink};
use crate::picture::{self, Drawing, Drawn, Scale};
use crate::title::draw_title;
use crate::wavelengths::{self, draw_colors};
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;

/// A plot of several quantities over wavelength: a panel for each quantity, with the same curves in each.
#[derive(Clone, Debug)]
pub struct PanelPlot {
    /// Title above the plot.
    pub title: String,
    /// The wavelengths, nm, ascending, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// The panels, from the top.
    pub panels: Vec<Panel>,
    /// Lines above the legend; there is room for three.
    pub heading: Vec<String>,
    /// The names of the curves, at most [`PanelPlot::MAX_CURVES`].
    pub names: Vec<CurveName>,
    /// A line below the legend.
    pub note: Option<String>,
}

/// A quantity over wavelength.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Its name.
    pub name: String,
    /// What the vertical axis covers at least: it ends at round numbers.
    pub range: (f64, f64),
    /// The values of each curve, one per wavelength.
    pub curves: Vec<Vec<f64>>,
}

/// A row of the legend.
#[derive(Clone, Debug)]
pub struct CurveName {
    /// The name of the curve.
    pub name: String,
    /// The color next to it.
    pub swatch: Option<Swatch>,
}

impl PanelPlot {
    /// The most curves that can be distinguished.
    pub const MAX_CURVES: usize = 16;

    /// Draws the plot as the text of an SVG file.
    pub fn svg(&self) -> String {
        picture::svg(self)
    }

    /// Draws the plot as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        picture::pixels(self)
    }

    fn ends_nm(&self) -> (f64, f64) {
        let nm = &self.wavelengths_nm;
        (nm[0], nm[nm.len() - 1])
    }

    fn draw_panel<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
        panel: &Panel,
        is_last: bool,
    ) -> Drawn<B> {
        let (low, high) = panel.range;
        let axes = Axes {
            x: wavelengths::axis(self.ends_nm()),
            y: Axis {
                range: round_range(low, high),
                name: &panel.name,
                labels: Labels {
                    most: 6,
                    decimals: 2,
                },
            },
            names_x: is_last,
            grid: true,
            above: 8.0,
            right: 12.0,
            below: if is_last { 40.0 } else { 12.0 },
        };
        let mut chart = axes.on(area, scale)?;
        axes.draw(&mut chart, scale)?;
        if is_last {
            let inside = chart.plotting_area().strip_coord_spec();
            draw_colors(&inside, scale, self.ends_nm())?;
        }
        for (index, curve) in panel.curves.iter().enumerate() {
            let points = self
                .wavelengths_nm
                .iter()
                .copied()
                .zip(curve.iter().copied());
            let style = scale.line(ink(index, panel.curves.len()), 1.8);
            chart.draw_series(LineSeries::new(points, style))?;
        }
        Ok(())
    }

    fn draw_legend<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
    ) -> Drawn<B> {
        let write = |text: &str, y: f64, units: f64| {
            let style = scale.text_from(units);
            area.draw(&Text::new(text.to_owned(), scale.at(0.0, y), style))
        };
        for (line, text) in self.heading.iter().enumerate() {
            write(text, 20.0 + 18.0 * line as f64, 13.0)?;
        }
        let height = |row: usize| 88.0 + 32.0 * row as f64;
        for (index, curve) in self.names.iter().enumerate() {
            let row = Row {
                ink: ink(index, self.names.len()),
                name: Some(&curve.name),
                codes: curve.swatch.as_ref().map(|swatch| swatch.codes),
                text: curve.swatch.as_ref().map(|swatch| swatch.label.as_str()),
            };
            COLUMNS.draw(area, scale, height(index), &row)?;
        }
        match &self.note {
            Some(note) => write(note, height(self.names.len()), 12.0),
            None => Ok(()),
        }
    }
}

/// The legend.
const COLUMNS: Columns = Columns {
    line: 22.0,
    name: 30.0,
    swatch: (78.0, 122.0),
    half: 12.0,
    text: 130.0,
};

impl Drawing for PanelPlot {
    fn size(&self) -> (u32, u32) {
        let legend = 130 + 32 * self.names.len() as u32;
        (900, (90 + 190 * self.panels.len() as u32).max(legend))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(scale.px(38.0));
        draw_title(&head, scale, &self.title)?;
        let (panels, legend) = body.split_horizontally(scale.px(700.0));
        let count = self.panels.len();
        // The last panel has the axis below it, and is higher by that much.
        let axis = scale.px(28.0);
        let height = (panels.dim_in_pixel().1 as i32 - axis) / count.max(1) as i32;
        let cuts: Vec<i32> = (1..count as i32).map(|i| i * height).collect();
        let areas = panels.split_by_breakpoints::<i32, i32, _, _>(&[], &cuts);
        for (index, (panel, area)) in self.panels.iter().zip(&areas).enumerate() {
            self.draw_panel(area, scale, panel, index + 1 == count)?;
        }
        self.draw_legend(&legend, scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(curves: usize) -> PanelPlot {
        let panel = |name: &str| Panel {
            name: name.to_owned(),
            range: (0.0, 0.9),
            curves: vec![vec![0.2, 0.9, 0.4]; curves],
        };
        let name = |index: usize| CurveName {
            name: format!("{index}°"),
            swatch: Some(Swatch {
                codes: [200, 30, 90],
                label: "#c81e5a".to_owned(),
            }),
        };
        PanelPlot {
            title: "a stack".to_owned(),
            wavelengths_nm: vec![380.0, 500.0, 780.0],
            panels: vec![panel("reflectance"), panel("transmittance")],
            heading: vec!["unpolarized light".to_owned()],
            names: (0..curves).map(name).collect(),
            note: Some("a note".to_owned()),
        }
    }

    #[test]
    fn what_is_shown_is_labeled() {
        let svg = plot(2).svg();
        for words in [
            "a stack",
            "reflectance",
            "transmittance",
            "wavelength in vacuum / nm",
            "unpolarized light",
            "1°",
            "#c81e5a",
            "a note",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert_eq!(svg.matches("wavelength in vacuum").count(), 1);
    }

    #[test]
    fn there_is_room_for_all_curves() {
        for count in [1, 7, 8, PanelPlot::MAX_CURVES] {
            let plot = plot(count);
            let picture = plot.pixels();
            let size = (picture.width(), picture.height());
            assert_eq!(size, (1800, 2 * plot.size().1));
            let of_swatches = picture.data().chunks(3).filter(|p| **p == [200, 30, 90]);
            assert!(of_swatches.count() > 2000 * count);
        }
    }
}
