//! Tests of `pellicle develop --booth`.

use crate::images::{gray, write};
use crate::place::Place;
use crate::{assert_says, scene};

/// A rendered bubble under four lamps on one sheet: each picture equals the output of `develop` for the image relit by that lamp.
#[test]
fn a_booth_shows_each_lamp() {
    let place = Place::default();
    let scene = scene("soap_bubble.toml");
    let _ = place
        .run(&format!(
            "render {scene} --backend cpu --size 64x48 --samples 4 -o a.exr"
        ))
        .succeeded();
    let _ = place
        .run("develop a.exr --booth D65,A,F11 -o booth.png --gamut clip")
        .succeeded();
    let mut command = place.command("develop a.exr --booth D65,A,F11 -o - --gamut clip");
    let to_standard_output = command.output().unwrap().stdout;
    assert!(to_standard_output == std::fs::read(place.path("booth.png")).unwrap());
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
}

/// `develop --booth` fails with all of `words` and leaves no file.
fn refused(arguments: &str, words: &[&str]) {
    let place = Place::default();
    // An image with an unknown lamp cannot be relit by another.
    write(&place.path("a.exr"), &gray([4, 3], 5, None));
    assert_says(&place.run(&format!("develop {arguments}")).failed(), words);
    assert_eq!(place.names(), ["a.exr"]);
}

cases! { refused:
    an_unknown_lamp("a.exr --booth A,x -o b.png", &["\"x\"", "known names:"]);
    a_spectral_image_as_sheet("a.exr --booth A -o b.exr", &["b.exr", ".png"]);
    a_missing_image("none.exr --booth A -o b.png", &["none.exr"]);
    an_image_whose_lamp_is_unknown("a.exr --booth A -o b.png", &["--booth A", "cannot be changed"]);
}
