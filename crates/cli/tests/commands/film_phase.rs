//! Tests of `pellicle film --phase`.

use crate::assert_says;
use crate::film::{figures, film};
use crate::place::Place;
use serde_json::Value;

/// Silica on silicon at 632.8 nm, with the constants of a common standard.
const STANDARD: &str = "1 | 1.4571 100nm | 3.875+0.018i";

/// A row of the CSV of a stack at one wavelength and angle.
fn row(stack: &str, arguments: &str) -> Vec<f64> {
    let ran = film(stack, &format!("{arguments} --phase --format csv")).succeeded();
    let head = ran.stdout.lines().next().unwrap();
    assert_eq!(
        head,
        "wavelength_nm,angle_deg,Rs,Rp,Ts,Tp,rs_re,rs_im,rp_re,rp_im,ts_re,ts_im,tp_re,tp_im,psi_deg,delta_deg"
    );
    let rows = figures(&ran.stdout);
    assert_eq!((rows.len(), rows[0].len()), (1, 16));
    rows[0].clone()
}

/// Amplitudes, ψ and Δ from the Python package tmm 0.2.0, whose Δ is 180° minus this one.
#[test]
fn csv_has_amplitudes_and_ellipsometric_angles() {
    let found = row(STANDARD, "--angles 70 --wavelengths 632.8");
    let expected = [
        -0.364_620_064_359,
        -0.423_481_334_148,
        -0.419_446_657_944,
        0.246_496_978_447,
        0.168_713_724_878,
        0.184_670_646_807,
        0.105_389_340_859,
        0.241_531_308_222,
        41.042_961_424_323,
        180.0 - 100.287_102_241_958,
    ];
    for (found, expected) in found[6..].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let power = |re: usize| found[re].powi(2) + found[re + 1].powi(2);
    assert!((found[2] - power(6)).abs() < 1e-14);
    assert!((found[3] - power(8)).abs() < 1e-14);
}

#[test]
fn the_sign_of_p_is_chosen_by_name() {
    let asked = "--angles 70 --wavelengths 632.8 --p-sign";
    let [verdet, fresnel] =
        ["verdet", "fresnel"].map(|sign| row(STANDARD, &format!("{asked} {sign}")));
    assert_eq!(verdet, row(STANDARD, "--angles 70 --wavelengths 632.8"));
    assert_eq!(fresnel[8..10], [-verdet[8], -verdet[9]]);
    assert!((fresnel[15] - verdet[15] - 180.0).abs() < 1e-9);
    assert_eq!(fresnel[..8], verdet[..8]);
    assert_eq!(fresnel[10..15], verdet[10..15]);
}

#[test]
fn json_has_the_columns_and_the_convention() {
    let asked = "--angles 0,70 --wavelengths 500,632.8 --phase --format json";
    let ran = film(STANDARD, asked).succeeded();
    let json: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(json["phase"]["p_sign"], "verdet");
    let at = &json["angles"][1];
    for name in [
        "rs_re", "rs_im", "rp_re", "rp_im", "ts_re", "ts_im", "tp_re", "tp_im",
    ] {
        assert!(at[name][1].is_f64(), "{name}: {}", at[name]);
        assert_eq!(at[name].as_array().unwrap().len(), 2);
    }
    let degrees = |angle: usize, name: &str| json["angles"][angle][name][1].as_f64().unwrap();
    assert!((degrees(1, "psi_deg") - 41.043).abs() < 1e-3);
    assert!((degrees(1, "delta_deg") - 79.713).abs() < 1e-3);
    assert!((degrees(0, "psi_deg") - 45.0).abs() < 1e-9);
    assert!((degrees(0, "delta_deg") - 180.0).abs() < 1e-9);
    let without = film(STANDARD, "--wavelengths 500 --format json").succeeded();
    assert!(!without.stdout.contains("rs_re") && !without.stdout.contains("\"phase\""));
}

#[test]
fn the_table_has_psi_and_delta() {
    let ran = film(STANDARD, "--angles 70 --wavelengths 632.8 --phase").succeeded();
    let head = ran.stdout.lines().find(|line| line.contains("Rs")).unwrap();
    assert!(head.ends_with("A   psi_deg delta_deg"), "{head}");
    let row = ran.stdout.lines().last().unwrap();
    assert!(row.ends_with("  41.0430   79.7129"), "{row}");
}

