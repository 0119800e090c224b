//! Files from which an interrupted render goes on.
//!
//! | bytes | content |
//! | --- | --- |
//! | 22 | `PELLICLE CHECKPOINT 1\n` |
//! | 8 | length of the header, little endian |
//! | | the header as JSON: what the render is of, its window and its state |
//! | 4 for each pixel | number of samples, `u32` little endian |
//! | 4 or 8 for each value | running means, as `f32` if that holds all of them exactly, otherwise `f64` |
//! | 32 | BLAKE3 digest of everything before |
//!
//! A file appears under its name when it is complete and on the disk, in place of the one before it.

use crate::identity::{Identity, listed};
use picture_file::PendingFile;
use serde::{Deserialize, Serialize};
use spectra::{Accumulation, Window};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

const MAGIC: &[u8] = b"PELLICLE CHECKPOINT 1\n";
/// The longest header that is read.
const MAX_HEADER: u64 = 1 << 28;
/// Values that are converted at a time.
const CHUNK: usize = 1 << 16;

/// Why a checkpoint was not written or not read.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The file could not be opened, written or read.
    #[error("{path}: the checkpoint cannot be {done}")]
    File {
        /// The file.
        path: PathBuf,
        /// `written` or `read`.
        done: &'static str,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file is no checkpoint.
    #[error("{path} is not a checkpoint of this program")]
    Unknown {
        /// The file.
        path: PathBuf,
    },
    /// The file is not what was written.
    #[error("{path}: the checkpoint is damaged: {reason}")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: &'static str,
    },
    /// The checkpoint is of another render.
    #[error("{path} is a checkpoint of another render: it differs in {differences}")]
    Foreign {
        /// The file.
        path: PathBuf,
        /// In what.
        differences: String,
    },
}

/// What a checkpoint says beside its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Header {
    identity: BTreeMap<String, String>,
    origin: [u32; 2],
    size: [u32; 2],
    first_sample: u32,
    values_per_pixel: usize,
    is_f32: bool,
    state: State,
}

/// The state of a render beside its sums.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// The state of the noise estimate.
    pub(crate) noise: Vec<u8>,
    /// The number of samples at which the noise is judged next.
    pub(crate) stop: u32,
    /// The number of samples of each tile; empty if all pixels have as many.
    pub(crate) plan: Vec<u32>,
    /// Whether the CPU has continued what a GPU began.
    pub(crate) is_mixed: bool,
}

/// The identity of a render of a window and of samples from some number on.
fn of_work(identity: &Identity, window: Window, first_sample: u32) -> Identity {
    let mut identity = identity.clone();
    identity.insert("window", window.to_string());
    identity.insert("first_sample", first_sample.to_string());
    identity
}

pub(crate) fn write(
    path: &Path,
    identity: &Identity,
    accumulation: &Accumulation,
    state: &State,
) -> Result<(), CheckpointError> {
    let attempt = || -> io::Result<()> {
        let pending = PendingFile::create(path)?;
        let mut out = Hashing {
            inner: BufWriter::with_capacity(1 << 20, pending.handle()?),
            hasher: blake3::Hasher::new(),
        };
        let (counts, sums) = (accumulation.counts(), accumulation.sums());
        let window = accumulation.window();
        let is_f32 = sums
            .iter()
            .all(|&v| f64::from(v as f32).to_bits() == v.to_bits());
        let header = Header {
            identity: identity.entries().clone(),
            origin: window.origin,
            size: window.size,
            first_sample: accumulation.first_sample(),
            values_per_pixel: accumulation.layout().len(),
            is_f32,
            state: state.clone(),
        };
        let header = serde_json::to_vec(&header)?;
        out.write_all(MAGIC)?;
        out.write_all(&(header.len() as u64).to_le_bytes())?;
        out.write_all(&header)?;
        write_each(&mut out, counts, u32::to_le_bytes)?;
        if is_f32 {
            write_each(&mut out, sums, |sum| (sum as f32).to_le_bytes())?;
        } else {
            write_each(&mut out, sums, f64::to_le_bytes)?;
        }
        let digest = out.hasher.finalize();
        let mut out = out.inner;
        out.write_all(digest.as_bytes())?;
        out.flush()?;
        drop(out);
        pending.commit()
    };
    attempt().map_err(|source| CheckpointError::File {
        path: path.to_owned(),
        done: "written",
        source,
    })
}

