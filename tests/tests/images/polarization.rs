//! Pictures of polarized light with known Stokes vectors: Fresnel's amplitudes, Malus' law, an ellipsometer, energy, and reciprocity.

mod bench;
mod ellipsometer;
mod emission;
mod energy;
mod mirrors;
mod oracle;
mod rough;
mod shadow_rays;
mod sky;
