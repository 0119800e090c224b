//! What a surface does to light: functions of numbers, in `f64`.
//!
//! No scene, no file and no device is known here; someone who designs coatings can use this crate alone.
//!
//! **Sign convention.** A complex index is n + ik and waves vary as exp(i(k·x − ωt)), so k ≥ 0
//! absorbs. Wavelengths are vacuum wavelengths. Lengths of a film and wavelengths are both in nanometres. A cosine is
//! that of the angle between a ray and the normal, measured in the medium that the ray is in.
//!
//! s is the polarisation whose electric field is perpendicular to the plane of incidence, p the one
//! whose field lies in it.

pub mod batch;
mod fresnel;
mod microfacet;
mod stack;
mod two_beam;

use bytemuck::{Pod, Zeroable};
pub use fresnel::{Amplitudes, cos_refracted, fresnel, reflectance_unpolarised};
pub use microfacet::{
    beckmann_d, cook_torrance, half_vector_pdf, reflected_pdf, sample_beckmann, v_groove_g,
};
pub use num_complex::Complex64;
pub use stack::{
    Layer, StackAmplitudes, ThicknessDerivative, absorptance, film, stack, thickness_derivatives,
};
pub use two_beam::{PathDifference, TwoBeam, two_beam};

/// A power for s and for p polarised light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Polarised {
    /// For s polarised light.
    pub s: f64,
    /// For p polarised light.
    pub p: f64,
}

impl Polarised {
    /// For unpolarised light: the mean of both.
    pub fn unpolarised(self) -> f64 {
        0.5 * (self.s + self.p)
    }
}
