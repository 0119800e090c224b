//! Optical constants of materials.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::DataSet;
use super::table::{Table, TableError, embedded};
use crate::{BandGrid, OpticalConstants, Spectrum, Tabulated};

/// A material's name and its file.
macro_rules! material {
    ($name:literal) => {
        (
            $name,
            include_str!(concat!("../../data/materials/", $name, ".csv")),
        )
    };
}

const FILES: [(&str, &str); 13] = [
    material!("aluminium"),
    material!("bk7"),
    material!("chromium"),
    material!("copper"),
    material!("gold"),
    material!("iron"),
    material!("nickel"),
    material!("silica"),
    material!("silicon"),
    material!("silver"),
    material!("titanium"),
    material!("tungsten"),
    material!("water"),
];

/// How a Sellmeier formula's second coefficient enters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Resonance {
    /// As a wavelength in µm, which is squared.
    Um,
    /// As the square of a wavelength, µm².
    Um2,
}

/// Index by Sellmeier's formula, n² − 1 = Σ bᵢ λ² / (λ² − cᵢ) (or cᵢ² in place of cᵢ), λ in µm.
fn sellmeier(terms: &[(f64, f64)], resonance: Resonance, nm: f64) -> f64 {
    let um2 = (nm * 1e-3).powi(2);
    let sum: f64 = terms
        .iter()
        .map(|&(b, c)| match resonance {
            Resonance::Um => b * um2 / (um2 - c * c),
            Resonance::Um2 => b * um2 / (um2 - c),
        })
        .sum();
    (1.0 + sum).sqrt()
}

/// A Sellmeier formula evaluated at every nanometre that a band grid may touch.
///
/// Linear reading between the points is within 2e-7 of the formula.
fn sellmeier_table(terms: &[(f64, f64)], resonance: Resonance) -> Result<Tabulated, TableError> {
    let (first, last) = BandGrid::LIMITS_NM;
    let points = (first as u32..=last as u32)
        .map(f64::from)
        .map(|nm| (nm, sellmeier(terms, resonance, nm)))
        .collect();
    Tabulated::new(points).map_err(|source| TableError::Points {
        column: "b",
        source,
    })
}

/// n from its table or formula; k from its table, or 0 where the source has none.
fn read(table: &Table) -> Result<OpticalConstants, TableError> {
    let n = if let Ok(terms) = table.pairs("b", "c_um2") {
        sellmeier_table(&terms, Resonance::Um2)?
    } else if let Ok(terms) = table.pairs("b", "c_um") {
        sellmeier_table(&terms, Resonance::Um)?
    } else {
        table.series("n")?
    };
    let k = match table.series("k") {
        Ok(k) => Spectrum::Table(k),
        Err(TableError::MissingColumns(_)) => Spectrum::Constant(0.0),
        Err(other) => return Err(other),
    };
    Ok(OpticalConstants {
        n: Spectrum::Table(n),
        k,
    })
}

fn all() -> &'static BTreeMap<&'static str, DataSet<OpticalConstants>> {
    static ALL: OnceLock<BTreeMap<&'static str, DataSet<OpticalConstants>>> = OnceLock::new();
    ALL.get_or_init(|| {
        let set = |(name, text)| {
            let (citation, data) = embedded(name, text, |t| Ok((t.citation()?, read(t)?)));
            (
                name,
                DataSet {
                    name,
                    citation,
                    data,
                },
            )
        };
        FILES.into_iter().map(set).collect()
    })
}

/// Optical constants by name (`"gold"`, `"water"`).
///
/// | name | data set | |
/// | --- | --- | --- |
/// | `gold`, `silver`, `copper` | Johnson and Christy (1972) | table |
/// | `titanium`, `chromium`, `iron`, `nickel` | Johnson and Christy (1974) | table |
/// | `aluminium` | Rakić (1995) | table |
/// | `tungsten` | Weaver, Olson and Lynch (1975) | table |
/// | `silicon` | Green (2008) | table |
/// | `silica` | Malitson (1965), fused silica | Sellmeier, k = 0 |
/// | `bk7` | SCHOTT, N-BK7 | Sellmeier, k from a table |
/// | `water` | Daimon and Masumura (2007), 20 °C | Sellmeier, k = 0 |
///
/// Tables are linear between their points, n and k each on its own, and cover at least 360 to 830 nm.
/// The choice of set moves a metal's colour by more than any numerics: name it beside a result.
pub fn optical_constants(name: &str) -> Option<DataSet<OpticalConstants>> {
    all().get(name).cloned()
}

/// Names that [`optical_constants`] knows, sorted.
pub fn material_names() -> Vec<&'static str> {
    all().keys().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn index(name: &str, nm: f64) -> (f64, f64) {
        let data = optical_constants(name).unwrap().data;
        (data.n.at(nm).unwrap(), data.k.at(nm).unwrap())
    }

    #[test]
    fn every_material_covers_what_a_band_grid_may_touch() {
        for name in material_names() {
            for nm in 360..=830 {
                let (n, k) = index(name, f64::from(nm));
                assert!(n > 0.0 && k >= 0.0, "{name} at {nm} nm: {n} + {k}i");
            }
        }
    }

    #[test]
    fn formulas_give_the_published_indices() {
        // Water at 20 °C and the sodium D line: Daimon and Masumura (2007).
        assert!((index("water", 589.3).0 - 1.33335).abs() < 1e-5);
        // Fused silica at the d line, 587.5618 nm: Malitson (1965), table 1 (1.45846).
        assert!((index("silica", 587.5618).0 - 1.45846).abs() < 1e-5);
        // N-BK7: n_d = 1.51680, n_F = 1.52238, n_C = 1.51432 (SCHOTT data sheet 517642.251).
        assert!((index("bk7", 587.5618).0 - 1.51680).abs() < 1e-5);
        assert!((index("bk7", 486.1327).0 - 1.52238).abs() < 1e-5);
        assert!((index("bk7", 656.2725).0 - 1.51432).abs() < 1e-5);
    }

    #[test]
    fn linear_reading_between_nanometres_follows_the_formula() {
        let water = [
            (5.684_027_565e-1, 5.101_829_712e-3),
            (1.726_177_391e-1, 1.821_153_936e-2),
            (2.086_189_578e-2, 2.620_722_293e-2),
            (1.130_748_688e-1, 1.069_792_721e1),
        ];
        for i in 0..470 {
            let nm = 360.5 + f64::from(i);
            let exact = sellmeier(&water, Resonance::Um2, nm);
            assert!((index("water", nm).0 - exact).abs() < 2e-7, "{nm} nm");
        }
    }

    #[test]
    fn gold_is_the_published_table() {
        // Johnson and Christy (1972), table I: 0.43 + 2.455i at 2.26 eV, which is 548.6 nm.
        assert_eq!(index("gold", 548.6), (0.43, 2.455));
        let (n, k) = index("gold", 550.0);
        assert!(
            (n - 0.4237).abs() < 5e-4 && (k - 2.4721).abs() < 5e-4,
            "{n} {k}"
        );
    }
}
