//! Tests of commands on spectral images of polarized light.

use crate::images::{gray, image, write};
use crate::place::Place;
use crate::{assert_says, json};
use ::image::ImageReader;
use spectra::{SpectralImage, Stokes};

/// An image in which every pixel has these components over its radiance of 0.2.
fn polarized(shares: [f32; 3]) -> SpectralImage {
    let mut image = gray([6, 4], 8, None).with_polarization();
    for (x, y) in (0..24).map(|i| (i % 6, i / 6)) {
        let (s0, xyz) = (image.pixel(x, y).to_vec(), image.xyz()[0]);
        for (stokes, share) in Stokes::POLARIZED.into_iter().zip(shares) {
            let radiance: Vec<f32> = s0.iter().map(|v| share * v).collect();
            let xyz = [xyz.map(|v| share * v)];
            image.set_component_by_light((x, y), stokes, &radiance, &xyz);
        }
    }
    image
}

/// The codes of a pixel of a picture.
fn code(place: &Place, name: &str, [x, y]: [u32; 2]) -> [u8; 3] {
    let reader = ImageReader::open(place.path(name)).unwrap();
    reader.decode().unwrap().into_rgb8().get_pixel(x, y).0
}

/// Fully polarized light at 30°: what passes is cos² of the angle between (Malus 1809), so the picture is that of a gray as dark.
#[test]
fn a_polarizer_follows_malus_law() {
    let place = Place::default();
    let (sin, cos) = 60.0_f32.to_radians().sin_cos();
    write(&place.path("image.exr"), &polarized([cos, sin, 0.0]));
    for (angle, share) in [
        ("30", 1.0),
        ("-30", 0.25),
        ("75", 0.5),
        ("120", 0.0),
        ("210", 1.0),
    ] {
        let _ = place
            .run(&format!(
                "develop image.exr -o turned.png --exposure 1 --polarizer {angle}"
            ))
            .succeeded();
        let gray = image([6, 4], 8, |_, _| vec![0.2 * share; 8]);
        write(&place.path("gray.exr"), &gray);
        let _ = place
            .run("develop gray.exr -o gray.png --exposure 1")
            .succeeded();
        let [found, expected] = ["turned.png", "gray.png"].map(|name| code(&place, name, [3, 2]));
        let off = found.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(1), "{angle}: {found:?} {expected:?}");
    }
    // It goes with other brightnesses of the light.
    let group = spectra::LightGroup::unknown().name;
    for (name, options) in [
        ("a.png", format!("--exposure 1 --light {group}=*2")),
        ("b.png", "--exposure 2".to_owned()),
    ] {
        let _ = place
            .run(&format!(
                "develop image.exr -o {name} --polarizer 75 {options}"
            ))
            .succeeded();
    }
    assert_eq!(code(&place, "a.png", [1, 1]), code(&place, "b.png", [1, 1]));
}

#[test]
fn an_image_without_polarization_has_no_polarizer() {
    let place = Place::default();
    write(&place.path("image.exr"), &gray([6, 4], 8, None));
    for option in ["--polarizer 30", "--stokes dolp"] {
        let message = place
            .run(&format!("develop image.exr -o a.png {option}"))
            .failed();
        let name = option.split(' ').next().unwrap();
        assert_says(
            &message,
            &[
                name,
                "has no polarization that can be used",
                "render.polarization = true",
            ],
        );
    }
    let message = place
        .run("develop image.exr -o a.png --polarizer x")
        .failed();
    assert_says(&message, &["angle of a polarizer", "-360 to 360"]);
    assert!(!place.path("a.png").exists());
}

#[test]
fn polarization_is_shown_in_false_colors_with_their_scale() {
    let place = Place::default();
    // Fully polarized: half linear at 60°, with an angle of 2·60° between S1 and S2, and right circular.
    write(
        &place.path("image.exr"),
        &polarized([-0.3, 0.3 * 3.0_f32.sqrt(), 0.8]),
    );
    for (shown, expected) in [
        ("dop", color::Polarization::Degree.color(1.0, 1.0)),
        ("dolp", color::Polarization::Linear.color(0.6, 1.0)),
        ("docp", color::Polarization::Circular.color(0.9, 1.0)),
        ("aolp", color::Polarization::Angle.color(60.0 / 180.0, 0.6)),
        ("s1", color::Polarization::S1.color(0.35, 1.0)),
        (
            "s2",
            color::Polarization::S2.color(0.5 + 0.15 * 3.0_f64.sqrt(), 1.0),
        ),
        ("s3", color::Polarization::S3.color(0.9, 1.0)),
    ] {
        let name = format!("{shown}.png");
        let ran = place.run(&format!("develop image.exr -o {name} --stokes {shown}"));
        assert_says(&ran.succeeded().stderr, &[&format!("wrote {name}")]);
        let found = code(&place, &name, [2, 3]);
        let off = found.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(1), "{shown}: {found:?} {expected:?}");
        // The scale is below: its ends have the colors of the ends.
        let size = ::image::image_dimensions(place.path(&name)).unwrap();
        assert!(size.0 > 300 && size.1 > 4 + 100, "{size:?}");
        assert_ne!(code(&place, &name, [60, 50]), [255; 3], "{shown}");
    }
    let message = place
        .run("develop image.exr -o a.exr --stokes dop")
        .failed();
    assert_says(&message, &["a.exr", ".png"]);
    let message = place
        .run("develop image.exr -o a.png --stokes dop --exposure 1")
        .failed();
    assert_says(&message, &["--stokes", "--exposure"]);
}

