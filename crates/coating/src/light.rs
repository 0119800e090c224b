//! The illuminant under which a stack is seen, and the observer.

use colorimetry::tristimulus::{Rule, Weights, WeightsError};
use spectra::{IlluminantError, Observer, Spectrum};

/// An illuminant and an observer, as weights for sums over wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    name: String,
    weights: Weights,
}

impl Light {
    /// Returns the illuminant with a name (`D65`, `A`, `FL11`, `D5700K`), with the CIE 1931 2° observer. Sums are at 1 nm, except at
    /// 5 nm for the CIE's illuminants with lines, which are defined at that step.
    ///
    /// # Errors
    /// If there is no illuminant of that name.
    ///
    /// # Panics
    /// Never: every named illuminant covers 380 to 780 nm and has luminance, which a test proves.
    pub fn named(name: &str) -> Result<Self, IlluminantError> {
        let set = spectra::find_illuminant(name)?;
        let rule = Rule::for_illuminant(&set.name);
        let light = Self::new(&set.name, &set.data, Observer::Cie1931Deg2, rule);
        Ok(light.unwrap_or_else(|error| panic!("illuminant {name}: {error}")))
    }

    /// Makes a light from any illuminant and observer.
    ///
    /// # Errors
    /// If the illuminant lacks a value somewhere from 380 to 780 nm, or has no luminance.
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

    /// Wavelengths of the sums, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        self.weights.rule().wavelengths_nm().collect()
    }

    /// Step between these wavelengths, nm.
    pub fn step_nm(&self) -> f64 {
        self.weights.rule().step_nm()
    }

    /// Weight in XYZ of the reflectance or transmittance at each of these wavelengths.
    pub fn per_wavelength(&self) -> &[[f64; 3]] {
        self.weights.per_wavelength()
    }

    /// XYZ of the light itself, Y = 1.
    pub fn white(&self) -> [f64; 3] {
        self.weights.white()
    }

    /// Returns XYZ from the reflectance or transmittance at each of [`Self::wavelengths_nm`]: Y = 1 for a perfect mirror.
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
