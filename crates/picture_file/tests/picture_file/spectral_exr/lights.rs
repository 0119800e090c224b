//! Light groups are written as layers and read back.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use exr::meta::MetaData;
use pellicle_picture_file::spectral_exr::{self, ReadExrError, WriteExrError, WriteOptions};
use spectra::{BandGrid, LightGroup, SpectralImage};

use super::support::{metadata, noise};

/// An image of light groups with these lamps in which every number differs.
fn image(groups: &[(&str, Option<&str>)]) -> SpectralImage {
    let grid = BandGrid::visible(5).unwrap();
    let lamp = |name: &str| grid.lamp(&spectra::illuminant(name).unwrap().data);
    let group = |(name, burns): &(&str, Option<&str>)| LightGroup {
        name: (*name).to_owned(),
        lamp: burns.and_then(lamp),
    };
    let list = groups.iter().map(group).collect();
    let mut image = SpectralImage::with_light_groups(9, 35, grid, list);
    let values = 5 * groups.len() as u32;
    for (x, y) in (0..9 * 35).map(|i| (i % 9, i / 9)) {
        let first = (y * 9 + x) * 100;
        let radiance: Vec<f32> = (0..values).map(|i| noise(first + i)).collect();
        let variance: Vec<f32> = (0..5).map(|i| noise(first + 60 + i)).collect();
        let xyz: Vec<_> = (0..groups.len() as u32)
            .map(|group| [0, 1, 2].map(|i| noise(first + 70 + 3 * group + i)))
            .collect();
        image.set_pixel_by_light((x, y), &radiance, &variance, &xyz, x + y);
    }
    image
}

fn write(path: &Path, image: &SpectralImage) -> Result<(), WriteExrError> {
    spectral_exr::write(path, image, &metadata(), WriteOptions::default())
}

fn channels(path: &Path) -> BTreeSet<String> {
    let meta = MetaData::read_from_file(path, true).unwrap();
    let list = meta.headers[0].channels.list.iter();
    list.map(|channel| channel.name.to_string()).collect()
}

#[test]
fn light_groups_come_back_to_the_bit() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let several = [("sky", Some("D65")), ("key", Some("FL11")), ("mixed", None)];
    let one = [("D65", Some("D65"))];
    for groups in [&several[..], &several[1..], &one, &[("all", None)]] {
        let image = image(groups);
        write(&path, &image).unwrap();
        let (found, found_metadata) = spectral_exr::read(&path).unwrap();
        assert_eq!(found, image);
        assert_eq!(found_metadata, metadata());
    }
}

#[test]
fn each_of_several_light_groups_is_a_layer() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    write(&path, &image(&[("only", Some("A"))])).unwrap();
    let single = channels(&path);
    write(&path, &image(&[("sky", None), ("key", None)])).unwrap();
    let both = channels(&path);
    assert!(both.is_superset(&single) && both.len() == single.len() + 2 * (5 + 6));
    for name in [
        "sky.R",
        "key.B",
        "pellicle.light.key.cieX",
        "pellicle.light.sky.420,000000nm",
    ] {
        assert!(both.contains(name), "{name}");
    }
}

/// Bit 10 of the version field marks names longer than 31 bytes.
#[test]
fn long_names_are_marked() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let longest = "abcdefghijklmnopqrstuvwxyz_01234";
    assert_eq!(longest.len(), LightGroup::MAX_NAME);
    let flags = || {
        let version = fs::read(&path).unwrap()[4..8].try_into().unwrap();
        u32::from_le_bytes(version)
    };
    write(&path, &image(&[("only", None)])).unwrap();
    assert_eq!(flags(), 2);
    let image = image(&[(longest, Some("D65")), ("key", None)]);
    write(&path, &image).unwrap();
    assert_eq!(flags(), 2 | 1 << 10);
    let (found, found_metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(found, image);
    assert_eq!(found_metadata, metadata());
}

