//! A plot of the spectra.

use super::film::FilmFinding;
use super::{Arguments, Inspection};
use crate::{output, print};
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::picture_file::{PendingFile, png};
use pellicle::plot::{Series, SpectrumPlot};
use std::io::Write;
use std::path::Path;

/// Reports what cannot be drawn or written, before the image is read.
pub(super) fn check(arguments: &Arguments) -> miette::Result<()> {
    let Some(path) = &arguments.plot else {
        return Ok(());
    };
    if !(ends_in(path, "svg") || ends_in(path, "png")) {
        return Err(miette!(
            help = "end it in .svg or .png",
            "--plot {}: a file with this ending cannot be written",
            path.display()
        ));
    }
    let places = arguments.at.len() + arguments.region.len();
    if places > SpectrumPlot::MAX_SERIES {
        let most = SpectrumPlot::MAX_SERIES;
        return Err(miette!(
            "--plot: {places} positions; at most {most} can be told apart"
        ));
    }
    output::check_place("--plot", path, &arguments.image)
}

/// Draws and writes the plot if it is requested.
pub(super) fn write(inspection: &Inspection) -> miette::Result<()> {
    let Some(path) = &inspection.arguments.plot else {
        return Ok(());
    };
    let plot = plot(inspection);
    if ends_in(path, "svg") {
        let written = PendingFile::create(path).and_then(|pending| {
            pending.handle()?.write_all(plot.svg().as_bytes())?;
            pending.commit()
        });
        written.into_diagnostic()
    } else {
        png::write(path, &plot.pixels()).into_diagnostic()
    }
    .wrap_err_with(|| format!("{} was not written", path.display()))?;
    print::note(format_args!("wrote {}", path.display()));
    Ok(())
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case(ending))
}

fn plot(inspection: &Inspection) -> SpectrumPlot {
    let mut series = Vec::new();
    for place in &inspection.places {
        series.push(Series {
            label: place.label.clone(),
            values: place.probe.radiance.clone(),
            deviation: place.probe.deviation.clone(),
            codes: Some(inspection.color_of(place).codes),
        });
        // Add the film if there is room.
        if let Some(FilmFinding::Film(fitted)) = &place.film
            && let (Some(model), Some(fits)) = (&fitted.model, &fitted.fits)
            && 2 * inspection.places.len() <= SpectrumPlot::MAX_SERIES
        {
            series.push(Series {
                label: format!("film {:.1} nm", fits.by_shape[0].thickness_nm),
                values: model.clone(),
                deviation: None,
                codes: None,
            });
        }
    }
    let unit = match inspection.image.metadata().emissive_units.as_str() {
        "" => "radiance".to_owned(),
        "W.m^-2.sr^-1.nm^-1" | "W.m^-2.sr^-1" => "radiance / W m⁻² sr⁻¹ nm⁻¹".to_owned(),
        unit => format!("value / {unit}"),
    };
    let name = inspection.arguments.image.file_name().unwrap_or_default();
    SpectrumPlot {
        title: name.to_string_lossy().into_owned(),
        quantity: unit,
        bands: *inspection.image.bands(),
        series,
    }
}
