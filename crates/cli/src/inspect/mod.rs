//! `pellicle inspect`.

mod film;
mod plot;
mod polarization;
mod report;

use crate::film::numbers::{self, Vary};
use crate::image_file;
use clap::ValueEnum;
use film::FilmFinding;
use miette::IntoDiagnostic;
use pellicle::color::{Probe, Probing, Region};
use pellicle::picture_file::spectral_exr::RowReader;
use std::path::PathBuf;

/// Show the spectrum, noise and color of pixels and regions of a spectral image, and the film that they show.
///
/// If --at and --region are left out, the mean of the whole image is shown. The thickness of a film is fitted if --scene gives the
/// scene that was rendered, which has the film and the angle at each pixel, or if --film gives a stack. It prints the
/// thicknesses that fit best by the shape of the spectrum and by color, each up to a scale, with their residuals.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The spectral image (.exr)
    image: PathBuf,
    /// A pixel, counted from 0 from the left and the top; can be repeated
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    at: Vec<Region>,
    /// A rectangle of pixels to average; can be repeated
    #[arg(long, value_name = "X,Y,WIDTH,HEIGHT", value_parser = region)]
    region: Vec<Region>,
    /// Exposure in stops [default: the stops of the file]
    #[arg(long, value_name = "EV", allow_hyphen_values = true)]
    exposure: Option<f64>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Write a plot of the spectra (.svg or .png)
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    film: FilmArguments,
}

/// The film to fit.
#[derive(clap::Args)]
struct FilmArguments {
    /// The scene that the image was rendered from: it gives the film at each pixel, the angle and the lamps
    #[arg(long, value_name = "FILE", conflicts_with_all = ["film", "angle", "lamp"])]
    scene: Option<PathBuf>,
    /// Allow the scene or stack to refer to files outside its folder; use this only for files that you trust
    #[arg(long)]
    allow_outside: bool,
    /// The film that the pixels show: a stack file, or a stack in one line such as "1 | water 300nm | 1"
    #[arg(long, value_name = "STACK")]
    film: Option<String>,
    /// The angle at which --film is seen, in degrees
    #[arg(long, value_name = "DEGREES", requires = "film", value_parser = numbers::number, allow_hyphen_values = true)]
    angle: Option<f64>,
    /// The lamp that --film reflects: the name of an illuminant or a file such as a .csv [default: the lamps of the image's
    /// light groups if it records them, else D65]
    #[arg(long, value_name = "LAMP", requires = "film")]
    lamp: Option<String>,
    /// The layer whose thickness is fitted, counted from 1, and its range in nm [default: layer 1 from 0 to 2000 nm]
    #[arg(long, value_name = "LAYER:FROM:TO", value_parser = Vary::parse, allow_hyphen_values = true)]
    vary: Option<Vary>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// A text table
    Table,
    /// wavelength_nm, then radiance, its standard deviation and, of a polarized image, S1 to S3 at each position
    Csv,
    /// All results
    Json,
}

/// An image and what is known about it.
struct Inspection<'a> {
    arguments: &'a Arguments,
    image: RowReader,
    exposure_ev: f64,
    places: Vec<Position>,
}

/// A pixel or region of the image and what is known about it.
struct Position {
    /// `320,200`, `10,10,40,40` or `the whole image`.
    label: String,
    probe: Probe,
    film: Option<FilmFinding>,
}

/// Inspects, prints and draws.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    plot::check(arguments)?;
    let inspection = Inspection::new(arguments)?;
    match arguments.format {
        Format::Table => inspection.print_table()?,
        Format::Csv => inspection.print_csv()?,
        Format::Json => inspection.print_json()?,
    }
    plot::write(&inspection)
}

impl<'a> Inspection<'a> {
    fn new(arguments: &'a Arguments) -> miette::Result<Self> {
        let exposure = arguments.exposure.map(image_file::checked_exposure);
        let exposure = exposure.transpose()?;
        let image = image_file::rows(&arguments.image)?;
        let exposure_ev = exposure.unwrap_or(image.metadata().exposure_ev);
        let mut inspection = Self {
            arguments,
            image,
            exposure_ev,
            places: Vec::new(),
        };
        let asked = arguments.at.iter().chain(&arguments.region);
        let mut regions: Vec<(String, Region)> =
            asked.map(|region| (label(region), *region)).collect();
        if regions.is_empty() {
            let [width, height] = inspection.image.size();
            let whole = Region {
                x: 0,
                y: 0,
                width,
                height,
            };
            regions.push(("the whole image".to_owned(), whole));
        }
        let films = film::Films::new(&inspection)?;
        let probes = inspection.probes(regions.iter().map(|(_, region)| *region))?;
        for ((label, _), probe) in regions.into_iter().zip(probes) {
            let film = films.find(&inspection, &probe)?;
            inspection.places.push(Position { label, probe, film });
        }
        Ok(inspection)
    }

    /// The means of regions, from those strips of the image that they need.
    fn probes(&mut self, regions: impl Iterator<Item = Region>) -> miette::Result<Vec<Probe>> {
        let size = self.image.size();
        let probings = regions.map(|region| Probing::new(size, region));
        let mut probings: Vec<Probing> = probings.collect::<Result<_, _>>().into_diagnostic()?;
        for strip in self.image.strips(image_file::STRIP_BYTES) {
            let needed = probings.iter().map(|probing| probing.rows_within(&strip));
            let needed = needed.filter(|rows| !rows.is_empty());
            let Some(rows) = needed.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)) else {
                continue;
            };
            let top = rows.start;
            let pixels = image_file::strip(&self.arguments.image, &mut self.image, rows)?;
            for probing in &mut probings {
                probing.add(&pixels, top);
            }
        }
        image_file::verify(&self.arguments.image, &mut self.image)?;
        Ok(probings.into_iter().map(Probing::finish).collect())
    }
}

fn label(region: &Region) -> String {
    let Region {
        x,
        y,
        width,
        height,
    } = region;
    match (width, height) {
        (1, 1) => format!("{x},{y}"),
        _ => format!("{x},{y},{width},{height}"),
    }
}

fn pixel(text: &str) -> Result<Region, String> {
    match whole_numbers(text).as_deref() {
        Some(&[x, y]) => Ok(Region::pixel(x, y)),
        _ => Err("a pixel is written like 320,200".to_owned()),
    }
}

fn region(text: &str) -> Result<Region, String> {
    match whole_numbers(text).as_deref() {
        Some(&[x, y, width, height]) => Ok(Region {
            x,
            y,
            width,
            height,
        }),
        _ => Err("a region is written like 10,20,40,30: left, top, width, height".to_owned()),
    }
}

fn whole_numbers(text: &str) -> Option<Vec<u32>> {
    text.split(',')
        .map(|number| number.trim().parse().ok())
        .collect()
}
