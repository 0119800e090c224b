//! The effective index of a mixture of two media with grains much smaller than the wavelength.

use crate::fault::Faults;
use crate::{Fault, OpticalConstants, Spectrum, Tabulated, TabulatedError};
use num_complex::Complex64;
use thiserror::Error;

/// A mixing rule for the effective index. ε = (n + ik)² is the permittivity, f the volume fraction of medium b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MixtureRule {
    /// Grains of both media side by side, neither of them the host: see [`bruggeman`].
    Bruggeman,
    /// Spheres of medium b in a host of medium a: see [`maxwell_garnett`].
    MaxwellGarnett,
}

impl MixtureRule {
    /// Returns the effective index of the mixture.
    pub fn index(self, a: Complex64, b: Complex64, fraction: f64) -> Complex64 {
        match self {
            Self::Bruggeman => bruggeman(a, b, fraction),
            Self::MaxwellGarnett => maxwell_garnett(a, b, fraction),
        }
    }
}

/// Returns the effective index of a mixture by Bruggeman's rule, from the indices n + ik of its media, each with n > 0 and k ≥ 0.
///
/// The permittivity ε solves f (ε_b − ε)/(ε_b + 2ε) + (1 − f)(ε_a − ε)/(ε_a + 2ε) = 0. With x = ε/(N_a N_b), where
/// N are the indices, this is 2x² − βx − 1 = 0 with β = (3f − 1) N_b/N_a + (2 − 3f) N_a/N_b. The product of the roots is −½,
/// so one of them has Re x > 0. This root is the physical one: the phase of ε lies between those of ε_a and ε_b, and k ≥ 0.
///
/// Source: D. A. G. Bruggeman, Ann. Phys. 416, 636 (1935), DOI 10.1002/andp.19354160705. Domain: 0 ≤ f ≤ 1, spherical
/// grains much smaller than the wavelength.
pub fn bruggeman(a: Complex64, b: Complex64, fraction: f64) -> Complex64 {
    let f = fraction;
    let beta = (b / a) * (3.0 * f - 1.0) + (a / b) * (2.0 - 3.0 * f);
    let root = (beta * beta + 8.0).sqrt();
    // The larger root is free of cancellation; the other follows from the product.
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

/// Returns the effective index of spheres of index `inclusion` in a medium of index `host`; the spheres fill the volume fraction
/// `fraction`.
///
/// (ε − ε_h)/(ε + 2ε_h) = f (ε_i − ε_h)/(ε_i + 2ε_h), so ε = ε_h (ε_i(1 + 2f) + 2ε_h(1 − f)) / (ε_i(1 − f) + ε_h(2 + f)).
///
/// Source: J. C. Maxwell Garnett, Phil. Trans. R. Soc. A 203, 385 (1904), DOI 10.1098/rsta.1904.0024. Domain: small f, where
/// the spheres do not interact; f = 0 and f = 1 are exact nevertheless.
pub fn maxwell_garnett(host: Complex64, inclusion: Complex64, fraction: f64) -> Complex64 {
    let f = fraction;
    let (h, i) = (host * host, inclusion * inclusion);
    let above = i * (1.0 + 2.0 * f) + h * (2.0 * (1.0 - f));
    let below = i * (1.0 - f) + h * (2.0 + f);
    absorbing(h * (above / below))
}

/// Returns the index of a passive medium from its permittivity; a k that rounding made negative becomes 0.
fn absorbing(permittivity: Complex64) -> Complex64 {
    let index = permittivity.sqrt();
    Complex64::new(index.re, index.im.max(0.0))
}

/// Why a mixture of two media cannot be computed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MixtureError {
    /// The media have no wavelengths in common.
    #[error(
        "the media have no wavelength in common: one covers {} to {} nm, the other {} to {} nm",
        .first.0, .first.1, .second.0, .second.1
    )]
    Apart {
        /// Range of the first medium, nm.
        first: (f64, f64),
        /// Range of the second medium, nm.
        second: (f64, f64),
    },
    /// A formula gives no index at a wavelength within its range.
    #[error("one of the media has no index at {nm} nm")]
    NoIndex {
        /// The wavelength, nm.
        nm: f64,
    },
    /// The rule does not give finite numbers.
    #[error("the mixture has no index: {0}")]
    Table(#[from] TabulatedError),
}

