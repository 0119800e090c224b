//! What to read from a file: which layer, which of its channels.

use exr::math::Vec2;
use exr::meta::header::Header;
use spectra::{BandGrid, LightGroup};

use super::{Context, ReadExrError};
use crate::spectral_exr::BandLayoutError;
use crate::spectral_exr::bands::{Bands, Shares};
use crate::spectral_exr::channels::{Content, plain_content, variance_band};
use crate::spectral_exr::lights;
use crate::spectral_exr::metadata::{Metadata, range_nm};
use crate::spectral_exr::wavelength::{Place, Quantity, spectral_channel};

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
    /// How many channels [`Content::Radiance`] counts.
    pub(super) spectral_channels: usize,
    /// How the spectral channels make the grid's bands; `None` where they are the grid's bands.
    pub(super) shares: Option<Shares>,
    /// What radiances and XYZ are multiplied by, and variances twice.
    pub(super) scale: f32,
    /// The light groups, at least one.
    pub(super) light_groups: Vec<LightGroup>,
}

/// The spectral channels of a layer, in order of their wavelengths.
struct Spectrum {
    quantity: Quantity,
    channels: Vec<(Place, usize)>,
}

impl Plan {
    /// The first flat layer that has a spectrum: radiances rather than reflectances. What it takes to read it goes into
    /// the notes of `metadata`, with its other entries.
    pub(super) fn new(
        context: &Context<'_>,
        headers: &[Header],
    ) -> Result<(Self, Metadata), ReadExrError> {
        let bands_error = |source| ReadExrError::Bands {
            path: context.path.to_owned(),
            source,
        };
        let (layer, spectrum) =
            find(headers)
                .map_err(bands_error)?
                .ok_or_else(|| ReadExrError::NoSpectrum {
                    path: context.path.to_owned(),
                })?;
        let header = &headers[layer];
        let mut channels = header.channels.list.iter();
        if channels.any(|c| c.sampling != Vec2(1, 1)) {
            return Err(context.unsupported("channels with fewer samples than pixels"));
        }
        let places: Vec<Place> = spectrum.channels.iter().map(|&(place, _)| place).collect();
        let bands = Bands::new(&places, range_nm(header)).map_err(bands_error)?;
        let mut metadata = Metadata::of_header(header);
        let light_groups = lights::of_header(header, &bands.grid, &mut metadata.notes);
        let contents = contents(header, &spectrum, &bands, &light_groups);
        if let Some(name) = lights::incomplete(&light_groups, &contents, &bands.grid) {
            return Err(context.damaged(&format!("the light group {name:?} lacks channels")));
        }
        let scale = match spectrum.quantity {
            Quantity::Reflectance => 1.0,
            Quantity::Radiance | Quantity::Range => metadata.take_units(),
        };
        note(&mut metadata, headers, &spectrum, &bands);
        let plan = Self {
            layer,
            size: (header.layer_size.width(), header.layer_size.height()),
            grid: bands.grid,
            contents,
            spectral_channels: bands.used.len(),
            shares: bands.shares,
            scale: scale as f32,
            light_groups,
        };
        Ok((plan, metadata))
    }

    /// Whether the file has X, Y and Z.
    pub(super) fn has_xyz(&self) -> bool {
        (0..3).all(|axis| self.contents.contains(&Some(Content::Xyz(axis))))
    }
}

/// The layer to read, with its spectrum.
fn find(headers: &[Header]) -> Result<Option<(usize, Spectrum)>, BandLayoutError> {
    for quantity in [Quantity::Radiance, Quantity::Range, Quantity::Reflectance] {
        for (layer, header) in headers.iter().enumerate().filter(|(_, h)| !h.deep) {
            let spectrum = Spectrum::of(header, quantity)?;
            if !spectrum.channels.is_empty() {
                return Ok(Some((layer, spectrum)));
            }
        }
    }
    Ok(None)
}

impl Spectrum {
    fn of(header: &Header, quantity: Quantity) -> Result<Self, BandLayoutError> {
        let mut channels = Vec::new();
        for (channel, name) in names(header).iter().enumerate() {
            if let Some(found) = spectral_channel(name) {
                let (of_channel, place) = found?;
                if of_channel == quantity {
                    channels.push((place, channel));
                }
            }
        }
        // Other writers need not pad their numbers, so that the order of names is not that of wavelengths.
        channels.sort_by(|a, b| a.0.centre_nm().total_cmp(&b.0.centre_nm()));
        Ok(Self { quantity, channels })
    }
}

fn names(header: &Header) -> Vec<String> {
    let channels = header.channels.list.iter();
    channels
        .map(|channel| String::from_utf8_lossy(channel.name.as_slice()).into_owned())
        .collect()
}

/// What each channel holds.
fn contents(
    header: &Header,
    spectrum: &Spectrum,
    bands: &Bands,
    light_groups: &[LightGroup],
) -> Vec<Option<Content>> {
    let content = |name: &String| match plain_content(name) {
        // Developed again from XYZ when needed.
        Some(Content::Rgb(_)) => None,
        Some(content) => Some(content),
        None => variance_band(name, &bands.grid)
            .map(Content::Variance)
            .or_else(|| lights::content(name, light_groups, &bands.grid)),
    };
    let mut contents: Vec<Option<Content>> = names(header).iter().map(content).collect();
    for (band, &(_, channel)) in spectrum.channels[bands.used.clone()].iter().enumerate() {
        contents[channel] = Some(Content::Radiance(band));
    }
    contents
}

/// Says what was chosen and changed.
fn note(metadata: &mut Metadata, headers: &[Header], spectrum: &Spectrum, bands: &Bands) {
    let mut say = |note: String| metadata.notes.push(note);
    if spectrum.quantity == Quantity::Reflectance {
        say(
            "holds reflectances: they are taken as lit by a radiance of 1 at every wavelength"
                .into(),
        );
    }
    let spectral_layers = headers.iter().filter(|header| {
        let found = Spectrum::of(header, spectrum.quantity);
        !header.deep && found.is_ok_and(|found| !found.channels.is_empty())
    });
    if spectral_layers.count() > 1 {
        say("has several parts with spectra: the first is read".into());
    }
    let left_out = spectrum.channels.len() - bands.used.len();
    let (low, high) = BandGrid::LIMITS_NM;
    if left_out > 0 {
        let all = spectrum.channels.len();
        say(format!(
            "{left_out} of its {all} bands are left out: they reach beyond {low} to {high} nm"
        ));
    }
    if bands.shares.is_some() {
        say(format!(
            "its {} bands are of different widths: read onto {} even ones of {:.3} nm, which keeps the integral",
            bands.used.len(),
            bands.grid.count(),
            bands.grid.width_nm()
        ));
    }
}
