//! Files that are damaged, cut short, or something else.

use std::fs;

use pellicle_picture_file::spectral_exr::{self, ReadExrError};

use super::support::{noise, write_noisy};

#[test]
fn what_is_no_exr_file_is_reported() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("text.exr");
    for content in ["", "v/1", "a longer text that is no image"] {
        fs::write(&path, content).unwrap();
        let error = spectral_exr::read(&path).unwrap_err();
        assert!(matches!(error, ReadExrError::NotExr { .. }), "{content:?}");
    }
    let missing = directory.path().join("missing.exr");
    let error = spectral_exr::read(&missing).unwrap_err();
    assert!(matches!(error, ReadExrError::File { .. }));
    assert!(error.to_string().contains("missing.exr"));
}

#[test]
fn a_file_cut_short_is_an_error_at_every_length() {
    let directory = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    let cut = directory.path().join("cut.exr");
    let header = 0..2500.min(bytes.len());
    for length in header
        .step_by(13)
        .chain((0..bytes.len()).step_by(997))
        .chain([bytes.len() - 1])
    {
        fs::write(&cut, &bytes[..length]).unwrap();
        let error = spectral_exr::read(&cut).unwrap_err();
        let is_expected = match error {
            ReadExrError::NotExr { .. } => length < 4,
            ReadExrError::Damaged { .. } => length >= 4,
            _ => false,
        };
        assert!(is_expected, "{length} bytes: {error}");
    }
}

#[test]
fn damaged_bytes_never_end_the_program() {
    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    let damaged = directory.path().join("damaged.exr");
    let header_end = 2500.min(bytes.len());
    let mut refused = 0;
    for turn in 0..1500_u32 {
        let mut copy = bytes.clone();
        // Most damage matters in the header.
        let range = if turn % 3 == 0 {
            bytes.len()
        } else {
            header_end
        };
        let place = (noise(turn) * range as f32) as usize;
        copy[place] = match turn % 4 {
            0 => 0xff,
            1 => 0x7f,
            2 => copy[place] ^ 0x80,
            _ => (noise(turn + 10_000) * 256.0) as u8,
        };
        fs::write(&damaged, &copy).unwrap();
        match spectral_exr::read(&damaged) {
            Ok((found, _)) => assert!(found.width() <= 4 * image.width()),
            Err(_) => refused += 1,
        }
    }
    assert!(
        refused > 300,
        "only {refused} of 1500 damaged files were refused"
    );
}

/// Sets the four bytes after `key` in a header, `skip` bytes further on.
fn patched(bytes: &[u8], key: &[u8], skip: usize, value: i32) -> Vec<u8> {
    let at = bytes.windows(key.len()).position(|w| w == key).unwrap() + key.len() + skip;
    let mut copy = bytes.to_vec();
    copy[at..at + 4].copy_from_slice(&value.to_le_bytes());
    copy
}

#[test]
fn claims_of_a_huge_image_are_refused_before_memory_is_taken() {
    let directory = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    // Attribute: name, 0, type, 0, size of the value, then xMin, yMin, xMax, yMax.
    let key = b"dataWindow\0box2i\0\x10\0\0\0";
    for (max_x, max_y) in [
        (1 << 29, 36),
        (22, 1 << 29),
        (1 << 29, 1 << 29),
        (1 << 20, 1 << 13),
    ] {
        let copy = patched(&patched(&bytes, key, 8, max_x), key, 12, max_y);
        fs::write(&path, copy).unwrap();
        let error = spectral_exr::read(&path).unwrap_err();
        assert!(
            matches!(error, ReadExrError::Damaged { .. }),
            "{max_x} {max_y}: {error}"
        );
    }
}

/// An attribute or a channel list that claims any length.
#[test]
fn a_huge_header_is_refused_before_memory_is_taken() {
    let directory = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    for key in [
        &b"software\0string\0"[..],
        b"channels\0chlist\0",
        b"pellicle.setting.note\0string\0",
        b"chromaticities\0chromaticities\0",
    ] {
        for size in [i32::MAX, -1, 1 << 28, 1 << 20] {
            fs::write(&path, patched(&bytes, key, 0, size)).unwrap();
            let error = spectral_exr::read(&path).unwrap_err();
            assert!(
                matches!(error, ReadExrError::Damaged { .. }),
                "{size}: {error}"
            );
        }
    }
}

/// Positions of bytes spread over the pixels of a written file, which follow the table of contents: a line of 8 bytes for each row.
fn pixel_places(bytes: &[u8], rows: usize) -> Vec<usize> {
    let header = exr::meta::MetaData::read_from_buffered(bytes, true).unwrap();
    assert_eq!(header.headers[0].chunk_count, rows);
    let first = first_line(bytes);
    let step = (bytes.len() - first) / 150;
    (first..bytes.len()).step_by(step).collect()
}

/// Position of the first line, as the table of contents gives it: its y coordinate, the number of its bytes, and its bytes.
pub(super) fn first_line(bytes: &[u8]) -> usize {
    // A table of offsets ends where the first line begins, and the first line's y is 0.
    let at = |table: usize| {
        let entry = bytes[table..table + 8].try_into().unwrap();
        u64::from_le_bytes(entry) as usize
    };
    let is_table = |&table: &usize| at(table) == table + 8 * 37;
    at((0..4000).find(is_table).unwrap())
}

#[test]
fn a_single_changed_bit_of_the_pixels_is_found() {
    let directory = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    let mut by_digest = 0;
    let places = pixel_places(&bytes, 37);
    for (turn, &place) in places.iter().chain([&(bytes.len() - 1)]).enumerate() {
        let mut copy = bytes.clone();
        copy[place] ^= 1 << (turn % 8);
        fs::write(&path, &copy).unwrap();
        let errors = [
            spectral_exr::read(&path).map(drop),
            spectral_exr::read_xyz(&path).map(drop),
        ];
        for error in errors.map(Result::unwrap_err) {
            assert!(
                matches!(error, ReadExrError::Damaged { .. }),
                "{place}: {error}"
            );
            let said = error.to_string();
            assert!(said.contains("image.exr"), "{said}");
            by_digest += usize::from(said.contains("not those that were written"));
        }
    }
    assert!(by_digest > 200, "{by_digest}");
    fs::write(&path, &bytes).unwrap();
    spectral_exr::read(&path).unwrap();
}

#[test]
fn a_changed_digest_is_found_and_a_missing_one_is_not_missed() {
    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), true);
    let bytes = fs::read(&path).unwrap();
    let key = b"pellicle.digest\0string\0\x40\0\0\0";
    let name = bytes.windows(key.len()).position(|w| w == key).unwrap();
    let value = name + key.len();
    for place in [value, value + 31, value + 63] {
        let mut copy = bytes.clone();
        copy[place] ^= 1;
        fs::write(&path, &copy).unwrap();
        let error = spectral_exr::read(&path).unwrap_err().to_string();
        assert!(error.contains("not those that were written"), "{error}");
    }
    let mut copy = bytes.clone();
    copy[name] = b'q';
    fs::write(&path, &copy).unwrap();
    let (found, metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(found, image);
    assert_eq!(metadata, super::support::metadata());
}
