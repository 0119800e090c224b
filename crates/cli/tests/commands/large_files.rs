//! Tests of images that `inspect`, `compare` and `develop` read in several strips.

use crate::place::Place;
use crate::{assert_says, json};
use color::develop::{DevelopSettings, SceneWhite, WhiteAdaptation, develop};
use color::{Region, compare, probe};
use colorimetry::{Adaptation, Display};
use picture_file::RgbImage8;
use picture_file::spectral_exr::{self, Metadata, RowReader, WriteOptions};
use relight::{Relight, relight};
use spectra::{BandGrid, LightGroup, Observer, SpectralImage};

const BANDS: usize = 8;

/// An image of two lights with noise, of two strips.
fn noisy(seed: u32) -> SpectralImage {
    let grid = BandGrid::visible(BANDS as u32).unwrap();
    let group = |(name, lamp): (&str, &str)| LightGroup {
        name: name.to_owned(),
        lamp: grid.lamp(&spectra::illuminant(lamp).unwrap().data),
    };
    let groups = [("key", "A"), ("sky", "D65")].map(group);
    let (width, height) = (300, 1500);
    let mut image = SpectralImage::with_light_groups(width, height, grid, groups.to_vec());
    let mut state = seed;
    let mut noise = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    for y in 0..height {
        for x in 0..width {
            let radiance: [f32; 2 * BANDS] = std::array::from_fn(|_| noise());
            let variance: [f32; BANDS] = std::array::from_fn(|_| 0.1 * noise());
            let xyz = [0; 2].map(|_| [0; 3].map(|_| 7e4 * noise()));
            image.set_pixel_by_light((x, y), &radiance, &variance, &xyz, 3);
        }
    }
    image
}

/// A folder with `a.exr`, and the image in it.
fn place() -> (Place, SpectralImage) {
    let (place, image) = (Place::default(), noisy(1));
    write(&place, "a.exr", &image);
    let rows = RowReader::open(&place.path("a.exr")).unwrap();
    assert_eq!(rows.strips(64 << 20).count(), 2);
    (place, image)
}

fn write(place: &Place, name: &str, image: &SpectralImage) {
    let metadata = Metadata::default();
    let options = WriteOptions::default();
    spectral_exr::write(&place.path(name), image, &metadata, options).unwrap();
}

/// The numbers of a list are these; reading them from JSON may change the last bit.
fn assert_same(found: &serde_json::Value, expected: &[f64]) {
    let found = found.as_array().unwrap().iter();
    let found: Vec<f64> = found.map(|v| v.as_f64().unwrap()).collect();
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 4.0 * f64::EPSILON * b.abs(), "{a} {b}");
    }
}

#[test]
fn regions_are_inspected_as_in_the_whole_image() {
    let (place, image) = place();
    let across = Region {
        x: 7,
        y: 100,
        width: 200,
        height: 1390,
    };
    let arguments = "inspect a.exr --format json --at 299,1499 --region 7,100,200,1390";
    let found = json(place.run(arguments));
    let all = json(place.run("inspect a.exr --format json"));
    let whole = Region::all_of(&image);
    let places = [&found["places"][0], &found["places"][1], &all["places"][0]];
    let regions = [Region::pixel(299, 1499), across, whole];
    for (place, region) in places.into_iter().zip(regions) {
        let expected = probe(&image, region).unwrap();
        assert_same(&place["radiance"], &expected.radiance);
        assert_same(&place["deviation"], &expected.deviation.unwrap());
        assert_same(&place["xyz"], &expected.xyz);
        assert_eq!(place["samples"], expected.samples);
        let groups = place["light_groups"].as_array().unwrap();
        for (group, expected) in groups.iter().zip(&expected.light_groups) {
            assert_same(&group["xyz"], &expected.xyz);
        }
    }
}

