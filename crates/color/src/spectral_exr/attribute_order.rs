//! Sorting the attributes of a written file.
//!
//! The encoder keeps attributes in a hash map, so that their order, and with it the file's bytes, would change from run to
//! run. `OpenEXR` allows any order; ours is that of the names.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};

/// Magic number and version, before the first attribute.
const PREAMBLE: u64 = 8;

/// Sorts the attributes of a finished single-part file in place. Their bytes keep their total length, so that nothing behind
/// them moves.
pub(super) fn sort_attributes(mut file: File) -> io::Result<()> {
    file.seek(SeekFrom::Start(PREAMBLE))?;
    let mut attributes = read_attributes(&mut BufReader::new(&file))?;
    attributes.sort();
    file.seek(SeekFrom::Start(PREAMBLE))?;
    file.write_all(&attributes.concat())
}

/// Each attribute as its bytes: name, 0, type, 0, size in four bytes, value. An empty name ends the list.
fn read_attributes(source: &mut impl BufRead) -> io::Result<Vec<Vec<u8>>> {
    let mut attributes = Vec::new();
    loop {
        let mut attribute = Vec::new();
        source.read_until(0, &mut attribute)?;
        if attribute.len() <= 1 {
            return Ok(attributes);
        }
        source.read_until(0, &mut attribute)?;
        let mut size = [0; 4];
        source.read_exact(&mut size)?;
        attribute.extend(size);
        let value = u64::from(u32::from_le_bytes(size));
        let read = source.by_ref().take(value).read_to_end(&mut attribute)?;
        if (read as u64) < value {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        attributes.push(attribute);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn attribute(name: &str, value: &[u8]) -> Vec<u8> {
        let size = (value.len() as u32).to_le_bytes();
        [name.as_bytes(), b"\0string\0", &size, value].concat()
    }

    #[test]
    fn attributes_are_read_whole_up_to_the_empty_name() {
        let (b, a) = (attribute("b", b"\0one"), attribute("a", b""));
        let file = [b.clone(), a.clone(), vec![0], b"pixels".to_vec()].concat();
        assert_eq!(
            read_attributes(&mut file.as_slice()).unwrap(),
            [b.clone(), a]
        );
        assert!(read_attributes(&mut &b[..b.len() - 1]).is_err());
    }
}
