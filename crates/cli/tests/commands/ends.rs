//! What else than a number of samples ends a render, and what is written before.

use crate::place::Place;
use crate::render::{bytes, exr, png, render};
use std::time::Instant;

#[test]
fn a_render_ends_with_the_noise_that_was_asked_for() {
    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 8 --noise 4% -o a.exr";
    let _ = place.run(&render(settings)).succeeded();
    let (image, metadata) = exr(&place, "a.exr");
    let noise: f64 = metadata.settings["noise"].parse().unwrap();
    // A goal that is missed by much would have cost four times the samples of one that is twice as large.
    assert!((0.01..=0.04).contains(&noise), "{noise}");
    assert_eq!(metadata.settings["stopped_by"], "noise");
    let samples = image.samples()[0];
    assert!((2..1000).contains(&samples), "{samples}");
    assert_eq!(metadata.settings["samples"], samples.to_string());
}

/// Renders that end with a noise are judged at the same numbers of samples, however long their rounds are.
#[test]
fn checkpoints_do_not_move_the_end() {
    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 8 --noise 2%";
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("-o whole.exr");
    let _ = run("-o a.exr --checkpoint kept --checkpoint-every 10ms");
    assert!(
        bytes(&place, "a.exr") == bytes(&place, "whole.exr"),
        "other bytes"
    );
}

/// With fewer samples than the noise needs, these end the render.
#[test]
fn samples_end_a_render_before_its_noise_does() {
    let place = Place::default();
    let settings = "--backend cpu --size 24x18 --bands 4 --noise 0.01% --samples 20 -o a.exr";
    let _ = place.run(&render(settings)).succeeded();
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!(metadata.settings["stopped_by"], "samples");
    assert!(image.samples().iter().all(|&samples| samples == 20));
}

fn a_render_ends_in_time(backend: &str) {
    let place = Place::default();
    let settings = format!("--backend {backend} --size 48x36 --bands 8 --time 1s -o a.exr");
    let started = Instant::now();
    let ran = place.run(&render(&settings)).succeeded();
    let seconds = started.elapsed().as_secs_f64();
    // A driver compiles the shader first, and other tests take their share of the cores.
    assert!(
        (0.5..15.0).contains(&seconds),
        "{seconds} s: {}",
        ran.stderr
    );
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!(metadata.settings["stopped_by"], "time");
    let samples = image.samples()[0];
    assert_eq!(metadata.settings["samples"], samples.to_string());
    assert!(
        image
            .samples()
            .iter()
            .all(|&count| count == samples && count > 0)
    );
}

cases! { a_render_ends_in_time:
    a_render_ends_in_time_on_the_cpu("cpu");
    a_render_ends_in_time_on_the_gpu("gpu");
}

/// A picture that takes longer than its time gets one sample of each pixel.
#[test]
fn every_pixel_gets_a_sample() {
    let place = Place::default();
    let settings = "--backend cpu --size 64x48 --bands 4 --time 1ms -o a.exr";
    let _ = place.run(&render(settings)).succeeded();
    assert!(
        exr(&place, "a.exr")
            .0
            .samples()
            .iter()
            .all(|&samples| samples > 0)
    );
}

#[cfg(unix)]
#[test]
fn a_preview_is_there_before_the_end() {
    use crate::running::{Running, exists};

    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 8 --samples 1000000 --preview-every 20ms";
    let mut running = Running::start(&place, &render(&format!("{settings} -o a")));
    assert!(running.wait_for(|| exists(&place, "a.png")));
    let first = bytes(&place, "a.png");
    assert_eq!(png(&place, "a.png").dimensions(), (48, 36));
    assert!(running.wait_for(|| bytes(&place, "a.png") != first));
    assert!(!exists(&place, "a.exr"), "previews are pictures");
}

/// The last preview is replaced by the picture, which is that of a render without previews.
#[test]
fn previews_do_not_change_the_picture() {
    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 8 --samples 100";
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("-o whole");
    let _ = run("-o a --preview-every 10ms");
    assert!(
        bytes(&place, "a.png") == bytes(&place, "whole.png"),
        "other bytes"
    );
    assert!(
        bytes(&place, "a.exr") == bytes(&place, "whole.exr"),
        "other bytes"
    );
    assert_eq!(place.names(), ["a.exr", "a.png", "whole.exr", "whole.png"]);
}
