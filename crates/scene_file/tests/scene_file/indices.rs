//! User-defined indices: files of the refractiveindex.info database, coefficients, mixtures.

use crate::{CAMERA, read};
use pellicle_scene_file::description::{Extrapolate, Index};
use pellicle_scene_file::{Problems, SceneFile};
use spectra::OpticalConstants;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Reads a file of the database with this text.
fn database(text: &str) -> Result<OpticalConstants, Problems> {
    noted(text).map(|(constants, _)| constants)
}

/// The same, with the notes on what was assumed.
fn noted(text: &str) -> Result<(OpticalConstants, Vec<String>), Problems> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("medium.yml"), text).unwrap();
    let yaml = "medium.yml".into();
    let extrapolate = Extrapolate::Error;
    let index = Index::Database { yaml, extrapolate };
    media::optical_constants(&index, folder.path())
}

fn close(constants: &OpticalConstants, nm: f64, (n, k): (f64, f64)) -> bool {
    let index = constants.at(nm).unwrap();
    (index.re - n).abs() < 1e-12 && (index.im - k).abs() < 1e-12
}

#[test]
fn tables_of_a_database_file_are_read_in_any_of_their_forms() {
    let together = "# a comment\nREFERENCES: |\n    A. Author\nDATA:\n  - type: tabulated nk\n    data: |\n        \
                    0.4 1.5 0.25\n        0.8 2.5 7.5e-1\nCONDITIONS:\n    temperature: 293\n";
    let apart = "DATA:\n  - type: tabulated n\n    data: |\n        0.4 1.5\n\n        0.8 2.5\n  - type: tabulated k\n    \
                 data: |\n        0.4 0.25\n        0.8 0.75\n";
    let other_order = "SPECS: {a: [1, {b: 2}], ? [c] : d}\nDATA:\n- data: >\n\n    0.4 1.5 0.25\n\n    0.8 2.5 0.75\n  type: \"tabulated nk\"\n";
    let twice = "DATA:\n  - type: tabulated nk\n    data: |\n        1e-5 1 0\n        0.4 1.5 0.25\n        0.4 1.50 2.5E-1\n        0.8 2.5 0.75\n";
    let tabs = "DATA:\r\n  - type: tabulated nk\r\n    data: |\r\n        # um\tn\tk\r\n        0.4\t1.5\t0.25\r\n        0.8\t2.5  0.75 # end\r\n";
    let with_n2 = "# a file of today\nREFERENCES: |\n    A. Author\nCOMMENTS: |\n    Film\nDATA:\n  - type: tabulated n2\n    data: |\n        \
                   9.2 750e-20\n  - type: tabulated nk\n    data: |\n        0.4 1.5 0.25\n        0.8 2.5 0.75\nSPECS:\n    \
                   n_is_absolute: true\n    thermal_dispersion:\n    - type: \"Schott formula\"\n      coefficients: 1 2\n\
                   PROPERTIES:\n  density: 2.5\n";
    let steps_back = "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.5 0.25\n        0.8 2.5 0.75\n        0.7 2.25 0.625\n";
    for text in [
        together,
        apart,
        other_order,
        twice,
        tabs,
        with_n2,
        steps_back,
    ] {
        let constants = database(text).unwrap_or_else(|problems| panic!("{text}\n{problems:#}"));
        assert!(close(&constants, 600.0, (2.0, 0.5)), "{text}");
        assert_eq!(constants.range_nm(), Some((400.0, 800.0)), "{text}");
    }
}

