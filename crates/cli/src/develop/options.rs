//! The options of developing, the checks on them, and the settings that they give.

use super::ImageProperties;
use super::values::{
    ExposureOption, GamutName, GlareName, White, bits, display, exposure, fov, polarizer,
    star_length, white,
};
use crate::output::is_standard_output;
use crate::print;
use crate::relight::RelightArguments;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::develop;
use pellicle::color::develop::{
    DevelopSettings, Exposure, EyeGlare, Glare, Latent, SceneWhite, StarGlare, WhiteAdaptation,
};
use pellicle::colorimetry::{Adaptation, Display};
use pellicle::picture_file::RgbImage8;
use pellicle::relight::{NotPolarized, behind};
use pellicle::spectra::stokes::Polarizer;
use pellicle::spectra::{LightGroup, Observer, SpectralImage};
use std::path::PathBuf;

/// How a picture is developed.
#[derive(clap::Args)]
#[command(next_help_heading = "Developing")]
pub(crate) struct Options {
    #[command(flatten)]
    lamps: RelightArguments,
    /// Put an ideal linear polarizer in front of the camera, at this angle of the light that passes, counterclockwise from the horizontal
    /// as the camera sees it: 0 for horizontal, 90 for vertical. The image must be rendered with its polarization. It is for pictures: a
    /// spectral image keeps all components
    #[arg(long, value_name = "DEGREES", value_parser = polarizer, allow_hyphen_values = true)]
    polarizer: Option<Polarizer>,
    /// Light that becomes the display's white: stops (3), a luminance in the scene (250cd), the luminance of the display's white
    /// (display), or the luminance that a percentage of the pixels do not exceed (auto, which is auto:99) [default: the scene's stops]
    #[arg(long, value_name = "STOPS|CDcd|display|auto[:PERCENT]", value_parser = exposure, allow_hyphen_values = true)]
    exposure: Option<ExposureOption>,
    /// Display, by its name or as a .toml file; `pellicle display` lists the names
    #[arg(long, value_name = "NAME|FILE", default_value = "srgb", value_parser = display)]
    display: Display,
    /// Chromatic adaptation from the scene's white to the display's
    #[arg(long, value_name = "none|bradford|cat16", default_value = "none")]
    adapt: Adaptation,
    /// White of the scene for --adapt: that of a lamp, a chromaticity x,y, or the image's mean [default: that of the scene's own
    /// brightest lamp]
    #[arg(long, value_name = "LAMP|X,Y|mean", value_parser = white)]
    adapt_from: Option<White>,
    /// Glare around bright light: a star from light that is too bright for the display, or the glare of an eye adapted to light
    /// (photopic), to dusk (mesopic) or to dark (scotopic)
    #[arg(long, value_enum, default_value_t = GlareName::Off)]
    glare: GlareName,
    /// Vertical field of view for the glare of an eye [default: that of the scene's camera]
    #[arg(long, value_name = "DEGREES", value_parser = fov)]
    glare_fov: Option<f64>,
    /// Distance at which the arms of the star have fallen to 1/e, as a fraction of the picture's height [default: 0.05]
    #[arg(long, value_name = "FRACTION", value_parser = star_length)]
    star_length: Option<f64>,
    /// Gamut mapping of colors that the display cannot show: reduce chroma at constant hue and lightness (perceptual), mix with white
    /// at constant luminance (white), clip, or keep, for .exr [default: perceptual, for .exr keep]
    #[arg(long, value_enum)]
    pub(super) gamut: Option<GamutName>,
    /// Mark with stripes the pixels that the display cannot show
    #[arg(long)]
    gamut_warning: bool,
    /// Print which fraction of the pixels the display cannot show, and how far gamut mapping moves them
    #[arg(long)]
    pub(super) gamut_report: bool,
    /// Bits per channel: 8 or 16 in a .png, 16 or 32 in an .exr [default: 8 in a .png, 16 in an .exr]
    #[arg(long, value_name = "8|16|32", value_parser = bits)]
    pub(super) bits: Option<u8>,
    /// Dither: spread the rounding to codes over neighboring pixels, so that gradients show no steps
    #[arg(long)]
    dither: bool,
}

fn unknown_lamp() -> miette::Report {
    miette!(
        help = "name the lamp that is white with --adapt-from, or `mean` for the image's mean",
        "--adapt: the lamp of the image's brightest lights is not known"
    )
}

/// The error of an option that needs polarized light.
pub(super) fn not_polarized(option: &str, error: NotPolarized) -> miette::Report {
    miette!(
        help = "render the scene with `render.polarization = true`, and without a polarizer in front of its camera",
        "{option}: {error}"
    )
}

fn without_effect(option: &str, needs: &str) -> miette::Report {
    miette!(
        help = format!("leave {option} out, or add {needs}"),
        "{option} has no effect without {needs}"
    )
}

impl Options {
    /// Reports options that cannot work before the work starts, not after it.
    pub(crate) fn check(
        &self,
        pictures: &[PathBuf],
        of_image: ImageProperties,
    ) -> miette::Result<()> {
        for path in pictures {
            self.format(path)?;
        }
        let streams = pictures.iter().filter(|path| is_standard_output(path));
        match streams.count() {
            2.. => return Err(miette!("-o -: standard output gets one picture")),
            1 if self.gamut_report => {
                return Err(miette!(
                    help = "write the picture to a file",
                    "--gamut-report: standard output gets the picture of -o -, not the report"
                ));
            }
            _ => {}
        }
        if self.adapt_from.is_some() && self.adapt == Adaptation::None {
            return Err(without_effect("--adapt-from", "--adapt"));
        }
        if self.glare_fov.is_some() && self.glare.vision().is_none() {
            return Err(without_effect("--glare-fov", "--glare of an eye"));
        }
        if self.star_length.is_some() && self.glare != GlareName::Star {
            return Err(without_effect("--star-length", "--glare star"));
        }
        if self.display.seen_by(self.observer()).is_none() {
            print::note(format_args!(
                "{}: its primaries are known for CIE 1931 alone; XYZ of {} is treated as XYZ of CIE 1931",
                self.display.name(),
                self.observer()
            ));
        }
        if self.glare.vision().is_some() && self.glare_fov.or(of_image.fov_deg).is_none() {
            return Err(miette!(
                help = "give the vertical field of view with --glare-fov DEGREES",
                "--glare: the glare of an eye depends on the field of view, which is not known for this image"
            ));
        }
        Ok(())
    }

