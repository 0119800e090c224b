//! Some rows of a file are those of the whole.

use std::fs;
use std::path::Path;

use exr::prelude::*;
use pellicle_picture_file::spectral_exr::{self, Frame, ReadExrError, RowReader, WriteOptions};
use spectra::Window;

use super::support::{metadata, noise, noisy, rows_of, write_noisy};

/// Compares a file's rows, in strips of several heights and from last to first, with those of the whole image.
fn check_rows(path: &Path, what: &str) {
    let (whole, metadata) = spectral_exr::read(path).unwrap();
    let mut reader = RowReader::open(path).unwrap();
    assert_eq!(reader.size(), [whole.width(), whole.height()]);
    assert_eq!(reader.bands(), whole.bands());
    assert_eq!(reader.light_groups(), whole.light_groups());
    assert_eq!(reader.metadata(), &metadata);
    for height in [1, 5, 16, 64] {
        let starts = (0..whole.height()).step_by(height as usize);
        for start in starts.rev() {
            let rows = start..(start + height).min(whole.height());
            let found = reader.read(rows.clone()).unwrap();
            assert!(found == rows_of(&whole, rows.clone()), "{what}: {rows:?}");
        }
    }
    assert_eq!(reader.read(3..3).unwrap().height(), 0);
    assert_eq!(
        reader.read_xyz().unwrap(),
        relight::XyzImage::from(&whole),
        "{what}"
    );
    for bytes in [0, 5000, usize::MAX] {
        let mut next = 0;
        for rows in reader.strips(bytes) {
            assert_eq!(rows.start, next, "{what}");
            next = rows.end;
            assert!(rows.start < next, "{what}: {rows:?}");
        }
        assert_eq!(next, whole.height(), "{what}");
    }
}

/// Writes a file of another program, with samples that differ.
fn write_foreign(path: &Path, prefix: &str, encoding: Encoding, (x, y): (i32, i32)) {
    let channel = |band: u32| {
        let samples = (0..23 * 37).map(|i| noise(i + 851 * band)).collect();
        let name = Text::new_or_panic(format!("{prefix}{}nm", 400 + 50 * band));
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    let channels = AnyChannels::sort((0..8).map(channel).collect());
    let attributes = LayerAttributes {
        layer_position: Vec2(x, y),
        ..LayerAttributes::default()
    };
    let layer = Layer::new((23, 37), attributes, encoding, channels);
    let picture = IntegerBounds::new((0, 0), (23, 37));
    let image = Image::new(ImageAttributes::new(picture), layer);
    image.write().to_file(path).unwrap();
}

#[test]
fn rows_of_our_files_are_those_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    for variance in [true, false] {
        let (path, _) = write_noisy(folder.path(), variance);
        check_rows(&path, "ours");
    }
}

#[test]
fn rows_of_any_encoding_and_position_are_those_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("foreign.exr");
    let lines = Blocks::ScanLines;
    let tiles = Blocks::Tiles(Vec2(16, 8));
    for (compression, blocks, line_order) in [
        (Compression::Uncompressed, lines, LineOrder::Increasing),
        (Compression::ZIP16, lines, LineOrder::Decreasing),
        (Compression::PIZ, lines, LineOrder::Increasing),
        (Compression::ZIP1, tiles, LineOrder::Increasing),
        (Compression::RLE, tiles, LineOrder::Unspecified),
    ] {
        let encoding = Encoding {
            compression,
            blocks,
            line_order,
        };
        for position in [(0, 0), (2, 5), (-3, -9), (0, 1000)] {
            for prefix in ["S0.", "T."] {
                write_foreign(&path, prefix, encoding, position);
                check_rows(&path, &format!("{encoding:?} {position:?} {prefix}"));
            }
        }
    }
}

#[test]
fn rows_that_are_not_there_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(folder.path(), true);
    let mut reader = RowReader::open(&path).unwrap();
    #[expect(clippy::reversed_empty_ranges)]
    for rows in [36..38, 38..38, 5..4, 0..u32::MAX] {
        let error = reader.read(rows).unwrap_err();
        assert!(matches!(error, ReadExrError::Rows { .. }), "{error}");
        assert!(error.to_string().contains("has 37 rows"), "{error}");
    }
}