#[test]
fn formulas_of_a_database_file_are_those_of_the_database() {
    // n at 500 nm, computed by hand: the same values as in the tests of the formulas.
    let cases = [
        ("formula 1", "2 3 0.3", (3.0_f64 + 0.75 / 0.16).sqrt()),
        ("formula 2", "2 3 0.1", 8.0_f64.sqrt()),
        ("formula 3", "2 3 2 4 -1", 10.75_f64.sqrt()),
        ("formula 4", "2 3 1 0.2 2", (2.0_f64 + 1.5 / 0.21).sqrt()),
        ("formula 5", "1.25 1E-2 -2", 1.29),
        ("formula 6", "0.5 3 10", 2.0),
        ("formula 7", "1.5 2.22E-2", 1.6),
        ("formula 8", "0.1 0.2 0.05 0.4", (1.9_f64 / 0.55).sqrt()),
        ("formula 9", "2 0.3 0.05 0.4 0.3 0.06", 4.3_f64.sqrt()),
    ];
    for (kind, coefficients, n) in cases {
        let text = format!(
            "DATA:\n  - type: {kind}\n    wavelength_range: 0.45 0.9\n    coefficients: {coefficients}\n  \
             - type: tabulated k\n    data: |\n        0.3 0\n        0.7 0.5\n"
        );
        let constants = database(&text).unwrap_or_else(|problems| panic!("{kind}\n{problems:#}"));
        assert!(close(&constants, 500.0, (n, 0.25)), "{kind}");
        assert_eq!(constants.range_nm(), Some((450.0, 700.0)), "{kind}");
        assert!(constants.n.at(449.0).is_err() && constants.n.at(901.0).is_err());
    }
}

