//! Illuminants: CIE tables by name, daylight and black bodies by temperature.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::illuminant_error::IlluminantError;
use super::observer::observer_1931;
use super::table::{Table, TableError, embedded};
use super::{DataSet, radiators};
use crate::{OutOfRange, Spectrum, Tabulated};
use document::suggestion::nearest;

/// The wavelengths of the 1 nm rule: 380, 381 … 780 nm.
fn rule_1nm() -> impl Iterator<Item = f64> {
    (380..=780).map(f64::from)
}

/// ∫ S ȳ dλ over 380 to 780 nm by the 1 nm rule.
fn luminance(spectrum: &Spectrum) -> Result<f64, OutOfRange> {
    let [_, y_bar, _] = observer_1931();
    rule_1nm()
        .map(|nm| Ok(spectrum.at(nm)? * y_bar.at(nm)?))
        .sum()
}

/// Scales a spectrum to the luminance of the equal-energy spectrum of value 1.
fn normalized(table: &Tabulated) -> Result<Spectrum, OutOfRange> {
    let own = luminance(&Spectrum::Table(table.clone()))?;
    let factor = luminance(&Spectrum::Constant(1.0))? / own;
    Ok(Spectrum::Table(table.scaled(factor)))
}

/// Normalizes a data set.
///
/// # Panics
/// When the table does not cover 380 to 780 nm. The built-in ones do, as the test that loads every set verifies.
fn normalized_set(set: DataSet<Tabulated>) -> DataSet<Spectrum> {
    let data = normalized(&set.data).unwrap_or_else(|gap| panic!("illuminant {}: {gap}", set.name));
    DataSet {
        name: set.name,
        citation: set.citation,
        data,
    }
}

/// Reads the illuminants of one data file.
fn read(table: &Table) -> Result<Vec<DataSet<Tabulated>>, TableError> {
    let citation = table.citation()?;
    let set = |name| {
        Ok(DataSet {
            name: Cow::Borrowed(name),
            citation: citation.clone(),
            data: table.series(name)?,
        })
    };
    table.series_names().into_iter().map(set).collect()
}

fn all() -> &'static BTreeMap<Cow<'static, str>, DataSet<Spectrum>> {
    static ALL: OnceLock<BTreeMap<Cow<'static, str>, DataSet<Spectrum>>> = OnceLock::new();
    macro_rules! table {
        ($file:literal) => {
            embedded($file, include_str!(concat!("../../data/", $file)), read)
        };
    }
    ALL.get_or_init(|| {
        let mut sets = table!("illuminants/standard.csv");
        sets.extend(table!("illuminants/fluorescent.csv"));
        sets.extend(table!("illuminants/led.csv"));
        sets.extend(table!("illuminants/discharge.csv"));
        let mut sets: Vec<_> = sets.into_iter().map(normalized_set).collect();
        sets.push(DataSet {
            name: Cow::Borrowed("E"),
            citation: "Equal-energy spectrum: CIE 015:2018, Colorimetry, 4th edition, DOI 10.25039/TR.015.2018."
                .to_owned(),
            data: Spectrum::Constant(1.0),
        });
        sets.into_iter().map(|set| (set.name.clone(), set)).collect()
    })
}

