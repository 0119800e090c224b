//! End-to-end tests of `pellicle compare` and `pellicle inspect`.

use color::BandWeights;
use color::spectral_exr::{self, Metadata, WriteOptions};
use color::{DevelopSettings, RgbImage8};
use pellicle::coating::{Angle, FilmFitting, Stack, View};
use pellicle_tests::command::{Place, Ran};
use pellicle_tests::wgsl::root;
use serde_json::Value;
use spectra::{BandGrid, Observer, SpectralImage};
use std::path::Path;

/// An image with the spectra that `radiance` returns for each pixel, and a deviation of 1 %.
fn image(size: [u32; 2], bands: u32, radiance: impl Fn(u32, u32) -> Vec<f32>) -> SpectralImage {
    let grid = BandGrid::visible(bands).unwrap();
    let observer = BandWeights::observed(&grid, Observer::Cie1931Deg2);
    let mut image = SpectralImage::new(size[0], size[1], grid);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let values = radiance(x, y);
            let variance: Vec<f32> = values.iter().map(|v| (0.01 * v).powi(2)).collect();
            let xyz = observer.xyz(&values).map(|v| v as f32);
            image.set_pixel((x, y), &values, &variance, xyz, 16);
        }
    }
    image
}

fn write(path: &Path, image: &SpectralImage) {
    let metadata = Metadata::default();
    spectral_exr::write(path, image, &metadata, WriteOptions::default()).unwrap();
}

/// Radiance 0.2 everywhere; at `odd` it is 1.5 times that in the first half of the bands.
fn gray(size: [u32; 2], bands: u32, odd: Option<(u32, u32)>) -> SpectralImage {
    image(size, bands, |x, y| {
        let bright = if odd == Some((x, y)) { 1.5 } else { 1.0 };
        let value = |band| 0.2 * if band < bands / 2 { bright } else { 1.0 };
        (0..bands).map(value).collect()
    })
}

fn json(ran: Ran) -> Value {
    serde_json::from_str(&ran.succeeded().stdout).unwrap()
}

fn assert_says(said: &str, words: &[&str]) {
    for words in words {
        assert!(said.contains(words), "{words:?} is not in\n{said}");
    }
}

#[test]
fn equal_images_do_not_differ() {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([6, 4], 8, None));
    let found = json(place.run("compare a.exr a.exr --format json"));
    for figure in ["mean", "p50", "p95", "p99", "max"] {
        assert_eq!(found["delta_e_2000"][figure], 0.0);
        assert!(found["flip"][figure].as_f64().unwrap() < 1e-9);
    }
    assert!(found["psnr_db"].is_null());
    assert_eq!(found["bands"].as_array().unwrap().len(), 8);
    for band in found["bands"].as_array().unwrap() {
        assert_eq!((&band["rmse"], &band["bias"]), (&0.0.into(), &0.0.into()));
    }
    let table = place.run("compare a.exr a.exr").succeeded().stdout;
    assert_says(
        &table,
        &["ΔE2000", "FLIP", "the codes are the same", "bias/σ"],
    );
}

/// One pixel of 24 has 0.1 more in the bands of the first half.
#[test]
fn a_pixel_that_differs_is_found_and_measured() {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([6, 4], 8, None));
    write(&place.path("b.exr"), &gray([6, 4], 8, Some((5, 2))));
    let found = json(place.run("compare a.exr b.exr --format json --map map.png --map-of delta-e"));
    assert_eq!(found["delta_e_2000"]["max_at"], serde_json::json!([5, 2]));
    assert!(found["delta_e_2000"]["max"].as_f64().unwrap() > 10.0);
    assert_eq!(found["delta_e_2000"]["p95"], 0.0);
    assert!(found["flip"]["max"].as_f64().unwrap() > 0.05);
    assert!(found["psnr_db"].as_f64().unwrap() < 45.0);
    for (index, band) in found["bands"].as_array().unwrap().iter().enumerate() {
        let (bias, rmse) = if index < 4 {
            (0.1 / 24.0, 0.1 / 24.0_f64.sqrt())
        } else {
            (0.0, 0.0)
        };
        assert!(
            (band["bias"].as_f64().unwrap() - bias).abs() < 1e-8,
            "{band}"
        );
        assert!(
            (band["rmse"].as_f64().unwrap() - rmse).abs() < 1e-7,
            "{band}"
        );
        assert_eq!(
            band["noise"]["bias_sigmas"].as_f64().unwrap() > 3.0,
            index < 4
        );
    }
    assert!(found["rmse_over_noise"].as_f64().unwrap() > 3.0);
    // In the other order the bias has the other sign.
    let back = json(place.run("compare b.exr a.exr --format json"));
    assert!(back["bands"][0]["bias"].as_f64().unwrap() < 0.0);
    // The map is black except for that pixel.
    let map = image::open(place.path("map.png")).unwrap().into_rgb8();
    for (x, y, pixel) in map.enumerate_pixels() {
        assert_eq!(pixel.0 != [0, 0, 4], (x, y) == (5, 2), "{x},{y}");
    }
}

