//! Checkpoints: which are gone on from, and which are refused.

use crate::place::Place;
use crate::render::{bytes, exr, render};
use crate::{assert_says, scene};

/// A small picture with a checkpoint in `kept`.
const KEPT: &str =
    "--backend cpu --size 24x18 --bands 4 --samples 8 --checkpoint kept --checkpoint-every 1h";

/// A folder with the checkpoint of a finished render, and nothing else.
fn place() -> Place {
    let place = Place::default();
    let _ = place.run(&render(&format!("{KEPT} -o a.exr"))).succeeded();
    std::fs::remove_file(place.path("a.exr")).unwrap();
    place
}

/// A checkpoint has the bytes that were written: what refuses it for another scene has compared its digest before.
pub(crate) fn assert_is_whole(place: &Place, name: &str) {
    let furnace = scene("furnace.toml");
    let options = "--backend cpu --size 4x4 --bands 4 --samples 1 --resume -o x.png";
    let other = Place::default();
    let path = place.path(name);
    let arguments = format!("render {furnace} {options} --checkpoint {}", path.display());
    assert_says(
        &other.run(&arguments).failed(),
        &["a checkpoint of another render"],
    );
}

/// Going on from the checkpoint fails with all of `words`, and nothing is written.
fn assert_is_refused(place: &Place, arguments: &str, words: &[&str]) {
    let before = bytes(place, "kept");
    let ran = place.run(arguments);
    assert_eq!(ran.code, 1);
    assert_says(&ran.failed(), words);
    assert_eq!(place.names(), ["kept"]);
    assert!(bytes(place, "kept") == before, "the checkpoint has changed");
}

/// A checkpoint whose bytes were changed is refused.
fn damaged(change: fn(&mut Vec<u8>), words: &[&str]) {
    let place = place();
    let mut bytes = bytes(&place, "kept");
    change(&mut bytes);
    std::fs::write(place.path("kept"), bytes).unwrap();
    assert_is_refused(&place, &render(&format!("{KEPT} --resume -o a")), words);
}

const DAMAGED: &[&str] = &["kept: the checkpoint is damaged"];
const UNKNOWN: &[&str] = &["kept is not a checkpoint of this program"];

cases! { damaged:
    a_flipped_bit_in_the_first_line(|bytes| bytes[3] ^= 4, UNKNOWN);
    a_flipped_bit_in_the_length(|bytes| bytes[22] ^= 1, DAMAGED);
    a_flipped_bit_in_the_top_of_the_length(|bytes| bytes[29] ^= 128, DAMAGED);
    a_flipped_bit_in_the_header(|bytes| bytes[200] ^= 1, DAMAGED);
    a_flipped_bit_in_the_middle(|bytes| { let at = bytes.len() / 2; bytes[at] ^= 16; }, DAMAGED);
    a_flipped_bit_at_the_end(|bytes| *bytes.last_mut().unwrap() ^= 128, DAMAGED);
    half_a_checkpoint(|bytes| bytes.truncate(bytes.len() / 2), DAMAGED);
    a_checkpoint_without_its_last_byte(|bytes| { bytes.pop(); }, DAMAGED);
    a_checkpoint_with_another_byte(|bytes| bytes.push(0), DAMAGED);
    the_first_line_alone(|bytes| bytes.truncate(22), DAMAGED);
    an_empty_checkpoint(Vec::clear, UNKNOWN);
    a_file_that_is_no_checkpoint(|bytes| *bytes = b"PELLICLE".repeat(99), UNKNOWN);
}

/// The checkpoint of another render is refused by what differs.
fn foreign(options: &str, words: &[&str]) {
    let place = place();
    let words = [
        &["kept is a checkpoint of another render: it differs in"],
        words,
    ]
    .concat();
    let backend = if options.contains("--backend") {
        ""
    } else {
        "--backend cpu"
    };
    let size = if options.contains("--size") {
        ""
    } else {
        "--size 24x18"
    };
    let bands = if options.contains("--bands") {
        ""
    } else {
        "--bands 4"
    };
    let own = "--samples 8 --checkpoint kept --resume -o a";
    let arguments = render(&format!("{backend} {size} {bands} {own} {options}"));
    assert_is_refused(&place, &arguments, &words);
}

cases! { foreign:
    a_checkpoint_of_another_seed("--seed 2", &["seed (0 instead of 2)"]);
    a_checkpoint_of_another_size("--size 18x24", &["size (24x18 instead of 18x24)", "window"]);
    a_checkpoint_of_other_bands("--bands 5", &["bands (4 from"]);
    a_checkpoint_of_another_backend("--backend gpu", &["backend ("]);
    a_checkpoint_of_another_time("--scene-time 0.5", &["time s (0 instead of 0.5)"]);
    a_checkpoint_of_other_samples("--samples-from 8", &["first sample (0 instead of 8)"]);
    a_checkpoint_of_other_pixels("--crop 0,0,8,8", &["window ("]);
    a_checkpoint_of_another_way_of_sampling("--adaptive", &["adaptive"]);
}

