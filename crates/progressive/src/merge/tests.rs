//! Files with polarized light are joined with all components.

use super::*;
use spectra::{BandGrid, LayerKey, LightGroup, Stokes, Window};

const SIZE: [u32; 2] = [5, 6];

/// An image whose values depend on `seed` and the pixel, its components too.
fn image(seed: u32, is_polarized: bool) -> SpectralImage {
    let groups = ["key", "sky"].map(|name| LightGroup {
        name: name.to_owned(),
        lamp: None,
    });
    let bands = BandGrid::visible(2).unwrap();
    let mut image = SpectralImage::with_light_groups(SIZE[0], SIZE[1], bands, groups.to_vec());
    if is_polarized {
        image = image.with_polarization();
    }
    for (x, y) in (0..SIZE[0] * SIZE[1]).map(|i| (i % SIZE[0], i / SIZE[0])) {
        for (stokes, factor) in Stokes::ALL.into_iter().zip([4.0, -3.0, 2.0, 1.0]) {
            let value = factor * (1 + seed + x + 10 * y) as f32;
            let (values, xyz) = ([value, 1.0, 2.0 * value, 3.0], [[value; 3], [1.0; 3]]);
            if stokes == Stokes::S0 {
                image.set_pixel_by_light((x, y), &values, &[0.5; 2], &xyz, 4);
            } else {
                image.set_component_by_light((x, y), stokes, &values, &xyz);
            }
        }
    }
    image
}

/// Writes some rows of an image as a part of it, with four samples from `first` on.
fn write(path: &Path, image: &SpectralImage, rows: Range<u32>, first: u32) {
    let mut metadata = Metadata::default();
    for (name, value) in [
        ("identity.seed", "1".to_owned()),
        ("samples_from", first.to_string()),
        ("samples", "4".to_owned()),
    ] {
        metadata.settings.insert(name.to_owned(), value);
    }
    let (origin, size) = ([0, rows.start], [SIZE[0], rows.end - rows.start]);
    let frame = Frame {
        picture: SIZE,
        window: Window { origin, size },
    };
    let whole = path.with_extension("whole");
    spectral_exr::write(&whole, image, &metadata, WriteOptions::default()).unwrap();
    let mut strip = Some(RowReader::open(&whole).unwrap().read(rows).unwrap());
    let mut next = || Ok::<_, ReadExrError>(strip.take());
    spectral_exr::write_rows(path, frame, &metadata, WriteOptions::default(), &mut next).unwrap();
}

#[test]
fn parts_and_ranges_keep_all_components() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b, all] = ["a", "b", "all"].map(|name| folder.path().join(name));
    let (first, second) = (image(0, true), image(2, true));
    write(&a, &first, 0..2, 0);
    write(&b, &first, 2..6, 0);
    assert_eq!(merge(&[b.clone(), a.clone()], &all).unwrap(), Merged::Parts);
    assert!(spectral_exr::read(&all).unwrap().0 == first);

    write(&a, &first, 0..6, 0);
    write(&b, &second, 0..6, 4);
    assert_eq!(merge(&[a, b], &all).unwrap(), Merged::Ranges);
    let (found, between) = (spectral_exr::read(&all).unwrap().0, image(1, true));
    for key in LayerKey::polarized(2) {
        assert!(found.layer(key) == between.layer(key), "{key:?}");
    }
    assert_eq!(found.xyz(), between.xyz());
}

#[test]
fn polarized_and_unpolarized_files_are_not_joined() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b, all] = ["a", "b", "all"].map(|name| folder.path().join(name));
    write(&a, &image(0, true), 0..2, 0);
    write(&b, &image(0, false), 2..6, 0);
    for (files, said) in [
        ([&a, &b], "b does not have S1, S2 and S3"),
        ([&b, &a], "a has S1, S2 and S3"),
    ] {
        let error = merge(&files.map(Clone::clone), &all).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
    }
    assert!(!all.exists());
}
