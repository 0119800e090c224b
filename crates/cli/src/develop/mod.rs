//! `pellicle develop`: turns a spectral image into a picture for a display. `render` has the same options.

mod options;
mod pictures;
mod values;

pub(crate) use options::Options;

use crate::booth::{self, BoothLamp};
use crate::output::check_place;
use crate::{image_file, print};
use miette::{IntoDiagnostic, WrapErr};
use pellicle::color::develop::{Latent, SceneWhite};
use pellicle::picture_file::png;
use pellicle::picture_file::spectral_exr::{self, Metadata};
use pellicle::plot::SheetColors;
use pellicle::spectra::SpectralImage;
use std::path::PathBuf;
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
    if !arguments.booth.is_empty() {
        return write_booth(arguments);
    }
    if options.needs_spectra() {
        let (mut image, metadata) = spectral_exr::read(path).into_diagnostic()?;
        image_file::print_notes(path, &metadata);
        let mut of_image = ImageProperties::said_by(&metadata);
        options.relight(&mut image, &mut of_image)?;
        write(arguments, &image, image.height(), of_image)
    } else {
        let (image, metadata) = spectral_exr::read_xyz(path).into_diagnostic()?;
        image_file::print_notes(path, &metadata);
        write(
            arguments,
            &image,
            image.height(),
            ImageProperties::said_by(&metadata),
        )
    }
}

/// Develops the image under each lamp of the booth, and writes the sheet.
fn write_booth(arguments: &Arguments) -> miette::Result<()> {
    let (lamps, options, outputs) = (&arguments.booth, &arguments.options, &arguments.output);
    booth::check(lamps, outputs)?;
    options.check_booth()?;
    let (image, metadata) = image_file::spectral(&arguments.image)?;
    let of_image = ImageProperties::said_by(&metadata);
    options.check(outputs, of_image)?;
    let observer = options.observer();
    let develop = |relit: &SpectralImage| {
        let of_image = ImageProperties {
            lamp: SceneWhite::of_lamps(relit, observer),
            ..of_image
        };
        options.codes(relit, of_image, relit.height())
    };
    let colors = SheetColors::on(options.display());
    let sheet = booth::sheet(&image, lamps, observer, colors, develop)?;
    for path in outputs {
        png::write_for_display(path, &sheet, options.display())
            .into_diagnostic()
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        print::note(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

fn write<'a>(
    arguments: &Arguments,
    image: impl Into<Latent<'a>>,
    height: u32,
    of_image: ImageProperties,
) -> miette::Result<()> {
    let (options, outputs) = (&arguments.options, &arguments.output);
    options.check(outputs, of_image)?;
    options.write(image, of_image, height, outputs, false)
}
