//! What emitters emit, as written in a scene file.

use super::{Extrapolate, Polarization, TableColumn};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What an emitter emits: a spectrum, one number for its strength, and its polarization.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Emission {
    /// The spectrum.
    #[serde(flatten)]
    pub spectrum: EmissionSpectrum,
    /// The strength.
    #[serde(flatten)]
    pub strength: Strength,
    /// The polarization; unpolarized when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polarization: Option<Polarization>,
}

/// The spectrum of an emitter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum EmissionSpectrum {
    /// The same at every wavelength.
    Constant {
        /// The radiance at scale 1, in W m⁻² sr⁻¹ nm⁻¹.
        #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
        constant: f64,
    },
    /// An illuminant built into Pellicle. At scale 1 it has the same luminance as constant = 1.
    Illuminant {
        /// The name: a standard one ("A", "C", "D65", "E"), a fluorescent lamp ("F11" or "FL11"), an LED ("LED-B3"), a high-pressure lamp
        /// ("HP1"), or a temperature of daylight ("D5700K") or of a black body ("blackbody_3000K").
        illuminant: String,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in the scene file, interpolated linearly.
    Table {
        /// Wavelengths in nm, in ascending order.
        nm: Vec<f64>,
        /// The radiance at each of them, at scale 1.
        values: Vec<f64>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
    /// A table in a file.
    File {
        /// A text file with columns for wavelength and radiance at scale 1, or a lamp's file by IES TM-27. The path is relative to the
        /// scene file.
        csv: PathBuf,
        /// The column of the file, by its name in the header or its number from 1; needed if there are several.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        column: Option<TableColumn>,
        /// The unit of the wavelengths, if the file's header does not name it: "nm", "um", "angstrom" or "eV".
        #[serde(default, skip_serializing_if = "Option::is_none")]
        unit: Option<String>,
        /// How the table extends outside its wavelengths.
        #[serde(default)]
        extrapolate: Extrapolate,
    },
}

/// The strength of an emission: at most one of these, or `scale = 1` when all are absent. Integrals run over the scene's wavelengths, and
/// one scene unit counts as a meter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Strength {
    /// Factor of the spectrum, which is a radiance in W m⁻² sr⁻¹ nm⁻¹; for a point or spot, an intensity in W sr⁻¹ nm⁻¹; for a distant
    /// light, an irradiance in W m⁻² nm⁻¹.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::EMISSION.low, max = limits::EMISSION.high))]
    pub scale: Option<f64>,
    /// Radiance in W m⁻² sr⁻¹, for objects, the environment, and distant lights with a diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub radiance: Option<f64>,
    /// Luminance in cd m⁻², for objects, the environment, and distant lights with a diameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub luminance_cd_m2: Option<f64>,
    /// Power in W that a point, a spot, or each object with this material emits within the scene's wavelengths; for a flat object, both
    /// sides together. It is less than the electrical power of a lamp.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub power_w: Option<f64>,
    /// Luminous flux in lm that a point, a spot, or each object with this material emits; for a flat object, both sides together. The box
    /// of a lamp states it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub power_lm: Option<f64>,
    /// Irradiance in W m⁻² on a surface that faces a distant light, or on one in a constant environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub irradiance_w_m2: Option<f64>,
    /// Illuminance in lux on a surface that faces a distant light, or on one in a constant environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub illuminance_lux: Option<f64>,
    /// Radiant intensity in W sr⁻¹ of a point, or of a spot along its axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub intensity_w_sr: Option<f64>,
    /// Luminous intensity in cd of a point, or of a spot along its axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = limits::STRENGTH.low, max = limits::STRENGTH.high))]
    pub intensity_cd: Option<f64>,
}

/// Defines a constructor for each unit.
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
    /// The emission of an illuminant built into Pellicle, such as "D65".
    pub fn illuminant(name: impl Into<String>, strength: Strength) -> Self {
        Self {
            spectrum: EmissionSpectrum::Illuminant {
                illuminant: name.into(),
                extrapolate: Extrapolate::Error,
            },
            strength,
            polarization: None,
        }
    }

    /// The same radiance at every wavelength, 1 W m⁻² sr⁻¹ nm⁻¹ at scale 1.
    pub fn even(strength: Strength) -> Self {
        Self {
            spectrum: EmissionSpectrum::Constant { constant: 1.0 },
            strength,
            polarization: None,
        }
    }
}