#[test]
fn pictures_compare_with_each_other_and_with_spectral_images() {
    let place = Place::default();
    let codes = |odd: u8| {
        let mut codes = vec![120; 3 * 24];
        codes[30] = odd;
        RgbImage8::new(6, 4, codes).unwrap()
    };
    color::png::write(&place.path("a.png"), &codes(120)).unwrap();
    color::png::write(&place.path("b.png"), &codes(160)).unwrap();
    let found = json(place.run("compare a.png b.png --format json"));
    assert_eq!(found["delta_e_2000"]["max_at"], serde_json::json!([4, 1]));
    assert_eq!(found["bands"], serde_json::json!([]));
    assert!(found["exposure_ev"].is_null());
    // (40/255)² over 72 codes.
    let psnr = -10.0 * ((40.0_f64 / 255.0).powi(2) / 72.0).log10();
    assert!((found["psnr_db"].as_f64().unwrap() - psnr).abs() < 1e-9);

    write(&place.path("c.exr"), &gray([6, 4], 8, None));
    let settings = DevelopSettings::srgb(1.0);
    let developed = color::develop(&gray([6, 4], 8, None), &settings).unwrap();
    color::png::write(&place.path("c.png"), &developed).unwrap();
    // sRGB clips the red of equal energy; the rest is rounding of the codes.
    let alike = json(place.run("compare c.exr c.png --exposure 1 --format json"));
    assert!(alike["delta_e_2000"]["max"].as_f64().unwrap() < 1.0);
    let darker = json(place.run("compare c.exr c.png --exposure 0 --format json"));
    assert!(darker["delta_e_2000"]["max"].as_f64().unwrap() > 10.0);
}

#[test]
fn files_that_do_not_compare_give_one_clear_error() {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([6, 4], 8, None));
    write(&place.path("wide.exr"), &gray([7, 4], 8, None));
    write(&place.path("bands.exr"), &gray([6, 4], 9, None));
    let picture = RgbImage8::new(2, 1, vec![9; 6]).unwrap();
    color::png::write(&place.path("small.png"), &picture).unwrap();
    std::fs::write(place.path("text.png"), "no picture").unwrap();
    std::fs::write(place.path("text.exr"), "no image").unwrap();
    let before = place.names();
    for (arguments, words) in [
        ("a.exr wide.exr", &["6×4", "7×4"][..]),
        ("a.exr bands.exr", &["8 bands", "9 bands"]),
        ("a.exr small.png", &["6×4", "2×1"]),
        ("a.exr none.exr", &["none.exr"]),
        ("a.exr text.exr", &["text.exr", "not an OpenEXR"]),
        ("a.exr text.png", &["text.png", "not a PNG"]),
        ("a.exr a.jpg", &["a.jpg", ".exr"]),
        ("a.exr a.exr --map m.jpg", &["m.jpg", ".png"]),
        ("a.exr a.exr --map no/m.png", &["no"]),
        ("small.png small.png --map small.png", &["overwrite"]),
        ("small.png small.png --exposure 1", &["--exposure"]),
        ("a.exr a.exr --exposure 1e9", &["--exposure", "from"]),
        ("a.exr wide.exr --map m.png", &["6×4"]),
    ] {
        let said = place.run(&format!("compare {arguments}")).failed();
        assert_says(&said, words);
    }
    assert_eq!(place.names(), before, "a partly written file was left");
}

