//! Validates a description and turns it into a display.

use std::path::{Path, PathBuf};

use document::text_file::{TextFileError, read_text};
use document::{Checks, FieldPath, Folder, Problem, ProblemKind, Range};
use spectra::table_file::{Options, Quantity, TableFileError, parse, parse_rows};
use spectra::{Observer, Spectrum, Tabulated};

use super::description::{
    AmbientDescription, Curve, Description, PerChannel, PrimariesDescription, ResponseDescription,
    WhiteDescription,
};
use super::response::PQ_PEAK;
use super::{Ambient, Display, MixtureError, Primaries, Response};
use crate::chromaticity::xy_of_xyz;
use crate::matrix::IDENTITY;
use crate::tristimulus::{Rule, Weights};

/// Where the tables are that a display names.
pub(super) enum Tables {
    /// In files beside it.
    Files,
    /// Built in: `(file, text)`.
    BuiltIn(&'static [(&'static str, &'static str)]),
}

/// Checks `written`, whose files are relative to `folder`, and returns the display, whose name is its title.
pub(super) fn check(
    written: &Description,
    folder: &Folder,
    tables: &Tables,
) -> Result<Display, Vec<Problem>> {
    let mut checks = DisplayChecks {
        checks: Checks::new(folder),
        tables,
    };
    let display = checks.display(written);
    checks.checks.finish(display).map(|(display, _)| display)
}

/// Turns a description into a display. A check returns the value if it is valid, and else reports why it is not.
struct DisplayChecks<'a> {
    checks: Checks,
    tables: &'a Tables,
}

fn at(path: &str) -> FieldPath {
    path.split('.')
        .fold(FieldPath::root(), |field, step| field.key(step))
}

