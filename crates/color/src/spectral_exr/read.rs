//! Reading a spectral image.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::block::reader::Reader;
use rayon::prelude::*;
use spectra::SpectralImage;
use thiserror::Error;

use super::bands::BandLayoutError;
use super::metadata::Metadata;
use super::write::BATCH_BYTES;

mod guard;
mod pixels;
mod plan;

pub use guard::MAX_BYTES;

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
    /// No channel is a radiance (`S0.…`).
    #[error("{path} is an OpenEXR file without emissive spectral channels (`S0.550,000000nm`)")]
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

/// Reads a spectral file: one written by [`write`](super::write()), or another emissive one in the same
/// layout with evenly spaced bands in nm.
///
/// What a file of other origin lacks is filled in: XYZ by summing the bands
/// ([`BandWeights::observed`](crate::BandWeights::observed)), variance and sample count as 0. Polarised components,
/// reflectances and other channels are passed over.
///
/// # Errors
/// When the file cannot be read, is damaged, has no such spectrum, or is larger than its length or
/// this machine's memory can account for.
pub fn read(path: &Path) -> Result<(SpectralImage, Metadata), ReadExrError> {
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
    let plan = Plan::new(&context, reader.headers())?;
    guard::check(&context, reader.headers(), &plan, length)?;
    let metadata = Metadata::of_header(&reader.headers()[plan.layer]);
    let image = pixels(&context, reader, plan)?;
    Ok((image, metadata))
}

/// Whether the file begins with the four bytes of an `OpenEXR` file; leaves it at its start.
fn is_exr(file: &mut File) -> io::Result<bool> {
    let mut magic = Vec::new();
    Read::by_ref(file).take(4).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok(magic == [0x76, 0x2f, 0x31, 0x01])
}

/// Decompresses the blocks, some at a time on all cores, and gathers their pixels.
fn pixels(
    context: &Context<'_>,
    reader: Reader<BufReader<File>>,
    plan: Plan,
) -> Result<SpectralImage, ReadExrError> {
    let meta = reader.meta_data().clone();
    let block_bytes = meta.headers[plan.layer].max_block_byte_size().max(1);
    let at_a_time = (BATCH_BYTES / block_bytes).clamp(1, 2 * rayon::current_num_threads());
    let mut chunks = context.run(|| reader.all_chunks(false))?;
    let mut pixels = Pixels::new(plan);
    loop {
        let batch: Vec<Chunk> = context.run(|| chunks.by_ref().take(at_a_time).collect())?;
        if batch.is_empty() {
            return pixels
                .finish()
                .ok_or_else(|| context.damaged("some pixels are missing"));
        }
        let blocks: Vec<UncompressedBlock> = context.run(|| {
            batch
                .into_par_iter()
                .filter(|chunk| chunk.layer_index == pixels.layer())
                .map(|chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false))
                .collect()
        })?;
        for block in &blocks {
            let channels = &meta.headers[block.index.layer].channels;
            pixels
                .insert(block, channels)
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
