//! A display as written in a file.

use document::Document;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// A display as written in a file.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    /// The full name of the display.
    #[serde(default)]
    pub(super) title: String,
    /// The standard or measurement that the data come from.
    #[serde(default)]
    pub(super) source: String,
    /// Remarks.
    #[serde(default)]
    pub(super) notes: String,
    /// A chromaticity [x, y], or the name of an illuminant. When absent, spectra are driven equally.
    pub(super) white: Option<WhiteDescription>,
    /// Luminance of the white in cd/m², without that of black.
    #[serde(default = "hundred")]
    pub(super) white_luminance: f64,
    /// Luminance at code 0 in cd/m².
    #[serde(default)]
    pub(super) black_luminance: f64,
    /// The light of full red, green and blue.
    pub(super) primaries: PrimariesDescription,
    /// Amounts of light for codes.
    pub(super) response: ResponseDescription,
    /// Light that the screen reflects; none when absent.
    pub(super) ambient: Option<AmbientDescription>,
}

fn hundred() -> f64 {
    100.0
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum WhiteDescription {
    Chromaticity(Vec<f64>),
    Illuminant(String),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PrimariesDescription {
    /// Chromaticity of red, [x, y].
    pub(super) red: Option<Vec<f64>>,
    /// Chromaticity of green, [x, y].
    pub(super) green: Option<Vec<f64>>,
    /// Chromaticity of blue, [x, y].
    pub(super) blue: Option<Vec<f64>>,
    /// Instead of chromaticities: a table with the columns nm, red, green, blue.
    pub(super) spectra: Option<PathBuf>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ResponseDescription {
    /// The kind of response.
    pub(super) curve: Curve,
    /// For gamma: the exponent, one for all channels or one for each.
    pub(super) gamma: Option<PerChannel>,
    /// For gamma: the α of ((V − α)/(1 − α))^γ, one for all channels or one for each; 0 when absent.
    pub(super) alpha: Option<PerChannel>,
    /// For table: a file with the columns code, red, green, blue.
    pub(super) csv: Option<PathBuf>,
}

#[derive(Clone, Copy, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Curve {
    Linear,
    Srgb,
    Gamma,
    Bt1886,
    Pq,
    Table,
}

#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(untagged)]
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

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AmbientDescription {
    /// Illuminance of the screen, lx.
    pub(super) illuminance_lux: f64,
    /// Diffuse reflectance of the screen.
    pub(super) reflectance: f64,
    /// Name of the illuminant.
    pub(super) illuminant: String,
}

impl Document for Description {
    const NEEDS: &'static str = "a display needs at least [primaries] and [response]";
}
