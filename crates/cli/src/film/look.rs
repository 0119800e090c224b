//! How colours of stacks are looked at.

use super::numbers;
use crate::lamp::Lamp;
use clap::ValueEnum;
use miette::miette;
use pellicle::coating::{Light, Polarisation, Side, View};
use pellicle::spectra::Observer;

/// How colours are looked at.
#[derive(clap::Args)]
pub(super) struct Look {
    /// The light that colours are seen in: D65, A, FL11, LED-B3, D5700K, blackbody_3000K ..., or a file of wavelength_nm,power (.csv, .spd, .spdx ...);
    /// swatches and codes of sRGB are not adapted to it: under A white looks orange
    #[arg(long, value_name = "NAME|FILE", default_value = "D65", value_parser = Lamp::unscaled)]
    pub(super) illuminant: Lamp,
    /// The observer of colours: 1931_2, 1964_10, 2015_2 or 2015_10
    #[arg(long, value_name = "NAME", default_value_t = Observer::Cie1931Deg2)]
    pub(super) observer: Observer,
    /// Stops by which colours are shown brighter: a soap film reflects 8 % at most
    #[arg(long, value_name = "EV", default_value = "0", value_parser = numbers::number, allow_hyphen_values = true)]
    pub(super) exposure: f64,
    /// Look at the light that passes, not at the reflected
    #[arg(long)]
    transmitted: bool,
    /// Polarisation of the light of colours and plots
    #[arg(long, value_enum, default_value_t = PolarisationName::Unpolarised)]
    polarisation: PolarisationName,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(super) enum PolarisationName {
    Unpolarised,
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
            polarisation: match self.polarisation {
                PolarisationName::Unpolarised => Polarisation::Unpolarised,
                PolarisationName::S => Polarisation::S,
                PolarisationName::P => Polarisation::P,
            },
        }
    }
}
