//! Reading a spectral image.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::block::reader::Reader;
use exr::meta::attribute::ChannelList;
use rayon::prelude::*;
use spectra::{BandGrid, SpectralImage};
use thiserror::Error;

use super::bands::BandLayoutError;
use super::metadata::Metadata;
use super::write::blocks_at_a_time;
use crate::XyzImage;

mod colours;
mod guard;
mod pixels;
mod plan;

pub use guard::MAX_BYTES;

use colours::Colours;
use pixels::Pixels;
use plan::Plan;

/// Why a spectral file was not read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadExrError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file does not begin as an `OpenEXR` file does.
    #[error("{path} is not an OpenEXR file")]
    NotExr {
        /// The file.
        path: PathBuf,
    },
    /// The file is cut short or contradicts itself.
    #[error("{path} is damaged or cut short: {reason}")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What was found wrong.
        reason: String,
    },
    /// The file may be sound, but has a form that is not read here.
    #[error("{path} has a form that is not supported: {reason}")]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// Which form.
        reason: String,
    },
    /// No channel is spectral.
    #[error("{path} is an OpenEXR file without spectral channels (`S0.550,000000nm`)")]
    NoSpectrum {
        /// The file.
        path: PathBuf,
    },
    /// The spectral channels make no band grid.
    #[error("the spectral channels of {path} cannot be used")]
    Bands {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: BandLayoutError,
    },
    /// The image would take more memory than [`MAX_BYTES`] or than there is.
    #[error(
        "{path} holds an image of {width}×{height} pixels and {bands} bands, too large to read"
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// Number of bands.
        bands: usize,
    },
}

/// Reads a spectral file: one written by [`write`](super::write()), or one of other origin in the same layout.
///
/// The bands of others may have any widths. Each is taken as constant from half way to its neighbour on one side to half way
/// on the other, as the layout has it; where the widths differ, the bands are read onto even ones as narrow as the narrowest
/// (1024 at most), which keeps the integral over wavelength. Bands beyond 360 to 830 nm are left out, and one that reaches over
/// an end from where people see (380 to 780 nm) is cut there.
///
/// What a file of other origin lacks is filled in: XYZ by summing the bands
/// ([`BandWeights::observed`](crate::BandWeights::observed)), variance and sample count as 0. Reflectances are taken as lit by a radiance of
/// 1, where there is no radiance in the file. Polarised components, light emitted at another wavelength than it was absorbed at,
/// and other channels are passed over. What was assumed or changed is in the metadata's notes.
///
/// # Errors
/// When the file cannot be read, is damaged, has no such spectrum, or is larger than its length or
/// this machine's memory can account for.
pub fn read(path: &Path) -> Result<(SpectralImage, Metadata), ReadExrError> {
    let (reader, plan, metadata) = open(path)?;
    Ok((pixels(&Context { path }, reader, plan)?, metadata))
}

/// How large the image of a spectral file is: width and height in pixels, and its bands. Its pixels are not read.
///
/// # Errors
/// As [`read`], but for what is wrong with pixels.
pub fn read_size(path: &Path) -> Result<([u32; 2], BandGrid), ReadExrError> {
    let (_, plan, _) = open(path)?;
    // Sides that memory holds, which has been looked at.
    let side = |side| u32::try_from(side).unwrap_or(u32::MAX);
    Ok(([side(plan.size.0), side(plan.size.1)], plan.grid))
}

/// Reads the colours of a spectral file, without its spectra: the same XYZ as [`read`] gives, sooner.
///
/// # Errors
/// As [`read`].
pub fn read_xyz(path: &Path) -> Result<(XyzImage, Metadata), ReadExrError> {
    let (reader, plan, metadata) = open(path)?;
    let context = Context { path };
    let image = if plan.has_xyz() {
        let mut colours = Colours::new(&plan);
        each_block(&context, reader, plan.layer, |block, channels| {
            colours.insert(&plan, block, channels)
        })?;
        colours.finish()
    } else {
        Some(XyzImage::from(&pixels(&context, reader, plan)?))
    };
    let missing = || context.damaged("some pixels are missing");
    Ok((image.ok_or_else(missing)?, metadata))
}

