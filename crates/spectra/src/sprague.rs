//! Interpolation of measured tables at coarse steps: T. B. Sprague's fifth-order interpolation (1880), which CIE 167:2005 recommends
//! for tables at equal steps.

use crate::Tabulated;

/// Steps of the tables that are interpolated, nm. At 5 nm and less, linear interpolation suffices.
const STEPS_NM: [f64; 2] = [10.0, 20.0];
/// The smallest number of points.
const MIN: usize = 6;

/// Weights of the first six values, times 209, that extrapolate one step ([`NEXT`]) and two steps ([`AFTER_NEXT`]) beyond an end
/// (CIE 167:2005, table 1; Westland, Ripamonti and Cheung, Computational Color Science, second edition, 2012, section 4.3).
const NEXT: [f64; 6] = [508.0, -540.0, 488.0, -367.0, 144.0, -24.0];
const AFTER_NEXT: [f64; 6] = [884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0];

/// Coefficients, times 24, of X⁰ … X⁵ within a step, for the values from two points before the step to two after it (same sources).
const POWERS: [[f64; 6]; 6] = [
    [0.0, 0.0, 24.0, 0.0, 0.0, 0.0],
    [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
    [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
    [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
    [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
    [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
];

/// Returns the table at every nm, clamped to `range`, and its original step in nm, if its points are 10 or 20 nm apart throughout;
/// `None` for other tables, which are linear between their points.
///
/// With this interpolation, colors of metals and films of some 100 nm from values every 10 nm are within ΔE₀₀ 0.03 of those from values
/// at every nm, and from values every 20 nm within 0.25; with linear interpolation, within 0.11 and 0.55
/// (`tests/tests/colors/coarse_tables.rs`).
pub fn sprague(table: &Tabulated, range: (f64, f64)) -> Option<(Tabulated, f64)> {
    let (first_nm, _) = table.range_nm();
    let values: Vec<f64> = table.points().map(|(_, value)| value).collect();
    let step_nm = STEPS_NM.into_iter().find(|step| {
        let on_grid = |(index, (nm, _)): (usize, (f64, f64))| {
            (nm - first_nm - index as f64 * step).abs() < 1e-6
        };
        table.points().enumerate().all(on_grid)
    })?;
    if values.len() < MIN {
        return None;
    }
    let longer = extended(&values);
    let parts = step_nm as usize;
    let mut points = Vec::with_capacity(parts * values.len());
    for (step, around) in longer.windows(6).enumerate() {
        for part in 0..parts {
            let nm = first_nm + step_nm * step as f64 + part as f64;
            let value = within(around, part as f64 / step_nm);
            points.push((nm, value.clamp(range.0, range.1)));
        }
    }
    let last = values.len() - 1;
    points.push((first_nm + step_nm * last as f64, values[last]));
    Some((Tabulated::new(points).ok()?, step_nm))
}

/// Returns the values with two extrapolated ones at either end.
fn extended(values: &[f64]) -> Vec<f64> {
    let from = |weights: [f64; 6], values: &mut dyn Iterator<Item = &f64>| -> f64 {
        let terms = weights.iter().zip(values).map(|(w, v)| w * v);
        terms.sum::<f64>() / 209.0
    };
    let mut longer = vec![
        from(AFTER_NEXT, &mut values.iter()),
        from(NEXT, &mut values.iter()),
    ];
    longer.extend_from_slice(values);
    longer.push(from(NEXT, &mut values.iter().rev()));
    longer.push(from(AFTER_NEXT, &mut values.iter().rev()));
    longer
}

/// Returns the value at the fraction `along` of a step after the third of six points.
fn within(around: &[f64], along: f64) -> f64 {
    let coefficient = |weights: &[f64; 6]| {
        let terms = weights.iter().zip(around).map(|(w, v)| w * v);
        terms.sum::<f64>() / 24.0
    };
    let powers = POWERS.iter().rev();
    powers.fold(0.0, |sum, weights| sum * along + coefficient(weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANY: (f64, f64) = (-1e9, 1e9);

    fn table(step: usize, of: impl Fn(f64) -> f64) -> Tabulated {
        let nm = (400..=700).step_by(step).map(|nm| f64::from(nm as u32));
        Tabulated::new(nm.map(|nm| (nm, of(nm))).collect()).unwrap()
    }

    /// The interpolation passes through the points and reproduces a polynomial of the fourth order, except in the two steps at either end,
    /// which use extrapolated values.
    #[test]
    fn polynomials_of_the_fourth_order_are_kept() {
        let of = |nm: f64| {
            let x = (nm - 550.0) / 100.0;
            1.0 + x * (0.3 + x * (-0.7 + x * (0.2 + 0.1 * x)))
        };
        for step in [10, 20] {
            let (fine, step_nm) = sprague(&table(step, of), ANY).unwrap();
            assert_eq!((step_nm, fine.points().len()), (step as f64, 301));
            for (nm, value) in fine.points() {
                let on_point = (nm as usize).is_multiple_of(step);
                let beyond = 2.0 * step_nm;
                let is_inside = (400.0 + beyond..=700.0 - beyond).contains(&nm);
                let allowed = match (on_point, is_inside) {
                    (true, _) => 1e-13,
                    (false, true) => 1e-9,
                    (false, false) => 1e-2,
                };
                assert!((value - of(nm)).abs() < allowed, "{nm}: {value} {}", of(nm));
            }
        }
    }

    /// Halfway between the middle two of 0, 0, 0, 1, 0, 0, the fourth column of [`POWERS`] gives, by hand,
    /// (16/2 + 16/4 + 66/8 − 124/16 + 50/32)/24.
    #[test]
    fn a_single_value_has_the_weights_of_the_formula() {
        let found = within(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], 0.5);
        assert!((found - 14.0625 / 24.0).abs() < 1e-15, "{found}");
    }

    #[test]
    fn only_equal_steps_of_ten_or_twenty_are_taken() {
        assert!(sprague(&table(5, |_| 0.5), ANY).is_none());
        assert!(sprague(&table(30, |_| 0.5), ANY).is_none());
        assert!(sprague(&table(100, |_| 0.5), ANY).is_none());
        let uneven = vec![
            (400.0, 0.1),
            (410.0, 0.2),
            (420.0, 0.3),
            (430.0, 0.1),
            (440.0, 0.2),
            (451.0, 0.3),
        ];
        assert!(sprague(&Tabulated::new(uneven).unwrap(), ANY).is_none());
    }

    /// Overshoots are clamped to the range.
    #[test]
    fn a_reflectance_stays_one() {
        let steep = |nm: f64| if nm < 550.0 { 0.0 } else { 1.0 };
        let (fine, _) = sprague(&table(10, steep), (0.0, 1.0)).unwrap();
        assert!(fine.points().all(|(_, value)| (0.0..=1.0).contains(&value)));
        let (free, _) = sprague(&table(10, steep), ANY).unwrap();
        assert!(free.points().any(|(_, value)| value > 1.01));
    }
}
