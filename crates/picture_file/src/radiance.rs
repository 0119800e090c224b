//! Radiance pictures (`.hdr`, `.pic`): colors of light with a shared exponent.
//!
//! A pixel is three mantissas and an exponent (G. Ward, *Real Pixels*, Graphics Gems II, 1991): m · 2^(e − 136). Radiance's own programs
//! add half a code to the mantissas, since they round down when they write. Like most programs, this reader does not.
//!
//! The operations that the header records are undone: the pixels are divided by the product of all `EXPOSURE` lines, and each channel by
//! the product of all `COLORCORR` lines. `PRIMARIES` other than those of sRGB, and XYZ (`32-bit_rle_xyze`), become linear red, green and
//! blue of sRGB without chromatic adaptation, so colors are unchanged. Without `PRIMARIES`, the primaries of sRGB are assumed, as most
//! programs write them (Radiance's own are 0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333). Y = 1 of XYZ is the luminance of (1, 1, 1);
//! Radiance's programs write Y in cd/m², which is 179 times the values that they write in red, green and blue. Lines that begin with a
//! blank belong to the pictures from which this one was made, and are ignored.

mod header;
mod scanlines;
#[cfg(test)]
mod tests;

use colorimetry::matrix::times;
use thiserror::Error;

use header::Header;
use scanlines::Scanlines;

/// Why a file cannot be used as a Radiance picture.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RadianceError {
    /// It does not begin with `#?`.
    #[error("is not a Radiance picture: it does not begin with #?RADIANCE or #?RGBE")]
    NotRadiance,
    /// The header has no end.
    #[error(
        "is cut short or not a Radiance picture: there is no empty line at the end of its header of at most 64 KiB"
    )]
    NoEnd,
    /// A line of the header cannot be used.
    #[error("line {line} of its header, {found:?}, {problem}")]
    Line {
        /// The line, counted from 1.
        line: usize,
        /// The text of the line.
        found: String,
        /// What is wrong, and what would be right.
        problem: &'static str,
    },
    /// The product of the exposures is not a valid divisor.
    #[error(
        "the EXPOSURE and COLORCORR lines of its header multiply to {0:?}, by which pixels cannot be divided"
    )]
    Divisor([f64; 3]),
    /// After the division by the exposures, a pixel does not fit an `f32`.
    #[error(
        "divided by its EXPOSURE and COLORCORR, a pixel of scanline {scanline} is larger than a 32-bit float can hold"
    )]
    Overflow {
        /// The scanline of the file, counted from 1.
        scanline: u32,
    },
    /// There are no pixels.
    #[error("has {width} × {height} pixels: it is empty")]
    Empty {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The file ends too early.
    #[error("is cut short: it ends in scanline {scanline} of {of}")]
    CutShort {
        /// The scanline, counted from 1.
        scanline: u32,
        /// The number of scanlines.
        of: u32,
    },
    /// The pixels are damaged.
    #[error("is damaged: scanline {scanline} of {of} {problem}")]
    Damaged {
        /// The scanline, counted from 1.
        scanline: u32,
        /// The number of scanlines.
        of: u32,
        /// What is wrong.
        problem: &'static str,
    },
}

/// A Radiance picture whose header has been read.
#[derive(Debug)]
pub struct RadiancePicture<'a> {
    header: Header,
    data: &'a [u8],
}

/// Whether a file with this beginning is, or claims to be, a Radiance picture.
pub fn is_radiance(start: &[u8]) -> bool {
    start.starts_with(b"#?")
}

impl<'a> RadiancePicture<'a> {
    /// Reads the header.
    ///
    /// # Errors
    /// When it is not a valid header.
    pub fn new(file: &'a [u8]) -> Result<Self, RadianceError> {
        let (header, length) = Header::read(file)?;
        let data = file.get(length..).unwrap_or_default();
        Ok(Self { header, data })
    }

    /// Width in pixels of the picture when it is upright.
    pub fn width(&self) -> u32 {
        self.header.layout.width
    }

    /// Height in pixels of the picture when it is upright.
    pub fn height(&self) -> u32 {
        self.header.layout.height
    }

    /// The operations done because of the header, and the assumptions made, one line each.
    pub fn notes(&self) -> &[String] {
        &self.header.notes
    }

    /// Returns linear red, green and blue of the primaries of sRGB, row by row from the top, each from the left.
    ///
    /// Twelve bytes per pixel are allocated once the file is known to hold all pixels; check [`Self::width`] and [`Self::height`] first.
    ///
    /// # Errors
    /// When the file is cut short or damaged.
    pub fn pixels(&self) -> Result<Vec<[f32; 3]>, RadianceError> {
        let layout = &self.header.layout;
        let mut scanlines = Scanlines::new(self.data, layout);
        while scanlines.next()?.is_some() {}

        let linear = Linear::new(&self.header);
        let mut pixels = vec![[0.0; 3]; layout.width as usize * layout.height as usize];
        let mut scanlines = Scanlines::new(self.data, layout);
        while let Some((scanline, rgbe)) = scanlines.next()? {
            for (along, &rgbe) in rgbe.iter().enumerate() {
                if let Some(pixel) = pixels.get_mut(layout.place(scanline, along as u32)) {
                    *pixel = linear.of(rgbe);
                    if !pixel.iter().all(|value| value.is_finite()) {
                        return Err(RadianceError::Overflow {
                            scanline: scanline + 1,
                        });
                    }
                }
            }
        }
        Ok(pixels)
    }
}

/// The conversion from the bytes of a pixel to linear red, green and blue.
struct Linear<'a> {
    /// 2^(e − 136) for each e; 0 for e = 0.
    scales: Vec<f32>,
    header: &'a Header,
}

impl<'a> Linear<'a> {
    fn new(header: &'a Header) -> Self {
        let scale = |e: i32| {
            if e == 0 {
                0.0
            } else {
                2.0_f64.powi(e - 136) as f32
            }
        };
        Self {
            scales: (0..256).map(scale).collect(),
            header,
        }
    }

    fn of(&self, [r, g, b, e]: [u8; 4]) -> [f32; 3] {
        let scale = self.scales[usize::from(e)];
        let own = [r, g, b].map(|mantissa| f32::from(mantissa) * scale);
        match &self.header.to_linear {
            None => own,
            Some(matrix) => times(matrix, own.map(f64::from)).map(|value| value as f32),
        }
    }
}
