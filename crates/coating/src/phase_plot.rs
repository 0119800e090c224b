//! Plots of the ellipsometric angles ψ and Δ over wavelength or angle.

use crate::phase::{EllipsometricAngles, PSign};
use picture_file::RgbImage8;
use plot::{CurveName, Over, Panel, PanelPlot, Vertical};

/// A plot of ψ and Δ of reflected light: a curve per angle over wavelength, or a curve per wavelength over angle.
#[derive(Clone, Debug)]
pub struct PhasePlot {
    /// Title above the plot: the stack.
    pub title: String,
    /// What the horizontal axis shows.
    pub over: Over,
    /// The name of each curve (its angle or wavelength, with the unit), at most [`PhasePlot::MAX_CURVES`], and ψ and Δ at each value of
    /// the horizontal axis.
    pub curves: Vec<(String, Vec<EllipsometricAngles>)>,
    /// The sign of r_p.
    pub p_sign: PSign,
}

impl PhasePlot {
    /// The most curves that can be distinguished.
    pub const MAX_CURVES: usize = PanelPlot::MAX_CURVES;

    /// Draws the plot as the text of an SVG file.
    pub fn svg(&self) -> String {
        self.drawing().svg()
    }

    /// Draws the plot as pixels.
    pub fn pixels(&self) -> RgbImage8 {
        self.drawing().pixels()
    }

    fn drawing(&self) -> PanelPlot {
        let name = |(name, _): &(String, _)| CurveName {
            name: name.clone(),
            swatch: None,
        };
        PanelPlot {
            title: self.title.clone(),
            over: self.over.clone(),
            panels: vec![
                self.panel("ψ / °", Vertical::Quarter, |angles| angles.psi_deg),
                self.panel("Δ / °", Vertical::Turn, |angles| angles.delta_deg),
            ],
            heading: self.heading().into(),
            names: self.curves.iter().map(name).collect(),
            note: None,
        }
    }

    /// An angle that is not defined is a gap.
    fn panel(
        &self,
        name: &str,
        range: Vertical,
        of: fn(&EllipsometricAngles) -> Option<f64>,
    ) -> Panel {
        let values = |(_, angles): &(String, Vec<EllipsometricAngles>)| {
            let numbers = angles.iter().map(|at| of(at).unwrap_or(f64::NAN));
            numbers.collect()
        };
        Panel {
            name: name.to_owned(),
            range,
            curves: self.curves.iter().map(values).collect(),
        }
    }

    fn heading(&self) -> [String; 2] {
        let at_normal = match self.p_sign {
            PSign::Verdet => 180,
            PSign::Fresnel => 0,
        };
        [
            "ψ and Δ of reflected light".to_owned(),
            format!("p sign {}: Δ = {at_normal}° at 0°", self.p_sign.name()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Angle, Stack};

    fn plot(p_sign: PSign) -> PhasePlot {
        let stack = Stack::parse("1 | silica 300nm | silicon").unwrap();
        let nm: Vec<f64> = (380..=780).map(f64::from).collect();
        let sampled = stack.sampled(&nm).unwrap();
        let curve = |deg: f64| {
            let angle = Angle::from_degrees(deg).unwrap();
            let found = sampled.amplitudes(stack.thicknesses_nm(), angle, p_sign);
            let angles = found.iter().map(EllipsometricAngles::of).collect();
            (format!("{deg}°"), angles)
        };
        PhasePlot {
            title: stack.label(),
            over: Over::Wavelengths(nm),
            curves: [60.0, 70.0].map(curve).into(),
            p_sign,
        }
    }

    #[test]
    fn what_is_shown_is_labeled() {
        let svg = plot(PSign::Verdet).svg();
        for words in [
            "silica 300 nm",
            "ψ / °",
            "Δ / °",
            "wavelength in vacuum / nm",
            "70°",
            "p sign verdet: Δ = 180° at 0°",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(
            plot(PSign::Fresnel)
                .svg()
                .contains("p sign fresnel: Δ = 0° at 0°")
        );
    }

    #[test]
    fn what_is_not_defined_is_a_gap() {
        let lines = |plot: &PhasePlot| plot.svg().matches("<polyline").count();
        let mut plot = plot(PSign::Verdet);
        let whole = lines(&plot);
        plot.curves[0].1[200] = EllipsometricAngles {
            psi_deg: Some(0.0),
            delta_deg: None,
        };
        assert_eq!(lines(&plot), whole + 1);
    }
}
