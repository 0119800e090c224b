//! `pellicle color`.

use crate::lamp::Lamp;
use crate::swatch::swatch;
use crate::{display, print};
use clap::ValueEnum;
use miette::miette;
use pellicle::colorimetry::chromaticity::{uv_of_xyz, xy_of_xyz};
use pellicle::colorimetry::matrix::times;
use pellicle::colorimetry::temperature::{Temperature, correlated_temperature};
use pellicle::colorimetry::tristimulus::{Rule, Weights, xyz_of_emission};
use pellicle::colorimetry::{Adaptation, Display, Lab, srgb};
use pellicle::spectra::table_file::{self, ColumnChoice, Options, Quantity};
use pellicle::spectra::{Observer, OutOfRange, Spectrum};
use serde_json::json;
use std::path::PathBuf;

/// Compute the color of a spectrum: XYZ, CIELAB, and RGB of a display.
///
/// FILE is a table with the columns wavelength_nm and value, linear between its points: a reflectance (or transmittance) from 0 to 1, or
/// with --emission the power of a light source in any unit. Colors are sums from 380 to 780 nm. XYZ has Y = 100 for the perfect reflector,
/// and for every emission; CIELAB is relative to the white of the illuminant. Linear RGB is the display's M⁻¹ times XYZ/100, and is below 0
/// or above 1 where the display cannot show the color; RGB is its 8-bit code, clipped. The display's black level and the ambient light,
/// which `develop` subtracts, are ignored here.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The table: columns of numbers (.csv, .txt, .tsv, .spd ...), CGATS or IES TM-27 (.spdx), or - for standard input
    file: PathBuf,
    /// Column to read, by its name in the header or its number, counted from 1, or the sample of a CGATS file
    #[arg(long, value_name = "NAME|NUMBER")]
    column: Option<String>,
    /// Units that the file does not name: nm, um, angstrom or eV for its wavelengths, percent for its values, or both
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Treat the values as the power of a light source, not as a reflectance; --illuminant is then the white that it is compared with
    #[arg(long)]
    emission: bool,
    /// Illuminant: D65, A, FL11, LED-B3, D5700K, blackbody_3000K ..., or a file with columns wavelength_nm,power (.csv, .spd, .spdx ...)
    #[arg(long, value_name = "NAME|FILE", default_value = "D65", value_parser = Lamp::unscaled)]
    illuminant: Lamp,
    /// Observer: 1931_2, 1964_10, 2015_2 or 2015_10
    #[arg(long, value_name = "NAME", default_value_t = Observer::Cie1931Deg2)]
    observer: Observer,
    /// Step of sums over wavelength: 5nm or 1nm [default: 5nm under FL and HP lamps, whose tables are defined that way, else 1nm]
    #[arg(long, value_name = "RULE")]
    rule: Option<Rule>,
    /// Chromatic adaptation of RGB from the illuminant's white to the display's: none, bradford or cat16
    #[arg(long, value_name = "NAME", default_value_t = Adaptation::None)]
    adapt: Adaptation,
    /// Display for RGB: a name that `pellicle display` lists, or a .toml file
    #[arg(long, value_name = "NAME|FILE", default_value = "srgb")]
    display: String,
    /// Extend the first and last values where the table does not cover 380 to 780 nm
    #[arg(long)]
    clamp: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Table,
    Json,
}

/// A color and everything that is printed about it.
struct Found<'a> {
    arguments: &'a Arguments,
    display: Display,
    rule: Rule,
    /// Y = 1 for the perfect reflector.
    xyz: [f64; 3],
    /// XYZ of the illuminant, Y = 1.
    white: [f64; 3],
    /// The luminance of an emission, in cd/m² if its unit is W m⁻² sr⁻¹ nm⁻¹.
    luminance: Option<f64>,
}

/// Computes and prints.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let found = Found::new(arguments)?;
    match arguments.format {
        Format::Table => print::result(found.table()),
        Format::Json => print::result(format_args!("{:#}", found.json())),
    }
}

