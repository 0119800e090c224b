//! Reading the colors of an `OpenEXR` file.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use colorimetry::Matrix3;
use colorimetry::matrix::times;
use colorimetry::srgb;
use exr::block::reader::Reader;
use rayon::prelude::*;
use thiserror::Error;

use super::layers::{ColorLayer, Kind, NotChosen, choose, names, of_headers};
use super::primaries::{BadPrimaries, srgb_from};
use crate::exr_file::{
    self, Context, ReadExrError, Window, each_block, each_sample, guard, listed,
};

/// Why the colors of a file could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadRgbError {
    /// The file is not an `OpenEXR` file, is damaged, or has an unsupported form.
    #[error(transparent)]
    File(#[from] ReadExrError),
    /// The file has no color channels.
    #[error(
        "{path} has neither channels R, G and B, nor X, Y and Z, nor Y, nor spectral ones (`S0.550,000000nm`); its channels are {channels}"
    )]
    NoColors {
        /// The file.
        path: PathBuf,
        /// The channels of the file.
        channels: String,
    },
    /// The file has several layers, and none is the main one.
    #[error("{path} has several layers of colors, {layers}; choose one with `layer`")]
    SeveralLayers {
        /// The file.
        path: PathBuf,
        /// Their names.
        layers: String,
    },
    /// The requested layer does not exist.
    #[error("{path} has no layer {layer:?} of colors; its layers are {layers}")]
    NoSuchLayer {
        /// The file.
        path: PathBuf,
        /// The requested name.
        layer: String,
        /// Their names.
        layers: String,
    },
    /// The chromaticities of red, green and blue are not primaries.
    #[error("the colors of {path} cannot be used")]
    Primaries {
        /// The file.
        path: PathBuf,
        /// The chromaticities.
        source: BadPrimaries,
    },
}

/// A color file whose header has been read and checked, but whose pixels have not been read.
#[derive(Debug)]
pub struct RgbFile {
    path: PathBuf,
    reader: Reader<BufReader<File>>,
    layer: ColorLayer,
    window: Window,
    to_srgb: Option<Matrix3>,
    notes: Vec<String>,
}

impl RgbFile {
    /// Opens a file and chooses the layer to read: the layer of this name; otherwise the only R, G and B, or those without a layer
    /// name; otherwise X, Y and Z without a layer name, taken as CIE XYZ, white at Y = 1; otherwise a luminance Y, taken as gray.
    ///
    /// A layer's name is its channels' names up to the last dot (`ViewLayer.Combined` of `ViewLayer.Combined.R`), preceded by the
    /// name of the part in a file of several parts. Alpha is ignored.
    ///
    /// # Errors
    /// When the file cannot be read, is larger than its length or this machine's memory can account for, or has no such layer.
    pub fn open(path: &Path, layer: Option<&str>) -> Result<Self, ReadRgbError> {
        let (reader, length) = exr_file::open(path)?;
        let context = Context { path };
        let (layer, is_choice) = chosen(path, &reader, layer)?;
        guard::check(&context, reader.headers(), layer.part, length)?;
        let header = &reader.headers()[layer.part];
        let window = Window::of(header);
        let bytes = |width, height| u128::from(width) * u128::from(height) * 12;
        if !guard::fits(&window, length, bytes) {
            let (width, height) = window.size();
            let reason = format!("a picture of {width}×{height} pixels, too large to read");
            return Err(context.unsupported(&reason).into());
        }
        let chromaticities = header.shared_attributes.chromaticities;
        let to_srgb = match layer.kind {
            Kind::Rgb => srgb_from(chromaticities).map_err(|source| ReadRgbError::Primaries {
                path: path.to_owned(),
                source,
            })?,
            Kind::Xyz => Some(*srgb::rgb_from_xyz()),
            Kind::Luminance => None,
        };
        let mut notes: Vec<String> = window.note().into_iter().collect();
        notes.extend(note(&layer, is_choice));
        Ok(Self {
            path: path.to_owned(),
            layer,
            window,
            to_srgb,
            notes,
            reader,
        })
    }

