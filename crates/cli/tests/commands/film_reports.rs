//! Tests of the plots and charts of `pellicle film`, and of its search, tolerance and sensitivity.

use crate::assert_says;
use crate::film::{STEP, film};
use crate::place::Place;

#[test]
fn pictures_are_written_the_same_each_time() {
    let place = Place::default();
    let run = |name: &str| {
        let asked = format!("--angles 0,45 --plot {name}.svg --exposure 1");
        let _ = place.film("1 | 1.333 400nm | 1", &asked).succeeded();
        let asked = format!("--plot {name}.png --chart {name}_chart.png --vary 1:0:500");
        let ran = place.film("1 | 1.333 400nm | 1", &asked).succeeded();
        assert!(ran.stdout.is_empty(), "{}", ran.stdout);
        assert_says(
            &ran.stderr,
            &[
                &format!("wrote {name}.png"),
                &format!("wrote {name}_chart.png"),
            ],
        );
        ["svg", "png"].map(|ending| std::fs::read(place.path(&format!("{name}.{ending}"))).unwrap())
    };
    assert!(run("a") == run("b"));
    let chart = |name: &str| std::fs::read(place.path(name)).unwrap();
    assert!(chart("a_chart.png") == chart("b_chart.png"));
    let size = |name: &str| {
        image::open(place.path(name))
            .unwrap()
            .into_rgb8()
            .dimensions()
    };
    assert_eq!(size("a_chart.png"), (1800, 1040));
    assert_eq!(size("a.png").0, 1800);
    assert_eq!(
        place.names(),
        [
            "a.png",
            "a.svg",
            "a_chart.png",
            "b.png",
            "b.svg",
            "b_chart.png"
        ]
    );
}

/// The thickness with the wanted color comes first, and the printed color leads back to it.
#[test]
fn the_thickness_for_a_wanted_color_is_found() {
    let ran = film(STEP, "--match #4d6caf --vary 1:20:700").succeeded();
    let lines: Vec<&str> = ran
        .stdout
        .lines()
        .filter(|line| line.contains(" EV "))
        .collect();
    let cells = |line: &str| {
        line.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let best = cells(lines[0]);
    let (thickness_nm, delta_e): (f64, f64) = (best[1].parse().unwrap(), best[2].parse().unwrap());
    // Codes of eight bits leave an uncertainty of half a unit.
    assert!(
        (thickness_nm - 300.0).abs() < 1.0 && delta_e < 0.5,
        "{}",
        ran.stdout
    );
    assert_eq!(best.last().unwrap(), "#4d6caf");
    let next: f64 = cells(lines[1])[2].parse().unwrap();
    assert!(next > delta_e);
    let told_exposure = film(
        STEP,
        "--match #99ccff --vary 1:20:700 --match-by chromaticity",
    );
    assert!(told_exposure.succeeded().stdout.contains("EV"));
}

/// A layer below opaque gold cannot be seen.
#[test]
fn an_invisible_layer_is_reported() {
    let stack = "air | gold 500nm | silica 100nm | 1.5";
    let said = film(stack, "--match #2e6fd0 --vary 2:0:400").succeeded();
    assert_says(&said.stdout, &["does not depend on this layer"]);
    assert!(!said.stdout.contains(" EV"), "{}", said.stdout);
    let ends = film(STEP, "--match #000000 --vary 1:20:30").succeeded();
    assert_says(&ends.stdout, &["(end of the range)"]);
}

#[test]
fn tolerance_and_sensitivity_are_reported_per_layer() {
    let stack = "air | titania 60nm | silica 90nm | bk7";
    let asked = "--tolerance 2% --trials 500 --seed 3 --sensitivity --angles 0,50";
    let ran = film(stack, asked).succeeded();
    assert_says(
        &ran.stdout,
        &[
            "at 0°, thicknesses off by 2 %",
            "at 50°, thicknesses off by 2 %",
            "nominal",
            "95 %",
            "all layers",
            "1 titania 60 nm alone",
            "matters most",
            "ΔR at 550 nm",
        ],
    );
    assert_eq!(film(stack, asked).succeeded().stdout, ran.stdout);
    assert_ne!(
        film(stack, &asked.replace("seed 3", "seed 4"))
            .succeeded()
            .stdout,
        ran.stdout
    );
}
