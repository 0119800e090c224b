//! `pellicle materials`.

use crate::print;
use clap::ValueEnum;
use miette::miette;
use pellicle::colorimetry::srgb;
use pellicle::optics::reflectance_unpolarized;
use pellicle::plot::braille;
use pellicle::relight::{BandWeights, xyz};
use pellicle::scene_file::description::Index;
use pellicle::spectra::{self, BandGrid, MaterialInfo, Observer, OpticalConstants};
use serde_json::{Value, json};
use std::io::IsTerminal;

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The material to show; if it is left out, all are listed
    name: Option<String>,
    /// List only materials whose name, substance, data set or paper contains this
    #[arg(long, value_name = "TEXT", conflicts_with = "name")]
    search: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// The wavelengths of the plot, nm.
const PLOT_NM: (f64, f64) = (380.0, 780.0);

/// Lists the materials or shows one.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    if let Some(name) = &arguments.name {
        let (info, constants) = material(name)?;
        return match arguments.format {
            Format::Text => show(&info, &constants),
            Format::Json => print::result(format_args!("{:#}", with_figures(&info, &constants))),
        };
    }
    let found = search(arguments.search.as_deref().unwrap_or_default())?;
    match arguments.format {
        Format::Text => list(&found),
        Format::Json => {
            let all: Vec<Value> = found.iter().map(described).collect();
            print::result(format_args!("{:#}", Value::Array(all)))
        }
    }
}

fn material(name: &str) -> miette::Result<(MaterialInfo, OpticalConstants)> {
    let index = Index::Name(name.to_owned());
    match (
        pellicle::media::optical_constants(&index, ""),
        spectra::material_info(name),
    ) {
        (Ok((constants, _)), Some(info)) => Ok((info, constants)),
        (Err(problems), _) => {
            let said = problems
                .iter()
                .next()
                .map(|problem| problem.message.clone());
            Err(miette!(
                help = "`pellicle materials` lists all",
                "{}",
                said.unwrap_or_default()
            ))
        }
        (Ok(_), None) => Err(miette!("nothing is known about {name:?}")),
    }
}

/// The materials that match a text.
fn search(text: &str) -> miette::Result<Vec<MaterialInfo>> {
    let text = text.to_lowercase();
    let is_meant = |info: &MaterialInfo| {
        let words = [info.name, info.material, info.data_set, info.paper];
        let mut names = words.iter().chain(&info.aliases);
        names.any(|word| word.to_lowercase().contains(&text))
    };
    let names = spectra::material_names().into_iter();
    let found: Vec<_> = names
        .filter_map(spectra::material_info)
        .filter(is_meant)
        .collect();
    if found.is_empty() {
        return Err(miette!(
            help = "`pellicle materials` lists all",
            "no material matches {text:?}"
        ));
    }
    Ok(found)
}

fn list(materials: &[MaterialInfo]) -> miette::Result<()> {
    print::result(format_args!(
        "{:<24}{:<20}{:>14}  {:<28}paper",
        "name", "also", "range, nm", "data set"
    ))?;
    for info in materials {
        let (low, high) = info.range_nm;
        print::result(format_args!(
            "{:<24}{:<20}{:>14}  {:<28}{}",
            info.name,
            info.aliases.join(" "),
            format!("{low:.0} to {high:.0}"),
            info.data_set,
            info.paper,
        ))?;
    }
    Ok(())
}

