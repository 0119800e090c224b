//! Numbers over wavelength as written.

use super::{IndexColumns, TableColumn};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What a table says outside its wavelengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Extrapolate {
    /// Nothing: asking there is an error.
    #[default]
    Error,
    /// Its first or last value.
    Clamp,
}

/// A reflectance: the part of the light that comes back, from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Reflectance {
    /// The same at every wavelength.
    Constant(#[schemars(range(min = 0.0, max = 1.0))] f64),
    /// The name of a reflectance that Pellicle carries, such as `white_9_5` of the `ColorChecker`.
    Name(String),
    /// A smooth reflectance with the color of these codes of sRGB (IEC 61966-2-1) under D65.
    Srgb {
        /// Red, green and blue as pictures have them, from 0 to 1.
        #[schemars(inner(range(min = 0.0, max = 1.0)))]
        srgb: [f64; 3],
    },
    /// A smooth reflectance with the color of these amounts of sRGB's primaries under D65.
    LinearSrgb {
        /// Red, green and blue in proportion to light, from 0 to 1.
        #[schemars(inner(range(min = 0.0, max = 1.0)))]
        linear_srgb: [f64; 3],
    },
    /// The name of a reflectance that Pellicle carries, and what to do outside its wavelengths.
    Named {
        /// The name.
        name: String,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in the scene, linear between its points.
    Table {
        /// Wavelengths in nm, rising.
        nm: Vec<f64>,
        /// The reflectance at each of them.
        values: Vec<f64>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in a file.
    File {
        /// A text file with the columns wavelength and reflectance, or of a measuring instrument; relative to the scene file.
        csv: PathBuf,
        /// Which column of the file, by its name in the head or its number from 1; needed where there are several.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<TableColumn>,
        /// Units that the file's head does not name: "nm", "um", "angstrom" or "eV" of its wavelengths, "percent" of its values,
        /// or both, as in "um percent".
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
}

/// A complex index of refraction n + ik; k ≥ 0 absorbs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Index {
    /// Real and the same at every wavelength.
    Real(#[schemars(range(min = limits::INDEX_N.low, max = limits::INDEX_N.high))] f64),
    /// `[n, k]`, the same at every wavelength.
    Complex([f64; 2]),
    /// The name of a material whose index Pellicle carries, such as "gold".
    Name(String),
    /// The name of a material whose index Pellicle carries, and what to do outside its wavelengths.
    Named {
        /// The name.
        name: String,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in the scene, linear between its points.
    Table {
        /// Wavelengths in nm, rising.
        nm: Vec<f64>,
        /// The real part at each of them.
        n: Vec<f64>,
        /// The imaginary part at each of them; 0 when absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        k: Option<Vec<f64>>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in a file.
    File {
        /// A text file with the columns wavelength, n and (0 when absent) k; relative to the scene file.
        csv: PathBuf,
        /// The columns of n and k, as in `["n_o", "k_o"]`, or that of n alone: by their names in the head or their numbers from 1;
        /// needed where the head does not tell.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<IndexColumns>,
        /// The unit that the file's head does not name: "nm", "um", "angstrom" or "eV" of its wavelengths.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A file of the refractiveindex.info database, or one like it.
    Database {
        /// A YAML file with `DATA` blocks: tables of n, k or both, and the formulas 1 to 9; relative to the scene file.
        yaml: PathBuf,
        /// What the data say outside their wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// Cauchy's formula, n = A + B/λ² + C/λ⁴ with λ in µm; k is 0.
    Cauchy {
        /// A, B in µm² and C in µm⁴; the later ones may be left out.
        cauchy: Vec<f64>,
        /// What the formula says where it gives no index.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// Sellmeier's formula, n² = 1 + Σ b λ²/(λ² − c) with λ in µm; k is 0.
    Sellmeier {
        /// The coefficients.
        sellmeier: SellmeierTerms,
        /// What the formula says where it gives no index.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// The index without absorption that reflects as much at normal incidence: n = (1 + √F) / (1 − √F), k = 0
    /// (Cook and Torrance 1982).
    Reflecting {
        /// The reflectance at normal incidence, at most 0.996.
        normal_reflectance: Reflectance,
    },
    /// A mixture of two media, in grains far smaller than the wavelength.
    Mixture {
        /// The rule.
        mixture: MixtureRule,
        /// The two media; by Maxwell Garnett the second is spheres in the first.
        of: Box<[Index; 2]>,
        /// The part of the volume that the second medium fills.
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
