//! Plots of the spectra of pixels.

use crate::picture::{self, Drawing, Drawn, FAINT, INK, Scale, decimals, draw_title, round_range};
use crate::plot::{draw_spectrum, ink};
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
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
        let at = |x: f64, y: f64| (scale.px(x), scale.px(y));
        let style = scale.text(13.0).pos(Pos::new(HPos::Left, VPos::Center));
        for (index, series) in self.series.iter().enumerate() {
            let y = 22.0 + 26.0 * index as f64;
            let stroke = scale.line(ink(index, self.series.len()), 2.5);
            area.draw(&PathElement::new(vec![at(0.0, y), at(20.0, y)], stroke))?;
            if let Some([r, g, b]) = series.codes {
                let swatch = [at(27.0, y - 9.0), at(55.0, y + 9.0)];
                area.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
            }
            area.draw(&Text::new(series.label.clone(), at(62.0, y), style.clone()))?;
        }
        Ok(())
    }
}

/// Maximum number of labels on the axes.
const X_LABELS: usize = 9;
const Y_LABELS: usize = 7;

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
        // A power of ten in the axis title keeps the labels short.
        let exponent = match high.max(-low) {
            size if size > 0.0 => (3.0 * (size.log10() / 3.0).floor()) as i32,
            _ => 0,
        };
        let unit = 10.0_f64.powi(exponent);
        let (bottom, top) = round_range(low / unit, high / unit);
        let (first, last) = (self.bands.min_nm(), self.bands.max_nm());
        let name = match exponent {
            0 => self.quantity.clone(),
            _ => format!("{} × 1e{exponent}", self.quantity),
        };
        let mut chart = ChartBuilder::on(&panel)
            .margin_top(scale.px(8.0))
            .margin_left(scale.px(14.0))
            .margin_right(scale.px(12.0))
            .set_label_area_size(LabelAreaPosition::Left, scale.px(66.0))
            .set_label_area_size(LabelAreaPosition::Bottom, scale.px(44.0))
            .build_cartesian_2d(first..last, bottom..top)?;
        let x_decimals = decimals(first, last, X_LABELS, 0);
        let y_decimals = decimals(bottom, top, Y_LABELS, 0);
        chart
            .configure_mesh()
            .axis_style(scale.line(INK, 1.0))
            .bold_line_style(scale.line(FAINT, 0.8))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(scale.px(4.0))
            .label_style(scale.text(13.0))
            .axis_desc_style(scale.text(14.0))
            .x_desc("wavelength in vacuum / nm")
            .y_desc(name)
            .x_labels(X_LABELS)
            .y_labels(Y_LABELS)
            .x_label_formatter(&|nm| format!("{nm:.x_decimals$}"))
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .draw()?;
        draw_spectrum(
            &chart.plotting_area().strip_coord_spec(),
            scale,
            (first, last),
        )?;
        for (index, series) in self.series.iter().enumerate() {
            let color = ink(index, self.series.len());
            let shown = |(nm, value): (f64, f64)| (nm, value / unit);
            if let Some(deviation) = &series.deviation {
                for (band, (value, half)) in (0..).zip(series.values.iter().zip(deviation)) {
                    let nm = self.bands.center_nm(band);
                    let bar = [(nm, value - half), (nm, value + half)].map(shown);
                    let style = scale.line(color, 0.8);
                    chart.draw_series(LineSeries::new(bar, style))?;
                }
            }
            let points = self.steps(&series.values).into_iter().map(shown);
            chart.draw_series(LineSeries::new(points, scale.line(color, 1.8)))?;
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
