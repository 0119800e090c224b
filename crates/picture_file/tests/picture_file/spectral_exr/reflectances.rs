//! Files of reflectances, shown under an illuminant.

use std::path::Path;

use exr::prelude::*;
use pellicle_picture_file::spectral_exr::{self, Metadata};
use relight::xyz::equal_energy_luminance;
use relight::{Relight, relight};
use spectra::{Observer, SpectralImage, illuminant};

/// D65 at a few wavelengths (CIE 15), in the form that other programs write.
const D65_TABLE: &str =
    "380nm:50.0;440nm:104.9;500nm:109.4;560nm:100.0;620nm:87.7;680nm:78.3;740nm:75.1;780nm:63.4";

fn write(path: &Path, reflectance: f32, illuminant: Option<&str>) {
    let nm = (400..=700).step_by(20);
    let channel = |nm| {
        let name = Text::new_or_panic(format!("T.{nm},0nm"));
        AnyChannel::new(name, FlatSamples::F32(vec![reflectance; 2]))
    };
    let channels = AnyChannels::sort(nm.map(channel).collect());
    let mut image = Image::from_channels((2, 1), channels);
    if let Some(text) = illuminant {
        let other = &mut image.layer_data.attributes.other;
        let value = AttributeValue::Text(Text::new_or_panic(text));
        other.insert(Text::new_or_panic("illuminant"), value);
    }
    image.write().to_file(path).unwrap();
}

fn read(reflectance: f32, illuminant: Option<&str>) -> (SpectralImage, Metadata) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("reflectance.exr");
    write(&path, reflectance, illuminant);
    let (xyz, _) = spectral_exr::read_xyz(&path).unwrap();
    let (image, metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(xyz.xyz(), image.xyz());
    (image, metadata)
}

/// Returns XYZ with Y = 1 for a perfect white.
fn xyz(image: &SpectralImage) -> [f64; 3] {
    image.xyz()[1].map(|value| f64::from(value) / equal_energy_luminance())
}

/// The white of D65 is (0.95047, 1, 1.08883) (CIE 15), and a gray of 0.9 is 0.9 of it.
#[test]
fn a_gray_under_d65_is_that_share_of_the_white() {
    for (said, note) in [
        (None, "names no illuminant"),
        (Some("D65"), "its illuminant D65"),
        (Some("CIE d65"), "its illuminant D65"),
        (Some(D65_TABLE), "under D65, which its table matches"),
        (Some("my lamp\u{1b}[2J"), "not known"),
        (Some("nm:1;2"), "not known"),
        (Some("NaNnm:1;500nm:1"), "not known"),
    ] {
        let (image, metadata) = read(0.9, said);
        let notes = metadata.notes.join("\n");
        assert!(
            notes.contains(note) && !notes.contains('\u{1b}'),
            "{said:?}: {notes}"
        );
        assert!(notes.contains("390 to 710 nm"), "{notes}");
        for (found, white) in xyz(&image).into_iter().zip([0.950_47, 1.0, 1.088_83]) {
            assert!(
                (found - 0.9 * white).abs() < 1e-3,
                "{said:?}: {found} {white}"
            );
        }
    }
}

/// The chromaticity of A is (0.44758, 0.40745) (CIE 15).
#[test]
fn the_illuminant_that_a_file_names_lights_it() {
    let (image, _) = read(0.5, Some("A"));
    let [x, y, z] = xyz(&image);
    assert!((y - 0.5).abs() < 1e-4);
    assert!((x / (x + y + z) - 0.447_58).abs() < 5e-4, "{x}");
    assert!((y / (x + y + z) - 0.407_45).abs() < 5e-4, "{y}");
}

/// A table of an unknown lamp: the constant 7 is an equal-energy spectrum.
#[test]
fn the_table_of_another_lamp_is_normalized() {
    let (image, metadata) = read(1.0, Some("500nm:7;600nm:7"));
    for value in xyz(&image) {
        assert!((value - 1.0).abs() < 1e-3, "{value}");
    }
    assert!((f64::from(image.pixel(0, 0)[10]) - 1.0).abs() < 1e-3);
    let notes = metadata.notes.join("\n");
    assert!(notes.contains("table") || notes.contains(" E"), "{notes}");
}

#[test]
fn reflectances_are_seen_under_other_lamps() {
    let (mut image, _) = read(0.9, None);
    assert_eq!(image.light_groups()[0].name, "illuminant");
    let mut burn = |name: &str| {
        let lamp = illuminant(name).map(|set| set.data);
        let change = Relight { lamp, factor: 1.0 };
        relight(
            &mut image,
            &[("illuminant".into(), change)],
            Observer::Cie1931Deg2,
        )
        .unwrap();
        xyz(&image)
    };
    let [x, y, z] = burn("A");
    assert!((y - 0.9).abs() < 2e-3, "{y}");
    assert!((x / (x + y + z) - 0.447_58).abs() < 5e-4);
    let [x, y, z] = burn("D65");
    assert!((x - 0.855_42).abs() < 2e-3 && (y - 0.9).abs() < 2e-3 && (z - 0.979_95).abs() < 2e-3);
}
