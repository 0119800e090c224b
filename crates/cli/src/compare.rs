//! `pellicle compare`.

use crate::image_file::{self, Opened};
use crate::{output, print};
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::compare::{self, BandDifference, BandSums, Noise, Picture, Summary};
use pellicle::picture_file::png;
use pellicle::picture_file::spectral_exr::RowReader;
use pellicle::relight::XyzImage;
use pellicle::spectra::Stokes;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Compare two images: per band, in color, and as the eye sees them.
///
/// The first image is the reference: a bias above 0 means that the second is brighter. Both are spectral images (.exr) or
/// pictures (.png), which have no bands. Colors are compared as an sRGB display shows them, both at the exposure of the first.
/// Color differences (CIEDE2000) include what the display would clip; FLIP and PSNR do not. Of polarized images, S1, S2 and S3 are
/// compared too.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The reference image, .exr or .png
    first: PathBuf,
    /// The image to compare with the reference, .exr or .png
    second: PathBuf,
    /// Write a picture of the differences (.png): black is 0, pale yellow is FLIP 1 or ΔE2000 10 and more
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// The difference that --map shows
    #[arg(long, value_enum, default_value_t = MapOf::Flip, requires = "map")]
    map_of: MapOf,
    /// Stops by which spectral images are shown brighter [default: those of the first image]
    #[arg(long, value_name = "EV", allow_hyphen_values = true)]
    exposure: Option<f64>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum MapOf {
    Flip,
    DeltaE,
}

impl MapOf {
    /// The value that is pale yellow.
    fn full(self) -> f64 {
        match self {
            Self::Flip => 1.0,
            Self::DeltaE => 10.0,
        }
    }
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// A text table
    Table,
    /// All results, for programs
    Json,
}

/// The results of a comparison.
struct Comparison {
    size: [usize; 2],
    /// `None` for pictures, whose exposure is fixed.
    exposure_ev: Option<f64>,
    delta_e: Vec<f64>,
    flip: Vec<f64>,
    psnr_db: f64,
    /// Empty if one of the images has none.
    bands: Vec<BandDifference>,
    /// S1, S2 and S3, if both images are polarized.
    components: Vec<(Stokes, Vec<BandDifference>)>,
}

/// Compares and prints.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    if let Some(map) = &arguments.map {
        check_map(map, arguments)?;
    }
    let first = Opened::read(&arguments.first)?;
    let second = Opened::read(&arguments.second)?;
    let comparison = Comparison::new(first, second, arguments)?;
    match arguments.format {
        Format::Table => print::result(comparison.table(arguments).trim_end())?,
        Format::Json => print::result(format_args!("{:#}", comparison.json(arguments)))?,
    }
    match &arguments.map {
        Some(path) => comparison.write_map(path, arguments.map_of),
        None => Ok(()),
    }
}

fn check_map(map: &Path, arguments: &Arguments) -> miette::Result<()> {
    let is_png = map
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if !is_png {
        return Err(miette!(
            help = "end it in .png",
            "--map {}: a map with this ending cannot be written",
            map.display()
        ));
    }
    output::check_place("--map", map, &arguments.first)?;
    output::check_place("--map", map, &arguments.second)
}

impl Comparison {
    fn new(first: Opened, second: Opened, arguments: &Arguments) -> miette::Result<Self> {
        let own = first.exposure_ev().or(second.exposure_ev());
        let exposure_ev = match arguments.exposure {
            Some(_) if own.is_none() => {
                return Err(miette!(
                    "--exposure has no effect here: the exposure of pictures is fixed"
                ));
            }
            Some(ev) => Some(image_file::checked_exposure(ev)?),
            None => own,
        };
        let ev = exposure_ev.unwrap_or_default();
        check_tags(&first, &second)?;
        let (mut components, [a, b]) = match (first, second) {
            (Opened::Spectral(mut a), Opened::Spectral(mut b)) => {
                say_polarization(&a, &b, arguments);
                let (components, colors) = spectra(&mut a, &mut b, arguments)?;
                let pictures = colors.map(|colors| Picture::of_colors(&colors, ev));
                (components, pictures)
            }
            (a, b) => {
                let a = a.picture(&arguments.first, ev)?;
                (Vec::new(), [a, b.picture(&arguments.second, ev)?])
            }
        };
        let bands = if components.is_empty() {
            Vec::new()
        } else {
            components.remove(0).1
        };
        let of = |error| unlike(&error, arguments);
        Ok(Self {
            size: a.size(),
            exposure_ev,
            delta_e: compare::delta_e(&a, &b).map_err(of)?,
            flip: compare::flip(&a, &b).map_err(of)?,
            psnr_db: compare::psnr(&a, &b).map_err(of)?,
            bands,
            components,
        })
    }

