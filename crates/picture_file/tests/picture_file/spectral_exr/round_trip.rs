//! Written files are read back, and have the form that the layout requires.

use std::fs;

use colorimetry::srgb;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, SampleType, Text};
use pellicle_picture_file::spectral_exr::{self, Metadata, WriteExrError, WriteOptions};
use relight::xyz::exposure_scale;
use spectra::{BandGrid, SpectralImage};

use super::support::{metadata, noisy, write_noisy};

#[test]
fn what_is_written_is_read_again_to_the_bit() {
    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), true);
    let (found, found_metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(found, image);
    assert_eq!(found_metadata, metadata());
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}

#[test]
fn bands_that_are_no_whole_nanometers_keep_their_grid() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    for grid in [
        BandGrid::visible(48).unwrap(),
        BandGrid::visible(1).unwrap(),
        BandGrid::new(400.1, 699.9, 7).unwrap(),
    ] {
        let image = SpectralImage::new(2, 1, grid);
        spectral_exr::write(&path, &image, &metadata(), WriteOptions::default()).unwrap();
        assert_eq!(spectral_exr::read(&path).unwrap().0.bands(), &grid);
    }
}

#[test]
fn values_that_are_no_numbers_are_kept() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let mut image = SpectralImage::new(1, 1, BandGrid::visible(3).unwrap());
    let odd = [f32::NAN, f32::INFINITY, -0.0];
    image.set_pixel((0, 0), &odd, &odd, odd, u32::MAX);
    spectral_exr::write(&path, &image, &metadata(), WriteOptions::default()).unwrap();
    let (found, _) = spectral_exr::read(&path).unwrap();
    let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(found.radiance()), bits(&odd));
    assert_eq!(bits(found.variance()), bits(&odd));
    assert_eq!(found.samples(), [u32::MAX]);
}

#[test]
fn an_exposure_that_cannot_be_is_0_and_noted() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let image = SpectralImage::new(1, 1, BandGrid::visible(3).unwrap());
    for (written, read, notes) in [
        (-40.0, -40.0, 0),
        (40.0, 40.0, 0),
        (40.1, 0.0, 1),
        (-1e9, 0.0, 1),
        (f64::INFINITY, 0.0, 1),
        (f64::NAN, 0.0, 1),
    ] {
        let metadata = Metadata {
            exposure_ev: written,
            ..Metadata::default()
        };
        spectral_exr::write(&path, &image, &metadata, WriteOptions::default()).unwrap();
        let (_, found) = spectral_exr::read(&path).unwrap();
        assert_eq!(found.exposure_ev, read, "{written}");
        assert_eq!(found.notes.len(), notes, "{:?}", found.notes);
    }
}

#[test]
fn variance_can_be_left_out() {
    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), false);
    let (found, _) = spectral_exr::read(&path).unwrap();
    assert_eq!(found.radiance(), image.radiance());
    assert_eq!(found.xyz(), image.xyz());
    assert!(found.variance().iter().all(|&v| v == 0.0));
}

