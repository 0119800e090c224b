//! Displays: the light that they emit for RGB codes.
//!
//! A display mixes three primaries: XYZ = M C, where C are the amounts of red, green and blue, each 1 for the white. The
//! channel's [`Response`] gives each amount from the code V in \[0, 1\] (Suzuki, Yokoi and Toriwaki, sections 2-2 and 2-3). The
//! light that the screen shows at code 0 is added.
//!
//! M comes from the spectra of the primaries, M = ∫ (x̄, ȳ, z̄) (r, g, b) dλ, or from the chromaticities of the primaries and the
//! white, with each column scaled so that C = (1, 1, 1) is the white (SMPTE RP 177:1993). See [`Display::open`] for names and files.

mod description;
mod file;
mod response;
mod shipped;
mod validate;

pub use file::DisplayError;
pub use response::Response;

use spectra::{Observer, Spectrum, Tabulated};

use crate::chromaticity::{mixed, uv_of_xy, xy_of_xyz, xyz_of_xy};
use crate::matrix::{Matrix3, determinant, inverse, of_columns, times};
use crate::tristimulus::{Rule, Weights, xyz_of_emission};

/// A display: its primaries, responses, white, black level and ambient light.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    name: String,
    title: String,
    source: String,
    notes: String,
    primaries: Primaries,
    amounts: [f64; 3],
    observer: Observer,
    xyz_from_rgb: Matrix3,
    rgb_from_xyz: Matrix3,
    responses: [Response; 3],
    white_luminance: f64,
    black_luminance: f64,
    ambient: Option<Ambient>,
    black: [f64; 3],
}

/// Ambient light that the screen reflects.
#[derive(Clone, Debug, PartialEq)]
struct Ambient {
    /// Luminance of the reflected light, cd/m².
    luminance: f64,
    light: Spectrum,
}

/// The light of full red, green and blue.
#[derive(Clone, Debug, PartialEq)]
pub enum Primaries {
    /// Chromaticities x, y for the CIE 1931 2° observer.
    Chromaticities([[f64; 2]; 3]),
    /// Relative spectral power, 380 to 780 nm.
    Spectra(Box<[Tabulated; 3]>),
}

/// Why primaries and a white do not define a display.
#[derive(Clone, Copy, Debug, thiserror::Error, PartialEq, Eq)]
enum MixtureError {
    /// A spectrum does not cover 380 to 780 nm or is 0 there.
    #[error("each primary's spectrum must emit light and cover 380 to 780 nm")]
    Spectrum,
    /// The primaries cannot mix the white.
    #[error(
        "the white must lie within the triangle of red, green and blue, but no positive amounts of the three mix it"
    )]
    White,
    /// The ambient light is not visible.
    #[error("it must emit light and cover 380 to 780 nm")]
    Ambient,
}

impl Primaries {
    /// Returns the matrix whose columns are XYZ of the primaries: with Y = 1 for chromaticities, unscaled for spectra.
    fn columns(&self, observer: Observer) -> Result<Matrix3, MixtureError> {
        let spectra = match self {
            Self::Chromaticities(xy) => return Ok(of_columns(xy.map(xyz_of_xy))),
            Self::Spectra(spectra) => spectra,
        };
        let mut columns = [[0.0; 3]; 3];
        for (column, table) in columns.iter_mut().zip(spectra.iter()) {
            *column = xyz_of_emission(&Spectrum::Table(table.clone()), observer, Rule::FiveNm)
                .map_err(|_| MixtureError::Spectrum)?;
            if column[1] <= 0.0 {
                return Err(MixtureError::Spectrum);
            }
        }
        Ok(of_columns(columns))
    }

    /// Returns the amounts of the three primaries that mix the white; equal amounts if no white is given.
    fn amounts(&self, white: Option<[f64; 2]>) -> Result<[f64; 3], MixtureError> {
        let columns = self.columns(Observer::Cie1931Deg2)?;
        let inverse = inverse(&columns);
        let amounts = white.map_or([1.0; 3], |white| times(&inverse, xyz_of_xy(white)));
        let is_mixed = amounts
            .iter()
            .all(|&amount| amount > 0.0 && amount.is_finite());
        // Whether the three colors lie on a line.
        let is_flat = determinant(&columns).abs() < 1e-9 * columns[1].iter().product::<f64>();
        if is_mixed && !is_flat {
            Ok(amounts)
        } else {
            Err(MixtureError::White)
        }
    }
}

