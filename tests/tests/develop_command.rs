//! Tests of `pellicle develop`, and of the same options in `pellicle render`.

use color::BandWeights;
use color::spectral_exr::{self, Metadata, WriteOptions};
use color::xyz::equal_energy_luminance;
use image::{ImageReader, RgbImage};
use pellicle_tests::command::Place;
use spectra::{BandGrid, SpectralImage};
use std::collections::BTreeMap;

const SIZE: [u32; 2] = [12, 8];

/// A folder with `image.exr`: grays, a row of saturated spectral lines, and a lamp.
fn place() -> Place {
    let place = Place::default();
    let grid = BandGrid::visible(40).unwrap();
    let observer = BandWeights::observed(&grid, spectra::Observer::Cie1931Deg2);
    let [width, height] = SIZE;
    let mut image = SpectralImage::new(width, height, grid);
    for y in 0..height {
        for x in 0..width {
            let mut radiance = [0.05 * (x + 1) as f32; 40];
            if y == 2 {
                radiance = [0.0; 40];
                radiance[2 + 2 * x as usize] = 4.0;
            }
            if (x, y) == (6, 5) {
                radiance = [60.0; 40];
            }
            let xyz = observer.xyz(&radiance).map(|v| v as f32);
            image.set_pixel((x, y), &radiance, &[0.0; 40], xyz, 1);
        }
    }
    let metadata = Metadata {
        exposure_ev: 1.0,
        settings: BTreeMap::from([("fov_deg".to_owned(), "20".to_owned())]),
        ..Metadata::default()
    };
    let path = place.path("image.exr");
    spectral_exr::write(&path, &image, &metadata, WriteOptions::default()).unwrap();
    place
}

/// Develops `image.exr` with these options and reads the picture.
fn developed(place: &Place, options: &str) -> RgbImage {
    let ran = place.run(&format!("develop image.exr -o out.png {options}"));
    assert!(ran.succeeded().stderr.contains("wrote out.png"));
    let reader = ImageReader::open(place.path("out.png")).unwrap();
    reader.decode().unwrap().into_rgb8()
}

#[test]
fn each_step_is_controlled_by_its_option() {
    let place = place();
    let plain = developed(&place, "");
    // The exposure that the image was rendered with is the default.
    assert_eq!(developed(&place, "--exposure 1"), plain);
    assert_eq!(
        developed(
            &place,
            "--gamut perceptual --glare off --adapt none --display srgb --bits 8"
        ),
        plain
    );
    let white = equal_energy_luminance() / 2.0;
    assert_eq!(developed(&place, &format!("--exposure {white}cd")), plain);
    for options in [
        "--exposure 2",
        "--exposure -1.5",
        "--exposure 100cd",
        "--exposure display",
        "--exposure auto",
        "--exposure auto:50",
        "--adapt bradford --adapt-from mean",
        "--adapt cat16 --adapt-from A",
        "--adapt cat16 --adapt-from 0.4,0.4",
        "--glare star",
        "--glare star --star-length 0.5",
        "--glare photopic",
        "--glare mesopic",
        "--glare scotopic --glare-fov 60",
        "--gamut clip",
        "--gamut white",
        "--gamut-warning",
        "--display bt2020",
        "--dither",
    ] {
        assert_ne!(developed(&place, options), plain, "{options}");
    }
}

#[test]
fn glare_keeps_the_light_of_a_lamp() {
    let place = place();
    let lamp = |picture: &RgbImage| picture.get_pixel(6, 5).0;
    let beside = |picture: &RgbImage| u32::from(picture.get_pixel(4, 5).0[1]);
    let plain = developed(&place, "");
    assert_eq!(lamp(&plain), [255; 3]);
    for glare in ["star", "photopic", "mesopic", "scotopic"] {
        let picture = developed(&place, &format!("--glare {glare}"));
        assert!(beside(&picture) > beside(&plain), "{glare}");
    }
    // The star has four arms and nothing between them.
    let star = developed(&place, "--glare star");
    assert_eq!(star.get_pixel(4, 4), plain.get_pixel(4, 4));
}

#[test]
fn the_gamut_report_counts_what_the_warning_marks() {
    let place = place();
    let ran = place.run("develop image.exr -o out.png --gamut-report --gamut-warning");
    let report = ran.succeeded().stdout;
    // The row of spectral lines, the lamp, and grays that are brighter than white.
    let count: u32 = report
        .split(['(', ' '])
        .find_map(|word| word.parse::<u32>().ok().filter(|&n| n > 12))
        .unwrap();
    let (plain, marked) = (developed(&place, ""), developed(&place, "--gamut-warning"));
    let stripe = |x: u32, y: u32| {
        if ((x + y) / 4).is_multiple_of(2) {
            [0; 3]
        } else {
            [255; 3]
        }
    };
    let (mut seen, mut hidden) = (0, 0);
    for (x, y, pixel) in plain.enumerate_pixels() {
        // Where a pixel already has the color of the stripe, nothing shows whether it is marked.
        if pixel.0 == stripe(x, y) {
            hidden += 1;
        } else if marked.get_pixel(x, y) != pixel {
            assert_eq!(marked.get_pixel(x, y).0, stripe(x, y));
            seen += 1;
        }
    }
    assert!(seen >= 12 && hidden < 12, "{seen} seen, {hidden} hidden");
    assert!(
        (seen..=seen + hidden).contains(&count),
        "{report}: {seen} seen, {hidden} hidden"
    );
    assert!(
        report.contains("ΔE2000") && report.starts_with("srgb: "),
        "{report}"
    );

    let none =
        place.run("develop image.exr -o out.png --gamut-report --exposure -20 --display bt2020");
    assert!(none.succeeded().stdout.starts_with("bt2020: "));
}

