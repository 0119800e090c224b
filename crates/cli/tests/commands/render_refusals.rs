//! Tests of what `pellicle render` refuses before it renders.

use crate::place::Place;
use crate::render::{SMALL, bytes, render};
use crate::{assert_says, scene};

/// `render` fails for the soap bubble with all of `words`, and leaves no file.
pub(crate) fn refused(arguments: &str, words: &[&str]) {
    let place = Place::default();
    assert_says(&place.run(&render(arguments)).failed(), words);
    assert!(place.names().is_empty(), "{:?}", place.names());
}

cases! { refused:
    an_empty_picture("--size 0x0", &["render.size[0]", "render.size[1]", "from 1"]);
    a_picture_that_is_too_large("--size 99999x99999", &["render.size", "99999", "32768"]);
    an_image_larger_than_memory("--size 32768x32768 --bands 1024 --max-memory 4GB", &["GB", "4.0 GB can be used", "--part"]);
    a_size_of_one_number("--size 4", &["--size", "640x480"]);
    no_samples("--samples 0", &["render.samples", "from 1"]);
    too_many_samples("--samples 4294967296", &["--samples"]);
    no_bands("--bands 0", &["render.bands", "from 1"]);
    too_many_bands("--bands 5000", &["render.bands", "5000", "1024"]);
    a_seed_that_is_no_number("--seed x", &["--seed"]);
    an_unknown_backend("--backend tpu", &["--backend", "cpu"]);
}

/// Settings with which a test would take very long if it rendered.
const LARGE: &str = "--size 4000x4000 --samples 100000 --backend cpu";

fn refused_output(output: &str, words: &[&str]) {
    refused(&format!("{LARGE} -o {output}"), words);
}

cases! { refused_output:
    an_output_of_an_unknown_type("x.jpg", &["x.jpg", ".png", ".exr"]);
    an_output_in_a_missing_folder("no/such/x.png", &["there is no folder no/such"]);
    a_missing_folder_as_output("nosuch/", &["there is no folder nosuch"]);
}

#[cfg(target_os = "linux")]
cases! { refused_output:
    an_output_that_cannot_be_created("/proc/x.png", &["/proc/x.png", "cannot be written to"]);
}

#[test]
fn an_output_that_is_a_folder() {
    let place = Place::default();
    std::fs::create_dir(place.path("soap_bubble.png")).unwrap();
    let stderr = place.run(&render(LARGE)).failed();
    assert_says(&stderr, &["soap_bubble.png", "folder"]);
    assert_eq!(place.names(), ["soap_bubble.png"]);
}

/// A scene file is not overwritten, whatever the output is called.
fn kept(arguments: &str) {
    let place = Place::default();
    std::fs::copy(scene("furnace.toml"), place.path("scene.png")).unwrap();
    let before = bytes(&place, "scene.png");
    let ran = place.run(&format!("render scene.png {SMALL} {arguments}"));
    assert_says(&ran.failed(), &["overwrite the file that is read"]);
    assert_eq!(place.names(), ["scene.png"]);
    assert_eq!(bytes(&place, "scene.png"), before);
}

cases! { kept:
    the_scene_file_as_the_default_output("");
    the_scene_file_as_an_output_without_an_ending("-o scene");
    the_scene_file_as_an_output_by_another_path("-o ./scene.png");
}
