//! Illuminants that a temperature defines: daylight and black bodies.

use std::sync::OnceLock;

use super::DataSet;
use super::illuminant_error::IlluminantError;
use super::table::{Table, TableError, embedded};
use crate::Tabulated;

/// Domain of the daylight model, K (CIE 015:2018, section 4.1.2).
const DAYLIGHT_K: (f64, f64) = (4000.0, 25_000.0);
/// Temperatures of black bodies that are accepted, K.
const BLACKBODY_K: (f64, f64) = (1000.0, 100_000.0);

/// Returns the illuminant that `D5700K` or `blackbody_3000K` names; `None` for a name of another form.
pub(super) fn by_temperature(name: &str) -> Result<Option<DataSet<Tabulated>>, IlluminantError> {
    let kelvin = |prefix| {
        let digits = name.strip_prefix(prefix)?.strip_suffix('K')?;
        let is_plain = digits.chars().all(|c| c.is_ascii_digit() || c == '.');
        digits.parse::<f64>().ok().filter(|_| is_plain)
    };
    let (what, range_k, light, temperature, citation): (_, _, fn(f64) -> _, _, _) = if let Some(
        temperature,
    ) =
        kelvin("D")
    {
        let citation = "CIE daylight of a correlated color temperature: CIE 015:2018, Colorimetry, 4th edition, section 4.1.2";
        ("daylight", DAYLIGHT_K, daylight, temperature, citation)
    } else if let Some(temperature) = kelvin("blackbody_") {
        let citation = "Planck's law with c2 = 1.4388e-2 m K: CIE 015:2018, Colorimetry, 4th edition, section 4.1.1";
        (
            "a black body",
            BLACKBODY_K,
            blackbody,
            temperature,
            citation,
        )
    } else {
        return Ok(None);
    };
    if !(range_k.0..=range_k.1).contains(&temperature) {
        return Err(IlluminantError::Temperature {
            name: name.chars().take(64).collect(),
            what,
            range_k,
        });
    }
    Ok(Some(DataSet {
        name: name.to_owned().into(),
        citation: format!("{citation}, DOI 10.25039/TR.015.2018."),
        data: light(temperature),
    }))
}

/// CIE daylight, S = S₀ + M₁ S₁ + M₂ S₂, 100 at 560 nm, of a correlated color temperature from 4000 to 25000 K, at 5 nm and linear
/// between the points (CIE 015:2018, equations 4.5 to 4.9; M₁ and M₂ are not rounded to three decimals, unlike in the CIE's
/// tables of D50 to D75).
fn daylight(kelvin: f64) -> Tabulated {
    let [x, y] = daylight_xy(kelvin);
    let below = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / below;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / below;
    let [s0, s1, s2] = components();
    let points = s0.points().zip(s1.points()).zip(s2.points());
    tabulated(points.map(|(((nm, s0), (_, s1)), (_, s2))| (nm, s0 + m1 * s1 + m2 * s2)))
}

/// Chromaticity of daylight of a correlated color temperature (CIE 015:2018, equations 4.5 to 4.7).
fn daylight_xy(kelvin: f64) -> [f64; 2] {
    let x = if kelvin <= 7000.0 {
        -4.6070e9 / kelvin.powi(3) + 2.9678e6 / kelvin.powi(2) + 0.09911e3 / kelvin + 0.244_063
    } else {
        -2.0064e9 / kelvin.powi(3) + 1.9018e6 / kelvin.powi(2) + 0.24748e3 / kelvin + 0.237_040
    };
    [x, -3.000 * x * x + 2.870 * x - 0.275]
}

/// Returns the power of a black body at a wavelength, relative to 560 nm, by Planck's law: λ⁻⁵ / (exp(c₂/λT) − 1) with
/// c₂ = 1.4388e-2 m K (CIE 015:2018, section 4.1.1).
pub fn black_body(nm: f64, kelvin: f64) -> f64 {
    const C2_NM_K: f64 = 1.4388e7;
    let planck = |nm: f64| 1.0 / (nm.powi(5) * (C2_NM_K / (nm * kelvin)).exp_m1());
    planck(nm) / planck(560.0)
}

/// A black body at 1 nm from 300 to 830 nm.
fn blackbody(kelvin: f64) -> Tabulated {
    tabulated((300..=830).map(|nm| (f64::from(nm), black_body(f64::from(nm), kelvin))))
}

