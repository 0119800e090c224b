//! The WGSL modules: all are in the table, each validates with what it requires, and it requires what it uses.

use gpu::modules::{LIMITS, MODULES, RecordLimits, Shader, Specialization};
use pellicle_tests::wgsl::{declarations, identifiers, root};
use std::collections::{BTreeMap, BTreeSet};

const SIZES: RecordLimits = RecordLimits {
    vertices: 13,
    crossings: 20,
    thicknesses: 20,
    light_groups: 2,
    splits: 2,
};

#[test]
fn every_file_is_in_the_table_once() {
    let names = |folder: &str| -> Vec<String> {
        let entries = std::fs::read_dir(root().join("shaders").join(folder));
        let entries = entries.expect("the folder exists");
        let names = entries.map(|entry| entry.expect("readable").file_name().into_string());
        names.map(|name| name.expect("UTF-8")).collect()
    };
    let in_bsdf = names("bsdf");
    let files = names("").into_iter().filter(|name| name != "bsdf");
    let files: BTreeSet<String> = files
        .chain(in_bsdf.iter().map(|name| format!("bsdf/{name}")))
        .collect();
    let table: BTreeSet<String> = MODULES.iter().map(|m| format!("{}.wgsl", m.name)).collect();
    assert!(files.len() > 10, "few shaders found: {files:?}");
    assert_eq!(files, table);
    assert_eq!(
        table.len(),
        MODULES.len(),
        "a module stands twice in the table"
    );
}

fn parsed(roots: &[&str], extra: &str) -> Result<naga::Module, String> {
    let made_for = Specialization::general(SIZES);
    let shader = Shader::assemble(roots, &made_for, extra);
    shader.parse().map_err(|error| error.to_string())
}

#[test]
fn every_module_validates_with_what_it_requires() {
    let mistakes: Vec<String> = MODULES
        .iter()
        .filter_map(|module| parsed(&[module.name], "").err())
        .collect();
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}

#[test]
fn a_broken_module_does_not_validate() {
    assert!(parsed(&["fresnel"], "fn f() -> f32 { return 1u; }").is_err());
}

/// Who declares each name of module scope.
fn owners() -> BTreeMap<String, &'static str> {
    let mut owners = BTreeMap::new();
    for name in [
        "MAX_VERTICES",
        "MAX_CROSSINGS",
        "MAX_THICKNESSES",
        "LIGHT_GROUPS",
        "MAX_SPLITS",
        "RECORDS_THICKNESSES",
    ] {
        owners.insert(name.to_owned(), LIMITS);
    }
    for module in MODULES {
        for name in declarations(module.source) {
            let before = owners.insert(name.clone(), module.name);
            assert_eq!(before, None, "{name} is declared twice");
        }
    }
    owners
}

fn used_modules(
    source: &str,
    own: &str,
    owners: &BTreeMap<String, &'static str>,
) -> BTreeSet<&'static str> {
    let words = identifiers(source);
    words
        .iter()
        .filter_map(|word| owners.get(word).copied())
        .filter(|owner| *owner != own)
        .collect()
}

#[test]
fn every_module_requires_exactly_what_it_uses() {
    let owners = owners();
    assert!(owners.len() > 80, "few declarations found");
    let mut mistakes = String::new();
    for module in MODULES {
        let used = used_modules(module.source, module.name, &owners);
        let required: BTreeSet<&str> = module.requires.iter().copied().collect();
        if used != required {
            mistakes += &format!("{} uses {used:?} but requires {required:?}\n", module.name);
        }
    }
    assert!(mistakes.is_empty(), "{mistakes}");
}

#[test]
fn a_missing_requirement_is_noticed() {
    let used = used_modules(
        "fn f(x: vec4f) -> vec4f { return sin_pi4(x); }",
        "new",
        &owners(),
    );
    assert_eq!(used, BTreeSet::from(["trig"]));
}
