//! `pellicle develop`: turns a spectral image into a picture for a display. `render` has the same options.

mod negative;
mod options;
mod pictures;
mod stokes;
mod values;

pub(crate) use options::Options;

use crate::booth::{self, BoothLamp};
use crate::output::check_place;
use crate::{image_file, print};
use miette::{IntoDiagnostic, WrapErr};
use negative::{Light, Negative};
use pellicle::color::develop::SceneWhite;
use pellicle::picture_file::spectral_exr::{Metadata, RowReader};
use pellicle::picture_file::{RgbImage8, png};
use pellicle::plot::SheetColors;
use pellicle::spectra::SpectralImage;
use std::path::PathBuf;
use stokes::StokesName;
use values::{FOV_DEG, number};

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The spectral image (EXR), as `render` writes it
    image: PathBuf,
    /// Output file: .png for the display, .exr for its linear red, green and blue; can be repeated
    #[arg(short, long, value_name = "PATH", required = true)]
    output: Vec<PathBuf>,
    /// Write a contact sheet (.png) of the image with all its lights set to each of these lamps in turn, such as
    /// A,D65,F11,LED-B3, each with or without a factor
    #[arg(long, conflicts_with = "lights", value_name = "LAMP,LAMP,…", value_delimiter = ',', value_parser = booth::lamp)]
    booth: Vec<BoothLamp>,
    /// Write a picture (.png) of the polarization in false colors, with their scale: degrees of polarization (dop, dolp, docp), the
    /// angle of linear polarization (aolp), or a component over S0, from the luminances of S0 to S3
    #[arg(long, value_enum, value_name = "dop|dolp|docp|aolp|s1|s2|s3", hide_possible_values = true, conflicts_with_all = [
        "booth", "polarizer", "exposure", "display", "adapt", "adapt_from", "glare", "glare_fov", "star_length", "gamut",
        "gamut_warning", "gamut_report", "bits", "dither",
    ])]
    stokes: Option<StokesName>,
    #[command(flatten)]
    options: Options,
}

/// The properties of an image that developing needs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ImageProperties {
    /// The exposure that it was rendered with.
    pub(crate) exposure_ev: f64,
    /// Vertical field of view, if the camera is perspective.
    pub(crate) fov_deg: Option<f64>,
    /// The white of its brightest lamp.
    pub(crate) lamp: Option<SceneWhite>,
}

/// The name under which a spectral image stores the vertical field of view of its camera.
pub(crate) const FOV_SETTING: &str = "fov_deg";

impl ImageProperties {
    fn said_by(metadata: &Metadata) -> Self {
        let fov = metadata.settings.get(FOV_SETTING);
        Self {
            exposure_ev: metadata.exposure_ev,
            fov_deg: fov.and_then(|text| number(text, &FOV_DEG)),
            lamp: None,
        }
    }
}

/// Reads, develops and writes.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let (path, options) = (&arguments.image, &arguments.options);
    for output in &arguments.output {
        options.format(output)?;
        check_place("-o", output, path)?;
    }
    if let Some(shown) = arguments.stokes {
        return stokes::write(arguments, shown);
    }
    if !arguments.booth.is_empty() {
        return write_booth(arguments);
    }
    let mut rows = image_file::rows(path)?;
    let of_image = ImageProperties::said_by(rows.metadata());
    options.check(&arguments.output, of_image)?;
    let negative = if options.needs_spectra() {
        let mut negatives = Negative::in_lights(
            path,
            &mut rows,
            &[&|image| options.light(image)],
            options.observer(),
            options.needs_bands(),
        )?;
        negatives.remove(0)
    } else {
        Negative::of_colors(image_file::colors(path, &mut rows)?)
    };
    let of_image = ImageProperties {
        lamp: negative.lamp,
        ..of_image
    };
    let exposed = options.expose(&negative, of_image, negative.height())?;
    drop(negative);
    options.write_exposed(exposed, &arguments.output, false)
}

/// Develops the image under each lamp of the booth, and writes the sheet.
fn write_booth(arguments: &Arguments) -> miette::Result<()> {
    let (lamps, options, outputs) = (&arguments.booth, &arguments.options, &arguments.output);
    booth::check(lamps, outputs)?;
    options.check_booth()?;
    let mut rows = image_file::rows(&arguments.image)?;
    options.check(outputs, ImageProperties::said_by(rows.metadata()))?;
    // Bands take so much memory that only those of one lamp are kept.
    let at_a_time = if options.needs_bands() {
        1
    } else {
        lamps.len().max(1)
    };
    let mut pictures = Vec::with_capacity(lamps.len());
    for lamps in lamps.chunks(at_a_time) {
        pictures.extend(under_lamps(arguments, &mut rows, lamps)?);
    }
    let sheet = booth::sheet(&pictures, SheetColors::on(options.display()))?;
    for path in outputs {
        png::write_for_display(path, &sheet, options.display())
            .into_diagnostic()
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        print::note(format_args!("wrote {}", print::output(path)));
    }
    Ok(())
}

/// The pictures of an image under these lamps, with their labels.
fn under_lamps(
    arguments: &Arguments,
    rows: &mut RowReader,
    lamps: &[BoothLamp],
) -> miette::Result<Vec<(String, RgbImage8)>> {
    let options = &arguments.options;
    let observer = options.observer();
    let lit = lamps.iter().map(|lamp| {
        move |image: &mut SpectralImage| {
            options.polarize(image)?;
            lamp.light(image, observer)
        }
    });
    let lit: Vec<_> = lit.collect();
    let lights: Vec<&Light<'_>> = lit.iter().map(|light| light as &Light<'_>).collect();
    let needs_bands = options.needs_bands();
    let negatives = Negative::in_lights(&arguments.image, rows, &lights, observer, needs_bands)?;
    let of_image = ImageProperties::said_by(rows.metadata());
    let developed = lamps.iter().zip(negatives).map(|(lamp, negative)| {
        let of_image = ImageProperties {
            lamp: negative.lamp,
            ..of_image
        };
        let picture = options.codes(&negative, of_image, negative.height())?;
        Ok((lamp.label().to_owned(), picture))
    });
    developed.collect()
}
