//! The index of a mixture of two media whose grains are far smaller than the wavelength.

use crate::{OpticalConstants, Spectrum, Tabulated, TabulatedError};
use num_complex::Complex64;
use thiserror::Error;

/// A rule for the index of a mixture. ε = (n + ik)² is the permittivity, f the share of the volume that medium b fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MixtureRule {
    /// Grains of both media side by side, neither being the ground of the other: see [`bruggeman`].
    Bruggeman,
    /// Spheres of medium b in a ground of medium a: see [`maxwell_garnett`].
    MaxwellGarnett,
}

impl MixtureRule {
    /// The index of the mixture.
    pub fn index(self, a: Complex64, b: Complex64, fraction: f64) -> Complex64 {
        match self {
            Self::Bruggeman => bruggeman(a, b, fraction),
            Self::MaxwellGarnett => maxwell_garnett(a, b, fraction),
        }
    }
}

/// The index of a mixture by Bruggeman's rule, from the indices n + ik of its media: n > 0 and k ≥ 0 of either.
///
/// The permittivity ε solves f (ε_b − ε)/(ε_b + 2ε) + (1 − f)(ε_a − ε)/(ε_a + 2ε) = 0. With x = ε/(N_a N_b), N the
/// indices, that is 2x² − βx − 1 = 0 with β = (3f − 1) N_b/N_a + (2 − 3f) N_a/N_b. The product of the roots is −½, so one
/// of them has Re x > 0. It is the physical one: the phase of ε then lies between those of ε_a and ε_b, and k ≥ 0.
///
/// Source: D. A. G. Bruggeman, Ann. Phys. 416, 636 (1935), DOI 10.1002/andp.19354160705. Domain: 0 ≤ f ≤ 1, spherical
/// grains much smaller than the wavelength.
pub fn bruggeman(a: Complex64, b: Complex64, fraction: f64) -> Complex64 {
    let f = fraction;
    let beta = (b / a) * (3.0 * f - 1.0) + (a / b) * (2.0 - 3.0 * f);
    let root = (beta * beta + 8.0).sqrt();
    // The larger root loses no digits; the other follows from the product.
    let plus = (beta + root) / 4.0;
    let minus = (beta - root) / 4.0;
    let larger = if plus.norm_sqr() >= minus.norm_sqr() {
        plus
    } else {
        minus
    };
    let x = if larger.re > 0.0 {
        larger
    } else {
        -0.5 / larger
    };
    absorbing(x * a * b)
}

/// The index of spheres of index `inclusion` in a medium of index `host`, of which they fill the share `fraction`.
///
/// (ε − ε_h)/(ε + 2ε_h) = f (ε_i − ε_h)/(ε_i + 2ε_h), so ε = ε_h (ε_i(1 + 2f) + 2ε_h(1 − f)) / (ε_i(1 − f) + ε_h(2 + f)).
///
/// Source: J. C. Maxwell Garnett, Phil. Trans. R. Soc. A 203, 385 (1904), DOI 10.1098/rsta.1904.0024. Domain: small f, where
/// the spheres do not see each other; both ends are exact nevertheless.
pub fn maxwell_garnett(host: Complex64, inclusion: Complex64, fraction: f64) -> Complex64 {
    let f = fraction;
    let (h, i) = (host * host, inclusion * inclusion);
    let above = i * (1.0 + 2.0 * f) + h * (2.0 * (1.0 - f));
    let below = i * (1.0 - f) + h * (2.0 + f);
    absorbing(h * (above / below))
}

/// The index of a passive medium from its permittivity: a k that rounding has put below 0 is 0.
fn absorbing(permittivity: Complex64) -> Complex64 {
    let index = permittivity.sqrt();
    Complex64::new(index.re, index.im.max(0.0))
}

