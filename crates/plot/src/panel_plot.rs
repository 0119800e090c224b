//! Curves over wavelength or angle in panels, one above another.

use crate::axes::{Axes, Axis, Labels, round_range};
use crate::legend::{Columns, Row, Swatch, ink};
use crate::picture::{self, Drawing, Drawn, Scale};
use crate::title::draw_title;
use crate::wavelengths::{self, draw_colors};
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;

/// A plot of several quantities over wavelength or angle: a panel for each quantity, with the same curves in each.
#[derive(Clone, Debug)]
pub struct PanelPlot {
    /// Title above the plot.
    pub title: String,
    /// What the horizontal axis shows.
    pub over: Over,
    /// The panels, from the top.
    pub panels: Vec<Panel>,
    /// Lines above the legend; there is room for three.
    pub heading: Vec<String>,
    /// The names of the curves, at most [`PanelPlot::MAX_CURVES`].
    pub names: Vec<CurveName>,
    /// A line below the legend.
    pub note: Option<String>,
}

/// What a horizontal axis shows: ascending values, at least two.
#[derive(Clone, Debug)]
pub enum Over {
    /// Wavelengths, nm.
    Wavelengths(Vec<f64>),
    /// Angles of incidence, degrees.
    Angles(Vec<f64>),
}

/// A quantity over wavelength or angle.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Its name.
    pub name: String,
    /// What the vertical axis covers.
    pub range: Vertical,
    /// The values of each curve, one per value of the horizontal axis. A curve has a gap where they are not finite.
    pub curves: Vec<Vec<f64>>,
}