/// Returns an illuminant by name, in relative units, scaled to the luminance of the equal-energy spectrum of value 1:
/// ∫S ȳ dλ = ∫ȳ dλ over 380 to 780 nm (CIE 1931, 1 nm rule).
///
/// * `A`, `B`, `C`, `D50`, `D55`, `D65`, `D75`: linear between the points of their 5 nm tables, which is how the D series is
///   defined; 300 to 780 nm, B from 320 nm. `E` is the constant 1.
/// * `FL1` to `FL12` (also `F1` to `F12`), `HP1` to `HP5`: lamps with spectral lines, *defined* by sums over their 5 nm tables
///   ([`is_line_lamp`]). With linear interpolation, as here, their chromaticity y differs by about 2e-4 from the published
///   one, and a mercury line is as wide as the table's step. 380 to 780 nm.
/// * `LED-B1` to `LED-B5`, `LED-BH1`, `LED-RGB1`, `LED-V1`, `LED-V2`: also 5 nm tables, of smooth lamps; 380 to 780 nm.
/// * `D5700K`: CIE daylight of that correlated color temperature, 4000 to 25000 K; 300 to 830 nm. D65 itself is near 6504 K.
/// * `blackbody_3000K`: Planck's law with c₂ = 1.4388e-2 m K, 1000 to 100000 K; 300 to 830 nm.
///
/// # Errors
/// When the name is unknown, or the temperature is outside its range.
pub fn find_illuminant(name: &str) -> Result<DataSet<Spectrum>, IlluminantError> {
    if let Some(set) = all()
        .get(name)
        .or_else(|| all().get(full_name(name)?.as_str()))
    {
        return Ok(set.clone());
    }
    match radiators::by_temperature(name)? {
        Some(set) => Ok(normalized_set(set)),
        None => Err(IlluminantError::Unknown {
            name: name.chars().take(64).collect(),
            nearest: nearest(name, illuminant_names()).map(str::to_owned),
        }),
    }
}

/// Returns the full name in the tables for a short name such as `F11`.
fn full_name(short: &str) -> Option<String> {
    let number = short.strip_prefix('F')?;
    let is_number = number.starts_with(|c: char| c.is_ascii_digit());
    is_number.then(|| format!("FL{number}"))
}

/// Returns an illuminant by name as [`find_illuminant`] does, for callers that report errors themselves.
pub fn illuminant(name: &str) -> Option<DataSet<Spectrum>> {
    find_illuminant(name).ok()
}

/// The names of the tables that [`find_illuminant`] knows, sorted.
pub fn illuminant_names() -> Vec<&'static str> {
    all().keys().map(AsRef::as_ref).collect()
}