/// The error for this text of a database file is one line that names the file and contains the phrase.
fn refused(text: &str, expected: &str) {
    let said = format!("{:#}", database(text).expect_err(text));
    assert!(said.starts_with("yaml: "), "{said}");
    assert!(said.contains("medium.yml: "), "{said}");
    assert!(said.contains(expected), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

cases! { refused:
    an_empty_database_file("", "no `DATA` with a list of blocks");
    a_database_file_of_words("just words", "no `DATA`");
    a_database_file_with_a_number_as_data("DATA: 5\n", "no `DATA`");
    a_database_file_without_data("OTHER:\n  - type: tabulated n\n", "no `DATA`");
    a_database_file_that_is_not_yaml("DATA:\n  - type: [\n", "line 3: this is not YAML: ");
    a_database_file_with_tabs("DATA:\n\t- type: x\n", "line 2: this is not YAML: ");
    a_database_file_with_an_alias("a: &a 1\nDATA:\n  - type: *a\n", "line 3: found an alias");
    a_block_without_a_type("DATA:\n  - data: 1\n", "line 2: the block has no `type`");
    a_formula_of_an_unknown_number(
        "DATA:\n\n  - type: formula 10\n",
        "line 3: found the type \"formula 10\"; it must be \"tabulated nk\"",
    );
    a_table_of_an_unknown_type("DATA:\n  - type: tabulated q\n", "found the type \"tabulated q\"");
    a_database_file_without_n("DATA:\n  - type: tabulated k\n    data: 0.4 1\n", "no block gives n");
    a_database_file_of_the_nonlinear_index(
        "DATA:\n  - type: tabulated n2\n    data: 9.2 750e-20\n",
        "no block gives n",
    );
    data_that_are_there_twice(
        "DATA:\n  - type: tabulated n\n    data: 0.4 1\nCOMMENTS: x\nDATA:\n  - type: tabulated n\n    data: 0.4 2\n",
        "line 5: the key \"DATA\" is already in line 1",
    );
    a_block_with_its_data_twice(
        "DATA:\n  - type: tabulated n\n    data: 0.4 1\n    data: 0.4 2\n",
        "line 4: the key \"data\" is already in line 3",
    );
    a_key_that_is_there_twice_in_a_part_not_read(
        "SPECS: {a: {b: 1, b: 2}}\nDATA:\n  - type: tabulated n\n    data: 0.4 1\n",
        "line 1: the key \"b\" is already in line 1",
    );
    a_second_document(
        "DATA:\n  - type: tabulated n\n    data: 0.4 1\n---\nDATA:\n  - type: tabulated k\n    data: 0.4 2\n",
        "line 4: found a second document",
    );
}

fn refused_table(rows: &str, expected: &str) {
    let head = "DATA:\n  - type: tabulated nk\n    data: |\n";
    refused(&format!("{head}{rows}"), expected);
}

cases! { refused_table:
    a_row_with_a_number_missing(
        "        0.4 1.5 0\n        0.5 1.5\n",
        "line 5: found 2 numbers, expected 3",
    );
    a_row_with_a_number_missing_after_empty_lines(
        "\n\n        0.4 1.5 0\n        0.5 1.5\n",
        "line 7: found 2 numbers, expected 3",
    );
    a_row_with_a_word("        0.4 1.5 0\n        0.5 1.5 x\n", "line 5: \"x\" is not a number");
    rows_with_n_below_0(
        "        0.4 -1 0\n        0.5 -2 0\n",
        "line 4: found n -1 at 400 nm; it must be from 0.001 to 1000",
    );
    a_row_with_k_below_0("        0.5 1 -1\n", "line 4: found k -1 at 500 nm; it must be from 0 to 1000");
    rows_that_contradict_each_other(
        "        0.4 1.5 0\n        0.4 1.6 0\n",
        "lines 4 and 5 both give n at 400 nm, as 1.5 and as 1.6",
    );
    a_wavelength_that_is_no_number("        nan 1.5 0\n", "line 4: found NaN");
    a_wavelength_of_0("        0 1.5 0\n", "line 4: found 0");
    rows_far_outside_of_all_bands("        1e9 1.5 0\n", "the table has no points");
    two_blocks_that_give_n(
        "        0.4 1.5 0\n  - type: tabulated n\n    data: 0.4 1\n",
        "2 blocks give n; only one can",
    );
    a_block_without_data("        0.4 1.5 0\n  - type: tabulated k\n", "line 5: the block has no `data`");
}

fn refused_formula(rest: &str, expected: &str) {
    refused(&format!("DATA:\n  - type: formula 1\n{rest}"), expected);
}

cases! { refused_formula:
    a_formula_without_a_range("    coefficients: 0\n", "line 2: the block has no `wavelength_range`");
    a_formula_without_coefficients(
        "    wavelength_range: 0.3 2\n",
        "line 2: the block has no `coefficients`",
    );
    a_range_of_one_number("    wavelength_range: 0.3\n", "line 3: found 1 numbers, expected 2");
    a_range_that_runs_backwards(
        "    wavelength_range: 2 0.3\n    coefficients: 0\n",
        "line 4: 2000 to 300 nm is not a range",
    );
    two_coefficients(
        "    wavelength_range: 0.3 2\n    coefficients: 0 1\n",
        "line 4: found 2 coefficients; expected one, then two for each",
    );
    a_coefficient_that_is_no_number(
        "    wavelength_range: 0.3 2\n    coefficients: 0 x\n",
        "line 4: \"x\" is not a number",
    );
    a_formula_without_an_index(
        "    wavelength_range: 0.3 2\n    coefficients: -2\n",
        "line 2: the formula gives no index from 0.001 to 1000 at any wavelength from 300 to 2000 nm",
    );
}

/// A fault is reported at wavelengths that it affects, and the rest of the table can be used: rows; a wavelength within the fault
/// and the error there; valid wavelengths around it.
fn fault(rows: &str, faulty: f64, said: &str, sound: &[f64]) {
    let rows = rows.replace('|', "\n        ");
    let text = format!("DATA:\n  - type: tabulated nk\n    data: |\n        {rows}\n");
    let constants = database(&text).unwrap_or_else(|problems| panic!("{text}\n{problems:#}"));
    let error = constants.at(faulty).unwrap_err().to_string();
    assert!(error.contains(said), "{error}");
    for &nm in sound {
        assert!(constants.at(nm).is_ok(), "at {nm} nm");
    }
    let clamped = constants.n.clone().clamped();
    let k = constants.k.clone().clamped();
    assert!(clamped.at(faulty).and(k.at(faulty)).is_err(), "{text}");
}

cases! { fault:
    a_fault_before_the_last_row(
        "0.3 1.5 0|0.9 1.45 0|12 1.9 -0.3|13 1.9 0",
        5000.0,
        "line 6: found k -0.3 at 12000 nm; it must be from 0 to 1000",
        &[300.0, 900.0, 13_000.0],
    );
    a_fault_in_the_last_row(
        "0.3 1.5 0|0.9 1.45 0|12 1.9 -0.3",
        901.0,
        "line 6: found k -0.3 at 12000 nm",
        &[300.0, 900.0],
    );
    a_fault_in_the_first_row(
        "0.1 -1 0|0.3 1.5 0|0.9 1.45 0",
        200.0,
        "line 4: found n -1 at 100 nm; it must be from 0.001 to 1000",
        &[300.0, 900.0],
    );
    // A slightly negative n does not count as noise.
    a_fault_of_n_that_is_not_noise(
        "0.3 1.5 0|0.5 -1e-9 0|0.9 1.45 0",
        400.0,
        "line 5: found n -0.000000001 at 500 nm",
        &[300.0, 900.0],
    );
    a_fault_of_n_that_is_no_number(
        "0.3 1.5 0|0.5 nan 0|0.9 1.45 0",
        500.0,
        "line 5: found n NaN at 500 nm",
        &[300.0, 900.0],
    );
    a_fault_of_k_that_is_not_noise(
        "0.3 1.5 0|0.5 1.5 -1.1e-6|0.9 1.45 0",
        500.0,
        "line 5: found k -0.0000011 at 500 nm",
        &[300.0, 900.0],
    );
    a_fault_of_rows_that_contradict_each_other(
        "0.3 1.5 0|0.5 1.5 0.1|0.9 1.45 0|0.5 1.5 0.2",
        600.0,
        "lines 5 and 7 both give k at 500 nm, as 0.1 and as 0.2",
        &[300.0, 900.0],
    );
}

#[test]
fn a_pole_of_a_formula_is_reported_only_where_it_is_asked_for() {
    let text = "DATA:\n  - type: formula 1\n    wavelength_range: 0.3 12\n    coefficients: 0 1.5 0.18 0.09 6.5919\n";
    let constants = database(text).unwrap();
    // √(1 + 1.5·0.25/(0.25 − 0.0324) + 0.09·0.25/(0.25 − 43.45314561)), by Python.
    assert!(close(&constants, 500.0, (1.650_098_419_132_538_5, 0.0)));
    // 1 + 1.5·144/(144 − 0.0324) + 0.09·144/(144 − 43.45314561)
    assert!(close(&constants, 12_000.0, (1.621_490_890_282_918_8, 0.0)));
    // n² is 0.135 at 6470 nm and −0.082 at 6480 nm, by hand.
    assert!((constants.at(6470.0).unwrap().re.powi(2) - 0.135).abs() < 1e-3);
    let error = constants.at(6591.9).unwrap_err().to_string();
    assert!(
        error.contains("line 2: the formula gives no index from 0.001 to 1000 at 6480 nm"),
        "{error}"
    );
    // A pole too weak for any sample to detect is still a fault.
    let weak = "DATA:\n  - type: formula 2\n    wavelength_range: 0.3 12\n    coefficients: 1 1e-20 0.25\n";
    let constants = database(weak).unwrap();
    assert!(constants.n.is_sound_within(380.0, 780.0).is_err());
    assert!(constants.n.is_sound_within(510.0, 780.0).is_ok());
}

#[test]
fn scenes_are_refused_only_where_their_bands_meet_a_fault() {
    let folder = TempDir::new().unwrap();
    let rows = |middle: &str| {
        format!(
            "DATA:\n  - type: tabulated nk\n    data: |\n        0.3 1.5 0\n        {middle}\n        0.9 1.5 0\n        12 1.5 -1\n"
        )
    };
    let check = |text: String| {
        let path = folder.path().join("medium.yml");
        fs::write(&path, text).unwrap();
        scene(&format!("{{ yaml = '{}' }}", path.display()))
    };
    assert!(check(rows("0.5 1.5 0")).is_ok());
    // Between the knots of the bands, which are whole nanometers apart.
    let narrow = rows("0.5001 1.5 0\n        0.5002 1.5 -1\n        0.5003 1.5 0");
    let problems = check(narrow).unwrap_err();
    let said = format!("{problems:#}");
    assert!(
        said.contains("line 6: found k -1 at 500.2 nm; it must be from 0 to 1000, and the bands cover 380 to 780 nm"),
        "{said}"
    );
    let help = problems.iter().next().and_then(|p| p.help.clone()).unwrap();
    assert!(!help.contains("extrapolate"), "{help}");
}

#[test]
fn mixtures_keep_the_faults_of_their_media() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("medium.yml");
    let rows = "0.3 2 0\n        0.5 2 0\n        0.55 2 -1\n        0.6 2 0\n        0.9 2 0";
    fs::write(
        &path,
        format!("DATA:\n  - type: tabulated nk\n    data: |\n        {rows}\n"),
    )
    .unwrap();
    let yaml = path.display();
    let index = format!(
        "{{ mixture = 'maxwell_garnett', of = [1, {{ yaml = '{yaml}' }}], fraction = 0.5 }}"
    );
    let said = format!("{:#}", scene(&index).unwrap_err());
    assert!(said.contains("line 6: found k -1 at 550 nm"), "{said}");
}

#[test]
fn what_is_assumed_of_a_database_file_is_noted() {
    let table = |rows: &str, rest: &str| {
        let rows = rows.replace('|', "\n        ");
        format!("DATA:\n  - type: tabulated nk\n    data: |\n        {rows}\n{rest}")
    };
    let n2 = "  - type: tabulated n2\n    data: 9.2 750e-20\n";
    let cases = [
        (
            table("0.3 1.5 1E-6|0.9 1.45 1E-8|30.0 1.9 -1E-9", ""),
            vec!["line 6: k -0.000000001 at 30000 nm: taken as 0"],
        ),
        (
            table("0.3 1.5 -1e-6|0.9 1.45 -1E-8", ""),
            vec!["line 4: k -0.000001 at 300 nm, and 1 more that are above -0.000001: taken as 0"],
        ),
        (
            table("0.3 1.5 0|0.9 1.5 0|0.3 1.5 0|0.9 1.5 0", ""),
            vec!["line 6 repeats line 4, and 1 more such rows; each counts once"],
        ),
        (
            table("0.3 1.5 0|1e-4 1 0|0.9 1.5 0", ""),
            vec!["1 of the rows are left out: they are outside 1 to 1e6 nm"],
        ),
        (
            table("0.3 1.5 0|0.9 1.5 0", n2),
            vec!["line 6: \"tabulated n2\", the nonlinear index, is ignored"],
        ),
        (
            table(
                "0.3 1.5 0|0.9 1.5 0",
                "SPECS:\n    n_is_absolute: false\n    wavelength_is_vacuum: false\n",
            ),
            vec![
                "line 7: n is relative to air (`n_is_absolute: false`) and is used unchanged",
                "line 8: wavelengths are in air (`wavelength_is_vacuum: false`) and are used unchanged",
            ],
        ),
        (
            table("0.3 1.5 0|0.9 1.5 0", "SPECS:\n    n_is_absolute: true\n"),
            vec![],
        ),
    ];
    for (text, expected) in cases {
        let (constants, notes) = noted(&text).unwrap_or_else(|problems| panic!("{problems:#}"));
        assert_eq!(notes.len(), expected.len(), "{text}\n{notes:?}");
        for (note, expected) in notes.iter().zip(expected) {
            assert!(
                note.contains("medium.yml: ") && note.ends_with(expected),
                "{text}\n{note}"
            );
        }
        assert!(constants.at(600.0).is_ok(), "{text}");
    }
    let (constants, _) = noted(&table("0.3 1.5 -1e-6|0.9 1.45 -1E-8", "")).unwrap();
    assert_eq!(constants.k.at(300.0), Ok(0.0));
}

#[test]
fn names_of_chemistry_are_materials() {
    let named = |name: &str| media::optical_constants(&Index::Name(name.to_owned()), Path::new(""));
    let (gold, notes) = named("Au").unwrap();
    assert_eq!(gold, spectra::optical_constants("gold").unwrap().data);
    let note =
        "Au is taken as gold (Johnson and Christy 1972); there are also gold_mcpeak, gold_olmon";
    assert!(notes.len() == 1 && notes[0].contains(note), "{notes:?}");
    // Only one data set, or its own name: nothing is assumed.
    assert!(named("Ge").unwrap().1.is_empty() && named("gold").unwrap().1.is_empty());
    for (written, meant) in [
        ("sio2", "SiO2"),
        ("AU", "Au"),
        ("n-bk7", "N-BK7"),
        ("silca", "silica"),
    ] {
        let said = format!("{:#}", named(written).unwrap_err());
        assert!(said.contains(&format!("did you mean {meant:?}?")), "{said}");
    }
}

/// A hostile database file is refused without delay.
fn hostile(text: &str) {
    let start = std::time::Instant::now();
    let said = format!("{:#}", database(text).unwrap_err());
    assert!(said.len() < 500, "{said}");
    assert!(start.elapsed().as_secs() < 5, "{said}");
}

/// Lists of lists by a few aliases.
fn bomb() -> String {
    let lists: Vec<_> = (0..50).map(|i| format!("b{i}: [*a, *a]\n")).collect();
    format!("a: &a [x, x]\n{}DATA: 1\n", lists.concat())
}

fn many_coefficients() -> String {
    let head = "DATA:\n  - type: formula 3\n    wavelength_range: 0.3 2\n    coefficients: ";
    format!("{head}{}\n", "1 ".repeat(1_000_001))
}

fn many_rows() -> String {
    let rows = "        0.5 1.5 0\n".repeat(500_000);
    format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}")
}

