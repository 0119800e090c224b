//! `pellicle develop --booth`: the same image under one lamp after another, on one sheet.

use crate::develop::{ImageProperties, Options};
use crate::lamp::Lamp;
use crate::print;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::develop::SceneWhite;
use pellicle::colorimetry::Display;
use pellicle::picture_file::png;
use pellicle::plot::{SheetColors, contact_sheet};
use pellicle::relight::{Relight, relight};
use pellicle::spectra::SpectralImage;
use std::path::{Path, PathBuf};

/// A lamp of the booth and its label.
#[derive(Clone, Debug)]
pub(crate) struct BoothLamp {
    label: String,
    lamp: Lamp,
}

/// The largest number of pictures on a sheet.
const MAX: usize = 36;

/// Parses one lamp of `A,D65,F11,LED-B3`, with or without a factor.
pub(crate) fn lamp(text: &str) -> Result<BoothLamp, String> {
    let lamp = Lamp::parse(text.trim())?;
    let label = if text.trim() == lamp.name {
        lamp.name.clone()
    } else {
        format!("{} ({})", text.trim(), lamp.name)
    };
    Ok(BoothLamp { label, lamp })
}

/// Reports options that cannot work before the image is read.
pub(crate) fn check(lamps: &[BoothLamp], outputs: &[PathBuf]) -> miette::Result<()> {
    let is_png = |path: &Path| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("png"))
    };
    if let Some(path) = outputs.iter().find(|path| !is_png(path)) {
        return Err(miette!(
            help = "end it in .png",
            "-o {}: a contact sheet with this ending cannot be written",
            path.display()
        ));
    }
    if lamps.len() > MAX {
        let found = lamps.len();
        return Err(miette!(
            "--booth: {found} lamps; a sheet has room for {MAX}"
        ));
    }
    Ok(())
}

/// Sets all lights to each lamp in turn, develops, and writes the sheet.
pub(crate) fn write(
    image: &SpectralImage,
    of_image: ImageProperties,
    lamps: &[BoothLamp],
    options: &Options,
    outputs: &[PathBuf],
) -> miette::Result<()> {
    let mut pictures = Vec::with_capacity(lamps.len());
    for BoothLamp { label, lamp } in lamps {
        let mut relit = image.clone();
        let burns = Relight {
            lamp: Some(lamp.spectrum.clone()),
            factor: lamp.factor,
        };
        let groups = image.light_groups().iter();
        let lights: Vec<(String, Relight)> = groups
            .map(|group| (group.name.clone(), burns.clone()))
            .collect();
        relight(&mut relit, &lights, options.observer())
            .into_diagnostic()
            .wrap_err_with(|| format!("--booth {label}"))?;
        let of_image = ImageProperties {
            lamp: SceneWhite::of_lamps(&relit, options.observer()),
            ..of_image
        };
        let height = relit.height();
        pictures.push((label.clone(), options.codes(&relit, of_image, height)?));
    }
    let colors = SheetColors {
        ground: shade(options.display(), 0.02),
        text: shade(options.display(), 1.0),
    };
    let sheet =
        contact_sheet(&pictures, colors).ok_or_else(|| miette!("--booth: there is no lamp"))?;
    for path in outputs {
        png::write_for_display(path, &sheet, options.display())
            .into_diagnostic()
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        print::note(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

/// The codes of a fraction of a display's white.
fn shade(display: &Display, share: f64) -> [u8; 3] {
    let responses = display.responses().each_ref();
    responses.map(|response| (255.0 * response.code(share).clamp(0.0, 1.0)).round() as u8)
}
