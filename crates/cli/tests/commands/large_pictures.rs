//! Pictures that are rendered in strips, and parts of pictures.

use crate::assert_says;
use crate::place::Place;
use crate::render::{exr, png, render};
use exr::meta::MetaData;

/// A picture whose state takes more memory than a strip: many bands rather than many pixels, which would take longer.
const LARGE: &str = "--backend cpu --size 100x100 --bands 1024";

/// The number in front of ` MB` that follows some words.
fn megabytes(text: &str, words: &str) -> f64 {
    let (_, rest) = text.split_once(words).unwrap();
    rest.split_once(" MB").unwrap().0.trim().parse().unwrap()
}

/// The least memory that the picture takes, in MB.
fn least(place: &Place, options: &str) -> f64 {
    let ran = place.run(&render(&format!(
        "{LARGE} {options} --max-memory 1MB -o a.exr"
    )));
    assert_eq!(ran.code, 1);
    megabytes(&ran.failed(), "with 1024 bands takes")
}

/// With enough memory for strips, but not for the whole picture, the pixels are the same. The noise of the picture is not known when
/// its first strip is written.
#[test]
fn strips_have_the_same_pixels() {
    let options = "--samples 2";
    let place = Place::default();
    let _ = place
        .run(&render(&format!("{LARGE} {options} -o whole")))
        .succeeded();
    // The number has three digits.
    let memory = (1.01 * least(&place, options)).ceil();
    let strips = format!("{LARGE} {options} --max-memory {memory}MB -o strips");
    let ran = place.run(&render(&strips)).succeeded();
    assert_says(&ran.stderr, &["it is rendered", "of 100 rows at a time"]);
    assert!(
        png(&place, "strips.png") == png(&place, "whole.png"),
        "other colors"
    );
    let (strips, mut whole) = (exr(&place, "strips.exr"), exr(&place, "whole.exr"));
    assert!(strips.0 == whole.0, "other pixels");
    for unknown in ["noise", "stopped_by"] {
        assert!(whole.1.settings.remove(unknown).is_some());
    }
    assert_eq!(strips.1.settings, whole.1.settings);
}

#[test]
fn too_little_memory_is_refused_with_both_numbers() {
    let place = Place::default();
    let ran = place.run(&render(
        "--size 640x480 --bands 40 --backend cpu --max-memory 20MB -o a",
    ));
    assert_eq!(ran.code, 1);
    let stderr = ran.failed();
    assert!(megabytes(&stderr, "with 40 bands takes") > 20.0);
    assert_says(&stderr, &["but 20.0 MB can be used", "--part"]);
    assert!(place.names().is_empty());
}

#[test]
fn what_needs_all_pixels_is_not_rendered_in_strips() {
    let place = Place::default();
    let memory = (1.01 * least(&place, "")).ceil();
    let strips = format!("{LARGE} --max-memory {memory}MB -o a.exr --noise 2%");
    let ran = place.run(&render(&strips));
    assert_eq!(ran.code, 1);
    assert_says(&ran.failed(), &["leave out", "--noise"]);
    assert!(place.names().is_empty());
}

/// A signal ends a render in strips after a strip: the file is whole, the other rows have no samples, and it says so.
#[cfg(unix)]
#[test]
fn an_interrupted_picture_in_strips_says_so() {
    use crate::running::{Running, temporary};

    let place = Place::default();
    let memory = (1.01 * least(&place, "--samples 1")).ceil();
    let settings = format!("{LARGE} --samples 1 --max-memory {memory}MB -o a.exr");
    let mut running = Running::start(&place, &render(&settings));
    assert!(running.wait_for(|| !temporary(&place, "a.exr").is_empty()));
    running.signal("INT");
    let ran = running.ran();
    assert_eq!(ran.code, 130, "{}", ran.stderr);
    assert_says(&ran.stderr, &["stopped before row", "--crop 0,"]);
    assert_eq!(place.names(), ["a.exr"]);
    let (image, metadata) = exr(&place, "a.exr");
    let samples = image.samples();
    assert_eq!((samples[0], samples[9999]), (1, 0));
    assert!(samples.is_sorted_by(|a, b| a >= b), "rows in between");
    let stopped_by = metadata.settings.get("stopped_by");
    assert_ne!(stopped_by.map(|by| &by[..]), Some("samples"));
}

/// A crop has the pixels of the whole picture, and the file says where they are in it.
fn a_crop_has_the_pixels_of_the_whole(backend: &str) {
    let place = Place::default();
    let settings = format!("--backend {backend} --size 40x30 --bands 4 --samples 3");
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("-o whole.exr");
    let _ = run("--crop 13,7,11,9 -o crop");
    let file = MetaData::read_from_file(place.path("crop.exr"), false).unwrap();
    let (data, picture) = (
        &file.headers[0],
        file.headers[0].shared_attributes.display_window,
    );
    assert_eq!(
        (
            data.own_attributes.layer_position.x(),
            data.own_attributes.layer_position.y()
        ),
        (13, 7)
    );
    assert_eq!((data.layer_size.width(), data.layer_size.height()), (11, 9));
    assert_eq!((picture.size.width(), picture.size.height()), (40, 30));
    let (whole, crop) = (exr(&place, "whole.exr").0, exr(&place, "crop.exr").0);
    assert_eq!((crop.width(), crop.height()), (40, 30));
    for y in 0..30 {
        for x in 0..40 {
            let is_inside = (13..24).contains(&x) && (7..16).contains(&y);
            let samples = crop.samples()[(y * 40 + x) as usize];
            assert_eq!(samples, if is_inside { 3 } else { 0 });
            if is_inside {
                assert_eq!(crop.pixel(x, y), whole.pixel(x, y), "{x},{y}");
            }
        }
    }
    assert_eq!(png(&place, "crop.png").dimensions(), (11, 9));
}

cases! { a_crop_has_the_pixels_of_the_whole:
    a_crop_has_the_pixels_of_the_whole_on_the_cpu("cpu");
    a_crop_has_the_pixels_of_the_whole_on_the_gpu("gpu");
}

/// Pixels that are not all within the picture.
fn a_crop_beyond_the_picture(crop: &str) {
    let words = ["--crop", "are not all within the picture", "40×30 pixels"];
    crate::render_refusals::refused(&format!("--size 40x30 --backend cpu --crop {crop}"), &words);
}

cases! { a_crop_beyond_the_picture:
    a_crop_that_begins_beyond_the_picture("40,0,1,1");
    a_crop_that_is_too_wide("30,0,11,1");
    a_crop_whose_end_overflows("1,1,4294967295,4294967295");
}

/// The parts of a picture have its rows, each once.
#[test]
fn parts_have_the_rows_of_the_whole() {
    let place = Place::default();
    let settings = "--backend cpu --size 20x11 --bands 4 --samples 2";
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("-o whole.exr");
    let whole = exr(&place, "whole.exr").0;
    let mut rows = 0;
    for number in 1..=3 {
        let _ = run(&format!("--part {number}/3"));
        let part = exr(&place, &format!("soap_bubble_part_{number}_of_3.exr")).0;
        for y in (0..11).filter(|y| part.samples()[(20 * y) as usize] > 0) {
            assert!(
                (0..20).all(|x| part.pixel(x, y) == whole.pixel(x, y)),
                "row {y}"
            );
            rows += 1;
        }
    }
    assert_eq!(rows, 11);
}
