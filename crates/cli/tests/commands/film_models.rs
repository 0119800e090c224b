//! Tests of `pellicle film` with media beyond their data and with the two-beam model.

use crate::film::{figures, film};
use crate::place::Place;
use crate::{assert_says, json, number, rows};
use pellicle_tests::agreement::compare;
use pellicle_tests::tolerances::ORACLE_TWO_BEAM;
use picture_file::spectral_exr::read;

/// Rs and Rp of `two_beam.csv`, which another program computed.
#[test]
fn two_beams_agree_with_an_independent_computation() {
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let table: Vec<_> = rows(include_str!("../../../../tests/data/two_beam.csv")).collect();
    for chunk in table.iter().step_by(23) {
        let [nm, angle, wavelength, path] = [0, 1, 2, 3].map(|cell| chunk[cell]);
        let asked = format!(
            "--model two_beam --path-difference {path} --angles {angle} --wavelengths {wavelength} --format csv"
        );
        let ran = film(&format!("1 | 1.3333333333333333 {nm}nm | 1"), &asked).succeeded();
        found.extend_from_slice(&figures(&ran.stdout)[0][2..4]);
        expected.extend([number(chunk[4]), number(chunk[5])]);
    }
    assert!(found.len() > 20);
    if let Err(report) = compare(&found, &expected, ORACLE_TWO_BEAM) {
        panic!("{report}");
    }
}

/// A film in front of black in an environment of radiance 1 has the radiance of its reflectance.
fn command_and_scene_agree(path: &str) {
    let place = Place::default();
    let scene = format!(
        r#"
            camera = {{ type = "orthographic", position = [0, 0, 2], look_at = [0, 0, 0], height = 0.1 }}
            environment = {{ type = "constant", emission = {{ constant = 1 }} }}
            objects = [
                {{ type = "rectangle", material = "film", center = [0, 0, 0], normal = [0, 0, 1], size = [4, 4] }},
                {{ type = "rectangle", material = "black", center = [0, 0, -1], normal = [0, 0, 1], size = [40, 40] }},
            ]
            [materials]
            film = {{ type = "film", index = 1.5, thickness_nm = 400, model = "two_beam", path_difference = "{path}" }}
            black = {{ type = "diffuse", reflectance = 0 }}
            [render]
            size = [2, 2]
            samples = 1
            bands = 4
            sampling = "center"
            wavelengths_nm = [499, 507]
            "#
    );
    let asked = "render - --backend cpu -o film.exr";
    let _ = place.run_with_input(asked, scene.as_bytes()).succeeded();
    let (image, _) = read(&place.path("film.exr")).unwrap();
    let asked =
        format!("--model two_beam --path-difference {path} --wavelengths 500:506:2 --format csv");
    let rows = figures(&film("1 | 1.5 400nm | 1", &asked).succeeded().stdout);
    for (band, row) in rows.iter().enumerate() {
        let seen = f64::from(image.pixel(0, 0)[band]);
        // An image stores f32.
        assert!((seen - row[2]).abs() < 1e-6, "{row:?}: {seen}");
    }
    assert!((rows[0][2] - 0.04).abs() > 0.005);
}

cases! { command_and_scene_agree:
    command_and_scene_agree_on_two_beams("optical");
    command_and_scene_agree_on_two_beams_as_printed("as_printed");
}

#[test]
fn the_model_is_named_and_has_no_absorptance() {
    let stack = "1 | 1.5 83.33333333333333nm | 1";
    let two = "--model two_beam --wavelengths 500";
    let ran = film(stack, two).succeeded();
    // 0.153664 and 0.9216, computed by hand: r² = 0.04.
    let words = ["two beams, path difference optical", "0.153664", "0.921600"];
    assert_says(&ran.stdout, &words);
    let head = ran.stdout.lines().find(|line| line.contains("Rs")).unwrap();
    assert!(head.trim_end().ends_with(" T"), "{head}");
    let json = |arguments: &str| json(film(stack, &format!("{arguments} --format json")));
    let printed = json(&format!("{two} --path-difference as_printed"));
    assert_eq!(printed["model"], "two_beam");
    assert_eq!(printed["path_difference"], "as_printed");
    assert!((printed["angles"][0]["Rs"][0].as_f64().unwrap() - 0.115_264).abs() < 1e-12);
    let exact = json("--wavelengths 500");
    assert_eq!(exact["model"], "exact");
    assert!(exact.get("path_difference").is_none());
    let place = Place::default();
    let asked = "--model two_beam --plot a.svg --chart a.png --sensitivity --tolerance 1%";
    let _ = place.film(stack, asked).succeeded();
    let plot = std::fs::read_to_string(place.path("a.svg")).unwrap();
    assert!(plot.contains("two beams"), "{plot}");
}

fn refused(stack: &str, arguments: &str, words: &str) {
    assert_says(&film(stack, arguments).failed(), &[words]);
}

cases! { refused:
    two_beams_of_two_layers("1 | 1.5 1nm | 1.4 1nm | 1", "--model two_beam", "has 2 layers");
    two_beams_of_an_absorbing_layer("1 | 1.5+0.1i 1nm | 1", "--model two_beam", "1.5+0.1i");
    two_beams_on_an_absorbing_medium("1 | 1.5 1nm | silicon", "--model two_beam", "behind it 6.6");
    two_beams_have_no_absorptance("1 | 1.5 1nm | 1", "--model two_beam --absorptance", "no absorptance");
    two_beams_on_the_gpu("1 | 1.5 1nm | 1", "--model two_beam --backend gpu", "on the CPU");
    a_path_difference_without_two_beams(
        "1 | 1.5 1nm | 1",
        "--path-difference optical",
        "a path difference applies only to the two_beam model",
    );
    a_misspelled_model("1 | 1.5 1nm | 1", "--model two-beam", "two_beam");
}

/// Rutile's data begin at 430 nm.
#[test]
fn clamp_extends_data_with_their_end_values() {
    let stack = "1 | rutile 100nm | silica";
    let failed = film(stack, "").failed();
    assert_says(&failed, &["--clamp"]);
    let ran = film(stack, "--clamp --wavelengths 430 --format json").succeeded();
    let notes: Vec<_> = ran
        .stderr
        .lines()
        .filter(|line| line.contains("end values"))
        .collect();
    assert_eq!(
        notes,
        ["note: end values are used where data end: rutile beyond 430 to 1530 nm"]
    );
    let clamped = json(film(stack, "--clamp --wavelengths 400,430 --format json"));
    let index = &clamped["indices"]["layer"][0]["n"];
    assert_eq!(index[0], index[1]);
    // Within the data, the results are the same with and without --clamp, and nothing is noted.
    let inside = "--wavelengths 430,500 --format csv";
    let (with, without) = (
        film(stack, &format!("--clamp {inside}")),
        film(stack, inside),
    );
    assert_eq!(with.clone().succeeded().stdout, without.succeeded().stdout);
    assert_eq!(with.stderr, "");
}
