//! Ranges of numbers, and numbers as messages show them.

use std::fmt;

/// A closed range of numbers with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest number allowed.
    pub low: f64,
    /// The largest number allowed.
    pub high: f64,
    /// The unit with a leading space, or nothing.
    pub unit: &'static str,
}

impl Range {
    /// A range from `low` to `high`, both included.
    pub const fn new(low: f64, high: f64, unit: &'static str) -> Self {
        Self { low, high, unit }
    }

    /// Whether `value` is in the range; NaN never is.
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} to {}{}",
            Shown(self.low),
            Shown(self.high),
            self.unit
        )
    }
}

/// A number as messages show it: in scientific notation if it has many digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (plain, power) = (self.0.to_string(), format!("{:e}", self.0));
        let is_long = self.0 != 0.0 && !(1e-4..1e6).contains(&self.0.abs());
        let shown = if is_long && power.len() < plain.len() {
            power
        } else {
            plain
        };
        write!(f, "{shown}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_rows_of_digits_are_shown_as_powers() {
        for (number, shown) in [
            (0.0, "0"),
            (-1e6, "-1e6"),
            (1e9, "1e9"),
            (1e30, "1e30"),
            (1e-9, "1e-9"),
            (100_000.0, "100000"),
            (16_777_216.0, "16777216"),
            (0.001, "0.001"),
            (0.25, "0.25"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(Shown(number).to_string(), shown);
        }
    }
}
