//! Shared code for spectral files and color files: opening, errors, checks of header claims, blocks, windows.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::block::lines::LineRef;
use exr::block::reader::Reader;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use exr::prelude::{Compression, f16};

mod blocks;
pub(crate) mod digest;
mod error;
pub(crate) mod guard;
mod window;

pub use blocks::BATCH_BYTES;
pub(crate) use blocks::{blocks_at_a_time, each_block, each_block_within};
pub use error::{BandLayoutError, ReadExrError};
pub use guard::MAX_BYTES;
pub(crate) use window::{Run, Window};

/// The most names that a message lists.
const MAX_LISTED: usize = 24;

/// Opens a file and reads its header. Returns the reader and the file's length in bytes. The header's claims are checked by
/// [`guard::check`].
pub(crate) fn open(path: &Path) -> Result<(Reader<BufReader<File>>, u64), ReadExrError> {
    let (file, length) = open_file(path)?;
    Ok((reader(&Context { path }, file)?, length))
}

/// Opens a file and checks that its form is supported. Returns the file's length in bytes too.
pub(crate) fn open_file(path: &Path) -> Result<(File, u64), ReadExrError> {
    let context = Context { path };
    let mut file = File::open(path).map_err(|error| context.file(error))?;
    let metadata = file.metadata().map_err(|error| context.file(error))?;
    if !is_exr(&mut file).map_err(|error| context.file(error))? {
        return Err(ReadExrError::NotExr {
            path: path.to_owned(),
        });
    }
    let buffered = BufReader::new(&file);
    let claimed = context.run(|| MetaData::read_from_buffered(buffered, true))?;
    check_form(&context, &claimed.headers)?;
    Ok((file, metadata.len()))
}

/// Reads the header of an open file from its start.
pub(crate) fn reader(
    context: &Context<'_>,
    mut file: File,
) -> Result<Reader<BufReader<File>>, ReadExrError> {
    file.rewind().map_err(|error| context.file(error))?;
    context.run(|| exr::block::read(BufReader::new(file), false))
}

/// Rejects data that the decoder does not support, with an error that names it.
fn check_form(context: &Context<'_>, headers: &[Header]) -> Result<(), ReadExrError> {
    if headers.iter().any(|header| header.deep) {
        return Err(context.unsupported("deep data, that is several samples per pixel"));
    }
    let channels = || headers.iter().flat_map(|header| &header.channels.list);
    let coarse = channels().filter(|channel| channel.sampling != Vec2(1, 1));
    let coarse: Vec<String> = coarse
        .map(|channel| name_of(channel.name.as_slice()))
        .collect();
    if !coarse.is_empty() {
        let all: Vec<String> = channels().map(|c| name_of(c.name.as_slice())).collect();
        return Err(context.unsupported(&format!(
            "channels with fewer samples than pixels ({}), as for luminance and chroma; write it with one sample per pixel, \
             as R, G and B; its channels are {}",
            listed(&coarse),
            listed(&all)
        )));
    }
    let unknown = headers.iter().map(|header| header.compression);
    let mut unknown = unknown.filter(|c| matches!(c, Compression::HTJ2K32 | Compression::HTJ2K256));
    match unknown.next() {
        Some(compression) => Err(context.unsupported(&format!(
            "compression {compression:?}; write it with ZIP or PIZ"
        ))),
        None => Ok(()),
    }
}

/// Whether the file begins with the four bytes of an `OpenEXR` file. The file is left at its start.
fn is_exr(file: &mut File) -> io::Result<bool> {
    let mut magic = Vec::new();
    Read::by_ref(file).take(4).read_to_end(&mut magic)?;
    file.rewind()?;
    Ok(magic == [0x76, 0x2f, 0x31, 0x01])
}

/// Returns the name of a channel or part, with invalid UTF-8 replaced.
pub(crate) fn name_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Lists names in quotation marks, with control characters escaped; of many names the first ones and the number of the others.
pub(crate) fn listed(names: &[String]) -> String {
    let shown = names.iter().take(MAX_LISTED);
    let shown: Vec<String> = shown.map(|name| format!("{name:?}")).collect();
    match names.len().saturating_sub(MAX_LISTED) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// Calls `put` with the index and value of `count` samples of a line, after the first `skip`.
pub(crate) fn each_sample(
    line: LineRef<'_>,
    kind: SampleType,
    (skip, count): (usize, usize),
    mut put: impl FnMut(usize, f32),
) {
    let samples = words(line.value).skip(skip).take(count).enumerate();
    match kind {
        SampleType::F32 => samples.for_each(|(x, bytes)| put(x, f32::from_ne_bytes(bytes))),
        SampleType::U32 => samples.for_each(|(x, bytes)| put(x, u32::from_ne_bytes(bytes) as f32)),
        SampleType::F16 => {
            let halves = line.value.chunks_exact(2).skip(skip).take(count);
            halves
                .enumerate()
                .for_each(|(x, b)| put(x, f16::from_ne_bytes([b[0], b[1]]).to_f32()));
        }
    }
}

/// Returns the four-byte samples of a line.
pub(crate) fn words(bytes: &[u8]) -> impl Iterator<Item = [u8; 4]> + '_ {
    bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]])
}

/// The file being read, for its errors.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) path: &'a Path,
}

impl Context<'_> {
    pub(crate) fn damaged(&self, reason: &str) -> ReadExrError {
        ReadExrError::Damaged {
            path: self.path.to_owned(),
            reason: reason.to_owned(),
        }
    }

    pub(crate) fn file(&self, source: io::Error) -> ReadExrError {
        ReadExrError::File {
            path: self.path.to_owned(),
            source,
        }
    }

    pub(crate) fn unsupported(&self, reason: &str) -> ReadExrError {
        ReadExrError::Unsupported {
            path: self.path.to_owned(),
            reason: reason.to_owned(),
        }
    }

    /// Runs a step of the decoder. Some damage makes the decoder panic, which becomes an error here.
    pub(crate) fn run<T>(
        &self,
        step: impl FnOnce() -> exr::error::Result<T>,
    ) -> Result<T, ReadExrError> {
        use exr::error::Error;
        match catch_unwind(AssertUnwindSafe(step)) {
            Ok(Ok(value)) => Ok(value),
            Ok(Err(Error::Io(source))) => Err(self.file(source)),
            Ok(Err(Error::NotSupported(reason))) => Err(self.unsupported(&reason)),
            Ok(Err(Error::Invalid(reason))) => Err(self.damaged(&reason)),
            Ok(Err(Error::Aborted)) => Err(self.damaged("reading was interrupted")),
            Err(_) => Err(self.damaged("the decoder failed")),
        }
    }
}
