//! `pellicle develop`: a spectral image becomes a picture for a display; and the options by which `render` does the same.

use crate::booth::{self, BoothLamp};
use crate::image_file;
use crate::lamp;
use crate::output::check_place;
use crate::print;
use crate::relight::RelightArguments;
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::develop::{
    DevelopSettings, Exposure, EyeGlare, GamutMapping, GamutReport, Glare, Latent, LinearImage,
    SceneWhite, StarGlare, Vision, WhiteAdaptation, expose, gamut, quantise,
};
use pellicle::color::rgb_exr::Samples;
use pellicle::color::spectral_exr::{self, Metadata};
use pellicle::color::{RgbImage8, develop, png, rgb_exr};
use pellicle::colorimetry::chromaticity::xy_of_xyz;
use pellicle::colorimetry::{Adaptation, Display, tristimulus};
use pellicle::spectra::{LightGroup, Observer, SpectralImage, Spectrum};
use std::ffi::OsStr;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The spectral image (EXR), as `render` writes it
    image: PathBuf,
    /// What to write: .png for the display, .exr for its linear red, green and blue; can be repeated
    #[arg(short, long, value_name = "PATH", required = true)]
    output: Vec<PathBuf>,
    /// A contact sheet (.png): the image with all its lights burning with each of these lamps in turn, like A,D65,F11,LED-B3,
    /// each times a factor or not
    #[arg(long, conflicts_with = "lights", value_name = "LAMP,LAMP,…", value_delimiter = ',', value_parser = booth::lamp)]
    booth: Vec<BoothLamp>,
    #[command(flatten)]
    options: Options,
}

