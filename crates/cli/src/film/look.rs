//! The viewing conditions for colors of stacks.

use super::numbers;
use crate::lamp::Lamp;
use clap::ValueEnum;
use miette::miette;
use pellicle::coating::{Light, Polarization, Side, View};
use pellicle::spectra::Observer;

/// The viewing conditions for colors.
#[derive(clap::Args)]
pub(super) struct Look {
    /// Illuminant of colors: D65, A, FL11, LED-B3, D5700K, blackbody_3000K ..., or a file with columns wavelength_nm,power (.csv, .spd,
    /// .spdx ...). Swatches and sRGB codes are not adapted to it: under A, white looks orange
    #[arg(long, value_name = "NAME|FILE", default_value = "D65", value_parser = Lamp::unscaled)]
    pub(super) illuminant: Lamp,
    /// Observer of colors: 1931_2, 1964_10, 2015_2 or 2015_10
    #[arg(long, value_name = "NAME", default_value_t = Observer::Cie1931Deg2)]
    pub(super) observer: Observer,
    /// Exposure in stops; a soap film reflects 8 % at most
    #[arg(long, value_name = "EV", default_value = "0", value_parser = numbers::number, allow_hyphen_values = true)]
    pub(super) exposure: f64,
    /// Show transmitted light instead of reflected light
    #[arg(long)]
    transmitted: bool,
    /// Polarization of the light in colors and plots
    #[arg(long, value_enum, default_value_t = PolarizationName::Unpolarized)]
    polarization: PolarizationName,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum PolarizationName {
    Unpolarized,
    S,
    P,
}

impl Look {
    pub(super) fn light(&self) -> miette::Result<Light> {
        let Lamp {
            name,
            spectrum,
            rule,
            ..
        } = &self.illuminant;
        Light::new(name, spectrum, self.observer, *rule)
            .map_err(|error| miette!("--illuminant {name}: {error}"))
    }

    pub(super) fn view(&self) -> View {
        View {
            side: if self.transmitted {
                Side::Transmitted
            } else {
                Side::Reflected
            },
            polarization: match self.polarization {
                PolarizationName::Unpolarized => Polarization::Unpolarized,
                PolarizationName::S => Polarization::S,
                PolarizationName::P => Polarization::P,
            },
        }
    }
}
