//! A diffuse body below a clear coat, in a validated scene.

use crate::prepared::coats;
use crate::{FacetTable, Microsurface, Pattern, SpectrumId};
use glam::DVec3;

/// A diffuse body below a coat without absorption: what the coat reflects, and
/// f = (1 − E(θᵢ)) (1 − E(θₒ)) P / π with P = ρ / (n² − ρ (n² − 1 + Ē)) of what enters it; see `optics::coated_albedo_factor`.
#[derive(Clone, Debug, PartialEq)]
pub struct CoatedBody {
    /// Real part of the coat's index.
    pub n: SpectrumId,
    /// Imaginary part of the coat's index: 0 everywhere.
    pub k: SpectrumId,
    /// The coat's facets; none where it is smooth.
    pub microsurface: Option<Microsurface>,
    /// ρ: what the body reflects.
    pub base: Pattern,
    /// Ē: the coat's reflectance of diffuse light from outside.
    pub mean_reflectance: SpectrumId,
    /// E of a rough coat: the first of [`Self::COSINES`] spectra, for cosines that are even in their roots from 0 to 1 and with straight
    /// lines between. None where the coat is smooth, and E Fresnel's reflectance. Of a brushed coat about its mean about the normal.
    pub reflectances: Option<SpectrumId>,
    /// By how much more a brushed coat lets through in a direction: 1 − E is this times what [`Self::reflectances`] leave. None where all
    /// directions of the same cosine are alike.
    pub transmittance_scale: Option<FacetTable>,
    /// What steers which way paths go: an index of the coat, and a reflectance of the body.
    pub estimate: CoatEstimate,
}

impl CoatedBody {
    /// Number of cosines for which a rough coat has its reflectance.
    pub const COSINES: usize = coats::COSINES;

    /// See [`Self::transmittance_scale`]; 1 where there is none.
    pub fn transmittance_scale_at(&self, direction: DVec3) -> f64 {
        let table = self.transmittance_scale.as_ref();
        table.map_or(1.0, |table| table.at(direction.to_array()))
    }
}

/// Numbers that stand for the spectra of a coated body where a path chooses its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatEstimate {
    /// The coat's index.
    pub n: f64,
    /// The body's reflectance.
    pub base: f64,
}