#[test]
fn a_pixel_and_a_region_are_reported_correctly() {
    let place = Place::default();
    let made = image([4, 3], 5, |x, y| {
        (0..5)
            .map(|band| 0.1 * (1 + x + 10 * y + band) as f32)
            .collect()
    });
    write(&place.path("a.exr"), &made);
    let ran = place.run("inspect a.exr --at 2,1 --region 1,0,2,2 --format json");
    let found = json(ran);
    let (pixel, region) = (&found["places"][0], &found["places"][1]);
    for band in 0..5 {
        let value = f64::from(made.pixel(2, 1)[band]);
        let of = |place: &Value, what: &str| place[what][band].as_f64().unwrap();
        assert!((of(pixel, "radiance") - value).abs() < 1e-7);
        assert!((of(pixel, "deviation") - 0.01 * value).abs() < 1e-7);
        let mean = 0.1 * (2.5 + 5.0 + band as f64);
        assert!((of(region, "radiance") - mean).abs() < 1e-6);
        assert!(of(region, "deviation") < 0.01 * mean);
    }
    let [x, y, z] = made.xyz()[6].map(f64::from);
    assert!((pixel["xyz"][1].as_f64().unwrap() / y - 1.0).abs() < 1e-6);
    assert!((pixel["xy"][0].as_f64().unwrap() - x / (x + y + z)).abs() < 1e-6);
    assert_eq!(
        (&pixel["samples"], &region["samples"]),
        (&16.into(), &64.into())
    );
    assert!(pixel["film"].is_null());

    let csv = place
        .run("inspect a.exr --at 2,1 --format csv")
        .succeeded()
        .stdout;
    assert_eq!(csv.lines().count(), 6);
    assert!(csv.starts_with("wavelength_nm,radiance_2_1,deviation_2_1\n420,"));
    let table = place.run("inspect a.exr --at 2,1").succeeded().stdout;
    assert_says(
        &table,
        &["4×3 pixels", "2,1: #", "x, y", "Lab", "16 samples"],
    );
    let whole = place.run("inspect a.exr").succeeded().stdout;
    assert_says(&whole, &["the whole image", "192 samples"]);
    // One stop is a factor of two.
    let shown = |ev: &str| {
        let found = json(place.run(&format!("inspect a.exr --format json --exposure {ev}")));
        found["places"][0]["xyz_shown"][1].as_f64().unwrap()
    };
    assert!((shown("-1") * 2.0 / shown("0") - 1.0).abs() < 1e-12);
}

#[test]
fn spectra_are_plotted() {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([4, 3], 5, None));
    let _ = place
        .run("inspect a.exr --at 1,1 --region 0,0,2,2 --plot p.svg")
        .succeeded();
    let svg = std::fs::read_to_string(place.path("p.svg")).unwrap();
    assert_says(&svg, &["<svg", "1,1", "0,0,2,2", "wavelength in vacuum"]);
    let _ = place.run("inspect a.exr --plot p.png").succeeded();
    assert!(image::open(place.path("p.png")).unwrap().width() > 1000);
    assert_eq!(place.names(), ["a.exr", "p.png", "p.svg"]);
}

#[test]
fn files_that_cannot_be_inspected_give_one_clear_error() {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([4, 3], 5, None));
    let before = place.names();
    for (arguments, words) in [
        ("a.exr --at 4,0", &["4,0", "4×3"][..]),
        ("a.exr --region 0,0,5,1", &["0,0,5,1", "4×3"]),
        ("a.exr --region 0,0,0,1", &["no pixels"]),
        ("a.exr --at 1", &["320,200"]),
        ("a.exr --at -1,0", &["-1"]),
        ("a.exr --region 1,2,3", &["left, top, width, height"]),
        ("none.exr", &["none.exr"]),
        ("a.exr --plot p.gif", &[".svg or .png"]),
        ("a.exr --plot a.exr", &[".svg or .png"]),
        ("a.exr --vary 1:0:100", &["--film or --scene"]),
        ("a.exr --angle 30", &["--film"]),
        ("a.exr --film 1|water_10nm", &["|"]),
        (
            "a.exr --film 1|1.5 --scene s.toml",
            &["cannot be used with"],
        ),
        ("a.exr --film 1|1.5", &["no layer"]),
        ("a.exr --scene none.toml", &["none.toml"]),
        ("a.exr --exposure 1e9", &["--exposure"]),
    ] {
        let said = place.run(&format!("inspect {arguments}")).failed();
        assert_says(&said, words);
    }
    assert_eq!(place.names(), before, "a partly written file was left");
}

