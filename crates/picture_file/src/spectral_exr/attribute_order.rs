//! Corrections to the header that the encoder writes.
//!
//! The encoder keeps attributes in a hash map, so their order, and with it the file's bytes, would change from run to run. `OpenEXR`
//! allows any order; here attributes are sorted by name. The encoder also does not set the flag for long channel names in the
//! version field, which the format requires. The digest of the pixels is known only after they are written.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};

use crate::exr_file::digest;

/// Position of the version field.
const VERSION: u64 = 4;
/// Bit 10 of the version field, in the second of its four bytes: some names are longer than [`SHORT_NAME`] bytes.
const LONG_NAMES: u8 = 1 << 2;
/// The longest name, in bytes, that every reader must accept.
const SHORT_NAME: usize = 31;
/// Bytes that follow a channel's name and its 0: type, a flag, three reserved bytes, and two numbers for the sampling.
const CHANNEL: usize = 16;

/// Sorts the attributes of a finished single-part file in place, sets the flag for long names, and puts the digest into the room for
/// it. The total length stays the same, so nothing after the header moves.
pub(super) fn finish_header(mut file: File, digest: &str) -> io::Result<()> {
    file.seek(SeekFrom::Start(VERSION))?;
    let mut version = [0; 4];
    file.read_exact(&mut version)?;
    let mut attributes = read_attributes(&mut BufReader::new(&file))?;
    attributes.sort();
    let mut named = attributes.iter_mut();
    if let Some(room) = named.find(|attribute| attribute.name() == digest::NAME.as_bytes()) {
        room.set_value(digest.as_bytes())?;
    }
    if attributes.iter().any(Attribute::has_long_name) {
        version[1] |= LONG_NAMES;
    }
    let bytes = attributes.iter().map(|attribute| &attribute.bytes[..]);
    let bytes: Vec<&[u8]> = [&version[..]].into_iter().chain(bytes).collect();
    file.seek(SeekFrom::Start(VERSION))?;
    file.write_all(&bytes.concat())
}

/// An attribute as its bytes: name, 0, type, 0, size in four bytes, value.
#[derive(Debug, Eq, Ord, PartialEq, PartialOrd)]
struct Attribute {
    bytes: Vec<u8>,
    /// Position of the value.
    value: usize,
}

impl Attribute {
    fn name(&self) -> &[u8] {
        let mut parts = self.bytes.split(|&byte| byte == 0);
        parts.next().unwrap_or_default()
    }

    /// Replaces the value by one of the same length.
    fn set_value(&mut self, value: &[u8]) -> io::Result<()> {
        let room = &mut self.bytes[self.value..];
        if room.len() != value.len() {
            let message = "the header has no room for the digest";
            return Err(io::Error::other(message));
        }
        room.copy_from_slice(value);
        Ok(())
    }

    /// Whether its name or type or, in a list of channels, the name of a channel is long.
    fn has_long_name(&self) -> bool {
        let mut parts = self.bytes.split(|&byte| byte == 0);
        let name = parts.next().unwrap_or_default();
        let kind = parts.next().unwrap_or_default();
        let mut longest = name.len().max(kind.len());
        let mut rest = &self.bytes[self.value..];
        // An empty name ends the list.
        while kind == b"chlist" && rest.first().is_some_and(|&byte| byte != 0) {
            let length = rest.iter().position(|&byte| byte == 0);
            let length = length.unwrap_or(rest.len());
            longest = longest.max(length);
            rest = rest.get(length + 1 + CHANNEL..).unwrap_or_default();
        }
        longest > SHORT_NAME
    }
}

/// Reads attributes up to the empty name that ends the list.
fn read_attributes(source: &mut impl BufRead) -> io::Result<Vec<Attribute>> {
    let mut attributes = Vec::new();
    loop {
        let mut bytes = Vec::new();
        source.read_until(0, &mut bytes)?;
        if bytes.len() <= 1 {
            return Ok(attributes);
        }
        source.read_until(0, &mut bytes)?;
        let mut size = [0; 4];
        source.read_exact(&mut size)?;
        bytes.extend(size);
        let value = bytes.len();
        let size = u64::from(u32::from_le_bytes(size));
        let read = source.by_ref().take(size).read_to_end(&mut bytes)?;
        if (read as u64) < size {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        attributes.push(Attribute { bytes, value });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attribute(name: &str, value: &[u8]) -> Vec<u8> {
        of_kind(name, "string", value)
    }

    fn of_kind(name: &str, kind: &str, value: &[u8]) -> Vec<u8> {
        let size = (value.len() as u32).to_le_bytes();
        let (name, kind) = (name.as_bytes(), kind.as_bytes());
        [name, b"\0", kind, b"\0", &size, value].concat()
    }

    #[test]
    fn long_names_are_found_in_attributes_and_in_channels() {
        let is_long = |bytes: &[u8]| {
            let file = [bytes, &[0]].concat();
            read_attributes(&mut file.as_slice()).unwrap()[0].has_long_name()
        };
        let channels = |names: [&str; 2]| {
            let channel = |name: &str| [name.as_bytes(), &[0; 1 + CHANNEL]].concat();
            let list = [&names.map(channel).concat()[..], &[0]].concat();
            of_kind("channels", "chlist", &list)
        };
        let names = ["a".repeat(31), "a".repeat(32)];
        for (name, long) in names.iter().zip([false, true]) {
            assert_eq!(is_long(&attribute(name, b"")), long);
            assert_eq!(is_long(&channels([name, "b"])), long);
            assert_eq!(is_long(&channels(["b", name])), long);
            assert!(!is_long(&attribute("a", name.as_bytes())));
        }
    }

    #[test]
    fn a_value_is_replaced_by_one_of_the_same_length() {
        let bytes = attribute("digest", b"000");
        let mut attribute = Attribute {
            value: bytes.len() - 3,
            bytes,
        };
        assert_eq!(attribute.name(), b"digest");
        attribute.set_value(b"123").unwrap();
        assert_eq!(attribute.bytes, self::attribute("digest", b"123"));
        assert!(attribute.set_value(b"12").is_err());
    }

    #[test]
    fn attributes_are_read_whole_up_to_the_empty_name() {
        let (b, a) = (attribute("b", b"\0one"), attribute("a", b""));
        let file = [b.clone(), a.clone(), vec![0], b"pixels".to_vec()].concat();
        let found = read_attributes(&mut file.as_slice()).unwrap();
        let found: Vec<Vec<u8>> = found.into_iter().map(|found| found.bytes).collect();
        assert_eq!(found, [b.clone(), a]);
        assert!(read_attributes(&mut &b[..b.len() - 1]).is_err());
    }
}
