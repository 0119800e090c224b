//! 1. From a scene file to a picture and a spectral image.
//!
//! `cargo run --release --example render_scene_file [SCENE [FOLDER]]`

use pellicle::color::{self, DevelopSettings};
use pellicle::picture_file::spectral_exr::{self, Metadata, WriteOptions};
use pellicle::scene_file::SceneFile;
use pellicle::{Backend, Renderer};
use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/film_wedge.toml");
    let scene = arguments.next().unwrap_or(shipped);
    let folder = arguments.next().unwrap_or_else(std::env::temp_dir);

    // The contents of the file can be changed before it is validated, as the options of the command do.
    let mut file = SceneFile::read(scene)?;
    file.description.render.size = [64, 16];
    file.description.render.samples = 4;
    let scene = file.validate()?;

    // The best adapter, or the CPU if there is no driver.
    let renderer = Renderer::open(&Backend::Auto)?;
    println!("{}", renderer.description());
    // The closure receives the samples taken so far; `Break` would stop the render.
    let image = renderer.render(&scene, &mut |_samples| ControlFlow::Continue(()))?;

    // The spectral image keeps everything; the picture is developed from it.
    let exposure_ev = scene.settings().exposure_ev;
    let metadata = Metadata {
        exposure_ev,
        ..Metadata::default()
    };
    let exr = folder.join("render_scene_file.exr");
    spectral_exr::write(&exr, &image, &metadata, WriteOptions::default())?;
    let png = folder.join("render_scene_file.png");
    let picture = color::develop(&image, &DevelopSettings::srgb(exposure_ev))?;
    picture_file::png::write(&png, &picture)?;
    println!("wrote {} and {}", exr.display(), png.display());
    Ok(())
}
