//! SIGINT and SIGTERM while a picture is rendered and written.

use crate::assert_says;
use crate::checkpoints::assert_is_whole;
use crate::place::{Place, Ran};
use crate::render::{bytes, exr, png, render};
use crate::running::{Random, Running, exists, temporary, tries};
use std::time::{Duration, Instant};

/// A picture that takes very long.
const LONG: &str = "--size 48x36 --bands 8 --samples 1000000";

/// The first signal ends a render with its round, and everything is written.
fn the_first_signal_keeps_everything(backend: &str, signal: &str, code: i32) {
    let place = Place::default();
    let options = "--checkpoint kept --checkpoint-every 20ms -o a";
    let mut running = Running::start(
        &place,
        &render(&format!("{LONG} --backend {backend} {options}")),
    );
    assert!(running.wait_for(|| exists(&place, "kept")));
    running.signal(signal);
    let ran = running.ran();
    assert_eq!(ran.code, code, "{}", ran.stderr);
    assert_says(
        &ran.stderr,
        &[
            "stopping after this round",
            "wrote a.exr",
            "wrote a.png",
            "--resume goes on from kept",
        ],
    );
    assert_eq!(place.names(), ["a.exr", "a.png", "kept"]);
    let (image, metadata) = exr(&place, "a.exr");
    assert_eq!(metadata.settings["stopped_by"], "signal");
    let samples = image.samples()[0];
    assert_eq!(metadata.settings["samples"], samples.to_string());
    assert!((1..1_000_000).contains(&samples), "{samples}");
    assert!(image.samples().iter().all(|&count| count == samples));
    assert_eq!(png(&place, "a.png").dimensions(), (48, 36));
}

cases! { the_first_signal_keeps_everything:
    sigint_keeps_everything_on_the_cpu("cpu", "INT", 130);
    sigterm_keeps_everything_on_the_cpu("cpu", "TERM", 143);
    sigint_keeps_everything_on_the_gpu("gpu", "INT", 130);
}

#[test]
fn without_a_checkpoint_other_samples_are_suggested() {
    let place = Place::default();
    let options = "--backend cpu --preview-every 20ms -o a.png -o a.exr";
    let mut running = Running::start(&place, &render(&format!("{LONG} {options}")));
    assert!(running.wait_for(|| exists(&place, "a.png")));
    running.signal("TERM");
    let ran = running.ran();
    assert_eq!(ran.code, 143);
    let samples = &exr(&place, "a.exr").1.settings["samples"];
    assert_says(
        &ran.stderr,
        &[&format!("--samples-from {samples} renders others")],
    );
}

#[test]
fn a_render_that_was_interrupted_thrice_has_the_same_bytes() {
    let place = Place::default();
    let settings = "--backend cpu --size 48x36 --bands 8 --samples 512";
    let _ = place
        .run(&render(&format!("{settings} -o whole.exr")))
        .succeeded();
    let again = render(&format!(
        "{settings} --checkpoint kept --checkpoint-every 20ms --resume -o a.exr"
    ));
    for _ in 0..3 {
        let mut running = Running::start(&place, &again);
        assert!(running.wait_for(|| !temporary(&place, "kept").is_empty()));
        running.signal("INT");
        let ran = running.ran();
        assert!(matches!(ran.code, 0 | 130), "{}", ran.stderr);
    }
    let _ = place.run(&again).succeeded();
    assert!(
        bytes(&place, "a.exr") == bytes(&place, "whole.exr"),
        "other bytes"
    );
}

/// A first round that lasts many seconds, on one core.
fn long_round(place: &Place) -> Running {
    let settings = "--backend cpu --size 2400x1800 --bands 4 --samples 4 -o a";
    let mut command = place.command(&render(settings));
    Running::of(command.env("RAYON_NUM_THREADS", "1"))
}

/// A second signal ends the program in the midst of a round.
fn a_second_signal_stops_at_once(first: &str, second: &str, code: i32) {
    let place = Place::default();
    let mut running = long_round(&place);
    std::thread::sleep(Duration::from_secs(1));
    running.signal(first);
    std::thread::sleep(Duration::from_millis(700));
    assert!(running.is_running(), "the round was too short");
    let started = Instant::now();
    running.signal(second);
    let ran = running.ran();
    let seconds = started.elapsed().as_secs_f64();
    assert_eq!(ran.code, code, "{}", ran.stderr);
    assert!(seconds < 1.5, "{seconds} s");
    assert!(place.names().is_empty(), "{:?}", place.names());
}

