//! S1, S2 and S3 are written as channels and read back, also from files of other programs.

use std::path::Path;

use exr::meta::MetaData;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, FlatSamples, Image, Text, WritableImage,
};
use pellicle_picture_file::spectral_exr::{self, RowReader, WriteOptions};
use relight::BandWeights;
use spectra::{BandGrid, LayerKey, LightGroup, Observer, Quantity, SpectralImage, Stokes, stokes};

use super::support::{metadata, noise, noisy, rows_of};

/// An image in which every number differs; S1, S2 and S3 have both signs.
fn image(groups: &[&str]) -> SpectralImage {
    let group = |name: &&str| LightGroup {
        name: (*name).to_owned(),
        lamp: None,
    };
    let list = groups.iter().map(group).collect();
    let grid = BandGrid::visible(5).unwrap();
    let mut image = SpectralImage::with_light_groups(9, 35, grid, list).with_polarization();
    let signed = |index: u32| 2.0 * noise(index) - 1.0;
    for (x, y) in (0..9 * 35).map(|i| (i % 9, i / 9)) {
        for component in Stokes::ALL {
            let first = 1000 * (y * 9 + x) + 200 * component.index() as u32;
            let values = 0..5 * groups.len() as u32;
            let radiance: Vec<f32> = values.map(|i| signed(first + i)).collect();
            let xyz: Vec<_> = (0..groups.len() as u32)
                .map(|group| [0, 1, 2].map(|i| signed(first + 70 + 3 * group + i)))
                .collect();
            if component == Stokes::S0 {
                image.set_pixel_by_light((x, y), &radiance, &[0.5; 5], &xyz, 3);
            } else {
                image.set_component_by_light((x, y), component, &radiance, &xyz);
            }
        }
    }
    image
}

fn header_of(path: &Path) -> (Vec<String>, Option<AttributeValue>) {
    let meta = MetaData::read_from_file(path, true).unwrap();
    let channels = meta.headers[0].channels.list.iter();
    let names = channels.map(|channel| channel.name.to_string()).collect();
    let attributes = &meta.headers[0].own_attributes.other;
    let handedness = Text::new_or_panic("polarisationHandedness");
    (names, attributes.get(&handedness).cloned())
}

#[test]
fn components_come_back_to_the_bit() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    for groups in [&["all"][..], &["key", "s1", "sky"]] {
        let image = image(groups);
        spectral_exr::write(&path, &image, &metadata(), WriteOptions::default()).unwrap();
        let (found, found_metadata) = spectral_exr::read(&path).unwrap();
        assert!(found.is_polarized());
        for key in image.layers().iter().map(spectra::ImageLayer::key) {
            assert!(found.layer(key) == image.layer(key), "{key:?}");
        }
        assert_eq!(found_metadata, metadata());
        let (names, handedness) = header_of(&path);
        let right = AttributeValue::Text(Text::new_or_panic("right"));
        assert_eq!(handedness, Some(right));
        for name in ["S0.420,000000nm", "S3.420,000000nm", "pellicle.S2.cieZ"] {
            assert!(names.iter().any(|own| own == name), "{name}: {names:?}");
        }
        assert!(!names.iter().any(|own| own.starts_with("S1.R")));
        // In strips it is the same.
        let mut rows = RowReader::open(&path).unwrap();
        assert_eq!(rows.content(), image.content());
        assert_eq!(rows.read(20..33).unwrap(), rows_of(&image, 20..33));
        assert_eq!(rows.read_xyz().unwrap().xyz(), image.xyz());
    }
}

#[test]
fn an_image_without_polarization_has_no_such_channels() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let image = noisy(4, 3, 5);
    spectral_exr::write(&path, &image, &metadata(), WriteOptions::default()).unwrap();
    let (names, handedness) = header_of(&path);
    assert_eq!((names.len(), handedness), (2 * 5 + 7, None));
    assert!(!RowReader::open(&path).unwrap().content().is_polarized);
}

/// Writes channels as another program might: each sample of one is its number.
fn write_foreign(path: &Path, channels: &[(&str, f32)], attributes: &[(&str, &str)]) {
    let channel =
        |&(name, value): &(&str, f32)| AnyChannel::new(name, FlatSamples::F32(vec![value; 6]));
    let channels = AnyChannels::sort(channels.iter().map(channel).collect());
    let mut image = Image::from_channels((3, 2), channels);
    for (name, value) in attributes {
        let value = AttributeValue::Text(Text::new_or_panic(value));
        let attributes = &mut image.layer_data.attributes.other;
        attributes.insert(Text::new_or_panic(name), value);
    }
    image.write().to_file(path).unwrap();
}

