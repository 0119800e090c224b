//! Angles of incidence.

use document::wording::number;
use thiserror::Error;

/// An angle of incidence, from the normal, in the incident medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    deg: f64,
    cosine: f64,
}

/// An invalid angle of incidence.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("an angle of {}°; it must be at least 0° and less than 90°", number(*.0))]
pub struct AngleError(
    /// The angle in degrees.
    pub f64,
);

impl Angle {
    /// Normal incidence.
    pub const NORMAL: Self = Self {
        deg: 0.0,
        cosine: 1.0,
    };

    /// Makes an angle from degrees.
    ///
    /// # Errors
    /// If it is not at least 0 and less than 90.
    pub fn from_degrees(deg: f64) -> Result<Self, AngleError> {
        // sin(90° − θ) keeps the digits near grazing incidence that cos θ loses when θ in radians is rounded.
        let cosine = (90.0 - deg).to_radians().sin();
        let is_possible = (0.0..90.0).contains(&deg) && cosine > 0.0;
        is_possible
            .then_some(Self { deg, cosine })
            .ok_or(AngleError(deg))
    }

    /// Returns the angle in degrees.
    pub fn degrees(self) -> f64 {
        self.deg
    }

    /// Returns its cosine, in (0, 1].
    pub fn cosine(self) -> f64 {
        self.cosine
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_end_before_they_graze() {
        assert_eq!(Angle::from_degrees(0.0), Ok(Angle::NORMAL));
        assert!((Angle::from_degrees(60.0).unwrap().cosine() - 0.5).abs() < 1e-15);
        assert!(Angle::from_degrees(89.99).is_ok());
        for deg in [90.0, -1e-9, 91.0, f64::NAN, f64::INFINITY] {
            assert!(Angle::from_degrees(deg).is_err(), "{deg}");
        }
    }
}
