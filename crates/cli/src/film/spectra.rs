//! R and T over wavelength and angle, as a table, as CSV or as JSON.

use super::phase::{self, Phase};
use super::{Film, Format};
use crate::print;
use crate::swatch::swatch;
use pellicle::coating::{Angle, Color, Model, Powers, Sampled, Side, absorptance};
use pellicle::optics::{Complex64, Polarized};
use serde_json::{Value, json};
use std::fmt::Write;

/// The results at all angles.
struct Spectra<'a> {
    film: &'a Film<'a>,
    /// The device that computed R and T.
    backend: String,
    sampled: Sampled,
    angles: Vec<AtAngle>,
}

struct AtAngle {
    angle: Angle,
    powers: Vec<Powers>,
    /// The absorptances of the layers at each wavelength; empty if they were not requested.
    absorptances: Vec<Vec<Polarized>>,
    /// Amplitudes and ellipsometric angles at each wavelength; empty if they were not requested.
    phases: Vec<Phase>,
    /// `None` if the data of the stack do not cover visible light.
    color: Option<Color>,
}

/// Computes and prints.
pub(crate) fn print(film: &Film, format: Format) -> miette::Result<()> {
    let spectra = Spectra::new(film)?;
    match format {
        Format::Table => print::result(spectra.table().trim_end()),
        Format::Csv => print::result(spectra.csv().trim_end()),
        Format::Json => print::result(spectra.json()),
    }
}

impl<'a> Spectra<'a> {
    fn new(film: &'a Film<'a>) -> miette::Result<Self> {
        let sampled = film.stack.sampled(&film.wavelengths_nm(10)?)?;
        let renderer = film.renderer()?;
        let powers = film.powers(&renderer, &sampled)?;
        let color = film.color().ok();
        let thicknesses = film.stack.thicknesses_nm();
        let at_angle = |(&angle, powers): (&Angle, Vec<Powers>)| AtAngle {
            angle,
            powers,
            absorptances: if film.arguments.absorptance {
                sampled.absorptances(thicknesses, angle)
            } else {
                Vec::new()
            },
            phases: phase::phases(film, &sampled, angle),
            color: color.as_ref().map(|color| color.at(thicknesses, angle)),
        };
        let angles = film.angles.iter().zip(powers).map(at_angle).collect();
        Ok(Self {
            film,
            backend: renderer.description(),
            sampled,
            angles,
        })
    }