/// How a picture is developed.
#[derive(clap::Args)]
#[command(next_help_heading = "Developing")]
pub(crate) struct Options {
    #[command(flatten)]
    lamps: RelightArguments,
    /// How much light becomes the display's white: stops (3), a luminance in the scene (250cd), that of the display (display), or
    /// the one that a percentage of the pixels does not exceed (auto, which is auto:99) [default: the scene's stops]
    #[arg(long, value_name = "STOPS|CDcd|display|auto[:PERCENT]", value_parser = exposure, allow_hyphen_values = true)]
    exposure: Option<ExposureOption>,
    /// The display, by its name or a file .toml; `pellicle display` lists the names
    #[arg(long, value_name = "NAME|FILE", default_value = "srgb", value_parser = display)]
    display: Display,
    /// Adapt from the scene's white to the display's
    #[arg(long, value_name = "none|bradford|cat16", default_value = "none")]
    adapt: Adaptation,
    /// The scene's white: that of its own brightest lamp, of another lamp, a chromaticity x,y, or the image's mean [default: its
    /// own lamp]
    #[arg(long, value_name = "LAMP|X,Y|mean", value_parser = white)]
    adapt_from: Option<White>,
    /// What bright light does to its surroundings: a star of what is too bright for the display, or the glare of an eye adapted to
    /// light, to dusk or to dark
    #[arg(long, value_enum, default_value_t = GlareName::Off)]
    glare: GlareName,
    /// For the glare of the eye: the height of the view [default: the scene's camera]
    #[arg(long, value_name = "DEGREES", value_parser = fov)]
    glare_fov: Option<f64>,
    /// For the star: where its arms have fallen to 1/e, as a share of the picture's height [default: 0.05]
    #[arg(long, value_name = "SHARE", value_parser = star_length)]
    star_length: Option<f64>,
    /// What becomes of colours that the display cannot show: chroma taken away at constant hue and lightness, mixed with white at
    /// constant luminance, clipped, or kept, for .exr [default: perceptual, for .exr keep]
    #[arg(long, value_enum)]
    gamut: Option<GamutName>,
    /// Stripe the pixels that the display cannot show
    #[arg(long)]
    gamut_warning: bool,
    /// Print which share of the pixels the display cannot show, and how far the mapping moves them
    #[arg(long)]
    gamut_report: bool,
    /// Bits of a channel: 8 or 16 in a .png, 16 or 32 in an .exr [default: 8 and 16]
    #[arg(long, value_name = "8|16|32", value_parser = bits)]
    bits: Option<u8>,
    /// Spread the rounding to codes over neighbouring pixels, so that gradients show no steps
    #[arg(long)]
    dither: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum ExposureOption {
    Fixed(Exposure),
    /// The luminance of the display's own white.
    Display,
}

/// A white to adapt from. What a lamp's is depends on the observer.
#[derive(Clone, Debug, PartialEq)]
enum White {
    Of(SceneWhite),
    Lamp(String, Spectrum),
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum GlareName {
    Off,
    Star,
    Photopic,
    Mesopic,
    Scotopic,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum GamutName {
    Perceptual,
    White,
    Clip,
    Keep,
}

/// Stops that an exposure may have.
const STOPS: RangeInclusive<f64> = -40.0..=40.0;
/// Luminances that may become the white.
const LUMINANCES: RangeInclusive<f64> = 1e-9..=1e12;
const FOV_DEG: RangeInclusive<f64> = 0.01..=170.0;
const STAR_LENGTHS: RangeInclusive<f64> = 1e-4..=10.0;

/// A number within a range.
fn number(text: &str, range: &RangeInclusive<f64>) -> Option<f64> {
    text.trim().parse().ok().filter(|v| range.contains(v))
}

fn exposure(text: &str) -> Result<ExposureOption, String> {
    let fixed = match text.split_once(':') {
        _ if text == "display" => return Ok(ExposureOption::Display),
        _ if text == "auto" => Some(Exposure::Percentile(99.0)),
        Some(("auto", percent)) => number(percent, &(0.0..=100.0)).map(Exposure::Percentile),
        _ => match text.strip_suffix("cd") {
            Some(luminance) => number(luminance, &LUMINANCES).map(Exposure::White),
            None => number(text, &STOPS).map(Exposure::Stops),
        },
    };
    fixed.map(ExposureOption::Fixed).ok_or_else(|| {
        "an exposure is stops from -40 to 40 (3), a luminance in cd/m² (250cd), display, auto, or auto with a percentage \
         (auto:95)"
            .to_owned()
    })
}

fn display(text: &str) -> Result<Display, String> {
    Display::open(text).map_err(|error| error.to_string())
}

fn white(text: &str) -> Result<White, String> {
    if text == "mean" {
        return Ok(White::Of(SceneWhite::Mean));
    }
    if let Some((x, y)) = text.split_once(',') {
        let share = 1e-3..=1.0;
        let xy = number(x, &share).zip(number(y, &share));
        return match xy.filter(|(x, y)| x + y <= 1.0) {
            Some((x, y)) => Ok(White::Of(SceneWhite::Chromaticity([x, y]))),
            None => Err(
                "a chromaticity is two numbers above 0 with a sum up to 1, as in 0.3127,0.3290"
                    .to_owned(),
            ),
        };
    }
    let (name, spectrum) = lamp::spectrum(text)?;
    Ok(White::Lamp(name, spectrum))
}

impl White {
    /// The renderer reads a lamp's table as linear between its points, and so does this, lamps with lines included.
    fn seen_by(&self, observer: Observer) -> miette::Result<SceneWhite> {
        let (name, spectrum) = match self {
            Self::Of(white) => return Ok(*white),
            Self::Lamp(name, spectrum) => (name, spectrum),
        };
        let xyz = tristimulus::xyz_of_emission(spectrum, observer, tristimulus::Rule::OneNm);
        let xyz = xyz
            .into_diagnostic()
            .wrap_err_with(|| format!("--adapt-from {name}"))?;
        Ok(SceneWhite::Chromaticity(xy_of_xyz(xyz)))
    }
}

fn fov(text: &str) -> Result<f64, String> {
    number(text, &FOV_DEG).ok_or_else(|| "a view is 0.01 to 170 degrees high".to_owned())
}

fn star_length(text: &str) -> Result<f64, String> {
    number(text, &STAR_LENGTHS).ok_or_else(|| "a share of the height is 0.0001 to 10".to_owned())
}

fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        "32" => Ok(32),
        _ => Err("a channel has 8 or 16 bits in a .png, 16 or 32 in an .exr".to_owned()),
    }
}

impl From<GamutName> for GamutMapping {
    fn from(name: GamutName) -> Self {
        match name {
            GamutName::Perceptual => Self::Perceptual,
            GamutName::White => Self::TowardWhite,
            GamutName::Clip => Self::Clip,
            GamutName::Keep => Self::Keep,
        }
    }
}

impl GlareName {
    fn vision(self) -> Option<Vision> {
        match self {
            Self::Off | Self::Star => None,
            Self::Photopic => Some(Vision::Photopic),
            Self::Mesopic => Some(Vision::Mesopic),
            Self::Scotopic => Some(Vision::Scotopic),
        }
    }
}

/// What an image says of itself that developing asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct OfImage {
    /// The exposure that it was rendered with.
    pub(crate) exposure_ev: f64,
    /// Height of the camera's view, of a perspective camera.
    pub(crate) fov_deg: Option<f64>,
    /// The white of its brightest lamp.
    pub(crate) lamp: Option<SceneWhite>,
}

