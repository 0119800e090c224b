//! Faults of a device in the midst of a render.

use crate::place::{Place, Ran};
use crate::render::{bytes, exr};
use crate::{assert_says, scene};
use std::sync::OnceLock;

/// A picture of seven rounds: to 4, 8, 16, 32, 64, 128 and 256 samples.
const SETTINGS: &str = "--backend gpu --size 24x18 --bands 4 --samples 256";
/// More faults in one round than are forgiven.
const TOO_MANY: &str = "--inject-fault lost@3 --inject-fault refused@3 --inject-fault lost@3 \
                        --inject-fault out-of-memory@3 --inject-fault lost@3";

fn run(place: &Place, options: &str) -> Ran {
    let wedge = scene("film_wedge.toml");
    place.run(&format!("render {wedge} {SETTINGS} {options}"))
}

/// The bytes of the picture without faults.
fn whole() -> &'static [u8] {
    static WHOLE: OnceLock<Vec<u8>> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let place = Place::default();
        let _ = run(&place, "-o a.exr").succeeded();
        bytes(&place, "a.exr")
    })
}

/// The picture has the same bytes with a fault as without, and the fault is reported.
fn a_fault_changes_nothing(fault: &str) {
    let place = Place::default();
    let ran = run(&place, &format!("--inject-fault {fault} -o a.exr")).succeeded();
    assert_says(&ran.stderr, &["warning", "the device was opened again"]);
    assert!(bytes(&place, "a.exr") == whole(), "other bytes");
    assert_eq!(place.names(), ["a.exr"]);
}

cases! { a_fault_changes_nothing:
    a_device_is_lost_in_the_first_round("lost@1");
    a_device_is_lost_in_the_second_round("lost@2");
    a_device_is_lost_in_the_last_round("lost@7");
    memory_runs_out_in_the_first_round("out-of-memory@1");
    memory_runs_out_in_the_second_round("out-of-memory@2");
    memory_runs_out_in_the_last_round("out-of-memory@7");
    a_call_is_refused_in_the_first_round("refused@1");
    a_call_is_refused_in_the_second_round("refused@2");
    a_call_is_refused_in_the_last_round("refused@7");
}

#[test]
fn a_device_that_fails_for_good_leaves_what_was_done() {
    let place = Place::default();
    let ran = run(&place, &format!("{TOO_MANY} --checkpoint kept -o a"));
    assert_eq!(ran.code, 1);
    let stderr = ran.failed();
    // An error begins with a cross, and the size of a picture has one between its sides.
    assert_eq!(stderr.matches("  × ").count(), 1, "{stderr}");
    assert_eq!(place.names(), ["a.exr", "a.png", "kept"]);
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!(image.samples()[0], 8);
    assert_eq!(metadata.settings["samples"], "8");
    // The checkpoint is one to go on from.
    let _ = run(&place, "--checkpoint kept --resume -o b.exr").succeeded();
    assert!(bytes(&place, "b.exr") == whole(), "other bytes");
}

#[test]
fn a_device_that_fails_for_good_at_once_leaves_nothing() {
    let place = Place::default();
    let ran = run(&place, &format!("{} -o a", TOO_MANY.replace("@3", "@1")));
    assert_eq!(ran.code, 1);
    let _ = ran.failed();
    assert!(place.names().is_empty(), "{:?}", place.names());
}

#[test]
fn the_cpu_goes_on_if_it_may() {
    let place = Place::default();
    let ran = run(&place, &format!("{TOO_MANY} --allow-cpu -o a.exr")).succeeded();
    assert_says(&ran.stderr, &["the CPU goes on"]);
    let (image, metadata) = exr(&place, "a.exr");
    assert!(image.samples().iter().all(|&samples| samples == 256));
    let renderer = &metadata.settings["renderer"];
    assert!(renderer.ends_with(", then the CPU"), "{renderer}");
}

/// A picture that was continued still says which of its samples are not the GPU's.
#[test]
fn a_checkpoint_remembers_that_the_cpu_went_on() {
    let place = Place::default();
    let _ = run(
        &place,
        &format!("{TOO_MANY} --allow-cpu --checkpoint kept -o a.exr"),
    )
    .succeeded();
    let _ = run(&place, "--checkpoint kept --resume -o b.exr").succeeded();
    let renderer = exr(&place, "b.exr").1.settings["renderer"].clone();
    assert!(renderer.contains("CPU"), "{renderer}");
}
