//! Disks that are full, that become read-only or that lose a folder, before and while a picture is rendered.
//!
//! The disks are file systems in memory that only the command sees, in a mount namespace of its own: `unshare` makes one for any user
//! where the system lets users make namespaces, and for root in any case.

use crate::assert_says;
use crate::checkpoints::assert_is_whole;
use crate::place::{Place, Ran};
use crate::render::{bytes, png, render};
use crate::running::{Running, exists};
use std::fs::File;
use std::process::Command;

/// A picture whose spectral image takes some 350 kB, and whose checkpoint takes 860.
const SETTINGS: &str = "--backend cpu --size 48x36 --bands 8 --samples 4";
const FULL: &str = "No space left on device";

/// Runs `script` in a shell in which `$PELLICLE` is the command, `$RENDER` its arguments for a picture, and `disk` an empty disk. What is
/// then on the disk, hidden files too, is copied to `kept`.
fn on_disk(place: &Place, size: &str, script: &str) -> Ran {
    for folder in ["disk", "kept"] {
        std::fs::create_dir(place.path(folder)).unwrap();
    }
    let script = format!(
        "mount -t tmpfs -o size={size} none disk || exit 99\n{script}\nended=$?\ncp -a disk/. kept/ || exit 98\nexit $ended"
    );
    let mut command = Command::new("unshare");
    command
        .args(["--map-root-user", "--mount", "sh", "-c", &script])
        .current_dir(place.path(""))
        .env("PELLICLE", crate::place::PELLICLE)
        .env("RENDER", render(SETTINGS));
    let ran = Ran::of(&command.output().unwrap());
    assert!(
        ran.code != 99,
        "no disk could be mounted for this test: {}",
        ran.stderr
    );
    assert!(ran.code != 98, "{}", ran.stderr);
    ran
}