impl<'a> Found<'a> {
    fn new(arguments: &'a Arguments) -> miette::Result<Self> {
        let Arguments {
            illuminant,
            observer,
            ..
        } = arguments;
        let display = display_seen_by(&arguments.display, *observer)?;
        let spectrum = read(arguments)?;
        let rule = arguments.rule.unwrap_or(illuminant.rule);
        if rule == Rule::OneNm && illuminant.rule == Rule::FiveNm {
            print::note(format_args!(
                "{} has lines and is defined by sums at 5 nm: at 1 nm its y is off by about 2e-4",
                illuminant.name
            ));
        }
        let weights = Weights::new(&illuminant.spectrum, *observer, rule)
            .map_err(|error| miette!("--illuminant {}: {error}", illuminant.name))?;
        let too_short = |gap: OutOfRange| {
            miette!(
                help = "--clamp extends its first and last values",
                "{}: {gap}; colors are sums from 380 to 780 nm",
                print::name(&arguments.file)
            )
        };
        let (xyz, luminance) = if arguments.emission {
            let xyz = xyz_of_emission(&spectrum, *observer, rule).map_err(too_short)?;
            if xyz[1] <= 0.0 {
                return Err(miette!(
                    "{}: an emission must have power between 380 and 780 nm, but its luminance is 0",
                    print::name(&arguments.file)
                ));
            }
            (xyz.map(|v| v / xyz[1]), Some(xyz[1]))
        } else {
            (weights.xyz_of(&spectrum).map_err(too_short)?, None)
        };
        Ok(Self {
            arguments,
            display,
            rule,
            xyz,
            white: weights.white(),
            luminance,
        })
    }

    fn lab(&self) -> Lab {
        Lab::from_xyz(self.xyz, self.white)
    }

    /// XYZ after adaptation to the white of the display.
    fn adapted(&self) -> [f64; 3] {
        let adaptation = self.arguments.adapt;
        times(
            &adaptation.matrix(self.white, self.display.white_xyz()),
            self.xyz,
        )
    }

    /// The correlated color temperature of an emission; `None` for observers for which it is not defined.
    fn temperature(&self) -> Option<Temperature> {
        let is_defined = self.arguments.observer == Observer::Cie1931Deg2;
        let xy = xy_of_xyz(self.xyz);
        is_defined.then(|| correlated_temperature(xy)).flatten()
    }

    fn linear_rgb(&self) -> [f64; 3] {
        times(self.display.rgb_from_xyz(), self.adapted())
    }

    /// Codes from 0 to 1, clipped to what the display can show.
    fn encoded(&self) -> [f64; 3] {
        let (linear, responses) = (self.linear_rgb(), self.display.responses());
        std::array::from_fn(|i| {
            let shown = linear[i].clamp(0.0, responses[i].peak());
            responses[i].code(shown).clamp(0.0, 1.0)
        })
    }

    fn rgb(&self) -> [u8; 3] {
        self.encoded().map(|code| (255.0 * code).round() as u8)
    }

    /// Whether the display can show the color, up to the rounding of sums over wavelength relative to its white.
    fn is_in_gamut(&self) -> bool {
        const ROUNDING: f64 = 1e-3;
        let fits = |v: &f64| (-ROUNDING..=self.display.peak() + ROUNDING).contains(v);
        self.linear_rgb().iter().all(fits)
    }

    fn table(&self) -> String {
        let Arguments {
            illuminant,
            observer,
            adapt,
            ..
        } = self.arguments;
        let lab = self.lab();
        let hundred = self.xyz.map(|v| 100.0 * v);
        let pair = |[a, b]: [f64; 2]| {
            // Black has no chromaticity.
            if a.is_finite() {
                format!("{a:.6}  {b:.6}")
            } else {
                "none".to_owned()
            }
        };
        let (xy, uv) = (pair(xy_of_xyz(self.xyz)), pair(uv_of_xyz(self.xyz)));
        let [r, g, b] = self.rgb();
        let about = match self.luminance {
            Some(luminance) => {
                let temperature = self.temperature().map_or_else(String::new, |found| {
                    format!("{:.0} K, Duv {:.4}; ", found.kelvin, found.duv)
                });
                format!(
                    "an emission beside {}, {observer}, sums at {}; {temperature}{luminance:.6} cd/m² if its unit is W/(m² sr nm)",
                    illuminant.name, self.rule
                )
            }
            None => format!(
                "under {}, {observer}, sums at {}",
                illuminant.name, self.rule
            ),
        };
        let adapted = match adapt {
            Adaptation::None => String::new(),
            _ => format!(", adapted from {} by {adapt}", illuminant.name),
        };
        let clipped = if self.is_in_gamut() {
            ""
        } else {
            "  (beyond the display, clipped)"
        };
        format!(
            "{}: {about}\nXYZ       {}\nxy        {xy}\nu'v'      {uv}\n\
             L*a*b*    {}   C* {:.4}  h {:.3}°\nlinear    {}   of {}{adapted}\nRGB       {r} {g} {b}   {}#{r:02x}{g:02x}{b:02x}{clipped}",
            print::name(&self.arguments.file),
            spaced(hundred),
            spaced([lab.l, lab.a, lab.b]),
            lab.chroma(),
            lab.hue_deg(),
            spaced(self.linear_rgb()),
            self.display.name(),
            swatch(srgb::linear_from_xyz(self.adapted()).map(srgb::to_u8)),
        )
    }

