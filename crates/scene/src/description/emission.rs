//! What lights emit, as written.

use super::{Extrapolate, TableColumn};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What a light emits: a spectrum, and one number that says how much of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Emission {
    /// The spectrum.
    #[serde(flatten)]
    pub spectrum: EmissionSpectrum,
    /// How much of it.
    #[serde(flatten)]
    pub strength: Strength,
}

/// The spectrum of a light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum EmissionSpectrum {
    /// The same at every wavelength.
    Constant {
        /// The radiance at scale 1, in W m⁻² sr⁻¹ nm⁻¹.
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        constant: f64,
    },
    /// An illuminant that Pellicle carries. At scale 1 it is as bright as constant = 1.
    Illuminant {
        /// The name: a standard one ("A", "C", "D65", "E"), a fluorescent lamp ("F11" or "FL11"), a LED ("LED-B3"), a
        /// high-pressure lamp ("HP1"), or a temperature of daylight ("D5700K") or of a black body ("blackbody_3000K").
        illuminant: String,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
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
    },
    /// A table in a file.
    File {
        /// A text file with the columns wavelength and radiance at scale 1, or of a lamp by IES TM-27; relative to the scene file.
        csv: PathBuf,
        /// Which column of the file, by its name in the head or its number from 1; needed where there are several.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<TableColumn>,
        /// The unit that the file's head does not name: "nm", "um", "angstrom" or "eV" of its wavelengths.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// What the table says outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
}

/// How much light of a spectrum: at most one of these; `scale = 1` where none is written. Sums run over the wavelengths of the
/// scene, and a unit of length of the scene counts as a meter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Strength {
    /// Factor of the spectrum, which is a radiance in W m⁻² sr⁻¹ nm⁻¹; of a point or spot an intensity in W sr⁻¹ nm⁻¹, of a distant light
    /// an irradiance in W m⁻² nm⁻¹.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
    pub scale: Option<f64>,
    /// Radiance in W m⁻² sr⁻¹: of emitters, environment, and distant lights with a diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub radiance: Option<f64>,
    /// Luminance in cd m⁻²: of emitters, environment, and distant lights with a diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub luminance_cd_m2: Option<f64>,
    /// Power in W that each object of an emitter (of plane ones both sides together), or that a point or spot sends out as light
    /// of the scene's wavelengths: less than what a lamp takes from the mains.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub power_w: Option<f64>,
    /// Power in lm that each object of an emitter (of plane ones both sides together), or that a point or spot sends out: what the
    /// box of a lamp says.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub power_lm: Option<f64>,
    /// Irradiance in W m⁻² of a surface that faces a distant light, or under constant environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub irradiance_w_m2: Option<f64>,
    /// Illuminance in lux of a surface that faces a distant light, or under constant environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub illuminance_lux: Option<f64>,
    /// Intensity in W sr⁻¹ of a point, or of a spot along its axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub intensity_w_sr: Option<f64>,
    /// Intensity in cd of a point, or of a spot along its axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub intensity_cd: Option<f64>,
}

/// Constructors of all units.
macro_rules! units {
    ($($(#[$doc:meta])* $unit:ident,)*) => {
        impl Strength {
            $(
                $(#[$doc])*
                pub fn $unit($unit: f64) -> Self {
                    Self {
                        $unit: Some($unit),
                        ..Self::default()
                    }
                }
            )*
        }
    };
}

units! {
    /// A factor.
    scale,
    /// A radiance in W m⁻² sr⁻¹.
    radiance,
    /// A luminance in cd m⁻².
    luminance_cd_m2,
    /// A power in W.
    power_w,
    /// A power in lm.
    power_lm,
    /// An irradiance in W m⁻².
    irradiance_w_m2,
    /// An illuminance in lux.
    illuminance_lux,
    /// An intensity in W sr⁻¹.
    intensity_w_sr,
    /// An intensity in cd.
    intensity_cd,
}

impl Emission {
    /// The light of an illuminant that Pellicle carries, such as "D65".
    pub fn illuminant(name: impl Into<String>, strength: Strength) -> Self {
        Self {
            spectrum: EmissionSpectrum::Illuminant {
                illuminant: name.into(),
                extrapolate: Extrapolate::Error,
            },
            strength,
        }
    }

    /// The same light at every wavelength, 1 W m⁻² sr⁻¹ nm⁻¹ at scale 1.
    pub fn even(strength: Strength) -> Self {
        Self {
            spectrum: EmissionSpectrum::Constant { constant: 1.0 },
            strength,
        }
    }
}
