//! End-to-end tests of `pellicle film`.

use pellicle::coating::{Angle, Stack};
use pellicle_tests::command::{Place, Ran, program};
use pellicle_tests::wgsl::root;
use serde_json::Value;
use std::collections::BTreeMap;
use std::process::Command;

/// Silica on silicon.
const STEP: &str = "1 | silica 300nm | silicon";

/// Runs `film` with a stack, which may contain spaces, and further arguments separated by spaces.
fn film_in(place: &Place, stack: &str, arguments: &str) -> Ran {
    let mut command = place.command("film");
    command.arg(stack).args(arguments.split_whitespace());
    Ran::of(&command.output().unwrap())
}

fn film(stack: &str, arguments: &str) -> Ran {
    film_in(&Place::default(), stack, arguments)
}

/// The rows of a CSV, without its header.
fn rows(csv: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
    csv.lines().skip(1).map(row).collect()
}

fn assert_says(said: &str, words: &[&str], case: &str) {
    for words in words {
        assert!(said.contains(words), "{case}: {words:?} is not in\n{said}");
    }
}

#[test]
fn csv_is_ordered_by_angle_then_wavelength_and_keeps_every_digit() {
    let ran = film(STEP, "--angles 0,60 --wavelengths 400:600:100 --format csv").succeeded();
    let head = ran.stdout.lines().next().unwrap();
    assert_eq!(head, "wavelength_nm,angle_deg,Rs,Rp,Ts,Tp");
    let found = rows(&ran.stdout);
    let order: Vec<_> = found.iter().map(|row| (row[0], row[1])).collect();
    assert_eq!(
        order,
        [
            (400.0, 0.0),
            (500.0, 0.0),
            (600.0, 0.0),
            (400.0, 60.0),
            (500.0, 60.0),
            (600.0, 60.0)
        ]
    );
    // Seventeen digits restore the exact number.
    let stack = Stack::parse(STEP).unwrap();
    let sampled = stack.sampled(&[400.0, 500.0, 600.0]).unwrap();
    let angles = [0.0, 60.0].map(|deg| Angle::from_degrees(deg).unwrap());
    let expected = sampled.powers_of_all(&[stack.thicknesses_nm().to_vec()], &angles);
    for (row, expected) in found.iter().zip(expected) {
        let (r, t) = (expected.reflectance, expected.transmittance);
        assert_eq!(row[2..], [r.s, r.p, t.s, t.p]);
    }
    assert!(ran.stdout.contains('e'), "{}", ran.stdout);
}

/// A case of independently computed figures: its media from the incident one on, each with its thickness, and rows of wavelength,
/// angle, Rs, Rp, Ts and Tp.
#[derive(Default)]
struct Case {
    media: BTreeMap<usize, (f64, [Vec<f64>; 3])>,
    rows: Vec<[f64; 6]>,
}

fn cases() -> BTreeMap<&'static str, Case> {
    let lines = |text: &'static str| {
        let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
        lines.map(|line| line.split(',').collect::<Vec<_>>())
    };
    let number = |cell: &str| -> f64 { cell.parse().unwrap() };
    let mut cases: BTreeMap<&str, Case> = BTreeMap::new();
    for cells in lines(include_str!("../data/films_media.csv")) {
        let case = cases.entry(cells[0]).or_default();
        let (thickness_nm, columns) = case.media.entry(cells[1].parse().unwrap()).or_default();
        *thickness_nm = number(cells[2]);
        for (column, cell) in columns.iter_mut().zip(&cells[3..]) {
            column.push(number(cell));
        }
    }
    for cells in lines(include_str!("../data/films.csv")) {
        let row: Vec<f64> = cells[1..].iter().map(|cell| number(cell)).collect();
        cases
            .entry(cells[0])
            .or_default()
            .rows
            .push(row.try_into().unwrap());
    }
    cases
}

/// A stack file with its tables inside.
fn stack_file(case: &Case) -> String {
    let table =
        |(_, [nm, n, k]): &(f64, [Vec<f64>; 3])| format!("{{ nm = {nm:?}, n = {n:?}, k = {k:?} }}");
    let last = case.media.len() - 1;
    let mut text = format!("incident = {}\n", case.media[&0].1[1][0]);
    text += &format!("substrate = {}\n", table(&case.media[&last]));
    for medium in 1..last {
        let (thickness_nm, _) = case.media[&medium];
        let index = table(&case.media[&medium]);
        text += &format!("[[layer]]\nindex = {index}\nthickness_nm = {thickness_nm}\n");
    }
    text
}

