//! A user's own index: files of the refractiveindex.info database, coefficients, mixtures.

use pellicle_scene::description::{Extrapolate, Index};
use pellicle_scene::{Problems, SceneFile, optical_constants};
use spectra::OpticalConstants;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// What a file of the database with this text gives.
fn database(text: &str) -> Result<OpticalConstants, Problems> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("medium.yml"), text).unwrap();
    let yaml = "medium.yml".into();
    let extrapolate = Extrapolate::Error;
    let index = Index::Database { yaml, extrapolate };
    optical_constants(&index, folder.path()).map(|(constants, _)| constants)
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
    let twice = "DATA:\n  - type: tabulated nk\n    data: |\n        1e-5 1 0\n        0.4 1.5 0.25\n        0.4 9 9\n        0.8 2.5 0.75\n";
    let steps_back = "DATA:\n  - type: tabulated nk\n    data: |\n        0.4 1.5 0.25\n        0.8 2.5 0.75\n        0.7 2.25 0.625\n";
    for text in [together, apart, other_order, twice, steps_back] {
        let constants = database(text).unwrap_or_else(|problems| panic!("{text}\n{problems:#}"));
        assert!(close(&constants, 600.0, (2.0, 0.5)), "{text}");
        assert_eq!(constants.range_nm(), Some((400.0, 800.0)), "{text}");
    }
}

