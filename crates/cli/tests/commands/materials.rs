//! Tests of `pellicle materials`.

use crate::assert_says;
use crate::place::{Place, Ran};
use serde_json::Value;
use spectra::{material_info, material_names};

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

fn refused(arguments: &str, words: &str) {
    assert_says(&materials(arguments).failed(), &[words]);
}

cases! { refused:
    a_misspelled_name("glod", "there is no material with a known index \"glod\"; did you mean \"gold\"?");
    an_unknown_name("unobtainium", "`pellicle materials` lists all");
    a_search_without_results("--search unobtainium", "no material matches \"unobtainium\"");
    a_name_and_a_search("gold --search gold", "cannot be used with");
    an_unknown_format("gold --format yaml", "[possible values: text, json]");
}
