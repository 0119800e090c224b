//! The results as a table, as CSV or as JSON.

use super::film::{FilmFinding, Fitted};
use super::{Inspection, Position, polarization};
use crate::print;
use crate::swatch::swatch;
use pellicle::coating::{FilmFit, FilmFits, MatchPlace, Verdict};
use pellicle::colorimetry::{Lab, chromaticity, srgb};
use pellicle::progressive::Identity;
use pellicle::relight::xyz::exposure_scale;
use serde_json::{Value, json};
use std::fmt::Write;

/// The largest number of thicknesses that are printed.
const MAX_FITS: usize = 3;

/// The color at a position.
pub(super) struct PlaceColor {
    /// Y = 1 for the display's white.
    xyz: [f64; 3],
    lab: Lab,
    pub(super) codes: [u8; 3],
    is_clipped: bool,
}

impl Inspection<'_> {
    pub(super) fn color_of(&self, place: &Position) -> PlaceColor {
        let xyz = place
            .probe
            .xyz
            .map(|v| v * exposure_scale(self.exposure_ev));
        let linear = srgb::linear_from_xyz(xyz);
        // Half an 8-bit code counts as rounding.
        let is_shown = |v: &f64| (-1.5e-4..=1.0045).contains(v);
        PlaceColor {
            xyz,
            lab: Lab::from_xyz(xyz, srgb::white_xyz()),
            codes: linear.map(srgb::to_u8),
            is_clipped: !linear.iter().all(is_shown),
        }
    }

    pub(super) fn print_table(&self) -> miette::Result<()> {
        let (bands, [width, height]) = (self.image.bands(), self.image.size());
        let mut text = format!(
            "{}: {width}×{height} pixels, {} bands from {} to {} nm",
            self.arguments.image.display(),
            bands.count(),
            bands.min_nm(),
            bands.max_nm()
        );
        if !self.image.metadata().software.is_empty() {
            let _ = write!(text, ", by {}", self.image.metadata().software);
        }
        text.push('\n');
        let settings = &self.image.metadata().settings;
        if let Some(identity) = Identity::of_settings(settings) {
            let _ = writeln!(text, "  identity: {}", identity.digest());
        }
        let is_own = |(name, _): &(&String, &String)| !Identity::has(name);
        for (name, value) in settings.iter().filter(is_own) {
            let _ = writeln!(text, "  {name}: {value}");
        }
        for place in &self.places {
            text.push('\n');
            self.color(&mut text, place);
            if let Some(film) = &place.film {
                film.describe(&mut text);
            }
        }
        // The mean spectrum of a whole image was not requested.
        if !(self.arguments.at.is_empty() && self.arguments.region.is_empty()) {
            text.push('\n');
            self.spectra(&mut text);
        }
        print::result(text.trim_end())
    }

    fn color(&self, text: &mut String, place: &Position) {
        let (color, probe) = (self.color_of(place), &place.probe);
        let [r, g, b] = color.codes;
        let _ = writeln!(
            text,
            "{}: {}#{r:02x}{g:02x}{b:02x} at {:+} EV{}",
            place.label,
            swatch(color.codes),
            self.exposure_ev,
            if color.is_clipped {
                "; sRGB clips it"
            } else {
                ""
            }
        );
        let [x, y, z] = probe.xyz;
        let _ = writeln!(text, "  XYZ   {x:.6e} {y:.6e} {z:.6e} (Y in cd/m²)");
        let chromaticity = chromaticity::xy_of_xyz(probe.xyz);
        if chromaticity.iter().all(|v| v.is_finite()) {
            let [x, y] = chromaticity;
            let _ = writeln!(text, "  x, y  {x:.5} {y:.5}");
        }
        let lab = color.lab;
        let _ = writeln!(
            text,
            "  Lab   {:.3} {:.3} {:.3} (C* {:.3}, h {:.2}°; white of sRGB)",
            lab.l,
            lab.a,
            lab.b,
            lab.chroma(),
            lab.hue_deg()
        );
        self.light_groups(text, place);
        if let Some(stokes) = probe.stokes_of_luminance() {
            let _ = writeln!(text, "  {}", polarization::line(stokes));
        }
        let _ = write!(text, "  {} samples", probe.samples);
        if probe.left_out > 0 {
            let _ = write!(
                text,
                "; {} pixels are not finite and left out",
                probe.left_out
            );
        }
        text.push('\n');
    }

    /// Writes how much each light group contributes to the luminance, if there are several.
    fn light_groups(&self, text: &mut String, place: &Position) {
        let probe = &place.probe;
        if probe.light_groups.len() < 2 {
            return;
        }
        for (group, share) in self.image.light_groups().iter().zip(&probe.light_groups) {
            text.push_str(&light_line(&group.name, share.xyz, probe.xyz[1]));
        }
    }

    fn spectra(&self, text: &mut String) {
        let _ = write!(text, "{:>9}", "nm");
        for place in &self.places {
            let _ = write!(text, " {:>13}", place.label);
            if place.probe.deviation.is_some() {
                let _ = write!(text, " {:>9}", "±");
            }
            if place.probe.polarized.is_some() {
                text.push_str(&polarization::heading());
            }
        }
        text.push('\n');
        for band in 0..self.image.bands().count() {
            let _ = write!(text, "{:>9.2}", self.image.bands().center_nm(band));
            for place in &self.places {
                let band = band as usize;
                let _ = write!(text, " {:>13.6e}", place.probe.radiance[band]);
                if let Some(deviation) = &place.probe.deviation {
                    let _ = write!(text, " {:>9.2e}", deviation[band]);
                }
                if let Some(stokes) = place.probe.stokes(band) {
                    text.push_str(&polarization::columns(stokes));
                }
            }
            text.push('\n');
        }
        let unit = &self.image.metadata().emissive_units;
        if !unit.is_empty() {
            let _ = writeln!(text, "radiance in {unit}, up to the scene's scale");
        }
    }

    pub(super) fn print_csv(&self) -> miette::Result<()> {
        let mut text = "wavelength_nm".to_owned();
        for place in &self.places {
            let name = place.label.replace([',', ' '], "_");
            let _ = write!(text, ",radiance_{name},deviation_{name}");
            if place.probe.polarized.is_some() {
                let _ = write!(text, ",s1_{name},s2_{name},s3_{name}");
            }
        }
        for band in 0..self.image.bands().count() {
            let _ = write!(text, "\n{}", self.image.bands().center_nm(band));
            for place in &self.places {
                let (band, probe) = (band as usize, &place.probe);
                let _ = write!(text, ",{:.9e},", probe.radiance[band]);
                if let Some(deviation) = &probe.deviation {
                    let _ = write!(text, "{:.3e}", deviation[band]);
                }
                if let Some([_, s1, s2, s3]) = probe.stokes(band) {
                    let _ = write!(text, ",{s1:.9e},{s2:.9e},{s3:.9e}");
                }
            }
        }
        print::result(text)
    }

    pub(super) fn print_json(&self) -> miette::Result<()> {
        let bands = self.image.bands();
        let centers: Vec<f64> = (0..bands.count())
            .map(|band| bands.center_nm(band))
            .collect();
        let value = json!({
            "about": "means over bands and regions; deviation is the standard deviation of the mean due to the renderer's noise; \
                      lab is relative to the white of sRGB, at the exposure",
            "program": concat!("pellicle ", env!("CARGO_PKG_VERSION")),
            "image": self.arguments.image.display().to_string(),
            "size": self.image.size(),
            "software": self.image.metadata().software,
            "settings": self.image.metadata().settings,
            "notes": self.image.metadata().notes,
            "units": self.image.metadata().emissive_units,
            "range_nm": [bands.min_nm(), bands.max_nm()],
            "centers_nm": centers,
            "exposure_ev": self.exposure_ev,
            "places": self.places.iter().map(|place| self.json_of(place)).collect::<Vec<_>>(),
        });
        print::result(format_args!("{value:#}"))
    }

    fn json_of(&self, place: &Position) -> Value {
        let (color, probe) = (self.color_of(place), &place.probe);
        let [r, g, b] = color.codes;
        let region = probe.region;
        let xy = chromaticity::xy_of_xyz(probe.xyz);
        json!({
            "place": place.label,
            "region": [region.x, region.y, region.width, region.height],
            "radiance": probe.radiance,
            "deviation": probe.deviation,
            "light_groups": self.image.light_groups().iter().zip(&probe.light_groups).map(|(group, share)| json!({
                "name": group.name, "radiance": share.radiance, "xyz": share.xyz,
            })).collect::<Vec<_>>(),
            "polarization": polarization::json(probe),
            "samples": probe.samples,
            "left_out": probe.left_out,
            "xyz": probe.xyz,
            "xyz_shown": color.xyz,
            "xy": xy.iter().all(|v| v.is_finite()).then_some(xy),
            "lab": [color.lab.l, color.lab.a, color.lab.b],
            "srgb": format!("#{r:02x}{g:02x}{b:02x}"),
            "clipped": color.is_clipped,
            "film": place.film.as_ref().map(FilmFinding::json),
        })
    }
}

