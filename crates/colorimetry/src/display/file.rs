//! Display files.

use std::ffi::OsStr;
use std::path::Path;

use document::text_file::STANDARD_INPUT;
use document::{Problems, SourceFile, suggestion};
use thiserror::Error;

use super::Display;
use super::description::Description;
use super::validate::{Tables, check};

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
    /// The file or one of its tables cannot be read, or its content is wrong.
    #[error("{0:#}")]
    File(Problems),
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
    /// All problems of the file: it or one of its tables cannot be read, a field is unknown or missing, or a value is impossible.
    pub fn read(path: &Path) -> Result<Self, DisplayError> {
        let (written, mut source) = SourceFile::read(path).map_err(DisplayError::File)?;
        source.allow_outside(true);
        let mut display = finish(&written, &source, &Tables::Files).map_err(DisplayError::File)?;
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

/// Parses the text of a built-in display; its tables are `(file, text)`.
pub(super) fn parse(
    name: &str,
    text: &str,
    tables: &'static [(&'static str, &'static str)],
) -> Result<Display, Problems> {
    let (written, source) = SourceFile::parse(name, text, &"".into())?;
    let mut display = finish(&written, &source, &Tables::BuiltIn(tables))?;
    name.clone_into(&mut display.name);
    Ok(display)
}

fn finish(
    written: &Description,
    source: &SourceFile,
    tables: &Tables,
) -> Result<Display, Problems> {
    source.finish(check(written, source.folder(), tables))
}