/// Why two media have no mixture.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MixtureError {
    /// They have no wavelengths in common.
    #[error(
        "the media have no wavelength in common: one covers {} to {} nm, the other {} to {} nm",
        .first.0, .first.1, .second.0, .second.1
    )]
    Apart {
        /// Where the first has an index, nm.
        first: (f64, f64),
        /// Where the second has an index, nm.
        second: (f64, f64),
    },
    /// A formula gives no index at a wavelength within its range.
    #[error("one of the media has no index at {nm} nm")]
    NoIndex {
        /// The wavelength.
        nm: f64,
    },
    /// The rule gives no number.
    #[error("the mixture has no index: {0}")]
    Table(#[from] TabulatedError),
}

impl OpticalConstants {
    /// The mixture of two media, `fraction` of it (0 to 1) being the second, where both have an index.
    ///
    /// It is constant if they are. Otherwise it is a table at every point of theirs and at steps of 1 nm (10 nm beyond
    /// 2.5 µm); at those points it is exact.
    ///
    /// # Errors
    /// When the media have no wavelength in common.
    pub fn mixture(
        rule: MixtureRule,
        [a, b]: [&Self; 2],
        fraction: f64,
    ) -> Result<Self, MixtureError> {
        let parts = [&a.n, &a.k, &b.n, &b.k];
        let Some(knots) = knots(&parts, common_range(a, b)?) else {
            let at = |constants: &Self| {
                constants
                    .at(0.0)
                    .map_err(|e| MixtureError::NoIndex { nm: e.nm })
            };
            let index = rule.index(at(a)?, at(b)?, fraction);
            return Ok(Self {
                n: Spectrum::Constant(index.re),
                k: Spectrum::Constant(index.im),
            });
        };
        let (mut n, mut k) = (Vec::new(), Vec::new());
        for nm in knots {
            let at = |constants: &Self| constants.at(nm).map_err(|_| MixtureError::NoIndex { nm });
            let index = rule.index(at(a)?, at(b)?, fraction);
            n.push((nm, index.re));
            k.push((nm, index.im));
        }
        let is_clamped = a.range_nm().is_none() && b.range_nm().is_none();
        let [n, k] = [Tabulated::new(n)?, Tabulated::new(k)?].map(Spectrum::Table);
        let kept = |spectrum: Spectrum| {
            if is_clamped {
                spectrum.clamped()
            } else {
                spectrum
            }
        };
        Ok(Self {
            n: kept(n),
            k: kept(k),
        })
    }
}

/// Where both have an index; `None` is everywhere.
fn common_range(
    a: &OpticalConstants,
    b: &OpticalConstants,
) -> Result<Option<(f64, f64)>, MixtureError> {
    let (Some(first), Some(second)) = (a.range_nm(), b.range_nm()) else {
        return Ok(a.range_nm().or(b.range_nm()));
    };
    let (low, high) = (first.0.max(second.0), first.1.min(second.1));
    if low > high {
        return Err(MixtureError::Apart { first, second });
    }
    Ok(Some((low, high)))
}

/// The wavelengths of a mixture's table: those of the tables that it comes from and regular ones between. `None` if
/// all is constant.
fn knots(parts: &[&Spectrum], range: Option<(f64, f64)>) -> Option<Vec<f64>> {
    let extents = || parts.iter().filter_map(|part| part.extent_nm());
    // Tables that keep their end values have all that they say between their ends.
    let hull = || {
        let low = extents().map(|extent| extent.0).reduce(f64::min)?;
        Some((low, extents().map(|extent| extent.1).reduce(f64::max)?))
    };
    let (low, high) = range.or_else(hull)?;
    let fine = (1..2500).map(f64::from);
    let coarse = (250..3000).map(|tens| 10.0 * f64::from(tens));
    let own = parts.iter().flat_map(|part| part.points_nm());
    let mut knots: Vec<f64> = fine.chain(coarse).chain(own).chain([low, high]).collect();
    knots.retain(|&nm| low <= nm && nm <= high);
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    Some(knots)
}
