//! The channels of S1, S2 and S3.

use exr::meta::header::Header;
use spectra::{LayerKey, LightGroup, Stokes};

use super::spectral::{Spectral, names};
use crate::spectral_exr::bands::Bands;
use crate::spectral_exr::content::Content;
use crate::spectral_exr::lights;
use crate::spectral_exr::wavelength::{Quantity, component_nm};

/// How far the wavelength of a channel may be from that of S0, as a fraction of it: names have few decimals.
const SAME_WITHIN: f64 = 1e-6;

/// The layer of a file in which S1, S2 and S3 are looked for.
pub(super) struct Polarization<'a> {
    pub(super) header: &'a Header,
    /// S0.
    pub(super) spectrum: &'a Spectral,
    pub(super) bands: &'a Bands,
    pub(super) light_groups: &'a [LightGroup],
}

impl Polarization<'_> {
    /// Adds what the channels of S1, S2 and S3 hold, and returns true. If the file does not have all of them, or has them for other
    /// wavelengths than S0, they are ignored, with a note.
    pub(super) fn plan(&self, contents: &mut [Option<Content>], notes: &mut Vec<String>) -> bool {
        let found = self.found(contents);
        match &found {
            Ok(Some(channels)) => {
                for &(stokes, band, channel) in channels {
                    let key = LayerKey::RADIANCE.component(stokes);
                    contents[channel] = Some(Content::Value(key, band));
                }
            }
            Ok(None) => {}
            Err(reason) => notes.push(format!("{reason}: its polarization is ignored")),
        }
        let is_polarized = matches!(found, Ok(Some(_)));
        let is_kept = |content: &Content| {
            is_polarized || !matches!(content, Content::Value(key, _) if key.stokes != Stokes::S0)
        };
        for content in contents {
            *content = content.filter(is_kept);
        }
        is_polarized
    }

    /// Component, band and index of each channel; `None` if the file has no polarization.
    fn found(&self, contents: &[Option<Content>]) -> Result<Option<Channels>, String> {
        let components = Stokes::POLARIZED.map(|stokes| self.of_component(stokes));
        let is_radiance = self.spectrum.quantity == Quantity::Radiance;
        if !is_radiance || components.iter().all(Vec::is_empty) {
            return Ok(None);
        }
        let mut channels = Vec::new();
        for (stokes, own) in Stokes::POLARIZED.into_iter().zip(&components) {
            let name = stokes.name();
            if own.is_empty() {
                return Err(format!("has no {name}, but other parts of a Stokes vector"));
            }
            if !self.is_of_s0(own) {
                return Err(format!("its {name} has other wavelengths than its S0"));
            }
            let lacking = lights::incomplete(self.light_groups, contents, &self.bands.grid, stokes);
            if let Some(group) = lacking {
                return Err(format!(
                    "its light group {group:?} lacks channels of {name}"
                ));
            }
            let used = own[self.bands.used.clone()].iter().enumerate();
            channels.extend(used.map(|(band, &(_, channel))| (stokes, band, channel)));
        }
        Ok(Some(channels))
    }

    /// Wavelengths and channels of a component, in order.
    fn of_component(&self, stokes: Stokes) -> Vec<(f64, usize)> {
        let names = names(self.header);
        let named = names.iter().enumerate();
        let of_name =
            |(channel, name): (usize, &String)| Some((component_nm(name, stokes)?, channel));
        let mut channels: Vec<_> = named.filter_map(of_name).collect();
        channels.sort_by(|a, b| a.0.total_cmp(&b.0));
        channels
    }

    fn is_of_s0(&self, own: &[(f64, usize)]) -> bool {
        let pairs = own.iter().zip(&self.spectrum.channels);
        let mut off = pairs.map(|((nm, _), (place, _))| (nm / place.center_nm() - 1.0).abs());
        own.len() == self.spectrum.channels.len() && off.all(|off| off <= SAME_WITHIN)
    }
}

/// Component, band and index of each channel.
type Channels = Vec<(Stokes, usize, usize)>;
