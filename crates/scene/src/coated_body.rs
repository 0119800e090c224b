//! A diffuse body below a clear coat, in a validated scene.

use crate::rounding::RoundToF32;
use crate::{FacetTable, Microsurface, Pattern, SpectrumId};
use glam::DVec3;

/// A diffuse body below a coat without absorption: the coat's reflection plus f = (1 − E(θᵢ)) (1 − E(θₒ)) P / π with P = ρ / (n² − ρ (n² −
/// 1 + Ē)) for the light that enters the coat; see `optics::coated_albedo_factor`.
#[derive(Clone, Debug, PartialEq)]
pub struct CoatedBody {
    /// Real part of the coat's index.
    pub n: SpectrumId,
    /// Imaginary part of the coat's index: 0 everywhere.
    pub k: SpectrumId,
    /// The coat's facets; `None` if it is smooth.
    pub microsurface: Option<Microsurface>,
    /// ρ: the body's reflectance.
    pub base: Pattern,
    /// Ē: the coat's reflectance for diffuse light from outside.
    pub mean_reflectance: SpectrumId,
    /// E of a rough coat: the first of [`Self::COSINES`] spectra, for cosines whose square roots are equally spaced from 0 to 1,
    /// interpolated linearly in the root. For a brushed coat it is roughly the mean over azimuth. `None` if the coat is smooth, so that E
    /// is the Fresnel reflectance.
    pub reflectances: Option<SpectrumId>,
    /// Ratio of a brushed coat's transmittance in a direction to the mean: 1 − E is this times the 1 − E of [`Self::reflectances`]. `None`
    /// if E depends only on the cosine.
    pub transmittance_scale: Option<FacetTable>,
    /// Estimates that steer sampling: an index of the coat, and a reflectance of the body.
    pub estimate: CoatEstimate,
}

impl CoatedBody {
    /// Number of cosines at which the reflectance of a rough coat is tabulated: they are close near grazing, where it changes fast.
    pub const COSINES: usize = 32;

    /// The value of [`Self::transmittance_scale`] in a direction; 1 if there is no table.
    pub fn transmittance_scale_at(&self, direction: DVec3) -> f64 {
        let table = self.transmittance_scale.as_ref();
        table.map_or(1.0, |table| table.at(direction.to_array()))
    }
}

/// Numbers that represent the spectra of a coated body when a path chooses between its lobes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatEstimate {
    /// The coat's index.
    pub n: f64,
    /// The body's reflectance.
    pub base: f64,
}

impl RoundToF32 for CoatedBody {
    fn rounded(&self) -> Self {
        Self {
            n: self.n,
            k: self.k,
            microsurface: self.microsurface.as_ref().map(RoundToF32::rounded),
            base: self.base.rounded(),
            mean_reflectance: self.mean_reflectance,
            reflectances: self.reflectances,
            transmittance_scale: self.transmittance_scale.as_ref().map(RoundToF32::rounded),
            estimate: CoatEstimate {
                n: self.estimate.n.rounded(),
                base: self.estimate.base.rounded(),
            },
        }
    }
}
