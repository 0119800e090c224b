//! End-to-end tests of the command, and tests of the library's examples.

use color::spectral_exr::{Metadata, read};
use pellicle_tests::command::{Place, Ran, program};
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::tolerances::FRAMES;
use pellicle_tests::wgsl::root;
use spectra::SpectralImage;
use std::path::Path;
use std::process::{Command, Stdio};

/// Settings of a picture small enough to be rendered often.
const SMALL: &str = "--size 32x24 --samples 2 --bands 6";

fn scene(name: &str) -> String {
    let path = root().join("scenes").join(name);
    path.to_str().unwrap().to_owned()
}

/// The command `render` for the soap bubble, with further arguments.
fn render(arguments: &str) -> String {
    format!("render {} {arguments}", scene("soap_bubble.toml"))
}

fn bytes(place: &Place, name: &str) -> Vec<u8> {
    std::fs::read(place.path(name)).unwrap()
}

fn exr(place: &Place, name: &str) -> (SpectralImage, Metadata) {
    read(&place.path(name)).unwrap()
}

fn png(place: &Place, name: &str) -> image::RgbImage {
    image::open(place.path(name)).unwrap().into_rgb8()
}

/// Runs `render` for the soap bubble and checks that it fails with all of `said` and leaves no file.
fn refused(arguments: &str, said: &[&str]) {
    let place = Place::default();
    assert_says(&place.run(&render(arguments)).failed(), said, arguments);
    assert!(place.names().is_empty(), "{arguments}: {:?}", place.names());
}

fn assert_says(stderr: &str, said: &[&str], case: &str) {
    for words in said {
        assert!(
            stderr.contains(words),
            "{case}: {words:?} is not in\n{stderr}"
        );
    }
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
        "",
    );
}