/// The name under which a spectral image keeps the height of its camera's view.
pub(crate) const FOV_SETTING: &str = "fov_deg";

impl OfImage {
    fn said_by(metadata: &Metadata) -> Self {
        let fov = metadata.settings.get(FOV_SETTING);
        Self {
            exposure_ev: metadata.exposure_ev,
            fov_deg: fov.and_then(|text| number(text, &FOV_DEG)),
            lamp: None,
        }
    }
}

fn unknown_lamp() -> miette::Report {
    miette!(
        help = "say with --adapt-from which lamp is white, or `mean` for the image's mean",
        "--adapt: what the image's brightest lights burn with is not known"
    )
}

fn without_effect(option: &str, needs: &str) -> miette::Report {
    miette!(
        help = format!("leave {option} out, or add {needs}"),
        "{option} has no effect without {needs}"
    )
}

impl Options {
    /// Tells what cannot be before the work, not after it.
    pub(crate) fn check(&self, pictures: &[PathBuf], of_image: OfImage) -> miette::Result<()> {
        for path in pictures {
            self.format(path)?;
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
                "{}: its primaries are known for CIE 1931 alone, and take XYZ of {} as if they were that observer's",
                self.display.name(),
                self.observer()
            ));
        }
        if self.glare.vision().is_some() && self.glare_fov.or(of_image.fov_deg).is_none() {
            return Err(miette!(
                help = "say how high the view is with --glare-fov DEGREES",
                "--glare: the glare of an eye depends on the angle of view, which is not known for this image"
            ));
        }
        Ok(())
    }

    /// Tells before a picture of these light groups is rendered if none of them will be its white.
    pub(crate) fn check_lamps(&self, groups: &[LightGroup]) -> miette::Result<()> {
        let needs_lamp = self.adapt != Adaptation::None && self.adapt_from.is_none();
        if needs_lamp && groups.iter().any(|group| group.lamp.is_none()) {
            return Err(unknown_lamp());
        }
        Ok(())
    }

    /// Tells which of these options a contact sheet does not have.
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

    /// Shows an image under the lamps and to the observer asked for, and keeps in mind by which lamp it then is.
    pub(crate) fn relight(
        &self,
        image: &mut SpectralImage,
        of_image: &mut OfImage,
    ) -> miette::Result<()> {
        self.lamps.apply(image)?;
        of_image.lamp = SceneWhite::of_lamps(image, self.observer());
        Ok(())
    }

    pub(crate) fn observer(&self) -> Observer {
        self.lamps.observer()
    }

    /// Whether the spectra are needed, or colours are enough.
    fn needs_spectra(&self) -> bool {
        let needs_lamp = self.adapt != Adaptation::None && self.adapt_from.is_none();
        let needs_bands = matches!(self.glare, GlareName::Mesopic | GlareName::Scotopic);
        needs_lamp || needs_bands || !self.lamps.is_nothing()
    }

    fn adaptation(&self, of_image: OfImage) -> miette::Result<Option<WhiteAdaptation>> {
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

    fn settings(&self, of_image: OfImage, height: u32) -> miette::Result<DevelopSettings> {
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

    /// The codes of a picture of 8 bits.
    pub(crate) fn codes<'a>(
        &self,
        image: impl Into<Latent<'a>>,
        of_image: OfImage,
        height: u32,
    ) -> miette::Result<RgbImage8> {
        develop(image, &self.settings(of_image, height)?)
            .into_diagnostic()
            .wrap_err("the picture cannot be developed")
    }

    pub(crate) fn display(&self) -> &Display {
        &self.display
    }

    fn format(&self, path: &Path) -> miette::Result<Format> {
        let extension = path.extension().map(OsStr::to_string_lossy);
        let extension = extension.map(|name| name.to_lowercase());
        match (extension.as_deref(), self.bits) {
            (Some("png"), None | Some(8)) => Ok(Format::Png8),
            (Some("png"), Some(16)) => Ok(Format::Png16),
            (Some("exr"), None | Some(16)) => Ok(Format::Exr(Samples::Half)),
            (Some("exr"), Some(32)) => Ok(Format::Exr(Samples::Float)),
            (Some("png" | "exr"), Some(bits)) => Err(miette!(
                help = "a .png has 8 or 16, an .exr 16 or 32",
                "{}: a file of this kind has no channels of {bits} bits",
                path.display()
            )),
            _ => Err(miette!(
                help = "end it in .png (codes of the display) or .exr (linear red, green and blue)",
                "-o {}: a picture with this ending cannot be written",
                path.display()
            )),
        }
    }

    /// Develops an image and writes each picture of it.
    pub(crate) fn write<'a>(
        &self,
        image: impl Into<Latent<'a>>,
        of_image: OfImage,
        height: u32,
        pictures: &[PathBuf],
    ) -> miette::Result<()> {
        if pictures.is_empty() {
            return Ok(());
        }
        let settings = self.settings(of_image, height)?;
        let linear = expose(image, &settings)
            .into_diagnostic()
            .wrap_err("the picture cannot be developed")?;
        let not_finite = linear.not_finite();
        if not_finite > 0 {
            print::note(format_args!(
                "pixels that are no numbers: {not_finite}; they are shown black"
            ));
        }
        if self.gamut_report {
            report(&GamutReport::of(&linear, &settings), &settings)?;
        }
        for path in pictures {
            self.write_one(path, &linear, &settings)
                .wrap_err_with(|| format!("{} was not written", path.display()))?;
            print::note(format_args!("wrote {}", path.display()));
        }
        Ok(())
    }

    fn write_one(
        &self,
        path: &Path,
        linear: &LinearImage,
        settings: &DevelopSettings,
    ) -> miette::Result<()> {
        let format = self.format(path)?;
        let mut settings = settings.clone();
        if self.gamut.is_none() && matches!(format, Format::Exr(_)) {
            settings.gamut = GamutMapping::Keep;
        }
        let mut linear = linear.clone();
        gamut::map(&mut linear, &settings);
        let (display, dither) = (&settings.display, settings.dither);
        match format {
            Format::Png8 => {
                let codes = quantise::codes::<u8>(&linear, display, dither);
                png::write_for_display(path, &codes, display).into_diagnostic()
            }
            Format::Png16 => {
                let codes = quantise::codes::<u16>(&linear, display, dither);
                png::write_for_display(path, &codes, display).into_diagnostic()
            }
            Format::Exr(samples) => {
                rgb_exr::write(path, &linear, display, samples).into_diagnostic()
            }
        }
    }
}

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Png8,
    Png16,
    Exr(Samples),
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
        print::result(format_args!("{} pixels are no numbers", report.not_finite))?;
    }
    if report.outside > report.not_finite {
        print::result(format_args!(
            "mapping moves those by ΔE2000 {:.2} on average, median {:.2}, 95 % below {:.2}, at most {:.2}",
            report.mean, report.median, report.p95, report.max
        ))?;
    }
    Ok(())
}