impl Display {
    /// Returns a built-in display by its name.
    pub fn named(name: &str) -> Option<Self> {
        shipped::named(name)
    }

    /// The names of the built-in displays, sorted.
    pub fn names() -> Vec<&'static str> {
        shipped::names()
    }

    /// The short name of the display.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The full name of the display.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The standard or measurement that the data come from; empty if the file states none.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Notes about the data.
    pub fn notes(&self) -> &str {
        &self.notes
    }

    /// The primaries as given.
    pub fn primaries(&self) -> &Primaries {
        &self.primaries
    }

    /// The matrix M, whose columns are XYZ of full red, green and blue, relative to Y = 1 for the white.
    pub fn xyz_from_rgb(&self) -> &Matrix3 {
        &self.xyz_from_rgb
    }

    /// The matrix M⁻¹.
    pub fn rgb_from_xyz(&self) -> &Matrix3 {
        &self.rgb_from_xyz
    }

    /// The observer of the display's XYZ.
    pub fn observer(&self) -> Observer {
        self.observer
    }

    /// Returns the display for another observer if the primaries are spectra; `None` if they are chromaticities, which are valid for
    /// CIE 1931 only.
    pub fn seen_by(&self, observer: Observer) -> Option<Self> {
        if observer == self.observer {
            return Some(self.clone());
        }
        if let Primaries::Chromaticities(_) = self.primaries {
            return None;
        }
        let mut display = self.clone();
        display.mix(observer).ok()?;
        Some(display)
    }

    /// Computes M, M⁻¹ and the light that the screen shows at code 0.
    fn mix(&mut self, observer: Observer) -> Result<(), MixtureError> {
        let columns = self.primaries.columns(observer)?;
        self.observer = observer;
        self.xyz_from_rgb = mixed(&columns, self.amounts);
        self.rgb_from_xyz = inverse(&self.xyz_from_rgb);
        let own = self.white_xyz().map(|v| v * self.black_luminance);
        let reflected = match &self.ambient {
            Some(Ambient { luminance, light }) => Weights::new(light, observer, Rule::FiveNm)
                .map_err(|_| MixtureError::Ambient)?
                .white()
                .map(|v| v * luminance),
            None => [0.0; 3],
        };
        self.black = std::array::from_fn(|i| (own[i] + reflected[i]) / self.white_luminance);
        Ok(())
    }

    /// XYZ of the white (1, 1, 1), with Y = 1.
    pub fn white_xyz(&self) -> [f64; 3] {
        times(&self.xyz_from_rgb, [1.0; 3])
    }

    /// Chromaticities of full red, green and blue.
    pub fn primaries_xy(&self) -> [[f64; 2]; 3] {
        std::array::from_fn(|i| xy_of_xyz(self.xyz_from_rgb.map(|row| row[i])))
    }

    /// The response of each channel.
    pub fn responses(&self) -> &[Response; 3] {
        &self.responses
    }

    /// The largest amount of any channel: 1, or more if there are codes above the white (PQ).
    pub fn peak(&self) -> f64 {
        self.responses
            .iter()
            .map(Response::peak)
            .fold(1.0, f64::max)
    }

    /// Luminance of the white, cd/m², without the luminance of black.
    pub fn white_luminance(&self) -> f64 {
        self.white_luminance
    }

    /// XYZ that the screen shows at code 0, from its black level and reflected ambient light, relative to Y = 1 for the white.
    /// It is added to every color.
    pub fn black_xyz(&self) -> [f64; 3] {
        self.black
    }

    /// Area of the gamut, the triangle of the primaries, in the x, y diagram.
    pub fn gamut_area_xy(&self) -> f64 {
        area(self.primaries_xy())
    }

    /// Area of the gamut in the u′, v′ diagram.
    pub fn gamut_area_uv(&self) -> f64 {
        area(self.primaries_xy().map(uv_of_xy))
    }
}

/// Returns the area of a triangle.
fn area([[x0, y0], [x1, y1], [x2, y2]]: [[f64; 2]; 3]) -> f64 {
    0.5 * ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)).abs()
}

#[cfg(test)]
mod tests;
