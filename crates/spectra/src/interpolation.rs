//! Linear interpolation between equidistant knots.

/// Returns the knot before a position, and the fraction of the way to the next. The position is from 0 at the first knot to 1 at the last;
/// there are at least two knots.
#[inline]
pub fn knot_before(position: f64, knots: usize) -> (usize, f64) {
    let place = position * (knots - 1) as f64;
    let knot = (place as usize).min(knots - 2);
    (knot, place - knot as f64)
}

/// Returns the value at a position from 0 at the first value to 1 at the last, of at least two values at equidistant knots.
#[inline]
pub fn linear(values: &[f64], position: f64) -> f64 {
    let (knot, part) = knot_before(position, values.len());
    values[knot] + (values[knot + 1] - values[knot]) * part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_position_belongs_to_the_last_interval() {
        assert_eq!(knot_before(0.0, 5), (0, 0.0));
        assert_eq!(knot_before(0.375, 5), (1, 0.5));
        assert_eq!(knot_before(0.5, 5), (2, 0.0));
        assert_eq!(knot_before(1.0, 5), (3, 1.0));
        assert_eq!(knot_before(1.0, 2), (0, 1.0));
    }

    #[test]
    fn values_are_linear_between_knots() {
        let values = [1.0, 3.0, 2.0];
        for (position, value) in [(0.0, 1.0), (0.25, 2.0), (0.5, 3.0), (0.75, 2.5), (1.0, 2.0)] {
            assert_eq!(linear(&values, position), value);
        }
    }
}