/// Reads a checkpoint into an accumulation of the same render.
pub(crate) fn read(
    path: &Path,
    identity: &Identity,
    accumulation: &mut Accumulation,
) -> Result<State, CheckpointError> {
    let reading = Reading { path };
    let mut file = reading.open()?;
    reading.verify(&mut file)?;
    file.rewind().map_err(|error| reading.file(error))?;
    let mut input = BufReader::with_capacity(1 << 20, file);
    let header = reading.header(&mut input)?;
    let window = Window {
        origin: header.origin,
        size: header.size,
    };
    let found = Identity::from_entries(header.identity);
    let found = of_work(&found, window, header.first_sample);
    let wanted = of_work(identity, accumulation.window(), accumulation.first_sample());
    let differences = found.differences(&wanted);
    if !differences.is_empty() {
        return Err(CheckpointError::Foreign {
            path: path.to_owned(),
            differences: listed(&differences),
        });
    }
    if header.values_per_pixel != accumulation.layout().len() {
        return Err(reading.damaged("its values do not fit its bands"));
    }
    let (counts, sums) = accumulation.state_mut();
    let values = read_each(&mut input, counts, u32::from_le_bytes).and_then(|()| {
        if header.is_f32 {
            read_each(&mut input, sums, |bytes| f32::from_le_bytes(bytes).into())
        } else {
            read_each(&mut input, sums, f64::from_le_bytes)
        }
    });
    values.map_err(|error| reading.file(error))?;
    Ok(header.state)
}

/// A file that is being read, for its errors.
struct Reading<'a> {
    path: &'a Path,
}

impl Reading<'_> {
    fn file(&self, source: io::Error) -> CheckpointError {
        if source.kind() == io::ErrorKind::UnexpectedEof {
            return self.damaged("it ends too early");
        }
        CheckpointError::File {
            path: self.path.to_owned(),
            done: "read",
            source,
        }
    }

    fn damaged(&self, reason: &'static str) -> CheckpointError {
        CheckpointError::Damaged {
            path: self.path.to_owned(),
            reason,
        }
    }

    /// Opens a file that begins like a checkpoint.
    fn open(&self) -> Result<File, CheckpointError> {
        let mut file = File::open(self.path).map_err(|error| self.file(error))?;
        let mut magic = Vec::new();
        let mut start = (&mut file).take(MAGIC.len() as u64);
        start.read_to_end(&mut magic).map_err(|e| self.file(e))?;
        if magic == MAGIC {
            Ok(file)
        } else {
            Err(CheckpointError::Unknown {
                path: self.path.to_owned(),
            })
        }
    }

    /// Compares the digest at the end of a file with its content.
    fn verify(&self, file: &mut File) -> Result<(), CheckpointError> {
        let mut verified = || -> io::Result<bool> {
            let length = file.metadata()?.len();
            let Some(content) = length.checked_sub(DIGEST) else {
                return Ok(false);
            };
            file.rewind()?;
            let mut hasher = blake3::Hasher::new();
            io::copy(&mut (&mut *file).take(content), &mut hasher)?;
            let mut digest = [0; DIGEST as usize];
            file.read_exact(&mut digest)?;
            Ok(hasher.finalize() == digest)
        };
        match verified() {
            Ok(true) => Ok(()),
            Ok(false) => Err(self.damaged("its bytes are not those that were written")),
            Err(error) => Err(self.file(error)),
        }
    }

    fn header(&self, input: &mut impl Read) -> Result<Header, CheckpointError> {
        let (mut magic, mut length) = ([0; MAGIC.len()], [0; 8]);
        let starts = input.read_exact(&mut magic);
        starts
            .and_then(|()| input.read_exact(&mut length))
            .map_err(|error| self.file(error))?;
        let length = u64::from_le_bytes(length);
        if length > MAX_HEADER {
            return Err(self.damaged("its header is too long"));
        }
        let mut text = Vec::new();
        let read = input.take(length).read_to_end(&mut text);
        read.map_err(|error| self.file(error))?;
        serde_json::from_slice(&text).map_err(|_| self.damaged("its header cannot be read"))
    }
}

/// Bytes of the digest at the end of a file.
const DIGEST: u64 = 32;

/// A writer that digests what passes.
struct Hashing<W> {
    inner: W,
    hasher: blake3::Hasher,
}

impl<W: Write> Write for Hashing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

fn write_each<T: Copy, const N: usize>(
    out: &mut impl Write,
    values: &[T],
    bytes: impl Fn(T) -> [u8; N],
) -> io::Result<()> {
    let mut buffer = Vec::with_capacity(N * CHUNK);
    for chunk in values.chunks(CHUNK) {
        buffer.clear();
        buffer.extend(chunk.iter().flat_map(|&value| bytes(value)));
        out.write_all(&buffer)?;
    }
    Ok(())
}

