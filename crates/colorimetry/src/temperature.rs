//! Correlated color temperature.

use std::sync::OnceLock;

use spectra::{Observer, black_body};

use crate::chromaticity::uv_of_xyz;
use crate::tristimulus::Rule;

/// The correlated color temperature of a color and its distance from the Planckian locus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Temperature {
    /// Correlated color temperature: the temperature of the black body whose chromaticity is nearest in u, v of CIE 1960, K.
    pub kelvin: f64,
    /// Distance D_uv from this black body; positive above the Planckian locus, for colors that are greener.
    pub duv: f64,
}

/// The largest distance from the Planckian locus at which a color has a temperature (CIE 015:2018, section 9.5).
const FARTHEST: f64 = 0.05;
/// Range of the search in reciprocal temperature, 10⁶/K: 100000 K to 1000 K.
const MIRED: (f64, f64) = (10.0, 1000.0);

/// Returns the correlated color temperature of a chromaticity x, y for the CIE 1931 observer (CIE 015:2018, section 9.5); `None` if it
/// is farther than 0.05 from the Planckian locus or outside 1000 to 100000 K.
pub fn correlated_temperature(xy: [f64; 2]) -> Option<Temperature> {
    let [u, v] = uv_1960([xy[0], xy[1], 1.0 - xy[0] - xy[1]]);
    let distance = |mired: f64| {
        let [u0, v0] = planckian(mired);
        (u - u0).hypot(v - v0)
    };
    let nearest = |best: f64, mired: f64| {
        if distance(mired) < distance(best) {
            mired
        } else {
            best
        }
    };
    let steps = (0..=99).map(|i| MIRED.0 + 10.0 * f64::from(i));
    let coarse = steps.reduce(nearest)?;
    let mired = minimum(
        (coarse - 10.0).max(MIRED.0),
        (coarse + 10.0).min(MIRED.1),
        distance,
    );
    let is_end = mired - MIRED.0 < 1e-6 || MIRED.1 - mired < 1e-6;
    let duv = distance(mired).copysign(v - planckian(mired)[1]);
    (!is_end && duv.abs() <= FARTHEST).then_some(Temperature {
        kelvin: 1e6 / mired,
        duv,
    })
}

/// Returns u, v of CIE 1960: u′ and two thirds of v′.
fn uv_1960(xyz: [f64; 3]) -> [f64; 2] {
    let [u, v] = uv_of_xyz(xyz);
    [u, 2.0 * v / 3.0]
}

/// Returns u, v of the black body with a reciprocal temperature in mired.
fn planckian(mired: f64) -> [f64; 2] {
    static OBSERVER: OnceLock<Vec<(f64, [f64; 3])>> = OnceLock::new();
    let observer = OBSERVER.get_or_init(|| {
        let at = |nm| (nm, Observer::Cie1931Deg2.at(nm));
        Rule::OneNm.wavelengths_nm().map(at).collect()
    });
    let mut xyz = [0.0; 3];
    for &(nm, functions) in observer {
        let power = black_body(nm, 1e6 / mired);
        for (sum, function) in xyz.iter_mut().zip(functions) {
            *sum += power * function;
        }
    }
    uv_1960(xyz)
}

/// Finds the only minimum of a function between two numbers by golden-section search.
fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    while high - low > 1e-8 {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if f(left) < f(right) {
            high = right;
        } else {
            low = left;
        }
    }
    f64::midpoint(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chromaticity::xy_of_xyz;
    use crate::tristimulus::Weights;

    fn of_illuminant(name: &str) -> Temperature {
        let light = spectra::find_illuminant(name).unwrap().data;
        let weights = Weights::new(&light, Observer::Cie1931Deg2, Rule::OneNm).unwrap();
        correlated_temperature(xy_of_xyz(weights.white())).unwrap()
    }

    #[test]
    fn black_bodies_have_their_own_temperature() {
        for kelvin in [1500.0, 2856.0, 5000.0, 6500.0, 20_000.0] {
            let found = of_illuminant(&format!("blackbody_{kelvin}K"));
            assert!((found.kelvin / kelvin - 1.0).abs() < 1e-5, "{found:?}");
            assert!(found.duv.abs() < 1e-7, "{found:?}");
        }
    }

    /// CIE 015:2018, table T.1: A 2856 K, D50 5003 K, D65 6504 K, D75 7504 K; C 6774 K.
    #[test]
    fn illuminants_have_their_published_temperatures() {
        for (name, kelvin) in [
            ("A", 2856.0),
            ("D50", 5003.0),
            ("D65", 6504.0),
            ("D75", 7504.0),
            ("C", 6774.0),
        ] {
            let found = of_illuminant(name);
            // The published values are rounded to 1 K and computed from chromaticities with four or five digits.
            assert!((found.kelvin - kelvin).abs() < 4.0, "{name}: {found:?}");
        }
        // Daylight lies above the Planckian locus by 0.003.
        assert!((of_illuminant("D65").duv - 0.0032).abs() < 1e-4);
    }

    #[test]
    fn saturated_colors_have_none() {
        for xy in [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.7, 0.29]] {
            assert_eq!(correlated_temperature(xy), None, "{xy:?}");
        }
        assert_eq!(correlated_temperature([f64::NAN, f64::NAN]), None);
    }
}