/// Results of `inspect --film` at pixel 0 (a film of 412 nm at 30° in FL11), 1 (a gray surface in it) and 2 (black).
#[test]
fn a_film_is_recognized_and_other_pixels_are_reported() {
    let grid = BandGrid::visible(40).unwrap();
    let stack = Stack::parse("1 | water 0nm | 1").unwrap();
    let lamp = spectra::illuminant("FL11").unwrap().data;
    let power: Vec<f64> = FilmFitting::wavelengths_nm(&grid)
        .into_iter()
        .map(|nm| lamp.at(nm).unwrap())
        .collect();
    let fitting = FilmFitting {
        stack: &stack,
        layer: 0,
        from_nm: 0.0,
        to_nm: 1000.0,
        angle: Angle::from_degrees(30.0).unwrap(),
        view: View::default(),
        lamp: &power,
    };
    let film = fitting.spectrum(&grid, 412.0).unwrap();
    let gray: Vec<f64> = power
        .chunks(10)
        .map(|v| v.iter().sum::<f64>() / 50.0)
        .collect();
    let place = Place::default();
    let made = image([3, 1], 40, |x, _| match x {
        0 => film.iter().map(|v| 3.0 * *v as f32).collect(),
        1 => gray.iter().map(|v| *v as f32).collect(),
        _ => vec![0.0; 40],
    });
    write(&place.path("a.exr"), &made);
    let inspect = |film: &str, arguments: &str| {
        let mut command = place.command("inspect a.exr --at 0,0 --at 1,0 --at 2,0");
        command
            .args(["--film", film])
            .args(arguments.split_whitespace());
        Ran::of(&command.output().unwrap())
    };
    let water = "1 | water 0nm | 1";
    let found = json(inspect(water, "--angle 30 --lamp FL11 --format json"));
    let film = |index: usize| &found["places"][index]["film"];
    assert_eq!(film(0)["verdict"], "film");
    let best = &film(0)["by_shape"][0];
    assert!(
        (best["thickness_nm"].as_f64().unwrap() - 412.0).abs() < 0.1,
        "{best}"
    );
    assert!((best["scale"].as_f64().unwrap() - 3.0).abs() < 1e-2);
    assert_eq!(film(1)["verdict"], "lamp");
    assert!(film(2)["verdict"].is_null());
    // Another lamp or another film does not fit.
    for (film, arguments) in [
        (water, "--angle 30 --lamp A"),
        ("1 | 2.4 0nm | gold", "--angle 30 --lamp FL11"),
    ] {
        let ran = inspect(film, &format!("{arguments} --format json"));
        assert_eq!(
            json(ran)["places"][0]["film"]["verdict"],
            "nothing",
            "{film} {arguments}"
        );
    }
    let table = inspect(water, "--angle 30 --lamp FL11 --plot p.svg").succeeded();
    assert_says(
        &table.stdout,
        &[
            "best fit by the shape of the spectrum",
            "by color",
            "the lamp's own spectrum",
            "nothing to fit",
        ],
    );
    let svg = std::fs::read_to_string(place.path("p.svg")).unwrap();
    assert_says(&svg, &["film 412.0 nm"]);
    let beyond = inspect(water, "--vary 1:600:900 --angle 30 --lamp FL11").succeeded();
    assert_says(&beyond.stdout, &["nothing fits from 600 to 900 nm"]);
}

/// A rendered bubble, inspected with its scene: the film's thickness follows from the spectrum alone.
#[test]
fn the_scene_identifies_the_film_at_a_pixel() {
    let place = Place::default();
    let scene = root().join("scenes/soap_bubble.toml");
    let scene = scene.display();
    let _ = place
        .run(&format!(
            "render {scene} --backend cpu --size 48x36 --samples 64 -o a.exr"
        ))
        .succeeded();
    let ran = place.run(&format!(
        "inspect a.exr --at 24,14 --at 30,20 --at 1,1 --scene {scene} --format json"
    ));
    let found = json(ran);
    for index in [0, 1] {
        let film = &found["places"][index]["film"];
        let known = film["scene_thickness_nm"].as_f64().unwrap();
        let best = film["by_shape"][0]["thickness_nm"].as_f64().unwrap();
        println!("{known:.1} nm in the scene, {best:.1} nm from the spectrum: {film}");
        assert_eq!(film["material"], "soap");
        // The film varies by some 25 nm over a pixel of this size.
        assert!((best - known).abs() < 15.0, "{best} {known}");
    }
    assert_says(
        found["places"][2]["film"]["other"].as_str().unwrap(),
        &["velvet"],
    );
    let other = root().join("scenes/film_wedge.toml");
    let table = place
        .run(&format!("inspect a.exr --at 1,1 --scene {scene}"))
        .succeeded();
    assert_says(&table.stdout, &["no film: the scene has \"velvet\""]);
    // A scene that the image was not rendered from gives other results; its bands are fitted to those of the image.
    let _ = place
        .run(&format!(
            "inspect a.exr --at 24,14 --scene {}",
            other.display()
        ))
        .succeeded();
}