    fn summaries(&self) -> [(&'static str, Option<Summary>); 2] {
        [
            ("ΔE2000", Summary::new(&self.delta_e)),
            ("FLIP", Summary::new(&self.flip)),
        ]
    }

    fn place(&self, index: usize) -> [usize; 2] {
        [index % self.size[0], index / self.size[0]]
    }

    fn table(&self, arguments: &Arguments) -> String {
        let [width, height] = self.size;
        let mut text = format!(
            "{} against {}: {width}×{height} pixels",
            arguments.second.display(),
            arguments.first.display()
        );
        if let Some(ev) = self.exposure_ev {
            let _ = write!(text, ", shown at {ev:+} EV");
        }
        let _ = writeln!(
            text,
            "\n\n{:<8} {:>9} {:>9} {:>9} {:>9} {:>9}  at",
            "", "mean", "50 %", "95 %", "99 %", "max"
        );
        for (name, summary) in self.summaries() {
            let Some(s) = summary else {
                let _ = writeln!(text, "{name:<8} no pixel is finite");
                continue;
            };
            let figures = [s.mean, s.p50, s.p95, s.p99, s.max].map(|v| format!("{v:>9.4}"));
            let [x, y] = self.place(s.max_at);
            let _ = write!(text, "{name:<8} {}  {x},{y}", figures.join(" "));
            if s.left_out > 0 {
                let _ = write!(text, "  ({} pixels are not finite)", s.left_out);
            }
            text.push('\n');
        }
        let _ = writeln!(text, "{:<8} {:>9}", "PSNR", decibels(self.psnr_db));
        if !self.bands.is_empty() {
            text.push('\n');
            self.table_of_bands(&mut text);
        }
        if !self.components.is_empty() {
            text.push('\n');
            self.table_of_components(&mut text);
        }
        text
    }

    /// S1, S2 and S3 over all bands, relative to the mean of S0.
    fn table_of_components(&self, text: &mut String) {
        let of_s0 = mean(&self.bands, |band| band.reference_mean);
        let _ = writeln!(
            text,
            "{:>9} {:>12} {:>12} {:>12} {:>12}",
            "over S0", "mean", "bias", "RMSE", "RMSE/noise"
        );
        for (stokes, bands) in &self.components {
            let rmse = mean(bands, |band| band.rmse * band.rmse).sqrt();
            let figures = [
                mean(bands, |band| band.reference_mean),
                mean(bands, |band| band.bias),
                rmse,
            ];
            let _ = write!(text, "{:>9}", stokes.name());
            for figure in figures {
                // Where there is no light at all, nothing is a part of it.
                let _ = if of_s0 > 0.0 {
                    write!(text, " {:>12.4e}", figure / of_s0)
                } else {
                    write!(text, " {:>12}", "-")
                };
            }
            match over_noise(bands) {
                Some(ratio) => _ = writeln!(text, " {ratio:>12.3}"),
                None => text.push('\n'),
            }
        }
        if self
            .components
            .iter()
            .any(|(_, bands)| over_noise(bands).is_some())
        {
            text.push_str(
                "the noise is that of S0: S1 to S3 have less where light is not fully polarized\n",
            );
        }
    }

    fn table_of_bands(&self, text: &mut String) {
        let knows_noise = self.bands.iter().any(|band| band.noise.is_some());
        let _ = write!(
            text,
            "{:>9} {:>12} {:>12} {:>12}",
            "nm", "mean", "bias", "RMSE"
        );
        if knows_noise {
            let _ = write!(text, " {:>12} {:>8}", "noise", "bias/σ");
        }
        text.push('\n');
        for band in &self.bands {
            let _ = write!(
                text,
                "{:>9.2} {:>12.5e} {:>12.4e} {:>12.5e}",
                band.center_nm, band.reference_mean, band.bias, band.rmse
            );
            if let Some(noise) = band.noise {
                let _ = write!(text, " {:>12.5e} {:>8.2}", noise.rmse, noise.bias_sigmas);
            }
            if band.left_out > 0 {
                let _ = write!(text, "  ({} values are not finite)", band.left_out);
            }
            text.push('\n');
        }
        if let Some(ratio) = over_noise(&self.bands) {
            let _ = writeln!(
                text,
                "\nover all bands the RMSE is {ratio:.3} times the RMSE expected from noise: \
                 about 1 if images with different seeds differ only by noise"
            );
        }
    }

    fn json(&self, arguments: &Arguments) -> Value {
        let summary = |summary: Option<Summary>| {
            summary.map(|s| {
                json!({
                    "mean": s.mean, "p50": s.p50, "p95": s.p95, "p99": s.p99, "max": s.max,
                    "max_at": self.place(s.max_at), "left_out": s.left_out,
                })
            })
        };
        let noise = |noise: Noise| json!({ "rmse": noise.rmse, "bias_sigmas": noise.bias_sigmas });
        let band = |band: &BandDifference| {
            json!({
                "center_nm": band.center_nm, "mean": band.reference_mean, "bias": band.bias,
                "rmse": band.rmse, "noise": band.noise.map(noise), "left_out": band.left_out,
            })
        };
        let [(_, delta_e), (_, flip)] = self.summaries();
        json!({
            "about": "differences are the second image minus the first; FLIP and PSNR are of sRGB codes",
            "program": concat!("pellicle ", env!("CARGO_PKG_VERSION")),
            "first": arguments.first.display().to_string(),
            "second": arguments.second.display().to_string(),
            "size": self.size,
            "exposure_ev": self.exposure_ev,
            "delta_e_2000": summary(delta_e),
            "flip": summary(flip),
            "psnr_db": self.psnr_db.is_finite().then_some(self.psnr_db),
            "bands": self.bands.iter().map(band).collect::<Vec<_>>(),
            "rmse_over_noise": over_noise(&self.bands),
            "components": self.components.iter().map(|(stokes, bands)| json!({
                "component": stokes.name(),
                "bands": bands.iter().map(band).collect::<Vec<_>>(),
                "rmse_over_noise_of_s0": over_noise(bands),
            })).collect::<Vec<_>>(),
        })
    }

    fn write_map(&self, path: &Path, of: MapOf) -> miette::Result<()> {
        let values = match of {
            MapOf::Flip => &self.flip,
            MapOf::DeltaE => &self.delta_e,
        };
        let map = compare::heat_map(self.size, values, of.full())
            .ok_or_else(|| miette!("{}: the images have no pixels", path.display()))?;
        png::write(path, &map)
            .into_diagnostic()
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        print::note(format_args!("wrote {}", path.display()));
        Ok(())
    }
}

/// The root mean square difference divided by that of noise alone, over all bands where noise is known.
fn over_noise(bands: &[BandDifference]) -> Option<f64> {
    let known = || {
        let with_noise = |band: &BandDifference| band.noise.map(|noise| (band.rmse, noise.rmse));
        bands.iter().filter_map(with_noise)
    };
    let difference: f64 = known().map(|(rmse, _)| rmse * rmse).sum();
    let noise: f64 = known().map(|(_, noise)| noise * noise).sum();
    (noise > 0.0).then(|| (difference / noise).sqrt())
}

/// The mean over all bands.
fn mean(bands: &[BandDifference], of: impl Fn(&BandDifference) -> f64) -> f64 {
    bands.iter().map(of).sum::<f64>() / bands.len().max(1) as f64
}

/// Notes that only one of two images is polarized.
fn say_polarization(first: &RowReader, second: &RowReader, arguments: &Arguments) {
    let with = match [first, second].map(|rows| rows.content().is_polarized) {
        [true, false] => &arguments.first,
        [false, true] => &arguments.second,
        _ => return,
    };
    print::note(format_args!(
        "only {} holds S1, S2 and S3 of polarized light: the images are compared by their radiance, S0",
        with.display()
    ));
}

/// The differences of one component of the Stokes vector after the other, from S0 on.
type Components = Vec<(Stokes, Vec<BandDifference>)>;

fn decibels(psnr_db: f64) -> String {
    if psnr_db.is_finite() {
        format!("{psnr_db:.2} dB")
    } else {
        "none: the codes are the same".to_owned()
    }
}

fn unlike(error: &compare::CompareError, arguments: &Arguments) -> miette::Report {
    let (first, second) = (arguments.first.display(), arguments.second.display());
    miette!(
        help = "render both with the same --size and --bands",
        "{first} and {second} cannot be compared: {error}"
    )
}

/// Checks that equal codes of both images mean equal colors.
fn check_tags(first: &Opened, second: &Opened) -> miette::Result<()> {
    let tag = |opened: &Opened| match opened {
        Opened::Picture(picture) => picture.tag().map(str::to_owned),
        Opened::Spectral(..) => None,
    };
    let (a, b) = (tag(first), tag(second));
    let named = |tag: &Option<String>| tag.clone().unwrap_or_else(|| "sRGB".to_owned());
    if a != b {
        return Err(miette!(
            help = "develop both for the same display, or compare their spectral images",
            "the first image is in {}, the second in {}",
            named(&a),
            named(&b)
        ));
    }
    if let Some(tag) = a {
        print::note(format_args!(
            "both pictures are tagged with {tag}; their codes are treated as sRGB codes"
        ));
    }
    Ok(())
}

/// Compares the bands of two files strip by strip, of all components if both are polarized, and returns the colors of both.
fn spectra(
    first: &mut RowReader,
    second: &mut RowReader,
    arguments: &Arguments,
) -> miette::Result<(Components, [XyzImage; 2])> {
    let of = |error| unlike(&error, arguments);
    let [width, height] = first.size();
    let sizes = [first.size(), second.size()].map(|size| size.map(|side| side as usize));
    compare::check_sizes(sizes[0], sizes[1]).map_err(of)?;
    compare::check_bands(first.bands(), second.bands()).map_err(of)?;
    let are_polarized = first.content().is_polarized && second.content().is_polarized;
    let components = if are_polarized {
        &Stokes::ALL[..]
    } else {
        &[Stokes::S0]
    };
    let sums = |stokes: &Stokes| (*stokes, BandSums::of_component(*first.bands(), *stokes));
    let mut sums: Vec<(Stokes, BandSums)> = components.iter().map(sums).collect();
    first.check_colors().into_diagnostic()?;
    let pixels = width as usize * height as usize;
    let mut xyz = [0; 2].map(|_| Vec::with_capacity(pixels));
    for rows in first.strips(image_file::STRIP_BYTES) {
        let a = image_file::strip(&arguments.first, first, rows.clone())?;
        let b = image_file::strip(&arguments.second, second, rows)?;
        for (_, sums) in &mut sums {
            sums.add(&a, &b).map_err(of)?;
        }
        for (xyz, strip) in xyz.iter_mut().zip([&a, &b]) {
            xyz.extend_from_slice(strip.xyz());
        }
    }
    image_file::verify(&arguments.first, first)?;
    image_file::verify(&arguments.second, second)?;
    let colors = xyz.map(|xyz| XyzImage::new(width, height, xyz));
    match colors {
        [Some(a), Some(b)] => {
            let finish = |(stokes, sums): (_, BandSums)| Ok((stokes, sums.finish().map_err(of)?));
            let components: miette::Result<Components> = sums.into_iter().map(finish).collect();
            Ok((components?, [a, b]))
        }
        _ => Err(miette!("the strips do not make up the images")),
    }
}

impl Opened {
    fn exposure_ev(&self) -> Option<f64> {
        match self {
            Self::Spectral(rows) => Some(rows.metadata().exposure_ev),
            Self::Picture(_) => None,
        }
    }

    fn picture(self, path: &Path, exposure_ev: f64) -> miette::Result<Picture> {
        match self {
            Self::Spectral(mut rows) => {
                let colors = image_file::colors(path, &mut rows)?;
                Ok(Picture::of_colors(&colors, exposure_ev))
            }
            Self::Picture(picture) => Ok(picture),
        }
    }
}
