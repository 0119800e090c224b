//! What emitters of a validated scene give off.

use crate::rounding::RoundToF32;
use crate::{LightGroupId, SpectrumId};

/// A spectrum and its scale. Their product is a radiance in W m⁻² sr⁻¹ nm⁻¹; for a point or a spot it is an intensity in W sr⁻¹ nm⁻¹, and
/// for light from a single direction an irradiance in W m⁻² nm⁻¹.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Spectrum at scale 1, ≥ 0.
    pub spectrum: SpectrumId,
    /// Factor, ≥ 0.
    pub scale: f64,
    /// The light group that its light belongs to.
    pub light_group: LightGroupId,
}

impl RoundToF32 for Emission {
    fn rounded(&self) -> Self {
        Self {
            spectrum: self.spectrum,
            scale: self.scale.rounded(),
            light_group: self.light_group,
        }
    }
}