/// At Brewster's angle r_p = 0.
#[test]
fn what_has_no_phase_is_left_empty() {
    let brewster = 1.5_f64.atan().to_degrees();
    let run = |format: &str| {
        let asked = format!("--angles {brewster} --wavelengths 500 --phase --format {format}");
        film("1 | 1.5", &asked).succeeded().stdout
    };
    let csv = run("csv");
    let row = csv.trim_end().lines().last().unwrap();
    assert!(row.ends_with(",0.0000000000000000e0,"), "{row}");
    let json: Value = serde_json::from_str(&run("json")).unwrap();
    assert_eq!(json["angles"][0]["psi_deg"][0], 0.0);
    assert!(json["angles"][0]["delta_deg"][0].is_null());
    let table = run("table");
    let row = table.trim_end().lines().last().unwrap();
    assert!(row.ends_with("   0.0000         -"), "{row}");
}

#[test]
fn absorptances_come_before_phases() {
    let asked = "--wavelengths 632.8 --absorptance --phase --format csv";
    let head = film(STANDARD, asked).succeeded().stdout;
    assert!(head.contains("Tp,A1s,A1p,rs_re,"), "{head}");
}

/// ψ and Δ are plotted over the wavelength or over the angle, in place of R, T and A.
#[test]
fn psi_and_delta_are_plotted() {
    let place = Place::default();
    let run = |name: &str, asked: &str| {
        let asked = format!("--phase --plot {name} {asked}");
        let ran = place.film(STANDARD, &asked).succeeded();
        assert!(ran.stdout.is_empty(), "{}", ran.stdout);
        assert_says(&ran.stderr, &[&format!("wrote {name}")]);
        std::fs::read(place.path(name)).unwrap()
    };
    let text = |name: &str, asked: &str| String::from_utf8(run(name, asked)).unwrap();
    let over_nm = text("a.svg", "--angles 60,70");
    let over_angle = text(
        "b.svg",
        "--plot-over angle --angles 0:89:1 --wavelengths 450,632.8 --p-sign fresnel",
    );
    assert_says(&over_nm, &["ψ / °", "Δ / °", "wavelength in vacuum", "70°"]);
    assert_says(
        &over_angle,
        &["angle of incidence / °", "632.8 nm", "p sign fresnel"],
    );
    assert!(!over_nm.contains("reflectance R") && !over_nm.contains("under D65"));
    let first = run("a.png", "--angles 60,70");
    assert_eq!(first, run("a.png", "--angles 60,70"));
    assert_ne!(first, run("b.png", "--angles 60,75"));
}

/// Colors are not shown, so nothing is said of their illuminant, and data need not cover visible light.
#[test]
fn a_plot_of_phases_has_no_colors() {
    let place = Place::default();
    let asked = "--phase --wavelengths 430:1000:10 --clamp --illuminant A --plot a.svg";
    let ran = place.film("1 | 1.5 100nm | rutile", asked).succeeded();
    assert_eq!(ran.stderr, "wrote a.svg\n");
}

fn refused(arguments: &str, words: &[&str]) {
    let place = Place::default();
    assert_says(&place.film("1 | 1.5 1nm | 1", arguments).failed(), words);
    assert!(place.names().is_empty(), "{:?}", place.names());
}

cases! { refused:
    phases_of_two_beams("--phase --model two_beam", &["--phase has no effect", "powers alone"]);
    phases_without_effect("--phase --sensitivity", &["--phase has no effect", "--format table"]);
    a_plot_of_phases_on_the_gpu(
        "--phase --plot a.png --backend gpu",
        &["--backend gpu has no effect", "on the CPU"],
    );
    a_sign_without_phases("--p-sign fresnel", &["--phase"]);
    a_misspelled_sign("--phase --p-sign nebraska", &["verdet", "fresnel"]);
    an_axis_without_a_plot("--phase --plot-over angle", &["--plot"]);
    an_axis_without_phases("--plot a.png --plot-over angle", &["--phase"]);
    a_plot_over_one_angle(
        "--phase --plot a.png --plot-over angle --wavelengths 500",
        &["two or more angles", "--angles"],
    );
    a_plot_of_too_many_wavelengths(
        "--phase --plot a.png --plot-over angle --angles 0:80:1",
        &["401 wavelengths; at most 16", "--wavelengths"],
    );
}

#[test]
fn a_refused_incident_medium_says_why() {
    let failed = film("gold | 1.5 1nm | 1", "--phase").failed();
    assert_says(&failed, &["gold absorbs", "no separate powers"]);
}
