//! Integrals of products of tables.

use spectra::{BandGrid, Tabulated};

/// Wavelengths, over a grid, between which lamps and observers are linear.
pub(super) struct Knots(Vec<f64>);

/// The three-point Gauss–Legendre rule over \[−1, 1\] (Abramowitz and Stegun 1964, table 25.4): position and weight.
const GAUSS: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

impl Knots {
    /// Merges the points of the lamps with the whole nanometers, which are the knots of the observers.
    pub(super) fn new(grid: &BandGrid, lamps: &[&Tabulated]) -> Self {
        let (first, last) = (grid.min_nm().ceil() as i32, grid.max_nm() as i32);
        let mut knots: Vec<f64> = (first..=last).map(f64::from).collect();
        for lamp in lamps {
            knots.extend(lamp.points().map(|(nm, _)| nm));
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        Self(knots)
    }

    /// Calls `add` with wavelengths and their weights in nm. The sum is exact for functions that are polynomials of degree 5
    /// between neighboring knots: a lamp times a parabola times an observer has degree 4.
    pub(super) fn integrate(&self, from_nm: f64, to_nm: f64, mut add: impl FnMut(f64, f64)) {
        let first = self.0.partition_point(|&nm| nm <= from_nm);
        let inner = self.0[first..].iter().copied();
        let mut low = from_nm;
        for high in inner.take_while(|&nm| nm < to_nm).chain([to_nm]) {
            let half = 0.5 * (high - low);
            for (place, weight) in GAUSS {
                add(low + half * (1.0 + place), weight * half);
            }
            low = high;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ (λ − 400)⁵ dλ = (λ − 400)⁶ / 6, and a kink on a knot causes no error.
    #[test]
    fn polynomials_of_degree_five_are_exact_between_knots() {
        let grid = BandGrid::new(400.5, 406.25, 1).unwrap();
        let table = Tabulated::new(vec![(400.5, 0.0), (403.3, 1.0), (406.25, 0.0)]).unwrap();
        let integral = |knots: Knots, f: &dyn Fn(f64) -> f64| {
            let mut sum = 0.0;
            knots.integrate(400.5, 406.25, |nm, d_nm| sum += f(nm) * d_nm);
            sum
        };
        let fifth = integral(Knots::new(&grid, &[]), &|nm| (nm - 400.0).powi(5));
        let expected = (6.25_f64.powi(6) - 0.5_f64.powi(6)) / 6.0;
        assert!((fifth / expected - 1.0).abs() < 1e-12, "{fifth} {expected}");
        let triangle = |knots| integral(knots, &|nm| table.clamped_at(nm));
        let area = 0.5 * (406.25 - 400.5);
        assert!((triangle(Knots::new(&grid, &[&table])) - area).abs() < 1e-12);
        assert!((triangle(Knots::new(&grid, &[])) - area).abs() > 1e-3);
    }
}
