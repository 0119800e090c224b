//! Files of other programs.

use std::path::Path;

use pellicle_picture_file::spectral_exr::{self, Metadata, ReadExrError};
use relight::BandWeights;
use spectra::{BandGrid, SpectralImage};

/// Writes a file with these channels, as another program might.
fn write_foreign(path: &Path, names: &[&str]) {
    use exr::prelude::*;

    let channel = |&name: &&str| {
        let samples = FlatSamples::F16((0..6).map(|i| f16::from_f32(i as f32)).collect());
        AnyChannel::new(name, samples)
    };
    let channels = AnyChannels::sort(names.iter().map(channel).collect());
    let image = Image::from_channels((3, 2), channels);
    image.write().to_file(path).unwrap();
}

#[test]
fn files_of_other_programs_are_read() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let names = [
        "R",
        "S0.500nm",
        "S0.4,5e2nm",
        "S0.550,00nm",
        "S1.450nm",
        "T.450nm",
    ];
    write_foreign(&path, &names);
    let (image, metadata) = spectral_exr::read(&path).unwrap();
    let grid = BandGrid::new(425.0, 575.0, 3).unwrap();
    assert_eq!(image.bands(), &grid);
    assert_eq!(image.pixel(2, 1), [5.0; 3]);
    assert_eq!((image.samples()[0], metadata.software.as_str()), (0, ""));
    let xyz = BandWeights::observed(&grid, spectra::Observer::Cie1931Deg2)
        .xyz(&[5.0; 3])
        .map(|v| v as f32);
    assert_eq!(image.xyz()[5].map(f32::to_bits), xyz.map(f32::to_bits));
}

/// Writes a file with a unit in the header, as other programs do.
fn write_with_unit(path: &Path, names: &[&str], unit: &str) {
    use exr::prelude::*;

    let channel = |&name: &&str| AnyChannel::new(name, FlatSamples::F32(vec![2.0; 6]));
    let channels = AnyChannels::sort(names.iter().map(channel).collect());
    let mut image = Image::from_channels((3, 2), channels);
    image.layer_data.attributes.other.insert(
        Text::new_or_panic("emissiveUnits"),
        AttributeValue::Text(Text::new_or_panic(unit)),
    );
    image.write().to_file(path).unwrap();
}

/// Writes and reads a file whose samples are 0 to 5, the same in every channel.
fn read_foreign(path: &Path, names: &[&str]) -> (SpectralImage, Metadata) {
    write_foreign(path, names);
    spectral_exr::read(path).unwrap()
}

#[test]
fn any_unit_and_order_of_wavelengths_is_the_same_spectrum() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let grid = BandGrid::new(445.0, 475.0, 3).unwrap();
    for names in [
        &["S0.470nm", "S0.450nm", "S0.460nm"][..],
        &["S0.0,47um", "S0.4,5e-7m", "S0.460000pm"],
        &["S0.470.0nm", "S0.450.0nm", "S0.460.0nm"],
        &["S0.637,856295THz", "S0.666,205462THz", "S0.651,722735THz"],
        &["450.00-460.00nm", "460.00-470.00nm"],
    ] {
        let (image, metadata) = read_foreign(&path, names);
        let found = image.bands();
        if names.len() == 3 {
            assert_eq!(found.count(), 3, "{names:?}");
            assert!((found.min_nm() - grid.min_nm()).abs() < 1e-3, "{names:?}");
            assert!((found.max_nm() - grid.max_nm()).abs() < 1e-3, "{names:?}");
        } else {
            assert_eq!(found, &BandGrid::new(450.0, 470.0, 2).unwrap());
        }
        assert_eq!(metadata.notes, [""; 0], "{names:?}");
    }
}

/// Each channel has its own number, so a band in the wrong position is noticed.
#[test]
fn each_band_comes_from_its_own_channel() {
    use exr::prelude::*;

    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    // The names are not in the order of wavelengths; 1000 nm is left out.
    let values = [
        ("S0.0,7um", 3.0),
        ("S0.1000nm", 4.0),
        ("S0.400nm", 1.0),
        ("S0.545,077196THz", 2.0),
        ("S0.850nm", 5.0),
    ];
    let channel = |&(name, v): &(&str, f32)| AnyChannel::new(name, FlatSamples::F32(vec![v; 6]));
    let channels = AnyChannels::sort(values.iter().map(channel).collect());
    Image::from_channels((3, 2), channels)
        .write()
        .to_file(&path)
        .unwrap();
    let (image, metadata) = spectral_exr::read(&path).unwrap();
    let (min_nm, max_nm) = (image.bands().min_nm(), image.bands().max_nm());
    // The first band begins at 325 nm and is cut at 360; the band at 850 nm begins at 775, in the visible range, and is cut at 830.
    assert_eq!((min_nm, max_nm), (360.0, 830.0));
    let pixel = image.pixel(2, 1);
    assert_eq!((pixel[0], pixel[pixel.len() - 1]), (1.0, 5.0));
    assert!(pixel.windows(2).all(|pair| pair[0] <= pair[1]));
    assert_eq!(metadata.notes.len(), 2, "{:?}", metadata.notes);
}

