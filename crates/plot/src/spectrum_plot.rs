//! Plots of the spectra of pixels.

use crate::axes::{Axes, Axis, Labels, Plane, round_range};
use crate::legend::{Columns, Row, ink};
use crate::picture::{self, Drawing, Drawn, Scale};
use crate::title::draw_title;
use crate::wavelengths::{self, draw_colors};
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;
use spectra::BandGrid;

/// A plot of radiance over wavelength: each band's mean as a step, with its noise around it.
#[derive(Clone, Debug)]
pub struct SpectrumPlot {
    /// Title above the plot.
    pub title: String,
    /// Quantity on the vertical axis.
    pub quantity: String,
    /// The bands.
    pub bands: BandGrid,
    /// The spectra, at most [`SpectrumPlot::MAX_SERIES`].
    pub series: Vec<Series>,
}

/// A spectrum in a plot.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name.
    pub label: String,
    /// The mean over each band.
    pub values: Vec<f64>,
    /// The standard deviation of each mean, if known.
    pub deviation: Option<Vec<f64>>,
    /// Its color on a display, for the swatch next to its name.
    pub codes: Option<[u8; 3]>,
}

impl SpectrumPlot {
    /// The most spectra that can be distinguished.
    pub const MAX_SERIES: usize = 16;

    /// Draws the plot as the text of an SVG file.
    pub fn svg(&self) -> String {
        picture::svg(self)
    }

    /// Draws the plot as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        picture::pixels(self)
    }

    /// Range of values and noise, including 0.
    fn extent(&self) -> (f64, f64) {
        let ends = |series: &Series| -> Vec<f64> {
            let half = |band: usize| series.deviation.as_ref().map_or(0.0, |d| d[band]);
            let numbered = series.values.iter().enumerate();
            numbered
                .flat_map(|(band, v)| [v - half(band), v + half(band)])
                .collect()
        };
        let all = self.series.iter().flat_map(ends).filter(|v| v.is_finite());
        all.fold((0.0, 0.0), |(low, high), v: f64| (v.min(low), v.max(high)))
    }

    /// The corners of the steps of all bands, from the left.
    fn steps(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let corners = |(band, &value): (u32, &f64)| {
            [0.0, 1.0].map(|end| (self.bands.wavelength_nm(band, end), value))
        };
        (0..)
            .zip(values)
            .flat_map(corners)
            .filter(|(_, v)| v.is_finite())
            .collect()
    }

    fn draw_legend<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
    ) -> Drawn<B> {
        for (index, series) in self.series.iter().enumerate() {
            let row = Row {
                ink: ink(index, self.series.len()),
                name: None,
                codes: series.codes,
                text: Some(&series.label),
            };
            COLUMNS.draw(area, scale, 22.0 + 26.0 * index as f64, &row)?;
        }
        Ok(())
    }

    /// Draws a spectrum and its noise in parts of `unit`.
    fn draw_series<B: DrawingBackend>(
        &self,
        chart: &mut ChartContext<'_, B, Plane>,
        scale: Scale,
        unit: f64,
        index: usize,
    ) -> Drawn<B> {
        let series = &self.series[index];
        let color = ink(index, self.series.len());
        let shown = |(nm, value): (f64, f64)| (nm, value / unit);
        let deviations = series.deviation.iter().flatten();
        for (band, (value, half)) in (0..).zip(series.values.iter().zip(deviations)) {
            let nm = self.bands.center_nm(band);
            let bar = [(nm, value - half), (nm, value + half)].map(shown);
            chart.draw_series(LineSeries::new(bar, scale.line(color, 0.8)))?;
        }
        let points = self.steps(&series.values).into_iter().map(shown);
        chart.draw_series(LineSeries::new(points, scale.line(color, 1.8)))?;
        Ok(())
    }
}

/// The legend.
const COLUMNS: Columns = Columns {
    line: 20.0,
    name: 0.0,
    swatch: (27.0, 55.0),
    half: 9.0,
    text: 62.0,
};

/// The power of ten in an axis title that keeps the labels short.
fn exponent((low, high): (f64, f64)) -> i32 {
    match high.max(-low) {
        size if size > 0.0 => (3.0 * (size.log10() / 3.0).floor()) as i32,
        _ => 0,
    }
}

impl Drawing for SpectrumPlot {
    fn size(&self) -> (u32, u32) {
        (980, (60 + 26 * self.series.len() as u32).max(420))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(scale.px(38.0));
        draw_title(&head, scale, &self.title)?;
        let (panel, legend) = body.split_horizontally(scale.px(740.0));
        let (low, high) = self.extent();
        let exponent = exponent((low, high));
        let unit = 10.0_f64.powi(exponent);
        let name = match exponent {
            0 => self.quantity.clone(),
            _ => format!("{} × 1e{exponent}", self.quantity),
        };
        let ends_nm = (self.bands.min_nm(), self.bands.max_nm());
        let axes = Axes {
            x: wavelengths::axis(ends_nm),
            y: Axis {
                range: round_range(low / unit, high / unit),
                name: &name,
                labels: Labels {
                    most: 7,
                    decimals: 0,
                },
            },
            y_step: None,
            names_x: true,
            grid: true,
            above: 8.0,
            right: 12.0,
            below: 44.0,
        };
        let mut chart = axes.on(&panel, scale)?;
        axes.draw(&mut chart, scale)?;
        draw_colors(&chart.plotting_area().strip_coord_spec(), scale, ends_nm)?;
        for index in 0..self.series.len() {
            self.draw_series(&mut chart, scale, unit, index)?;
        }
        self.draw_legend(&legend, scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(scale: f64) -> SpectrumPlot {
        let bands = BandGrid::visible(40).unwrap();
        let series = |label: &str, at: f64| Series {
            label: label.to_owned(),
            values: (0..40)
                .map(|b| scale * (-(f64::from(b) - at).powi(2) / 50.0).exp())
                .collect(),
            deviation: Some(vec![0.05 * scale; 40]),
            codes: Some([200, 30, 90]),
        };
        SpectrumPlot {
            title: "bubble.exr".to_owned(),
            quantity: "radiance / W m⁻² sr⁻¹ nm⁻¹".to_owned(),
            bands,
            series: vec![series("320,200", 10.0), series("100,50", 25.0)],
        }
    }

    #[test]
    fn what_is_shown_is_labeled() {
        let svg = plot(0.3).svg();
        for words in [
            "bubble.exr",
            "320,200",
            "100,50",
            "wavelength in vacuum",
            "× 1e-3",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!plot(5.0).svg().contains("× 1e"));
    }

    #[test]
    fn the_picture_is_the_same_each_time_and_has_the_swatch() {
        let plot = plot(0.3);
        let picture = plot.pixels();
        assert_eq!(picture, plot.pixels());
        let of_swatch = picture
            .data()
            .chunks(3)
            .filter(|pixel| **pixel == [200, 30, 90]);
        assert!(of_swatch.count() > 2000);
    }

    /// Black pixels and NaN pixels can be drawn too.
    #[test]
    fn anything_can_be_drawn() {
        for scale in [0.0, f64::NAN, 1e30, 1e-30, -1.0] {
            let picture = plot(scale).pixels();
            assert_eq!((picture.width(), picture.height()), (1960, 840));
        }
    }
}
