//! Pictures to compare, and their color differences.

use std::fs::File;
use std::hash::{DefaultHasher, Hasher};
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use colorimetry::lab::delta_e_2000;
use colorimetry::{Lab, srgb};
use rayon::prelude::*;
use thiserror::Error;

use super::{CompareError, check_sizes};
use picture_file::RgbImage8;
use picture_file::icc;
use relight::XyzImage;
use relight::xyz::exposure_scale;

/// A picture in linear sRGB, not clipped, with row 0 at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    size: [usize; 2],
    linear: Vec<[f64; 3]>,
    tag: Option<String>,
}

/// Why a picture could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadPictureError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file is not a PNG file, or is damaged.
    #[error("{path} is not a PNG file that can be read")]
    Decode {
        /// The file.
        path: PathBuf,
        /// The error of the decoder.
        source: ::png::DecodingError,
    },
}

impl Picture {
    /// Creates a picture from sRGB codes.
    pub fn of_codes(image: &RgbImage8) -> Self {
        let pixels = image.data().chunks_exact(3);
        Self {
            size: [image.width() as usize, image.height() as usize],
            linear: pixels
                .map(|p| [p[0], p[1], p[2]].map(srgb::from_u8))
                .collect(),
            tag: None,
        }
    }

    /// Creates a picture from an image's XYZ at an exposure in stops, neither adapted nor clipped.
    pub fn of_colors(image: &XyzImage, exposure_ev: f64) -> Self {
        let scale = exposure_scale(exposure_ev);
        let rgb = |xyz: &[f32; 3]| srgb::linear_from_xyz(xyz.map(|value| f64::from(value) * scale));
        let linear = image.xyz().par_iter().map(rgb);
        Self {
            size: [image.width() as usize, image.height() as usize],
            linear: linear.collect(),
            tag: None,
        }
    }

    /// Reads a PNG file of 1 to 16 bits. Its codes are taken as sRGB, whatever its tags say; transparency is ignored.
    ///
    /// # Errors
    /// When the file cannot be read or is not a PNG file.
    pub fn read_png(path: &Path) -> Result<Self, ReadPictureError> {
        let file = File::open(path).map_err(|source| ReadPictureError::File {
            path: path.to_owned(),
            source,
        })?;
        decode(BufReader::new(file)).map_err(|source| ReadPictureError::Decode {
            path: path.to_owned(),
            source,
        })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Linear sRGB of each pixel, row by row.
    pub fn linear(&self) -> &[[f64; 3]] {
        &self.linear
    }

    /// The color space that the file names, if it is not sRGB. Files with different ICC profiles have different tags.
    pub fn tag(&self) -> Option<&str> {
        self.tag.as_deref()
    }

    /// The pixels as an sRGB display shows them: clipped, with 0 for NaN.
    pub(super) fn shown(&self) -> impl Iterator<Item = [f64; 3]> {
        let shown = |v: f64| if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) };
        self.linear.iter().map(move |rgb| rgb.map(shown))
    }

    pub(super) fn check_alike(&self, other: &Self) -> Result<(), CompareError> {
        check_sizes(self.size, other.size)?;
        if self.linear.is_empty() {
            return Err(CompareError::Empty);
        }
        Ok(())
    }
}

/// The largest factor by which decompression lengthens a stream (RFC 1951: 258 bytes from two bits).
const MAX_INFLATION: u64 = 1032;

