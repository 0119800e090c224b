//! Tests of the command `pellicle materials`, and of the materials in a scene.

use pellicle_tests::command::{Place, Ran};
use scene::SceneFile;
use serde_json::Value;
use spectra::{material_info, material_names};
use std::path::Path;

fn materials(arguments: &str) -> Ran {
    Place::default().run(&format!("materials {arguments}"))
}

fn printed(arguments: &str) -> String {
    materials(arguments).succeeded().stdout
}

#[test]
fn all_materials_are_listed_with_set_range_and_paper() {
    let listed = printed("");
    assert!(listed.starts_with("name "), "{listed}");
    let rows: Vec<&str> = listed.lines().skip(1).collect();
    let names: Vec<_> = rows
        .iter()
        .filter_map(|row| row.split_whitespace().next())
        .collect();
    assert_eq!(names, material_names());
    assert!(names.len() >= 40);
    let gold: Vec<_> = rows[names.iter().position(|&name| name == "gold").unwrap()]
        .split_whitespace()
        .collect();
    assert_eq!(
        gold.join(" "),
        "gold Au 255 to 1937 Au-Johnson Johnson and Christy 1972"
    );
}

#[test]
fn chemical_names_are_shown_and_accepted() {
    let glass = printed("N-BK7");
    assert_eq!(glass, printed("bk7"));
    assert!(glass.contains("also      BK7, N-BK7, NBK7\n"), "{glass}");
    assert!(printed("--search tio2").contains("titania "));
    let said = Place::default().run("materials sio2").failed();
    assert!(said.contains("did you mean \"SiO2\"?"), "{said}");
}

#[test]
fn a_material_is_shown_with_source_figures_and_plot() {
    let shown = printed("gold");
    for phrase in [
        "gold: gold, evaporated film\n",
        "Phys. Rev. B 6, 4370-4379 (1972), DOI 10.1103/PhysRevB.6.4370\n",
        "license   CC0 1.0",
        "range     255.1 to 1937 nm\n",
        // Between 0.43 + 2.455i at 548.6 nm and 0.29 + 2.863i at 582.1 nm, Johnson and Christy (1972).
        "   550        0.4241        2.4721\n",
        "380            480             580             680             780 nm\n",
    ] {
        assert!(shown.contains(phrase), "{phrase:?} is not in\n{shown}");
    }
    let drawn = |line: &&str| {
        line.contains('┤') && line.chars().any(|c| ('\u{2801}'..='\u{28ff}').contains(&c))
    };
    assert!(
        shown.lines().filter(drawn).count() >= 15,
        "two curves:\n{shown}"
    );
    assert!(
        !shown.contains('\x1b'),
        "output that is not a terminal has escapes"
    );
    // Without absorption there is one curve, and outside its range a material has no figures.
    let rutile = printed("rutile");
    assert_eq!(
        rutile.matches("680             780 nm").count(),
        1,
        "{rutile}"
    );
    assert!(
        rutile.contains("\n   450 ") && !rutile.contains("\n   400 "),
        "{rutile}"
    );
}

#[test]
fn every_material_can_be_shown() {
    let place = Place::default();
    for name in material_names() {
        let shown = place.run(&format!("materials {name}")).succeeded().stdout;
        assert!(
            shown.contains(material_info(name).unwrap().citation),
            "{name}"
        );
    }
}

#[test]
fn json_has_the_same_content() {
    let all: Value = serde_json::from_str(&printed("--format json")).unwrap();
    let listed: Vec<_> = all
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["name"].as_str().unwrap())
        .collect();
    assert_eq!(listed, material_names());
    let gold: Value = serde_json::from_str(&printed("gold --format json")).unwrap();
    assert_eq!(gold["data_set"], "Au-Johnson");
    assert_eq!(gold["range_nm"][1], 1937.0);
    let nm: Vec<_> = gold["nm"]
        .as_array()
        .unwrap()
        .iter()
        .map(|nm| nm.as_u64().unwrap())
        .collect();
    assert_eq!(nm, (380..=780).step_by(10).collect::<Vec<u64>>());
    let constants = spectra::optical_constants("gold").unwrap().data;
    for (index, &nm) in nm.iter().enumerate() {
        let expected = constants.at(nm as f64).unwrap();
        // The JSON parser of these tests may miss the last digit.
        let near =
            |found: &Value, expected: f64| (found.as_f64().unwrap() - expected).abs() < 1e-14;
        assert!(
            near(&gold["n"][index], expected.re) && near(&gold["k"][index], expected.im),
            "{nm}"
        );
    }
}

#[test]
fn a_part_of_a_name_or_of_a_paper_finds_materials() {
    let found = |text: &str| {
        let listed = printed(&format!("--search {text}"));
        let names = listed
            .lines()
            .skip(1)
            .filter_map(|row| row.split_whitespace().next());
        names.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(
        found("nitride"),
        [
            "silicon_nitride",
            "silicon_nitride_film",
            "titanium_nitride"
        ]
    );
    assert_eq!(found("DAIMON"), ["water"]);
}

#[test]
fn unknown_names_are_reported_with_suggestions() {
    for (arguments, said) in [
        (
            "glod",
            "there is no material with a known index \"glod\"; did you mean \"gold\"?",
        ),
        ("unobtainium", "`pellicle materials` lists all"),
        (
            "--search unobtainium",
            "no material matches \"unobtainium\"",
        ),
        ("gold --search gold", "cannot be used with"),
        ("gold --format yaml", "[possible values: text, json]"),
    ] {
        let stderr = materials(arguments).failed();
        assert!(stderr.contains(said), "{arguments}: {stderr}");
    }
}

#[test]
fn an_index_of_any_form_makes_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("glass.yml"),
        "DATA:\n  - type: formula 5\n    wavelength_range: 0.3 1\n    coefficients: 1.5 0.004 -2\n",
    )
    .unwrap();
    std::fs::write(folder.path().join("glass.csv"), "300,1.5\n1000,1.6\n").unwrap();
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
    let camera = "camera = { type = 'perspective', position = [0, 1, 5], look_at = [0, 0, 0], fov_deg = 30 }\n";
    let text = camera.to_owned() + &films.collect::<String>();
    let parsed = SceneFile::parse("forms.toml", &text, folder.path());
    let scene = parsed
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"));
    assert_eq!(scene.materials().len(), forms.len());
    // Another folder does not have the files.
    let elsewhere = SceneFile::parse("forms.toml", &text, Path::new("")).unwrap();
    assert_eq!(elsewhere.validate().unwrap_err().iter().len(), 2);
}