#[test]
fn a_checkpoint_of_another_scene() {
    let place = place();
    let wedge = format!("render {} {KEPT} --resume -o a", scene("film_wedge.toml"));
    let words = [
        "a checkpoint of another render",
        "camera",
        "materials",
        "objects",
    ];
    assert_is_refused(&place, &wedge, &words);
}

#[test]
fn a_checkpoint_is_gone_on_from_only_when_that_is_asked_for() {
    let words = ["--checkpoint kept: this file exists", "--resume"];
    assert_is_refused(&place(), &render(&format!("{KEPT} -o a")), &words);
}

#[test]
fn without_a_checkpoint_a_resumed_render_begins() {
    let place = Place::default();
    let _ = place
        .run(&render(&format!("{KEPT} --resume -o a.exr")))
        .succeeded();
    assert_eq!(place.names(), ["a.exr", "kept"]);
}

#[test]
fn a_folder_is_no_checkpoint() {
    let place = Place::default();
    std::fs::create_dir(place.path("kept")).unwrap();
    let ran = place.run(&render(&format!("{KEPT} --resume -o a")));
    assert_says(&ran.failed(), &["kept"]);
    assert_eq!(place.names(), ["kept"]);
}

/// What a checkpoint cannot be written to is refused before the work.
fn a_place_without_checkpoints(path: &str, words: &[&str]) {
    let place = Place::default();
    let options = "--backend cpu --size 24x18 --bands 4 --samples 1 -o a.exr";
    let ran = place.run(&render(&format!("{options} --checkpoint {path}")));
    assert_eq!(ran.code, 1);
    assert_says(&ran.failed(), words);
    assert!(place.names().is_empty(), "{:?}", place.names());
}

cases! { a_place_without_checkpoints:
    a_checkpoint_in_a_missing_folder("no/such/kept", &["no/such"]);
    a_checkpoint_in_the_place_of_an_output("a.exr", &["a.exr"]);
    a_checkpoint_in_the_place_of_an_output_by_another_path("./a.exr", &["a.exr"]);
    a_checkpoint_on_standard_output("-", &["-"]);
}

/// A finished checkpoint goes on to more samples, with the bytes of a render of that many.
fn a_finished_render_goes_on(backend: &str) {
    let place = Place::default();
    let settings = format!("--backend {backend} --size 24x18 --bands 4");
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("--samples 6 --checkpoint kept -o a.exr");
    let again = run("--samples 21 --checkpoint kept --resume -o a.exr");
    assert_says(
        &again.stderr,
        &["going on from kept at 6 samples per pixel"],
    );
    let _ = run("--samples 21 -o whole.exr");
    assert!(
        exr(&place, "a.exr")
            .0
            .samples()
            .iter()
            .all(|&samples| samples == 21)
    );
    assert!(
        bytes(&place, "a.exr") == bytes(&place, "whole.exr"),
        "other bytes"
    );
    // One that needs no more is written once more.
    let _ = run("--samples 21 --checkpoint kept --resume -o b.exr");
    assert!(
        bytes(&place, "b.exr") == bytes(&place, "whole.exr"),
        "other bytes"
    );
}

cases! { a_finished_render_goes_on:
    a_finished_render_goes_on_on_the_cpu("cpu");
    a_finished_render_goes_on_on_the_gpu("gpu");
}

/// A finished picture of more samples than are asked for stays what it is.
#[test]
fn a_checkpoint_keeps_its_samples() {
    let place = place();
    let _ = place
        .run(&render(
            &format!("{KEPT} --resume --samples 3 -o a.exr").replace("--samples 8 ", ""),
        ))
        .succeeded();
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!(image.samples()[0], 8);
    assert_eq!(metadata.settings["samples"], "8");
}

/// An adaptive render goes on with the plan of its pilot.
#[test]
fn an_adaptive_render_goes_on_with_the_same_bytes() {
    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 4 --samples 32 --adaptive";
    let run = |options: &str| {
        place
            .run(&render(&format!("{settings} {options}")))
            .succeeded()
    };
    let _ = run("-o whole.exr");
    let _ = run("--checkpoint kept -o a.exr");
    let _ = run("--checkpoint kept --resume -o b.exr");
    let whole = bytes(&place, "whole.exr");
    assert!(bytes(&place, "a.exr") == whole, "other bytes");
    assert!(bytes(&place, "b.exr") == whole, "other bytes");
}
