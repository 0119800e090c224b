//! `pellicle develop --booth`: the same image under one lamp after another, on one sheet.

use crate::lamp::Lamp;
use crate::output::is_stream;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::picture_file::RgbImage8;
use pellicle::plot::{MAX_PICTURES, SheetColors, contact_sheet};
use pellicle::relight::{Relight, relight};
use pellicle::spectra::{Observer, SpectralImage};
use std::path::{Path, PathBuf};

/// A lamp of the booth and its label.
#[derive(Clone, Debug)]
pub(crate) struct BoothLamp {
    label: String,
    lamp: Lamp,
}

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
    if let Some(path) = outputs
        .iter()
        .find(|path| !(is_png(path) || is_stream(path)))
    {
        return Err(miette!(
            help = "end it in .png",
            "-o {}: a contact sheet with this ending cannot be written",
            path.display()
        ));
    }
    if lamps.len() > MAX_PICTURES {
        let found = lamps.len();
        return Err(miette!(
            "--booth: {found} lamps; a sheet has room for {MAX_PICTURES}"
        ));
    }
    Ok(())
}

/// Returns the sheet of the pictures under the lamps, with their labels.
pub(crate) fn sheet(
    pictures: &[(String, RgbImage8)],
    colors: SheetColors,
) -> miette::Result<RgbImage8> {
    contact_sheet(pictures, colors).ok_or_else(|| miette!("--booth: there is no lamp"))
}

impl BoothLamp {
    /// What is written below its picture.
    pub(crate) fn label(&self) -> &str {
        &self.label
    }

    /// Sets all lights of an image, or of a strip of it, to the lamp.
    pub(crate) fn light(
        &self,
        image: &mut SpectralImage,
        observer: Observer,
    ) -> miette::Result<()> {
        let burns = Relight {
            lamp: Some(self.lamp.spectrum.clone()),
            factor: self.lamp.factor,
        };
        let groups = image.light_groups().iter();
        let lights: Vec<(String, Relight)> = groups
            .map(|group| (group.name.clone(), burns.clone()))
            .collect();
        relight(image, &lights, observer)
            .into_diagnostic()
            .wrap_err_with(|| format!("--booth {}", self.label))
    }
}