impl FilmFinding {
    fn describe(&self, text: &mut String) {
        match self {
            Self::Other(what) => {
                let _ = writeln!(text, "  no film: the scene has {what} there");
            }
            Self::Film(fitted) => fitted.describe(text),
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Other(what) => json!({ "other": what }),
            Self::Film(fitted) => fitted.json(),
        }
    }
}

impl Fitted {
    fn describe(&self, text: &mut String) {
        let own = match &self.material {
            Some(material) => format!(", the scene's {material:?}"),
            None => String::new(),
        };
        let _ = writeln!(
            text,
            "  film  {} at {:.2}°{own}, in the light of {}",
            self.stack.label_with_varied(self.layer),
            self.angle.degrees(),
            self.lamp
        );
        if self.material.is_some() {
            let nm = self.stack.thicknesses_nm()[self.layer];
            let _ = writeln!(text, "        in the scene it is {nm:.2} nm thick there");
        }
        let Some(fits) = &self.fits else {
            let _ = writeln!(
                text,
                "        nothing to fit: the position is black or not finite"
            );
            return;
        };
        let _ = writeln!(text, "        {}", self.verdict(fits));
        let _ = writeln!(
            text,
            "        {:<10} {:>14} {:>8} {:>9} {:>8} {:>10}",
            "nearest", "thickness / nm", "±", "residual", "ΔE2000", "scale"
        );
        for (name, found) in [("by shape", &fits.by_shape), ("by color", &fits.by_color)] {
            for (index, fit) in found.iter().take(MAX_FITS).enumerate() {
                let name = if index == 0 { name } else { "" };
                text.push_str(&line(name, fit));
            }
        }
    }

