//! Plots of R, T and A of a stack over wavelength, with the color at each angle.

use crate::response::{Angle, absorptance};
use crate::stack_color::{Color, Polarization, Side, View};
use optics::batch::Powers;
use picture_file::RgbImage8;
use plot::{CurveName, Over, Panel, PanelPlot, Swatch, Vertical};

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
    pub const MAX_CURVES: usize = PanelPlot::MAX_CURVES;

    /// Draws the plot as the text of an SVG file.
    pub fn svg(&self) -> String {
        self.drawing().svg()
    }

    /// Draws the plot as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        self.drawing().pixels()
    }

    /// The quantities with something to show; an A that is a rounding error is not shown.
    fn quantities(&self) -> Vec<Quantity> {
        let all = [
            Quantity {
                name: "reflectance R",
                of: |p| p.reflectance,
                least: 1e-9,
            },
            Quantity {
                name: "transmittance T",
                of: |p| p.transmittance,
                least: 1e-9,
            },
            Quantity {
                name: "absorptance A",
                of: absorptance,
                least: self.rounding,
            },
        ];
        let is_seen = |quantity: &Quantity| self.extent(quantity).1 > quantity.least;
        all.into_iter().filter(is_seen).collect()
    }

    fn values<'a>(
        &'a self,
        quantity: &'a Quantity,
        curve: &'a Curve,
    ) -> impl Iterator<Item = f64> + 'a {
        let value = |powers: &Powers| self.view.polarization.of((quantity.of)(*powers)).max(0.0);
        curve.powers.iter().map(value)
    }

    fn extent(&self, quantity: &Quantity) -> (f64, f64) {
        let values = self
            .curves
            .iter()
            .flat_map(|curve| self.values(quantity, curve));
        values.fold((f64::INFINITY, 0.0), |(low, high), v| {
            (v.min(low), v.max(high))
        })
    }

    /// What is drawn.
    fn drawing(&self) -> PanelPlot {
        let is_clipped =
            |curve: &Curve| curve.color.is_some_and(|c| !c.is_in_srgb(self.exposure_ev));
        let note = self.curves.iter().any(is_clipped);
        PanelPlot {
            title: self.title.clone(),
            over: Over::Wavelengths(self.wavelengths_nm.clone()),
            panels: self.quantities().iter().map(|q| self.panel(q)).collect(),
            heading: self.heading().into(),
            names: self.curves.iter().map(|curve| self.name(curve)).collect(),
            note: note.then(|| "* clipped to sRGB".to_owned()),
        }
    }

    fn panel(&self, quantity: &Quantity) -> Panel {
        let (low, high) = self.extent(quantity);
        let values = |curve| self.values(quantity, curve).collect();
        Panel {
            name: quantity.name.to_owned(),
            range: Vertical::AtLeast(low, high.min(1.0)),
            curves: self.curves.iter().map(values).collect(),
        }
    }

    /// The angle of a curve and its color.
    fn name(&self, curve: &Curve) -> CurveName {
        let swatch = |color: Color| {
            let is_shown = color.is_in_srgb(self.exposure_ev);
            let clipped = if is_shown { "" } else { "*" };
            Swatch {
                codes: color.srgb8(self.exposure_ev),
                label: format!("{}{clipped}", color.hex(self.exposure_ev)),
            }
        };
        CurveName {
            name: format!("{}°", curve.angle.degrees()),
            swatch: curve.color.map(swatch),
        }
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

/// Returns a polarization in words.
pub(crate) fn polarization(polarization: Polarization) -> &'static str {
    match polarization {
        Polarization::Unpolarized => "unpolarized light",
        Polarization::S => "s-polarized light",
        Polarization::P => "p-polarized light",
    }
}

/// Returns an exposure in words.
pub(crate) fn exposure(ev: f64) -> String {
    if ev == 0.0 {
        "0 EV".to_owned()
    } else {
        format!("{ev:+} EV")
    }
}

/// A quantity over wavelength.
struct Quantity {
    name: &'static str,
    of: fn(Powers) -> optics::Polarized,
    /// It is shown if it exceeds this somewhere.
    least: f64,
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
            assert_eq!(picture.width(), 1800);
            assert!(picture.height() as usize >= 2 * (130 + 32 * count));
        }
    }
}