impl DisplayChecks<'_> {
    fn refuse<T>(&mut self, field: &str, message: impl Into<String>) -> Option<T> {
        self.checks
            .report(Problem::new(ProblemKind::Inconsistent, &at(field), message));
        None
    }

    fn number(&mut self, field: &str, value: f64, (low, high): (f64, f64)) -> Option<f64> {
        self.checks
            .number(&at(field), value, &Range::new(low, high, ""))
    }

    fn display(&mut self, written: &Description) -> Option<Display> {
        let primaries = self.primaries(&written.primaries);
        let white = self.white(written.white.as_ref(), primaries.as_ref());
        let white_luminance = self.number("white_luminance", written.white_luminance, (1e-3, 1e6));
        let most = 0.5 * white_luminance.unwrap_or(1e6);
        let black_luminance = self.number("black_luminance", written.black_luminance, (0.0, most));
        let ambient = match &written.ambient {
            Some(ambient) => self.ambient(ambient).map(Some),
            None => Some(None),
        };
        let responses = self.responses(
            &written.response,
            white_luminance.unwrap_or(1.0),
            black_luminance.unwrap_or(0.0),
        );
        let (primaries, white) = (primaries?, white?);
        let amounts = primaries.amounts(white);
        let mut display = Display {
            name: written.title.clone(),
            title: written.title.clone(),
            source: written.source.clone(),
            notes: written.notes.clone(),
            primaries,
            amounts: self.mixed(amounts)?,
            observer: Observer::Cie1931Deg2,
            xyz_from_rgb: IDENTITY,
            rgb_from_xyz: IDENTITY,
            responses: responses?,
            white_luminance: white_luminance?,
            black_luminance: black_luminance?,
            ambient: ambient?,
            black: [0.0; 3],
        };
        let mixed = display.mix(Observer::Cie1931Deg2);
        self.mixed(mixed)?;
        Some(display)
    }

    fn mixed<T>(&mut self, result: Result<T, MixtureError>) -> Option<T> {
        result
            .map_err(|error| {
                let field = match error {
                    MixtureError::Spectrum => "primaries.spectra",
                    MixtureError::White => "white",
                    MixtureError::Ambient => "ambient.illuminant",
                };
                self.refuse::<()>(field, error.to_string());
            })
            .ok()
    }

    fn primaries(&mut self, written: &PrimariesDescription) -> Option<Primaries> {
        match (&written.red, &written.green, &written.blue, &written.spectra) {
            (Some(red), Some(green), Some(blue), None) => {
                let red = self.chromaticity("primaries.red", red);
                let green = self.chromaticity("primaries.green", green);
                let blue = self.chromaticity("primaries.blue", blue);
                Some(Primaries::Chromaticities([red?, green?, blue?]))
            }
            (None, None, None, Some(csv)) => {
                let field = "primaries.spectra";
                let (path, text) = self.table(field, csv)?;
                let table = parse(&text, [Quantity::POWER; 3], &Options::default());
                let table = self.read(field, &path, table)?;
                Some(Primaries::Spectra(Box::new(table.columns)))
            }
            _ => self.refuse(
                "primaries",
                "it needs either red, green and blue, each a chromaticity [x, y], or spectra, a file with the columns nm, red, green, blue",
            ),
        }
    }

    /// The path and the text of a table.
    fn table(&mut self, field: &str, csv: &Path) -> Option<(PathBuf, String)> {
        let path = self.checks.path(&at(field), csv)?;
        let text = match self.tables {
            Tables::Files => read_text(&path),
            Tables::BuiltIn(tables) => {
                let own = tables.iter().find(|(name, _)| Path::new(name) == csv);
                Ok::<_, TextFileError>(own.map_or(String::new(), |(_, text)| (*text).to_owned()))
            }
        };
        match text {
            Ok(text) => Some((path, text)),
            Err(error) => self.refuse(field, format!("{}: {error}", path.display())),
        }
    }

    fn read<T>(&mut self, field: &str, path: &Path, table: Result<T, TableFileError>) -> Option<T> {
        table
            .map_err(|error| self.refuse::<()>(field, format!("{}: {error}", path.display())))
            .ok()
    }

    /// Checks a chromaticity: primaries and whites may be imaginary, but must be on the same side of the line of zero luminance.
    fn chromaticity(&mut self, field: &str, written: &[f64]) -> Option<[f64; 2]> {
        let &[x, y] = written else {
            let found = written.len();
            let message = format!("found {found} numbers; a chromaticity is two, x and y");
            return self.refuse(field, message);
        };
        if (-0.5..=1.5).contains(&x) && (1e-4..=1.5).contains(&y) {
            return Some([x, y]);
        }
        self.refuse(
            field,
            format!(
                "found [{x}, {y}]; a chromaticity has x from -0.5 to 1.5 and y from 0.0001 to 1.5"
            ),
        )
    }

    /// The chromaticity of the white; the inner `None` means equal amounts of the primaries.
    #[expect(clippy::option_option, reason = "the outer one is the check's result")]
    fn white(
        &mut self,
        written: Option<&WhiteDescription>,
        primaries: Option<&Primaries>,
    ) -> Option<Option<[f64; 2]>> {
        match (written, primaries) {
            (Some(WhiteDescription::Chromaticity(xy)), _) => {
                self.chromaticity("white", xy).map(Some)
            }
            (Some(WhiteDescription::Illuminant(name)), _) => {
                let light = self.illuminant("white", name)?;
                match Weights::new(&light, Observer::Cie1931Deg2, Rule::FiveNm) {
                    Ok(weights) => Some(Some(xy_of_xyz(weights.white()))),
                    Err(error) => self.refuse("white", error.to_string()),
                }
            }
            (None, Some(Primaries::Chromaticities(_))) => self.refuse(
                "white",
                "it is missing; primaries that are chromaticities need it, as a chromaticity [x, y] or the name of an illuminant",
            ),
            (None, _) => Some(None),
        }
    }

    fn illuminant(&mut self, field: &str, name: &str) -> Option<Spectrum> {
        match spectra::find_illuminant(name) {
            Ok(set) => Some(set.data),
            Err(error) => self.refuse(field, error.to_string()),
        }
    }

    /// Reads the ambient light, whose luminance is E ρ / π.
    fn ambient(&mut self, written: &AmbientDescription) -> Option<Ambient> {
        let illuminance = self.number(
            "ambient.illuminance_lux",
            written.illuminance_lux,
            (0.0, 1e6),
        );
        let reflectance = self.number("ambient.reflectance", written.reflectance, (0.0, 1.0));
        let light = self.illuminant("ambient.illuminant", &written.illuminant);
        Some(Ambient {
            luminance: illuminance? * reflectance? / std::f64::consts::PI,
            light: light?,
        })
    }

    fn responses(
        &mut self,
        written: &ResponseDescription,
        white_luminance: f64,
        black_luminance: f64,
    ) -> Option<[Response; 3]> {
        self.without_effect(written)?;
        match written.curve {
            Curve::Linear => Some([const { Response::Linear }; 3]),
            Curve::Srgb => Some([const { Response::Srgb }; 3]),
            Curve::Gamma => self.gamma(written),
            Curve::Bt1886 => {
                let black = black_luminance / (white_luminance + black_luminance);
                Some(std::array::from_fn(|_| Response::Bt1886 { black }))
            }
            Curve::Pq if white_luminance > PQ_PEAK => self.refuse(
                "white_luminance",
                format!("found {white_luminance}; the codes of PQ end at {PQ_PEAK} cd/m²"),
            ),
            Curve::Pq => Some(std::array::from_fn(|_| Response::Pq { white_luminance })),
            Curve::Table => self.measured(written),
        }
    }

    /// Refuses fields that belong to another curve.
    fn without_effect(&mut self, written: &ResponseDescription) -> Option<()> {
        for (field, is_given, of) in [
            ("response.gamma", written.gamma.is_some(), Curve::Gamma),
            ("response.alpha", written.alpha.is_some(), Curve::Gamma),
            ("response.csv", written.csv.is_some(), Curve::Table),
        ] {
            if is_given && written.curve != of {
                let name = if of == Curve::Gamma { "gamma" } else { "table" };
                return self.refuse(
                    field,
                    format!("it has no effect here; it requires curve = {name:?}"),
                );
            }
        }
        Some(())
    }

    fn gamma(&mut self, written: &ResponseDescription) -> Option<[Response; 3]> {
        let Some(gamma) = written.gamma else {
            return self.refuse(
                "response.gamma",
                "it is missing; curve = \"gamma\" needs it, such as 2.2",
            );
        };
        let alpha = written.alpha.unwrap_or(PerChannel::Same(0.0)).each();
        let mut responses = [const { Response::Linear }; 3];
        for ((response, gamma), alpha) in responses.iter_mut().zip(gamma.each()).zip(alpha) {
            let gamma = self.number("response.gamma", gamma, (0.1, 10.0));
            let alpha = self.number("response.alpha", alpha, (-0.9, 0.9));
            *response = Response::Gamma {
                gamma: gamma?,
                alpha: alpha?,
            };
        }
        Some(responses)
    }

    /// Reads a measured response, with codes and amounts relative to the last ones of the table.
    fn measured(&mut self, written: &ResponseDescription) -> Option<[Response; 3]> {
        let field = "response.csv";
        let Some(csv) = &written.csv else {
            return self.refuse(field, "it is missing; curve = \"table\" needs a file with the columns code, red, green, blue");
        };
        let (path, text) = self.table(field, csv)?;
        let rows = self.read(field, &path, parse_rows::<3>(&text))?;
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return self.read(field, &path, Err(TableFileError::Empty));
        };
        if first.nm != 0.0 || last.nm <= 0.0 {
            return self.refuse(
                field,
                format!(
                    "codes must rise from 0, but the first is {} and the last is {}",
                    first.nm, last.nm
                ),
            );
        }
        let mut responses = [const { Response::Linear }; 3];
        for (channel, response) in responses.iter_mut().enumerate() {
            let points = rows
                .iter()
                .map(|row| (row.nm / last.nm, row.values[channel] / last.values[channel]));
            *response = Response::Table(self.rising(points.collect())?);
        }
        Some(responses)
    }

    fn rising(&mut self, points: Vec<(f64, f64)>) -> Option<Tabulated> {
        let rises = points.windows(2).all(|pair| pair[0].1 <= pair[1].1);
        match Tabulated::new(points) {
            Ok(table) if rises && table.clamped_at(0.0) >= 0.0 => Some(table),
            _ => self.refuse(
                "response.csv",
                "codes must rise, and amounts of light must not be negative or fall from one code to the next; the last must be above 0",
            ),
        }
    }
}