#[test]
fn units_are_converted_where_they_are_a_scale_away() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    for (unit, value, notes, now) in [
        ("W.m^-2.sr^-1.nm^-1", 2.0, 0, "W.m^-2.sr^-1.nm^-1"),
        ("W.m^-2.sr^-1", 2.0, 0, "W.m^-2.sr^-1"),
        ("mW.m^-2.sr^-1.nm^-1", 2e-3, 1, "W.m^-2.sr^-1.nm^-1"),
        ("W.m^-2.nm^-1", 2.0, 1, "W.m^-2.nm^-1"),
    ] {
        write_with_unit(&path, &["S0.450nm", "S0.460nm"], unit);
        let (image, metadata) = spectral_exr::read(&path).unwrap();
        assert_eq!(image.pixel(0, 0), [value; 2], "{unit}");
        assert_eq!(metadata.notes.len(), notes, "{unit}");
        assert_eq!(metadata.emissive_units, now);
    }
}

/// Reading bands of different widths onto even ones neither loses nor adds light.
#[test]
fn uneven_bands_keep_their_light() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let (image, metadata) = read_foreign(&path, &["S0.400nm", "S0.410nm", "S0.430nm"]);
    let bands = image.bands();
    assert_eq!((bands.min_nm(), bands.max_nm()), (395.0, 440.0));
    assert_eq!(bands.count(), 5);
    for value in image.pixel(2, 1) {
        assert!((value - 5.0).abs() < 1e-5, "{value}");
    }
    assert!(metadata.notes[0].contains("different widths"));
}

#[test]
fn the_first_part_with_radiances_is_read() {
    use exr::prelude::*;

    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("parts.exr");
    let layer = |name: &str, channels: &[&str], value: f32| {
        let channel = |&name: &&str| AnyChannel::new(name, FlatSamples::F32(vec![value; 6]));
        let channels = AnyChannels::sort(channels.iter().map(channel).collect());
        let attributes = LayerAttributes::named(Text::new_or_panic(name));
        Layer::new((3, 2), attributes, Encoding::FAST_LOSSLESS, channels)
    };
    let layers = [
        layer("color", &["R", "G", "B"], 1.0),
        layer("reflectance", &["T.450nm", "T.460nm"], 2.0),
        layer("left", &["S0.450nm", "S0.460nm"], 3.0),
        layer("right", &["S0.450nm", "S0.460nm"], 4.0),
    ];
    let window = IntegerBounds::from_dimensions((3, 2));
    let attributes = ImageAttributes::new(window);
    let layers: SmallVec<_> = layers.into_iter().collect();
    let image = Image {
        attributes,
        layer_data: layers,
    };
    image.write().to_file(&path).unwrap();
    let (image, metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(image.pixel(1, 1), [3.0; 2]);
    assert!(metadata.notes[0].contains("several parts"));
}

#[test]
fn spectra_that_cannot_be_used_are_distinguished() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("foreign.exr");
    let fault = |names: &[&str]| {
        write_foreign(&path, names);
        spectral_exr::read(&path).unwrap_err()
    };
    for names in [&["R", "G", "B"][..], &["S1.450nm", "T.450nm.460nm"]] {
        assert!(matches!(fault(names), ReadExrError::NoSpectrum { .. }));
    }
    for names in [
        &["S0.400nm", "S0.400,0nm"][..],
        &["S0.500nm", "S0.0,5um", "S0.600nm"],
        &["S0.550nm"],
        &["S0.900nm", "S0.910nm"],
        &["S0.450nm", "S0.red"],
        &["400.00-410.00nm", "420.00-430.00nm"],
    ] {
        let error = fault(names);
        assert!(
            matches!(error, ReadExrError::Bands { .. }),
            "{names:?}: {error}"
        );
        let reason = std::error::Error::source(&error).unwrap().to_string();
        assert!(!reason.is_empty() && !reason.contains('\n'), "{reason}");
    }
}

/// A file may have more channels than a band grid may have bands.
#[test]
fn too_many_bands_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("many.exr");
    let names: Vec<String> = (0..2000)
        .map(|i| format!("S0.{}pm", 400_000 + 100 * i))
        .collect();
    write_foreign(&path, &names.iter().map(String::as_str).collect::<Vec<_>>());
    let error = spectral_exr::read(&path).unwrap_err();
    let reason = std::error::Error::source(&error).unwrap().to_string();
    assert_eq!(reason, "2000 bands; between 1 and 1024 are possible");
}
