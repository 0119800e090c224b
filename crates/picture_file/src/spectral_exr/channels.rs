//! The channels of files written here, and their contents.

use exr::meta::attribute::{ChannelDescription, SampleType, Text};
use exr::prelude::SmallVec;
use spectra::{BandGrid, LightGroup};

use super::bands::{band_of_text, radiance_name, wavelength_text};
use super::lights;

/// Prefix of the names of our own channels.
const OWN: &str = "pellicle.";
/// What follows [`OWN`] in the names of variances.
const VARIANCE: &str = "variance.";

/// The content of a channel.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Content {
    /// Radiance of this band.
    Radiance(usize),
    /// Variance of the mean of this band.
    Variance(usize),
    /// X, Y or Z.
    Xyz(usize),
    /// Linear red, green or blue.
    Rgb(usize),
    /// Number of samples.
    Samples,
    /// Content of the light group with this index.
    Light(usize, LightContent),
}

/// The content of a channel of a light group.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum LightContent {
    /// Radiance of this band.
    Radiance(usize),
    /// X, Y or Z.
    Xyz(usize),
    /// Linear red, green or blue.
    Rgb(usize),
}

impl Content {
    fn sample_type(self) -> SampleType {
        match self {
            Self::Samples => SampleType::U32,
            _ => SampleType::F32,
        }
    }
}

/// Returns the name of the variance channel of the band with center `nm`.
fn variance_name(nm: f64) -> String {
    format!("{OWN}{VARIANCE}{}", wavelength_text(nm))
}

/// Returns the channels other than the spectrum, by name.
fn plain() -> impl Iterator<Item = (String, Content)> {
    let rgb = ["R", "G", "B"].into_iter().enumerate();
    // Many readers would take a name that ends in `.Z` for a depth.
    let xyz = ["cieX", "cieY", "cieZ"].into_iter().enumerate();
    rgb.map(|(i, name)| (name.to_owned(), Content::Rgb(i)))
        .chain(xyz.map(|(i, name)| (format!("{OWN}{name}"), Content::Xyz(i))))
        .chain([(format!("{OWN}samples"), Content::Samples)])
}

/// Returns the content of a channel other than the spectrum by its name; `None` for channels that are not ours.
pub(super) fn plain_content(name: &str) -> Option<Content> {
    let mut channels = plain();
    channels
        .find(|(own, _)| own == name)
        .map(|(_, content)| content)
}

/// Returns the band whose variance a channel of this name holds.
pub(super) fn variance_band(name: &str, grid: &BandGrid) -> Option<usize> {
    band_of_text(name.strip_prefix(OWN)?.strip_prefix(VARIANCE)?, grid)
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
    /// The channels of an image with these bands.
    pub(super) fn new(grid: &BandGrid, light_groups: &[LightGroup], variance: bool) -> Self {
        let mut named: Vec<(String, Content)> = plain().collect();
        named.extend(lights::channels(light_groups, grid));
        for band in 0..grid.count() {
            let (nm, index) = (grid.center_nm(band), band as usize);
            named.push((radiance_name(nm), Content::Radiance(index)));
            if variance {
                named.push((variance_name(nm), Content::Variance(index)));
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
        let groups = ["key", "S0_sky"].map(group);
        let channels = Channels::new(&grid, &groups, true);
        assert_eq!(channels.contents.len(), 2 * 48 + 7 + 2 * (48 + 6));
        for (description, &content) in channels.descriptions.iter().zip(&channels.contents) {
            let name = description.name.to_string();
            let found =
                plain_content(&name).or_else(|| variance_band(&name, &grid).map(Content::Variance));
            let found = found.or_else(|| lights::content(&name, &groups, &grid));
            match content {
                Content::Radiance(_) | Content::Light(_, LightContent::Rgb(_)) => {
                    assert_eq!(found, None);
                }
                other => assert_eq!(found, Some(other), "{name}"),
            }
        }
        assert_eq!(
            Channels::new(&grid, &groups[..1], true).contents.len(),
            2 * 48 + 7
        );
        assert_eq!(plain_content("A"), None);
        assert_eq!(variance_band("variance.385,000000nm", &grid), None);
    }
}
