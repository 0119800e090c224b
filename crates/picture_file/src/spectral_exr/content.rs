//! What channels hold.

use exr::meta::attribute::SampleType;
use spectra::{LayerKey, Quantity};

/// The content of a channel.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Content {
    /// The value with this index of each pixel of a layer.
    Value(LayerKey, usize),
    /// Linear red, green or blue, developed from the XYZ of all light or of a light group.
    Rgb(Option<usize>, usize),
}

impl Content {
    pub(super) fn sample_type(self) -> SampleType {
        match self {
            Self::Value(key, _) if key.quantity == Quantity::Samples => SampleType::U32,
            _ => SampleType::F32,
        }
    }
}