fn read_each<T, const N: usize>(
    input: &mut impl Read,
    values: &mut [T],
    value: impl Fn([u8; N]) -> T,
) -> io::Result<()> {
    let mut buffer = vec![0; N * CHUNK];
    for chunk in values.chunks_mut(CHUNK) {
        let bytes = &mut buffer[..N * chunk.len()];
        input.read_exact(bytes)?;
        for (to, bytes) in chunk.iter_mut().zip(bytes.as_chunks().0) {
            *to = value(*bytes);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::{BandGrid, LightGroup};

    const WINDOW: Window = Window {
        origin: [1, 2],
        size: [3, 2],
    };

    fn empty(first_sample: u32) -> Accumulation {
        with_components(first_sample, false)
    }

    fn with_components(first_sample: u32, is_polarized: bool) -> Accumulation {
        let groups = vec![LightGroup::unknown()];
        let bands = BandGrid::visible(4).unwrap();
        Accumulation::new(WINDOW, first_sample, bands, groups, is_polarized)
    }

    fn filled(value: impl Fn(usize) -> f64) -> Accumulation {
        let mut all = empty(0);
        let (counts, sums) = all.state_mut();
        counts.copy_from_slice(&[3, 1, 4, 1, 5, 9]);
        sums.iter_mut()
            .enumerate()
            .for_each(|(i, sum)| *sum = value(i));
        all
    }

    fn identity(seed: &str) -> Identity {
        let entries = [("seed".to_owned(), seed.to_owned())];
        Identity::from_entries(entries.into_iter().collect())
    }

    fn state() -> State {
        State {
            noise: vec![0, 255, 3],
            stop: 16,
            plan: vec![4, 8],
            is_mixed: true,
        }
    }

    #[test]
    fn every_bit_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let mut lengths = Vec::new();
        let values: [fn(usize) -> f64; 2] =
            [|i| (i as f64).sqrt(), |i| f64::from((i as f32).sqrt())];
        for value in values {
            let all = filled(value);
            write(&path, &identity("1"), &all, &state()).unwrap();
            let mut found = empty(0);
            assert_eq!(read(&path, &identity("1"), &mut found).unwrap(), state());
            assert_eq!(found, all);
            lengths.push(std::fs::metadata(&path).unwrap().len());
        }
        let values = filled(|_| 0.0).sums().len() as u64;
        assert_eq!(
            lengths[0] - lengths[1],
            4 * values + 1,
            "false is longer than true"
        );
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn another_render_is_refused_by_what_differs() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        write(&path, &identity("1"), &filled(|i| i as f64), &state()).unwrap();
        let error = read(&path, &identity("2"), &mut empty(0)).unwrap_err();
        let message = error.to_string();
        assert!(
            message.ends_with("differs in seed (1 instead of 2)"),
            "{message}"
        );
        let error = read(&path, &identity("1"), &mut empty(64)).unwrap_err();
        let message = error.to_string();
        assert!(
            message.ends_with("first sample (0 instead of 64)"),
            "{message}"
        );
    }

    #[test]
    fn components_of_polarized_light_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let mut all = with_components(0, true);
        let (counts, sums) = all.state_mut();
        counts.fill(2);
        (0..)
            .zip(sums)
            .for_each(|(i, sum)| *sum = -f64::from(i) / 3.0);
        write(&path, &identity("1"), &all, &state()).unwrap();
        let mut found = with_components(0, true);
        read(&path, &identity("1"), &mut found).unwrap();
        assert_eq!(found, all);
        // A render without them does not go on from it, even if its identity were the same.
        let error = read(&path, &identity("1"), &mut empty(0)).unwrap_err();
        assert!(error.to_string().contains("do not fit"), "{error}");
        let mut polarized = identity("1");
        polarized.insert("polarization", "all components".to_owned());
        let error = read(&path, &polarized, &mut found).unwrap_err();
        let said = "differs in polarization (none instead of all components)";
        assert!(error.to_string().ends_with(said), "{error}");
    }

    /// Any flipped bit, and any missing end.
    #[test]
    fn damage_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        write(&path, &identity("1"), &filled(|i| i as f64), &state()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let refused = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            let mut found = empty(0);
            let error = read(&path, &identity("1"), &mut found).unwrap_err();
            assert_eq!(found, empty(0), "nothing is read of it");
            error
        };
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            let error = refused(&damaged);
            let is_named = match error {
                CheckpointError::Unknown { .. } => at < MAGIC.len(),
                CheckpointError::Damaged { .. } => at >= MAGIC.len(),
                _ => false,
            };
            assert!(is_named, "byte {at}: {error}");
        }
        for length in [0, 5, MAGIC.len(), MAGIC.len() + 20, bytes.len() - 1] {
            refused(&bytes[..length]);
        }
    }
}
