//! Numbers over wavelength as written.

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
        /// A text file with two columns, wavelength in nm and reflectance; relative to the scene file.
        csv: PathBuf,
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
        /// A text file with the columns wavelength in nm, n and (0 when absent) k; relative to the scene file.
        csv: PathBuf,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
}

/// A spectrum of radiance and its scale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Emission {
    /// The same at every wavelength.
    Constant {
        /// The radiance at scale 1.
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        constant: f64,
        /// Factor.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
    },
    /// An illuminant that Pellicle carries, such as "D65". At scale 1 it is as bright as constant = 1.
    Illuminant {
        /// The name.
        illuminant: String,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
        /// Factor.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
    },
    /// A table in the scene, linear between its points.
    Table {
        /// Wavelengths in nm, rising.
        nm: Vec<f64>,
        /// The radiance at each of them, at scale 1.
        values: Vec<f64>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
        /// Factor.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
    },
    /// A table in a file.
    File {
        /// A text file with two columns, wavelength in nm and radiance at scale 1; relative to the scene file.
        csv: PathBuf,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
        /// Factor.
        #[serde(default = "one")]
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        scale: f64,
    },
}

fn one() -> f64 {
    1.0
}
