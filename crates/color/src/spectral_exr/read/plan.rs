//! What to read from a file: which layer, which of its channels.

use exr::math::Vec2;
use exr::meta::header::Header;
use spectra::{BandGrid, LightGroup};

use super::{Context, ReadExrError};
use crate::spectral_exr::bands::{grid_of, wavelength_of};
use crate::spectral_exr::channels::{Content, plain_content, variance_band};
use crate::spectral_exr::lights;
use crate::spectral_exr::metadata::range_nm;

/// The layer with the spectrum and what its channels hold.
#[derive(Debug)]
pub(super) struct Plan {
    /// Index of the layer.
    pub(super) layer: usize,
    /// Width and height in pixels.
    pub(super) size: (usize, usize),
    /// The bands.
    pub(super) grid: BandGrid,
    /// What each channel of the layer holds, `None` where it is passed over.
    pub(super) contents: Vec<Option<Content>>,
    /// The light groups, at least one.
    pub(super) light_groups: Vec<LightGroup>,
}

impl Plan {
    /// The first flat layer that has radiances.
    pub(super) fn new(context: &Context<'_>, headers: &[Header]) -> Result<Self, ReadExrError> {
        let is_spectral = |header: &Header| {
            !header.deep
                && names(header)
                    .iter()
                    .any(|name| wavelength_of(name).is_some())
        };
        let layer =
            headers
                .iter()
                .position(is_spectral)
                .ok_or_else(|| ReadExrError::NoSpectrum {
                    path: context.path.to_owned(),
                })?;
        let header = &headers[layer];
        if header
            .channels
            .list
            .iter()
            .any(|c| c.sampling != Vec2(1, 1))
        {
            return Err(context.unsupported("channels with fewer samples than pixels"));
        }
        let light_groups = lights::of_header(header);
        let (grid, contents) =
            contents(header, &light_groups).map_err(|source| ReadExrError::Bands {
                path: context.path.to_owned(),
                source,
            })?;
        if let Some(name) = lights::incomplete(&light_groups, &contents, &grid) {
            return Err(context.damaged(&format!("the light group {name:?} lacks channels")));
        }
        Ok(Self {
            layer,
            size: (header.layer_size.width(), header.layer_size.height()),
            grid,
            contents,
            light_groups,
        })
    }

    /// Whether the file has X, Y and Z.
    pub(super) fn has_xyz(&self) -> bool {
        (0..3).all(|axis| self.contents.contains(&Some(Content::Xyz(axis))))
    }
}

fn names(header: &Header) -> Vec<String> {
    let channels = header.channels.list.iter();
    channels
        .map(|channel| String::from_utf8_lossy(channel.name.as_slice()).into_owned())
        .collect()
}

/// The grid that the channels' names give, and what each channel holds.
fn contents(
    header: &Header,
    light_groups: &[LightGroup],
) -> Result<(BandGrid, Vec<Option<Content>>), crate::spectral_exr::BandLayoutError> {
    let names = names(header);
    let mut radiances = Vec::new();
    for (channel, name) in names.iter().enumerate() {
        if let Some(nm) = wavelength_of(name) {
            radiances.push((nm?, channel));
        }
    }
    // Other writers need not pad their numbers, so that the order of names is not that of wavelengths.
    radiances.sort_by(|a, b| a.0.total_cmp(&b.0));
    let centres: Vec<f64> = radiances.iter().map(|&(nm, _)| nm).collect();
    let grid = grid_of(&centres, range_nm(header))?;

    let mut contents: Vec<Option<Content>> = names
        .iter()
        .map(|name| match plain_content(name) {
            // Developed again from XYZ when needed.
            Some(Content::Rgb(_)) => None,
            Some(content) => Some(content),
            None => variance_band(name, &grid)
                .map(Content::Variance)
                .or_else(|| lights::content(name, light_groups, &grid)),
        })
        .collect();
    for (band, &(_, channel)) in radiances.iter().enumerate() {
        contents[channel] = Some(Content::Radiance(band));
    }
    Ok((grid, contents))
}
