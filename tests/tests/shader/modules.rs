//! Tests of the WGSL modules: every file is one, together they are valid, and mistakes are reported with their positions.

use gpu::modules::{MODULES, RecordLimits, Shader, Specialization};
use pellicle_tests::sources::root;
use std::collections::BTreeSet;
use std::path::Path;

const SIZES: RecordLimits = RecordLimits {
    vertices: 13,
    crossings: 20,
    thicknesses: 20,
    light_groups: 2,
    splits: 2,
};

/// Names of the files in a subfolder of `shaders/`, without their extensions.
fn files_in(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(root().join("shaders").join(folder));
    let entries = entries.expect("the folder exists");
    let below = entries.flat_map(|entry| {
        let entry = entry.expect("readable");
        let path = folder.join(entry.file_name());
        if entry.path().is_dir() {
            return files_in(&path);
        }
        let name = path.with_extension("");
        [name.to_str().expect("UTF-8").replace('\\', "/")].into()
    });
    below.collect()
}

#[test]
fn every_file_is_a_module() {
    let files = files_in(Path::new(""));
    let modules: Vec<_> = MODULES
        .iter()
        .map(|module| module.name.to_owned())
        .collect();
    assert!(files.len() > 30, "few shaders found: {files:?}");
    assert_eq!(files, modules.iter().cloned().collect());
    assert_eq!(modules.len(), files.len(), "a module is in the list twice");
}

fn parsed(extra: &str) -> Result<naga::Module, String> {
    let shader = Shader::assemble(&Specialization::general(SIZES), extra);
    shader.parse().map_err(|error| error.to_string())
}

#[test]
fn all_modules_together_are_valid() {
    let module = parsed("").unwrap_or_else(|error| panic!("{error}"));
    let entry_points: BTreeSet<_> = module
        .entry_points
        .iter()
        .map(|e| e.name.as_str())
        .collect();
    assert_eq!(entry_points, ["evaluate_stacks", "render"].into());
}

#[test]
fn broken_modules_are_refused() {
    assert!(parsed("fn f() -> f32 { return 1u; }").is_err());
    assert!(parsed("fn sin_pi4(x: f32) -> f32 { return x; }").is_err());
}