    /// Reports before a picture is rendered if the lamps of its light groups cannot give its white.
    pub(crate) fn check_lamps(&self, groups: &[LightGroup]) -> miette::Result<()> {
        let needs_lamp = self.adapt != Adaptation::None && self.adapt_from.is_none();
        if needs_lamp && groups.iter().any(|group| group.lamp.is_none()) {
            return Err(unknown_lamp());
        }
        Ok(())
    }

    /// Reports options that a contact sheet does not support.
    pub(crate) fn check_booth(&self) -> miette::Result<()> {
        let asked = [
            ("--bits", self.bits.is_some_and(|bits| bits != 8)),
            ("--gamut-report", self.gamut_report),
        ];
        match asked.iter().find(|(_, is_asked)| *is_asked) {
            Some((option, _)) => Err(miette!(
                help =
                    format!("leave {option} out, or develop under one lamp at a time with --light"),
                "a contact sheet of --booth has 8 bits and no report: {option} has no effect"
            )),
            None => Ok(()),
        }
    }

    /// Shows an image under the requested lamps and for the requested observer, and records the white of its brightest lamp.
    pub(crate) fn relight(
        &self,
        image: &mut SpectralImage,
        of_image: &mut ImageProperties,
    ) -> miette::Result<()> {
        self.light(image)?;
        of_image.lamp = SceneWhite::of_lamps(image, self.observer());
        Ok(())
    }

    /// Shows an image, or a strip of it, behind the requested polarizer, under the requested lamps and for the requested observer.
    pub(super) fn light(&self, image: &mut SpectralImage) -> miette::Result<()> {
        self.polarize(image)?;
        self.lamps.apply(image)
    }

    /// Puts the requested polarizer in front of an image, or of a strip of it.
    pub(super) fn polarize(&self, image: &mut SpectralImage) -> miette::Result<()> {
        match &self.polarizer {
            None => Ok(()),
            Some(polarizer) => {
                behind(image, polarizer).map_err(|error| not_polarized("--polarizer", error))
            }
        }
    }

    pub(crate) fn observer(&self) -> Observer {
        self.lamps.observer()
    }

    /// Whether the spectra are needed, because colors are not enough.
    pub(crate) fn needs_spectra(&self) -> bool {
        let needs_lamp = self.adapt != Adaptation::None && self.adapt_from.is_none();
        needs_lamp || self.needs_bands() || !self.lamps.is_nothing() || self.polarizer.is_some()
    }

    /// Whether the picture depends on the bands of all pixels: the halo in an eye is a ring for each wavelength.
    pub(super) fn needs_bands(&self) -> bool {
        matches!(self.glare, GlareName::Mesopic | GlareName::Scotopic)
    }

    fn adaptation(&self, of_image: ImageProperties) -> miette::Result<Option<WhiteAdaptation>> {
        if self.adapt == Adaptation::None {
            return Ok(None);
        }
        let from = match &self.adapt_from {
            Some(white) => white.seen_by(self.observer())?,
            None => of_image.lamp.ok_or_else(unknown_lamp)?,
        };
        let method = self.adapt;
        Ok(Some(WhiteAdaptation { method, from }))
    }

    pub(super) fn settings(
        &self,
        of_image: ImageProperties,
        height: u32,
    ) -> miette::Result<DevelopSettings> {
        let exposure = match self.exposure {
            None => Exposure::Stops(of_image.exposure_ev),
            Some(ExposureOption::Fixed(exposure)) => exposure,
            Some(ExposureOption::Display) => Exposure::White(self.display.white_luminance()),
        };
        let glare = match (self.glare, self.glare.vision()) {
            (_, Some(vision)) => {
                let fov_deg = self.glare_fov.or(of_image.fov_deg).unwrap_or_default();
                Glare::Eye(EyeGlare::of_view(fov_deg, height, vision))
            }
            (GlareName::Star, None) => Glare::Star(StarGlare {
                length: self.star_length.unwrap_or(StarGlare::default().length),
            }),
            _ => Glare::Off,
        };
        let seen = self.display.seen_by(self.observer());
        Ok(DevelopSettings {
            observer: self.observer(),
            exposure,
            adaptation: self.adaptation(of_image)?,
            glare,
            gamut: self.gamut.map(Into::into).unwrap_or_default(),
            gamut_warning: self.gamut_warning,
            dither: self.dither,
            ..DevelopSettings::new(seen.unwrap_or_else(|| self.display.clone()))
        })
    }

    /// Develops an image into a picture of 8-bit codes.
    pub(crate) fn codes<'a>(
        &self,
        image: impl Into<Latent<'a>>,
        of_image: ImageProperties,
        height: u32,
    ) -> miette::Result<RgbImage8> {
        develop(image, &self.settings(of_image, height)?)
            .into_diagnostic()
            .wrap_err("the picture cannot be developed")
    }

    pub(crate) fn display(&self) -> &Display {
        &self.display
    }
}
