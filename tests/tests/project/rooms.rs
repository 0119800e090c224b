//! Checks the dependencies between the workspace's crates, as their `Cargo.toml` files declare them.

use cargo_metadata::{DependencyKind, MetadataCommand, Package};
use std::collections::{BTreeMap, BTreeSet};

/// The crates that each crate may depend on. A test crate may depend on everything.
const ARROWS: &[(&str, &[&str])] = &[
    ("pellicle-document", &[]),
    ("pellicle-spectra", &["pellicle-document"]),
    ("pellicle-optics", &[]),
    (
        "pellicle-colorimetry",
        &["pellicle-document", "pellicle-spectra"],
    ),
    (
        "pellicle-media",
        &[
            "pellicle-colorimetry",
            "pellicle-document",
            "pellicle-optics",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle-relight",
        &["pellicle-colorimetry", "pellicle-spectra"],
    ),
    (
        "pellicle-picture-file",
        &[
            "pellicle-colorimetry",
            "pellicle-relight",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle-plot",
        &[
            "pellicle-colorimetry",
            "pellicle-picture-file",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle-color",
        &[
            "pellicle-colorimetry",
            "pellicle-picture-file",
            "pellicle-relight",
            "pellicle-spectra",
        ],
    ),
    ("pellicle-scene", &["pellicle-document", "pellicle-spectra"]),
    (
        "pellicle-prepare",
        &["pellicle-optics", "pellicle-scene", "pellicle-spectra"],
    ),
    (
        "pellicle-scene-file",
        &[
            "pellicle-colorimetry",
            "pellicle-document",
            "pellicle-media",
            "pellicle-optics",
            "pellicle-picture-file",
            "pellicle-prepare",
            "pellicle-scene",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle-reference",
        &["pellicle-optics", "pellicle-scene", "pellicle-spectra"],
    ),
    ("pellicle-gpu", &["pellicle-scene", "pellicle-spectra"]),
    (
        "pellicle-progressive",
        &[
            "pellicle-picture-file",
            "pellicle-scene",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle-coating",
        &[
            "pellicle-colorimetry",
            "pellicle-document",
            "pellicle-media",
            "pellicle-optics",
            "pellicle-picture-file",
            "pellicle-plot",
            "pellicle-spectra",
        ],
    ),
    (
        "pellicle",
        &[
            "pellicle-coating",
            "pellicle-color",
            "pellicle-colorimetry",
            "pellicle-document",
            "pellicle-gpu",
            "pellicle-media",
            "pellicle-optics",
            "pellicle-picture-file",
            "pellicle-plot",
            "pellicle-progressive",
            "pellicle-reference",
            "pellicle-relight",
            "pellicle-scene",
            "pellicle-scene-file",
            "pellicle-spectra",
        ],
    ),
    ("pellicle-cli", &["pellicle"]),
    ("pellicle-fuzz", &[]),
];

const TESTS: &str = "pellicle-tests";

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The members' dependencies on one another, without those for tests.
fn declared() -> Arrows {
    let manifest = pellicle_tests::sources::root().join("Cargo.toml");
    let metadata = MetadataCommand::new()
        .manifest_path(manifest)
        .no_deps()
        .other_options(["--offline".to_owned()])
        .exec()
        .unwrap();
    let members = metadata.workspace_packages();
    let names: BTreeSet<String> = members.iter().map(|m| m.name.to_string()).collect();
    let of_member = |member: &&Package| {
        let ours = member
            .dependencies
            .iter()
            .filter(|dependency| dependency.kind != DependencyKind::Development)
            .map(|dependency| dependency.name.clone())
            .filter(|name| names.contains(name));
        (member.name.to_string(), ours.collect())
    };
    members.iter().map(of_member).collect()
}

/// Errors in the dependencies: one that is not allowed, one that is allowed and not there, a member without a rule, a rule without a member.
fn wrong(arrows: &Arrows) -> Vec<String> {
    let mut wrong = Vec::new();
    for (from, targets) in arrows.iter().filter(|(from, _)| *from != TESTS) {
        let Some((_, allowed)) = ARROWS.iter().find(|(name, _)| name == from) else {
            wrong.push(format!("{from} has no rule"));
            continue;
        };
        for to in targets {
            if !allowed.contains(&to.as_str()) {
                wrong.push(format!("{from} depends on {to}"));
            }
        }
        for to in allowed.iter().filter(|to| !targets.contains(**to)) {
            wrong.push(format!("{from} does not depend on {to}, which is allowed"));
        }
    }
    for (name, _) in ARROWS {
        if !arrows.contains_key(*name) {
            wrong.push(format!("{name} is missing"));
        }
    }
    wrong
}

#[test]
fn the_dependencies_follow_the_design() {
    let arrows = declared();
    let found = wrong(&arrows);
    assert!(found.is_empty(), "{}", found.join("\n"));
    // The list is really read: these dependencies exist.
    assert!(arrows["pellicle-reference"].contains("pellicle-optics"));
    assert!(arrows["pellicle-gpu"].contains("pellicle-scene"));
    assert!(arrows["pellicle-cli"].contains("pellicle"));
}

/// The two renderers share only the scene, directly or through others: no optics, and nothing that uses it. A scene holds tables that
/// were computed with optics and that both look up; the content of these tables is tested absolutely.
#[test]
fn both_renderers_share_no_physics() {
    let arrows = declared();
    let of_gpu = reached(&arrows, "pellicle-gpu");
    assert_eq!(
        of_gpu.iter().map(String::as_str).collect::<Vec<_>>(),
        ["pellicle-document", "pellicle-scene", "pellicle-spectra"]
    );
    let of_reference = reached(&arrows, "pellicle-reference");
    assert!(of_reference.contains("pellicle-optics") && !of_reference.contains("pellicle-gpu"));
    assert!(reached(&arrows, "pellicle-optics").is_empty());
    // An arrow through another crate is found.
    let mut through = arrows;
    let of_scene = through.get_mut("pellicle-scene").unwrap();
    of_scene.insert("pellicle-optics".to_owned());
    assert!(reached(&through, "pellicle-gpu").contains("pellicle-optics"));
}

/// All members that a member depends on, directly or through others.
fn reached(arrows: &Arrows, from: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![from.to_owned()];
    while let Some(name) = open.pop() {
        for to in &arrows[&name] {
            if found.insert(to.clone()) {
                open.push(to.clone());
            }
        }
    }
    found
}

#[test]
fn a_wrong_dependency_is_noticed() {
    let truth = declared();
    for (from, to) in [
        ("pellicle-gpu", "pellicle-reference"),
        ("pellicle-gpu", "pellicle-optics"),
        ("pellicle-reference", "pellicle-gpu"),
        ("pellicle-optics", "pellicle-gpu"),
        ("pellicle-spectra", "pellicle-scene"),
        ("pellicle-cli", "pellicle-gpu"),
        ("pellicle-color", "pellicle-tests"),
    ] {
        let mut arrows = truth.clone();
        arrows.get_mut(from).unwrap().insert(to.to_owned());
        assert_eq!(wrong(&arrows), [format!("{from} depends on {to}")]);
    }
    let mut arrows = truth.clone();
    let of_gpu = arrows.get_mut("pellicle-gpu").unwrap();
    assert!(of_gpu.remove("pellicle-spectra"));
    assert_eq!(
        wrong(&arrows),
        ["pellicle-gpu does not depend on pellicle-spectra, which is allowed"]
    );
    let mut arrows = truth.clone();
    arrows.insert("pellicle-new".to_owned(), BTreeSet::new());
    assert_eq!(wrong(&arrows), ["pellicle-new has no rule"]);
    let mut arrows = truth;
    arrows.remove("pellicle-color");
    assert_eq!(wrong(&arrows), ["pellicle-color is missing"]);
}