/// Makes a table from a formula.
///
/// # Panics
/// Never: the wavelengths rise, and the formulas are finite in their ranges.
fn tabulated(points: impl Iterator<Item = (f64, f64)>) -> Tabulated {
    Tabulated::new(points.collect())
        .unwrap_or_else(|error| panic!("an illuminant by formula: {error}"))
}

/// The components S₀, S₁ and S₂ of daylight.
pub(crate) fn components() -> &'static [Tabulated; 3] {
    fn read(table: &Table) -> Result<[Tabulated; 3], TableError> {
        Ok([
            table.series("S0")?,
            table.series("S1")?,
            table.series("S2")?,
        ])
    }
    static COMPONENTS: OnceLock<[Tabulated; 3]> = OnceLock::new();
    COMPONENTS.get_or_init(|| {
        let text = include_str!("../../data/illuminants/daylight_components.csv");
        embedded("illuminants/daylight_components.csv", text, read)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::illuminant;

    /// The CIE's tables are daylight of 5000, 5500, 6500 and 7500 K for an older c₂ of 1.4380e-2 m K.
    #[test]
    fn daylight_is_that_of_the_tables() {
        for (name, nominal) in [
            ("D50", 5000.0),
            ("D55", 5500.0),
            ("D65", 6500.0),
            ("D75", 7500.0),
        ] {
            let table = illuminant(name).unwrap().data;
            let found = daylight(nominal * 1.4388 / 1.4380);
            let scale = 100.0 / table.at(560.0).unwrap();
            for nm in (300..=780).step_by(5).map(f64::from) {
                let (found, expected) = (found.at(nm).unwrap(), scale * table.at(nm).unwrap());
                // The tables use M₁ and M₂ with three decimals: an error of 0.0005 (S₁ + S₂), where S is 100 at 560 nm.
                assert!(
                    (found - expected).abs() < 0.04,
                    "{name} {nm} nm: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn the_two_formulas_of_daylight_meet() {
        let [[x1, y1], [x2, y2]] = [7000.0, 7000.001].map(daylight_xy);
        // The CIE's coefficients have five to six digits.
        assert!(
            (x1 - x2).abs() < 1e-5 && (y1 - y2).abs() < 1e-5,
            "{x1} {x2}"
        );
    }

    /// Illuminant A is the black body of 2848 K for c₂ = 1.4350e-2 m K (CIE 015:2018, equation 4.1).
    #[test]
    fn a_black_body_is_illuminant_a() {
        let a = illuminant("A").unwrap().data;
        let found = blackbody(2848.0 * 1.4388 / 1.4350);
        let scale = a.at(560.0).unwrap();
        for nm in (300..=780).step_by(5).map(f64::from) {
            let ratio = found.at(nm).unwrap() * scale / a.at(nm).unwrap();
            // The table has six digits.
            assert!((ratio - 1.0).abs() < 6e-6, "{nm} nm: {ratio}");
        }
    }

    /// Wien's displacement law: the peak lies at 2.8978e-3 m K / T.
    #[test]
    fn hotter_bodies_peak_at_shorter_wavelengths() {
        for kelvin in [4000.0, 5800.0, 7000.0] {
            let table = blackbody(kelvin);
            let peak = table.points().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0;
            assert!(
                (peak - 2.8978e6 / kelvin).abs() <= 0.6,
                "{kelvin} K: {peak} nm"
            );
        }
    }

    #[test]
    fn names_say_temperatures() {
        let found = |name| by_temperature(name).map(|set| set.map(|set| set.name.into_owned()));
        assert_eq!(found("D5700K"), Ok(Some("D5700K".to_owned())));
        assert_eq!(found("D6504.5K"), Ok(Some("D6504.5K".to_owned())));
        for other in [
            "D65",
            "5700K",
            "D-1K",
            "D+5000K",
            "DinfK",
            "DnanK",
            "DK",
            "D5e3K",
            "blackbody_K",
            "blackbody_3000",
        ] {
            assert_eq!(found(other), Ok(None), "{other}");
        }
        for outside in [
            "D3999K",
            "D25001K",
            "blackbody_999K",
            "blackbody_0K",
            "blackbody_100001K",
        ] {
            assert!(found(outside).is_err(), "{outside}");
        }
        for edge in ["D4000K", "D25000K", "blackbody_1000K", "blackbody_100000K"] {
            assert!(
                illuminant(edge).unwrap().data.at(380.0).unwrap() > 0.0,
                "{edge}"
            );
        }
    }
}
