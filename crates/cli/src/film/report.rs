//! How the color depends on thicknesses: matches, tolerances, sensitivities.

use super::spectra::{described, side};
use super::{Film, Vary, Wanted};
use crate::print;
use crate::swatch::swatch;
use miette::miette;
use pellicle::coating::{
    self, Angle, Match, MatchBy, MatchPlace, Matching, Quantiles, StackColor, Tolerance,
};
use pellicle::colorimetry::srgb;
use std::fmt::Write;

/// The largest number of matches that are printed.
const MAX_MATCHES: usize = 6;

/// Prints the requested reports.
pub(crate) fn print(film: &Film) -> miette::Result<()> {
    let arguments = film.arguments;
    let mut reports = Vec::new();
    if let (Some(wanted), Some(vary)) = (&arguments.wanted, &arguments.vary) {
        reports.push(matches(film, wanted, vary)?);
    }
    if let Some(relative_sigma) = arguments.tolerance {
        let errors = Tolerance {
            relative_sigma,
            trials: arguments.trials,
            seed: arguments.seed,
        };
        let color = film.color()?;
        for &angle in &film.angles {
            reports.push(tolerance(film, &color, angle, errors)?);
        }
    }
    if arguments.sensitivity {
        let color = film.color()?;
        for &angle in &film.angles {
            reports.push(sensitivity(film, &color, angle)?);
        }
    }
    for (index, report) in reports.iter().enumerate() {
        if index == 0 {
            print::result(film.title())?;
        }
        print::result(format_args!("\n{}", report.trim_end()))?;
    }
    Ok(())
}

fn matches(film: &Film, wanted: &Wanted, vary: &Vary) -> miette::Result<String> {
    let layer = film.layer_of(vary)?;
    let [angle] = film.angles.as_slice() else {
        return Err(miette!(
            "--match needs exactly one angle; {} are given",
            film.angles.len()
        ));
    };
    if film.match_by() == MatchBy::Chromaticity && wanted.xyz[1] <= 0.0 {
        return Err(miette!(
            help = "leave out --match-by, or choose another color",
            "--match-by chromaticity: black has no chromaticity"
        ));
    }
    let matching = Matching {
        wanted: wanted.xyz,
        layer,
        from_nm: vary.from_nm,
        to_nm: vary.to_nm,
        exposure_ev: film.exposure_ev,
        by: film.match_by(),
    };
    let found = coating::matches(
        &film.color()?,
        film.stack.thicknesses_nm(),
        *angle,
        &matching,
    );
    let codes = srgb::linear_from_xyz(wanted.xyz).map(srgb::to_u8);
    let mut text = format!(
        "wanted {}{}: layer {}, {}, from {} to {} nm at {}° ({} under {})\n",
        swatch(codes),
        hex(codes),
        vary.layer,
        film.stack.layers()[layer].medium.label(),
        vary.from_nm,
        vary.to_nm,
        angle.degrees(),
        side(film),
        film.light.name(),
    );
    if let [
        only @ Match {
            place: MatchPlace::Anywhere,
            ..
        },
    ] = found.as_slice()
    {
        let _ = writeln!(
            text,
            "the color does not depend on this layer: ΔE2000 {:.3} at any of these thicknesses, {}",
            only.delta_e,
            code(only)
        );
        return Ok(text);
    }
    let _ = writeln!(
        text,
        "{:>4} {:>14} {:>10} {:>9}  color",
        "", "thickness / nm", "ΔE2000", "shown at"
    );
    for (index, found) in found.iter().take(MAX_MATCHES).enumerate() {
        text.push_str(&line_of_match(index + 1, found));
    }
    if found.len() > MAX_MATCHES {
        let _ = writeln!(text, "and {} more", found.len() - MAX_MATCHES);
    }
    Ok(text)
}

