//! The examples run, as programs. `cargo test -p pellicle` builds them first; with `--test examples` alone, cargo builds none.

use pellicle::picture_file::spectral_exr;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The path of an example. This test is `target/<profile>/deps/<name>`, and cargo puts examples beside that folder.
fn program(name: &str) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let profile = test.parent().and_then(Path::parent).unwrap();
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let program = profile.join("examples").join(file);
    assert!(
        program.is_file(),
        "{} is not built: `cargo build -p pellicle --examples` builds it, with the profile of this test",
        program.display()
    );
    program
}

/// What an example prints.
fn run(name: &str, arguments: &[&Path]) -> String {
    let output = Command::new(program(name)).args(arguments).output();
    let output = output.unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    String::from_utf8(output.stdout).unwrap()
}

fn assert_says(text: &str, words: &[&str]) {
    for words in words {
        assert!(text.contains(words), "{words:?} is not in\n{text}");
    }
}

#[test]
fn a_scene_is_built() {
    let folder = TempDir::new().unwrap();
    run("build_a_scene", &[folder.path()]);
    let picture = image::open(folder.path().join("build_a_scene.png")).unwrap();
    let picture = picture.into_rgb8();
    // Eight films of different thickness have different colors.
    let colors: BTreeSet<_> = (0..8).map(|i| picture.get_pixel(8 * i + 4, 4).0).collect();
    assert_eq!(colors.len(), 8, "{colors:?}");
    assert!(!colors.contains(&[0; 3]), "{colors:?}");
}

#[test]
fn a_scene_file_is_rendered_and_a_pixel_is_read() {
    let folder = TempDir::new().unwrap();
    let wedge = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/film_wedge.toml");
    run("render_scene_file", &[&wedge, folder.path()]);
    assert!(folder.path().join("render_scene_file.png").is_file());

    let path = folder.path().join("render_scene_file.exr");
    let (image, _) = spectral_exr::read(&path).unwrap();
    let said = run("read_a_pixel", &[&path, "3".as_ref(), "2".as_ref()]);
    assert_says(&said, &["pixel (3, 2), 4 samples", "XYZ"]);
    for &radiance in image.pixel(3, 2) {
        assert_says(&said, &[&format!("{radiance:.5e}")]);
    }
}

#[test]
fn a_pixel_of_a_picture_made_for_it_is_read() {
    let said = run("read_a_pixel", &[]);
    assert_says(&said, &["pixel (16, 4)", "XYZ"]);
}
