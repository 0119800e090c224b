//! `pellicle display`.

use crate::print;
use clap::ValueEnum;
use miette::miette;
use pellicle::colorimetry::chromaticity::{uv_of_xy, xy_of_xyz};
use pellicle::colorimetry::display::{Primaries, Response};
use pellicle::colorimetry::{Display, Matrix3};
use serde_json::{Value, json};
use std::fmt::Write;

/// Show the primaries, white, matrices, curves and gamut of a display, or list the displays.
///
/// NAME is a built-in display, FILE one of your own (.toml): `white`, `white_luminance`, `black_luminance`; [primaries] as
/// chromaticities `red`, `green`, `blue` or as `spectra`, a table with the columns nm, red, green, blue; [response] with a `curve`,
/// which is linear, srgb, gamma (with `gamma` and `alpha`), bt1886, pq or table (with `csv`: code, red, green, blue); and [ambient]
/// with `illuminance_lux`, `reflectance` and `illuminant`. If both are left out, the built-in displays are listed.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The name of a display, or a .toml file
    #[arg(value_name = "NAME|FILE")]
    display: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Table,
    Json,
}

/// Shows a display or lists all of them.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    if let Some(name) = &arguments.display {
        let display = open(name)?;
        return match arguments.format {
            Format::Table => print::result(described(&display).trim_end()),
            Format::Json => print::result(format_args!("{:#}", json_of(&display))),
        };
    }
    let displays: Vec<Display> = Display::names()
        .into_iter()
        .filter_map(Display::named)
        .collect();
    match arguments.format {
        Format::Table => print::result(listed(&displays).trim_end()),
        Format::Json => {
            let all: Vec<Value> = displays.iter().map(json_of).collect();
            print::result(format_args!("{:#}", Value::Array(all)))
        }
    }
}

/// Opens a display by name or from a file.
pub(crate) fn open(name_or_file: &str) -> miette::Result<Display> {
    Display::open(name_or_file)
        .map_err(|error| miette!(help = "`pellicle display` lists all", "{error}"))
}

/// The areas of the gamut relative to those of sRGB, in x, y and in u′, v′.
fn shares_of_srgb(display: &Display) -> Option<[f64; 2]> {
    let srgb = Display::named("srgb")?;
    Some([
        display.gamut_area_xy() / srgb.gamut_area_xy(),
        display.gamut_area_uv() / srgb.gamut_area_uv(),
    ])
}

fn listed(displays: &[Display]) -> String {
    let mut text = format!(
        "{:<14}{:<34}{:<18}{:<10}gamut relative to sRGB's\n",
        "name", "title", "white x, y", "curve"
    );
    for display in displays {
        let [x, y] = xy_of_xyz(display.white_xyz());
        let _ = writeln!(
            text,
            "{:<14}{:<34}{:<18}{:<10}{:.2} in u'v'",
            display.name(),
            display.title(),
            format!("{x:.4}, {y:.4}"),
            display.responses()[0].name(),
            shares_of_srgb(display).map_or(f64::NAN, |[_, uv]| uv),
        );
    }
    text
}

fn described(display: &Display) -> String {
    let mut text = display.name().to_owned();
    if !display.title().is_empty() {
        let _ = write!(text, ": {}", display.title());
    }
    text.push('\n');
    for (what, said) in [("source", display.source()), ("notes", display.notes())] {
        if !said.is_empty() {
            let _ = writeln!(text, "{what:<10}{said}");
        }
    }
    text += &colors(display);
    text += &light(display);
    text += &matrix(
        "M, XYZ from amounts of red, green and blue; the white has Y = 1",
        display.xyz_from_rgb(),
    );
    text += &matrix("M⁻¹", display.rgb_from_xyz());
    text += "\ncurves\n";
    for (channel, response) in ["red", "green", "blue"]
        .into_iter()
        .zip(display.responses())
    {
        let _ = writeln!(text, "{channel:<10}{}", curve(response));
    }
    if let Some([xy, uv]) = shares_of_srgb(display) {
        let _ = writeln!(
            text,
            "\ngamut     area {:.5} in xy ({:.1} % of sRGB's), {:.5} in u'v' ({:.1} %)",
            display.gamut_area_xy(),
            100.0 * xy,
            display.gamut_area_uv(),
            100.0 * uv,
        );
    }
    text
}