fn a_long_row() -> String {
    let row = "0.5 ".repeat(2_000_000);
    format!("DATA:\n  - type: tabulated nk\n    data: {row}\n")
}

fn many_keys() -> String {
    let keys: Vec<_> = (0..200_000).map(|key| format!("k{key}: 1\n")).collect();
    keys.concat()
}

cases! { hostile:
    hostile_nesting(&format!("DATA: {}", "[".repeat(100_000)));
    hostile_dashes(&format!("DATA:\n{}", "- ".repeat(100_000)));
    hostile_length(&format!("DATA: '{}'", "x".repeat(17 << 20)));
    hostile_nesting_of_a_part_not_read(&format!("SPECS: {}1\nDATA: 1\n", "{a: ".repeat(100_000)));
    hostile_aliases(&bomb());
    hostile_coefficients(&many_coefficients());
    hostile_rows(&many_rows());
    hostile_row(&a_long_row());
    hostile_keys(&many_keys());
}

/// A scene whose metal has this index.
fn scene(index: &str) -> Result<scene::Scene, Problems> {
    let text = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 1, 5]\nlook_at = [0, 0, 0]\nfov_deg = 30\n\
         [materials.metal]\ntype = 'conductor'\nindex = {index}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'metal'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    SceneFile::parse("test.toml", &text, Path::new(""))?
        .allow_outside(true)
        .validate()
}

