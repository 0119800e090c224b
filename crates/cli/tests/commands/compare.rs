//! Tests of `pellicle compare`.

use crate::images::{gray, write};
use crate::place::Place;
use crate::{assert_says, json};
use color::DevelopSettings;
use picture_file::RgbImage8;

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
    picture_file::png::write(&place.path("a.png"), &codes(120)).unwrap();
    picture_file::png::write(&place.path("b.png"), &codes(160)).unwrap();
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
    picture_file::png::write(&place.path("c.png"), &developed).unwrap();
    // sRGB clips the red of equal energy; the rest is rounding of the codes.
    let alike = json(place.run("compare c.exr c.png --exposure 1 --format json"));
    assert!(alike["delta_e_2000"]["max"].as_f64().unwrap() < 1.0);
    let darker = json(place.run("compare c.exr c.png --exposure 0 --format json"));
    assert!(darker["delta_e_2000"]["max"].as_f64().unwrap() > 10.0);
}

/// `compare` fails with all of `words` and leaves no file.
fn refused(arguments: &str, words: &[&str]) {
    let place = Place::default();
    write(&place.path("a.exr"), &gray([6, 4], 8, None));
    write(&place.path("wide.exr"), &gray([7, 4], 8, None));
    write(&place.path("bands.exr"), &gray([6, 4], 9, None));
    let picture = RgbImage8::new(2, 1, vec![9; 6]).unwrap();
    picture_file::png::write(&place.path("small.png"), &picture).unwrap();
    std::fs::write(place.path("text.png"), "no picture").unwrap();
    std::fs::write(place.path("text.exr"), "no image").unwrap();
    let before = place.names();
    let said = place.run(&format!("compare {arguments}")).failed();
    assert_says(&said, words);
    assert_eq!(place.names(), before, "a partly written file was left");
}

cases! { refused:
    images_of_other_sizes("a.exr wide.exr", &["6×4", "7×4"]);
    images_of_other_bands("a.exr bands.exr", &["8 bands", "9 bands"]);
    a_picture_of_another_size("a.exr small.png", &["6×4", "2×1"]);
    a_missing_image("a.exr none.exr", &["none.exr"]);
    a_text_as_image("a.exr text.exr", &["text.exr", "not an OpenEXR"]);
    a_text_as_picture("a.exr text.png", &["text.png", "not a PNG"]);
    a_file_of_an_unknown_type("a.exr a.jpg", &["a.jpg", ".exr"]);
    a_map_of_an_unknown_type("a.exr a.exr --map m.jpg", &["m.jpg", ".png"]);
    a_map_in_a_missing_folder("a.exr a.exr --map no/m.png", &["no"]);
    a_map_over_a_picture("small.png small.png --map small.png", &["overwrite"]);
    an_exposure_for_pictures("small.png small.png --exposure 1", &["--exposure"]);
    an_impossible_exposure("a.exr a.exr --exposure 1e9", &["--exposure", "from"]);
    a_map_of_images_of_other_sizes("a.exr wide.exr --map m.png", &["6×4"]);
}
