//! The light that a stack is looked at in, and the observer who looks.

use colorimetry::tristimulus::{Rule, Weights, WeightsError};
use spectra::{IlluminantError, Observer, Spectrum};

/// An illuminant with an observer, as weights for sums over wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    name: String,
    weights: Weights,
}

impl Light {
    /// An illuminant by its name (`D65`, `A`, `FL11`, `D5700K`) with the CIE 1931 2° observer; sums are taken at 1 nm, but at 5 nm for
    /// the CIE's lamps with lines, which that defines.
    ///
    /// # Errors
    /// When there is none of that name.
    ///
    /// # Panics
    /// Never: every illuminant by name covers 380 to 780 nm and shines, which a test proves.
    pub fn named(name: &str) -> Result<Self, IlluminantError> {
        let set = spectra::find_illuminant(name)?;
        let rule = Rule::for_illuminant(&set.name);
        let light = Self::new(&set.name, &set.data, Observer::Cie1931Deg2, rule);
        Ok(light.unwrap_or_else(|error| panic!("illuminant {name}: {error}")))
    }

    /// Any light.
    ///
    /// # Errors
    /// When it has no value somewhere from 380 to 780 nm, or no luminance.
    pub fn new(
        name: &str,
        spectrum: &Spectrum,
        observer: Observer,
        rule: Rule,
    ) -> Result<Self, WeightsError> {
        Ok(Self {
            name: name.to_owned(),
            weights: Weights::new(spectrum, observer, rule)?,
        })
    }

    /// The illuminant's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where the sums are taken, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        self.weights.rule().wavelengths_nm().collect()
    }

    /// How far apart they are, nm.
    pub fn step_nm(&self) -> f64 {
        self.weights.rule().step_nm()
    }

    /// What a share of the light at each of them adds to XYZ.
    pub fn per_wavelength(&self) -> &[[f64; 3]] {
        self.weights.per_wavelength()
    }

    /// XYZ of the light itself, Y = 1.
    pub fn white(&self) -> [f64; 3] {
        self.weights.white()
    }

    /// XYZ of a share of the light at each of [`Self::wavelengths_nm`]: Y = 1 for a perfect mirror.
    pub fn xyz(&self, shares: impl IntoIterator<Item = f64>) -> [f64; 3] {
        self.weights.xyz(shares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_mirror_is_the_white() {
        for name in spectra::illuminant_names() {
            let light = Light::named(name).unwrap();
            let mirror = light.xyz(vec![1.0; light.wavelengths_nm().len()]);
            assert_eq!(mirror, light.white());
            assert!((mirror[1] - 1.0).abs() < 1e-14);
        }
    }
}
