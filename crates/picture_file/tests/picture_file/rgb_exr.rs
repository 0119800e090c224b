//! Color files as other programs write them.

use std::path::Path;

use exr::prelude::*;
use pellicle_picture_file::rgb_exr::{ReadRgbError, RgbFile};

type Named<'a> = (&'a str, FlatSamples);

fn floats(values: &[f32]) -> FlatSamples {
    FlatSamples::F32(values.to_vec())
}

fn layer(
    name: Option<&str>,
    channels: Vec<Named<'_>>,
    encoding: Encoding,
) -> Layer<AnyChannels<FlatSamples>> {
    let channel = |(name, samples): Named<'_>| AnyChannel::new(name, samples);
    let channels = AnyChannels::sort(channels.into_iter().map(channel).collect());
    let attributes = LayerAttributes {
        layer_name: name.map(Text::new_or_panic),
        ..LayerAttributes::default()
    };
    Layer::new((2, 1), attributes, encoding, channels)
}

/// Writes a file of one part with 2×1 pixels.
fn write(path: &Path, channels: Vec<Named<'_>>) {
    let layer = layer(None, channels, Encoding::FAST_LOSSLESS);
    Image::from_layer(layer).write().to_file(path).unwrap();
}

fn rgb(prefix: &str, value: f32) -> Vec<(String, FlatSamples)> {
    let channel = |(i, name): (usize, &str)| {
        let values = [value + i as f32, 10.0 + value + i as f32];
        (format!("{prefix}{name}"), floats(&values))
    };
    ["R", "G", "B"]
        .into_iter()
        .enumerate()
        .map(channel)
        .collect()
}

fn borrowed(channels: &[(String, FlatSamples)]) -> Vec<Named<'_>> {
    channels
        .iter()
        .map(|(name, samples)| (name.as_str(), samples.clone()))
        .collect()
}

fn read(path: &Path, layer: Option<&str>) -> (Vec<[f32; 3]>, Vec<String>) {
    let file = RgbFile::open(path, layer).unwrap();
    let notes = file.notes().to_vec();
    (file.read().unwrap(), notes)
}

fn refused(path: &Path, layer: Option<&str>) -> ReadRgbError {
    RgbFile::open(path, layer).unwrap_err()
}

#[test]
fn layers_are_found_and_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("layers.exr");
    let combined = rgb("ViewLayer.Combined.", 1.0);
    write(&path, borrowed(&combined));
    let (pixels, notes) = read(&path, None);
    assert_eq!(pixels, [[1., 2., 3.], [11., 12., 13.]]);
    assert!(notes[0].contains("\"ViewLayer.Combined\""), "{notes:?}");

    let mut two = combined.clone();
    two.extend(rgb("ViewLayer.Diffuse.", 5.0));
    write(&path, borrowed(&two));
    let error = refused(&path, None).to_string();
    assert!(
        error.contains("\"ViewLayer.Combined\", \"ViewLayer.Diffuse\""),
        "{error}"
    );
    assert_eq!(
        read(&path, Some("ViewLayer.Diffuse")),
        (vec![[5., 6., 7.], [15., 16., 17.]], vec![])
    );
    let error = refused(&path, Some("Combined"));
    assert!(matches!(error, ReadRgbError::NoSuchLayer { .. }));
    assert!(
        error.to_string().contains("\"ViewLayer.Diffuse\""),
        "{error}"
    );

    two.extend(rgb("", 30.0));
    write(&path, borrowed(&two));
    let (pixels, notes) = read(&path, None);
    assert_eq!((pixels[0], notes.len()), ([30., 31., 32.], 1));
}

#[test]
fn parts_are_layers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("parts.exr");
    let parts = |names: [&str; 3]| {
        let depth = layer(
            Some(names[0]),
            vec![("Z", floats(&[1., 2.]))],
            Encoding::FAST_LOSSLESS,
        );
        let of = |name, value| {
            layer(
                Some(name),
                borrowed(&rgb("", value)),
                Encoding::FAST_LOSSLESS,
            )
        };
        let layers: SmallVec<_> = [depth, of(names[1], 2.0), of(names[2], 4.0)]
            .into_iter()
            .collect();
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 1)));
        let image = Image {
            attributes,
            layer_data: layers,
        };
        image.write().to_file(&path).unwrap();
    };
    parts(["depth", "left", "right"]);
    assert!(matches!(
        refused(&path, None),
        ReadRgbError::SeveralLayers { .. }
    ));
    assert_eq!(
        read(&path, Some("right")).0,
        [[4., 5., 6.], [14., 15., 16.]]
    );
    assert_eq!(read(&path, Some("left")).0, [[2., 3., 4.], [12., 13., 14.]]);
}

