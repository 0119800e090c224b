//! Files that are written in strips of rows.

use std::fs;
use std::path::Path;

use pellicle_picture_file::spectral_exr::{
    self, Frame, WriteExrError, WriteOptions, WriteRowsError,
};
use spectra::{BandGrid, SpectralImage, Window};

use super::support::{metadata, noisy, rows_of};

/// Writes strips of these heights, from the rows of an image.
fn write(
    path: &Path,
    frame: Frame,
    image: &SpectralImage,
    heights: &[u32],
) -> Result<(), WriteRowsError<std::fmt::Error>> {
    let mut heights = heights.iter();
    let mut row = 0;
    let mut next = || {
        Ok(heights.next().map(|height| {
            row += height;
            rows_of(image, row - height..row)
        }))
    };
    let options = WriteOptions::default();
    spectral_exr::write_rows(path, frame, &metadata(), options, &mut next)
}

#[test]
fn strips_make_the_same_file_as_the_whole_image() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, strips] = ["whole", "strips"].map(|name| folder.path().join(name));
    let image = noisy(23, 37, 6);
    spectral_exr::write(&whole, &image, &metadata(), WriteOptions::default()).unwrap();
    for heights in [&[37][..], &[1; 37], &[16, 0, 16, 5], &[0, 36, 1, 0]] {
        write(&strips, Frame::whole([23, 37]), &image, heights).unwrap();
        let same = fs::read(&strips).unwrap() == fs::read(&whole).unwrap();
        assert!(same, "{heights:?}");
    }
}

#[test]
fn a_window_is_placed_in_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.exr");
    let image = noisy(5, 4, 3);
    let window = Window {
        origin: [2, 1],
        size: [5, 4],
    };
    let picture = [9, 5];
    write(&path, Frame { picture, window }, &image, &[3, 1]).unwrap();
    let (found, metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!([found.width(), found.height()], picture);
    assert!(metadata.notes[0].contains("5×4 pixels at 2,1 of a picture of 9×5"));
    for (x, y) in (0..9).flat_map(|x| (0..5).map(move |y| (x, y))) {
        let expected = if (2..7).contains(&x) && y >= 1 {
            image.pixel(x - 2, y - 1)
        } else {
            &[0.0; 3]
        };
        assert_eq!(found.pixel(x, y), expected, "{x},{y}");
    }
}

#[test]
fn rows_that_do_not_make_up_the_window_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    let image = noisy(5, 9, 3);
    for (size, heights, said) in [
        ([5, 6], &[][..], "no rows"),
        ([5, 6], &[3, 2], "end after 5 of its 6 rows"),
        ([5, 6], &[6, 1], "more than its 6 rows"),
        ([5, 6], &[7], "more than its 6 rows"),
        (
            [4, 6],
            &[6],
            "rows have 4 pixels, and one of its strips has 5",
        ),
    ] {
        let error = write(&path, Frame::whole(size), &image, heights).unwrap_err();
        assert!(
            matches!(error, WriteRowsError::Write(WriteExrError::Rows { .. })),
            "{error:?}"
        );
        assert!(error.to_string().contains(said), "{error}");
    }
    let other = SpectralImage::new(5, 1, BandGrid::visible(4).unwrap());
    let mut strips = [rows_of(&image, 0..5), other].into_iter();
    let error = spectral_exr::write_rows(
        &path,
        Frame::whole([5, 6]),
        &metadata(),
        WriteOptions::default(),
        &mut || Ok::<_, std::fmt::Error>(strips.next()),
    );
    assert!(error.unwrap_err().to_string().contains("the same bands"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn windows_outside_the_picture_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    let image = noisy(5, 4, 3);
    for (origin, picture) in [
        ([1, 0], [5, 4]),
        ([0, 1], [5, 4]),
        ([u32::MAX, 0], [5, 4]),
        ([0, 0], [1 << 31, 4]),
    ] {
        let window = Window {
            origin,
            size: [5, 4],
        };
        let error = write(&path, Frame { picture, window }, &image, &[4]).unwrap_err();
        assert!(
            matches!(error, WriteRowsError::Write(WriteExrError::Window { .. })),
            "{error:?}"
        );
    }
}

#[test]
fn an_error_of_the_source_is_returned_and_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    for good in [0, 2] {
        let mut left = good;
        let mut next = || {
            if left == 0 {
                return Err("the renderer has failed");
            }
            left -= 1;
            Ok(Some(noisy(5, 1, 3)))
        };
        let (frame, options) = (Frame::whole([5, 4]), WriteOptions::default());
        let error = spectral_exr::write_rows(&path, frame, &metadata(), options, &mut next);
        assert!(matches!(
            error,
            Err(WriteRowsError::Source("the renderer has failed"))
        ));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
