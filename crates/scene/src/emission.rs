//! What emitters of a validated scene give off.

use crate::rounding::RoundToF32;
use crate::{LightGroupId, SpectrumId};
use glam::DVec3;

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
    /// Its polarization, which matters only where light is traced with it; `None` for unpolarized light.
    pub polarization: Option<EmittedPolarization>,
}

/// How light is polarized that an emitter gives off. It is the same at all wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EmittedPolarization {
    /// The same Stokes vector in every direction.
    Stokes {
        /// S1, S2 and S3 over S0; the length is at most 1.
        stokes: [f64; 3],
        /// The reference axis, a unit vector: for each ray, its part across the ray.
        axis: DVec3,
    },
    /// A clear sky by single Rayleigh scattering: at an angle γ from the sun, light is polarized across the plane of sun and ray to the degree
    /// `most` · sin²γ / (1 + cos²γ) (Strutt 1871; Coulson, Polarization and Intensity of Light in the Atmosphere, 1988, chapter 2). Light from
    /// below the horizon is unpolarized.
    Sky {
        /// Unit vector toward the sun.
        sun: DVec3,
        /// The degree of polarization at 90° from the sun, from 0 to 1: 1 for a purely molecular atmosphere.
        most: f64,
    },
}

impl RoundToF32 for Emission {
    fn rounded(&self) -> Self {
        Self {
            spectrum: self.spectrum,
            scale: self.scale.rounded(),
            light_group: self.light_group,
            polarization: self.polarization.map(|of| of.rounded()),
        }
    }
}

impl RoundToF32 for EmittedPolarization {
    fn rounded(&self) -> Self {
        match self {
            Self::Stokes { stokes, axis } => Self::Stokes {
                stokes: stokes.map(|component| component.rounded()),
                axis: axis.rounded(),
            },
            Self::Sky { sun, most } => Self::Sky {
                sun: sun.rounded(),
                most: most.rounded(),
            },
        }
    }
}
