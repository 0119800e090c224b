//! OpenEXR files of linear red, green and blue.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use colorimetry::Display;
use colorimetry::chromaticity::xy_of_xyz;
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
    f16,
};
use thiserror::Error;

use crate::LinearImage;
use crate::pending_file::PendingFile;
use crate::spectral_exr::software;

mod layers;
mod primaries;
mod read;

pub use primaries::BadPrimaries;
pub use read::{ReadRgbError, RgbFile};

/// The format of a file's values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Samples {
    /// 16 bits: eleven bits of precision, up to 65504. Most software expects this.
    #[default]
    Half,
    /// 32 bits, lossless.
    Float,
}

/// Why a file could not be written. No file is left behind.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteRgbError {
    /// The file could not be opened, written or renamed to its target.
    #[error("cannot write {path}")]
    File {
        /// The requested file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The image cannot be put into an OpenEXR file: it has no pixels, or too many.
    #[error("cannot encode {path} as OpenEXR")]
    Encode {
        /// The requested file.
        path: PathBuf,
        /// The error of the encoder.
        source: exr::error::Error,
    },
}

/// Writes channels R, G and B, 1 for the display's white, with the chromaticities of the display's primaries and white, and
/// `whiteLuminance`, the luminance of that white in the scene, cd/m².
///
/// The display's black level is not subtracted: the file holds the wanted light. Half floats end at 65504; larger values are written
/// as 65504.
///
/// # Errors
/// When the file cannot be written or the image has no pixels.
pub fn write(
    path: &Path,
    image: &LinearImage,
    display: &Display,
    samples: Samples,
) -> Result<(), WriteRgbError> {
    let file_error = |source| WriteRgbError::File {
        path: path.to_owned(),
        source,
    };
    let pending = PendingFile::create(path).map_err(file_error)?;
    let file = BufWriter::new(pending.handle().map_err(file_error)?);
    let result = encode(file, image, display, samples);
    result.map_err(|error| match error {
        exr::error::Error::Io(source) => file_error(source),
        source => WriteRgbError::Encode {
            path: path.to_owned(),
            source,
        },
    })?;
    pending.commit().map_err(file_error)
}

/// Returns the nearest half float; finite values stay finite.
fn half(value: f32) -> f16 {
    if value.is_finite() {
        f16::from_f32(value.clamp(f16::MIN.to_f32(), f16::MAX.to_f32()))
    } else {
        f16::from_f32(value)
    }
}

fn encode(
    file: BufWriter<std::fs::File>,
    image: &LinearImage,
    display: &Display,
    samples: Samples,
) -> exr::error::UnitResult {
    let size = (image.width() as usize, image.height() as usize);
    if size.0 == 0 || size.1 == 0 {
        return Err(exr::error::Error::Invalid("the image has no pixels".into()));
    }
    let channels = ["R", "G", "B"].into_iter().enumerate().map(|(i, name)| {
        let values = image.rgb().iter().map(|rgb| rgb[i]);
        let samples = match samples {
            Samples::Half => FlatSamples::F16(values.map(half).collect()),
            Samples::Float => FlatSamples::F32(values.collect()),
        };
        AnyChannel::new(name, samples)
    });
    let attributes = LayerAttributes {
        white_luminance: Some(image.white_cd_m2() as f32),
        software_name: Some(Text::from_slice_unchecked(software().as_bytes())),
        ..LayerAttributes::default()
    };
    let channels = AnyChannels::sort(channels.collect());
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut file_image = Image::from_layer(layer);
    file_image.attributes.chromaticities = Some(chromaticities(display));
    file_image.write().to_buffered(file)
}

fn chromaticities(display: &Display) -> Chromaticities {
    let point = |[x, y]: [f64; 2]| Vec2(x as f32, y as f32);
    let [red, green, blue] = display.primaries_xy().map(point);
    Chromaticities {
        red,
        green,
        blue,
        white: point(xy_of_xyz(display.white_xyz())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32) -> (LinearImage, Display) {
        let color = |i: u32| [0.3 * i as f32, 0.2, 20.0 / (1 + i) as f32];
        let rgb = (0..width * height).map(color).collect();
        let image = LinearImage::new(width, height, rgb, 8.0).unwrap();
        (image, Display::named("display_p3").unwrap())
    }

    #[test]
    fn light_comes_back_with_its_primaries() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("light.exr");
        let (image, display) = image(9, 4);
        for (samples, tolerance) in [(Samples::Float, 0.0), (Samples::Half, 5e-4)] {
            write(&path, &image, &display, samples).unwrap();
            let read = exr::prelude::read_first_flat_layer_from_file(&path).unwrap();
            let layer = read.layer_data;
            assert_eq!(layer.attributes.white_luminance, Some(8.0));
            let white = read.attributes.chromaticities.unwrap().white;
            assert!((white.0 - 0.3127).abs() < 1e-6 && (white.1 - 0.3290).abs() < 1e-6);
            for (channel, name) in layer.channel_data.list.iter().zip(["B", "G", "R"]) {
                assert_eq!(channel.name, Text::from(name));
                let i = ["R", "G", "B"].iter().position(|&n| n == name).unwrap();
                for (found, expected) in channel.sample_data.values_as_f32().zip(image.rgb()) {
                    let error = (found - expected[i]).abs();
                    assert!(
                        error <= tolerance * expected[i].abs(),
                        "{found} {expected:?}"
                    );
                }
            }
        }
        assert!(
            half(1e9).is_finite() && half(f32::NAN).is_nan() && half(f32::INFINITY).is_infinite()
        );
    }

    #[test]
    fn an_image_without_pixels_leaves_no_file() {
        let directory = tempfile::tempdir().unwrap();
        let (image, display) = image(0, 0);
        let path = directory.path().join("light.exr");
        assert!(write(&path, &image, &display, Samples::Half).is_err());
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
    }

    /// Display P3's red in sRGB, from its definition (SMPTE EG 432-1): 1.2249, −0.0421, −0.0196.
    #[test]
    fn primaries_of_a_file_are_known() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p3.exr");
        let (image, display) = image(2, 1);
        write(&path, &image, &display, Samples::Float).unwrap();
        let primaries = || {
            let file = exr::meta::MetaData::read_from_file(&path, true).unwrap();
            file.headers[0].shared_attributes.chromaticities
        };
        let matrix = primaries::srgb_from(primaries()).unwrap().unwrap();
        for (row, expected) in matrix.iter().zip([1.2249, -0.0421, -0.0196]) {
            assert!((row[0] - expected).abs() < 1e-4, "{matrix:?}");
            // Both have the same white.
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-4);
        }
        let srgb = Display::named("srgb").unwrap();
        write(&path, &image, &srgb, Samples::Float).unwrap();
        assert_eq!(primaries::srgb_from(primaries()), Ok(None));
        assert_eq!(primaries::srgb_from(None), Ok(None));
    }
}