/// n and k of the scene's metal at the middle of band 17 of 40, 555 nm.
fn at_555_nm(index: &str) -> (f64, f64) {
    let scene = scene(index).unwrap_or_else(|problems| panic!("{problems:#}"));
    let scene::Material::Interface { n, k, .. } = scene.materials()[0] else {
        panic!("a conductor was asked for")
    };
    (scene.spectrum(n).at(17, 0.5), scene.spectrum(k).at(17, 0.5))
}

#[test]
fn coefficients_give_the_index_that_the_formula_does() {
    let (n, k) = at_555_nm("{ cauchy = [1.45, 0.0035, 0.0001] }");
    let um2 = 0.555_f64 * 0.555;
    assert!((n - (1.45 + 0.0035 / um2 + 0.0001 / (um2 * um2))).abs() < 1e-12 && k == 0.0);
    assert!((at_555_nm("{ cauchy = [1.45] }").0 - 1.45).abs() < 1e-15);
    // N-BK7 as SCHOTT gives it.
    let (n, _) = at_555_nm(
        "{ sellmeier = { b = [1.03961212, 0.231792344, 1.01046945], c_um2 = [0.00600069867, 0.0200179144, 103.560653] } }",
    );
    let bk7 = spectra::optical_constants("bk7").unwrap().data;
    assert!((n - bk7.n.at(555.0).unwrap()).abs() < 1e-12, "{n}");
}

