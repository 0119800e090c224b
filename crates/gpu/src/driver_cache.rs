//! The driver's compiled code, kept on disk.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The variable for the folder of the drivers' caches; empty for none.
const FOLDER_VARIABLE: &str = "PELLICLE_CACHE_DIR";

/// A larger cache is discarded.
const MAX_BYTES: usize = 64 << 20;

/// How long a device waits before it writes its cache again: a device that creates many pipelines writes them together.
const PAUSE: Duration = Duration::from_secs(10);

/// The driver's compiled code for the shaders of this and earlier runs, in a file for each adapter. A file that cannot be read or
/// written is not an error: the driver compiles again.
#[derive(Debug)]
pub(crate) struct DriverCache {
    pub(crate) cache: wgpu::PipelineCache,
    file: PathBuf,
    written: Mutex<Written>,
}

/// What a device knows about its file.
#[derive(Debug, Default)]
struct Written {
    /// The checksum of the data that it last read or wrote.
    checksum: Option<u64>,
    /// When it last checked for new data to write.
    at: Option<Instant>,
}

impl DriverCache {
    /// Opens the cache of an adapter, if its driver exposes its compiled code and the user has a cache folder.
    pub(crate) fn open(device: &wgpu::Device, info: &wgpu::AdapterInfo) -> Option<Self> {
        if !device.features().contains(wgpu::Features::PIPELINE_CACHE) {
            return None;
        }
        let folder = cache_folder(|variable| std::env::var_os(variable))?;
        let file = folder.join(wgpu::util::pipeline_cache_key(info)?);
        let content = read_at_most(&file, MAX_BYTES);
        let data = content.as_deref().and_then(data_of);
        Some(Self {
            cache: cache_of(device, data),
            file,
            written: Mutex::new(Written {
                checksum: data.map(checksum),
                at: None,
            }),
        })
    }

    /// Writes new data, if it has not looked for any lately.
    pub(crate) fn save_now_and_then(&self) {
        let mut written = self.written.lock().unwrap_or_else(PoisonError::into_inner);
        if written.at.is_none_or(|at| at.elapsed() > PAUSE) {
            self.save(&mut written);
        }
    }

    /// Writes new data.
    fn save(&self, written: &mut Written) {
        // A folder that cannot be written to is not tried again for every pipeline.
        written.at = Some(Instant::now());
        let Some(data) = self.cache.get_data() else {
            return;
        };
        let sum = checksum(&data);
        if written.checksum == Some(sum) {
            return;
        }
        let done = if data.len() > MAX_BYTES {
            fs::remove_file(&self.file)
        } else {
            replace(&self.file, &[header(&data).as_bytes(), &data])
        };
        written.checksum = done.ok().map(|()| sum);
    }
}

impl Drop for DriverCache {
    fn drop(&mut self) {
        let written = self.written.get_mut();
        let mut written = std::mem::take(written.unwrap_or_else(PoisonError::into_inner));
        // Without a pipeline there is no new data.
        if written.at.is_some() {
            self.save(&mut written);
        }
    }
}

/// Returns a cache that starts with this data, or empty.
#[allow(unsafe_code)] // wgpu has no other way to make one.
fn cache_of(device: &wgpu::Device, data: Option<&[u8]>) -> wgpu::PipelineCache {
    let descriptor = wgpu::PipelineCacheDescriptor {
        label: Some("pipelines"),
        data,
        fallback: true,
    };
    // SAFETY: data must come from `PipelineCache::get_data`. `data_of` returns only data that `save`, of the same version, obtained
    // from there and wrote: the length and the checksum are those of that time. wgpu itself compares the adapter and its driver
    // with those of the data, and starts empty where they differ.
    unsafe { device.create_pipeline_cache(&descriptor) }
}

/// Returns the line before the data: the program and version that wrote it, the data's length and checksum.
fn header(data: &[u8]) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let length = data.len();
    let sum = checksum(data);
    format!("pellicle pipelines {version} {length} {sum:016x}\n")
}

/// Returns the data of a file that is complete and of this version.
fn data_of(content: &[u8]) -> Option<&[u8]> {
    let line = content.iter().position(|&byte| byte == b'\n')? + 1;
    let (line, data) = content.split_at(line);
    (line == header(data).as_bytes()).then_some(data)
}

