//! How scene files are read: what becomes of valid ones, and how mistakes in others are reported.

/// Makes a test of each row: the check is called with the arguments in its parentheses.
macro_rules! cases {
    ($check:ident: $($name:ident($($argument:expr),* $(,)?);)+) => {
        $(
            #[test]
            fn $name() {
                $check($($argument),*);
            }
        )+
    };
}

mod bodies;
mod environment;
mod files;
mod folders;
mod fuzz;
mod indices;
mod layers;
mod light_groups;
mod lights;
mod pictures;
mod polarization;
mod problems;
mod schema;
mod thickness;
mod validation;

use pellicle_scene_file::{Problem, Problems, SceneFile};
use scene::Scene;
use std::path::Path;

/// A valid camera, on one line.
const CAMERA: &str =
    "camera = { type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }\n";

/// Reads a scene and validates it. Files that it names are in `folder`.
fn read(text: &str, folder: impl AsRef<Path>) -> Result<Scene, Problems> {
    SceneFile::parse("scene.toml", text, folder.as_ref())?.validate()
}

/// What a problem says: its message and its help.
fn said(problem: &Problem) -> String {
    let help = problem.help.as_deref().unwrap_or_default();
    format!("{} | {help}", problem.message)
}

/// The checksum of a chunk of a PNG file: CRC-32 of ISO 3309, bit by bit (PNG specification, annex D).
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ if sum & 1 == 1 { 0xedb8_8320 } else { 0 }
        })
    })
}
