//! Environments from pictures: by the angle from the top in half turns and the longitude in turns, in which the cells of the
//! table are uniform.

use super::chi_square::Experiment;
use glam::DVec3;
use image::{ImageBuffer, Rgb};
use pellicle_tests::scenes::file;
use reference::{environment_pdf, sample_environment};
use scene::{Environment, EnvironmentPicture, EnvironmentShape, Scene};
use scene_file::SceneFile;
use std::f64::consts::{PI, TAU};

pub(crate) const TESTS: usize = 3;

/// An environment of 48 × 24 pixels, all of it importance-sampled: the part brighter than the mean would be too few cells to judge.
fn painted(color: impl Fn(u32, u32) -> f32) -> Scene {
    let folder = tempfile::tempdir().expect("a folder can be created");
    let picture = ImageBuffer::from_fn(48, 24, |x, y| Rgb([color(x, y); 3]));
    picture
        .save(folder.path().join("sky.exr"))
        .expect("written");
    let text = "camera = { type = \"panorama\", position = [0, 0, 0] }\n\
                environment = { type = \"image\", image = \"sky.exr\", rotation_deg = 20 }\n\
                render = { direct_light = \"emitters\" }\n";
    let file = SceneFile::parse("painted.toml", text, folder.path());
    file.and_then(|file| file.validate())
        .unwrap_or_else(|e| panic!("{e:#}"))
}

fn picture_of(scene: &Scene) -> &EnvironmentPicture {
    match scene.environment() {
        Environment::Picture { picture, .. } => picture,
        _ => panic!("the environment is not a picture"),
    }
}

#[test]
fn pictures_are_sampled_by_environment_pdf() {
    let bright = |x, y| if (x, y) == (31, 7) { 1e6 } else { 0.0 };
    let made = file("everything_pictured")
        .validate()
        .unwrap_or_else(|e| panic!("{e:#}"));
    for (seed, name, scene) in [
        (91, "everything_pictured", made),
        (92, "one bright pixel", painted(bright)),
        (93, "a black picture", painted(|_, _| 0.0)),
    ] {
        let picture = picture_of(&scene);
        let part = EnvironmentShape::Picture(picture);
        let draw = |u: f64, v: f64| {
            let w = sample_environment(part, u, v);
            assert!((w.length() - 1.0).abs() < 1e-12);
            let longitude = w.dot(picture.right).atan2(w.dot(picture.forward));
            Some([w.y.clamp(-1.0, 1.0).acos() / PI, 0.5 + longitude / TAU])
        };
        let pdf = |down: f64, across: f64| {
            let (sine, cosine) = (PI * down).sin_cos();
            let (aside, ahead) = (TAU * (across - 0.5)).sin_cos();
            let around = picture.right * aside + picture.forward * ahead;
            environment_pdf(part, around * sine + DVec3::Y * cosine) * sine * PI * TAU
        };
        let right = Experiment {
            name: name.to_owned(),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            // Cells of up to 48 columns and up to 24 rows end where these do.
            parts: 2,
            outside: Some(0.0),
        };
        right.holds(seed);
        // Rotated by 5°.
        let turned = |down: f64, across: f64| pdf(down, (across + 1.0 / 72.0).fract());
        let wrong = Experiment {
            density: &turned,
            ..right
        };
        if name != "a black picture" {
            wrong.is_refused(seed);
        }
    }
}