fn line_of_match(number: usize, found: &Match) -> String {
    let place = match found.place {
        MatchPlace::ThinEnd | MatchPlace::ThickEnd => "  (end of the range)",
        MatchPlace::Within | MatchPlace::Anywhere => "",
    };
    format!(
        "{number:>4} {:>14.3} {:>10.3} {:>9}  {}{place}\n",
        found.thickness_nm,
        found.delta_e,
        format!("{:+.2} EV", found.exposure_ev + 0.0),
        code(found)
    )
}

/// The color of a match as a swatch and a code.
fn code(found: &Match) -> String {
    let codes = srgb::linear_from_xyz(found.xyz).map(srgb::to_u8);
    format!("{}{}", swatch(codes), hex(codes))
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn tolerance(
    film: &Film,
    color: &StackColor,
    angle: Angle,
    errors: Tolerance,
) -> miette::Result<String> {
    let thicknesses = film.stack.thicknesses_nm();
    let spread = coating::tolerance(color, thicknesses, angle, errors)
        .map_err(|error| miette!("--tolerance: {error}"))?;
    let mut text = format!(
        "at {}°, thicknesses off by {} % (standard deviation), {} trials, seed {}\n",
        angle.degrees(),
        100.0 * errors.relative_sigma,
        errors.trials,
        errors.seed
    );
    let _ = writeln!(text, "nominal  {}", described(film, &spread.nominal));
    let _ = writeln!(
        text,
        "mean     {}, ΔE2000 {:.3}",
        described(film, &spread.mean),
        spread.mean_delta_e
    );
    let _ = writeln!(
        text,
        "{:<28} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "ΔE2000 from nominal", "50 %", "90 %", "95 %", "99 %", "max"
    );
    let _ = writeln!(text, "{:<28} {}", "all layers", figures(&spread.all));
    if errors.trials > Tolerance::ALONE && !spread.alone.is_empty() {
        let _ = writeln!(text, "of the first {} trials:", Tolerance::ALONE);
    }
    for (layer, alone) in spread.alone.iter().enumerate() {
        let matters_most = match spread.worst_layer() {
            Some(worst) if worst == layer && spread.alone.len() > 1 => "  matters most",
            _ => "",
        };
        let name = format!("{} alone", layer_name(film, layer));
        let _ = writeln!(text, "{name:<28} {}{matters_most}", figures(alone));
    }
    Ok(text)
}

fn figures(q: &Quantiles) -> String {
    let all = [q.p50, q.p90, q.p95, q.p99, q.max];
    all.map(|figure| format!("{figure:>9.3}")).join(" ")
}

fn layer_name(film: &Film, layer: usize) -> String {
    format!("{} {}", layer + 1, film.stack.layers()[layer].label())
}

fn sensitivity(film: &Film, color: &StackColor, angle: Angle) -> miette::Result<String> {
    let thicknesses = film.stack.thicknesses_nm();
    let found = coating::sensitivity(color, thicknesses, angle);
    let design_nm = film.arguments.design;
    let at_design = film
        .stack
        .sampled(&[design_nm])?
        .derivatives(thicknesses, angle);
    let mut text = format!(
        "at {}°: {}\n",
        angle.degrees(),
        described(film, &found.color)
    );
    if found.layers.is_empty() {
        return Err(miette!(
            "--sensitivity: the stack has no layer whose thickness could vary"
        ));
    }
    let _ = writeln!(
        text,
        "{:<28} {:>9} {:>9} {:>9} {:>9} {:>16}",
        "per nm",
        "ΔE2000",
        "ΔL*",
        "Δa*",
        "Δb*",
        format!("ΔR at {design_nm} nm")
    );
    for (layer, per_nm) in found.layers.iter().enumerate() {
        let lab = per_nm.lab_per_nm;
        let figures = [per_nm.delta_e_per_nm, lab.l, lab.a, lab.b];
        let slope = film
            .arguments
            .look
            .view()
            .polarization
            .of(at_design[0][layer].reflectance);
        let _ = writeln!(
            text,
            "{:<28} {} {slope:>16.3e}",
            layer_name(film, layer),
            figures.map(|figure| format!("{figure:>9.4}")).join(" "),
        );
    }
    Ok(text)
}
