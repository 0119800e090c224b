//! Plots and charts of stacks, written to files.

use super::phase::{self, OverName};
use super::{Film, Vary, model};
use crate::{output, print};
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::coating::{Angle, Chart, ChartOf, Curve, Plot};
use pellicle::picture_file::{PendingFile, RgbImage8, png};
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The file format of a picture.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Png,
    Svg,
}

/// Reports what cannot be drawn or written, before anything is computed.
pub(crate) fn check(film: &Film) -> miette::Result<()> {
    let arguments = film.arguments;
    if let Some(path) = &arguments.plot {
        place("--plot", path, &[Kind::Svg, Kind::Png], film)?;
        check_axis(film)?;
    }
    if let Some(path) = &arguments.chart {
        place("--chart", path, &[Kind::Png], film)?;
    }
    if let (Some(plot), Some(chart)) = (&arguments.plot, &arguments.chart)
        && resolved(plot) == resolved(chart)
    {
        return Err(miette!("--plot and --chart are the same file"));
    }
    if let Some(vary) = &arguments.vary {
        film.layer_of(vary)?;
    }
    Ok(())
}

/// Checks the horizontal axis of a plot and the number of its curves.
fn check_axis(film: &Film) -> miette::Result<()> {
    let nm = film.wavelengths_nm(1)?;
    let degrees: Vec<f64> = film.angles.iter().map(|angle| angle.degrees()).collect();
    let (axis, values, curves, count) = match film.arguments.phases.plot_over {
        OverName::Wavelength => ("wavelengths", nm, "angles", degrees.len()),
        OverName::Angle => ("angles", degrees, "wavelengths", nm.len()),
    };
    if values.len() < 2 || !values.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(miette!(
            help = format!("use --{axis}"),
            "--plot: there must be two or more {axis}, in increasing order"
        ));
    }
    let most = Plot::MAX_CURVES;
    if count > most {
        return Err(miette!(
            help = format!("use --{curves}"),
            "--plot: {count} {curves}; at most {most} can be told apart"
        ));
    }
    Ok(())
}

/// Draws and writes the requested pictures.
pub(crate) fn write(film: &Film) -> miette::Result<()> {
    if let Some(path) = &film.arguments.plot {
        let is_svg = kind(path) == Some(Kind::Svg);
        match (film.arguments.phases.phase, is_svg) {
            (false, true) => write_text(path, &plot(film)?.svg())?,
            (false, false) => write_pixels(path, &plot(film)?.pixels())?,
            (true, true) => write_text(path, &phase::plot(film)?.svg())?,
            (true, false) => write_pixels(path, &phase::plot(film)?.pixels())?,
        }
        print::note(format_args!("wrote {}", path.display()));
    }
    if let Some(path) = &film.arguments.chart {
        write_pixels(path, &chart(film)?.pixels())?;
        print::note(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

fn plot(film: &Film) -> miette::Result<Plot> {
    let wavelengths_nm = film.wavelengths_nm(1)?;
    let powers = film.powers(&film.renderer()?, &film.stack.sampled(&wavelengths_nm)?)?;
    // A stack whose data do not cover visible light has curves, but no colors.
    let color = film.color().ok();
    let thicknesses = film.stack.thicknesses_nm();
    let curve = |(&angle, powers): (&Angle, Vec<_>)| Curve {
        angle,
        powers,
        color: color.as_ref().map(|color| color.at(thicknesses, angle)),
    };
    Ok(Plot {
        title: film.title(),
        wavelengths_nm,
        curves: film.angles.iter().zip(powers).map(curve).collect(),
        view: film.arguments.look.view(),
        illuminant: film.light.name().to_owned(),
        exposure_ev: film.exposure_ev,
        rounding: film.rounding(),
    })
}

fn chart(film: &Film) -> miette::Result<Chart> {
    let vary = match film.arguments.vary {
        Some(vary) => vary,
        None => usual_range(film)?,
    };
    let layer = film.layer_of(&vary)?;
    let of = ChartOf {
        title: film.stack.label_with_varied(layer) + &model::remark(film.stack.model()),
        layer,
        layer_label: film.stack.layers()[layer].medium.label(),
        range_nm: (vary.from_nm, vary.to_nm),
        angles: range_of_angles(&film.angles)?,
        exposure_ev: film.exposure_ev,
    };
    Ok(Chart::new(&film.color()?, film.stack.thicknesses_nm(), &of))
}

/// Layer 1, from 0 to 1000 nm, or to twice its thickness.
fn usual_range(film: &Film) -> miette::Result<Vary> {
    let first = film.stack.thicknesses_nm().first();
    let nm = first
        .ok_or_else(|| miette!("--chart: the stack has no layer whose thickness could vary"))?;
    Ok(Vary {
        layer: 1,
        from_nm: 0.0,
        to_nm: (2.0 * nm).max(1000.0),
    })
}

/// From the smallest to the largest of several angles, or else from 0 to 85°.
fn range_of_angles(angles: &[Angle]) -> miette::Result<(Angle, Angle)> {
    let mut degrees: Vec<f64> = angles.iter().map(|angle| angle.degrees()).collect();
    degrees.sort_by(f64::total_cmp);
    let (low, high) = match degrees.as_slice() {
        [low, .., high] if low < high => (*low, *high),
        _ => (0.0, 85.0),
    };
    Ok((
        Angle::from_degrees(low).into_diagnostic()?,
        Angle::from_degrees(high).into_diagnostic()?,
    ))
}

/// The path of a file with its folder resolved.
fn resolved(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default();
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    let folder = folder.unwrap_or(Path::new("."));
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    folder.join(name)
}

fn kind(path: &Path) -> Option<Kind> {
    let ending = path.extension().map(OsStr::to_ascii_lowercase)?;
    match ending.to_str() {
        Some("png") => Some(Kind::Png),
        Some("svg") => Some(Kind::Svg),
        _ => None,
    }
}

/// Checks that the file of a picture has an ending that names its format, and that its folder can be written to.
fn place(option: &str, path: &Path, kinds: &[Kind], film: &Film) -> miette::Result<()> {
    if !kind(path).is_some_and(|kind| kinds.contains(&kind)) {
        let endings = if kinds.contains(&Kind::Svg) {
            ".svg or .png"
        } else {
            ".png"
        };
        return Err(miette!(
            help = format!("end it in {endings}"),
            "{option} {}: a file with this ending cannot be written",
            path.display()
        ));
    }
    output::check_place(option, path, Path::new(&film.arguments.stack))
}

fn write_pixels(path: &Path, picture: &RgbImage8) -> miette::Result<()> {
    png::write(path, picture)
        .into_diagnostic()
        .wrap_err_with(|| format!("{} was not written", path.display()))
}

fn write_text(path: &Path, text: &str) -> miette::Result<()> {
    let written = PendingFile::create(path).and_then(|pending| {
        pending.handle()?.write_all(text.as_bytes())?;
        pending.commit()
    });
    written
        .into_diagnostic()
        .wrap_err_with(|| format!("{} was not written", path.display()))
}