#[test]
fn inspect_shows_degrees_and_angles() {
    let place = Place::default();
    let image = polarized([0.0, -0.6, -0.3]);
    write(&place.path("image.exr"), &image);
    let table = place.run("inspect image.exr --at 2,1").succeeded().stdout;
    let degree = format!("{:.2} %", 100.0 * 0.45_f64.sqrt());
    assert_says(
        &table,
        &[
            &degree,
            "60.00 % linear at 135.00°",
            "30.00 % left circular",
        ],
    );
    assert_says(
        &table,
        &["DoP", "AoLP/°", "DoCP", " 0.6708  135.00  -0.3000"],
    );
    let found = json(place.run("inspect image.exr --at 2,1 --format json"));
    let of = &found["places"][0]["polarization"];
    for band in 0..8 {
        assert!((of["s2"][band].as_f64().unwrap() + 0.12).abs() < 1e-6);
        assert!((of["linear_degree"][band].as_f64().unwrap() - 0.6).abs() < 1e-5);
        assert!((of["angle_deg"][band].as_f64().unwrap() - 135.0).abs() < 1e-4);
    }
    assert!((of["of_luminance"]["circular_degree"].as_f64().unwrap() + 0.3).abs() < 1e-6);
    let csv = place
        .run("inspect image.exr --at 2,1 --format csv")
        .succeeded()
        .stdout;
    assert_says(
        &csv,
        &["wavelength_nm,radiance_2_1,deviation_2_1,s1_2_1,s2_2_1,s3_2_1"],
    );
    let row: Vec<&str> = csv.lines().nth(1).unwrap().split(',').collect();
    assert!(
        (row[5].parse::<f64>().unwrap() + 0.06).abs() < 1e-6,
        "{row:?}"
    );
    // Without polarization nothing is said of it.
    write(&place.path("gray.exr"), &gray([6, 4], 8, None));
    let table = place.run("inspect gray.exr --at 2,1").succeeded().stdout;
    assert!(
        !table.contains("polarization") && !table.contains("DoP"),
        "{table}"
    );
}

#[test]
fn compare_measures_each_component() {
    let place = Place::default();
    write(&place.path("a.exr"), &polarized([0.5, 0.0, 0.1]));
    write(&place.path("b.exr"), &polarized([0.5, 0.2, 0.1]));
    let found = json(place.run("compare a.exr b.exr --format json"));
    assert_eq!(found["rmse_over_noise"], 0.0);
    let components = found["components"].as_array().unwrap();
    assert_eq!(components.len(), 3);
    for (component, (name, bias)) in components
        .iter()
        .zip([("S1", 0.0), ("S2", 0.04), ("S3", 0.0)])
    {
        assert_eq!(component["component"], name);
        let own = component["bands"][3]["bias"].as_f64().unwrap();
        assert!((own - bias).abs() < 1e-7, "{component}");
    }
    // 0.04 over √2 of the deviation of 1 % of 0.2.
    let ratio = components[1]["rmse_over_noise_of_s0"].as_f64().unwrap();
    assert!(
        (ratio - 0.04 / (2.0_f64.sqrt() * 0.002)).abs() < 1e-3,
        "{ratio}"
    );
    let table = place.run("compare a.exr b.exr").succeeded().stdout;
    assert_says(&table, &["over S0", "S1", "S2", "2.0000e-1", "S3"]);
}

#[test]
fn compare_takes_the_radiance_if_only_one_image_is_polarized() {
    let place = Place::default();
    write(&place.path("a.exr"), &polarized([0.5, 0.0, 0.1]));
    write(&place.path("b.exr"), &gray([6, 4], 8, None));
    for [first, second] in [["a.exr", "b.exr"], ["b.exr", "a.exr"]] {
        let ran = place.run(&format!("compare {first} {second} --format json"));
        assert_says(&ran.stderr, &["only a.exr holds S1, S2 and S3"]);
        let found = json(ran);
        assert_eq!(found["components"].as_array().unwrap().len(), 0);
        assert_eq!(found["bands"][0]["rmse"], 0.0);
    }
}