cases! { a_second_signal_stops_at_once:
    a_second_sigint_stops_at_once("INT", "INT", 130);
    a_sigterm_after_a_sigint_stops_at_once("INT", "TERM", 143);
}

/// A shell sends both when a terminal is closed, and some programs pass on what their children got already.
#[test]
fn two_signals_at_once_are_one() {
    let place = Place::default();
    let options = "--backend cpu --preview-every 20ms -o a.png -o a.exr";
    let mut running = Running::start(&place, &render(&format!("{LONG} {options}")));
    assert!(running.wait_for(|| exists(&place, "a.png")));
    running.signal("INT");
    running.signal("INT");
    let ran = running.ran();
    assert_eq!(ran.code, 130);
    assert_says(&ran.stderr, &["wrote a.exr"]);
}

/// A folder with files from before.
fn old_files() -> Place {
    let place = Place::default();
    for name in ["a.exr", "a.png"] {
        std::fs::write(place.path(name), "old").unwrap();
    }
    place
}

/// Each file is the old one or whole, and there is no other.
fn assert_none_is_half(place: &Place, ran: &Ran) {
    assert!(matches!(ran.code, 0 | 130), "{}", ran.stderr);
    assert_eq!(temporary(place, ""), Vec::<String>::new());
    let is_old = |name| bytes(place, name) == b"old";
    if !is_old("a.exr") {
        let _ = exr(place, "a.exr");
    }
    if !is_old("a.png") {
        let _ = png(place, "a.png");
    }
    if exists(place, "kept") {
        assert_is_whole(place, "kept");
    }
    if ran.code == 0 {
        assert!(!is_old("a.exr") && !is_old("a.png"));
    }
}

/// Any of the files that a render writes.
fn any_file(random: &mut Random) -> &'static str {
    ["kept", "a.exr", "a.png"][random.below(3) as usize]
}

#[test]
fn a_signal_while_files_are_written_leaves_none_of_them_half() {
    let mut random = Random(7);
    for number in 0..tries(10) {
        let place = old_files();
        let settings = "--backend cpu --size 96x72 --bands 16 --samples 1 -o a --checkpoint kept";
        let mut running = Running::start(&place, &render(settings));
        let target = any_file(&mut random);
        let delay = Duration::from_micros(random.below(2) * random.below(50_000));
        running.wait_for(|| !temporary(&place, target).is_empty());
        std::thread::sleep(delay);
        running.signal("INT");
        let ran = running.ran();
        println!("seed 7, try {number}: {target} and {delay:?}: {}", ran.code);
        assert_none_is_half(&place, &ran);
    }
}

/// The first signal comes in a round that lasts, and the second, more than half a second later, while something is written.
#[test]
fn a_second_signal_while_files_are_written_leaves_none_of_them_half() {
    let mut random = Random(5);
    for number in 0..tries(3) {
        let place = old_files();
        let settings = "--backend cpu --size 800x600 --bands 4 --samples 2 -o a --checkpoint kept";
        let mut command = place.command(&render(settings));
        let mut running = Running::of(command.env("RAYON_NUM_THREADS", "1"));
        let target = any_file(&mut random);
        let delay = Duration::from_micros(random.below(2) * random.below(20_000));
        std::thread::sleep(Duration::from_millis(150));
        running.signal("INT");
        running.wait_for(|| !temporary(&place, target).is_empty());
        std::thread::sleep(delay);
        running.signal("INT");
        let ran = running.ran();
        println!(
            "seed 5, try {number}: {target} and {delay:?}: {}, {:?}",
            ran.code,
            place.names()
        );
        assert_none_is_half(&place, &ran);
    }
}

/// Before anything is rendered a signal ends the program, with nothing written.
#[test]
fn a_signal_at_the_start_leaves_nothing() {
    let mut random = Random(3);
    for number in 0..tries(10) {
        let place = Place::default();
        let settings = "--backend cpu --size 16x12 --bands 4 --samples 1 -o a.exr";
        let mut running = Running::start(&place, &render(settings));
        let delay = Duration::from_micros(random.below(20_000));
        std::thread::sleep(delay);
        running.signal("TERM");
        let output = running.output();
        println!("seed 3, try {number}: {delay:?}: {}", output.status);
        // Without a code, it came before the program began to listen.
        if output.status.code().is_some() {
            assert!(matches!(Ran::of(&output).code, 0 | 143));
        }
        assert_eq!(temporary(&place, ""), Vec::<String>::new());
        if exists(&place, "a.exr") {
            let _ = exr(&place, "a.exr");
        } else {
            assert!(!output.status.success());
        }
    }
}