/// What a vertical axis covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vertical {
    /// From the first to the second number at least: it ends at round ones.
    AtLeast(f64, f64),
    /// Angles from 0 to 90°.
    Quarter,
    /// Angles from 0 to 360°. A curve that leaves at one end comes back at the other.
    Turn,
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

    fn draw_panel<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
        panel: &Panel,
        is_last: bool,
    ) -> Drawn<B> {
        let axes = Axes {
            x: self.over.axis(),
            y: panel.range.axis(&panel.name),
            y_step: panel.range.step(),
            names_x: is_last,
            grid: true,
            above: 8.0,
            right: 12.0,
            below: if is_last { 40.0 } else { 12.0 },
        };
        let mut chart = axes.on(area, scale)?;
        axes.draw(&mut chart, scale)?;
        // A strip would hide curves of angles near 0.
        let has_strip = matches!(self.over, Over::Wavelengths(_)) && panel.range != Vertical::Turn;
        if is_last && has_strip {
            let inside = chart.plotting_area().strip_coord_spec();
            draw_colors(&inside, scale, self.over.ends())?;
        }
        for (index, curve) in panel.curves.iter().enumerate() {
            let style = scale.line(ink(index, panel.curves.len()), 1.8);
            for line in panel.range.lines(self.over.values(), curve) {
                chart.draw_series(LineSeries::new(line, style))?;
            }
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

impl Over {
    fn values(&self) -> &[f64] {
        match self {
            Self::Wavelengths(values) | Self::Angles(values) => values,
        }
    }

    fn ends(&self) -> (f64, f64) {
        let values = self.values();
        (values[0], values[values.len() - 1])
    }

    fn axis(&self) -> Axis<'static> {
        match self {
            Self::Wavelengths(_) => wavelengths::axis(self.ends()),
            Self::Angles(_) => Axis {
                range: self.ends(),
                name: "angle of incidence / °",
                labels: Labels {
                    most: 10,
                    decimals: 0,
                },
            },
        }
    }
}

impl Vertical {
    fn axis(self, name: &str) -> Axis<'_> {
        let (range, decimals) = match self {
            Self::AtLeast(low, high) => (round_range(low, high), 2),
            Self::Quarter => ((0.0, 90.0), 0),
            Self::Turn => ((0.0, 360.0), 0),
        };
        let most = 6;
        let labels = Labels { most, decimals };
        Axis {
            range,
            name,
            labels,
        }
    }

    /// The step between labels; `None` for a round one.
    fn step(self) -> Option<f64> {
        match self {
            Self::AtLeast(..) => None,
            Self::Quarter => Some(15.0),
            Self::Turn => Some(45.0),
        }
    }

    /// The lines of a curve: it is broken where a value is not finite, and where it wraps.
    fn lines(self, x: &[f64], curve: &[f64]) -> Vec<Vec<(f64, f64)>> {
        let mut lines = vec![Vec::new()];
        let mut last: Option<(f64, f64)> = None;
        for (&x, &y) in x.iter().zip(curve) {
            if !y.is_finite() {
                lines.push(Vec::new());
                last = None;
                continue;
            }
            if let Some([leaves, comes]) = last.and_then(|last| self.wrap(last, (x, y))) {
                lines.last_mut().into_iter().for_each(|l| l.push(leaves));
                lines.push(vec![comes]);
            }
            lines.last_mut().into_iter().for_each(|l| l.push((x, y)));
            last = Some((x, y));
        }
        lines.retain(|line| line.len() > 1);
        lines
    }

    /// Where a line from `a` to `b` leaves, and where it comes back, if the shorter way is across the ends of the axis.
    fn wrap(self, a: (f64, f64), b: (f64, f64)) -> Option<[(f64, f64); 2]> {
        if self != Self::Turn || (b.1 - a.1).abs() <= 180.0 {
            return None;
        }
        let (out, back) = if b.1 > a.1 {
            (0.0, 360.0)
        } else {
            (360.0, 0.0)
        };
        let (before, after) = ((out - a.1).abs(), (b.1 - back).abs());
        let along = if before > 0.0 {
            before / (before + after)
        } else {
            0.0
        };
        let x = a.0 + (b.0 - a.0) * along;
        Some([(x, out), (x, back)])
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
            range: Vertical::AtLeast(0.0, 0.9),
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
            over: Over::Wavelengths(vec![380.0, 500.0, 780.0]),
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
    #[test]
    fn angles_have_their_own_axes() {
        let mut plot = plot(1);
        plot.over = Over::Angles(vec![0.0, 40.0, 80.0]);
        for (panel, range) in plot
            .panels
            .iter_mut()
            .zip([Vertical::Quarter, Vertical::Turn])
        {
            panel.range = range;
        }
        let svg = plot.svg();
        assert!(svg.contains("angle of incidence / °") && !svg.contains("wavelength"));
        for label in ["15", "75", "90", "45", "135", "315", "360"] {
            let is_label = |line: &str| line.trim() == label;
            assert!(svg.lines().any(is_label), "{label}");
        }
    }

    #[test]
    fn a_curve_that_wraps_is_broken_at_the_ends_of_its_axis() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let down = [40.0, 10.0, 340.0, 350.0];
        let expected = [
            vec![(0.0, 40.0), (1.0, 10.0), (1.0 + 1.0 / 3.0, 0.0)],
            vec![(1.0 + 1.0 / 3.0, 360.0), (2.0, 340.0), (3.0, 350.0)],
        ];
        assert_eq!(Vertical::Turn.lines(&x, &down), expected);
        let up = Vertical::Turn.lines(&x, &[300.0, 350.0, 0.0, 20.0]);
        assert_eq!(up[0][2], (2.0, 360.0));
        assert_eq!(up[1], [(2.0, 0.0), (2.0, 0.0), (3.0, 20.0)]);
        // Half a turn is a jump, as at Brewster's angle, and other axes do not wrap.
        assert_eq!(Vertical::Turn.lines(&x, &[180.0, 180.0, 0.0, 0.0]).len(), 1);
        assert_eq!(Vertical::AtLeast(0.0, 400.0).lines(&x, &down).len(), 1);
    }

    #[test]
    fn a_curve_has_a_gap_where_it_has_no_value() {
        let curve = [1.0, 2.0, f64::NAN, 4.0, 5.0];
        let lines = Vertical::Quarter.lines(&[0.0, 1.0, 2.0, 3.0, 4.0], &curve);
        assert_eq!(lines, [[(0.0, 1.0), (1.0, 2.0)], [(3.0, 4.0), (4.0, 5.0)]]);
    }
}
