//! How a stack is seen.

use optics::Polarized;

/// The side from which a stack is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The reflected light.
    #[default]
    Reflected,
    /// The transmitted light.
    Transmitted,
}

/// Polarization of the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarization {
    /// Unpolarized: the mean of both.
    #[default]
    Unpolarized,
    /// s: the electric field is perpendicular to the plane of incidence.
    S,
    /// p: the electric field is in that plane.
    P,
}

impl Polarization {
    /// Returns the power in light of this polarization.
    pub fn of(self, power: Polarized) -> f64 {
        match self {
            Self::Unpolarized => power.unpolarized(),
            Self::S => power.s,
            Self::P => power.p,
        }
    }
}

/// How a stack is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct View {
    /// The side.
    pub side: Side,
    /// The polarization of the light.
    pub polarization: Polarization,
}

impl View {
    /// Selects from a reflected and a transmitted power, or from their derivatives, what is seen.
    pub fn of(self, reflected: Polarized, transmitted: Polarized) -> f64 {
        self.polarization.of(match self.side {
            Side::Reflected => reflected,
            Side::Transmitted => transmitted,
        })
    }
}