/// Whether this is a CIE illuminant with spectral lines, FL1 to FL12 or HP1 to HP5, which are defined by sums at 5 nm.
pub fn is_line_lamp(name: &str) -> bool {
    let name = full_name(name).unwrap_or_else(|| name.to_owned());
    (name.starts_with("FL") || name.starts_with("HP")) && all().contains_key(name.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// XYZ, scaled to Y = 100, by plain sums at 380, 380 + `step` … 780 nm.
    fn white_point(spectrum: &Spectrum, step: u32) -> [f64; 3] {
        let mut xyz = [0.0; 3];
        for nm in (380..=780).step_by(step as usize).map(f64::from) {
            for (sum, function) in xyz.iter_mut().zip(observer_1931()) {
                *sum += spectrum.at(nm).unwrap() * function.at(nm).unwrap();
            }
        }
        xyz.map(|value| 100.0 * value / xyz[1])
    }

    /// X and Z at Y = 100, from plain double-precision sums over the same published tables,
    /// computed independently (numpy).
    const WHITE_POINTS: [(&str, u32, f64, f64); 17] = [
        ("A", 5, 109.848_993_121, 35.582_473_632_4),
        ("A", 1, 109.847_886_503, 35.587_346_062_6),
        ("C", 5, 98.071_714_216, 118.224_892_313),
        ("C", 1, 98.059_413_975_3, 118.163_796_804),
        ("D50", 5, 96.419_686_124_9, 82.512_259_200_4),
        ("D50", 1, 96.421_468_222_7, 82.501_706_935_5),
        ("D55", 5, 95.679_089_933_4, 92.136_745_658_6),
        ("D55", 1, 95.680_007_103_1, 92.123_102_684_8),
        ("D65", 5, 95.042_966_940_2, 108.880_054_703),
        ("D65", 1, 95.042_281_762_9, 108.861_009_241),
        ("D75", 5, 94.967_384_935_6, 122.614_030_164),
        ("D75", 1, 94.965_315_426_3, 122.590_218_187),
        ("E", 5, 100.000_923_755, 100.000_993_944),
        ("E", 1, 99.998_745_068_8, 99.990_319_865_3),
        ("FL2", 5, 99.185_758_445_2, 67.393_784_195_5),
        ("FL11", 5, 100.961_005_324, 64.350_584_665_1),
        ("LED-B3", 5, 100.893_451_334, 67.715_259_229_9),
    ];

    #[test]
    fn white_points_equal_an_independent_computation() {
        for (name, step, x, z) in WHITE_POINTS {
            let xyz = white_point(&illuminant(name).unwrap().data, step);
            // The expected values have 12 digits.
            assert!(
                (xyz[0] - x).abs() < 1e-9,
                "{name} {step} nm: X {} {x}",
                xyz[0]
            );
            assert!(
                (xyz[2] - z).abs() < 1e-9,
                "{name} {step} nm: Z {} {z}",
                xyz[2]
            );
        }
    }

    #[test]
    fn chromaticities_are_those_that_the_cie_publishes() {
        // CIE 015:2018; the rule is the sum at 5 nm.
        let published = [
            ("A", 0.44758, 0.40745),
            ("C", 0.31006, 0.31616),
            ("D50", 0.34567, 0.35851),
            ("D65", 0.31272, 0.32903),
            ("FL11", 0.38054, 0.37692),
        ];
        for (name, x, y) in published {
            let xyz = white_point(&illuminant(name).unwrap().data, 5);
            let sum: f64 = xyz.iter().sum();
            assert!((xyz[0] / sum - x).abs() < 1e-5, "{name}: {}", xyz[0] / sum);
            assert!((xyz[1] / sum - y).abs() < 1e-5, "{name}: {}", xyz[1] / sum);
        }
    }

    #[test]
    fn every_illuminant_has_the_luminance_of_equal_energy() {
        let expected = luminance(&Spectrum::Constant(1.0)).unwrap();
        for name in illuminant_names() {
            let found = luminance(&illuminant(name).unwrap().data).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-14, "{name}: {found}");
        }
    }

    #[test]
    fn illuminant_a_follows_its_formula() {
        // CIE 015:2018, equation (1): S = 100 (560/λ)⁵ (exp(c/560) − 1)/(exp(c/λ) − 1), c = 1.435e7/2848 nm.
        let c = 1.435e7 / 2848.0;
        let formula = |nm: f64| {
            100.0 * (560.0 / nm).powi(5) * (f64::exp(c / 560.0) - 1.0) / (f64::exp(c / nm) - 1.0)
        };
        let a = illuminant("A").unwrap().data;
        let scale = a.at(560.0).unwrap() / formula(560.0);
        for nm in (380..=780).step_by(5).map(f64::from) {
            let ratio = a.at(nm).unwrap() / (scale * formula(nm));
            // The table has six digits.
            assert!((ratio - 1.0).abs() < 6e-6, "{nm} nm: {ratio}");
        }
    }

    #[test]
    fn a_name_that_nothing_has_brings_a_suggestion() {
        let said = |name| find_illuminant(name).unwrap_err().to_string();
        assert!(
            said("d65").contains("did you mean \"D65\""),
            "{}",
            said("d65")
        );
        for strange in ["tungsten bulb", "halogen", "sun", "X", ""].map(said) {
            assert!(
                !strange.contains("did you mean") && strange.contains("FL1 to FL12"),
                "{strange}"
            );
        }
        assert!(
            said("D3999K").contains("4000 to 25000 K"),
            "{}",
            said("D3999K")
        );
        assert!(
            said("blackbody_1e9K").contains("no illuminant"),
            "{}",
            said("blackbody_1e9K")
        );
    }

    #[test]
    fn lamps_with_lines_are_reported_by_either_name() {
        assert_eq!(illuminant("F11"), illuminant("FL11"));
        assert!(is_line_lamp("F11") && is_line_lamp("FL1") && is_line_lamp("HP5"));
        assert!(!is_line_lamp("F13") && !is_line_lamp("LED-B3") && !is_line_lamp("D65"));
        assert_eq!(illuminant("F"), None);
    }
}
