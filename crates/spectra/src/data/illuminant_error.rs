//! Why a name has no illuminant.

use thiserror::Error;

/// The names that `find_illuminant` accepts, for messages.
const KNOWN: &str = "A, B, C, D50, D55, D65, D75, E, FL1 to FL12 (or F1 to F12), HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, \
    LED-V1, LED-V2, daylight D4000K to D25000K, and black bodies blackbody_1000K to blackbody_100000K";

/// Why there is no illuminant with a name.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum IlluminantError {
    /// The name is unknown.
    #[error("there is no illuminant {name:?}{}; known names: {KNOWN}", suggestion(.nearest.as_deref()))]
    Unknown {
        /// The requested name.
        name: String,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// The temperature is outside the domain of the formula.
    #[error("illuminant {name:?}: {what} is defined from {} to {} K", range_k.0, range_k.1)]
    Temperature {
        /// The requested name.
        name: String,
        /// The radiator whose temperature it is.
        what: &'static str,
        /// The lowest and highest possible temperature, K.
        range_k: (f64, f64),
    },
}

fn suggestion(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean {name:?}?"))
}
