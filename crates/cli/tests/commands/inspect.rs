//! Tests of `pellicle inspect`.

use crate::images::{gray, image, write};
use crate::place::{Place, Ran};
use crate::{assert_says, json, scene};
use pellicle::coating::{Angle, FilmFitting, Stack, View};
use serde_json::Value;
use spectra::BandGrid;

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

/// `inspect` fails with all of `words` and leaves no file.
fn refused(arguments: &str, words: &[&str]) {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([4, 3], 5, None));
    let said = place.run(&format!("inspect {arguments}")).failed();
    assert_says(&said, words);
    assert_eq!(place.names(), ["a.exr"], "a partly written file was left");
}

cases! { refused:
    a_pixel_outside_the_image("a.exr --at 4,0", &["4,0", "4×3"]);
    a_region_outside_the_image("a.exr --region 0,0,5,1", &["0,0,5,1", "4×3"]);
    a_region_without_pixels("a.exr --region 0,0,0,1", &["no pixels"]);
    a_pixel_of_one_number("a.exr --at 1", &["320,200"]);
    a_negative_pixel("a.exr --at -1,0", &["-1"]);
    a_region_of_three_numbers("a.exr --region 1,2,3", &["left, top, width, height"]);
    a_missing_image("none.exr", &["none.exr"]);
    a_plot_of_an_unknown_type("a.exr --plot p.gif", &[".svg or .png"]);
    the_image_itself_as_plot("a.exr --plot a.exr", &[".svg or .png"]);
    a_layer_without_a_film("a.exr --vary 1:0:100", &["--film or --scene"]);
    an_angle_without_a_film("a.exr --angle 30", &["--film"]);
    a_stack_with_an_unknown_medium("a.exr --film 1|water_10nm", &["|"]);
    a_film_and_a_scene("a.exr --film 1|1.5 --scene s.toml", &["cannot be used with"]);
    a_film_without_layers("a.exr --film 1|1.5", &["no layer"]);
    a_missing_scene("a.exr --scene none.toml", &["none.toml"]);
    an_impossible_exposure("a.exr --exposure 1e9", &["--exposure"]);
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
    let scene = scene("soap_bubble.toml");
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
    let other = crate::scene("film_wedge.toml");
    let table = place
        .run(&format!("inspect a.exr --at 1,1 --scene {scene}"))
        .succeeded();
    assert_says(&table.stdout, &["no film: the scene has \"velvet\""]);
    // A scene that the image was not rendered from gives other results; its bands are fitted to those of the image.
    let _ = place
        .run(&format!("inspect a.exr --at 24,14 --scene {other}"))
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
