//! The light that a stack is looked at in, and the observer who looks.

use spectra::IlluminantError;

/// An illuminant with the CIE 1931 2° observer, as weights for sums at 380, 381 … 780 nm.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    name: String,
    weights: Vec<[f64; 3]>,
    white: [f64; 3],
}

impl Light {
    /// A CIE illuminant by its name: `D65`, `A`, `C`, `FL11`.
    ///
    /// # Errors
    /// When there is none of that name.
    pub fn named(name: &str) -> Result<Self, IlluminantError> {
        let set = spectra::find_illuminant(name)?;
        let observer = spectra::observer_1931();
        let at = |nm| {
            let power = set.data.at(nm).unwrap_or(0.0);
            observer
                .each_ref()
                .map(|curve| power * curve.clamped_at(nm))
        };
        let mut weights: Vec<[f64; 3]> = Self::wavelengths_nm().into_iter().map(at).collect();
        let luminance: f64 = weights.iter().map(|w| w[1]).sum();
        for weight in &mut weights {
            *weight = weight.map(|w| w / luminance);
        }
        Ok(Self {
            name: set.name.into_owned(),
            white: sum(weights.iter().copied()),
            weights,
        })
    }

    /// The illuminant's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where the sums are taken: 380, 381 … 780 nm.
    pub fn wavelengths_nm() -> Vec<f64> {
        (380..=780).map(f64::from).collect()
    }

    /// XYZ of the light itself, Y = 1.
    pub fn white(&self) -> [f64; 3] {
        self.white
    }

    /// XYZ = Σ R S (x̄, ȳ, z̄) / Σ S ȳ of a share R of the light at each of [`Self::wavelengths_nm`]: Y = 1 for a perfect mirror
    /// (CIE 015:2018, section 7.1, at 1 nm from 380 to 780 nm).
    pub fn xyz(&self, shares: impl IntoIterator<Item = f64>) -> [f64; 3] {
        sum(shares
            .into_iter()
            .zip(&self.weights)
            .map(|(share, weight)| weight.map(|w| share * w)))
    }
}

fn sum(terms: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    terms.fold([0.0; 3], |sum, term| {
        std::array::from_fn(|i| sum[i] + term[i])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_mirror_is_the_white() {
        for name in spectra::illuminant_names() {
            let light = Light::named(name).unwrap();
            let mirror = light.xyz(vec![1.0; 401]);
            assert_eq!(mirror, light.white());
            assert!((mirror[1] - 1.0).abs() < 1e-14);
        }
    }
}