fn show(info: &MaterialInfo, constants: &OpticalConstants) -> miette::Result<()> {
    let (low, high) = info.range_nm;
    print::result(format_args!("{}: {}", info.name, info.material))?;
    if !info.aliases.is_empty() {
        print::result(format_args!("also      {}", info.aliases.join(", ")))?;
    }
    print::result(format_args!("data set  {}", info.data_set))?;
    print::result(format_args!("source    {}", info.citation))?;
    print::result(format_args!("license   {}", info.license))?;
    print::result(format_args!("range     {low} to {high} nm"))?;
    print::result(format_args!("notes     {}", info.notes))?;
    if std::io::stdout().is_terminal()
        && let Some([r, g, b]) = bulk_color(constants)
    {
        print::result(format_args!(
            "color    \x1b[48;2;{r};{g};{b}m          \x1b[0m  polished, under D65"
        ))?;
    }
    print::result(format_args!("\n{:>6}{:>14}{:>14}", "nm", "n", "k"))?;
    for (nm, n, k) in figures(constants, 50) {
        print::result(format_args!(
            "{nm:>6}{:>14}{:>14}",
            braille::number(n),
            braille::number(k)
        ))?;
    }
    for (name, part) in [("n", &constants.n), ("k", &constants.k)] {
        if *part == spectra::Spectrum::Constant(0.0) {
            continue;
        }
        let (from, to) = PLOT_NM;
        let step = (to - from) / (braille::DOTS_WIDE - 1) as f64;
        let curve = braille::curve(&std::array::from_fn(|dot| {
            part.at(from + step * dot as f64).ok()
        }));
        print::result(format_args!("\n{name:>10}"))?;
        for line in curve {
            print::result(line)?;
        }
        print::result(braille::axis(from, to))?;
    }
    Ok(())
}

/// Wavelengths from 380 or 400 nm to 780 nm that the material covers, with n and k there.
fn figures(constants: &OpticalConstants, step_nm: u32) -> Vec<(u32, f64, f64)> {
    let wavelengths = (380..=780).filter(|nm| nm % step_nm == 0);
    let at = |nm: u32| {
        let index = constants.at(f64::from(nm)).ok()?;
        Some((nm, index.re, index.im))
    };
    wavelengths.filter_map(at).collect()
}

fn described(info: &MaterialInfo) -> Value {
    json!({
        "name": info.name,
        "aliases": info.aliases,
        "material": info.material,
        "data_set": info.data_set,
        "paper": info.paper,
        "citation": info.citation,
        "license": info.license,
        "notes": info.notes,
        "range_nm": [info.range_nm.0, info.range_nm.1],
    })
}

fn with_figures(info: &MaterialInfo, constants: &OpticalConstants) -> Value {
    let figures = figures(constants, 10);
    let mut value = described(info);
    value["nm"] = figures.iter().map(|&(nm, ..)| nm).collect();
    value["n"] = figures.iter().map(|&(_, n, _)| n).collect();
    value["k"] = figures.iter().map(|&(.., k)| k).collect();
    value
}

/// The sRGB codes of a polished surface in air under D65 at normal incidence; `None` if the data do not cover the
/// visible range.
fn bulk_color(constants: &OpticalConstants) -> Option<[u8; 3]> {
    let grid = BandGrid::new(PLOT_NM.0, PLOT_NM.1, 80).ok()?;
    let d65 = spectra::illuminant("D65")?.data;
    let reflected = |band| {
        let nm = grid.wavelength_nm(band, 0.5);
        let reflectance = reflectance_unpolarized(constants.at(nm).ok()?, 1.0);
        Some((d65.at(nm).ok()? * reflectance) as f32)
    };
    let radiance: Option<Vec<f32>> = (0..grid.count()).map(reflected).collect();
    let in_air = BandWeights::observed(&grid, Observer::Cie1931Deg2).xyz(&radiance?);
    let relative = in_air.map(|value| value * xyz::exposure_scale(0.0));
    Some(srgb::linear_from_xyz(relative).map(srgb::to_u8))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn color(name: &str) -> Option<[u8; 3]> {
        bulk_color(&spectra::optical_constants(name).unwrap().data)
    }

    #[test]
    fn metals_and_glass_have_the_colors_of_an_independent_computation() {
        // Normal incidence, D65, CIE 1931 2° at 1 nm, colour-science 0.4.7 and numpy.
        for (name, expected) in [
            ("gold", [255, 222, 163]),
            ("silver", [254, 253, 252]),
            ("bk7", [58, 58, 59]),
        ] {
            let found = color(name).unwrap();
            let near = found
                .iter()
                .zip(expected)
                .all(|(code, other)| code.abs_diff(other) <= 1);
            assert!(near, "{name}: {found:?}");
        }
        assert_eq!(color("rutile"), None);
    }
}