#[test]
fn mixtures_lie_between_their_media_and_may_hold_mixtures() {
    let (n, k) = at_555_nm("{ mixture = 'bruggeman', of = [1.5, 'water'], fraction = 0 }");
    assert!((n - 1.5).abs() < 1e-14 && k == 0.0);
    let gold = at_555_nm("'gold'");
    let all_gold = at_555_nm("{ mixture = 'maxwell_garnett', of = [1, 'gold'], fraction = 1 }");
    assert!((gold.0 - all_gold.0).abs() < 1e-12 && (gold.1 - all_gold.1).abs() < 1e-12);
    // ε 1 and 4 in equal parts: (2.5 + √38.25) / 4 by Bruggeman, 2 by Maxwell Garnett.
    let (n, _) = at_555_nm("{ mixture = 'bruggeman', of = [1, 2], fraction = 0.5 }");
    assert!(
        (n * n - (2.5 + 38.25_f64.sqrt()) / 4.0).abs() < 1e-12,
        "{n}"
    );
    let (n, _) = at_555_nm("{ mixture = 'maxwell_garnett', of = [1, [2, 0]], fraction = 0.5 }");
    assert!((n * n - 2.0).abs() < 1e-12, "{n}");
    let nested = "{ mixture = 'bruggeman', of = [{ mixture = 'maxwell_garnett', of = [1, 2], fraction = 0.5 }, 2], fraction = 0 }";
    assert!((at_555_nm(nested).0 - 2.0_f64.sqrt()).abs() < 1e-12);
}

