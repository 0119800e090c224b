//! Tests of files that come from standard input.

use crate::assert_says;
use crate::place::Place;

const SCENE: &str = "camera = { type = \"orthographic\", position = [0, 0, 2], look_at = [0, 0, 0], height = 1 }\n\
    environment = { type = \"constant\", emission = { csv = \"lamp.csv\" } }\n\
    render = { size = [4, 4], samples = 1, bands = 4 }\n";

const LAMP: &str = "wavelength_nm,power\n300,1\n900,1\n";

const DISPLAY: &str = "white = [0.3127, 0.3290]\n[primaries]\nred = [0.64, 0.33]\ngreen = [0.30, 0.60]\nblue = [0.15, 0.06]\n\
    [response]\ncurve = \"linear\"\n";

/// The command prints `words` for a file on standard input, next to `lamp.csv`.
fn accepted(arguments: &str, input: &str, words: &str) {
    let place = Place::default();
    std::fs::write(place.path("lamp.csv"), LAMP).unwrap();
    let ran = place.run_with_input(arguments, input.as_bytes());
    assert_says(&ran.succeeded().stdout, &[words]);
}

cases! { accepted:
    a_scene("check -", SCENE, "<standard input>: valid; 4×4 pixels");
    a_stack("film - --wavelengths 500", "incident = 1\nsubstrate = 1.5\n", "0.040000");
    a_table("color - --emission", LAMP, "<standard input>: an emission");
    a_lamp("film 1|1.5 --illuminant -", LAMP, "under standard input");
    a_display("display -", DISPLAY, "0.640000");
}

#[test]
fn a_scene_to_render() {
    let place = Place::default();
    std::fs::write(place.path("lamp.csv"), LAMP).unwrap();
    let ran = place.run_with_input("render - --backend cpu", SCENE.as_bytes());
    let _ = ran.succeeded();
    assert_eq!(place.names(), ["lamp.csv", "render.exr", "render.png"]);
}

fn refused(arguments: &str, input: &str, words: &str) {
    let ran = Place::default().run_with_input(arguments, input.as_bytes());
    assert_says(&ran.failed(), &[words]);
}

cases! { refused:
    a_bad_scene("check -", "x = 1\n", "<standard input>:1:1");
    no_scene("check -", "", "the file is empty");
    a_bad_stack("film -", "substrat = 1\n", "<standard input>:1:1");
    a_bad_table("color -", "x\n", "<standard input>:");
    a_lamp_without_power(
        "film 1|1.5 --illuminant -",
        "380,0\n780,0\n",
        "<standard input>: a lamp must have power",
    );
    a_stack_and_a_lamp("film - --illuminant -", "380,1\n780,1\n", "can be read once");
    standard_input_as_a_device("check /dev/stdin", "x", "standard input is read as -");
    a_folder_as_scene("check .", "", "is a directory");
    a_folder_as_stack("film .", "", "is a directory");
    a_folder_as_table("color .", "", "is a directory");
}
