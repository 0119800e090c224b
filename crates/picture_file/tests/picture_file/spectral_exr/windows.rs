//! Files whose data window is not their display window.

use std::path::Path;

use exr::prelude::*;
use pellicle_picture_file::spectral_exr;

const NAMES: [&str; 2] = ["S0.450nm", "S0.460nm"];

/// Writes a file whose samples count up from 1, row by row.
fn write(path: &Path, (position, size): ([i32; 2], [usize; 2]), display: ([i32; 2], [usize; 2])) {
    let count = size[0] * size[1];
    let channel = |name: &&str| {
        let samples = (1..=count).map(|i| i as f32).collect();
        AnyChannel::new(*name, FlatSamples::F32(samples))
    };
    let channels = AnyChannels::sort(NAMES.iter().map(channel).collect());
    let attributes = LayerAttributes {
        layer_position: Vec2(position[0], position[1]),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(
        (size[0], size[1]),
        attributes,
        Encoding::FAST_LOSSLESS,
        channels,
    );
    let window = IntegerBounds::new((display.0[0], display.0[1]), (display.1[0], display.1[1]));
    let image = Image::new(ImageAttributes::new(window), layer);
    image.write().to_file(path).unwrap();
}

fn first_band(path: &Path) -> (Vec<f32>, Vec<String>) {
    let (image, metadata) = spectral_exr::read(path).unwrap();
    let (xyz, _) = spectral_exr::read_xyz(path).unwrap();
    assert_eq!(xyz.xyz(), image.xyz());
    let ([width, height], _) = spectral_exr::read_size(path).unwrap();
    assert_eq!((width, height), (image.width(), image.height()));
    let values = image.radiance().chunks(2).map(|pixel| pixel[0]).collect();
    (values, metadata.notes)
}

#[test]
fn a_crop_is_placed_in_black() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("crop.exr");
    for origin in [0, -7, 5] {
        write(
            &path,
            ([origin + 1, origin + 1], [2, 1]),
            ([origin, origin], [4, 3]),
        );
        let (values, notes) = first_band(&path);
        assert_eq!(values, [0., 0., 0., 0., 0., 1., 2., 0., 0., 0., 0., 0.]);
        assert!(
            notes[0].contains("2×1 pixels at 1,1 of a picture of 4×3"),
            "{notes:?}"
        );
    }
}

#[test]
fn overscan_is_cut_off() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("overscan.exr");
    write(&path, ([-1, -1], [4, 3]), ([0, 0], [2, 1]));
    let (values, notes) = first_band(&path);
    assert_eq!(values, [6., 7.]);
    assert!(notes[0].contains("cut off"), "{notes:?}");
    // The data window starts above and to the left of the picture and ends before its right edge.
    write(&path, ([-1, -1], [2, 2]), ([0, 0], [2, 1]));
    assert_eq!(first_band(&path).0, [4., 0.]);
    write(&path, ([3, 3], [2, 2]), ([3, 3], [2, 2]));
    assert_eq!(first_band(&path), (vec![1., 2., 3., 4.], vec![]));
}

#[test]
fn a_picture_without_any_of_the_pixels_is_black_and_a_huge_one_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("far.exr");
    write(&path, ([1_000_000, -2_000_000], [2, 2]), ([0, 0], [3, 1]));
    let (values, notes) = first_band(&path);
    assert_eq!((values, notes.len()), (vec![0.0; 3], 1));
    for display in [[40_000, 25_000], [1 << 29, 1 << 29], [1 << 29, 1]] {
        write(&path, ([0, 0], [2, 2]), ([0, 0], display));
        let error = spectral_exr::read(&path).unwrap_err();
        assert!(error.to_string().contains("too large"), "{error}");
    }
}

#[test]
fn windows_at_the_ends_of_numbers_never_end_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ends.exr");
    write(&path, ([0, 0], [2, 2]), ([0, 0], [2, 2]));
    let bytes = std::fs::read(&path).unwrap();
    let ends = [
        i32::MIN,
        i32::MIN + 1,
        i32::MIN / 2,
        -1,
        0,
        i32::MAX / 2,
        i32::MAX,
    ];
    let mut refused = 0;
    for key in [
        &b"dataWindow\0box2i\0\x10\0\0\0"[..],
        b"displayWindow\0box2i\0\x10\0\0\0",
    ] {
        let at = bytes.windows(key.len()).position(|w| w == key).unwrap() + key.len();
        for number in 0..4 {
            for other in 0..4 {
                for (a, b) in ends.iter().flat_map(|a| ends.iter().map(move |b| (a, b))) {
                    let mut copy = bytes.clone();
                    copy[at + 4 * number..at + 4 * number + 4].copy_from_slice(&a.to_le_bytes());
                    copy[at + 4 * other..at + 4 * other + 4].copy_from_slice(&b.to_le_bytes());
                    std::fs::write(&path, &copy).unwrap();
                    refused += usize::from(spectral_exr::read(&path).is_err());
                }
            }
        }
    }
    assert!(refused > 1000, "{refused}");
}