impl OpticalConstants {
    /// Returns the mixture of two media, with the volume fraction `fraction` (0 to 1) of the second, where both have an index.
    ///
    /// If both media are constant, so is the mixture. Otherwise it is a table at all of their points and at steps of 1 nm
    /// (10 nm beyond 2.5 µm); it is exact at those points. Where the data of either medium are unusable, it has no value.
    ///
    /// # Errors
    /// When the media have no wavelength in common, one has no index at a wavelength, or the rule gives no finite numbers.
    pub fn mixture(
        rule: MixtureRule,
        [a, b]: [&Self; 2],
        fraction: f64,
    ) -> Result<Self, MixtureError> {
        let parts = [&a.n, &a.k, &b.n, &b.k];
        let faults = faults(&parts);
        let Some(knots) = knots(&parts, &faults, common_range(a, b)?) else {
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
        let sound = |table: Tabulated| table.with_faults(faults.iter().cloned().collect());
        let [n, k] = [Tabulated::new(n)?, Tabulated::new(k)?].map(sound);
        let [n, k] = [n, k].map(Spectrum::Table);
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

/// Returns the range where both media have an index; `None` means everywhere.
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

fn faults(parts: &[&Spectrum]) -> Faults {
    let all = parts.iter().filter_map(|part| part.faults());
    Faults::new(all.flat_map(Faults::iter).cloned().collect())
}

/// Returns the wavelengths of a mixture's table: those of the tables of its media and regular ones between them, except those
/// in a fault. `None` if all parts are constant.
fn knots(parts: &[&Spectrum], faults: &Faults, range: Option<(f64, f64)>) -> Option<Vec<f64>> {
    let extents = || parts.iter().filter_map(|part| part.extent_nm());
    // Clamped tables vary only between their ends.
    let hull = || {
        let low = extents().map(|extent| extent.0).reduce(f64::min)?;
        Some((low, extents().map(|extent| extent.1).reduce(f64::max)?))
    };
    let (low, high) = range.or_else(hull)?;
    let fine = (1..2500).map(f64::from);
    let coarse = (250..3000).map(|tens| 10.0 * f64::from(tens));
    let own = parts.iter().flat_map(|part| part.points_nm());
    let ends_of = |fault: &Fault| [fault.from_nm, fault.to_nm];
    let sound_ends = faults.iter().flat_map(ends_of);
    let regular = fine.chain(coarse).chain([low, high]);
    let mut knots: Vec<f64> = regular.chain(own).chain(sound_ends).collect();
    knots.retain(|&nm| low <= nm && nm <= high && faults.at(nm).is_none());
    knots.sort_by(f64::total_cmp);
    knots.dedup();
    Some(knots)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optical_constants;

    const VOID: Complex64 = Complex64::new(1.0, 0.0);
    const GLASS: Complex64 = Complex64::new(1.5, 0.0);
    const SILVER: Complex64 = Complex64::new(0.05, 3.2);
    const IRON: Complex64 = Complex64::new(2.9, 3.1);
    const MEDIA: [Complex64; 5] = [VOID, GLASS, SILVER, IRON, Complex64::new(4.1, 0.03)];
    const RULES: [MixtureRule; 2] = [MixtureRule::Bruggeman, MixtureRule::MaxwellGarnett];

    fn near(found: Complex64, expected: Complex64, tolerance: f64) -> bool {
        (found - expected).norm() <= tolerance * expected.norm()
    }

    /// Checks every pair of different media at every whole percent.
    fn each(check: impl Fn(Complex64, Complex64, f64)) {
        for a in MEDIA {
            for b in MEDIA.into_iter().filter(|&b| b != a) {
                for percent in 0..=100 {
                    check(a, b, f64::from(percent) / 100.0);
                }
            }
        }
    }

    #[test]
    fn without_the_other_medium_a_mixture_is_the_one() {
        for rule in RULES {
            each(|a, b, _| {
                assert!(near(rule.index(a, b, 0.0), a, 1e-13), "{rule:?} {a} {b}");
                assert!(near(rule.index(a, b, 1.0), b, 1e-13), "{rule:?} {a} {b}");
            });
            for f in [0.0, 0.3, 1.0] {
                assert!(near(rule.index(SILVER, SILVER, f), SILVER, 1e-14));
            }
        }
    }

    #[test]
    fn bruggeman_solves_its_own_equation_and_is_passive() {
        each(|a, b, f| {
            let index = bruggeman(a, b, f);
            let (e, ea, eb) = (index * index, a * a, b * b);
            let residual = (eb - e) / (eb + e * 2.0) * f + (ea - e) / (ea + e * 2.0) * (1.0 - f);
            assert!(residual.norm() < 1e-12, "{a} {b} {f}: {residual}");
            assert!(index.re > 0.0 && index.im >= 0.0, "{a} {b} {f}: {index}");
            let swapped = bruggeman(b, a, 1.0 - f);
            assert!(near(swapped, index, 1e-12), "{a} {b} {f}: {swapped}");
        });
    }

    #[test]
    fn the_phase_of_a_mixture_lies_between_those_of_its_media() {
        for rule in RULES {
            each(|a, b, f| {
                let phase = rule.index(a, b, f).arg();
                let (low, high) = (a.arg().min(b.arg()), a.arg().max(b.arg()));
                let inside = low - 1e-12 <= phase && phase <= high + 1e-12;
                assert!(inside, "{rule:?} {a} {b} {f}: {phase}");
            });
        }
    }

    #[test]
    fn bruggeman_in_closed_form() {
        // ε = 1 and 4 in equal parts: 2ε² − 2.5ε − 4 = 0 halved, ε = (2.5 + √(2.5² + 32)) / 4.
        let index = bruggeman(VOID, Complex64::from(2.0), 0.5);
        let expected = Complex64::from(((2.5 + 38.25_f64.sqrt()) / 4.0).sqrt());
        assert!(near(index, expected, 1e-15), "{index}");
        // Below the percolation threshold of 1/3, a perfect conductor in a void has ε = 1/(1 − 3f): Bruggeman (1935).
        let conductor = Complex64::new(1e7, 1e7);
        for f in [0.01, 0.1, 0.2, 0.3] {
            let expected = Complex64::from((1.0_f64 / (1.0 - 3.0 * f)).sqrt());
            assert!(near(bruggeman(VOID, conductor, f), expected, 1e-10), "{f}");
        }
        // Above the threshold, the mixture conducts: ε → ε_b (3f − 1)/2.
        let expected = conductor * ((3.0 * 0.5 - 1.0) / 2.0_f64).sqrt();
        assert!(near(bruggeman(VOID, conductor, 0.5), expected, 1e-10));
    }

    #[test]
    fn maxwell_garnett_in_closed_form() {
        // ε = 1 and 4 in equal parts: (4·2 + 2·1·½) / (4·½ + 1·2½) = 9 / 4.5 = 2.
        let index = maxwell_garnett(VOID, Complex64::from(2.0), 0.5);
        assert!(
            near(index, Complex64::from(2.0_f64.sqrt()), 1e-15),
            "{index}"
        );
        // The relation in Maxwell Garnett (1904), with Clausius–Mossotti factors on both sides.
        each(|a, b, f| {
            let (e, h, i) = (maxwell_garnett(a, b, f).powu(2), a * a, b * b);
            let left = (e - h) / (e + h * 2.0);
            let right = (i - h) / (i + h * 2.0) * f;
            let scale = right.norm().max(1.0);
            assert!((left - right).norm() < 1e-10 * scale, "{a} {b} {f}");
        });
        // For spheres of a perfect conductor, ε = ε_h (1 + 2f)/(1 − f).
        let conductor = Complex64::new(1e7, 1e7);
        let expected = GLASS * (1.4_f64 / 0.8).sqrt();
        assert!(near(
            maxwell_garnett(GLASS, conductor, 0.2),
            expected,
            1e-10
        ));
    }

    #[test]
    fn the_rules_differ_and_maxwell_garnett_knows_host_from_inclusion() {
        assert!((bruggeman(VOID, SILVER, 0.3) - maxwell_garnett(VOID, SILVER, 0.3)).norm() > 0.1);
        let swapped = maxwell_garnett(SILVER, VOID, 0.7);
        assert!((maxwell_garnett(VOID, SILVER, 0.3) - swapped).norm() > 0.1);
    }

    fn material(name: &str) -> OpticalConstants {
        optical_constants(name).unwrap().data
    }

    #[test]
    fn a_mixture_of_materials_is_the_rule_at_every_wavelength_of_both() {
        let (water, gold) = (material("water"), material("gold"));
        let mixed =
            OpticalConstants::mixture(MixtureRule::Bruggeman, [&water, &gold], 0.25).unwrap();
        // Gold from 261.6 nm (Johnson and Christy), water to 1129 nm (Daimon and Masumura).
        assert_eq!(mixed.range_nm(), Some((gold.range_nm().unwrap().0, 1129.0)));
        for tenths in 3000..8000 {
            let nm = f64::from(tenths) / 10.0;
            let expected = bruggeman(water.at(nm).unwrap(), gold.at(nm).unwrap(), 0.25);
            let tolerance = if tenths % 10 == 0 { 1e-14 } else { 2e-5 };
            assert!(near(mixed.at(nm).unwrap(), expected, tolerance), "{nm}");
        }
        for nm in [548.6, 381.5] {
            let expected = bruggeman(water.at(nm).unwrap(), gold.at(nm).unwrap(), 0.25);
            assert!(near(mixed.at(nm).unwrap(), expected, 1e-14), "{nm}");
        }
    }

    #[test]
    fn constants_stay_constant_and_clamped_tables_unbounded() {
        let constant = |n: f64| OpticalConstants {
            n: Spectrum::Constant(n),
            k: Spectrum::Constant(0.0),
        };
        let rule = MixtureRule::Bruggeman;
        let mixed = OpticalConstants::mixture(rule, [&constant(1.0), &constant(2.0)], 0.5).unwrap();
        let expected = bruggeman(VOID, Complex64::from(2.0), 0.5).re;
        assert_eq!(mixed.n, Spectrum::Constant(expected));

        let gold = material("gold");
        let clamped = OpticalConstants {
            n: gold.n.clone().clamped(),
            k: gold.k.clone().clamped(),
        };
        let mixed = OpticalConstants::mixture(rule, [&constant(1.0), &clamped], 0.5).unwrap();
        assert_eq!(mixed.range_nm(), None);
        assert_eq!(mixed.at(1.0), mixed.at(gold.range_nm().unwrap().0));
    }

    #[test]
    fn media_without_a_common_wavelength_have_no_mixture() {
        let table = |nm: f64| OpticalConstants {
            n: Spectrum::Table(Tabulated::new(vec![(nm, 1.5), (nm + 50.0, 1.5)]).unwrap()),
            k: Spectrum::Constant(0.0),
        };
        let mixed =
            OpticalConstants::mixture(MixtureRule::Bruggeman, [&table(400.0), &table(500.0)], 0.5);
        let said = mixed.unwrap_err().to_string();
        assert!(
            said.contains("400 to 450 nm") && said.contains("500 to 550 nm"),
            "{said}"
        );
    }
}
