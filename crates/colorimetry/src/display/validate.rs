//! Validates a description and turns it into a display.

use std::path::Path;

use spectra::table_file::{Options, Quantity, TableFileError, parse, parse_rows};
use spectra::{Observer, Spectrum, Tabulated};

use super::file::{
    AmbientDescription, Curve, Description, DisplayError, PerChannel, PrimariesDescription,
    ReadTable, ResponseDescription, WhiteDescription,
};
use super::response::PQ_PEAK;
use super::{Ambient, Display, MixtureError, Primaries, Response};
use crate::chromaticity::xy_of_xyz;
use crate::matrix::IDENTITY;
use crate::tristimulus::{Rule, Weights};

/// Turns a description into a display.
pub(super) struct Checks<'a> {
    pub(super) path: &'a str,
    pub(super) read: ReadTable<'a>,
}

impl Checks<'_> {
    fn fault(&self, field: &'static str, message: impl Into<String>) -> DisplayError {
        DisplayError::Field {
            path: self.path.to_owned(),
            field,
            message: message.into(),
        }
    }

    fn number(
        &self,
        field: &'static str,
        value: f64,
        low: f64,
        high: f64,
    ) -> Result<f64, DisplayError> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        Err(self.fault(
            field,
            format!("found {value}; it must be from {low} to {high}"),
        ))
    }

    pub(super) fn display(&self, written: Description) -> Result<Display, DisplayError> {
        let primaries = self.primaries(&written.primaries)?;
        let white = self.white(written.white, &primaries)?;
        let fault = |error: MixtureError| {
            let field = match error {
                MixtureError::Spectrum => "primaries.spectra",
                MixtureError::White => "white",
                MixtureError::Ambient => "ambient.illuminant",
            };
            self.fault(field, error.to_string())
        };
        let amounts = primaries.amounts(white).map_err(fault)?;
        let white_luminance = self.number("white_luminance", written.white_luminance, 1e-3, 1e6)?;
        let most = 0.5 * white_luminance;
        let black_luminance = self.number("black_luminance", written.black_luminance, 0.0, most)?;
        let ambient = written.ambient.map(|ambient| self.ambient(&ambient));
        let mut display = Display {
            name: self.path.to_owned(),
            title: written.title,
            source: written.source,
            notes: written.notes,
            primaries,
            amounts,
            observer: Observer::Cie1931Deg2,
            xyz_from_rgb: IDENTITY,
            rgb_from_xyz: IDENTITY,
            responses: self.responses(&written.response, white_luminance, black_luminance)?,
            white_luminance,
            black_luminance,
            ambient: ambient.transpose()?,
            black: [0.0; 3],
        };
        display.mix(Observer::Cie1931Deg2).map_err(fault)?;
        Ok(display)
    }

    fn primaries(&self, written: &PrimariesDescription) -> Result<Primaries, DisplayError> {
        match (&written.red, &written.green, &written.blue, &written.spectra) {
            (Some(red), Some(green), Some(blue), None) => Ok(Primaries::Chromaticities([
                self.primary("primaries.red", red)?,
                self.primary("primaries.green", green)?,
                self.primary("primaries.blue", blue)?,
            ])),
            (None, None, None, Some(csv)) => {
                let text = (self.read)(csv)?;
                let table = parse(&text, [Quantity::POWER; 3], &Options::default());
                let table = table.map_err(|source| self.table_fault(csv, source))?;
                Ok(Primaries::Spectra(Box::new(table.columns)))
            }
            _ => Err(self.fault(
                "primaries",
                "it needs either red, green and blue, each a chromaticity [x, y], or spectra, a file with the columns nm, red, green, blue",
            )),
        }
    }

    fn table_fault(&self, csv: &Path, source: TableFileError) -> DisplayError {
        DisplayError::Table {
            path: Path::new(self.path)
                .with_file_name(csv)
                .display()
                .to_string(),
            source: Box::new(source),
        }
    }

    fn primary(&self, field: &'static str, written: &[f64]) -> Result<[f64; 2], DisplayError> {
        let &[x, y] = written else {
            let found = written.len();
            let message = format!("found {found} numbers; a chromaticity is two, x and y");
            return Err(self.fault(field, message));
        };
        self.chromaticity(field, [x, y])
    }

    /// Checks a chromaticity: primaries and whites may be imaginary, but must be on the same side of the line of zero luminance.
    fn chromaticity(&self, field: &'static str, xy: [f64; 2]) -> Result<[f64; 2], DisplayError> {
        let [x, y] = xy;
        if (-0.5..=1.5).contains(&x) && (1e-4..=1.5).contains(&y) {
            return Ok(xy);
        }
        Err(self.fault(
            field,
            format!(
                "found [{x}, {y}]; a chromaticity has x from -0.5 to 1.5 and y from 0.0001 to 1.5"
            ),
        ))
    }

    fn white(
        &self,
        written: Option<WhiteDescription>,
        primaries: &Primaries,
    ) -> Result<Option<[f64; 2]>, DisplayError> {
        match (written, primaries) {
            (Some(WhiteDescription::Chromaticity(xy)), _) => self.chromaticity("white", xy).map(Some),
            (Some(WhiteDescription::Illuminant(name)), _) => {
                let light = self.illuminant("white", &name)?;
                let weights = Weights::new(&light, Observer::Cie1931Deg2, Rule::FiveNm)
                    .map_err(|error| self.fault("white", error.to_string()))?;
                Ok(Some(xy_of_xyz(weights.white())))
            }
            (None, Primaries::Spectra(_)) => Ok(None),
            (None, Primaries::Chromaticities(_)) => Err(self.fault(
                "white",
                "it is missing; primaries that are chromaticities need it, as a chromaticity [x, y] or the name of an illuminant",
            )),
        }
    }

    fn illuminant(&self, field: &'static str, name: &str) -> Result<Spectrum, DisplayError> {
        let set = spectra::find_illuminant(name);
        set.map(|set| set.data)
            .map_err(|error| self.fault(field, error.to_string()))
    }

    /// Reads the ambient light, whose luminance is E ρ / π.
    fn ambient(&self, written: &AmbientDescription) -> Result<Ambient, DisplayError> {
        let illuminance =
            self.number("ambient.illuminance_lux", written.illuminance_lux, 0.0, 1e6)?;
        let reflectance = self.number("ambient.reflectance", written.reflectance, 0.0, 1.0)?;
        Ok(Ambient {
            luminance: illuminance * reflectance / std::f64::consts::PI,
            light: self.illuminant("ambient.illuminant", &written.illuminant)?,
        })
    }

    fn responses(
        &self,
        written: &ResponseDescription,
        white_luminance: f64,
        black_luminance: f64,
    ) -> Result<[Response; 3], DisplayError> {
        let curve = written.curve;
        for (field, is_given, of) in [
            ("response.gamma", written.gamma.is_some(), Curve::Gamma),
            ("response.alpha", written.alpha.is_some(), Curve::Gamma),
            ("response.csv", written.csv.is_some(), Curve::Table),
        ] {
            if is_given && curve != of {
                let name = if of == Curve::Gamma { "gamma" } else { "table" };
                return Err(self.fault(
                    field,
                    format!("it has no effect here; it requires curve = {name:?}"),
                ));
            }
        }
        Ok(match curve {
            Curve::Linear => [const { Response::Linear }; 3],
            Curve::Srgb => [const { Response::Srgb }; 3],
            Curve::Gamma => self.gamma(written)?,
            Curve::Bt1886 => {
                let black = black_luminance / (white_luminance + black_luminance);
                std::array::from_fn(|_| Response::Bt1886 { black })
            }
            Curve::Pq if white_luminance > PQ_PEAK => {
                return Err(self.fault(
                    "white_luminance",
                    format!("found {white_luminance}; the codes of PQ end at {PQ_PEAK} cd/m²"),
                ));
            }
            Curve::Pq => std::array::from_fn(|_| Response::Pq { white_luminance }),
            Curve::Table => self.measured(written)?,
        })
    }

    fn gamma(&self, written: &ResponseDescription) -> Result<[Response; 3], DisplayError> {
        let Some(gamma) = written.gamma else {
            return Err(self.fault(
                "response.gamma",
                "it is missing; curve = \"gamma\" needs it, such as 2.2",
            ));
        };
        let alpha = written.alpha.unwrap_or(PerChannel::Same(0.0)).each();
        let mut responses = [const { Response::Linear }; 3];
        for ((response, gamma), alpha) in responses.iter_mut().zip(gamma.each()).zip(alpha) {
            *response = Response::Gamma {
                gamma: self.number("response.gamma", gamma, 0.1, 10.0)?,
                alpha: self.number("response.alpha", alpha, -0.9, 0.9)?,
            };
        }
        Ok(responses)
    }

    /// Reads a measured response, with codes and amounts relative to the last ones of the table.
    fn measured(&self, written: &ResponseDescription) -> Result<[Response; 3], DisplayError> {
        let field = "response.csv";
        let Some(csv) = &written.csv else {
            return Err(self.fault(field, "it is missing; curve = \"table\" needs a file with the columns code, red, green, blue"));
        };
        let text = (self.read)(csv)?;
        let rows = parse_rows::<3>(&text).map_err(|source| self.table_fault(csv, source))?;
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
            return Err(self.table_fault(csv, TableFileError::Empty));
        };
        if first.nm != 0.0 || last.nm <= 0.0 {
            return Err(self.fault(
                field,
                format!(
                    "codes must rise from 0, but the first is {} and the last is {}",
                    first.nm, last.nm
                ),
            ));
        }
        let mut responses = [const { Response::Linear }; 3];
        for (channel, response) in responses.iter_mut().enumerate() {
            let points = rows
                .iter()
                .map(|row| (row.nm / last.nm, row.values[channel] / last.values[channel]));
            *response = Response::Table(self.rising(points.collect())?);
        }
        Ok(responses)
    }

    fn rising(&self, points: Vec<(f64, f64)>) -> Result<Tabulated, DisplayError> {
        let rises = points.windows(2).all(|pair| pair[0].1 <= pair[1].1);
        match Tabulated::new(points) {
            Ok(table) if rises && table.clamped_at(0.0) >= 0.0 => Ok(table),
            _ => Err(self.fault(
                "response.csv",
                "codes must rise, and amounts of light must not be negative or fall from one code to the next; the last must be above 0",
            )),
        }
    }
}