/// Reads, develops and writes.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let (path, options) = (&arguments.image, &arguments.options);
    for output in &arguments.output {
        options.format(output)?;
        check_place("-o", output, path)?;
    }
    if !arguments.booth.is_empty() {
        booth::check(&arguments.booth, &arguments.output)?;
        options.check_booth()?;
        let (image, metadata) = image_file::spectral(path)?;
        let of_image = OfImage::said_by(&metadata);
        options.check(&arguments.output, of_image)?;
        return booth::write(
            &image,
            of_image,
            &arguments.booth,
            options,
            &arguments.output,
        );
    }
    if options.needs_spectra() {
        let (mut image, metadata) = spectral_exr::read(path).into_diagnostic()?;
        image_file::tell(path, &metadata);
        let mut of_image = OfImage::said_by(&metadata);
        options.relight(&mut image, &mut of_image)?;
        write(arguments, &image, image.height(), of_image)
    } else {
        let (image, metadata) = spectral_exr::read_xyz(path).into_diagnostic()?;
        image_file::tell(path, &metadata);
        write(
            arguments,
            &image,
            image.height(),
            OfImage::said_by(&metadata),
        )
    }
}

fn write<'a>(
    arguments: &Arguments,
    image: impl Into<Latent<'a>>,
    height: u32,
    of_image: OfImage,
) -> miette::Result<()> {
    let (options, outputs) = (&arguments.options, &arguments.output);
    options.check(outputs, of_image)?;
    options.write(image, of_image, height, outputs)
}
