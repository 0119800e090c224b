//! `pellicle develop --stokes`: pictures of polarization in false colors.

use super::Arguments;
use super::options::not_polarized;
use crate::output::is_stream;
use crate::{image_file, print};
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::color::Polarization;
use pellicle::picture_file::{RgbImage8, png};
use pellicle::plot::{ColorBar, with_color_bar};
use pellicle::relight::NotPolarized;
use pellicle::spectra::{LayerKey, SpectralImage, Stokes};
use std::path::Path;

/// What the picture shows.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(super) enum StokesName {
    /// Degree of polarization, 0 to 1
    Dop,
    /// Degree of linear polarization, 0 to 1
    Dolp,
    /// Degree of circular polarization, -1 (left) to 1 (right)
    Docp,
    /// Angle of linear polarization, 0 to 180°: the hue; the brightness is the degree of linear polarization
    Aolp,
    /// S1/S0: horizontal minus vertical
    S1,
    /// S2/S0: along 45° minus along 135°
    S2,
    /// S3/S0: right circular minus left circular
    S3,
}

impl StokesName {
    fn polarization(self) -> Polarization {
        match self {
            Self::Dop => Polarization::Degree,
            Self::Dolp => Polarization::Linear,
            Self::Docp => Polarization::Circular,
            Self::Aolp => Polarization::Angle,
            Self::S1 => Polarization::S1,
            Self::S2 => Polarization::S2,
            Self::S3 => Polarization::S3,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Dop => "degree of polarization",
            Self::Dolp => "degree of linear polarization",
            Self::Docp => "degree of circular polarization",
            Self::Aolp => "angle of polarization, °",
            Self::S1 => "S1/S0",
            Self::S2 => "S2/S0",
            Self::S3 => "S3/S0",
        }
    }

    /// Where the labels of the scale are, and what they say.
    fn labels(self) -> Vec<(f64, String)> {
        let [from, to] = self.polarization().range();
        let label = |quarter: u8| {
            let share = f64::from(quarter) / 4.0;
            (share, (from + share * (to - from)).to_string())
        };
        (0..=4).map(label).collect()
    }
}

/// Reports options that cannot work before the image is read.
fn check(arguments: &Arguments) -> miette::Result<()> {
    let is_png = |path: &Path| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("png"))
    };
    let mut outputs = arguments.output.iter();
    match outputs.find(|path| !(is_png(path) || is_stream(path))) {
        Some(path) => Err(miette!(
            help = "end it in .png",
            "-o {}: a picture of --stokes with this ending cannot be written",
            path.display()
        )),
        None => Ok(()),
    }
}

/// Reads the image, and writes the picture of its polarization with the scale of its colors.
pub(super) fn write(arguments: &Arguments, shown: StokesName) -> miette::Result<()> {
    check(arguments)?;
    let picture = picture(arguments, shown)?;
    let polarization = shown.polarization();
    let bar = ColorBar {
        title: shown.title(),
        labels: &shown.labels(),
        color: &|share, degree| polarization.color(share, degree),
    };
    let whole = with_color_bar(&picture, &bar)
        .ok_or_else(|| miette!("the picture has no room for the scale of its colors"))?;
    for path in &arguments.output {
        png::write(path, &whole)
            .into_diagnostic()
            .wrap_err_with(|| format!("{} was not written", path.display()))?;
        print::note(format_args!("wrote {}", print::output(path)));
    }
    Ok(())
}

/// The picture of the luminances of S0 to S3 of each pixel.
fn picture(arguments: &Arguments, shown: StokesName) -> miette::Result<RgbImage8> {
    let path = &arguments.image;
    let mut rows = image_file::rows(path)?;
    if !rows.content().is_polarized {
        return Err(not_polarized("--stokes", NotPolarized));
    }
    rows.check_colors().into_diagnostic()?;
    let [width, height] = rows.size();
    let mut vectors = Vec::with_capacity(width as usize * height as usize);
    for strip in rows.strips(image_file::STRIP_BYTES) {
        let mut strip = image_file::strip(path, &mut rows, strip)?;
        arguments.options.light(&mut strip)?;
        add_luminances(&mut vectors, &strip);
    }
    image_file::verify(path, &mut rows)?;
    let picture = shown.polarization().picture([width, height], &vectors);
    picture.ok_or_else(|| miette!("the strips do not make up the image"))
}

/// Adds the luminances of the components of each pixel: Y of their XYZ.
fn add_luminances(vectors: &mut Vec<[f32; 4]>, strip: &SpectralImage) {
    let xyz = |stokes| {
        let layer = strip.layer(LayerKey::XYZ.component(stokes));
        layer.map_or(&[][..], |layer| layer.floats().as_chunks::<3>().0)
    };
    let [s0, s1, s2, s3] = Stokes::ALL.map(xyz);
    let polarized = s1.iter().zip(s2).zip(s3);
    let all = s0.iter().zip(polarized);
    vectors.extend(all.map(|(s0, ((s1, s2), s3))| [s0[1], s1[1], s2[1], s3[1]]));
}
