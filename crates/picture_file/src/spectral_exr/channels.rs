//! The channels of files written here, and their contents.

use exr::meta::attribute::{ChannelDescription, Text};
use exr::prelude::SmallVec;
use spectra::{BandGrid, LayerKey, LightGroup, Quantity, SpectralImage, Stokes};

use super::bands::{band_of_text, radiance_name, wavelength_text};
use super::content::Content;
use super::lights;

/// Prefix of the names of our own channels.
const OWN: &str = "pellicle.";
/// What follows [`OWN`] in the names of variances.
const VARIANCE: &str = "variance.";
/// What follows [`OWN`] in the name of the number of samples.
const SAMPLES: &str = "samples";
/// What follows [`OWN`] or the prefix of a light group in the names of X, Y and Z. Many readers would take a name that ends in `.Z` for
/// a depth.
const XYZ: [&str; 3] = ["cieX", "cieY", "cieZ"];

/// Returns the name of the channel with a value of a layer.
fn value_name(key: LayerKey, index: usize, grid: &BandGrid, light_groups: &[LightGroup]) -> String {
    let own = key.light_group.map_or(OWN.to_owned(), |group| {
        lights::prefix(&light_groups[group].name)
    });
    let own = match key.stokes {
        Stokes::S0 => own,
        stokes => own + stokes.name() + ".",
    };
    let center_nm = || grid.center_nm(index as u32);
    match (key.quantity, key.light_group) {
        (Quantity::Radiance, None) => radiance_name(key.stokes, center_nm()),
        (Quantity::Radiance, Some(_)) => own + &wavelength_text(center_nm()),
        (Quantity::Variance, _) => own + VARIANCE + &wavelength_text(center_nm()),
        (Quantity::Xyz, _) => own + XYZ[index],
        (Quantity::Samples, _) => own + SAMPLES,
    }
}

/// Returns the names of the channels with developed color of all light or of a light group.
fn rgb_names(light_group: Option<&LightGroup>) -> [String; 3] {
    let layer = light_group.map_or(String::new(), |group| format!("{}.", group.name));
    ["R", "G", "B"].map(|name| layer.clone() + name)
}

/// Returns the content of a channel by its name, if it is a value of one of the layers of an image with these bands and light groups;
/// `None` for the spectrum of all light, whose channels other programs name too, and for red, green and blue, which are developed
/// again from XYZ.
pub(super) fn content(name: &str, grid: &BandGrid, light_groups: &[LightGroup]) -> Option<Content> {
    let (light_group, rest) = match lights::split(name, light_groups) {
        Some((group, rest)) => (Some(group), rest),
        None => (None, name.strip_prefix(OWN)?),
    };
    let polarized = Stokes::POLARIZED.into_iter().find_map(|stokes| {
        let rest = rest.strip_prefix(stokes.name())?.strip_prefix('.')?;
        Some((stokes, rest))
    });
    let (stokes, rest) = polarized.unwrap_or((Stokes::S0, rest));
    let (quantity, index) = if let Some(axis) = XYZ.iter().position(|xyz| *xyz == rest) {
        (Quantity::Xyz, axis)
    } else if light_group.is_some() {
        (Quantity::Radiance, band_of_text(rest, grid)?)
    } else if stokes != Stokes::S0 {
        return None;
    } else if rest == SAMPLES {
        (Quantity::Samples, 0)
    } else {
        let band = rest.strip_prefix(VARIANCE)?;
        (Quantity::Variance, band_of_text(band, grid)?)
    };
    let key = LayerKey {
        quantity,
        light_group,
        stokes,
    };
    Some(Content::Value(key, index))
}

/// The channels of an image to write, in the order of their names, which the format requires.
#[derive(Debug)]
pub(super) struct Channels {
    /// The content of each channel, in that order.
    pub(super) contents: Vec<Content>,
    /// The channels as the header lists them.
    pub(super) descriptions: SmallVec<[ChannelDescription; 5]>,
}

impl Channels {
    /// The channels of an image: those of each of its layers, and developed colors.
    pub(super) fn new(image: &SpectralImage, variance: bool) -> Self {
        let (grid, groups) = (image.bands(), image.light_groups());
        let mut named = Vec::new();
        for layer in image.layers() {
            let key = layer.key();
            if key.quantity == Quantity::Variance && !variance {
                continue;
            }
            for index in 0..layer.values_per_pixel() {
                let name = value_name(key, index, grid, groups);
                named.push((name, Content::Value(key, index)));
            }
            if key.quantity == Quantity::Xyz && key.stokes == Stokes::S0 {
                let names = rgb_names(key.light_group.map(|group| &groups[group]));
                let contents = (0..).map(|channel| Content::Rgb(key.light_group, channel));
                named.extend(names.into_iter().zip(contents));
            }
        }
        named.sort_by(|a, b| a.0.cmp(&b.0));
        Self {
            contents: named.iter().map(|&(_, content)| content).collect(),
            descriptions: named
                .iter()
                .map(|(name, content)| description(name, *content))
                .collect(),
        }
    }
}

fn description(name: &str, content: Content) -> ChannelDescription {
    // Names are ASCII. The last flag matters only for lossy compression.
    let name = Text::from_slice_unchecked(name.as_bytes());
    ChannelDescription::new(name, content.sample_type(), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_of_a_file_is_reported_from_its_name() {
        let grid = BandGrid::visible(48).unwrap();
        let group = |name: &str| LightGroup {
            name: name.to_owned(),
            lamp: None,
        };
        let groups = ["S1", "S0_sky"].map(group);
        let is_spectrum = |key: LayerKey| key.component(Stokes::S0) == LayerKey::RADIANCE;
        let image =
            |groups: &[LightGroup]| SpectralImage::with_light_groups(1, 1, grid, groups.to_vec());
        let channels = Channels::new(&image(&groups).with_polarization(), true);
        let of_s0 = 2 * 48 + 7 + 2 * (48 + 6);
        assert_eq!(channels.contents.len(), of_s0 + 3 * 3 * (48 + 3));
        for (description, &own) in channels.descriptions.iter().zip(&channels.contents) {
            let name = description.name.to_string();
            let found = content(&name, &grid, &groups);
            match own {
                Content::Value(key, _) if !is_spectrum(key) => {
                    assert_eq!(found, Some(own), "{name}");
                }
                _ => assert_eq!(found, None),
            }
        }
        let of = |groups, variance| Channels::new(&image(groups), variance).contents.len();
        assert_eq!(of(&groups[..1], true), 2 * 48 + 7);
        assert_eq!(of(&groups[..1], false), 48 + 7);
        for other in [
            "A",
            "R",
            "variance.384,166667nm",
            "pellicle.384,166667nm",
            "pellicle.S1.384,166667nm",
            "pellicle.S1.samples",
            "pellicle.S1.variance.384,166667nm",
            "pellicle.S4.cieX",
            "pellicle.light.S1.samples",
            "pellicle.light.fill.cieX",
        ] {
            assert_eq!(content(other, &grid, &groups), None, "{other}");
        }
        for own in [
            "pellicle.light.S1.384,166667nm",
            "pellicle.light.S1.S2.384,166667nm",
            "pellicle.S3.cieY",
        ] {
            assert!(content(own, &grid, &groups).is_some(), "{own}");
        }
    }
}