/// Opens a file and reads what its header says, which is checked.
fn open(path: &Path) -> Result<(Reader<BufReader<File>>, Plan, Metadata), ReadExrError> {
    let file_error = |source| ReadExrError::File {
        path: path.to_owned(),
        source,
    };
    let mut file = File::open(path).map_err(file_error)?;
    let length = file.metadata().map_err(file_error)?.len();
    if !is_exr(&mut file).map_err(file_error)? {
        return Err(ReadExrError::NotExr {
            path: path.to_owned(),
        });
    }
    let context = Context { path };
    let reader = context.run(|| exr::block::read(BufReader::new(file), false))?;
    let (plan, metadata) = Plan::new(&context, reader.headers())?;
    guard::check(&context, reader.headers(), &plan, length)?;
    Ok((reader, plan, metadata))
}

/// Whether the file begins with the four bytes of an `OpenEXR` file; leaves it at its start.
fn is_exr(file: &mut File) -> io::Result<bool> {
    let mut magic = Vec::new();
    Read::by_ref(file).take(4).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok(magic == [0x76, 0x2f, 0x31, 0x01])
}

/// The whole image.
fn pixels(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    plan: Plan,
) -> Result<SpectralImage, ReadExrError> {
    let mut pixels = Pixels::new(plan);
    each_block(context, reader, pixels.layer(), |block, channels| {
        pixels.insert(block, channels)
    })?;
    pixels
        .finish()
        .ok_or_else(|| context.damaged("some pixels are missing"))
}

/// Decompresses the blocks of a layer, some at a time on all cores, and hands them on in order.
fn each_block(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    layer: usize,
    mut insert: impl FnMut(&UncompressedBlock, &ChannelList) -> Option<()>,
) -> Result<(), ReadExrError> {
    let meta = reader.meta_data().clone();
    let at_a_time = blocks_at_a_time(meta.headers[layer].max_block_byte_size());
    let channels = &meta.headers[layer].channels;
    let mut chunks = context.run(|| reader.all_chunks(false))?;
    loop {
        let batch: Vec<Chunk> = context.run(|| chunks.by_ref().take(at_a_time).collect())?;
        if batch.is_empty() {
            return Ok(());
        }
        let blocks: Vec<UncompressedBlock> = context.run(|| {
            batch
                .into_par_iter()
                .filter(|chunk| chunk.layer_index == layer)
                .map(|chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false))
                .collect()
        })?;
        for block in &blocks {
            insert(block, channels)
                .ok_or_else(|| context.damaged("a block lies outside the image"))?;
        }
    }
}

/// The file being read, for its errors.
#[derive(Clone, Copy)]
struct Context<'a> {
    path: &'a Path,
}

impl Context<'_> {
    fn damaged(&self, reason: &str) -> ReadExrError {
        ReadExrError::Damaged {
            path: self.path.to_owned(),
            reason: reason.to_owned(),
        }
    }

    fn unsupported(&self, reason: &str) -> ReadExrError {
        ReadExrError::Unsupported {
            path: self.path.to_owned(),
            reason: reason.to_owned(),
        }
    }

    /// Runs a step of the decoder. Some damage makes the decoder panic: here that is an error too.
    fn run<T>(&self, step: impl FnOnce() -> exr::error::Result<T>) -> Result<T, ReadExrError> {
        use exr::error::Error;
        match catch_unwind(AssertUnwindSafe(step)) {
            Ok(Ok(value)) => Ok(value),
            Ok(Err(Error::Io(source))) => Err(ReadExrError::File {
                path: self.path.to_owned(),
                source,
            }),
            Ok(Err(Error::NotSupported(reason))) => Err(self.unsupported(&reason)),
            Ok(Err(Error::Invalid(reason))) => Err(self.damaged(&reason)),
            Ok(Err(Error::Aborted)) => Err(self.damaged("reading was broken off")),
            Err(_) => Err(self.damaged("the decoder gave up")),
        }
    }
}