#[test]
fn the_frame_is_that_which_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.exr");
    let window = Window {
        origin: [3, 8],
        size: [5, 4],
    };
    let picture = [9, 20];
    let frame = Frame { picture, window };
    let mut strip = Some(noisy(5, 4, 3));
    let mut next = || Ok::<_, std::fmt::Error>(strip.take());
    let options = WriteOptions::default();
    spectral_exr::write_rows(&path, frame, &metadata(), options, &mut next).unwrap();
    assert_eq!(RowReader::open(&path).unwrap().frame(), frame);
    check_rows(&path, "window");
}

/// A picture of 160 GB.
#[test]
fn rows_of_a_picture_too_large_for_memory_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.exr");
    let window = Window {
        origin: [7, 99_998],
        size: [5, 2],
    };
    let frame = Frame {
        picture: [50_000, 100_000],
        window,
    };
    let image = noisy(5, 2, 3);
    let mut strip = Some(image.clone());
    let mut next = || Ok::<_, std::fmt::Error>(strip.take());
    let options = WriteOptions::default();
    spectral_exr::write_rows(&path, frame, &metadata(), options, &mut next).unwrap();
    let error = spectral_exr::read(&path).unwrap_err();
    assert!(matches!(error, ReadExrError::TooLarge { .. }), "{error}");
    let mut reader = RowReader::open(&path).unwrap();
    let found = reader.read(99_998..100_000).unwrap();
    assert_eq!(found.pixel(8, 1), image.pixel(1, 1));
    assert_eq!(found.pixel(12, 1), [0.0; 3]);
    let error = reader.read(0..100_000).unwrap_err();
    assert!(matches!(error, ReadExrError::TooLarge { .. }), "{error}");
}

#[test]
fn damage_is_found_in_its_rows_or_by_the_digest() {
    let folder = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(folder.path(), true);
    assert!(RowReader::open(&path).unwrap().verify().unwrap());
    let bytes = fs::read(&path).unwrap();
    let mut copy = bytes.clone();
    *copy.last_mut().unwrap() ^= 1;
    fs::write(&path, &copy).unwrap();
    let mut reader = RowReader::open(&path).unwrap();
    assert!(reader.read(0..36).unwrap() == rows_of(&image, 0..36));
    let error = reader.verify().unwrap_err();
    assert!(matches!(error, ReadExrError::Damaged { .. }), "{error}");
    // The last line is missing.
    fs::write(&path, &bytes[..bytes.len() - 9]).unwrap();
    let mut reader = RowReader::open(&path).unwrap();
    assert!(reader.read(0..36).is_ok());
    assert!(reader.read(30..37).is_err());
    assert!(reader.verify().is_err());

    write_foreign(&path, "S0.", Encoding::FAST_LOSSLESS, (0, 0));
    assert!(!RowReader::open(&path).unwrap().verify().unwrap());
}

#[test]
fn the_digest_is_compared_after_strips_in_any_order() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _) = write_noisy(folder.path(), true);
    let bytes = fs::read(&path).unwrap();
    let key = b"pellicle.digest\0string\0\x40\0\0\0";
    let name = bytes.windows(key.len()).position(|w| w == key).unwrap();
    let mut other = bytes.clone();
    other[name + key.len()] ^= 1;
    for (bytes, is_same) in [(bytes, true), (other, false)] {
        fs::write(&path, bytes).unwrap();
        let orders = [vec![0, 10, 20, 30], vec![30, 20, 10, 0], vec![0, 5, 20]];
        for starts in orders {
            let mut reader = RowReader::open(&path).unwrap();
            for start in starts {
                reader.read(start..(start + 12).min(37)).unwrap();
            }
            assert_eq!(reader.verify().is_ok(), is_same);
        }
    }
}

#[test]
fn a_damaged_table_of_contents_is_not_needed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(folder.path(), true);
    let bytes = fs::read(&path).unwrap();
    let table = super::damaged::first_line(&bytes) - 8 * 37;
    let of_line = |line: usize| table + 8 * line..table + 8 * line + 8;
    for entry in [[0; 8], [0xff; 8], bytes[of_line(3)].try_into().unwrap()] {
        let mut copy = bytes.clone();
        copy[of_line(20)].copy_from_slice(&entry);
        fs::write(&path, &copy).unwrap();
        let mut reader = RowReader::open(&path).unwrap();
        let found = reader.read(18..25).unwrap();
        assert!(found == rows_of(&image, 18..25), "{entry:?}");
    }
}
