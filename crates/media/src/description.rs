//! Media and reflectances as written in a file.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How a table extends outside its wavelengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Extrapolate {
    /// Not at all: it is an error if a value is needed there.
    #[default]
    Error,
    /// Its first or last value.
    Clamp,
}

/// A reflectance: the fraction of the incident light that is reflected, from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Reflectance {
    /// The same at every wavelength.
    Constant(#[schemars(range(min = 0.0, max = 1.0))] f64),
    /// The name of a reflectance built into Pellicle, such as `white_9_5` of the `ColorChecker`.
    Name(String),
    /// A smooth reflectance whose color under D65 has these sRGB values (IEC 61966-2-1).
    Srgb {
        /// Red, green and blue as encoded in pictures, from 0 to 1.
        #[schemars(inner(range(min = 0.0, max = 1.0)))]
        srgb: [f64; 3],
    },
    /// A smooth reflectance whose color under D65 has these linear sRGB values.
    LinearSrgb {
        /// Red, green and blue, proportional to light, from 0 to 1.
        #[schemars(inner(range(min = 0.0, max = 1.0)))]
        linear_srgb: [f64; 3],
    },
    /// The name of a reflectance built into Pellicle, and how it extends outside its wavelengths.
    Named {
        /// The name.
        name: String,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table written here, interpolated linearly.
    Table {
        /// Wavelengths in nm, in ascending order.
        nm: Vec<f64>,
        /// The reflectance at each of them.
        values: Vec<f64>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in a file.
    File {
        /// A text file with columns for wavelength and reflectance, or a file written by a measuring instrument. The path is relative to
        /// this file.
        csv: PathBuf,
        /// The column of the file, by its name in the header or its number from 1; needed if there are several.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<TableColumn>,
        /// The units that the file's header does not name: "nm", "um", "angstrom" or "eV" for wavelengths, "percent" for values, or both,
        /// as in "um percent".
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
}

/// A complex index of refraction n + ik with k ≥ 0; k > 0 absorbs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Index {
    /// Real and the same at every wavelength.
    Real(#[schemars(range(min = limits::INDEX_N.low, max = limits::INDEX_N.high))] f64),
    /// `[n, k]`, the same at every wavelength.
    Complex([f64; 2]),
    /// The name of a material whose index is built into Pellicle, such as "gold".
    Name(String),
    /// The name of a material whose index is built into Pellicle, and how it extends outside its wavelengths.
    Named {
        /// The name.
        name: String,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table written here, interpolated linearly.
    Table {
        /// Wavelengths in nm, in ascending order.
        nm: Vec<f64>,
        /// The real part at each of them.
        n: Vec<f64>,
        /// The imaginary part at each of them; 0 when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        k: Option<Vec<f64>>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in a file.
    File {
        /// A text file with columns for wavelength, n and, unless it is 0, k. The path is relative to this file.
        csv: PathBuf,
        /// The columns of n and k, as in `["n_o", "k_o"]`, or the column of n alone, by their names in the header or their numbers from 1;
        /// needed if the header does not identify them.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<IndexColumns>,
        /// The unit of the wavelengths, if the file's header does not name it: "nm", "um", "angstrom" or "eV".
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A file of the refractiveindex.info database, or one like it.
    Database {
        /// A YAML file with `DATA` blocks: tables of n, k or both, and the formulas 1 to 9; relative to this file.
        yaml: PathBuf,
        /// How the data extend outside their wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// Cauchy's formula, n = A + B/λ² + C/λ⁴ with λ in µm; k is 0.
    Cauchy {
        /// A, B in µm² and C in µm⁴; C, or B and C, may be left out.
        cauchy: Vec<f64>,
        /// What to do at wavelengths where the formula yields no index.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// Sellmeier's formula, n² = 1 + Σ b λ²/(λ² − c) with λ in µm; k is 0.
    Sellmeier {
        /// The coefficients.
        sellmeier: SellmeierTerms,
        /// What to do at wavelengths where the formula yields no index.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// The real index with a given reflectance at normal incidence: n = (1 + √F) / (1 − √F), k = 0 (Cook and Torrance 1982).
    Reflecting {
        /// The reflectance at normal incidence, at most 0.996.
        normal_reflectance: Reflectance,
    },
    /// A mixture of two media, in grains much smaller than the wavelength.
    Mixture {
        /// The rule.
        mixture: MixtureRule,
        /// The two media; for Maxwell Garnett, the second forms spheres in the first.
        of: Box<[Index; 2]>,
        /// The fraction of the volume that the second medium fills.
        #[schemars(range(min = limits::FRACTION.low, max = limits::FRACTION.high))]
        fraction: f64,
    },
}

/// The terms of Sellmeier's formula.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SellmeierTerms {
    /// The strengths b.
    pub b: Vec<f64>,
    /// The squares c of the resonant wavelengths in µm², one for each strength.
    pub c_um2: Vec<f64>,
}

/// A rule for the index of a mixture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MixtureRule {
    /// Grains of both media side by side (Bruggeman 1935).
    Bruggeman,
    /// Spheres of the second medium in the first (Maxwell Garnett 1904).
    MaxwellGarnett,
}

/// A column of a table in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum TableColumn {
    /// Its position; the first column of the file is 1.
    Number(#[schemars(range(min = 1))] u32),
    /// Its name in the header, or the id or name of a sample.
    Name(String),
}

/// The columns of an index in a table of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum IndexColumns {
    /// The column of n; k is 0.
    N(TableColumn),
    /// The columns of n and k.
    Both([TableColumn; 2]),
}