#[test]
fn formulas_of_a_database_file_are_those_of_the_database() {
    // n at 500 nm, worked by hand: the same figures as in the tests of the formulas.
    let cases = [
        ("formula 1", "2 3 0.3", (3.0_f64 + 0.75 / 0.16).sqrt()),
        ("formula 2", "2 3 0.1", 8.0_f64.sqrt()),
        ("formula 3", "2 3 2 4 -1", 10.75_f64.sqrt()),
        ("formula 4", "2 3 1 0.2 2", (2.0_f64 + 1.5 / 0.21).sqrt()),
        ("formula 5", "1.25 1E-2 -2", 1.29),
        ("formula 6", "0.5 3 10", 2.0),
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

/// What is said about each of the texts is one line that names the file and has the phrase.
fn assert_told(cases: &[(String, &str)]) {
    for (text, expected) in cases {
        let said = format!("{:#}", database(text).expect_err(text));
        assert!(
            said.starts_with("yaml: ") && said.contains("medium.yml: "),
            "{text}\n{said}"
        );
        assert!(said.contains(expected), "{text}\n{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}

#[test]
fn files_that_are_not_of_the_database_are_told() {
    let cases = [
        ("", "no `DATA` with a list of blocks"),
        ("just words", "no `DATA`"),
        ("DATA: 5\n", "no `DATA`"),
        ("OTHER:\n  - type: tabulated n\n", "no `DATA`"),
        ("DATA:\n  - type: [\n", "line 3: this is not YAML: "),
        ("DATA:\n\t- type: x\n", "line 2: this is not YAML: "),
        ("a: &a 1\nDATA:\n  - type: *a\n", "line 3: an alias"),
        ("DATA:\n  - data: 1\n", "line 2: the block has no `type`"),
        (
            "DATA:\n\n  - type: formula 7\n",
            "line 3: found the type \"formula 7\"; it must be \"tabulated nk\"",
        ),
        (
            "DATA:\n  - type: tabulated q\n",
            "found the type \"tabulated q\"",
        ),
        (
            "DATA:\n  - type: tabulated k\n    data: 0.4 1\n",
            "no block gives n",
        ),
    ];
    assert_told(&cases.map(|(text, expected)| (text.to_owned(), expected)));
}

#[test]
fn tables_of_a_database_file_are_checked_line_by_line() {
    let cases = [
        (
            "        0.4 1.5 0\n        0.5 1.5\n",
            "line 5: found 2 numbers, expected 3",
        ),
        (
            "\n\n        0.4 1.5 0\n        0.5 1.5\n",
            "line 7: found 2 numbers, expected 3",
        ),
        (
            "        0.4 1.5 0\n        0.5 1.5 x\n",
            "line 5: \"x\" is not a number",
        ),
        (
            "        0.4 1.5 0\n        0.5 1.5 0\n        0.4 1.6 0\n",
            "line 6: found 400 nm after 400 nm; wavelengths must rise",
        ),
        (
            "        0.4 1.5 0\n        0.5 -1 0\n",
            "line 5: found n -1; it must be from 0.001 to 1000",
        ),
        (
            "        0.4 1.5 0\n        0.5 1 -1\n",
            "line 5: found k -1; it must be from 0 to 1000",
        ),
        (
            "        0.8 1.5 0\n        0.5 1 0\n        0.7 1 -0.1\n",
            "line 6: found k -0.1; it must be from 0 to 1000",
        ),
        ("        nan 1.5 0\n", "line 4: found NaN"),
        ("        0 1.5 0\n", "line 4: found 0"),
        ("        1e9 1.5 0\n", "the table has no points"),
        (
            "        0.4 1.5 0\n  - type: tabulated n\n    data: 0.4 1\n",
            "2 blocks give n; only one can",
        ),
        (
            "        0.4 1.5 0\n  - type: tabulated k\n",
            "line 5: the block has no `data`",
        ),
    ];
    let table = |rows: &str| format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
    assert_told(&cases.map(|(rows, expected)| (table(rows), expected)));
}

#[test]
fn formulas_of_a_database_file_are_checked() {
    let range = "    wavelength_range: 0.3 2\n";
    let cases = [
        (
            "    coefficients: 0\n".to_owned(),
            "line 2: the block has no `wavelength_range`",
        ),
        (range.to_owned(), "line 2: the block has no `coefficients`"),
        (
            "    wavelength_range: 0.3\n".to_owned(),
            "line 3: found 1 numbers, expected 2",
        ),
        (
            "    wavelength_range: 2 0.3\n    coefficients: 0\n".to_owned(),
            "line 4: 2000 to 300 nm is not a range",
        ),
        (
            format!("{range}    coefficients: 0 1\n"),
            "line 4: found 2 coefficients: one, then two for each",
        ),
        (
            format!("{range}    coefficients: 0 x\n"),
            "line 4: \"x\" is not a number",
        ),
        (
            format!("{range}    coefficients: -2\n"),
            "line 2: the formula gives no index from 0.001 to 1000 at 300 nm",
        ),
    ];
    let formula = |rest: String| format!("DATA:\n  - type: formula 1\n{rest}");
    assert_told(&cases.map(|(rest, expected)| (formula(rest), expected)));
}

#[test]
fn hostile_database_files_are_refused_without_delay() {
    let deep = format!("DATA: {}", "[".repeat(100_000));
    let dashes = format!("DATA:\n{}", "- ".repeat(100_000));
    let large = format!("DATA: '{}'", "x".repeat(17 << 20));
    for text in [deep, dashes, large] {
        assert!(database(&text).is_err());
    }
}

/// A scene whose metal has this index.
fn scene(index: &str) -> Result<pellicle_scene::Scene, Problems> {
    let text = format!(
        "[camera]\ntype = 'perspective'\nposition = [0, 1, 5]\nlook_at = [0, 0, 0]\nfov_deg = 30\n\
         [materials.metal]\ntype = 'conductor'\nindex = {index}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'metal'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    SceneFile::parse("test.toml", &text, Path::new(""))?.validate()
}

/// n and k of the scene's metal at the middle of band 17 of 40, 555 nm.
fn at_555_nm(index: &str) -> (f64, f64) {
    let scene = scene(index).unwrap_or_else(|problems| panic!("{problems:#}"));
    let pellicle_scene::Material::Conductor { n, k, .. } = scene.materials()[0] else {
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

#[test]
fn mistakes_in_an_index_are_told_where_they_are() {
    let mix = |rest: &str| format!("{{ mixture = 'bruggeman', {rest} }}");
    let cases = [
        (
            mix("of = ['gold', 'watr'], fraction = 0.5"),
            "index.of[1]: there is no material with a known index \"watr\"; did you mean \"water\"?",
        ),
        (
            mix("of = ['gold'], fraction = 0.5"),
            "index.of: found an array of 1, expected an array of 2 values",
        ),
        (
            mix("of = ['gold', true], fraction = 0.5"),
            "index.of[1]: found the boolean true, expected a number, an array of 2 numbers",
        ),
        (
            mix("of = ['gold', 1], fraction = 1.5"),
            "index.fraction: found 1.5; it must be from 0 to 1",
        ),
        (mix("of = ['gold', 1]"), "index.fraction: is missing"),
        (
            mix("of = ['gold', 1], fractoin = 0.5"),
            "index.fractoin: unknown field; did you mean `fraction`?",
        ),
        (
            mix("of = ['gold', { cauchy = [] }], fraction = 0.5"),
            "index.of[1].cauchy: found 0 coefficients; it must be 1 to 3",
        ),
        (
            "{ mixture = 'brugeman', of = [1, 2], fraction = 0 }".to_owned(),
            "did you mean \"bruggeman\"?",
        ),
        (
            mix("of = ['gold', 'polystyrene'], fraction = 0.5"),
            "index: the data cover 400 to 1937 nm, but the bands cover 380 to 780 nm",
        ),
        (
            mix(
                "of = [{ nm = [300, 400], n = [1, 1] }, { nm = [500, 600], n = [1, 1] }], fraction = 0.5",
            ),
            "index.of: the media have no wavelength in common",
        ),
        (
            "'rutile'".to_owned(),
            "index: the data cover 430 to 1530 nm, but the bands cover 380 to 780 nm",
        ),
        (
            "{ cauchy = [1, 2, 3, 4] }".to_owned(),
            "index.cauchy: found 4 coefficients",
        ),
        (
            "{ cauchy = [1, 1e20] }".to_owned(),
            "index.cauchy[1]: found 1e20; it must be from",
        ),
        (
            "{ cauchy = [-1] }".to_owned(),
            "index.cauchy: the formula gives no index",
        ),
        (
            "{ sellmeier = { b = [1], c_um2 = [] } }".to_owned(),
            "index.sellmeier: found 1 strengths `b` for 0 resonances",
        ),
        (
            "{ sellmeier = { b = [1] } }".to_owned(),
            "index.sellmeier.c_um2: is missing",
        ),
        // n² = 1 + λ²/(λ² − 0.36): a resonance at 600 nm, so an index from there up, and none between 425 and 600 nm.
        (
            "{ sellmeier = { b = [1], c_um2 = [0.36] } }".to_owned(),
            "index: the data cover 601 to 30000 nm, but the bands",
        ),
        (
            "{ yaml = 'no_such.yml' }".to_owned(),
            "index.yaml: no_such.yml: cannot be opened",
        ),
    ];
    for (index, expected) in cases {
        let said = format!("{:#}", scene(&index).expect_err(&index));
        assert!(said.contains(expected), "{index}\n{said}");
        assert!(said.starts_with("test.toml:8:"), "{index}\n{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}

#[test]
fn what_is_too_short_can_be_clamped() {
    let rutile = spectra::optical_constants("rutile").unwrap().data;
    let scene = scene("{ name = 'rutile', extrapolate = 'clamp' }").unwrap();
    let pellicle_scene::Material::Conductor { n, .. } = scene.materials()[0] else {
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