#[test]
fn channels_and_attributes_are_those_of_the_layout() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let image = SpectralImage::new(3, 2, BandGrid::visible(40).unwrap());
    spectral_exr::write(&path, &image, &metadata(), WriteOptions::default()).unwrap();
    let meta = MetaData::read_from_file(&path, true).unwrap();
    let [header] = meta.headers.as_slice() else {
        panic!("one layer")
    };

    let names: Vec<String> = header
        .channels
        .list
        .iter()
        .map(|c| c.name.to_string())
        .collect();
    let mut expected = vec!["B".to_owned(), "G".to_owned(), "R".to_owned()];
    // Fichet, Pacanowski and Wilkie (2021), section 4: centers with a comma, unit nm.
    expected.extend((0..40).map(|band| format!("S0.{},000000nm", 385 + 10 * band)));
    expected.extend(["cieX", "cieY", "cieZ", "samples"].map(|name| format!("pellicle.{name}")));
    expected.extend((0..40).map(|band| format!("pellicle.variance.{},000000nm", 385 + 10 * band)));
    expected.sort();
    assert_eq!(names, expected);
    for channel in &header.channels.list {
        let is_count = channel.name.eq("pellicle.samples");
        let kind = if is_count {
            SampleType::U32
        } else {
            SampleType::F32
        };
        assert_eq!(channel.sample_type, kind);
    }

    let own = &header.own_attributes;
    let attribute = |name: &str| own.other.get(&Text::new_or_panic(name)).unwrap().clone();
    let text = |text: &str| AttributeValue::Text(Text::new_or_panic(text));
    assert_eq!(attribute("spectralLayoutVersion"), text("1.0"));
    assert_eq!(attribute("emissiveUnits"), text("W.m^-2.sr^-1.nm^-1"));
    assert_eq!(attribute("pellicle.lambdaMin"), AttributeValue::F64(380.0));
    assert_eq!(attribute("pellicle.lambdaMax"), AttributeValue::F64(780.0));
    assert_eq!(attribute("pellicle.exposureEv"), AttributeValue::F64(-1.25));
    assert_eq!(attribute("pellicle.setting.seed"), text("42"));
    assert!(
        own.software_name
            .as_ref()
            .unwrap()
            .to_string()
            .starts_with("Pellicle ")
    );
    assert!(header.shared_attributes.chromaticities.is_some());
}

#[test]
fn viewers_get_the_developed_color() {
    use exr::prelude::read_first_flat_layer_from_file;

    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), true);
    let layer = read_first_flat_layer_from_file(&path).unwrap().layer_data;
    let channel = |name: &str| {
        let mut list = layer.channel_data.list.iter();
        let channel = list.find(|channel| channel.name.eq(name)).unwrap();
        channel.sample_data.values_as_f32().collect::<Vec<f32>>()
    };
    let scale = exposure_scale(metadata().exposure_ev);
    for (index, name) in ["R", "G", "B"].into_iter().enumerate() {
        for (found, xyz) in channel(name).into_iter().zip(image.xyz()) {
            let rgb = srgb::linear_from_xyz(xyz.map(|v| f64::from(v) * scale));
            assert_eq!(found.to_bits(), (rgb[index] as f32).to_bits());
        }
    }
}

#[test]
fn a_failure_to_write_leaves_no_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let write = |image: &SpectralImage, metadata: &Metadata| {
        spectral_exr::write(&path, image, metadata, WriteOptions::default()).unwrap_err()
    };
    let empty = SpectralImage::new(0, 3, BandGrid::visible(2).unwrap());
    assert!(matches!(
        write(&empty, &metadata()),
        WriteExrError::Empty { .. }
    ));
    for name in [String::new(), "a\0b".to_owned(), "x".repeat(239)] {
        let mut metadata = metadata();
        metadata.settings.insert(name, String::new());
        let error = write(&noisy(2, 2, 2), &metadata);
        assert!(
            matches!(error, WriteExrError::SettingName { .. }),
            "{error}"
        );
    }
    let nowhere = directory.path().join("missing").join("image.exr");
    let image = noisy(2, 2, 2);
    let error = spectral_exr::write(&nowhere, &image, &metadata(), WriteOptions::default());
    assert!(matches!(error, Err(WriteExrError::File { .. })));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn colors_alone_are_those_of_the_whole_image() {
    let directory = tempfile::tempdir().unwrap();
    let (path, image) = write_noisy(directory.path(), true);
    let (found, found_metadata) = spectral_exr::read_xyz(&path).unwrap();
    assert_eq!(found.xyz(), image.xyz());
    assert_eq!(
        (found.width(), found.height()),
        (image.width(), image.height())
    );
    assert_eq!(found_metadata, metadata());

    // A file that is cut short is an error here too.
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() - bytes.len() / 4]).unwrap();
    assert!(spectral_exr::read_xyz(&path).is_err());
}
