//! A free film by two beams (Suzuki, Yokoi and Toriwaki, section 4-2).

use crate::Polarised;
use std::f64::consts::{PI, TAU};

/// The path difference l between the two beams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathDifference {
    /// l = 2 n d cos θ₂.
    Optical,
    /// l = 2 d cos θ₂, as printed.
    AsPrinted,
}

/// Powers of a film by two beams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBeam {
    /// With two beams.
    pub reflectance: Polarised,
    /// Without interference.
    pub transmittance: Polarised,
}

/// Reflectance and transmittance by two beams of a film of real index in air.
pub fn two_beam(
    index: f64,
    thickness_nm: f64,
    wavelength_nm: f64,
    cos_incident: f64,
    path_difference: PathDifference,
) -> TwoBeam {
    let sine2 = (1.0 - cos_incident) * (1.0 + cos_incident);
    let cosine = (1.0 - sine2 / (index * index)).sqrt();
    let path = match path_difference {
        PathDifference::Optical => 2.0 * index * thickness_nm * cosine,
        PathDifference::AsPrinted => 2.0 * thickness_nm * cosine,
    };
    let phase = TAU * path / wavelength_nm - PI;
    let powers = |r: f64| {
        let through = 1.0 - r * r;
        let second = through * r;
        let reflected = r * r + second * second + 2.0 * r * second * phase.cos();
        (reflected, through * through)
    };
    let s = powers((cos_incident - index * cosine) / (cos_incident + index * cosine));
    let p = powers((index * cos_incident - cosine) / (index * cos_incident + cosine));
    TwoBeam {
        reflectance: Polarised { s: s.0, p: p.0 },
        transmittance: Polarised { s: s.1, p: p.1 },
    }
}