#[test]
fn images_are_compared_as_wholes() {
    let (place, image) = place();
    let other = noisy(2);
    write(&place, "b.exr", &other);
    let found = json(place.run("compare a.exr b.exr --format json"));
    let expected = compare::bands(&image, &other).unwrap();
    for (found, expected) in found["bands"].as_array().unwrap().iter().zip(expected) {
        let found = serde_json::json!([found["rmse"], found["bias"], found["noise"]["rmse"]]);
        let noise = expected.noise.unwrap().rmse;
        assert_same(&found, &[expected.rmse, expected.bias, noise]);
    }
    let picture = |image: &SpectralImage| compare::Picture::of_colors(&image.into(), 0.0);
    let delta_e = compare::delta_e(&picture(&image), &picture(&other)).unwrap();
    let summary = compare::Summary::new(&delta_e).unwrap();
    let found = &found["delta_e_2000"];
    let found = serde_json::json!([found["mean"], found["max"]]);
    assert_same(&found, &[summary.mean, summary.max]);
}

/// The codes in a file.
fn codes(place: &Place, name: &str) -> Vec<u8> {
    let picture = image::open(place.path(name)).unwrap();
    picture.into_rgb8().into_raw()
}

/// The codes of an image with `key` under D50, adapted to its brightest lamp.
fn under_d50(mut image: SpectralImage) -> RgbImage8 {
    let change = Relight {
        lamp: Some(spectra::illuminant("D50").unwrap().data),
        factor: 0.3,
    };
    let observer = Observer::Cie1931Deg2;
    relight(&mut image, &[("key".to_owned(), change)], observer).unwrap();
    let adaptation = WhiteAdaptation {
        method: Adaptation::Cat16,
        from: SceneWhite::of_lamps(&image, observer).unwrap(),
    };
    let settings = DevelopSettings {
        adaptation: Some(adaptation),
        ..DevelopSettings::new(Display::named("srgb").unwrap())
    };
    develop(&image, &settings).unwrap()
}

#[test]
fn relit_images_are_developed_as_wholes() {
    let (place, image) = place();
    let arguments = "develop a.exr -o out.png --light key=D50*0.3 --adapt cat16";
    let _ = place.run(arguments).succeeded();
    assert!(codes(&place, "out.png") == under_d50(image).data());
}

#[test]
fn the_halo_of_an_eye_is_that_of_the_whole_image() {
    let (place, image) = place();
    let mut settings = DevelopSettings::srgb(0.0);
    let vision = color::develop::Vision::Scotopic;
    settings.glare = color::develop::Glare::Eye(color::develop::EyeGlare::of_view(
        20.0,
        image.height(),
        vision,
    ));
    let arguments = "develop a.exr -o out.png --glare scotopic --glare-fov 20";
    let _ = place.run(arguments).succeeded();
    assert!(codes(&place, "out.png") == develop(&image, &settings).unwrap().data());
}

#[test]
fn damage_far_from_what_is_shown_is_found() {
    let (place, _) = place();
    let mut bytes = std::fs::read(place.path("a.exr")).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    std::fs::write(place.path("b.exr"), bytes).unwrap();
    for arguments in [
        "inspect b.exr --at 0,0",
        "compare a.exr b.exr",
        "compare b.exr a.exr",
        "develop b.exr -o out.png",
        "develop b.exr -o out.png --light key=*2",
        "develop b.exr -o out.png --booth A",
    ] {
        let said = place.run(arguments).failed();
        assert_says(
            &said,
            &["b.exr was not read", "not those that were written"],
        );
    }
    assert_eq!(place.names(), ["a.exr", "b.exr"]);
}

#[test]
fn a_light_that_is_not_there_is_reported_before_pixels_are_read() {
    let (place, _) = place();
    let bytes = std::fs::read(place.path("a.exr")).unwrap();
    std::fs::write(place.path("a.exr"), &bytes[..bytes.len() / 2]).unwrap();
    let said = place
        .run("develop a.exr -o out.png --light moon=A")
        .failed();
    assert_says(&said, &["moon", "\"key\", \"sky\""]);
}