/// XYZ of the white of D65, (0.95047, 1, 1.08883), is (1, 1, 1) in sRGB.
#[test]
fn luminance_and_xyz_are_colors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.exr");
    write(&path, vec![("Y", floats(&[0.25, 3.0]))]);
    let (pixels, notes) = read(&path, None);
    assert_eq!(pixels, [[0.25; 3], [3.0; 3]]);
    assert!(notes[0].contains("gray"), "{notes:?}");
    let white = [("X", 0.950_47), ("Y", 1.0), ("Z", 1.088_83)];
    write(
        &path,
        white.map(|(name, v)| (name, floats(&[v, 0.0]))).to_vec(),
    );
    let (pixels, notes) = read(&path, None);
    assert!(
        pixels[0].iter().all(|v| (v - 1.0).abs() < 1e-3),
        "{pixels:?}"
    );
    assert!(notes[0].contains("CIE XYZ") && pixels[1] == [0.0; 3]);
    for chroma in [vec!["Y", "RY", "BY"], vec!["Y", "BY"]] {
        write(
            &path,
            chroma
                .iter()
                .map(|&name| (name, floats(&[1.0; 2])))
                .collect(),
        );
        let error = refused(&path, None).to_string();
        assert!(error.contains("luminance and chroma"), "{error}");
    }
    write(
        &path,
        vec![
            ("Z", floats(&[1.0; 2])),
            ("mask\u{1b}[2J", floats(&[1.0; 2])),
        ],
    );
    let error = refused(&path, None).to_string();
    assert!(
        error.contains("\"Z\"") && !error.contains('\u{1b}'),
        "{error}"
    );
}

/// 1.5 and 2 are exact in every type except integers, where the values are 1 and 2.
#[test]
fn types_tiles_and_compressions_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kinds.exr");
    let half = || FlatSamples::F16([1.5, 2.0].map(f16::from_f32).to_vec());
    let tiles = Blocks::Tiles(Vec2(1, 1));
    for (compression, blocks) in [
        (Compression::Uncompressed, Blocks::ScanLines),
        (Compression::RLE, tiles),
        (Compression::ZIP1, Blocks::ScanLines),
        (Compression::ZIP16, tiles),
        (Compression::PIZ, Blocks::ScanLines),
        (Compression::PXR24, Blocks::ScanLines),
        (Compression::B44, Blocks::ScanLines),
        (Compression::B44A, Blocks::ScanLines),
    ] {
        let encoding = Encoding {
            compression,
            blocks,
            line_order: LineOrder::Increasing,
        };
        let channels = vec![
            ("R", half()),
            ("G", floats(&[1.5, 2.0])),
            ("B", FlatSamples::U32(vec![1, 2])),
            ("mask", floats(&[9.0; 2])),
        ];
        let layer = layer(None, channels, encoding);
        Image::from_layer(layer).write().to_file(&path).unwrap();
        let (pixels, notes) = read(&path, None);
        for (found, expected) in pixels.iter().zip([[1.5, 1.5, 1.0], [2.0; 3]]) {
            assert!(
                found
                    .iter()
                    .zip(expected)
                    .all(|(a, b)| (a - b).abs() < 0.02),
                "{compression}: {pixels:?}"
            );
        }
        assert!(notes.is_empty());
    }
}

#[test]
fn windows_are_those_of_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.exr");
    let write = |position: Vec2<i32>, display: IntegerBounds| {
        let mut layer = layer(None, borrowed(&rgb("", 1.0)), Encoding::FAST_LOSSLESS);
        layer.attributes.layer_position = position;
        Image::new(ImageAttributes::new(display), layer)
            .write()
            .to_file(&path)
            .unwrap();
    };
    write(Vec2(-4, 6), IntegerBounds::new((-5, 5), (3, 2)));
    let black = [0.0; 3];
    let (pixels, notes) = read(&path, None);
    assert_eq!(
        pixels,
        [black, black, black, black, [1., 2., 3.], [11., 12., 13.]]
    );
    assert_eq!(notes.len(), 1);
    write(Vec2(-1, 0), IntegerBounds::new((0, 0), (1, 1)));
    assert_eq!(read(&path, None).0, [[11., 12., 13.]]);
    write(Vec2(0, 0), IntegerBounds::new((0, 0), (40_000, 25_000)));
    assert!(refused(&path, None).to_string().contains("too large"));
}

/// Changes bytes of a valid file: unsupported forms are errors that name them, and no damage is a panic.
#[test]
fn what_is_not_read_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("forms.exr");
    write(&path, borrowed(&rgb("", 1.0)));
    let bytes = std::fs::read(&path).unwrap();
    let said = |at: usize, value: u8| {
        let mut copy = bytes.clone();
        copy[at] = value;
        std::fs::write(&path, copy).unwrap();
        RgbFile::open(&path, None)
            .and_then(RgbFile::read)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    let after = |key: &[u8]| bytes.windows(key.len()).position(|w| w == key).unwrap() + key.len();
    let compression = after(b"compression\0compression\0\x01\0\0\0");
    let error = said(compression, 10).unwrap_err();
    assert!(error.contains("HTJ2K"), "{error}");
    assert!(said(compression, 77).is_err());
    // The first channel is B: its type, a flag and three bytes, then the sampling along x.
    let channels = after(b"channels\0chlist\0") + 4;
    let error = said(channels + 2 + 4 + 4, 2).unwrap_err();
    assert!(
        error.contains("fewer samples") && error.contains("\"G\""),
        "{error}"
    );
    // A second G in place of B.
    let error = said(channels, b'G').unwrap_err();
    assert!(!error.is_empty());
    for at in 0..bytes.len() {
        for value in [0, 0x7f, 0x80, 0xff] {
            let _ = said(at, value);
        }
    }
    for length in 0..bytes.len() {
        std::fs::write(&path, &bytes[..length]).unwrap();
        let whole = RgbFile::open(&path, None).and_then(RgbFile::read);
        assert!(whole.is_err(), "{length} of {} bytes", bytes.len());
    }
}