/// The index of the scene's metal has one problem, which is reported where it is.
fn refused_index(index: &str, expected: &str) {
    let said = format!("{:#}", scene(index).expect_err(index));
    assert!(said.contains(expected), "{said}");
    assert!(said.starts_with("test.toml:8:"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

cases! { refused_index:
    an_unknown_mixture("{ mixture = 'brugeman', of = [1, 2], fraction = 0 }", "did you mean \"bruggeman\"?");
    an_index_with_short_data(
        "'rutile'",
        "index: the data cover 430 to 1530 nm, but the bands cover 380 to 780 nm",
    );
    too_many_coefficients_of_cauchy("{ cauchy = [1, 2, 3, 4] }", "index.cauchy: found 4 coefficients");
    a_coefficient_of_cauchy_that_is_too_large(
        "{ cauchy = [1, 1e20] }",
        "index.cauchy[1]: found 1e20; it must be from",
    );
    a_formula_of_cauchy_without_an_index("{ cauchy = [-1] }", "index.cauchy: the formula gives no index");
    strengths_without_resonances(
        "{ sellmeier = { b = [1], c_um2 = [] } }",
        "index.sellmeier: found 1 strengths `b` for 0 resonances",
    );
    a_sellmeier_formula_without_resonances(
        "{ sellmeier = { b = [1] } }",
        "index.sellmeier.c_um2: is missing",
    );
    // n² = 1 + λ²/(λ² − 0.36) has a resonance at 600 nm, so there is an index above it, and none between 425 and 600 nm.
    a_sellmeier_formula_with_a_resonance_in_the_bands(
        "{ sellmeier = { b = [1], c_um2 = [0.36] } }",
        "index: the data cover 601 to 30000 nm, but the bands",
    );
    a_missing_database_file("{ yaml = 'no_such.yml' }", "index.yaml: no_such.yml: cannot be opened");
}

fn refused_mixture(rest: &str, expected: &str) {
    refused_index(&format!("{{ mixture = 'bruggeman', {rest} }}"), expected);
}

cases! { refused_mixture:
    a_misspelled_medium_of_a_mixture(
        "of = ['gold', 'watr'], fraction = 0.5",
        "index.of[1]: there is no material with a known index \"watr\"; did you mean \"water\"?",
    );
    a_mixture_of_one_medium(
        "of = ['gold'], fraction = 0.5",
        "index.of: found an array of 1, expected an array of 2 values",
    );
    a_boolean_in_a_mixture(
        "of = ['gold', true], fraction = 0.5",
        "index.of[1]: found the boolean true, expected a number, an array of 2 numbers",
    );
    a_fraction_above_1(
        "of = ['gold', 1], fraction = 1.5",
        "index.fraction: found 1.5; it must be from 0 to 1",
    );
    a_mixture_without_a_fraction("of = ['gold', 1]", "index.fraction: is missing");
    a_misspelled_fraction(
        "of = ['gold', 1], fractoin = 0.5",
        "index.fractoin: unknown field; did you mean `fraction`?",
    );
    a_formula_without_coefficients_in_a_mixture(
        "of = ['gold', { cauchy = [] }], fraction = 0.5",
        "index.of[1].cauchy: found 0 coefficients; there must be 1 to 3",
    );
    a_mixture_with_short_data(
        "of = ['gold', 'polystyrene'], fraction = 0.5",
        "index: the data cover 400 to 1937 nm, but the bands cover 380 to 780 nm",
    );
    a_mixture_without_a_common_wavelength(
        "of = [{ nm = [300, 400], n = [1, 1] }, { nm = [500, 600], n = [1, 1] }], fraction = 0.5",
        "index.of: the media have no wavelength in common",
    );
}

#[test]
fn what_is_too_short_can_be_clamped() {
    let rutile = spectra::optical_constants("rutile").unwrap().data;
    let scene = scene("{ name = 'rutile', extrapolate = 'clamp' }").unwrap();
    let scene::Material::Interface { n, .. } = scene.materials()[0] else {
        panic!("a conductor was asked for")
    };
    let first = scene.spectrum(n).at(0, 0.0);
    assert!(
        (first - rutile.n.at(430.0).unwrap()).abs() < 1e-12,
        "{first}"
    );
    for index in [
        "{ sellmeier = { b = [1], c_um2 = [0.36] }, extrapolate = 'clamp' }",
        "{ mixture = 'bruggeman', of = ['gold', { name = 'rutile', extrapolate = 'clamp' }], fraction = 0.5 }",
    ] {
        let clamped = self::scene(index);
        assert!(clamped.is_ok(), "{index}");
    }
    let said =
        self::scene("{ mixture = 'bruggeman', of = [1, 'rutile'], fraction = 0.5 }").unwrap_err();
    let help = said
        .iter()
        .next()
        .and_then(|problem| problem.help.clone())
        .unwrap();
    assert!(
        help.contains("`extrapolate = \"clamp\"` to the part of the mixture"),
        "{help}"
    );
}

#[test]
fn an_index_of_any_form_makes_a_scene() {
    let folder = TempDir::new().unwrap();
    fs::write(
        folder.path().join("glass.yml"),
        "DATA:\n  - type: formula 5\n    wavelength_range: 0.3 1\n    coefficients: 1.5 0.004 -2\n",
    )
    .unwrap();
    fs::write(folder.path().join("glass.csv"), "300,1.5\n1000,1.6\n").unwrap();
    let forms = [
        "1.5",
        "[1.5, 0.01]",
        "'bk7'",
        "{ name = 'rutile', extrapolate = 'clamp' }",
        "{ nm = [300, 1000], n = [1.5, 1.6] }",
        "{ csv = 'glass.csv' }",
        "{ yaml = 'glass.yml' }",
        "{ cauchy = [1.5, 0.004] }",
        "{ sellmeier = { b = [1.2], c_um2 = [0.01] } }",
        "{ mixture = 'bruggeman', of = ['gold', { mixture = 'maxwell_garnett', of = ['water', 'silver'], fraction = 0.1 }], fraction = 0.5 }",
    ];
    let films = forms.iter().enumerate().map(|(number, index)| {
        format!("[materials.m{number}]\ntype = 'film'\nthickness_nm = 300\nindex = {index}\n")
    });
    let text = format!("{CAMERA}{}", films.collect::<String>());
    let scene = read(&text, folder.path()).unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_eq!(scene.materials().len(), forms.len());
    // Another folder does not have the files.
    assert_eq!(read(&text, "").unwrap_err().iter().len(), 2);
}