/// What is on the disk at the end.
fn kept(place: &Place) -> Vec<String> {
    let entries = std::fs::read_dir(place.path("kept")).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A failure with one error.
fn assert_fails_once(ran: &Ran, words: &[&str]) {
    assert_eq!(ran.code, 1, "{}", ran.stderr);
    assert_says(&ran.stderr, words);
    assert_eq!(ran.stderr.matches("  × ").count(), 1, "{}", ran.stderr);
}

/// A file that does not fit on a disk is not written, and the one of its name that was there stays.
fn a_full_disk(name: &str, size: &str) {
    let place = Place::default();
    let script = format!("printf old >disk/{name}; $PELLICLE $RENDER -o disk/{name}");
    let ran = on_disk(&place, size, &script);
    assert_fails_once(&ran, &[&format!("disk/{name}"), FULL]);
    assert_eq!(kept(&place), [name]);
    assert_eq!(
        std::fs::read(place.path("kept").join(name)).unwrap(),
        b"old"
    );
}

cases! { a_full_disk:
    a_spectral_image_on_a_full_disk("a.exr", "200k");
    a_picture_on_a_full_disk("a.png", "4k");
}

/// What fits is written, though something before it does not.
#[test]
fn a_picture_is_written_though_the_spectral_image_is_not() {
    let place = Place::default();
    let ran = on_disk(&place, "200k", "$PELLICLE $RENDER -o disk/a.exr -o a.png");
    assert_fails_once(&ran, &["disk/a.exr", FULL]);
    assert!(kept(&place).is_empty(), "{:?}", kept(&place));
    assert_eq!(png(&place, "a.png").dimensions(), (48, 36));
}

/// A checkpoint that does not fit is a warning while the picture is rendered, and an error at its end; the picture is written.
#[test]
fn a_checkpoint_on_a_full_disk() {
    let place = Place::default();
    let options = "--samples 256 --checkpoint disk/kept --checkpoint-every 10ms -o a";
    let settings = SETTINGS.replace("--samples 4", "");
    let script = format!("$PELLICLE {} {options}", render(&settings));
    let ran = on_disk(&place, "100k", &script);
    let goes_on = "warning: disk/kept: the checkpoint cannot be written";
    assert_fails_once(&ran, &[goes_on, "the render goes on", FULL, "wrote a.exr"]);
    assert!(kept(&place).is_empty(), "{:?}", kept(&place));
    assert_eq!(png(&place, "a.png").dimensions(), (48, 36));
    assert!(exists(&place, "a.exr"));
}

/// A disk on which one checkpoint fits, but no other beside it, keeps the one.
#[test]
fn a_disk_that_fills_up_keeps_the_last_checkpoint() {
    let place = Place::default();
    let settings = SETTINGS.replace("--samples 4", "");
    let render = render(&settings);
    let options = "--checkpoint disk/kept -o a.exr";
    let script = format!(
        "$PELLICLE $RENDER {options} &&
         $PELLICLE {render} --samples 256 --resume --checkpoint-every 10ms {options}"
    );
    let ran = on_disk(&place, "1200k", &script);
    assert_fails_once(&ran, &["warning: disk/kept", FULL]);
    assert_eq!(kept(&place), ["kept"]);
    assert_is_whole(&place, "kept/kept");
}

#[test]
fn standard_output_on_a_full_disk() {
    let place = Place::default();
    let mut command = place.command(&render(&format!("{SETTINGS} -o -")));
    let full = File::options().write(true).open("/dev/full").unwrap();
    let ran = Ran::of(&command.stdout(full).output().unwrap());
    assert_fails_once(&ran, &["- was not written", FULL]);
    assert!(place.names().is_empty());
}

#[test]
fn a_device_that_is_full() {
    let place = Place::default();
    let ran = place.run(&render(&format!("{SETTINGS} -o /dev/full")));
    assert_fails_once(&ran, &["/dev/full", FULL]);
}

/// A disk that cannot be written to is found before the picture is rendered.
#[test]
fn a_read_only_disk_is_refused_before_the_work() {
    let place = Place::default();
    let script = "printf old >disk/a.exr; mount -o remount,ro disk || exit 99\n\
                  $PELLICLE $RENDER --samples 16000000 -o disk/a.exr";
    let settings = SETTINGS.replace("--samples 4", "");
    let ran = on_disk(&place, "1m", &script.replace("$RENDER", &render(&settings)));
    assert_fails_once(
        &ran,
        &[
            "disk/a.exr",
            "cannot be written to",
            "Read-only file system",
        ],
    );
    assert_eq!(kept(&place), ["a.exr"]);
}

#[test]
fn a_read_only_disk_is_refused_for_checkpoints_before_the_work() {
    let place = Place::default();
    let script = "mount -o remount,ro disk || exit 99\n\
                  $PELLICLE $RENDER --checkpoint disk/kept -o a.exr";
    let ran = on_disk(&place, "1m", script);
    assert_fails_once(&ran, &["disk/kept", "Read-only file system"]);
    assert!(!exists(&place, "a.exr"), "the picture was rendered");
}

/// A disk that becomes read-only while a picture is rendered.
#[test]
fn a_disk_that_becomes_read_only() {
    let place = Place::default();
    let settings = SETTINGS.replace("--samples 4", "");
    let script = format!(
        "printf old >disk/a.exr
         $PELLICLE {} --time 2s --preview-every 10ms -o disk/a.exr -o a.png & id=$!
         until [ -e a.png ]; do sleep 0.02; done
         mount -o remount,ro disk || exit 99
         wait $id",
        render(&settings)
    );
    let ran = on_disk(&place, "4m", &script);
    assert_fails_once(&ran, &["disk/a.exr", "Read-only file system"]);
    assert_eq!(kept(&place), ["a.exr"]);
    assert_eq!(std::fs::read(place.path("kept/a.exr")).unwrap(), b"old");
}

/// A folder that is removed while a picture is rendered.
#[test]
fn a_folder_that_is_removed() {
    let place = Place::default();
    std::fs::create_dir(place.path("folder")).unwrap();
    let settings = SETTINGS.replace("--samples 4", "");
    let options = "--time 1s --preview-every 10ms -o a.png -o folder/a.exr";
    let mut running = Running::start(&place, &render(&format!("{settings} {options}")));
    assert!(running.wait_for(|| exists(&place, "a.png")));
    std::fs::remove_dir(place.path("folder")).unwrap();
    assert_fails_once(
        &running.ran(),
        &["folder/a.exr", "No such file or directory"],
    );
    assert_eq!(place.names(), ["a.png"]);
    assert!(!bytes(&place, "a.png").is_empty());
}

/// The folder of the checkpoint is removed: the picture is written all the same.
#[test]
fn a_folder_of_checkpoints_that_is_removed() {
    let place = Place::default();
    std::fs::create_dir(place.path("folder")).unwrap();
    let settings = SETTINGS.replace("--samples 4", "");
    let options = "--time 1s --checkpoint folder/kept --checkpoint-every 10ms -o a.exr";
    let mut running = Running::start(&place, &render(&format!("{settings} {options}")));
    assert!(running.wait_for(|| place.path("folder/kept").exists()));
    // A checkpoint may be begun while the folder is being removed.
    while std::fs::remove_dir_all(place.path("folder")).is_err() {}
    assert_fails_once(
        &running.ran(),
        &["folder/kept", "the render goes on", "wrote a.exr"],
    );
    assert_eq!(place.names(), ["a.exr"]);
}