/// Chromaticities, and each primary's fraction of the white's luminance.
fn colors(display: &Display) -> String {
    let kind = match display.primaries() {
        Primaries::Chromaticities(_) => "as given",
        Primaries::Spectra(_) => "from sums over the spectra at 5 nm",
    };
    let mut text = format!(
        "\n{:<10}{:>10}{:>10}{:>10}{:>10}{:>10}   ({kind}; CIE 1931)\n",
        "", "x", "y", "u'", "v'", "Y"
    );
    let white = xy_of_xyz(display.white_xyz());
    let luminances = display.xyz_from_rgb()[1];
    let primaries = ["red", "green", "blue"]
        .into_iter()
        .zip(display.primaries_xy())
        .zip(luminances);
    let rows = primaries.map(|((name, xy), y)| (name, xy, y));
    for (name, [x, y], luminance) in rows.chain([("white", white, 1.0)]) {
        let [u, v] = uv_of_xy([x, y]);
        let _ = writeln!(
            text,
            "{name:<10}{x:>10.6}{y:>10.6}{u:>10.6}{v:>10.6}{luminance:>10.6}"
        );
    }
    text
}

/// Luminances of white, peak and black.
fn light(display: &Display) -> String {
    let white = display.white_luminance();
    let mut text = format!("\nwhite     {white} cd/m²\n");
    if display.peak() > 1.0 {
        let _ = writeln!(text, "peak      {} cd/m²", display.peak() * white);
    }
    let black = display.black_xyz()[1];
    if black > 0.0 {
        let _ = writeln!(
            text,
            "black     {} cd/m², including ambient light; contrast {:.0}",
            black * white,
            (1.0 + black) / black
        );
    }
    text
}

fn matrix(title: &str, matrix: &Matrix3) -> String {
    let mut text = format!("\n{title}\n");
    for row in matrix {
        // Values that are 0 except for rounding are shown as 0.
        let [a, b, c] = row.map(|value| if value.abs() < 1e-12 { 0.0 } else { value });
        let _ = writeln!(text, "{a:>16.10}{b:>16.10}{c:>16.10}");
    }
    text
}

fn curve(response: &Response) -> String {
    match response {
        Response::Linear => "linear, C = V".to_owned(),
        Response::Srgb => "sRGB, IEC 61966-2-1".to_owned(),
        Response::Gamma { gamma, alpha } if *alpha == 0.0 => format!("C = V^γ, γ = {gamma}"),
        Response::Gamma { gamma, alpha } => {
            format!("C = ((V - α)/(1 - α))^γ, γ = {gamma}, α = {alpha}")
        }
        Response::Bt1886 { black } => format!("ITU-R BT.1886, γ = 2.4, black {black} of the white"),
        Response::Pq { .. } => "SMPTE ST 2084 (PQ)".to_owned(),
        Response::Table(table) => format!("measured, {} points", table.points().len()),
    }
}

fn json_of(display: &Display) -> Value {
    let curve = |response: &Response| match response {
        Response::Gamma { gamma, alpha } => {
            json!({ "curve": response.name(), "gamma": gamma, "alpha": alpha })
        }
        Response::Bt1886 { black } => json!({ "curve": response.name(), "black": black }),
        Response::Table(table) => {
            let (codes, light): (Vec<f64>, Vec<f64>) = table.points().unzip();
            json!({ "curve": response.name(), "codes": codes, "light": light })
        }
        _ => json!({ "curve": response.name() }),
    };
    let shares = shares_of_srgb(display);
    json!({
        "name": display.name(),
        "title": display.title(),
        "source": display.source(),
        "notes": display.notes(),
        "primaries_xy": display.primaries_xy(),
        "white_xy": xy_of_xyz(display.white_xyz()),
        "white_xyz": display.white_xyz(),
        "white_luminance": display.white_luminance(),
        "peak": display.peak(),
        "black_xyz": display.black_xyz(),
        "xyz_from_rgb": display.xyz_from_rgb(),
        "rgb_from_xyz": display.rgb_from_xyz(),
        "response": display.responses().each_ref().map(curve),
        "gamut_area": {
            "xy": display.gamut_area_xy(),
            "uv": display.gamut_area_uv(),
            "xy_of_srgb": shares.map(|[xy, _]| xy),
            "uv_of_srgb": shares.map(|[_, uv]| uv),
        },
    })
}