const FOREIGN: [(&str, f32); 8] = [
    ("S0.450nm", 4.0),
    ("S0.460nm", 5.0),
    ("S1.0,45um", -1.0),
    ("S1.460nm", -2.0),
    ("S2.450nm", 0.5),
    ("S2.460nm", 0.25),
    ("S3.450nm", 3.0),
    ("S3.460nm", 2.0),
];

#[test]
fn the_handedness_of_other_programs_decides_over_the_sign_of_s3() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    for (handedness, sign, notes) in [
        (Some("right"), 1.0, 0),
        (Some("left"), -1.0, 1),
        (Some("up"), 1.0, 1),
        (None, 1.0, 1),
    ] {
        let mut attributes = vec![("emissiveUnits", "mW.m^-2.sr^-1.nm^-1")];
        attributes.extend(handedness.map(|hand| ("polarisationHandedness", hand)));
        write_foreign(&path, &FOREIGN, &attributes);
        let (image, metadata) = spectral_exr::read(&path).unwrap();
        // One note is on the unit.
        assert_eq!(metadata.notes.len(), 1 + notes, "{:?}", metadata.notes);
        let of = |stokes| {
            let layer = image.layer(LayerKey::RADIANCE.component(stokes)).unwrap();
            let values = layer.floats();
            [values[0], values[1]].map(|v| (1e3 * v * 1e4).round() / 1e4)
        };
        let found = Stokes::ALL.map(of);
        let expected = [
            [4.0, 5.0],
            [-1.0, -2.0],
            [0.5, 0.25],
            [3.0 * sign, 2.0 * sign],
        ];
        assert_eq!(found, expected, "{handedness:?}");
        // XYZ is that of the bands.
        let weights = BandWeights::observed(image.bands(), Observer::Cie1931Deg2);
        for stokes in Stokes::ALL {
            let bands = image.group_component(0, stokes);
            let xyz = weights.xyz(&bands[..2]).map(|v| v as f32);
            assert_eq!(image.group_component_xyz(0, stokes)[0], xyz, "{stokes:?}");
        }
        let vector = found.map(|of_bands| f64::from(of_bands[0]));
        assert!(stokes::degree_of_polarization(vector) > 0.7);
    }
}

#[test]
fn incomplete_polarization_is_ignored_with_a_note() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let without = |name: &str| -> Vec<(&str, f32)> {
        let kept = FOREIGN.into_iter();
        kept.filter(|(own, _)| !own.starts_with(name)).collect()
    };
    let mut shifted = without("S2.450nm");
    shifted.push(("S2.451nm", 1.0));
    for (channels, said) in [
        (without("S2"), "has no S2"),
        (
            without("S3.460nm"),
            "its S3 has other wavelengths than its S0",
        ),
        (shifted, "its S2 has other wavelengths than its S0"),
    ] {
        write_foreign(&path, &channels, &[]);
        let (image, metadata) = spectral_exr::read(&path).unwrap();
        assert!(!image.is_polarized());
        assert_eq!(image.layers().len(), LayerKey::all(1).count());
        assert_eq!(image.pixel(2, 1), [4.0, 5.0]);
        let [note] = &metadata.notes[..] else {
            panic!("{:?}", metadata.notes);
        };
        assert!(note.contains(said) && note.contains("ignored"), "{note}");
    }
}

/// Bands of different widths are mixed in all components alike.
#[test]
fn uneven_bands_are_mixed_in_all_components() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let names = Stokes::ALL
        .map(|stokes| ["450", "460", "480"].map(|nm| format!("{}.{nm}nm", stokes.name())));
    let channels: Vec<(&str, f32)> = names
        .as_flattened()
        .iter()
        .zip(0_u8..)
        .map(|(name, i)| (name.as_str(), f32::from(1 + i % 3) / f32::from(1 + i / 3)))
        .collect();
    write_foreign(&path, &channels, &[("polarisationHandedness", "right")]);
    let (image, _) = spectral_exr::read(&path).unwrap();
    assert!(image.bands().count() > 3);
    for (stokes, part) in Stokes::ALL.into_iter().zip([1.0, 2.0, 3.0, 4.0]) {
        let key = LayerKey::total(Quantity::Radiance).component(stokes);
        let values = image.layer(key).unwrap().floats();
        for (value, of_s0) in values.iter().zip(image.radiance()) {
            assert!((part * value - of_s0).abs() < 1e-5, "{stokes:?}");
        }
    }
}
