//! What a stack does to light: R, T and A over wavelength at an angle.

use optics::{Complex64, Layer, Polarised, StackAmplitudes, ThicknessDerivative};
use thiserror::Error;

/// A stack at chosen wavelengths: numbers alone, without names or tables. Thicknesses and angles are given when it is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    wavelengths_nm: Vec<f64>,
    incident: Vec<f64>,
    /// For each layer an index per wavelength.
    layers: Vec<Vec<Complex64>>,
    substrate: Vec<Complex64>,
}

/// The shares of the power that a stack reflects and lets pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// Reflectance R.
    pub reflectance: Polarised,
    /// Transmittance T, into the substrate.
    pub transmittance: Polarised,
}

impl Powers {
    /// Absorptance A = 1 − R − T.
    pub fn absorptance(self) -> Polarised {
        Polarised {
            s: 1.0 - self.reflectance.s - self.transmittance.s,
            p: 1.0 - self.reflectance.p - self.transmittance.p,
        }
    }
}

impl From<StackAmplitudes> for Powers {
    fn from(found: StackAmplitudes) -> Self {
        Self {
            reflectance: found.reflectance,
            transmittance: found.transmittance,
        }
    }
}

/// An angle of incidence, from the normal, in the incident medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    deg: f64,
    cosine: f64,
}

/// An angle of incidence that there is not.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("an angle of {0}°; it must be at least 0° and less than 90°")]
pub struct AngleError(
    /// The angle in degrees.
    pub f64,
);

impl Angle {
    /// Along the normal.
    pub const NORMAL: Self = Self {
        deg: 0.0,
        cosine: 1.0,
    };

    /// An angle in degrees.
    ///
    /// # Errors
    /// Unless it is at least 0 and less than 90.
    pub fn from_degrees(deg: f64) -> Result<Self, AngleError> {
        // sin(90° − θ) keeps the digits near grazing that cos θ loses where θ in radians is rounded.
        let cosine = (90.0 - deg).to_radians().sin();
        let is_possible = (0.0..90.0).contains(&deg) && cosine > 0.0;
        is_possible
            .then_some(Self { deg, cosine })
            .ok_or(AngleError(deg))
    }

    /// In degrees.
    pub fn degrees(self) -> f64 {
        self.deg
    }

    /// Its cosine, in (0, 1].
    pub fn cosine(self) -> f64 {
        self.cosine
    }
}

impl Sampled {
    pub(crate) fn new(
        wavelengths_nm: Vec<f64>,
        incident: Vec<f64>,
        layers: Vec<Vec<Complex64>>,
        substrate: Vec<Complex64>,
    ) -> Self {
        Self {
            wavelengths_nm,
            incident,
            layers,
            substrate,
        }
    }

    /// The wavelengths, nm.
    pub fn wavelengths_nm(&self) -> &[f64] {
        &self.wavelengths_nm
    }

    /// The incident medium's real index at each wavelength.
    pub fn incident(&self) -> &[f64] {
        &self.incident
    }

    /// For each layer its index n + ik at each wavelength.
    pub fn layers(&self) -> &[Vec<Complex64>] {
        &self.layers
    }

    /// The substrate's index n + ik at each wavelength.
    pub fn substrate(&self) -> &[Complex64] {
        &self.substrate
    }

    /// R and T at each wavelength, with these thicknesses (nm, one per layer).
    ///
    /// # Panics
    /// When there is not one thickness per layer.
    pub fn powers(&self, thicknesses_nm: &[f64], angle: Angle) -> Vec<Powers> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            optics::stack(n0, layers, substrate, nm, angle.cosine()).into()
        })
    }

    /// At each wavelength the absorptance of each layer: R + T + ΣA = 1.
    ///
    /// # Panics
    /// When there is not one thickness per layer.
    pub fn absorptances(&self, thicknesses_nm: &[f64], angle: Angle) -> Vec<Vec<Polarised>> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            optics::absorptance(n0, layers, substrate, nm, angle.cosine())
        })
    }

    /// At each wavelength ∂R/∂d and ∂T/∂d of each layer, per nm.
    ///
    /// # Panics
    /// When there is not one thickness per layer.
    pub fn derivatives(
        &self,
        thicknesses_nm: &[f64],
        angle: Angle,
    ) -> Vec<Vec<ThicknessDerivative>> {
        self.each(thicknesses_nm, |n0, layers, substrate, nm| {
            optics::thickness_derivatives(n0, layers, substrate, nm, angle.cosine())
        })
    }

    /// Something of the stack at each wavelength: of the incident index, layers, substrate and wavelength.
    fn each<T>(
        &self,
        thicknesses_nm: &[f64],
        of: impl Fn(f64, &[Layer], Complex64, f64) -> T,
    ) -> Vec<T> {
        let (given, needed) = (thicknesses_nm.len(), self.layers.len());
        assert_eq!(given, needed, "one thickness per layer");
        let layer = |&thickness_nm: &f64| Layer {
            index: Complex64::ONE,
            thickness_nm,
        };
        let mut layers: Vec<Layer> = thicknesses_nm.iter().map(layer).collect();
        let at = |(w, &nm): (usize, &f64)| {
            for (layer, indices) in layers.iter_mut().zip(&self.layers) {
                layer.index = indices[w];
            }
            of(self.incident[w], &layers, self.substrate[w], nm)
        };
        self.wavelengths_nm.iter().enumerate().map(at).collect()
    }
}
