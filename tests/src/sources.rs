//! The project's own texts: sources, scenes, tables and pages.

use std::path::{Path, PathBuf};

/// The root of the workspace.
pub fn root() -> PathBuf {
    let tests = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    tests.parent().map_or(tests.clone(), PathBuf::from)
}

/// A file of the project.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its path from the root of the workspace, with `/`.
    pub path: String,
    /// Its content.
    pub text: String,
}

impl Source {
    /// Whether the file name ends in `.` and `ending`.
    pub fn ends_in(&self, ending: &str) -> bool {
        Path::new(&self.path)
            .extension()
            .is_some_and(|found| found == ending)
    }
}

const FOLDERS: &[&str] = &[
    "crates",
    "docs",
    "fuzz/src",
    "fuzz/tests",
    "scenes",
    "shaders",
    "tests",
];
const ENDINGS: &[&str] = &["csv", "json", "md", "py", "rs", "sh", "toml", "wgsl"];

/// All files that people wrote, in the root and the project's folders. The generated inputs of the fuzzing corpus are left out.
///
/// # Panics
/// When a file cannot be read.
pub fn sources() -> Vec<Source> {
    let root = root();
    let mut paths = Vec::new();
    for folder in FOLDERS {
        collect(&root.join(folder), &mut paths);
    }
    paths.extend(entries(&root).into_iter().filter(|path| path.is_file()));
    let is_text = |path: &PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        ending.map_or(path.ends_with("NOTICE"), |ending| ENDINGS.contains(&ending))
    };
    let read = |path: PathBuf| Source {
        text: std::fs::read_to_string(&path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display())),
        path: path
            .strip_prefix(&root)
            .expect("the path is below the root")
            .to_string_lossy()
            .replace('\\', "/"),
    };
    paths.into_iter().filter(is_text).map(read).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) {
    for path in entries(folder) {
        if path.is_dir() {
            collect(&path, paths);
        } else {
            paths.push(path);
        }
    }
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let found =
        std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = found.map(|entry| entry.expect("readable").path()).collect();
    paths.sort();
    paths
}