#[test]
fn names_that_cannot_be_layers_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    for names in [
        ["a", "a"],
        ["a", "b.c"],
        ["", "b"],
        ["S0", "b"],
        ["a", "b c"],
    ] {
        let refused = write(&path, &image(&names.map(|name| (name, None))));
        assert!(
            matches!(refused, Err(WriteExrError::LightGroup { .. })),
            "{names:?}"
        );
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn a_unit_that_is_a_scale_away_is_that_of_all_light() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let written = image(&[("sky", None), ("key", None)]);
    write(&path, &written).unwrap();
    replaced(&path, "W.m^-2.sr^-1.nm^-1", "W.m^-2.sr^-1.um^-1");
    let (found, _) = spectral_exr::read(&path).unwrap();
    let check = |found: &[f32], written: &[f32], scale: f32| {
        assert_eq!(found.len(), written.len());
        for (found, written) in found.iter().zip(written) {
            let expected = scale * written;
            assert!((found - expected).abs() <= 1e-6 * expected, "{scale}");
        }
    };
    check(found.variance(), written.variance(), 1e-6);
    for group in 0..2 {
        let [xyz, written_xyz] =
            [&found, &written].map(|image| image.group_xyz(group).as_flattened());
        check(xyz, written_xyz, 1e-3);
        check(
            found.group_radiance(group),
            written.group_radiance(group),
            1e-3,
        );
    }
    check(
        found.xyz().as_flattened(),
        written.xyz().as_flattened(),
        1e-3,
    );
    check(found.radiance(), written.radiance(), 1e-3);
    let (colors, _) = spectral_exr::read_xyz(&path).unwrap();
    check(
        colors.xyz().as_flattened(),
        written.xyz().as_flattened(),
        1e-3,
    );
}

/// A lamp with unlimited wavelengths could keep a reader busy forever.
#[test]
fn a_lamp_that_is_none_is_unknown_and_noted() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    let grid = BandGrid::visible(5).unwrap();
    let written = image(&[("sky", Some("A")), ("key", Some("D65"))]);
    write(&path, &written).unwrap();
    let lamp = written.light_groups()[0].lamp.as_ref().unwrap();
    let last = lamp.points().last().unwrap();
    assert_eq!(last.0, grid.max_nm());
    let line = format!("780,{}", last.1);
    replaced(&path, &line, &format!("9e9,{}", last.1));
    let (found, metadata) = spectral_exr::read(&path).unwrap();
    assert_eq!(found.light_groups()[0].lamp, None);
    assert_eq!(found.light_groups()[1], written.light_groups()[1]);
    assert_eq!(found.radiance(), written.radiance());
    let [note] = metadata.notes.as_slice() else {
        panic!("{:?}", metadata.notes)
    };
    assert!(note.contains("\"sky\""), "{note}");
}

/// Replaces some bytes of a file by the same number of other bytes.
fn replaced(path: &Path, from: &str, to: &str) {
    assert_eq!(from.len(), to.len());
    let mut bytes = fs::read(path).unwrap();
    let at = bytes.windows(from.len()).position(|w| w == from.as_bytes());
    let at = at.expect("the header has it");
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    fs::write(path, bytes).unwrap();
}

#[test]
fn a_light_group_without_its_channels_is_damage() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("image.exr");
    write(&path, &image(&[("sky", None), ("key", None)])).unwrap();
    replaced(&path, "pellicle.light.key.cieX", "pellicle.light.key.cieW");
    match spectral_exr::read(&path) {
        Err(ReadExrError::Damaged { reason, .. }) => {
            assert_eq!(reason, "the light group \"key\" lacks channels");
        }
        other => panic!("{other:?}"),
    }
    // The list of names is not usable, but the total is there.
    let image = image(&[("sky", None), ("key", None)]);
    write(&path, &image).unwrap();
    replaced(&path, "sky key", "sky sky");
    let (found, _) = spectral_exr::read(&path).unwrap();
    assert_eq!(found.light_groups(), [LightGroup::unknown()]);
    assert_eq!(found.radiance(), image.radiance());
    assert_eq!(found.xyz(), image.xyz());
}
