//! The optics of surfaces: pure functions of numbers, in `f64`.
//!
//! This crate knows nothing of scenes, files and devices. A designer of coatings can use it alone.
//!
//! | to compute | call |
//! | --- | --- |
//! | r, t, R and T of a stack of layers | [`stack`], [`film`] |
//! | how much each layer absorbs | [`absorptance`] |
//! | how R and T change with each thickness | [`thickness_derivatives`] |
//! | R and T of many stacks at many angles and wavelengths, fast | [`batch::evaluate`] |
//! | formulas for your own loop over wavelengths, in SIMD registers | [`wide`] |
//! | a film by the two beams of Suzuki, Yokoi and Toriwaki | [`two_beam`] |
//! | one boundary | [`fresnel`], [`reflectance_unpolarized`] |
//! | what becomes of polarized light | [`Mueller`]; fast, [`wide::PolarizedPowers`] |
//! | the model of Cook and Torrance as printed in 1981 and later | [`gaussian_d1`], [`beckmann_d2`], [`index_from_normal_reflectance`] |
//! | a diffuse body below a coat | [`hemispherical_reflectance`], [`coated_albedo_factor`] |
//! | rough surfaces | [`Microsurface`], [`multiple_color`] |
//!
//! What a coating reflects, transmits and absorbs at one angle and wavelength:
//!
//! ```
//! use pellicle_optics::{Complex64, Layer, absorptance, stack, thickness_derivatives};
//!
//! // An antireflection coating with a thin metal layer: silica on chromium on glass, at 550 nm and 30°.
//! let layers = [
//!     Layer { index: 1.46.into(), thickness_nm: 80.0 },
//!     Layer { index: Complex64::new(3.18, 3.33), thickness_nm: 10.0 },
//! ];
//! let (glass, cosine) = (1.52.into(), 30.0_f64.to_radians().cos());
//! let found = stack(1.0, &layers, glass, 550.0, cosine);
//! let absorbed = absorptance(1.0, &layers, glass, 550.0, cosine);
//! let (r, t) = (found.reflectance.s, found.transmittance.s);
//! assert!((r + t + absorbed[0].s + absorbed[1].s - 1.0).abs() < 1e-14);
//! assert_eq!(absorbed[0].s, 0.0); // silica absorbs nothing
//!
//! // One nanometer more of silica changes R by the derivative, to first order.
//! let slope = thickness_derivatives(1.0, &layers, glass, 550.0, cosine)[0];
//! let thicker = [Layer { thickness_nm: 81.0, ..layers[0] }, layers[1]];
//! let change = stack(1.0, &thicker, glass, 550.0, cosine).reflectance.s - r;
//! assert!((change - slope.reflectance.s).abs() < 0.05 * change.abs());
//! ```
//!
//! **Sign convention.** A complex index is n + ik and waves vary as exp(i(k·x − ωt)), so k ≥ 0
//! absorbs. Wavelengths are vacuum wavelengths. Thicknesses and wavelengths are in nanometers. A cosine belongs to
//! the angle between a ray and the normal, measured in the medium that contains the ray.
//!
//! s is the polarization whose electric field is perpendicular to the plane of incidence; the field of p
//! is in that plane. The sign of r_p is such that it equals −r_s at normal incidence. For every ray with direction d, p = d × s.
//! [`Mueller`] says what Stokes vectors are.

pub mod batch;
mod coat;
mod cook;
mod fresnel;
mod gaussian;
mod microfacet;
mod microsurface;
mod polarization;
mod stack;
mod two_beam;
pub mod wide;

use bytemuck::{Pod, Zeroable};
pub use coat::{coated_albedo_factor, hemispherical_reflectance};
pub use cook::{beckmann_d2, fresnel_by_g_and_c, index_from_normal_reflectance};
pub use fresnel::{Amplitudes, cos_refracted, fresnel, reflectance_unpolarized};
pub use gaussian::{
    gaussian_constant, gaussian_d1, gaussian_fraction, gaussian_pdf, sample_gaussian,
};
pub use microfacet::{beckmann_d, half_vector_pdf, sample_beckmann, v_groove_g};
pub use microsurface::{
    Distribution, MEAN_COSINES, Microsurface, mean_reflectance, multiple_color,
};
pub use num_complex::Complex64;
pub use polarization::Mueller;
pub use stack::{
    Layer, StackAmplitudes, ThicknessDerivative, absorptance, film, stack, thickness_derivatives,
};
pub use two_beam::{PathDifference, TwoBeam, two_beam};

/// A power for s- and for p-polarized light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Polarized {
    /// For s-polarized light.
    pub s: f64,
    /// For p-polarized light.
    pub p: f64,
}

impl Polarized {
    /// Returns the power for unpolarized light, the mean of both.
    pub fn unpolarized(self) -> f64 {
        0.5 * (self.s + self.p)
    }
}
