//! Tests of the files that `pellicle render` writes.

use crate::place::{Place, Ran};
use crate::{assert_says, scene};
use picture_file::spectral_exr::{Metadata, read};
use spectra::SpectralImage;
use std::process::Stdio;

/// Settings of a picture small enough to be rendered often.
pub(crate) const SMALL: &str = "--size 32x24 --samples 2 --bands 6";

/// The command `render` for the soap bubble, with further arguments.
pub(crate) fn render(arguments: &str) -> String {
    format!("render {} {arguments}", scene("soap_bubble.toml"))
}

pub(crate) fn bytes(place: &Place, name: &str) -> Vec<u8> {
    std::fs::read(place.path(name)).unwrap()
}

pub(crate) fn exr(place: &Place, name: &str) -> (SpectralImage, Metadata) {
    read(&place.path(name)).unwrap()
}

pub(crate) fn png(place: &Place, name: &str) -> image::RgbImage {
    image::open(place.path(name)).unwrap().into_rgb8()
}

#[test]
fn a_render_writes_both_files_named_after_the_scene() {
    let place = Place::default();
    let ran = place.run(&render(SMALL)).succeeded();
    assert_eq!(place.names(), ["soap_bubble.exr", "soap_bubble.png"]);
    assert!(ran.stdout.is_empty(), "{}", ran.stdout);
    assert_says(
        &ran.stderr,
        &["wrote soap_bubble.png", "wrote soap_bubble.exr"],
    );
}

/// The option `-o` of a render chooses the names of its files.
fn written(outputs: &str, expected: &[&str]) {
    let place = Place::default();
    let arguments = format!("{SMALL} --backend cpu {outputs}");
    let _ = place.run(&render(&arguments)).succeeded();
    assert_eq!(place.names(), expected);
}

cases! { written:
    a_png_alone("-o a.png", &["a.png"]);
    an_exr_alone("-o a.exr", &["a.exr"]);
    endings_in_capitals("-o A.PNG", &["A.PNG"]);
    both_files_of_one_name("-o a", &["a.exr", "a.png"]);
    each_file_by_its_name("-o a.png -o b.exr", &["a.png", "b.exr"]);
    both_files_in_this_folder("-o .", &["soap_bubble.exr", "soap_bubble.png"]);
    both_files_in_a_folder_with_a_slash("-o ./", &["soap_bubble.exr", "soap_bubble.png"]);
}

#[test]
fn paths_may_contain_spaces_and_any_letters() {
    let place = Place::default();
    std::fs::create_dir(place.path("a folder")).unwrap();
    std::fs::copy(scene("film_wedge.toml"), place.path("öl film.toml")).unwrap();
    let mut command = place.command(&format!("render {SMALL} --backend cpu"));
    command.args(["öl film.toml", "-o", "a folder"]);
    let _ = Ran::of(&command.output().unwrap()).succeeded();
    assert!(place.path("a folder/öl film.png").is_file());
    assert!(place.path("a folder/öl film.exr").is_file());
}

#[test]
fn options_replace_the_settings_of_the_scene() {
    let place = Place::default();
    let options = "--size 20x10 --samples 3 --bands 7 --seed 5 -o a";
    let _ = place.run(&render(options)).succeeded();
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!((image.width(), image.height()), (20, 10));
    assert_eq!(image.bands().count(), 7);
    assert!(image.samples().iter().all(|&samples| samples == 3));
    assert_eq!(metadata.settings["samples"], "3");
    assert_eq!(metadata.settings["seed"], "5");
    assert_eq!(png(&place, "a.png").dimensions(), (20, 10));
}

fn equal_seeds_give_equal_bits(backend: &str) {
    let place = Place::default();
    for (name, seed) in [("a", 1), ("b", 1), ("c", 2)] {
        let options = format!("{SMALL} --backend {backend} --seed {seed} -o {name}");
        let _ = place.run(&render(&options)).succeeded();
    }
    let picture = |name| bytes(&place, &format!("{name}.png"));
    assert!(picture("a") == picture("b"), "the PNGs differ");
    assert!(picture("a") != picture("c"), "the same PNG");
    let spectral = |name| bytes(&place, &format!("{name}.exr"));
    assert!(spectral("a") == spectral("b"), "the EXRs differ");
    let radiance = |name| exr(&place, &format!("{name}.exr")).0.radiance().to_vec();
    assert!(radiance("a") != radiance("c"), "the same EXR");
}

cases! { equal_seeds_give_equal_bits:
    equal_seeds_give_equal_bits_on_the_gpu("gpu");
    equal_seeds_give_equal_bits_on_the_cpu("cpu");
}

#[test]
fn without_a_terminal_there_is_no_progress_bar() {
    let place = Place::default();
    let ran = place.run(&render(&format!("{SMALL} --backend cpu")));
    let said = ran.succeeded().stderr;
    for sign in ['\r', '\u{1b}', '█', '░'] {
        assert!(!said.contains(sign), "{sign:?} in {said:?}");
    }
    // The lines name the renderer, the work, the speed, and two files.
    assert_eq!(said.lines().count(), 5, "{said}");
}

/// `pellicle schema | head -1` must not end in a panic.
#[test]
fn a_closed_pipe_is_no_error() {
    let place = Place::default();
    let mut command = place.command("schema");
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let ran = Ran::of(&child.wait_with_output().unwrap()).succeeded();
    assert!(ran.stderr.is_empty(), "{}", ran.stderr);
}
