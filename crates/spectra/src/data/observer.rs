//! The CIE 1931 2° standard observer.

use std::sync::OnceLock;

use super::table::embedded;
use crate::Tabulated;

/// The CIE 1931 2° colour-matching functions x̄, ȳ, z̄ at 1 nm, 360 to 830 nm.
///
/// Source: CIE (2019), DOI 10.25039/CIE.DS.xvudnb9b.
pub fn observer_1931() -> &'static [Tabulated; 3] {
    static OBSERVER: OnceLock<[Tabulated; 3]> = OnceLock::new();
    OBSERVER.get_or_init(|| {
        embedded(
            "observers/cie1931_2deg.csv",
            include_str!("../../data/observers/cie1931_2deg.csv"),
            |table| {
                Ok([
                    table.series("x_bar")?,
                    table.series("y_bar")?,
                    table.series("z_bar")?,
                ])
            },
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_complete_and_peaks_where_it_should() {
        for function in observer_1931() {
            assert_eq!(function.points().len(), 471);
            assert_eq!(function.range_nm(), (360.0, 830.0));
            assert!(function.points().all(|(_, value)| value >= 0.0));
        }
        // ȳ is V(λ): 1 at 555 nm, the anchor of the lumen (CIE 018:2019).
        assert_eq!(observer_1931()[1].at(555.0), Ok(1.0));
    }

    #[test]
    fn the_three_functions_have_nearly_equal_sums() {
        // The functions are normalised so that equal energy is white: X = Y = Z.
        // The rounding of the table leaves 3e-4.
        let sums = observer_1931()
            .each_ref()
            .map(|function| function.points().map(|(_, value)| value).sum::<f64>());
        for sum in sums {
            assert!((sum / sums[1] - 1.0).abs() < 4e-4, "{sums:?}");
        }
    }
}
