//! Plots of R, T and A of a stack over wavelength, with the color at each angle.

use crate::picture::{
    self, Drawing, Drawn, FAINT, INK, Scale, decimals, draw_title, exposure, round_range,
};
use crate::response::{Angle, absorptance};
use crate::stack_color::{Color, Polarization, Side, View};
use colorimetry::srgb;
use optics::batch::Powers;
use picture_file::RgbImage8;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::Color as _;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Maximum number of labels on the axes.
const X_LABELS: usize = 9;
const Y_LABELS: usize = 6;

/// A plot of R, T and A over wavelength, with a curve and a color swatch per angle.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Title above the plot: the stack.
    pub title: String,
    /// The wavelengths, nm, ascending, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// One curve per angle.
    pub curves: Vec<Curve>,
    /// Side and polarization of the swatches; the polarization also applies to the curves.
    pub view: View,
    /// The illuminant of the swatches.
    pub illuminant: String,
    /// The swatches are 2^EV times as bright.
    pub exposure_ev: f64,
    /// An absorptance that stays below this is a rounding error of R + T and is not shown.
    pub rounding: f64,
}

/// The data of one angle.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The angle of incidence.
    pub angle: Angle,
    /// R and T at each wavelength.
    pub powers: Vec<Powers>,
    /// The color; `None` if the stack's data do not cover visible light.
    pub color: Option<Color>,
}

impl Plot {
    /// The most angles that can be distinguished.
    pub const MAX_CURVES: usize = 16;

    /// Draws the plot as the text of an SVG file.
    pub fn svg(&self) -> String {
        picture::svg(self)
    }

