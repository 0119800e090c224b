//! Tests of `pellicle render --frames` and `--scene-time`.

use crate::assert_says;
use crate::place::Place;
use crate::render::exr;
use crate::render_refusals::refused;

/// A film that grows thicker with time, one frame per second.
const GROWING: &str = "
render = { size = [16, 12], samples = 2, bands = 6, time_s = 10, time_step_s = 5 }
camera = { type = 'perspective', position = [0, 0, 3], look_at = [0, 0, 0], fov_deg = 30 }
environment = { type = 'constant', emission = { constant = 1 } }
[materials.film]
type = 'film'
index = 1.33
thickness_nm = { drainage = { initial = 900, radius_m = 0.01, viscosity_pa_s = 1e-7 } }
[[objects]]
type = 'sphere'
material = 'film'
center = [0, 0, 0]
radius = 0.5
";

#[test]
fn a_sequence_has_a_numbered_file_for_each_frame_at_its_time() {
    let place = Place::default();
    std::fs::write(place.path("film.toml"), GROWING).unwrap();
    let ran = place
        .run("render film.toml --backend cpu --frames 2:4 -o a.exr")
        .succeeded();
    assert_eq!(place.names(), ["a_0002.exr", "a_0003.exr", "film.toml"]);
    assert_says(
        &ran.stderr,
        &["frame 2 of 2 to 3 at 20 s", "wrote a_0003.exr"],
    );
    let _ = place
        .run("render film.toml --backend cpu --scene-time 25 -o still.exr")
        .succeeded();
    let (third, metadata) = exr(&place, "a_0003.exr");
    assert_eq!(metadata.settings["time_s"], "25");
    assert_eq!(third, exr(&place, "still.exr").0);
    assert_ne!(third, exr(&place, "a_0002.exr").0);
}

#[test]
fn a_sequence_of_a_scene_without_motion_is_reported() {
    let place = Place::default();
    let drainage = "{ drainage = { initial = 900, radius_m = 0.01, viscosity_pa_s = 1e-7 } }";
    assert!(GROWING.contains(drainage));
    std::fs::write(place.path("film.toml"), GROWING).unwrap();
    std::fs::write(place.path("still.toml"), GROWING.replace(drainage, "400")).unwrap();
    let said = |arguments: &str| {
        let arguments = format!("render {arguments} --backend cpu -o a.exr");
        place.run(&arguments).succeeded().stderr
    };
    let note = "are the same picture";
    assert!(said("still.toml --frames 0:2").contains(note));
    assert!(!said("film.toml --frames 0:2").contains(note));
    assert!(!said("still.toml --frames 0:1").contains(note));
}

cases! { refused:
    a_range_of_frames_has_two_ends("--frames 4", &["write frames as in 0:48"]);
    a_range_of_frames_is_not_empty("--frames 4:4", &["must be larger than the first"]);
    a_frame_is_not_negative("--frames -1:4", &["write frames as in 0:48"]);
    a_time_is_not_negative("--scene-time -3", &["render.time_s", "found -3", "set outside the file"]);
}

#[test]
fn a_sequence_with_an_impossible_frame_is_refused_before_it_begins() {
    let place = Place::default();
    let text = GROWING.replace("time_step_s = 5", "time_step_s = 1e9");
    std::fs::write(place.path("film.toml"), text).unwrap();
    let ran = place.run("render film.toml --backend cpu --frames 0:3");
    let words = ["frame 2 cannot be rendered", "render.time_s"];
    assert_says(&ran.failed(), &words);
    assert_eq!(place.names(), ["film.toml"]);
}