    fn verdict(&self, fits: &FilmFits) -> String {
        let best = fits.by_shape[0];
        let noise = fits.of_noise.map_or_else(String::new, |noise| {
            format!(" (noise of the bands: {:.2} %)", 100.0 * noise)
        });
        let (from, to) = self.range_nm;
        match fits.verdict() {
            Verdict::Film => format!(
                "best fit by the shape of the spectrum: {:.2} nm, residual {:.2} %{noise}",
                best.thickness_nm,
                100.0 * best.residual
            ),
            Verdict::Lamp => format!(
                "no film can be identified: the lamp's own spectrum fits to {:.2} %{noise}",
                100.0 * fits.of_lamp
            ),
            Verdict::Nothing => format!(
                "nothing fits from {from} to {to} nm: the closest film has a residual of {:.2} %{noise}, the lamp's own spectrum {:.2} %",
                100.0 * best.residual,
                100.0 * fits.of_lamp
            ),
        }
    }

    fn json(&self) -> Value {
        let fit = |fit: &FilmFit| {
            json!({
                "thickness_nm": fit.thickness_nm, "deviation_nm": fit.deviation_nm, "residual": fit.residual,
                "delta_e_2000": fit.delta_e, "scale": fit.scale,
                "end_of_range": fit.place != MatchPlace::Within,
            })
        };
        let all = |found: &[FilmFit]| found.iter().take(MAX_FITS).map(fit).collect::<Vec<_>>();
        let verdict = |fits: &FilmFits| match fits.verdict() {
            Verdict::Film => "film",
            Verdict::Lamp => "lamp",
            Verdict::Nothing => "nothing",
        };
        let scene_nm = self.stack.thicknesses_nm()[self.layer];
        json!({
            "material": self.material,
            "stack": self.stack.label_with_varied(self.layer),
            "layer": self.layer + 1,
            "range_nm": [self.range_nm.0, self.range_nm.1],
            "angle_deg": self.angle.degrees(),
            "lamp": self.lamp,
            "scene_thickness_nm": self.material.as_ref().map(|_| scene_nm),
            "verdict": self.fits.as_ref().map(verdict),
            "residual_of_lamp": self.fits.as_ref().map(|fits| fits.of_lamp),
            "residual_of_noise": self.fits.as_ref().and_then(|fits| fits.of_noise),
            "by_shape": self.fits.as_ref().map(|fits| all(&fits.by_shape)),
            "by_color": self.fits.as_ref().map(|fits| all(&fits.by_color)),
        })
    }
}

/// The contribution of a light group to a luminance; black has no percentages.
fn light_line(name: &str, [x, y, z]: [f64; 3], of_y: f64) -> String {
    let part = if of_y == 0.0 {
        String::new()
    } else {
        format!("{:>6.2} % of Y; ", 100.0 * y / of_y)
    };
    format!("  light {name:<12} {part}XYZ {x:.6e} {y:.6e} {z:.6e}\n")
}

fn line(name: &str, fit: &FilmFit) -> String {
    let deviation = fit
        .deviation_nm
        .map_or_else(String::new, |nm| format!("{nm:.2}"));
    let place = match fit.place {
        MatchPlace::Within => "",
        MatchPlace::Anywhere => "  (any thickness)",
        MatchPlace::ThinEnd | MatchPlace::ThickEnd => "  (end of the range)",
    };
    format!(
        "        {name:<10} {:>14.2} {deviation:>8} {:>7.2} % {:>8.3} {:>10.4}{place}\n",
        fit.thickness_nm,
        100.0 * fit.residual,
        fit.delta_e,
        fit.scale
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_has_no_shares() {
        let half = light_line("key", [1.0, 2.0, 3.0], 4.0);
        assert!(
            half.contains("key") && half.contains(" 50.00 % of Y; XYZ 1.0"),
            "{half}"
        );
        let black = light_line("key", [0.0; 3], 0.0);
        assert!(!black.contains('%') && !black.contains("NaN"), "{black}");
    }
}
