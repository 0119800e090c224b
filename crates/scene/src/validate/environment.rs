//! The surroundings: from `[environment]` to emissions.

use super::checks::Checks;
use super::spectrum_list::SpectrumList;
use super::strength::Radiator;
use crate::{Environment, FieldPath, description};

/// Checks `[environment]`; without one it is black.
pub(crate) fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList<'_>,
    environment: Option<&description::Environment>,
) -> Option<Environment> {
    let top = FieldPath::root().key("environment");
    let radiator = match environment {
        Some(description::Environment::Gradient { .. }) => Radiator::PartOfSurroundings,
        _ => Radiator::Surroundings,
    };
    let mut emission =
        |name: &str, emission| spectra.emission(checks, &top.key(name), emission, radiator);
    match environment {
        None => {
            let black = description::Emission {
                spectrum: description::EmissionSpectrum::Constant { constant: 0.0 },
                strength: description::Strength::scale(0.0),
            };
            emission("emission", &black).map(Environment::Constant)
        }
        Some(description::Environment::Constant {
            emission: written, ..
        }) => emission("emission", written).map(Environment::Constant),
        Some(description::Environment::Gradient {
            zenith,
            horizon,
            ground,
            ..
        }) => {
            let zenith = emission("zenith", zenith);
            let horizon = emission("horizon", horizon);
            let ground = match ground {
                Some(ground) => emission("ground", ground),
                None => horizon,
            };
            Some(Environment::Gradient {
                zenith: zenith?,
                horizon: horizon?,
                ground: ground?,
            })
        }
    }
}
