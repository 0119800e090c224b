//! When a render ends.

use std::fmt::{self, Display};

/// When a render ends: at the first of these that is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// The number of samples of a pixel; their mean over the pixels if sampling is adaptive.
    pub samples: u32,
    /// Seconds of rendering. At least one sample is taken.
    pub seconds: Option<f64>,
    /// The noise of the picture, see [`NoiseEstimator`](crate::NoiseEstimator).
    pub noise: Option<f64>,
}

impl Goal {
    /// Ends with a number of samples.
    pub fn samples(samples: u32) -> Self {
        Self {
            samples,
            seconds: None,
            noise: None,
        }
    }
}

/// Which part of a [`Goal`] was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The number of samples.
    Samples,
    /// The time.
    Time,
    /// The noise.
    Noise,
}

impl Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Samples => "samples",
            Self::Time => "time",
            Self::Noise => "noise",
        })
    }
}
