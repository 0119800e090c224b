//! Display files.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use spectra::suggestion;
use spectra::table_file::TableFileError;
use spectra::text_file::{STANDARD_INPUT, TextFileError, read_text};
use thiserror::Error;

use super::Display;
use super::validate::Checks;

/// Why a display cannot be found or read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DisplayError {
    /// The name is unknown.
    #[error("there is no display {name:?}{}; known names: {}, or a .toml file", .nearest.map_or_else(String::new, |near| format!("; did you mean {near:?}?")), Display::names().join(", "))]
    Unknown {
        /// The requested name.
        name: String,
        /// The name that was probably meant.
        nearest: Option<&'static str>,
    },
    /// A file cannot be read.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: String,
        /// Why.
        source: TextFileError,
    },
    /// A file is not TOML, or does not have the fields of a display.
    #[error("{path} is not a display: {}", .source.to_string().trim_end())]
    Toml {
        /// The file.
        path: String,
        /// What and where.
        source: Box<toml::de::Error>,
    },
    /// A table of spectra or of a response cannot be used.
    #[error("{path}: {source}")]
    Table {
        /// The file.
        path: String,
        /// What and where.
        source: Box<TableFileError>,
    },
    /// A field has an impossible value.
    #[error("{path}: {field}: {message}")]
    Field {
        /// The file.
        path: String,
        /// The field, such as `primaries.red`.
        field: &'static str,
        /// What is wrong and what would be right.
        message: String,
    },
}

impl Display {
    /// Opens a display by its name, or from a file whose name ends in `.toml`, or from standard input for `-`.
    ///
    /// # Errors
    /// When there is no display with the name, or [`Self::read`] fails.
    pub fn open(name_or_file: &str) -> Result<Self, DisplayError> {
        let path = Path::new(name_or_file);
        let is_toml = |extension: &OsStr| extension.eq_ignore_ascii_case("toml");
        if path.extension().is_some_and(is_toml) || path.as_os_str() == STANDARD_INPUT {
            return Self::read(path);
        }
        Self::named(name_or_file).ok_or_else(|| DisplayError::Unknown {
            name: name_or_file.chars().take(64).collect(),
            nearest: nearest(name_or_file),
        })
    }

    /// Reads a display file (TOML). The paths of its tables are relative to it.
    ///
    /// ```toml
    /// title = "my screen"              # optional, as are source and notes
    /// white = [0.3127, 0.3290]         # chromaticity, or the name of an illuminant; when absent, spectra are driven equally
    /// white_luminance = 120            # cd/m², without the luminance of black; 100 when absent
    /// black_luminance = 0.1            # cd/m² at code 0, with the chromaticity of the white; 0 when absent
    ///
    /// [primaries]                      # chromaticities for CIE 1931 …
    /// red = [0.64, 0.33]
    /// green = [0.30, 0.60]
    /// blue = [0.15, 0.06]
    /// # spectra = "primaries.csv"      # … or a table with the columns nm, red, green, blue
    ///
    /// [response]
    /// curve = "gamma"                  # or linear, srgb, bt1886, pq, table
    /// gamma = [2.21, 2.17, 2.25]       # for gamma: ((V − α)/(1 − α))^γ, one for all channels or one each
    /// alpha = 0.02                     # 0 when absent
    /// # csv = "response.csv"           # for table: columns code, red, green, blue; codes and amounts from 0 to any maximum
    ///
    /// [ambient]                        # light that the screen reflects; none when absent
    /// illuminance_lux = 64
    /// reflectance = 0.01               # diffuse
    /// illuminant = "D50"
    /// ```
    ///
    /// # Errors
    /// When the file or one of its tables cannot be read, a field is unknown or missing, or a value is impossible.
    pub fn read(path: &Path) -> Result<Self, DisplayError> {
        let file = |path: &Path| {
            read_text(path).map_err(|source| DisplayError::File {
                path: path.display().to_string(),
                source,
            })
        };
        let text = file(path)?;
        let directory = path.parent().unwrap_or(Path::new(""));
        let mut display = parse(&path.display().to_string(), &text, &|name| {
            file(&directory.join(name))
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        stem.as_ref().clone_into(&mut display.name);
        Ok(display)
    }
}

/// Returns the known name that was probably meant, or else one that contains the word.
fn nearest(name: &str) -> Option<&'static str> {
    let word: String = name.to_lowercase().chars().take(24).collect();
    let part = || {
        let mut names = Display::names().into_iter();
        names.find(|known| word.len() >= 2 && known.contains(&word))
    };
    suggestion::nearest(name, Display::names()).or_else(part)
}

/// A display as written in a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    #[serde(default)]
    pub(super) title: String,
    #[serde(default)]
    pub(super) source: String,
    #[serde(default)]
    pub(super) notes: String,
    pub(super) white: Option<WhiteDescription>,
    #[serde(default = "hundred")]
    pub(super) white_luminance: f64,
    #[serde(default)]
    pub(super) black_luminance: f64,
    pub(super) primaries: PrimariesDescription,
    pub(super) response: ResponseDescription,
    pub(super) ambient: Option<AmbientDescription>,
}

fn hundred() -> f64 {
    100.0
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "expected a chromaticity [x, y] or the name of an illuminant"
)]
pub(super) enum WhiteDescription {
    Chromaticity([f64; 2]),
    Illuminant(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PrimariesDescription {
    pub(super) red: Option<Vec<f64>>,
    pub(super) green: Option<Vec<f64>>,
    pub(super) blue: Option<Vec<f64>>,
    pub(super) spectra: Option<PathBuf>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ResponseDescription {
    pub(super) curve: Curve,
    pub(super) gamma: Option<PerChannel>,
    pub(super) alpha: Option<PerChannel>,
    pub(super) csv: Option<PathBuf>,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Curve {
    Linear,
    Srgb,
    Gamma,
    Bt1886,
    Pq,
    Table,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(
    untagged,
    expecting = "expected a number, or three for red, green and blue"
)]
pub(super) enum PerChannel {
    Same(f64),
    Each([f64; 3]),
}

impl PerChannel {
    pub(super) fn each(self) -> [f64; 3] {
        match self {
            Self::Same(value) => [value; 3],
            Self::Each(values) => values,
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AmbientDescription {
    pub(super) illuminance_lux: f64,
    pub(super) reflectance: f64,
    pub(super) illuminant: String,
}

/// A function that reads the text of a table named in a display file.
pub(super) type ReadTable<'a> = &'a dyn Fn(&Path) -> Result<String, DisplayError>;

/// Parses a display from the text of a file, which errors call `path`.
pub(super) fn parse(path: &str, text: &str, read: ReadTable) -> Result<Display, DisplayError> {
    let written: Description = toml::from_str(text).map_err(|source| DisplayError::Toml {
        path: path.to_owned(),
        source: Box::new(source),
    })?;
    Checks { path, read }.display(written)
}