/// Returns FNV-1a of 64 bits (Fowler, Noll and Vo; RFC 9923): against accidental damage, not against tampering.
fn checksum(data: &[u8]) -> u64 {
    data.iter().fold(0xcbf2_9ce4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Returns the folder of the caches: the value of `PELLICLE_CACHE_DIR`, or a folder in the user's cache folder (on Unix according
/// to the XDG Base Directory Specification, 0.8).
fn cache_folder(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    if let Some(folder) = variable(FOLDER_VARIABLE) {
        return (!folder.is_empty()).then(|| folder.into());
    }
    // The specification says that relative paths are ignored.
    let absolute = |name| {
        let path = variable(name).map(PathBuf::from);
        path.filter(|path| path.is_absolute())
    };
    let of_user = if cfg!(windows) {
        absolute("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        absolute("HOME").map(|home| home.join("Library/Caches"))
    } else {
        absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(".cache")))
    };
    of_user.map(|folder| folder.join("pellicle"))
}

/// Reads a file of at most `bytes` bytes and a header.
fn read_at_most(file: &Path, bytes: usize) -> Option<Vec<u8>> {
    let most = bytes + header(&[]).len() + usize::MAX.to_string().len();
    let length = fs::metadata(file).ok()?.len();
    if length > most as u64 {
        return None;
    }
    fs::read(file).ok()
}

/// Writes a temporary file beside the file and renames it: a reader sees either the old or the new file, no matter who else writes. Only
/// the user can read it.
fn replace(file: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let folder = file.parent().unwrap_or(Path::new("."));
    create_private_folder(folder)?;
    let mut beside = tempfile::Builder::new()
        .suffix(".new")
        .tempfile_in(folder)?;
    parts.iter().try_for_each(|part| beside.write_all(part))?;
    beside.persist(file)?;
    Ok(())
}

/// Creates the folder, if it does not exist, with permissions that keep others from writing to it: drivers' code will be read from
/// it. An existing folder is used as it is: whoever names a folder that others may write to trusts them.
fn create_private_folder(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(data: &[u8]) -> Vec<u8> {
        [header(data).as_bytes(), data].concat()
    }

    #[test]
    fn what_was_written_is_read() {
        for data in [&b""[..], b"\n", b"data of a driver\n\0\xff"] {
            assert_eq!(data_of(&kept(data)), Some(data));
        }
    }

    #[test]
    fn a_damaged_file_is_ignored() {
        let whole = kept(b"data of a driver");
        for byte in 0..whole.len() {
            for bit in 0..8 {
                let mut damaged = whole.clone();
                damaged[byte] ^= 1 << bit;
                assert_eq!(data_of(&damaged), None, "bit {bit} of byte {byte}");
            }
        }
    }

    #[test]
    fn a_file_of_another_length_is_ignored() {
        let mut whole = kept(b"data of a driver");
        for length in 0..whole.len() {
            assert_eq!(data_of(&whole[..length]), None, "{length} bytes");
        }
        whole.push(0);
        assert_eq!(data_of(&whole), None);
    }

    #[test]
    fn a_file_of_another_version_is_ignored() {
        let text = String::from_utf8(kept(b"data")).unwrap();
        let version = env!("CARGO_PKG_VERSION");
        assert!(text.contains(version));
        let other = text.replacen(version, "0.0.0", 1);
        assert_eq!(data_of(other.as_bytes()), None);
    }

    /// The checksums of the authors' test vectors.
    #[test]
    fn the_checksum_is_fnv_1a() {
        assert_eq!(checksum(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(checksum(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(checksum(b"foobar"), 0x8594_4171_f739_67e8);
    }

    fn folder(variables: &[(&str, &str)]) -> Option<PathBuf> {
        cache_folder(|name| {
            let found = variables.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| value.into())
        })
    }

    #[test]
    fn the_variable_sets_the_folder_or_none() {
        let home = ("HOME", "/home/x");
        assert_eq!(
            folder(&[(FOLDER_VARIABLE, "here"), home]),
            Some("here".into())
        );
        assert_eq!(folder(&[(FOLDER_VARIABLE, ""), home]), None);
        assert_eq!(folder(&[]), None);
    }

    #[cfg(all(unix, not(target_os = "macos")))]
    #[test]
    fn the_folder_is_where_the_specification_has_it() {
        let home = ("HOME", "/home/x");
        let in_home = Some("/home/x/.cache/pellicle".into());
        assert_eq!(folder(&[home]), in_home);
        assert_eq!(folder(&[("XDG_CACHE_HOME", "relative"), home]), in_home);
        assert_eq!(folder(&[("XDG_CACHE_HOME", ""), home]), in_home);
        assert_eq!(
            folder(&[("XDG_CACHE_HOME", "/c"), home]),
            Some("/c/pellicle".into())
        );
    }

    #[test]
    fn a_file_takes_the_place_of_another_and_leaves_nothing_beside() {
        let name = format!("pellicle-pipelines-{}", std::process::id());
        let folder = std::env::temp_dir().join(name).join("deeper");
        let file = folder.join("file");
        for content in [&b"first"[..], b"second"] {
            replace(&file, &[content, b"."]).unwrap();
            assert_eq!(fs::read(&file).unwrap(), [content, b"."].concat());
        }
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        assert_eq!(read_at_most(&file, 7).as_deref(), Some(&b"second."[..]));
        fs::write(&file, vec![0; 200]).unwrap();
        assert_eq!(read_at_most(&file, 7), None);
        fs::remove_dir_all(folder.parent().unwrap()).unwrap();
    }
}