/// Bare metals, soap films, oxides and a mirror of seven layers (tmm 0.2.0), from a stack file to CSV.
#[test]
fn stack_files_give_the_figures_of_an_independent_computation() {
    let cases = cases();
    assert_eq!(cases.len(), 14);
    for (name, case) in &cases {
        let place = Place::default();
        std::fs::write(place.path("stack.toml"), stack_file(case)).unwrap();
        let asked = "--angles 0,30,60,80 --wavelengths 380:780:10 --format csv";
        let ran = film_in(&place, "stack.toml", asked).succeeded();
        let found: BTreeMap<_, _> = rows(&ran.stdout)
            .into_iter()
            .map(|row| ((row[0] as u32, row[1] as u32), row))
            .collect();
        assert_eq!(found.len(), 164);
        for expected in &case.rows {
            let row = &found[&(expected[0] as u32, expected[1] as u32)];
            for (a, b) in row.iter().zip(expected) {
                assert!((a - b).abs() < 1e-10, "{name}: {row:?} {expected:?}");
            }
        }
    }
}

#[test]
fn json_describes_its_content() {
    let place = Place::default();
    let text =
        "incident = 1\nsubstrate = \"silicon\"\n[[layer]]\nindex = [1.5, 0.1]\nthickness_nm = 80\n";
    std::fs::write(place.path("stack.toml"), text).unwrap();
    let asked = "--angles 0,30 --wavelengths 400,500 --format json --absorptance";
    let ran = film_in(&place, "stack.toml", asked).succeeded();
    let json: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(
        json["stack"]["layer"][0]["index"],
        serde_json::json!([1.5, 0.1])
    );
    assert_eq!(json["stack"]["substrate"], "silicon");
    assert!(json["backend"].as_str().unwrap().starts_with("CPU"));
    assert_eq!(json["wavelengths_nm"], serde_json::json!([400.0, 500.0]));
    let figure = |value: &Value| value.as_f64().unwrap();
    assert_eq!(figure(&json["indices"]["substrate"]["n"][0]), 5.613);
    for (angle, deg) in [0.0, 30.0].into_iter().enumerate() {
        let at = &json["angles"][angle];
        assert_eq!(figure(&at["angle_deg"]), deg);
        for w in 0..2 {
            let absorbed = figure(&at["layers"][0]["Ap"][w]);
            let sum = figure(&at["Rp"][w]) + figure(&at["Tp"][w]) + absorbed;
            assert!((sum - 1.0).abs() < 1e-12 && absorbed > 0.01);
        }
        assert!(at["color"]["srgb"].as_str().unwrap().starts_with('#'));
    }
}

#[test]
fn without_a_file_a_table_with_the_colors_is_printed() {
    let ran = film(STEP, "--angles 0,60").succeeded();
    assert_says(
        &ran.stdout,
        &[
            "1 | silica 300 nm | silicon",
            "0°: #4d6caf",
            "60°: #a68879",
            "Rs",
        ],
        "",
    );
    assert_eq!(
        ran.stdout
            .lines()
            .filter(|line| line.trim_start().starts_with("780 "))
            .count(),
        2
    );
    assert!(
        !ran.stdout.contains('\x1b'),
        "no colors where there is no terminal"
    );
    let short = film(
        STEP,
        "--wavelengths 550 --illuminant A --exposure 1 --transmitted",
    )
    .succeeded();
    assert_says(&short.stdout, &["transmitted under A, shown at +1 EV"], "");
    assert_says(&short.stderr, &["not adapted to A"], "");
    assert!(!ran.stderr.contains("adapted"), "{}", ran.stderr);
    assert_eq!(
        film(STEP, "--format table --angles 0,60")
            .succeeded()
            .stdout,
        ran.stdout
    );
}

/// The CPU computes in `f64` and the GPU in `f32`, so the numbers differ a little.
#[test]
fn the_gpu_agrees_with_the_cpu() {
    let stack = "1.5 | titania 60nm | silica 90nm | gold 20nm | bk7";
    let asked = "--angles 0,30,60,80 --format csv";
    let cpu = rows(&film(stack, asked).succeeded().stdout);
    let gpu = rows(
        &film(stack, &format!("{asked} --backend gpu"))
            .succeeded()
            .stdout,
    );
    assert_eq!(cpu.len(), gpu.len());
    let pairs = || cpu.iter().flatten().zip(gpu.iter().flatten());
    for (a, b) in pairs() {
        assert!((a - b).abs() < 5e-5, "{a} {b}");
    }
    assert!(
        pairs().any(|(a, b)| a != b),
        "all numbers are equal: both runs used the CPU"
    );
}

