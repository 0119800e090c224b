//! The spectral channels of a layer.

use exr::meta::header::Header;

use crate::exr_file::{BandLayoutError, name_of};
use crate::spectral_exr::wavelength::{Quantity, SpectralPosition, spectral_channel};

/// The spectral channels of a layer, in order of their wavelengths.
pub(super) struct Spectral {
    pub(super) quantity: Quantity,
    pub(super) channels: Vec<(SpectralPosition, usize)>,
}

impl Spectral {
    /// Those of a layer with this quantity.
    pub(super) fn of(header: &Header, quantity: Quantity) -> Result<Self, BandLayoutError> {
        let mut channels = Vec::new();
        for (channel, name) in names(header).iter().enumerate() {
            if let Some(found) = spectral_channel(name) {
                let (of_channel, place) = found?;
                if of_channel == quantity {
                    channels.push((place, channel));
                }
            }
        }
        // Other writers may not pad their numbers, so names may not be in the order of wavelengths.
        channels.sort_by(|a, b| a.0.center_nm().total_cmp(&b.0.center_nm()));
        Ok(Self { quantity, channels })
    }
}

/// The names of the channels of a layer.
pub(super) fn names(header: &Header) -> Vec<String> {
    let channels = header.channels.list.iter();
    channels
        .map(|channel| name_of(channel.name.as_slice()))
        .collect()
}