    fn json(&self) -> serde_json::Value {
        let arguments = self.arguments;
        let lab = self.lab();
        // Black has no chromaticity: null.
        let finite = |xy: [f64; 2]| xy.iter().all(|v| v.is_finite()).then_some(xy);
        let mut value = json!({
            "xyz": self.xyz.map(|v| 100.0 * v),
            "xy": finite(xy_of_xyz(self.xyz)),
            "uv": finite(uv_of_xyz(self.xyz)),
            "lab": [lab.l, lab.a, lab.b],
            "lch": [lab.l, lab.chroma(), lab.hue_deg()],
            "linear_rgb": self.linear_rgb(),
            "rgb": self.rgb(),
            "encoded_rgb": self.encoded(),
            "in_gamut": self.is_in_gamut(),
            "illuminant": arguments.illuminant.name,
            "observer": arguments.observer.name(),
            "rule": self.rule.name(),
            "adapt": arguments.adapt.name(),
            "display": self.display.name(),
            "white_xyz": self.white.map(|v| 100.0 * v),
        });
        if let Some(luminance) = self.luminance {
            value["luminance_cd_m2"] = json!(luminance);
            let temperature = self.temperature();
            value["cct_k"] = json!(temperature.map(|found| found.kelvin));
            value["duv"] = json!(temperature.map(|found| found.duv));
        }
        value
    }
}

/// The display as the observer sees it, if that is known.
fn display_seen_by(name_or_file: &str, observer: Observer) -> miette::Result<Display> {
    let display = display::open(name_or_file)?;
    if let Some(seen) = display.seen_by(observer) {
        return Ok(seen);
    }
    print::note(format_args!(
        "{}: its primaries are known for CIE 1931 alone; RGB treats XYZ of {observer} as XYZ of CIE 1931",
        display.name()
    ));
    Ok(display)
}

fn spaced(values: [f64; 3]) -> String {
    let [a, b, c] = values.map(|value| format!("{value:.6}"));
    format!("{a}  {b}  {c}")
}

fn read(arguments: &Arguments) -> miette::Result<Spectrum> {
    let quantity = if arguments.emission {
        // In any unit.
        Quantity::amount("power", (0.0, 1e30))
    } else {
        Quantity::REFLECTANCE
    };
    let file = print::name(&arguments.file);
    let table = table_file::read(&arguments.file, [quantity], &options(arguments)?)
        .map_err(|error| miette!("{file}: {error}"))?;
    print::notes(table.note.map(|note| format!("{file}: {note}")));
    let [table] = table.columns;
    let spectrum = Spectrum::Table(table);
    if !arguments.clamp {
        return Ok(spectrum);
    }
    if let Spectrum::Table(table) = &spectrum {
        let (from_nm, to_nm) = table.range_nm();
        if from_nm >= 780.0 || to_nm <= 380.0 {
            return Err(miette!(
                help = "if its wavelengths have another unit, name it with --unit",
                "{file}: its data, {from_nm} to {to_nm} nm, do not overlap 380 to 780 nm"
            ));
        }
        if from_nm > 380.0 || to_nm < 780.0 {
            print::notes([format!(
                "{file}: its data cover {from_nm} to {to_nm} nm; beyond that, the end values are used"
            )]);
        }
    }
    Ok(spectrum.clamped())
}

/// The options for reading the file.
fn options(arguments: &Arguments) -> miette::Result<Options> {
    let mut options = Options::default();
    if let Some(column) = &arguments.column {
        let number = column.parse().map(ColumnChoice::Number);
        options.columns = vec![number.unwrap_or_else(|_| ColumnChoice::Name(column.clone()))];
    }
    if let Some(unit) = &arguments.unit {
        let taken = options.set_unit(unit);
        taken.map_err(|complaint| miette!("--unit: {complaint}"))?;
    }
    Ok(options)
}