#[test]
fn pictures_are_written_the_same_each_time() {
    let place = Place::default();
    let run = |name: &str| {
        let asked = format!("--angles 0,45 --plot {name}.svg --exposure 1");
        let _ = film_in(&place, "1 | 1.333 400nm | 1", &asked).succeeded();
        let asked = format!("--plot {name}.png --chart {name}_chart.png --vary 1:0:500");
        let ran = film_in(&place, "1 | 1.333 400nm | 1", &asked).succeeded();
        assert!(ran.stdout.is_empty(), "{}", ran.stdout);
        assert_says(
            &ran.stderr,
            &[
                &format!("wrote {name}.png"),
                &format!("wrote {name}_chart.png"),
            ],
            "",
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
    assert_says(&said.stdout, &["does not depend on this layer"], "");
    assert!(!said.stdout.contains(" EV"), "{}", said.stdout);
    let ends = film(STEP, "--match #000000 --vary 1:20:30").succeeded();
    assert_says(&ends.stdout, &["(end of the range)"], "");
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
        "",
    );
    assert_eq!(film(stack, asked).succeeded().stdout, ran.stdout);
    assert_ne!(
        film(stack, &asked.replace("seed 3", "seed 4"))
            .succeeded()
            .stdout,
        ran.stdout
    );
}

#[test]
fn bad_stacks_are_reported_with_their_position() {
    for (stack, words) in [
        ("", vec!["no stack file", "air | silica 300nm | silicon"]),
        (
            "silica 300nm",
            vec!["no stack file \"silica 300nm\"", "has | between"],
        ),
        ("nowhere.toml", vec!["no stack file \"nowhere.toml\""]),
        ("|", vec!["no medium", "stack:1:1"]),
        (
            "1 | silca 300nm | silicon",
            vec!["did you mean \"silica\"", "stack:1:5"],
        ),
        (
            "1 | silica -3nm | silicon",
            vec!["-3 nm", "from 0 to 100000 nm", "stack:1:5"],
        ),
        (
            "1 | silica | silicon",
            vec!["has no thickness", "stack:1:5"],
        ),
        ("gold | silica 3nm | 1", vec!["gold absorbs", "stack:1:1"]),
        ("1 | silica 3nm", vec!["are half spaces", "stack:1:5"]),
        (".", vec!["is a directory"]),
    ] {
        let place = Place::default();
        assert_says(&film_in(&place, stack, "").failed(), &words, stack);
        assert!(place.names().is_empty());
    }
    let place = Place::default();
    let text = "incident = \"gold\"\nsubstrate = \"silicon\"\n[[layer]]\nindex = \"silca\"\nthickness_nm = -3\n";
    std::fs::write(place.path("bad.toml"), text).unwrap();
    let words = [
        "3 problems",
        "bad.toml:1:12",
        "bad.toml:4:9",
        "\"silica\"",
        "bad.toml:5:16",
        "found -3",
    ];
    assert_says(
        &film_in(&place, "bad.toml", "").failed(),
        &words,
        "bad.toml",
    );
}

#[test]
fn bad_arguments_are_reported_and_leave_no_file() {
    for (arguments, words) in [
        ("--angles 90", vec!["90°", "less than 90°"]),
        ("--angles -1", vec!["-1°"]),
        ("--angles x", vec!["--angles", "\"x\" is not a number"]),
        (
            "--wavelengths 780:380:10",
            vec!["runs backwards", "380:780:10"],
        ),
        (
            "--wavelengths 100:200:10",
            vec!["100 nm", "layer 1, silica", "210 to 6700 nm"],
        ),
        ("--wavelengths 0", vec!["0 nm", "1 to 1e6 nm"]),
        ("--wavelengths 380:780:0", vec!["a step of 0"]),
        (
            "--chart a.png --vary 2:0:100",
            vec!["no layer 2", "one layer"],
        ),
        ("--chart a.png --vary 0:0:100", vec!["no layer 0"]),
        ("--chart a.png --vary 1:100:0", vec!["from 100 to 0 nm"]),
        ("--chart a.png --vary 1:100", vec!["LAYER:FROM:TO"]),
        (
            "--match blue --vary 1:0:100",
            vec!["\"blue\" is not a color", "#2e6fd0"],
        ),
        ("--match #123456", vec!["--vary"]),
        (
            "--match #000000 --vary 1:0:100 --match-by chromaticity",
            vec!["black has no chromaticity"],
        ),
        (
            "--match #123456 --vary 1:0:100 --angles 0,1",
            vec!["one angle"],
        ),
        ("--plot a.jpg", vec!["a.jpg", ".svg or .png"]),
        ("--plot no/a.png", vec!["no folder no"]),
        ("--plot .", vec!["--plot ."]),
        (
            "--plot a.png --wavelengths 500",
            vec!["two or more wavelengths"],
        ),
        ("--plot a.png --angles 0:80:1", vec!["81 angles"]),
        ("--chart a.svg", vec!["a.svg", ".png"]),
        ("--plot a.png --chart a.png", vec!["same file"]),
        ("--plot ./a.png --chart a.png", vec!["same file"]),
        (
            "--sensitivity --backend gpu",
            vec!["--backend gpu has no effect", "R and T"],
        ),
        (
            "--match #123456 --vary 1:0:100 --wavelengths 500",
            vec!["--wavelengths has no effect", "R and T"],
        ),
        (
            "--plot a.png --absorptance",
            vec!["--absorptance has no effect", "--format table"],
        ),
        (
            "--vary 1:0:100",
            vec!["--vary has no effect", "--match and --chart"],
        ),
        (
            "--angles 0:89:0.001 --wavelengths 380:780:0.1",
            vec!["rows", "at most 4000000"],
        ),
        ("--illuminant d65", vec!["did you mean \"D65\""]),
        ("--exposure 99", vec!["-32 to 32"]),
        ("--tolerance 2", vec!["2%"]),
        ("--tolerance 0%", vec!["more than 0"]),
        ("--tolerance 2% --trials 0", vec!["0 trials"]),
        ("--sensitivity --design 1", vec!["1 nm", "210 to 6700"]),
        (
            "--match #123456 --vary 1:0:100 --format csv",
            vec!["cannot be used with"],
        ),
    ] {
        let place = Place::default();
        assert_says(
            &film_in(&place, STEP, arguments).failed(),
            &words,
            arguments,
        );
        assert!(place.names().is_empty(), "{arguments}: {:?}", place.names());
    }
    let many = format!("1 | {}1.5", "1.5 10nm | ".repeat(65));
    assert_says(
        &film(&many, "--wavelengths 380:780:0.005 --absorptance").failed(),
        &[
            "--absorptance",
            "80001 rows of 65 layers",
            "at most 4000000",
        ],
        "",
    );
    for report in ["--tolerance 1%", "--sensitivity", "--chart a.png"] {
        assert_says(&film("1 | 1.5", report).failed(), &["no layer"], report);
    }
}

#[test]
fn a_stack_file_is_not_overwritten() {
    let place = Place::default();
    let text = "substrate = 1.5\n";
    std::fs::write(place.path("stack.png"), text).unwrap();
    assert_says(
        &film_in(&place, "stack.png", "--plot stack.png").failed(),
        &["overwrite"],
        "",
    );
    assert_eq!(
        std::fs::read_to_string(place.path("stack.png")).unwrap(),
        text
    );
}

/// Data that end within the visible range give spectra, but no color.
#[test]
fn without_data_for_the_visible_range_there_is_no_color() {
    let place = Place::default();
    let text = "substrate = { nm = [400, 700], n = [1.5, 1.4] }\n";
    std::fs::write(place.path("stack.toml"), text).unwrap();
    let ran = film_in(&place, "stack.toml", "--wavelengths 400:700:100").succeeded();
    assert_says(&ran.stdout, &["no color", "0.039946"], "");
    let said = film_in(&place, "stack.toml", "").failed();
    assert_says(&said, &["380 nm", "the substrate", "400 to 700 nm"], "");
}

/// The commands of the README run, as in a shell, on the file that it shows.
#[test]
fn the_commands_of_the_readme_run() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let (_, section) = readme.split_once("`mirror.toml`").unwrap();
    let (_, file) = section.split_once("```toml\n").unwrap();
    let place = Place::default();
    let (file, _) = file.split_once("```").unwrap();
    std::fs::write(place.path("mirror.toml"), file).unwrap();
    let commands = readme
        .lines()
        .filter_map(|line| line.strip_prefix("cargo run --release -- film "));
    let mut count = 0;
    for command in commands {
        let line = format!("\"$PELLICLE\" film {command}");
        let mut shell = Command::new("sh");
        shell
            .args(["-c", &line])
            .env("PELLICLE", program("pellicle"))
            .current_dir(place.path(""));
        let _ = Ran::of(&shell.output().unwrap()).succeeded();
        count += 1;
    }
    assert_eq!(count, 7);
    assert_eq!(place.names(), ["mirror.svg", "mirror.toml", "newton.png"]);
}
