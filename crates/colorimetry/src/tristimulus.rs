//! From spectra to XYZ: sums over wavelength.
//!
//! A reflectance R under a light S has XYZ = k Σ R S (x̄, ȳ, z̄) with k = 1 / Σ S ȳ, so that the perfect reflector has Y = 1
//! (CIE 015:2018, section 7.1, from 380 to 780 nm in place of 360 to 830 nm).

use std::fmt;
use std::str::FromStr;

use spectra::{KM_LUMENS_PER_WATT, Observer, OutOfRange, Spectrum};
use thiserror::Error;

/// Where sums over wavelength are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rule {
    /// At 380, 385 … 780 nm: the rule that defines the CIE's lamps with lines.
    FiveNm,
    /// At 380, 381 … 780 nm, the light linear between the points of its table.
    #[default]
    OneNm,
}

/// A name that no rule has.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("there is no rule {0:?}; known are 5nm and 1nm")]
pub struct UnknownRule(String);

impl Rule {
    /// Both.
    pub const ALL: [Self; 2] = [Self::FiveNm, Self::OneNm];

    /// The rule for a light by its name: 5 nm for lamps with lines, which their 5 nm tables define, else 1 nm.
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

    /// Δλ, nm.
    pub fn step_nm(self) -> f64 {
        match self {
            Self::FiveNm => 5.0,
            Self::OneNm => 1.0,
        }
    }

    /// The wavelengths, rising, nm.
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

/// A light and an observer as weights, so that reflectances become XYZ in one sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    rule: Rule,
    weights: Vec<[f64; 3]>,
    white: [f64; 3],
}

/// Why a light gives no weights.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum WeightsError {
    /// It has no value at some of the wavelengths.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The observer sees nothing of it.
    #[error("the light has no luminance")]
    Dark,
}

impl Weights {
    /// S (x̄, ȳ, z̄) / Σ S ȳ for a light S, in any unit.
    ///
    /// # Errors
    /// When the light has no value somewhere from 380 to 780 nm, or no luminance.
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
            weights,
        })
    }

    /// The rule of the sums.
    pub fn rule(&self) -> Rule {
        self.rule
    }

    /// The weight of each wavelength of the rule.
    pub fn weights(&self) -> &[[f64; 3]] {
        &self.weights
    }

    /// XYZ of the light itself and of the perfect reflector, Y = 1.
    pub fn white(&self) -> [f64; 3] {
        self.white
    }

    /// XYZ of a share of the light at each of the rule's wavelengths: Y = 1 where all of them are 1.
    pub fn xyz(&self, shares: impl IntoIterator<Item = f64>) -> [f64; 3] {
        let terms = shares.into_iter().zip(&self.weights);
        sum(terms.map(|(share, weight)| weight.map(|w| share * w)))
    }

    /// XYZ of a reflectance or transmittance, Y = 1 for that of 1.
    ///
    /// # Errors
    /// When it has no value somewhere from 380 to 780 nm.
    pub fn xyz_of(&self, reflectance: &Spectrum) -> Result<[f64; 3], OutOfRange> {
        let shares: Result<Vec<f64>, _> = self
            .rule
            .wavelengths_nm()
            .map(|nm| reflectance.at(nm))
            .collect();
        Ok(self.xyz(shares?))
    }
}

/// XYZ of an emission: Kₘ Σ L (x̄, ȳ, z̄) Δλ, in cd/m² for a radiance in W m⁻² sr⁻¹ nm⁻¹ (CIE 015:2018, section 7.1, note 3).
///
/// # Errors
/// When it has no value somewhere from 380 to 780 nm.
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
