//! Checks that the workspace's dependencies follow `deny.toml`: licenses, duplicate versions, and the sources of crates.
//!
//! `cargo deny check` checks the same and looks for known faults; this test needs only Cargo.

use cargo_metadata::{Metadata, MetadataCommand, Package};
use pellicle_tests::sources::root;
use serde::Deserialize;
use spdx::{Expression, LicenseReq, ParseMode};
use std::collections::{BTreeMap, BTreeSet};

#[derive(Deserialize)]
struct Policy {
    licenses: Licenses,
    bans: Bans,
}

#[derive(Deserialize)]
struct Licenses {
    allow: Vec<String>,
}

#[derive(Deserialize)]
struct Bans {
    skip: Vec<Skip>,
}

#[derive(Deserialize)]
struct Skip {
    /// `name@version`, with as much of the version as matters.
    #[serde(rename = "crate")]
    package: String,
    reason: String,
}

fn policy() -> Policy {
    toml::from_str(&std::fs::read_to_string(root().join("deny.toml")).unwrap()).unwrap()
}

fn metadata() -> Metadata {
    MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .other_options(["--locked".to_owned(), "--offline".to_owned()])
        .exec()
        .unwrap()
}

/// Whether these licenses satisfy the expression.
fn is_allowed(expression: &str, allowed: &[String]) -> bool {
    let Ok(expression) = Expression::parse_mode(expression, ParseMode::LAX) else {
        return false;
    };
    let is_one = |required: &LicenseReq| allowed.contains(&required.to_string());
    expression.evaluate(is_one)
}

#[test]
fn expressions_are_understood() {
    let allowed = ["MIT", "Zlib"].map(str::to_owned);
    for (expression, expected) in [
        ("MIT", true),
        ("GPL-3.0-only", false),
        ("MIT OR GPL-3.0-only", true),
        ("MIT/Apache-2.0", true),
        ("MIT AND GPL-3.0-only", false),
        ("(MIT OR Apache-2.0) AND Zlib", true),
        ("Apache-2.0 WITH LLVM-exception", false),
        ("", false),
        ("what one likes", false),
    ] {
        assert_eq!(is_allowed(expression, &allowed), expected, "{expression}");
    }
}

#[test]
fn licenses_are_allowed() {
    let allowed = policy().licenses.allow;
    let is_wrong = |package: &&Package| {
        let license = package.license.as_deref().unwrap_or_default();
        !is_allowed(license, &allowed)
    };
    let metadata = metadata();
    let wrong = metadata.packages.iter().filter(is_wrong);
    let wrong: Vec<_> = wrong
        .map(|p| format!("{}: {:?}", p.name, p.license))
        .collect();
    assert!(wrong.is_empty(), "deny.toml does not allow {wrong:#?}");
}

#[test]
fn crates_come_from_crates_io_or_the_workspace() {
    let metadata = metadata();
    let members: BTreeSet<_> = metadata.workspace_members.iter().collect();
    for package in &metadata.packages {
        let is_known = match &package.source {
            Some(source) => source.is_crates_io(),
            None => members.contains(&package.id),
        };
        assert!(is_known, "{} comes from {:?}", package.name, package.source);
    }
}

/// Every crate has one version, except those that are skipped with a reason; no skip is unnecessary.
#[test]
fn every_crate_has_one_version() {
    let metadata = metadata();
    let mut versions: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for package in &metadata.packages {
        let of_name = versions.entry(package.name.as_str()).or_default();
        of_name.insert(package.version.to_string());
    }
    for Skip { package, reason } in policy().bans.skip {
        assert!(reason.len() > 10, "{package} has no reason");
        let (name, skipped) = package.split_once('@').expect("a name and a version");
        let found = versions
            .get_mut(name)
            .unwrap_or_else(|| panic!("there is no {name}"));
        let before = found.len();
        found.retain(|version| !version.starts_with(&format!("{skipped}.")));
        assert!(
            before > 1 && found.len() < before,
            "{package} has one version: it needs no skip"
        );
    }
    versions.retain(|_, found| found.len() > 1);
    assert!(versions.is_empty(), "in several versions: {versions:?}");
}
