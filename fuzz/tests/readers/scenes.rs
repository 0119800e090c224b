//! Campaign for scene files.

use crate::bombs;
use crate::support::{files, root, text};
use pellicle_fuzz::{Campaign, Outcome};
use scene::{Scene, Shape};
use scene_file::SceneFile;
use std::fs;
use std::path::Path;

/// Words that mean something in a scene or in TOML.
const WORDS: [&str; 44] = [
    "true",
    "1979-05-27",
    "\"gold\"",
    "\"water\"",
    "\"\"",
    "[]",
    "{}",
    "[0, 0, 0]",
    "[1e-6, 0, 0]",
    "[nan, 1, 1]",
    "[[objects]]",
    "[camera]",
    "[render]",
    "=",
    "\"",
    "'''",
    "\"\"\"",
    ".",
    ",",
    "\n",
    "#",
    "\\u0000",
    "{ constant = 1 }",
    "{ pole = 1, equator = 2 }",
    "{ cauchy = [1.5, 0.004] }",
    "{ sellmeier = { b = [1], c_um2 = [0.3] } }",
    "{ mixture = 'bruggeman', of = [1, 'gold'], fraction = 0.5 }",
    "{ texture = 'colors.png' }",
    "{ csv = 'glass.csv' }",
    "{ yaml = 'glass.yml' }",
    "{ image = 'thickness.png', min = 100, max = 900 }",
    "{ illuminant = 'A' }",
    "{ srgb = [0.1, 0.5, 1] }",
    "{ temperature_k = 3000 }",
    "type = 'image'\nimage = 'environment.hdr'",
    "type = 'film'",
    "type = 'conductor'",
    "type = 'dielectric'",
    "type = 'diffuse'",
    "type = 'emitter'",
    "type = 'sky'",
    "roughness",
    "scale",
    "bands",
];

/// The scene with few bands per render, so that a case takes no longer than necessary.
fn quickened(scene: &[u8]) -> Vec<u8> {
    text(scene)
        .replace("[render]\n", "[render]\nbands = 2\n")
        .replace("\"tests/data/", "\"")
        .into_bytes()
}

/// Finds a fault in a scene: every number must be finite, before and after rounding, and no length may be 0.
fn fault(scene: &Scene) -> Option<String> {
    for scene in [scene, &scene.rounded_to_f32()] {
        // Without the assumptions made about files, which are words.
        let words = scene.notes().into_iter().map(|note| format!("{note:?}"));
        let text = words.fold(format!("{scene:?}"), |text, note| text.replace(&note, ""));
        for word in ["NaN", "inf"] {
            if let Some(at) = text.find(word) {
                let from = text.floor_char_boundary(at.saturating_sub(300));
                return Some(format!("a number is {word}: {}", &text[from..at]));
            }
        }
        for object in scene.objects() {
            let lengths = match object.shape {
                Shape::Sphere { radius, .. } => [radius, 1.0, 1.0],
                Shape::Plane {
                    normal, tangent, ..
                } => [normal.length(), tangent.length(), 1.0],
                Shape::Rectangle {
                    half_width,
                    half_height,
                    normal,
                    ..
                } => [half_width, half_height, normal.length()],
                Shape::Disk { radius, normal, .. } => [radius, normal.length(), 1.0],
            };
            let is_material = object.material.index() < scene.materials().len();
            if !is_material || lengths.iter().any(|&length| length <= 1e-7) {
                return Some(format!("an object: {object:?}"));
            }
        }
    }
    None
}

pub(crate) fn read(text: &str, folder: &Path) -> Outcome {
    let scene = SceneFile::parse("fuzz.toml", text, folder).and_then(|file| file.validate());
    match scene {
        Ok(scene) => match fault(&scene) {
            Some(fault) => Outcome::Unsound(fault),
            None => Outcome::ACCEPTED,
        },
        Err(problems) if problems.iter().len() == 0 => {
            Outcome::Unsound("it is refused without a problem".to_owned())
        }
        Err(problems) => Outcome::Refused(format!("{problems:#}")),
    }
}

/// A folder with the files that the words and scenes name.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["colors.png", "thickness.png", "environment.hdr"] {
        fs::copy(
            root().join("tests/data").join(name),
            folder.path().join(name),
        )
        .unwrap();
    }
    fs::write(
        folder.path().join("glass.csv"),
        "nm,n,k\n300,1.5,0\n900,1.4,0.1\n",
    )
    .unwrap();
    let yaml = "DATA:\n  - type: formula 5\n    wavelength_range: 0.3 0.9\n    coefficients: 1.5 0.004 -2\n";
    fs::write(folder.path().join("glass.yml"), yaml).unwrap();
    folder
}

#[test]
fn scene_files() {
    let folder = folder();
    let quickened = |scenes: Vec<Vec<u8>>| scenes.iter().map(|scene| quickened(scene)).collect();
    // The scenes that contain everything are prepared slowly, and bombs are long.
    let everything: Vec<_> = quickened(files("tests/src", "toml"));
    Campaign {
        seeds: quickened(files("scenes", "toml")),
        unchanged: [everything, bombs::toml()].concat(),
        words: &WORDS,
        ..Campaign::new("scene_files", 400)
    }
    .run(|bytes| read(&text(bytes), folder.path()));
}