    /// Draws the plot as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        picture::pixels(self)
    }

    /// The panels with something to show; an A that is a rounding error is not shown.
    fn panels(&self) -> Vec<Panel> {
        let all = [
            Panel {
                name: "reflectance R",
                of: |p| p.reflectance,
                least: 1e-9,
            },
            Panel {
                name: "transmittance T",
                of: |p| p.transmittance,
                least: 1e-9,
            },
            Panel {
                name: "absorptance A",
                of: absorptance,
                least: self.rounding,
            },
        ];
        let is_seen = |panel: &Panel| self.extent(panel).1 > panel.least;
        all.into_iter().filter(is_seen).collect()
    }

    fn values<'a>(&'a self, panel: &'a Panel, curve: &'a Curve) -> impl Iterator<Item = f64> + 'a {
        let value = |powers: &Powers| self.view.polarization.of((panel.of)(*powers)).max(0.0);
        curve.powers.iter().map(value)
    }

    fn extent(&self, panel: &Panel) -> (f64, f64) {
        let values = self
            .curves
            .iter()
            .flat_map(|curve| self.values(panel, curve));
        values.fold((f64::INFINITY, 0.0), |(low, high), v| {
            (v.min(low), v.max(high))
        })
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
        let (low, high) = self.extent(panel);
        let (bottom, top) = round_range(low, high.min(1.0));
        let (first, last) = self.ends_nm();
        let mut chart = ChartBuilder::on(area)
            .margin_top(scale.px(8.0))
            .margin_left(scale.px(14.0))
            .margin_right(scale.px(12.0))
            .set_label_area_size(LabelAreaPosition::Left, scale.px(66.0))
            .set_label_area_size(
                LabelAreaPosition::Bottom,
                scale.px(if is_last { 40.0 } else { 12.0 }),
            )
            .build_cartesian_2d(first..last, bottom..top)?;
        let x_decimals = decimals(first, last, X_LABELS, 0);
        let y_decimals = decimals(bottom, top, Y_LABELS, 2);
        chart
            .configure_mesh()
            .axis_style(scale.line(INK, 1.0))
            .bold_line_style(scale.line(FAINT, 0.8))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(scale.px(4.0))
            .label_style(scale.text(13.0))
            .axis_desc_style(scale.text(14.0))
            .x_desc(if is_last {
                "wavelength in vacuum / nm"
            } else {
                ""
            })
            .y_desc(panel.name)
            .x_labels(X_LABELS)
            .y_labels(Y_LABELS)
            .x_label_formatter(&|nm| {
                if is_last {
                    format!("{nm:.x_decimals$}")
                } else {
                    String::new()
                }
            })
            .y_label_formatter(&|value| format!("{value:.y_decimals$}"))
            .draw()?;
        if is_last {
            draw_spectrum(
                &chart.plotting_area().strip_coord_spec(),
                scale,
                (first, last),
            )?;
        }
        for (index, curve) in self.curves.iter().enumerate() {
            let values = self.values(panel, curve);
            let points = self.wavelengths_nm.iter().copied().zip(values);
            let style = scale.line(ink(index, self.curves.len()), 1.8);
            chart.draw_series(LineSeries::new(points, style))?;
        }
        Ok(())
    }

    fn draw_legend<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        scale: Scale,
    ) -> Drawn<B> {
        let at = |x: f64, y: f64| (scale.px(x), scale.px(y));
        let middle = |units| scale.text(units).pos(Pos::new(HPos::Left, VPos::Center));
        for (line, text) in self.heading().iter().enumerate() {
            area.draw(&Text::new(
                text.clone(),
                at(0.0, 20.0 + 18.0 * line as f64),
                middle(13.0),
            ))?;
        }
        for (index, curve) in self.curves.iter().enumerate() {
            let y = 88.0 + 32.0 * index as f64;
            let stroke = scale.line(ink(index, self.curves.len()), 2.5);
            area.draw(&PathElement::new(vec![at(0.0, y), at(22.0, y)], stroke))?;
            let angle = format!("{}°", curve.angle.degrees());
            area.draw(&Text::new(angle, at(30.0, y), middle(14.0)))?;
            let Some(color) = curve.color else {
                continue;
            };
            let [r, g, b] = color.srgb8(self.exposure_ev);
            let swatch = [at(78.0, y - 12.0), at(122.0, y + 12.0)];
            area.draw(&Rectangle::new(swatch, RGBColor(r, g, b).filled()))?;
            let clipped = if color.is_in_srgb(self.exposure_ev) {
                ""
            } else {
                "*"
            };
            let code = format!("{}{clipped}", color.hex(self.exposure_ev));
            area.draw(&Text::new(code, at(130.0, y), middle(13.0)))?;
        }
        let is_clipped =
            |curve: &Curve| curve.color.is_some_and(|c| !c.is_in_srgb(self.exposure_ev));
        if self.curves.iter().any(is_clipped) {
            let y = 88.0 + 32.0 * self.curves.len() as f64;
            area.draw(&Text::new("* clipped to sRGB", at(0.0, y), middle(12.0)))?;
        }
        Ok(())
    }

    fn heading(&self) -> [String; 3] {
        let side = match self.view.side {
            Side::Reflected => "reflected",
            Side::Transmitted => "transmitted",
        };
        [
            polarization(self.view.polarization).to_owned(),
            format!("color {side} under {}", self.illuminant),
            format!("shown at exposure {}", exposure(self.exposure_ev)),
        ]
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

/// Returns a polarization in words.
pub(crate) fn polarization(polarization: Polarization) -> &'static str {
    match polarization {
        Polarization::Unpolarized => "unpolarized light",
        Polarization::S => "s-polarized light",
        Polarization::P => "p-polarized light",
    }
}

/// A quantity over wavelength.
struct Panel {
    name: &'static str,
    of: fn(Powers) -> optics::Polarized,
    /// It is shown if it exceeds this somewhere.
    least: f64,
}

impl Drawing for Plot {
    fn size(&self) -> (u32, u32) {
        let legend = 130 + 32 * self.curves.len() as u32;
        (900, (90 + 190 * self.panels().len() as u32).max(legend))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: Scale) -> Drawn<B> {
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(scale.px(38.0));
        draw_title(&head, scale, &self.title)?;
        let (panels, legend) = body.split_horizontally(scale.px(700.0));
        let shown = self.panels();
        // The last panel has the axis below it, and is higher by that much.
        let axis = scale.px(28.0);
        let height = (panels.dim_in_pixel().1 as i32 - axis) / shown.len().max(1) as i32;
        let cuts: Vec<i32> = (1..shown.len() as i32).map(|i| i * height).collect();
        let areas = panels.split_by_breakpoints::<i32, i32, _, _>(&[], &cuts);
        for (index, (panel, area)) in shown.iter().zip(&areas).enumerate() {
            self.draw_panel(area, scale, panel, index + 1 == shown.len())?;
        }
        self.draw_legend(&legend, scale)
    }
}

