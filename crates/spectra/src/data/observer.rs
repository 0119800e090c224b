//! The CIE observers.

use std::fmt;
use std::str::FromStr;
use std::sync::OnceLock;

use thiserror::Error;

use super::table::{Table, TableError, embedded};
use crate::Tabulated;

/// A CIE observer: a set of color-matching functions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Observer {
    /// CIE 1931, fields of 2° (CIE 2019, DOI 10.25039/CIE.DS.xvudnb9b).
    #[default]
    Cie1931Deg2,
    /// CIE 1964, fields of 10° (CIE 2019, DOI 10.25039/CIE.DS.sqksu2n5).
    Cie1964Deg10,
    /// Based on the cone fundamentals for 2° (CIE 170-2:2015).
    Cie2015Deg2,
    /// Based on the cone fundamentals for 10° (CIE 170-2:2015).
    Cie2015Deg10,
}

/// The name is not that of an observer.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "there is no observer {0:?}; known names: 1931_2, 1964_10, 2015_2 and 2015_10 (year and degrees)"
)]
pub struct UnknownObserver(String);

impl Observer {
    /// All observers.
    pub const ALL: [Self; 4] = [
        Self::Cie1931Deg2,
        Self::Cie1964Deg10,
        Self::Cie2015Deg2,
        Self::Cie2015Deg10,
    ];

    /// The name, which consists of year and degrees: `1931_2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cie1931Deg2 => "1931_2",
            Self::Cie1964Deg10 => "1964_10",
            Self::Cie2015Deg2 => "2015_2",
            Self::Cie2015Deg10 => "2015_10",
        }
    }

    /// The color-matching functions x̄, ȳ, z̄ at 1 nm: those of 1931 and 1964 from 360 nm, those of 2015 from 390 nm, to 830 nm.
    /// Outside the table the functions are 0: see [`Self::at`].
    pub fn functions(self) -> &'static [Tabulated; 3] {
        macro_rules! table {
            ($file:literal) => {{
                static TABLE: OnceLock<[Tabulated; 3]> = OnceLock::new();
                TABLE.get_or_init(|| {
                    embedded($file, include_str!(concat!("../../data/", $file)), read)
                })
            }};
        }
        match self {
            Self::Cie1931Deg2 => table!("observers/cie1931_2deg.csv"),
            Self::Cie1964Deg10 => table!("observers/cie1964_10deg.csv"),
            Self::Cie2015Deg2 => table!("observers/cie2015_2deg.csv"),
            Self::Cie2015Deg10 => table!("observers/cie2015_10deg.csv"),
        }
    }

    /// Returns x̄, ȳ, z̄ at a wavelength, linear between the table's points; 0 outside the table, where they are negligible.
    pub fn at(self, nm: f64) -> [f64; 3] {
        let functions = self.functions().each_ref();
        functions.map(|function| function.at(nm).unwrap_or(0.0))
    }
}

impl fmt::Display for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Observer {
    type Err = UnknownObserver;

    fn from_str(name: &str) -> Result<Self, UnknownObserver> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known.ok_or_else(|| UnknownObserver(name.chars().take(40).collect()))
    }
}

fn read(table: &Table) -> Result<[Tabulated; 3], TableError> {
    Ok([
        table.series("x_bar")?,
        table.series("y_bar")?,
        table.series("z_bar")?,
    ])
}

/// The CIE 1931 2° color-matching functions x̄, ȳ, z̄ at 1 nm, 360 to 830 nm.
///
/// Source: CIE (2019), DOI 10.25039/CIE.DS.xvudnb9b.
pub fn observer_1931() -> &'static [Tabulated; 3] {
    Observer::Cie1931Deg2.functions()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_complete_and_peak_where_they_should() {
        for observer in Observer::ALL {
            let from = match observer {
                Observer::Cie1931Deg2 | Observer::Cie1964Deg10 => 360.0,
                Observer::Cie2015Deg2 | Observer::Cie2015Deg10 => 390.0,
            };
            for function in observer.functions() {
                assert_eq!(function.points().len(), 831 - from as usize, "{observer}");
                assert_eq!(function.range_nm(), (from, 830.0), "{observer}");
                assert!(function.points().all(|(_, value)| value >= 0.0));
            }
        }
        // ȳ is V(λ): 1 at 555 nm, the anchor of the lumen (CIE 018:2019).
        assert_eq!(observer_1931()[1].at(555.0), Ok(1.0));
        assert_eq!(Observer::Cie1931Deg2.at(555.0)[1], 1.0);
        assert_eq!(Observer::Cie2015Deg2.at(380.0), [0.0; 3]);
    }

    #[test]
    fn the_three_functions_have_nearly_equal_sums() {
        // The functions are normalized so that equal energy gives X = Y = Z.
        // Rounding in the tables leaves 3e-4.
        for observer in Observer::ALL {
            let sums = observer
                .functions()
                .each_ref()
                .map(|function| function.points().map(|(_, value)| value).sum::<f64>());
            for sum in sums {
                assert!((sum / sums[1] - 1.0).abs() < 4e-4, "{observer}: {sums:?}");
            }
        }
    }

    #[test]
    fn names_and_back() {
        for observer in Observer::ALL {
            assert_eq!(observer.name().parse(), Ok(observer));
        }
        let said = "1931".parse::<Observer>().unwrap_err().to_string();
        assert!(
            said.contains("1931_2") && said.contains("2015_10"),
            "{said}"
        );
    }
}