fn decode(file: BufReader<File>) -> Result<Picture, ::png::DecodingError> {
    let length = file
        .get_ref()
        .metadata()
        .map_or(0, |metadata| metadata.len());
    let mut decoder = ::png::Decoder::new(file);
    decoder.set_transformations(::png::Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    if reader.info().raw_bytes() as u64 > length.saturating_mul(MAX_INFLATION) {
        return Err(too_large());
    }
    let bytes = reader.output_buffer_size().ok_or_else(too_large)?;
    let mut data = Vec::new();
    data.try_reserve_exact(bytes).map_err(|_| too_large())?;
    data.resize(bytes, 0);
    let frame = reader.next_frame(&mut data)?;
    let tag = tag(reader.info());
    let values: Vec<f64> = match frame.bit_depth {
        ::png::BitDepth::Sixteen => {
            let pairs = data.chunks_exact(2);
            pairs
                .map(|b| f64::from(u16::from_be_bytes([b[0], b[1]])) / 65535.0)
                .collect()
        }
        _ => data.iter().map(|&code| f64::from(code) / 255.0).collect(),
    };
    let samples = frame.color_type.samples();
    let rgb = |pixel: &[f64]| match samples {
        1 | 2 => [pixel[0]; 3],
        _ => [pixel[0], pixel[1], pixel[2]],
    };
    let pixels = frame.width as usize * frame.height as usize;
    Ok(Picture {
        size: [frame.width as usize, frame.height as usize],
        linear: values
            .chunks_exact(samples)
            .take(pixels)
            .map(|pixel| rgb(pixel).map(srgb::decode))
            .collect(),
        tag,
    })
}

fn too_large() -> ::png::DecodingError {
    ::png::DecodingError::LimitsExceeded
}

/// Returns the color space that a file names, if it is not sRGB. If there are several chunks, the one with the highest
/// precedence counts (PNG specification, third edition, section 4.3).
fn tag(info: &::png::Info<'_>) -> Option<String> {
    if let Some(points) = &info.coding_independent_code_points {
        let (primaries, curve) = (points.color_primaries, points.transfer_function);
        let is_srgb = (primaries, curve) == (1, 13);
        return (!is_srgb)
            .then(|| format!("cICP primaries {primaries}, transfer function {curve}"));
    }
    match (&info.icc_profile, info.srgb) {
        (Some(profile), None) => Some(icc_tag(profile)),
        _ => None,
    }
}

/// A profile's name, its size, and a hash that distinguishes it from others of the same name.
fn icc_tag(profile: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    hasher.write(profile);
    let name = icc::description(profile).map_or_else(String::new, |name| format!(" {name:?}"));
    let (bytes, hash) = (profile.len(), hasher.finish());
    format!("an ICC profile{name} of {bytes} bytes (hash {hash:016x})")
}

/// Returns the color difference ΔE₀₀ at each pixel, from CIELAB under the white of sRGB, colors outside the gamut included; NaN
/// where a color is not finite.
///
/// # Errors
/// When the pictures differ in size or are empty.
pub fn delta_e(reference: &Picture, test: &Picture) -> Result<Vec<f64>, CompareError> {
    reference.check_alike(test)?;
    let white = srgb::white_xyz();
    let lab = |&linear: &[f64; 3]| Lab::from_xyz(srgb::xyz_from_linear(linear), white);
    let pairs = reference.linear.par_iter().zip(&test.linear);
    let of_pair = |(a, b): (&[f64; 3], &[f64; 3])| {
        let is_finite = a.iter().chain(b).all(|v| v.is_finite());
        if is_finite {
            delta_e_2000(lab(a), lab(b))
        } else {
            f64::NAN
        }
    };
    Ok(pairs.map(of_pair).collect())
}

/// Returns the peak signal-to-noise ratio of the pictures' sRGB codes, −10 log₁₀ of the mean squared difference of codes from 0
/// to 1, in dB; infinite for equal pictures.
///
/// # Errors
/// When the pictures differ in size or are empty.
pub fn psnr(reference: &Picture, test: &Picture) -> Result<f64, CompareError> {
    reference.check_alike(test)?;
    let squared = |(a, b): ([f64; 3], [f64; 3])| -> f64 {
        let pairs = a.map(srgb::encode).into_iter().zip(b.map(srgb::encode));
        pairs.map(|(a, b)| (a - b).powi(2)).sum()
    };
    let sum: f64 = reference.shown().zip(test.shown()).map(squared).sum();
    let values = 3 * reference.linear.len();
    Ok(-10.0 * (sum / values as f64).log10())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(code: u8) -> Picture {
        Picture::of_codes(&RgbImage8::new(4, 3, vec![code; 36]).unwrap())
    }

    #[test]
    fn equal_pictures_do_not_differ() {
        let gray = gray(90);
        assert_eq!(delta_e(&gray, &gray).unwrap(), [0.0; 12]);
        assert_eq!(psnr(&gray, &gray).unwrap(), f64::INFINITY);
    }

    /// Black and white differ by 1 in every code, and by L* = 100 with S_L = 1 + 0.015·0/√20 = 1.
    #[test]
    fn black_and_white_differ_as_computed_by_hand() {
        let (black, white) = (gray(0), gray(255));
        assert!(psnr(&black, &white).unwrap().abs() < 1e-9);
        for found in delta_e(&black, &white).unwrap() {
            assert!((found - 100.0).abs() < 1e-6, "{found}");
        }
        // A step of one code: 20 log10(255).
        let step = psnr(&gray(100), &gray(101)).unwrap();
        assert!((step - 48.130_803_6).abs() < 1e-6, "{step}");
    }

    #[test]
    fn one_pixel_that_differs_is_found() {
        let mut codes = vec![100; 36];
        codes[3 * 7] = 140;
        let other = Picture::of_codes(&RgbImage8::new(4, 3, codes).unwrap());
        let found = delta_e(&gray(100), &other).unwrap();
        for (index, value) in found.into_iter().enumerate() {
            assert_eq!(value > 5.0, index == 7, "{index}: {value}");
        }
        assert!(psnr(&gray(100), &other).unwrap() < 40.0);
    }

    #[test]
    fn what_is_not_a_number_is_reported() {
        let mut other = gray(100);
        other.linear[2] = [f64::NAN, 0.1, f64::INFINITY];
        let found = delta_e(&gray(100), &other).unwrap();
        assert!(found[2].is_nan() && found[3] == 0.0);
        assert!(psnr(&gray(100), &other).unwrap().is_finite());
        assert!(super::super::flip(&gray(100), &other).unwrap()[0].is_finite());
    }

    #[test]
    fn pictures_of_different_sizes_do_not_compare() {
        let wide = Picture::of_codes(&RgbImage8::new(6, 2, vec![0; 36]).unwrap());
        assert!(delta_e(&gray(0), &wide).is_err() && psnr(&gray(0), &wide).is_err());
    }

    #[test]
    fn png_files_of_any_depth_are_read() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture.png");
        picture_file::png::write(&path, &RgbImage8::new(4, 3, (0..36).collect()).unwrap()).unwrap();
        let found = Picture::read_png(&path).unwrap();
        assert_eq!(found.linear()[1], [3, 4, 5].map(srgb::from_u8));
        assert_eq!((found.size(), found.tag()), ([4, 3], None));

        let mut encoder = ::png::Encoder::new(File::create(&path).unwrap(), 2, 1);
        encoder.set_color(::png::ColorType::GrayscaleAlpha);
        encoder.set_depth(::png::BitDepth::Sixteen);
        let mut writer = encoder.write_header().unwrap();
        writer
            .write_chunk(::png::chunk::ChunkType(*b"cICP"), &[12, 13, 0, 1])
            .unwrap();
        writer
            .write_image_data(&[0xff, 0xff, 0, 0, 0x80, 0x00, 0, 0])
            .unwrap();
        writer.finish().unwrap();
        let found = Picture::read_png(&path).unwrap();
        assert_eq!(found.linear()[0], [1.0; 3]);
        assert!((found.linear()[1][0] - srgb::decode(32768.0 / 65535.0)).abs() < 1e-15);
        assert!(found.tag().unwrap().contains("primaries 12"));

        // Profiles of the same length and name: one byte of a curve differs.
        let profile = icc::profile(&colorimetry::Display::named("lcd").unwrap()).unwrap();
        let tag_with = |profile: &[u8]| {
            let mut info = ::png::Info::with_size(1, 1);
            info.icc_profile = Some(profile.to_vec().into());
            let file = File::create(&path).unwrap();
            let mut writer = ::png::Encoder::with_info(file, info)
                .unwrap()
                .write_header()
                .unwrap();
            writer.write_image_data(&[0]).unwrap();
            writer.finish().unwrap();
            Picture::read_png(&path).unwrap().tag().unwrap().to_owned()
        };
        let mut other = profile.clone();
        *other.last_mut().unwrap() ^= 1;
        assert_eq!(tag_with(&profile), tag_with(&profile));
        assert_ne!(tag_with(&profile), tag_with(&other));
        assert!(tag_with(&profile).starts_with("an ICC profile \"lcd\" of "));
        assert!(tag_with(b"no profile").starts_with("an ICC profile of 10 bytes"));

        std::fs::write(&path, "no picture").unwrap();
        assert!(Picture::read_png(&path).is_err());
    }
}