/// Draws the colors of the wavelengths, as far as a display can show them, in a strip along the lower edge.
pub(crate) fn draw_spectrum<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: Scale,
    (first, last): (f64, f64),
) -> Drawn<B> {
    let (width, height) = area.dim_in_pixel();
    let top = height as i32 - scale.px(6.0);
    let step = scale.px(1.0).max(1);
    for x in (0..width as i32).step_by(step as usize) {
        let nm = first + (last - first) * (f64::from(x) + 0.5) / f64::from(width);
        if !(380.0..=780.0).contains(&nm) {
            continue;
        }
        // One step wider than its own, so that no gap shows between neighbors.
        let strip = [(x, top), ((x + 2 * step).min(width as i32), height as i32)];
        area.draw(&Rectangle::new(strip, color_of(nm).filled()))?;
    }
    Ok(())
}

/// The color of a wavelength, made pale enough for a display.
fn color_of(nm: f64) -> RGBColor {
    let xyz = spectra::observer_1931()
        .each_ref()
        .map(|curve| curve.clamped_at(nm));
    let rgb = srgb::linear_from_xyz(xyz);
    let paleness = rgb
        .into_iter()
        .fold(0.0, |paleness: f64, v| paleness.max(-v));
    let [r, g, b] = rgb.map(|v| srgb::to_u8((v + paleness) / 1.8));
    RGBColor(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Stack, StackColor};

    fn plot(line: &str, angles_deg: &[f64]) -> Plot {
        let stack = Stack::parse(line).unwrap();
        let wavelengths_nm: Vec<f64> = (380..=780).map(f64::from).collect();
        let sampled = stack.sampled(&wavelengths_nm).unwrap();
        let light = Light::named("D65").unwrap();
        let color = StackColor::new(&stack, light, View::default()).unwrap();
        let curve = |&deg: &f64| {
            let angle = Angle::from_degrees(deg).unwrap();
            Curve {
                angle,
                powers: sampled.powers(stack.thicknesses_nm(), angle),
                color: Some(color.at(stack.thicknesses_nm(), angle)),
            }
        };
        Plot {
            title: stack.label(),
            wavelengths_nm,
            curves: angles_deg.iter().map(curve).collect(),
            view: View::default(),
            illuminant: "D65".to_owned(),
            exposure_ev: 0.0,
            rounding: 1e-9,
        }
    }

    #[test]
    fn what_is_shown_is_labeled() {
        let svg = plot("1 | silica 300nm | gold", &[0.0, 60.0]).svg();
        assert!(svg.starts_with("<svg width=\"900\"") && svg.trim_end().ends_with("</svg>"));
        for words in [
            "1 | silica 300 nm | gold",
            "reflectance R",
            "transmittance T",
            "wavelength in vacuum / nm",
            "60°",
            "under D65",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!svg.contains("absorptance A"), "nothing is absorbed");
        assert!(
            plot("1 | gold 20nm | 1.5", &[0.0])
                .svg()
                .contains("absorptance A")
        );
    }

    #[test]
    fn the_picture_is_the_same_each_time_and_has_the_swatch() {
        let plot = plot("1 | silica 300nm | silicon", &[0.0]);
        let picture = plot.pixels();
        assert_eq!(picture, plot.pixels());
        assert_eq!(plot.svg(), plot.svg());
        let codes = plot.curves[0].color.unwrap().srgb8(0.0);
        let of_swatch = picture.data().chunks(3).filter(|pixel| **pixel == codes);
        assert!(of_swatch.count() > 2000);
    }

    /// In `f32`, R + T of a stack that absorbs nothing is 1 up to rounding.
    #[test]
    fn a_rounding_is_no_absorptance() {
        let mut plot = plot("1 | silica 300nm | 1.5", &[0.0]);
        for powers in &mut plot.curves[0].powers {
            powers.reflectance.s -= 3e-5;
        }
        assert!(plot.svg().contains("absorptance A"));
        plot.rounding = 2e-4;
        assert!(!plot.svg().contains("absorptance A"));
    }

    #[test]
    fn any_number_of_angles_is_drawn() {
        for count in [1, 7, 8, Plot::MAX_CURVES] {
            let angles: Vec<f64> = (0..count).map(|i| 5.0 * i as f64).collect();
            let plot = plot("1 | 1.333 300nm | 1", &angles);
            let picture = plot.pixels();
            assert_eq!(
                (picture.width(), picture.height()),
                (1800, 2 * plot.size().1)
            );
        }
    }
}
