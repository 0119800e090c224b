//! Writes pictures to files, in the format that their names ask for.

use super::{ImageProperties, Options};
use crate::output::is_stream;
use crate::print;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::develop::{
    DevelopSettings, GamutMapping, GamutReport, Latent, expose, gamut, quantize,
};
use pellicle::picture_file::LinearImage;
use pellicle::picture_file::rgb_exr::Samples;
use pellicle::picture_file::{png, rgb_exr};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Format {
    Png8,
    Png16,
    Exr(Samples),
}

/// A picture that is not yet mapped into the display's gamut, and how it goes on.
pub(super) struct Exposed {
    linear: LinearImage,
    settings: DevelopSettings,
}

impl Options {
    pub(super) fn format(&self, path: &Path) -> miette::Result<Format> {
        let extension = path.extension().map(OsStr::to_string_lossy);
        let extension = extension.map(|name| name.to_lowercase());
        match (extension.as_deref(), self.bits) {
            (Some("png"), None | Some(8)) => Ok(Format::Png8),
            (Some("png"), Some(16)) => Ok(Format::Png16),
            (Some("exr"), None | Some(16)) => Ok(Format::Exr(Samples::Half)),
            (Some("exr"), Some(32)) => Ok(Format::Exr(Samples::Float)),
            (Some("png" | "exr"), Some(bits)) => Err(miette!(
                help = "use 8 or 16 for a .png, 16 or 32 for an .exr",
                "{}: a file of this kind has no channels of {bits} bits",
                path.display()
            )),
            (None, None | Some(8)) if is_stream(path) => Ok(Format::Png8),
            (None, Some(16)) if is_stream(path) => Ok(Format::Png16),
            _ => Err(miette!(
                help = "end it in .png (codes of the display) or .exr (linear red, green and blue)",
                "-o {}: a picture with this ending cannot be written",
                path.display()
            )),
        }
    }

    /// Develops an image and writes each picture of it, silently if it is not the last.
    pub(crate) fn write<'a>(
        &self,
        image: impl Into<Latent<'a>>,
        of_image: ImageProperties,
        height: u32,
        pictures: &[PathBuf],
        is_preview: bool,
    ) -> miette::Result<()> {
        if pictures.is_empty() {
            return Ok(());
        }
        let exposed = self.expose(image, of_image, height)?;
        self.write_exposed(exposed, pictures, is_preview)
    }

    /// Develops an image up to the picture that is not yet mapped into the display's gamut. The image is not needed after that.
    pub(super) fn expose<'a>(
        &self,
        image: impl Into<Latent<'a>>,
        of_image: ImageProperties,
        height: u32,
    ) -> miette::Result<Exposed> {
        let settings = self.settings(of_image, height)?;
        let linear = expose(image, &settings)
            .into_diagnostic()
            .wrap_err("the picture cannot be developed")?;
        Ok(Exposed { linear, settings })
    }

    /// Writes the pictures of an exposed image. The last one takes its place in memory.
    pub(super) fn write_exposed(
        &self,
        exposed: Exposed,
        pictures: &[PathBuf],
        is_preview: bool,
    ) -> miette::Result<()> {
        let Exposed { linear, settings } = exposed;
        let not_finite = linear.not_finite();
        if not_finite > 0 && !is_preview {
            print::note(format_args!(
                "pixels that are not finite numbers: {not_finite}; they are shown black"
            ));
        }
        if self.gamut_report && !is_preview {
            report(&GamutReport::of(&linear, &settings), &settings)?;
        }
        let Some((last, others)) = pictures.split_last() else {
            return Ok(());
        };
        for path in others {
            self.write_and_say(path, linear.clone(), &settings, is_preview)?;
        }
        self.write_and_say(last, linear, &settings, is_preview)
    }

    fn write_and_say(
        &self,
        path: &Path,
        linear: LinearImage,
        settings: &DevelopSettings,
        is_preview: bool,
    ) -> miette::Result<()> {
        self.write_one(path, linear, settings)
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        if !is_preview {
            print::note(format_args!("wrote {}", print::output(path)));
        }
        Ok(())
    }

    fn write_one(
        &self,
        path: &Path,
        mut linear: LinearImage,
        settings: &DevelopSettings,
    ) -> miette::Result<()> {
        let format = self.format(path)?;
        let mut settings = settings.clone();
        if self.gamut.is_none() && matches!(format, Format::Exr(_)) {
            settings.gamut = GamutMapping::Keep;
        }
        gamut::map(&mut linear, &settings);
        let (display, dither) = (&settings.display, settings.dither);
        match format {
            Format::Png8 => {
                let codes = quantize::codes::<u8>(&linear, display, dither);
                drop(linear);
                png::write_for_display(path, &codes, display).into_diagnostic()
            }
            Format::Png16 => {
                let codes = quantize::codes::<u16>(&linear, display, dither);
                drop(linear);
                png::write_for_display(path, &codes, display).into_diagnostic()
            }
            Format::Exr(samples) => {
                rgb_exr::write(path, &linear, display, samples).into_diagnostic()
            }
        }
    }
}

fn report(report: &GamutReport, settings: &DevelopSettings) -> miette::Result<()> {
    print::result(format_args!(
        "{}: {:.2} % of the pixels cannot be shown ({} of {}), {:.2} % are brighter than its white",
        settings.display.name(),
        100.0 * report.share(),
        report.outside,
        report.pixels,
        100.0 * report.too_bright as f64 / report.pixels.max(1) as f64,
    ))?;
    if report.not_finite > 0 {
        print::result(format_args!("{} pixels are not finite", report.not_finite))?;
    }
    if report.outside > report.not_finite {
        print::result(format_args!(
            "mapping moves these by ΔE2000 {:.2} on average, median {:.2}, 95 % below {:.2}, at most {:.2}",
            report.mean, report.median, report.p95, report.max
        ))?;
    }
    Ok(())
}