    /// Each wavelength with the results there.
    fn rows<'b>(
        &'b self,
        at: &'b AtAngle,
    ) -> impl Iterator<Item = (f64, &'b Powers, &'b [Polarized], Option<&'b Phase>)> {
        let numbered = self.sampled.wavelengths_nm().iter().enumerate();
        numbered.map(|(w, &nm)| {
            let absorptances = at.absorptances.get(w).map_or(&[][..], Vec::as_slice);
            (nm, &at.powers[w], absorptances, at.phases.get(w))
        })
    }

    /// The layers whose absorptance is printed, counted from 1.
    fn layers(&self) -> std::ops::RangeInclusive<usize> {
        let printed = if self.film.arguments.absorptance {
            self.film.stack.layers().len()
        } else {
            0
        };
        1..=printed
    }

    fn table(&self) -> String {
        let mut text = format!("{}\n", self.film.title());
        let is_exact = self.film.stack.model() == Model::Exact;
        let head = ["nm", "Rs", "Rp", "R", "Ts", "Tp", "T"].map(|name| format!("{name:>9}"));
        let mut head = head.join(" ");
        if is_exact {
            head += &format!(" {:>9}", "A");
        }
        self.layers().for_each(|layer| {
            let _ = write!(head, " {:>9}", format!("A{layer}"));
        });
        if self.film.arguments.phases.phase {
            head += &format!(" {:>9} {:>9}", "psi_deg", "delta_deg");
        }
        for at in &self.angles {
            let _ = writeln!(text, "\n{}\n{head}", self.heading(at));
            for (nm, powers, absorptances, phase) in self.rows(at) {
                let (r, t) = (powers.reflectance, powers.transmittance);
                // Two beams have no absorptance.
                let a = is_exact.then(|| absorptance(*powers).unpolarized());
                let _ = write!(text, "{nm:>9}");
                let layers = absorptances.iter().map(|a| a.unpolarized());
                let figures = [r.s, r.p, r.unpolarized(), t.s, t.p, t.unpolarized()];
                for figure in figures.into_iter().chain(a).chain(layers) {
                    // A value that rounds to 0 is shown without a sign.
                    let _ = write!(text, " {:>9.6}", (figure * 1e6).round() / 1e6 + 0.0);
                }
                for degrees in phase.map(Phase::angles).iter().flatten() {
                    let _ = write!(text, " {:>9}", shown_angle(*degrees));
                }
                text.push('\n');
            }
        }
        text
    }

    fn heading(&self, at: &AtAngle) -> String {
        let angle = format!("{}°", at.angle.degrees());
        let Some(color) = at.color else {
            return format!("{angle}: no color, the data do not cover 380 to 780 nm");
        };
        format!("{angle}: {}", described(self.film, &color))
    }

    fn csv(&self) -> String {
        let mut text = "wavelength_nm,angle_deg,Rs,Rp,Ts,Tp".to_owned();
        for layer in self.layers() {
            let _ = write!(text, ",A{layer}s,A{layer}p");
        }
        if self.film.arguments.phases.phase {
            let _ = write!(text, ",{}", Phase::COLUMNS.join(","));
        }
        text.push('\n');
        for at in &self.angles {
            for (nm, powers, absorptances, phase) in self.rows(at) {
                let _ = write!(text, "{nm},{}", at.angle.degrees());
                let layers = absorptances.iter().copied();
                for power in [powers.reflectance, powers.transmittance]
                    .into_iter()
                    .chain(layers)
                {
                    // + 0 turns −0 into 0.
                    let _ = write!(text, ",{:.16e},{:.16e}", power.s + 0.0, power.p + 0.0);
                }
                for figure in phase.map(Phase::figures).iter().flatten() {
                    let cell = figure.map_or_else(String::new, |figure| format!("{figure:.16e}"));
                    let _ = write!(text, ",{cell}");
                }
                text.push('\n');
            }
        }
        text
    }

    fn json(&self) -> Value {
        let stack = &self.film.stack;
        let complex = |indices: &[Complex64]| {
            let n: Vec<f64> = indices.iter().map(|index| index.re).collect();
            let k: Vec<f64> = indices.iter().map(|index| index.im).collect();
            json!({ "n": n, "k": k })
        };
        let layers: Vec<Value> = self.sampled.layers().iter().map(|l| complex(l)).collect();
        let mut value = json!({
            "about": "power reflectance R and transmittance T (into the substrate) of a stack of thin films for s and p polarized light; \
                      index n + ik, k >= 0 absorbs; wavelengths in vacuum",
            "program": concat!("pellicle ", env!("CARGO_PKG_VERSION")),
            "backend": self.backend,
            "model": stack.model().name(),
            "stack": stack.description(),
            "indices": {
                "incident": { "n": self.sampled.incident() },
                "layer": layers,
                "substrate": complex(self.sampled.substrate()),
            },
            "wavelengths_nm": self.sampled.wavelengths_nm(),
            "angles": self.angles.iter().map(|at| self.json_of_angle(at)).collect::<Vec<_>>(),
        });
        if let Some(path) = stack.model().path_difference() {
            value["path_difference"] = json!(path);
        }
        if self.film.arguments.phases.phase {
            value["phase"] = phase::about(self.film);
        }
        value
    }

    fn json_of_angle(&self, at: &AtAngle) -> Value {
        let column =
            |of: &dyn Fn(&Powers) -> f64| -> Vec<f64> { at.powers.iter().map(of).collect() };
        let mut value = json!({
            "angle_deg": at.angle.degrees(),
            "Rs": column(&|p| p.reflectance.s),
            "Rp": column(&|p| p.reflectance.p),
            "Ts": column(&|p| p.transmittance.s),
            "Tp": column(&|p| p.transmittance.p),
        });
        if !at.absorptances.is_empty() {
            let of_layer = |layer: usize| {
                let column = |of: &dyn Fn(&Polarized) -> f64| -> Vec<f64> {
                    at.absorptances
                        .iter()
                        .map(|layers| of(&layers[layer - 1]) + 0.0)
                        .collect()
                };
                json!({ "As": column(&|a| a.s), "Ap": column(&|a| a.p) })
            };
            value["layers"] = self.layers().map(of_layer).collect();
        }
        if !at.phases.is_empty() {
            for (column, name) in Phase::COLUMNS.into_iter().enumerate() {
                let figures = at.phases.iter().map(|phase| phase.figures()[column]);
                value[name] = figures.collect();
            }
        }
        if let Some(color) = at.color {
            let lab = color.lab();
            value["color"] = json!({
                "side": side(self.film),
                "illuminant": self.film.light.name(),
                "observer": self.film.arguments.look.observer.name(),
                "XYZ": color.xyz,
                "Lab": [lab.l, lab.a, lab.b],
                "exposure_ev": self.film.exposure_ev,
                "linear_srgb": color.linear_srgb(self.film.exposure_ev),
                "srgb": color.hex(self.film.exposure_ev),
            });
        }
        value
    }
}

/// An ellipsometric angle in a table; "-" where it is not defined. What rounds to 360° is 0°.
fn shown_angle(degrees: Option<f64>) -> String {
    let Some(degrees) = degrees else {
        return "-".to_owned();
    };
    format!("{:.4}", (degrees * 1e4).round() / 1e4 % 360.0)
}

/// The side of the stack that is shown, as a word.
pub(crate) fn side(film: &Film) -> &'static str {
    match film.arguments.look.view().side {
        Side::Reflected => "reflected",
        Side::Transmitted => "transmitted",
    }
}

/// A color in one line: swatch, code, CIELAB and viewing conditions.
pub(crate) fn described(film: &Film, color: &Color) -> String {
    let lab = color.lab();
    format!(
        "{}{}  L* {:.2}  a* {:.2}  b* {:.2}  ({} under {}{}{})",
        swatch(color.srgb8(film.exposure_ev)),
        color.hex(film.exposure_ev),
        lab.l,
        lab.a,
        lab.b,
        side(film),
        film.light.name(),
        exposure(film.exposure_ev),
        if color.is_in_srgb(film.exposure_ev) {
            ""
        } else {
            "; sRGB clips it"
        },
    )
}

/// The remark on an exposure; empty for 0.
fn exposure(ev: f64) -> String {
    if ev == 0.0 {
        String::new()
    } else {
        format!(", shown at {ev:+} EV")
    }
}