#[test]
fn the_output_option_chooses_what_is_written() {
    for (asked, expected) in [
        ("-o a.png", vec!["a.png"]),
        ("-o a.exr", vec!["a.exr"]),
        ("-o A.PNG", vec!["A.PNG"]),
        ("-o a", vec!["a.exr", "a.png"]),
        ("-o a.png -o b.exr", vec!["a.png", "b.exr"]),
        ("-o .", vec!["soap_bubble.exr", "soap_bubble.png"]),
        ("-o ./", vec!["soap_bubble.exr", "soap_bubble.png"]),
    ] {
        let place = Place::default();
        let _ = place
            .run(&render(&format!("{SMALL} --backend cpu {asked}")))
            .succeeded();
        assert_eq!(place.names(), expected, "{asked}");
    }
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

#[test]
fn equal_seeds_give_equal_bits_and_other_seeds_do_not() {
    for backend in ["gpu", "cpu"] {
        let place = Place::default();
        for (name, seed) in [("a", 1), ("b", 1), ("c", 2)] {
            let options = format!("{SMALL} --backend {backend} --seed {seed} -o {name}");
            let _ = place.run(&render(&options)).succeeded();
        }
        let picture = |name| bytes(&place, &format!("{name}.png"));
        assert!(picture("a") == picture("b"), "{backend}: the PNGs differ");
        assert!(picture("a") != picture("c"), "{backend}: the same PNG");
        let spectral = |name| bytes(&place, &format!("{name}.exr"));
        assert!(spectral("a") == spectral("b"), "{backend}: the EXRs differ");
        let radiance = |name| exr(&place, &format!("{name}.exr")).0.radiance().to_vec();
        assert!(radiance("a") != radiance("c"), "{backend}: the same EXR");
    }
}

#[test]
fn gpu_and_cpu_give_nearly_the_same_files() {
    let place = Place::default();
    // Numbers of bands that fill groups of four and some that do not, and pictures of one pixel, one row or one column.
    for options in [
        SMALL,
        "--size 24x24 --samples 4 --bands 1",
        "--size 24x24 --samples 4 --bands 3",
        "--size 24x24 --samples 1 --bands 256",
        "--size 1x700 --samples 4 --bands 5",
        "--size 700x1 --samples 4 --bands 4",
    ] {
        for backend in ["gpu", "cpu"] {
            let options = format!("{options} --backend {backend} -o {backend}");
            let _ = place.run(&render(&options)).succeeded();
        }
        let (gpu, cpu) = (exr(&place, "gpu.exr").0, exr(&place, "cpu.exr").0);
        if let Err(report) = same_numbers(Values::of(&gpu), Values::of(&cpu), &FRAMES) {
            panic!("{options}: {report}");
        }
        let (gpu, cpu) = (png(&place, "gpu.png"), png(&place, "cpu.png"));
        let codes = gpu.as_raw().iter().zip(cpu.as_raw());
        let apart = codes.filter(|(a, b)| a.abs_diff(**b) > 1).count();
        // Two codes or more are 1 % of light: an outlier. There may be as many as in the spectra.
        let allowed = FRAMES.outlier_fraction * cpu.as_raw().len() as f64;
        assert!(
            apart as f64 <= allowed,
            "{options}: {apart} codes differ by more than one"
        );
        assert!(
            cpu.as_raw().iter().any(|&code| code > 50),
            "a black picture"
        );
    }
}

#[test]
fn without_a_driver_auto_renders_on_the_cpu_and_says_so() {
    let place = Place::default();
    let ran = place
        .run_without_driver(&render(&format!("{SMALL} -o auto")))
        .succeeded();
    let notes: Vec<_> = ran
        .stderr
        .lines()
        .filter(|line| line.contains("GPU"))
        .collect();
    assert_eq!(notes, ["rendering on the CPU: there is no GPU"]);

    let _ = place
        .run(&render(&format!("{SMALL} --backend cpu -o cpu")))
        .succeeded();
    assert!(exr(&place, "auto.exr") == exr(&place, "cpu.exr"));
    assert!(bytes(&place, "auto.png") == bytes(&place, "cpu.png"));
}

/// The CPU is faster than a software driver, and starts at once.
#[test]
fn auto_uses_a_gpu_but_not_a_software_driver() {
    let place = Place::default();
    let ran = place.run(&render(&format!("{SMALL} -o auto"))).succeeded();
    let adapter = &gpu::adapters()[0];
    if adapter.to_string().contains("(software") {
        let reason = "rendering on the CPU: there is no GPU, only the software driver";
        let name = &adapter.info.name;
        assert!(
            ran.stderr.contains(&format!("{reason} {name}\n")),
            "{}",
            ran.stderr
        );
    } else {
        assert!(ran.stderr.contains(&adapter.to_string()), "{}", ran.stderr);
    }
}

#[test]
fn without_a_driver_gpu_fails_with_the_command_that_installs_one() {
    let place = Place::default();
    let ran = place.run_without_driver(&render(&format!("{SMALL} --backend gpu")));
    let stderr = ran.failed();
    assert_says(
        &stderr,
        &["`apt-get install mesa-vulkan-drivers`"],
        "no driver",
    );
    assert_eq!(stderr.matches("no Vulkan").count(), 1, "{stderr}");
    assert!(place.names().is_empty());

    let listed = place.run_without_driver("devices").succeeded().stdout;
    assert_says(
        &listed,
        &["renders run on the CPU", "mesa-vulkan-drivers"],
        "devices",
    );
}

#[test]
fn an_adapter_is_chosen_by_a_part_of_its_name() {
    let place = Place::default();
    let adapters = gpu::adapters();
    let name = &adapters[0].info.name;

    let listed = place.run("devices").succeeded().stdout;
    assert_says(&listed, &[name, "[default]", "MiB"], "devices");

    let stderr = place.run(&render("--adapter nosuch")).failed();
    for adapter in &adapters {
        assert_says(&stderr, &["nosuch", &adapter.info.name], "nosuch");
    }
    let part = name.split_whitespace().next().unwrap().to_uppercase();
    let ran = place.run(&render(&format!("{SMALL} --adapter {part} -o a.png")));
    assert_says(&ran.succeeded().stderr, &[name], "a part");
    assert_eq!(place.names(), ["a.png"]);

    refused("--backend cpu --adapter x", &["--adapter", "--backend cpu"]);
}

#[test]
fn check_summarizes_a_scene() {
    let place = Place::default();
    let ran = place.run(&format!("check {}", scene("film_wedge.toml")));
    let said = ran.succeeded();
    assert_says(
        &said.stdout,
        &["film_wedge.toml: valid", "bands", "lit by its environment;"],
        "check",
    );
    assert!(said.stderr.is_empty(), "{}", said.stderr);
    let dark = place.path("dark.toml");
    let camera =
        "camera = { type = 'orthographic', position = [0, 0, 5], look_at = [0, 0, 0], height = 2 }";
    std::fs::write(&dark, camera).unwrap();
    let said = place.run(&format!("check {}", dark.display())).succeeded();
    assert_says(&said.stdout, &["0 objects, no light;"], "check");
    assert_says(&said.stderr, &["note: nothing emits light"], "check");
    std::fs::remove_file(&dark).unwrap();
    assert!(place.names().is_empty());
}

#[test]
fn the_printed_schema_is_the_shipped_one() {
    let printed = Place::default().run("schema").succeeded().stdout;
    let shipped = std::fs::read_to_string(scene("scene.schema.json")).unwrap();
    let parse = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    assert_eq!(parse(&printed), parse(&shipped));
}

#[test]
fn without_a_terminal_there_is_no_progress_bar() {
    let place = Place::default();
    let ran = place.run(&render(&format!("{SMALL} --backend cpu")));
    let said = ran.succeeded().stderr;
    for sign in ['\r', '\u{1b}', '█', '░', '%'] {
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

#[test]
fn files_that_are_not_scenes_are_refused() {
    let place = Place::default();
    std::fs::write(place.path("empty.toml"), "").unwrap();
    std::fs::write(place.path("binary.toml"), [0x89, b'P', 0, 0xff, 0xfe]).unwrap();
    std::fs::create_dir(place.path("folder")).unwrap();
    let before = place.names();
    for (name, said) in [
        ("missing.toml", "cannot be opened"),
        ("folder", "is a directory"),
        ("empty.toml", "the file is empty"),
        ("binary.toml", "is not text"),
    ] {
        for subcommand in ["render", "check"] {
            let stderr = place.run(&format!("{subcommand} {name}")).failed();
            assert_says(&stderr, &[name, said], name);
        }
    }
    assert_eq!(place.names(), before);
}

#[test]
fn all_mistakes_of_a_scene_are_reported_with_their_lines() {
    let place = Place::default();
    let text = "[camera]\ntype = \"perspective\"\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_deg = 200\n\n\
        [render]\nsampels = 4\n\n[[objects]]\ntype = \"sphere\"\nmaterial = \"gold\"\ncenter = [0, 0, 0]\nradius = -1\n";
    std::fs::write(place.path("bad.toml"), text).unwrap();
    let stderr = place.run("render bad.toml").failed();
    let mistakes = [
        ("bad.toml:5:11", "fov_deg = 200"),
        ("bad.toml:8:1", "sampels = 4"),
        ("bad.toml:12:12", "material = \"gold\""),
        ("bad.toml:14:10", "radius = -1"),
    ];
    for (at, line) in mistakes {
        assert_says(&stderr, &[at, line], "bad.toml");
    }
    assert_says(&stderr, &["4 problems", "samples"], "bad.toml");
    assert_eq!(place.names(), ["bad.toml"]);
}

#[test]
fn impossible_settings_are_refused() {
    refused(
        "--size 0x0",
        &["render.size[0]", "render.size[1]", "from 1"],
    );
    refused("--size 99999x99999", &["render.size", "99999", "32768"]);
    refused("--size 32768x32768 --bands 1024", &["GiB"]);
    refused("--size 4", &["--size", "640x480"]);
    refused("--samples 0", &["render.samples", "from 1"]);
    refused("--samples 4294967296", &["--samples"]);
    refused("--bands 0", &["render.bands", "from 1"]);
    refused("--bands 5000", &["render.bands", "5000", "1024"]);
    refused("--seed x", &["--seed"]);
    refused("--backend tpu", &["--backend", "cpu"]);
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_the_render() {
    // So large that the test would take very long if it were rendered.
    let large = "--size 4000x4000 --samples 100000 --backend cpu";
    let refused = |output: &str, said: &[&str]| refused(&format!("{large} -o {output}"), said);
    refused("x.jpg", &["x.jpg", ".png", ".exr"]);
    refused("no/such/x.png", &["there is no folder no/such"]);
    refused("nosuch/", &["there is no folder nosuch"]);
    #[cfg(target_os = "linux")]
    refused("/proc/x.png", &["/proc/x.png", "cannot be written to"]);

    let place = Place::default();
    std::fs::create_dir(place.path("soap_bubble.png")).unwrap();
    let stderr = place.run(&render(large)).failed();
    assert_says(&stderr, &["soap_bubble.png", "folder"], "a folder");
    assert_eq!(place.names(), ["soap_bubble.png"]);
}

#[test]
fn the_scene_file_is_not_overwritten() {
    let place = Place::default();
    std::fs::copy(scene("furnace.toml"), place.path("scene.png")).unwrap();
    let before = bytes(&place, "scene.png");
    for arguments in ["", "-o scene", "-o ./scene.png"] {
        let stderr = place
            .run(&format!("render scene.png {SMALL} {arguments}"))
            .failed();
        assert_says(&stderr, &["overwrite the file that is read"], arguments);
    }
    assert_eq!(place.names(), ["scene.png"]);
    assert_eq!(bytes(&place, "scene.png"), before);
}

/// Runs an example of the library.
fn example(name: &str, arguments: &[&Path]) -> String {
    let output = Command::new(program(name)).args(arguments).output();
    Ran::of(&output.unwrap()).succeeded().stdout
}

#[test]
fn the_examples_run() {
    let place = Place::default();
    let folder = place.path("");
    let wedge = scene("film_wedge.toml");
    example("render_scene_file", &[wedge.as_ref(), &folder]);
    example("build_a_scene", &[&folder]);
    assert_eq!(
        place.names(),
        [
            "build_a_scene.png",
            "render_scene_file.exr",
            "render_scene_file.png"
        ]
    );
    // Eight films of different thickness have different colors.
    let picture = png(&place, "build_a_scene.png");
    let colors: std::collections::BTreeSet<_> =
        (0..8).map(|i| picture.get_pixel(8 * i + 4, 4).0).collect();
    assert_eq!(colors.len(), 8, "{colors:?}");
    assert!(!colors.contains(&[0; 3]), "{colors:?}");

    let exr_path = place.path("render_scene_file.exr");
    let (image, _) = read(&exr_path).unwrap();
    let said = example("read_a_pixel", &[&exr_path, "3".as_ref(), "2".as_ref()]);
    assert_says(&said, &["pixel (3, 2), 4 samples", "XYZ"], "read_a_pixel");
    for &radiance in image.pixel(3, 2) {
        assert_says(&said, &[&format!("{radiance:.5e}")], "read_a_pixel");
    }
    let said = example("read_a_pixel", &[]);
    assert_says(&said, &["pixel (16, 4)", "XYZ"], "read_a_pixel");
}

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
        "",
    );
    let _ = place
        .run("render film.toml --backend cpu --time 25 -o still.exr")
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

#[test]
fn impossible_sequences_are_refused_before_they_begin() {
    for (frames, said) in [
        ("--frames 4", "write frames as in 0:48"),
        ("--frames 4:4", "must be larger than the first"),
        ("--frames -1:4", "write frames as in 0:48"),
    ] {
        refused(frames, &[said]);
    }
    refused(
        "--time -3",
        &["render.time_s", "found -3", "set outside the file"],
    );
    let place = Place::default();
    std::fs::write(
        place.path("film.toml"),
        GROWING.replace("time_step_s = 5", "time_step_s = 1e9"),
    )
    .unwrap();
    let failed = place
        .run("render film.toml --backend cpu --frames 0:3")
        .failed();
    assert_says(
        &failed,
        &["frame 2 cannot be rendered", "render.time_s"],
        "",
    );
    assert_eq!(place.names(), ["film.toml"]);
}