#[test]
fn files_have_the_requested_bit_depth() {
    let place = place();
    for (name, bits, expected) in [
        ("eight.png", "", image::ColorType::Rgb8),
        ("sixteen.png", "--bits 16", image::ColorType::Rgb16),
    ] {
        let options = format!("develop image.exr -o {name} --display display_p3 {bits}");
        assert!(place.run(&options).success);
        let picture = ImageReader::open(place.path(name))
            .unwrap()
            .decode()
            .unwrap();
        assert_eq!(picture.color(), expected);
    }
    for bits in ["", "--bits 32"] {
        let options = format!("develop image.exr -o light.exr -o light.EXR {bits}");
        assert!(place.run(&options).success);
        assert_eq!(
            &std::fs::read(place.path("light.exr")).unwrap()[..4],
            b"\x76\x2f\x31\x01"
        );
    }
    assert_eq!(
        place.names(),
        [
            "eight.png",
            "image.exr",
            "light.EXR",
            "light.exr",
            "sixteen.png"
        ]
    );
}

#[test]
fn impossible_options_are_reported_and_nothing_is_written() {
    let place = place();
    std::fs::write(place.path("notes.txt"), "no image").unwrap();
    for (arguments, said) in [
        ("image.exr -o out.jpg", "end it in .png"),
        ("image.exr -o image.exr", "overwrite"),
        ("image.exr -o out.png --bits 32", "no channels of 32 bits"),
        ("image.exr -o out.exr --bits 8", "no channels of 8 bits"),
        ("image.exr -o out.png --bits 12", "8 or 16 bits"),
        ("image.exr -o none/out.png", "no folder"),
        (
            "image.exr -o out.png --exposure bright",
            "write stops from -40",
        ),
        (
            "image.exr -o out.png --exposure auto:101",
            "write stops from -40",
        ),
        (
            "image.exr -o out.png --exposure NaN",
            "write stops from -40",
        ),
        ("image.exr -o out.png --adapt bradford", "with --adapt-from"),
        ("image.exr -o out.png --adapt-from 0.9,0.9", "a sum up to 1"),
        ("image.exr -o out.png --adapt-from X99", "X99"),
        ("image.exr -o out.png --adapt warm", "cat16"),
        ("image.exr -o out.png --display tv", "tv"),
        ("image.exr -o out.png --display none.toml", "none.toml"),
        (
            "image.exr -o out.png --glare mesopic --glare-fov 190",
            "170 degrees",
        ),
        (
            "image.exr -o out.png --glare star --star-length 0",
            "fraction of the height",
        ),
        ("image.exr", "--output"),
        ("missing.exr -o out.png", "missing.exr"),
        ("notes.txt -o out.png", "not an OpenEXR file"),
    ] {
        let error = place.run(&format!("develop {arguments}")).failed();
        assert!(error.contains(said), "{arguments}: {error}");
    }
    assert_eq!(place.names(), ["image.exr", "notes.txt"]);
}

/// Glare in a human eye depends on the field of view: from the scene's camera, which is stored in the file, or from the option.
#[test]
fn an_unknown_field_of_view_must_be_given() {
    let place = Place::default();
    let grid = BandGrid::visible(4).unwrap();
    let image = SpectralImage::new(3, 2, grid);
    let options = WriteOptions::default();
    spectral_exr::write(
        &place.path("image.exr"),
        &image,
        &Metadata::default(),
        options,
    )
    .unwrap();
    let error = place
        .run("develop image.exr -o out.png --glare scotopic")
        .failed();
    assert!(error.contains("--glare-fov"), "{error}");
    assert!(
        place
            .run("develop image.exr -o out.png --glare scotopic --glare-fov 30")
            .success
    );
    // A black image can be developed, but it has nothing to expose for or to adapt from.
    for (option, said) in [
        ("--exposure auto", "nothing to expose for"),
        (
            "--adapt bradford --adapt-from mean",
            "not a white to adapt from",
        ),
    ] {
        let error = place
            .run(&format!("develop image.exr -o black.png {option}"))
            .failed();
        assert!(error.contains(said), "{error}");
    }
    assert_eq!(place.names(), ["image.exr", "out.png"]);
}

const SCENE: &str = r#"
camera = { type = "perspective", position = [0, 1, 5], look_at = [0, 0.4, 0], fov_deg = 25 }
environment = { type = "constant", emission = { illuminant = "D65", scale = 0.5 } }
render = { size = [16, 12], samples = 4, bands = 8, exposure_ev = 3 }

[materials]
soap = { type = "film", index = "water", thickness_nm = { pole = 300, equator = 1200 } }

[[objects]]
type = "sphere"
material = "soap"
center = [0, 0, 0]
radius = 1
"#;

/// Developing the file of a render gives the same picture as rendering it, to the byte, whatever the options.
#[test]
fn rendering_equals_rendering_then_developing() {
    let place = Place::default();
    std::fs::write(place.path("scene.toml"), SCENE).unwrap();
    for options in [
        "",
        "--glare mesopic --display display_p3 --exposure 2 --dither --gamut white",
    ] {
        let render = format!("render scene.toml --backend cpu -o a.png -o a.exr {options}");
        assert!(place.run(&render).success);
        let develop = format!("develop a.exr -o b.png {options}");
        assert!(place.run(&develop).success);
        let [a, b] = ["a.png", "b.png"].map(|name| std::fs::read(place.path(name)).unwrap());
        assert!(a == b, "{options}");
    }
}