/// Assumptions made in reading a file of other origin are reported once, on standard error.
#[test]
fn files_of_other_origin_are_reported() {
    use exr::prelude::*;

    let place = Place::default();
    let channel = |name: &str, v: f32| AnyChannel::new(name, FlatSamples::F32(vec![v; 6]));
    let channels = [("T.0,5um", 0.5), ("T.520nm", 0.7), ("T.600nm", 0.9)];
    let channels = channels
        .map(|(name, v)| channel(name, v))
        .into_iter()
        .collect();
    Image::from_channels((3, 2), AnyChannels::sort(channels))
        .write()
        .to_file(place.path("t.exr"))
        .unwrap();
    let ran = place
        .run("inspect t.exr --at 0,0 --format json")
        .succeeded();
    assert_says(
        &ran.stderr,
        &[
            "t.exr: holds reflectances",
            "t.exr: its bands cover 490 to 640 nm",
        ],
    );
    let found: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(found["notes"].as_array().unwrap().len(), 2);
}

/// A rendered bubble under four lamps on one sheet: each picture equals the output of `develop` for the image relit by that lamp.
#[test]
fn a_booth_shows_each_lamp() {
    let place = Place::default();
    let scene = root().join("scenes/soap_bubble.toml");
    let scene = scene.display();
    let _ = place
        .run(&format!(
            "render {scene} --backend cpu --size 64x48 --samples 4 -o a.exr"
        ))
        .succeeded();
    let _ = place
        .run("develop a.exr --booth D65,A,F11 -o booth.png --gamut clip")
        .succeeded();
    let _ = place
        .run("develop a.exr -o d65.png --gamut clip")
        .succeeded();
    let sheet = image::open(place.path("booth.png")).unwrap().into_rgb8();
    let alone = image::open(place.path("d65.png")).unwrap().into_rgb8();
    // Two columns of 64 pixels, gaps of 12, labels of 40.
    assert_eq!(sheet.dimensions(), (2 * 76 + 12, 2 * 100 + 12));
    let (mut of_lamps, mut same) = ([[0_u64; 3]; 3], 0);
    for (x, y, pixel) in alone.enumerate_pixels() {
        for (lamp, (left, top)) in [(12, 52), (88, 52), (12, 152)].into_iter().enumerate() {
            let codes = sheet.get_pixel(left + x, top + y).0;
            for (sum, code) in of_lamps[lamp].iter_mut().zip(codes) {
                *sum += u64::from(code);
            }
        }
        let found = sheet.get_pixel(12 + x, 52 + y).0;
        same += u32::from((0..3).all(|i| found[i].abs_diff(pixel.0[i]) <= 1));
    }
    // The image's own lamp changes nothing beyond rounding; A is redder than D65.
    assert_eq!(same, 64 * 48);
    assert!(
        of_lamps[1][0] > of_lamps[0][0] && of_lamps[1][2] < of_lamps[0][2],
        "{of_lamps:?}"
    );
    assert_ne!(of_lamps[2], of_lamps[0]);

    let before = place.names();
    for (arguments, words) in [
        ("a.exr --booth A,x -o b.png", &["\"x\"", "known names:"][..]),
        ("a.exr --booth A -o b.exr", &["b.exr", ".png"]),
        ("none.exr --booth A -o b.png", &["none.exr"]),
    ] {
        assert_says(&place.run(&format!("develop {arguments}")).failed(), words);
    }
    // An image with an unknown lamp cannot be relit by another.
    write(&place.path("unknown.exr"), &gray([4, 3], 5, None));
    let said = place.run("develop unknown.exr --booth A -o b.png").failed();
    assert_says(&said, &["--booth A", "cannot be changed"]);
    assert_eq!(place.names().len(), before.len() + 1);
}
