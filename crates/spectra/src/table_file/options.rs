//! What a user states about a file.

/// A unit of the wavelengths in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// Nanometers.
    Nm,
    /// Micrometers.
    Um,
    /// Ångström, 0.1 nm.
    Angstrom,
    /// Photon energy in electronvolts.
    Ev,
}

/// h c / e in eV nm, exact by the definitions of the SI.
const EV_NM: f64 = 1_239.841_984_332_002_6;

impl Unit {
    /// Returns the wavelength in nm of a number in this unit.
    pub fn nm(self, number: f64) -> f64 {
        match self {
            Self::Nm => number,
            // A single rounding, so that 0.38 µm is 380 nm.
            Self::Um => number * 1000.0,
            Self::Angstrom => number / 10.0,
            Self::Ev => EV_NM / number,
        }
    }

    /// The symbol of the unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nm => "nm",
            Self::Um => "µm",
            Self::Angstrom => "Å",
            Self::Ev => "eV",
        }
    }

    /// Returns the unit that a word such as `um`, `µm` or `microns` names.
    pub fn from_word(word: &str) -> Option<Self> {
        Some(match word.to_lowercase().as_str() {
            "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" | "nanometern" => {
                Self::Nm
            }
            "um" | "µm" | "μm" | "micron" | "microns" | "micrometer" | "micrometers"
            | "micrometre" | "micrometres" => Self::Um,
            "å" | "\u{212b}" | "a\u{30a}" | "angstrom" | "angstroms" | "ångström" | "angström" => {
                Self::Angstrom
            }
            "ev" => Self::Ev,
            _ => return None,
        })
    }
}

/// A column that a user requests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ColumnChoice {
    /// By its name in the header, or the name or id of a sample.
    Name(String),
    /// By its position in the file, from 1.
    Number(usize),
}

/// What a user states about a file; nothing by default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The unit of the wavelengths.
    pub unit: Option<Unit>,
    /// Whether the values are in percent.
    pub is_percent: bool,
    /// The columns of the values, one per quantity.
    pub columns: Vec<ColumnChoice>,
}

impl Options {
    /// Sets the units of wavelengths and values from words such as `um`, `percent` or `um, %`.
    ///
    /// # Errors
    /// When a word is neither; the text lists the possible ones.
    pub fn set_unit(&mut self, words: &str) -> Result<(), String> {
        let is_blank = |c: char| c == ',' || c.is_whitespace();
        for word in words.split(is_blank).filter(|word| !word.is_empty()) {
            if word == "%" || word.eq_ignore_ascii_case("percent") {
                self.is_percent = true;
            } else if let Some(unit) = Unit::from_word(word) {
                self.unit = Some(unit);
            } else {
                let word: String = word.chars().take(40).collect();
                return Err(format!(
                    "found {word:?}; it must be \"nm\", \"um\", \"angstrom\" or \"eV\" for the wavelengths, \
                     \"percent\" for the values, or both, as in \"um percent\""
                ));
            }
        }
        Ok(())
    }
}
