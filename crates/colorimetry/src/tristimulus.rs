//! XYZ from spectra, by sums over wavelength.
//!
//! A reflectance R under an illuminant S has XYZ = k Σ R S (x̄, ȳ, z̄) with k = 1 / Σ S ȳ, so that the perfect reflector has Y = 1
//! (CIE 015:2018, section 7.1, but from 380 to 780 nm instead of 360 to 830 nm).

use std::fmt;
use std::str::FromStr;

use spectra::{KM_LUMENS_PER_WATT, Observer, OutOfRange, Spectrum};
use thiserror::Error;

/// The wavelengths of the sums.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rule {
    /// At 380, 385 … 780 nm: the rule that defines the CIE illuminants with spectral lines.
    FiveNm,
    /// At 380, 381 … 780 nm, with the illuminant linear between the points of its table.
    #[default]
    OneNm,
}

/// The name is not that of a rule.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("there is no rule {0:?}; known names: 5nm and 1nm")]
pub struct UnknownRule(String);

impl Rule {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::FiveNm, Self::OneNm];

    /// Returns the rule for an illuminant by name: 5 nm for those with spectral lines, which are defined by 5 nm tables, else 1 nm.
    pub fn for_illuminant(name: &str) -> Self {
        if spectra::is_line_lamp(name) {
            Self::FiveNm
        } else {
            Self::OneNm
        }
    }

    /// The name: `5nm` or `1nm`.
    pub fn name(self) -> &'static str {
        match self {
            Self::FiveNm => "5nm",
            Self::OneNm => "1nm",
        }
    }

    /// The step Δλ, nm.
    pub fn step_nm(self) -> f64 {
        match self {
            Self::FiveNm => 5.0,
            Self::OneNm => 1.0,
        }
    }

    /// The wavelengths in rising order, nm.
    pub fn wavelengths_nm(self) -> impl Iterator<Item = f64> + Clone {
        (380..=780_u32)
            .step_by(self.step_nm() as usize)
            .map(f64::from)
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Rule {
    type Err = UnknownRule;

    fn from_str(name: &str) -> Result<Self, UnknownRule> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known.ok_or_else(|| UnknownRule(name.chars().take(40).collect()))
    }
}

/// Weights for an illuminant and an observer, which give XYZ of a reflectance in one sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    rule: Rule,
    per_wavelength: Vec<[f64; 3]>,
    white: [f64; 3],
}

/// Why an illuminant gives no weights.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum WeightsError {
    /// The illuminant has no value at some of the wavelengths.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The illuminant is not visible to the observer.
    #[error("the illuminant has no luminance")]
    Dark,
}

impl Weights {
    /// Computes the weights S (x̄, ȳ, z̄) / Σ S ȳ of an illuminant S in any unit.
    ///
    /// # Errors
    /// When the illuminant has no value somewhere from 380 to 780 nm, or no luminance.
    pub fn new(light: &Spectrum, observer: Observer, rule: Rule) -> Result<Self, WeightsError> {
        let weight = |nm| {
            let power = light.at(nm)?;
            Ok(observer.at(nm).map(|function| power * function))
        };
        let weights: Result<Vec<[f64; 3]>, OutOfRange> =
            rule.wavelengths_nm().map(weight).collect();
        let mut weights = weights?;
        let luminance = sum(weights.iter().copied())[1];
        if !(luminance > 0.0 && luminance.is_finite()) {
            return Err(WeightsError::Dark);
        }
        for weight in &mut weights {
            *weight = weight.map(|w| w / luminance);
        }
        Ok(Self {
            rule,
            white: sum(weights.iter().copied()),
            per_wavelength: weights,
        })
    }

    /// The rule of the sums.
    pub fn rule(&self) -> Rule {
        self.rule
    }

    /// The weight of each wavelength of the rule.
    pub fn per_wavelength(&self) -> &[[f64; 3]] {
        &self.per_wavelength
    }

    /// XYZ of the illuminant itself and of the perfect reflector, with Y = 1.
    pub fn white(&self) -> [f64; 3] {
        self.white
    }

    /// Returns XYZ for the fraction of the light at each wavelength of the rule; Y = 1 if all fractions are 1.
    pub fn xyz(&self, shares: impl IntoIterator<Item = f64>) -> [f64; 3] {
        let terms = shares.into_iter().zip(&self.per_wavelength);
        sum(terms.map(|(share, weight)| weight.map(|w| share * w)))
    }

    /// Returns XYZ of a reflectance or transmittance; Y = 1 for a constant 1.
    ///
    /// # Errors
    /// When the spectrum has no value somewhere from 380 to 780 nm.
    pub fn xyz_of(&self, reflectance: &Spectrum) -> Result<[f64; 3], OutOfRange> {
        let shares: Result<Vec<f64>, _> = self
            .rule
            .wavelengths_nm()
            .map(|nm| reflectance.at(nm))
            .collect();
        Ok(self.xyz(shares?))
    }
}

/// Returns XYZ of an emission: Kₘ Σ L (x̄, ȳ, z̄) Δλ, in cd/m² for a radiance in W m⁻² sr⁻¹ nm⁻¹ (CIE 015:2018, section 7.1, note 3).
///
/// # Errors
/// When the spectrum has no value somewhere from 380 to 780 nm.
pub fn xyz_of_emission(
    radiance: &Spectrum,
    observer: Observer,
    rule: Rule,
) -> Result<[f64; 3], OutOfRange> {
    let term = |nm| {
        let power = KM_LUMENS_PER_WATT * rule.step_nm() * radiance.at(nm)?;
        Ok(observer.at(nm).map(|function| power * function))
    };
    let terms: Result<Vec<[f64; 3]>, _> = rule.wavelengths_nm().map(term).collect();
    Ok(sum(terms?.into_iter()))
}

fn sum(terms: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    terms.fold([0.0; 3], |sum, term| {
        std::array::from_fn(|i| sum[i] + term[i])
    })
}
