//! The plan for reading a file: which layer and which of its channels.

use std::ops::Range;

use exr::meta::header::Header;
use spectra::{BandGrid, LayerKey, LightGroup, PixelContent, Spectrum, Stokes};

use super::polarization::Polarization;
use super::reflectances;
use super::spectral::{Spectral, names};
use crate::exr_file::{BandLayoutError, Context, ReadExrError, Window};
use crate::spectral_exr::bands::{BandMix, Bands};
use crate::spectral_exr::channels::content;
use crate::spectral_exr::content::Content;
use crate::spectral_exr::lights;
use crate::spectral_exr::metadata::{Metadata, range_nm, sign_of_s3};
use crate::spectral_exr::wavelength::{Quantity, SpectralPosition};

/// The layer with the spectrum, and the contents of its channels.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Index of the layer.
    pub(super) layer: usize,
    /// The picture, and the position of the layer's pixels in it.
    pub(super) window: Window,
    /// The bands.
    pub(super) grid: BandGrid,
    /// The content of each channel of the layer; `None` for channels that are ignored.
    pub(super) contents: Vec<Option<Content>>,
    /// Number of channels with radiance of all light.
    pub(super) spectral_channels: usize,
    /// How the grid's bands are computed from the spectral channels; `None` if the channels are the grid's bands.
    pub(super) shares: Option<BandMix>,
    /// The factor on radiances and XYZ; variances are multiplied by its square.
    pub(super) scale: f32,
    /// The light groups, at least one.
    pub(super) light_groups: Vec<LightGroup>,
    /// Whether S1, S2 and S3 are read.
    pub(super) is_polarized: bool,
    /// The factor on S3 besides the scale: −1 if it is positive for left-handed light.
    pub(super) sign_of_s3: f32,
    /// The illuminant of reflectances; `None` if the channels are radiances.
    pub(super) illuminant: Option<Spectrum>,
}

impl Plan {
    /// What the pixels of the image hold.
    pub(super) fn content(&self) -> PixelContent {
        PixelContent {
            bands: self.grid.count(),
            light_groups: self.light_groups.len(),
            is_polarized: self.is_polarized,
        }
    }

    /// Chooses the first flat layer that has a spectrum, with radiances preferred to reflectances. The changes and assumptions that
    /// reading needs are in the notes of the returned metadata.
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
        let places: Vec<SpectralPosition> =
            spectrum.channels.iter().map(|&(place, _)| place).collect();
        let is_reflectance = spectrum.quantity == Quantity::Reflectance;
        let bands = Bands::new(&places, range_nm(header));
        let bands = if is_reflectance {
            bands.and_then(Bands::reaching_the_ends)
        } else {
            bands
        };
        let bands = bands.map_err(bands_error)?;
        let mut metadata = Metadata::of_header(header);
        let window = Window::of(header);
        metadata.notes.extend(window.note());
        let (light_groups, illuminant) = if is_reflectance {
            let illuminant = reflectances::illuminant(header, &bands.grid, &mut metadata.notes);
            (reflectances::light_groups(&bands.grid), Some(illuminant))
        } else {
            let groups = lights::of_header(header, &bands.grid, &mut metadata.notes);
            (groups, None)
        };
        let mut contents = contents(header, &spectrum, &bands, &light_groups);
        let lacking = lights::incomplete(&light_groups, &contents, &bands.grid, Stokes::S0);
        if let Some(name) = lacking {
            return Err(context.damaged(&format!("the light group {name:?} lacks channels")));
        }
        let scale = match spectrum.quantity {
            Quantity::Reflectance => 1.0,
            Quantity::Radiance | Quantity::Range => metadata.take_units(),
        };
        note(&mut metadata, headers, &spectrum, &bands);
        let polarization = Polarization {
            header,
            spectrum: &spectrum,
            bands: &bands,
            light_groups: &light_groups,
        };
        let is_polarized = polarization.plan(&mut contents, &mut metadata.notes);
        let sign_of_s3 = if is_polarized {
            sign_of_s3(header, &mut metadata.notes)
        } else {
            1.0
        };
        let plan = Self {
            layer,
            window,
            grid: bands.grid,
            contents,
            spectral_channels: bands.used.len(),
            shares: bands.shares,
            scale: scale as f32,
            light_groups,
            is_polarized,
            sign_of_s3,
            illuminant,
        };
        Ok((plan, metadata))
    }

    /// The plan for reading only these rows of the picture.
    pub(super) fn of_rows(&self, rows: &Range<u32>) -> Self {
        Self {
            window: self.window.of_rows(rows),
            ..self.clone()
        }
    }

    /// Whether the file has X, Y and Z.
    pub(super) fn has_xyz(&self) -> bool {
        self.has_xyz_of(Stokes::S0)
    }

    /// Whether the file has X, Y and Z of a component of the Stokes vector.
    pub(super) fn has_xyz_of(&self, stokes: Stokes) -> bool {
        self.illuminant.is_none()
            && (0..3).all(|axis| {
                let content = Content::Value(LayerKey::XYZ.component(stokes), axis);
                self.contents.contains(&Some(content))
            })
    }

    /// The components of the Stokes vector that are read.
    pub(super) fn components(&self) -> &'static [Stokes] {
        if self.is_polarized {
            &Stokes::ALL
        } else {
            &Stokes::ALL[..1]
        }
    }

    /// The factor on a radiance or color of the file.
    pub(super) fn scale_of(&self, key: LayerKey) -> f32 {
        match key.stokes {
            Stokes::S3 => self.sign_of_s3 * self.scale,
            _ => self.scale,
        }
    }
}

/// Finds the layer to read, with its spectrum.
fn find(headers: &[Header]) -> Result<Option<(usize, Spectral)>, BandLayoutError> {
    for quantity in [Quantity::Radiance, Quantity::Range, Quantity::Reflectance] {
        for (layer, header) in headers.iter().enumerate().filter(|(_, h)| !h.deep) {
            let spectrum = Spectral::of(header, quantity)?;
            if !spectrum.channels.is_empty() {
                return Ok(Some((layer, spectrum)));
            }
        }
    }
    Ok(None)
}

/// Returns the content of each channel.
fn contents(
    header: &Header,
    spectrum: &Spectral,
    bands: &Bands,
    light_groups: &[LightGroup],
) -> Vec<Option<Content>> {
    let content = |name: &String| content(name, &bands.grid, light_groups);
    let mut contents: Vec<Option<Content>> = names(header).iter().map(content).collect();
    for (band, &(_, channel)) in spectrum.channels[bands.used.clone()].iter().enumerate() {
        contents[channel] = Some(Content::Value(LayerKey::RADIANCE, band));
    }
    contents
}

/// Adds notes on choices and changes.
fn note(metadata: &mut Metadata, headers: &[Header], spectrum: &Spectral, bands: &Bands) {
    let mut say = |note: String| metadata.notes.push(note);
    let spectral_layers = headers.iter().filter(|header| {
        let found = Spectral::of(header, spectrum.quantity);
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
    if let Some((from_nm, to_nm)) = bands.ends_nm {
        say(format!(
            "its bands cover {from_nm} to {to_nm} nm: beyond them, the reflectance has its value at the ends"
        ));
    }
    if bands.shares.is_some() && spectrum.quantity != Quantity::Reflectance {
        say(format!(
            "its {} bands have different widths: they are read onto {} even ones of {:.3} nm, which keeps the integral",
            bands.used.len(),
            bands.grid.count(),
            bands.grid.width_nm()
        ));
    }
}