    /// Width and height of the display window in pixels.
    pub fn size(&self) -> [u32; 2] {
        let (width, height) = self.window.size();
        // `open` has checked that an image of these sides fits into memory.
        [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX))
    }

    /// The assumptions made, each worded to follow the file's name.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Reads the pixels row by row as linear red, green and blue of the primaries of sRGB, without chromatic adaptation. Pixels that
    /// the file lacks are black. Values are not scaled: `whiteLuminance` is not used; the caller decides how bright 1 is.
    ///
    /// # Errors
    /// When the pixels are damaged or missing.
    pub fn read(self) -> Result<Vec<[f32; 3]>, ReadRgbError> {
        let (window, layer) = (self.window, self.layer);
        let (width, height) = window.size();
        let mut rgb = vec![[0.0_f32; 3]; width * height];
        let mut filled = 0;
        let context = Context { path: &self.path };
        each_block(&context, self.reader, layer.part, |block, channels| {
            for line in block.lines(channels) {
                let at = line.location;
                let Some(axis) = layer.channels.iter().position(|&c| c == at.channel) else {
                    continue;
                };
                let place = (at.position.x(), at.position.y());
                if !window.holds(place, at.sample_count) {
                    return None;
                }
                filled += at.sample_count;
                if let Some(run) = window.place(place, at.sample_count) {
                    let start = run.y * width + run.x;
                    let row = &mut rgb[start..start + run.count];
                    let kind = channels.list[at.channel].sample_type;
                    each_sample(line, kind, (run.skip, run.count), |x, v| row[x][axis] = v);
                }
            }
            Some(())
        })?;
        let held = window.data();
        if filled != layer.channels.len() * held.0 * held.1 {
            return Err(context.damaged("some pixels are missing").into());
        }
        finish(&mut rgb, layer.kind, self.to_srgb.as_ref());
        Ok(rgb)
    }
}

fn finish(rgb: &mut [[f32; 3]], kind: Kind, to_srgb: Option<&Matrix3>) {
    let pixels = rgb.par_iter_mut().with_min_len(4096);
    match (kind, to_srgb) {
        (Kind::Luminance, _) => pixels.for_each(|pixel| *pixel = [pixel[0]; 3]),
        (_, Some(matrix)) => pixels.for_each(|pixel| {
            *pixel = times(matrix, pixel.map(f64::from)).map(|value| value as f32);
        }),
        (_, None) => {}
    }
}

fn chosen(
    path: &Path,
    reader: &Reader<BufReader<File>>,
    asked: Option<&str>,
) -> Result<(ColorLayer, bool), ReadRgbError> {
    let path_buf = || path.to_owned();
    let found = choose(&of_headers(reader.headers()), asked);
    let (layer, is_choice) = found.map_err(|error| match error {
        NotChosen::NoSuch(layers) if !layers.is_empty() => ReadRgbError::NoSuchLayer {
            path: path_buf(),
            layer: asked.unwrap_or_default().to_owned(),
            layers: listed(&layers),
        },
        NotChosen::Several(layers) => ReadRgbError::SeveralLayers {
            path: path_buf(),
            layers: listed(&layers),
        },
        _ => {
            let channels: Vec<String> = reader.headers().iter().flat_map(names).collect();
            ReadRgbError::NoColors {
                path: path_buf(),
                channels: listed(&channels),
            }
        }
    })?;
    let context = Context { path };
    if layer.kind == Kind::Luminance && layer.has_chroma {
        let reason = "luminance and chroma (Y, RY, BY); write it with R, G and B";
        return Err(context.unsupported(reason).into());
    }
    if let Some(name) = &layer.twice {
        return Err(context
            .damaged(&format!("it has two channels {name}"))
            .into());
    }
    Ok((layer, is_choice))
}

/// Returns a note on the assumptions about the channels.
fn note(layer: &ColorLayer, is_choice: bool) -> Option<String> {
    let of_layer = if layer.name.is_empty() {
        String::new()
    } else {
        format!(" of the layer {:?}", layer.name)
    };
    match layer.kind {
        Kind::Rgb if is_choice && layer.name.is_empty() => {
            Some("has several layers: R, G and B without a layer name are used".to_owned())
        }
        Kind::Rgb if is_choice => Some(format!("R, G and B{of_layer} are used")),
        Kind::Rgb => None,
        Kind::Xyz => Some(format!(
            "X, Y and Z{of_layer} are taken as CIE XYZ, white at Y = 1"
        )),
        Kind::Luminance => Some(format!(
            "has no color: its luminance Y{of_layer} is taken as gray"
        )),
    }
}
