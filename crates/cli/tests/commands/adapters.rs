//! Tests of the choice of a renderer: a GPU, a software driver or the CPU.

use crate::assert_says;
use crate::place::Place;
use crate::render::{SMALL, bytes, exr, png, render};
use crate::render_refusals::refused;
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::tolerances::FRAMES;

/// The GPU and the CPU give nearly the same files with these options.
fn renderers_agree(options: &str) {
    let place = Place::default();
    for backend in ["gpu", "cpu"] {
        let options = format!("{options} --backend {backend} -o {backend}");
        let _ = place.run(&render(&options)).succeeded();
    }
    let (gpu, cpu) = (exr(&place, "gpu.exr").0, exr(&place, "cpu.exr").0);
    if let Err(report) = same_numbers(Values::of(&gpu), Values::of(&cpu), &FRAMES) {
        panic!("{report}");
    }
    let (gpu, cpu) = (png(&place, "gpu.png"), png(&place, "cpu.png"));
    let codes = gpu.as_raw().iter().zip(cpu.as_raw());
    let apart = codes.filter(|(a, b)| a.abs_diff(**b) > 1).count();
    // Two codes or more are 1 % of light: an outlier. There may be as many as in the spectra.
    let allowed = FRAMES.outlier_fraction * cpu.as_raw().len() as f64;
    assert!(
        apart as f64 <= allowed,
        "{apart} codes differ by more than one"
    );
    assert!(
        cpu.as_raw().iter().any(|&code| code > 50),
        "a black picture"
    );
}

// Numbers of bands that fill groups of four and some that do not, and pictures of one pixel, one row or one column.
cases! { renderers_agree:
    renderers_agree_on_a_small_picture(SMALL);
    renderers_agree_on_one_band("--size 24x24 --samples 4 --bands 1");
    renderers_agree_on_three_bands("--size 24x24 --samples 4 --bands 3");
    renderers_agree_on_256_bands("--size 24x24 --samples 1 --bands 256");
    renderers_agree_on_one_column("--size 1x700 --samples 4 --bands 5");
    renderers_agree_on_one_row("--size 700x1 --samples 4 --bands 4");
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
    assert_says(&stderr, &["`apt-get install mesa-vulkan-drivers`"]);
    assert_eq!(stderr.matches("no Vulkan").count(), 1, "{stderr}");
    assert!(place.names().is_empty());

    let listed = place.run_without_driver("devices").succeeded().stdout;
    assert_says(&listed, &["renders run on the CPU", "mesa-vulkan-drivers"]);
}

#[test]
fn an_adapter_is_chosen_by_a_part_of_its_name() {
    let place = Place::default();
    let adapters = gpu::adapters();
    let name = &adapters[0].info.name;

    let listed = place.run("devices").succeeded().stdout;
    assert_says(&listed, &[name, "[default]", "MiB"]);

    let stderr = place.run(&render("--adapter nosuch")).failed();
    for adapter in &adapters {
        assert_says(&stderr, &["nosuch", &adapter.info.name]);
    }
    let part = name.split_whitespace().next().unwrap().to_uppercase();
    let ran = place.run(&render(&format!("{SMALL} --adapter {part} -o a.png")));
    assert_says(&ran.succeeded().stderr, &[name]);
    assert_eq!(place.names(), ["a.png"]);

    refused("--backend cpu --adapter x", &["--adapter", "--backend cpu"]);
}
