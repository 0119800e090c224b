//! Tests of `pellicle develop`, and of the same options in `pellicle render`.

use crate::assert_says;
use crate::place::Place;
use image::{ImageReader, RgbImage};
use picture_file::spectral_exr::{self, Metadata, WriteOptions};
use relight::BandWeights;
use relight::xyz::equal_energy_luminance;
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
fn the_defaults_are_those_of_the_documentation() {
    let place = place();
    let plain = developed(&place, "");
    // The exposure that the image was rendered with is the default.
    assert_eq!(developed(&place, "--exposure 1"), plain);
    let defaults = "--gamut perceptual --glare off --adapt none --display srgb --bits 8";
    assert_eq!(developed(&place, defaults), plain);
    let white = equal_energy_luminance() / 2.0;
    assert_eq!(developed(&place, &format!("--exposure {white}cd")), plain);
}

fn changes_the_picture(options: &str) {
    let place = place();
    assert_ne!(developed(&place, options), developed(&place, ""));
}

cases! { changes_the_picture:
    a_brighter_exposure("--exposure 2");
    a_darker_exposure("--exposure -1.5");
    the_luminance_of_white("--exposure 100cd");
    the_exposure_of_the_display("--exposure display");
    an_automatic_exposure("--exposure auto");
    an_automatic_exposure_of_a_percentile("--exposure auto:50");
    adaptation_from_the_mean("--adapt bradford --adapt-from mean");
    adaptation_from_an_illuminant("--adapt cat16 --adapt-from A");
    adaptation_from_a_chromaticity("--adapt cat16 --adapt-from 0.4,0.4");
    a_star("--glare star");
    a_short_star("--glare star --star-length 0.5");
    photopic_glare("--glare photopic");
    mesopic_glare("--glare mesopic");
    scotopic_glare_of_a_field_of_view("--glare scotopic --glare-fov 60");
    clipping("--gamut clip");
    mapping_toward_white("--gamut white");
    a_gamut_warning("--gamut-warning");
    another_display("--display bt2020");
    dither("--dither");
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
fn a_picture_goes_to_standard_output() {
    let place = place();
    for bits in ["8", "16"] {
        let to_file = place.run(&format!("develop image.exr -o out.png --bits {bits}"));
        let _ = to_file.succeeded();
        let mut command = place.command(&format!("develop image.exr -o - --bits {bits}"));
        let ran = command.output().unwrap();
        assert!(ran.status.success(), "{ran:?}");
        assert_eq!(ran.stdout, std::fs::read(place.path("out.png")).unwrap());
        let said = String::from_utf8(ran.stderr).unwrap();
        assert!(said.contains("wrote <standard output>"), "{said}");
    }
}

#[test]
fn an_image_comes_from_standard_input() {
    let place = place();
    let _ = place.run("develop image.exr -o out.png").succeeded();
    let input = std::fs::read(place.path("image.exr")).unwrap();
    let ran = place.run_with_input("develop - -o other.png", &input);
    let _ = ran.succeeded();
    let [out, other] = ["out.png", "other.png"].map(|name| std::fs::read(place.path(name)));
    assert_eq!(out.unwrap(), other.unwrap());
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

/// `develop` fails with these words and writes nothing.
fn refused(arguments: &str, words: &str) {
    let place = place();
    std::fs::write(place.path("notes.txt"), "no image").unwrap();
    let error = place.run(&format!("develop {arguments}")).failed();
    assert_says(&error, &[words]);
    assert_eq!(place.names(), ["image.exr", "notes.txt"]);
}

cases! { refused:
    an_output_of_an_unknown_type("image.exr -o out.jpg", "end it in .png");
    the_image_itself_as_output("image.exr -o image.exr", "overwrite");
    too_many_bits_for_a_png("image.exr -o out.png --bits 32", "no channels of 32 bits");
    too_few_bits_for_an_exr("image.exr -o out.exr --bits 8", "no channels of 8 bits");
    twelve_bits("image.exr -o out.png --bits 12", "8 or 16 bits");
    a_missing_folder("image.exr -o none/out.png", "no folder");
    an_exposure_in_words("image.exr -o out.png --exposure bright", "write stops from -40");
    a_percentile_above_100("image.exr -o out.png --exposure auto:101", "write stops from -40");
    an_exposure_that_is_no_number("image.exr -o out.png --exposure NaN", "write stops from -40");
    adaptation_from_nothing("image.exr -o out.png --adapt bradford", "with --adapt-from");
    an_impossible_chromaticity("image.exr -o out.png --adapt-from 0.9,0.9", "a sum up to 1");
    an_unknown_white("image.exr -o out.png --adapt-from X99", "X99");
    an_unknown_adaptation("image.exr -o out.png --adapt warm", "cat16");
    an_unknown_display("image.exr -o out.png --display tv", "tv");
    a_missing_display_file("image.exr -o out.png --display none.toml", "none.toml");
    a_field_of_view_that_is_too_wide("image.exr -o out.png --glare mesopic --glare-fov 190", "170 degrees");
    a_star_without_length("image.exr -o out.png --glare star --star-length 0", "fraction of the height");
    no_output("image.exr", "--output");
    two_pictures_on_standard_output("image.exr -o - -o -", "one picture");
    a_report_with_the_picture("image.exr -o - --gamut-report", "write the picture to a file");
    a_missing_image("missing.exr -o out.png", "missing.exr");
    a_text_as_image("notes.txt -o out.png", "not an OpenEXR file");
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

/// Developing the file of a render gives the same picture as rendering it, to the byte.
fn rendering_equals_developing(options: &str) {
    let place = Place::default();
    std::fs::write(place.path("scene.toml"), SCENE).unwrap();
    let render = format!("render scene.toml --backend cpu -o a.png -o a.exr {options}");
    let _ = place.run(&render).succeeded();
    let _ = place
        .run(&format!("develop a.exr -o b.png {options}"))
        .succeeded();
    let [a, b] = ["a.png", "b.png"].map(|name| std::fs::read(place.path(name)).unwrap());
    assert!(a == b);
}

cases! { rendering_equals_developing:
    rendering_equals_developing_by_default("");
    rendering_equals_developing_with_options(
        "--glare mesopic --display display_p3 --exposure 2 --dither --gamut white",
    );
}
