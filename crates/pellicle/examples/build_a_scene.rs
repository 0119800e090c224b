//! 2. A scene made by a program: a row of soap films, each 60 nm thicker than the last.
//!
//! `cargo run --release --example build_a_scene [FOLDER]`

use pellicle::color::{self, DevelopSettings};
use pellicle::scene_file::description::{
    Camera, Description, Emission, Environment, Filter, Index, Material, Object, Render, Strength,
    Thickness,
};
use pellicle::{Backend, Renderer};
use std::error::Error;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Number of films.
const COUNT: u32 = 8;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(std::env::temp_dir, PathBuf::from);

    // The types are those of a scene file, field by field.
    let mut description = Description {
        camera: Camera::Orthographic {
            position: [0.0, 0.0, 2.0],
            look_at: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            height: 1.0,
            filter: Filter::default(),
            polarizer: None,
        },
        render: Render {
            size: [8 * COUNT, 8],
            samples: 256,
            // White is a surface that reflects a tenth of the light: log2(72 983 / 100).
            exposure_ev: (72_983.0_f64 / 100.0).log2(),
            ..Render::default()
        },
        materials: [].into(),
        objects: Vec::new(),
        lights: Vec::new(),
        environment: Some(Environment::Constant {
            emission: Emission::illuminant("D65", Strength::luminance_cd_m2(1000.0)),
            light_group: None,
        }),
    };
    for i in 0..COUNT {
        let name = format!("film {i}");
        let film = Material::film(
            Index::Name("water".to_owned()),
            Thickness::Constant(120.0 + 60.0 * f64::from(i)),
        );
        description.materials.insert(name.clone(), film);
        description.objects.push(wall(&name, i, 0.0));
    }
    // Black sheets absorb what the films transmit.
    let black = Material::conductor(Index::Real(1.0));
    description.materials.insert("black".to_owned(), black);
    for i in 0..COUNT {
        description.objects.push(wall("black", i, -0.5));
    }

    // Validation reports all errors at once; files would be looked up in the folder given here.
    let scene = scene_file::validate(&description, Path::new("."))?;
    let renderer = Renderer::open(&Backend::Auto)?;
    let image = renderer.render(&scene, &mut |_samples| ControlFlow::Continue(()))?;

    let path = folder.join("build_a_scene.png");
    let picture = color::develop(&image, &DevelopSettings::srgb(scene.settings().exposure_ev))?;
    picture_file::png::write(&path, &picture)?;
    for i in 0..COUNT {
        let thickness = 120 + 60 * i;
        println!("{thickness} nm: sRGB {:?}", picture.pixel(8 * i + 4, 4));
    }
    println!("wrote {}", path.display());
    Ok(())
}

/// A unit square at the i-th position of the row.
fn wall(material: &str, i: u32, z: f64) -> Object {
    Object::Rectangle {
        material: material.to_owned(),
        center: [f64::from(i) - 0.5 * f64::from(COUNT - 1), 0.0, z],
        normal: [0.0, 0.0, 1.0],
        size: [1.0, 1.0],
        up: None,
    }
}
