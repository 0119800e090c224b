//! Pictures of all directions, absolutely: an escaped ray gets the radiance that the file has in its direction.

use colorimetry::srgb;
use glam::DVec3;
use image::{ImageBuffer, Rgb};
use pellicle_tests::device::lend;
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::tolerances::FRAMES;
use picture_file::spectral_exr::{Metadata, WriteOptions};
use relight::xyz::exposure_scale;
use scene::Scene;
use scene_file::SceneFile;
use spectra::{BandGrid, SpectralImage};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use std::path::Path;
use tempfile::TempDir;

const BANDS: u32 = 8;
/// The scene is in f32, and so are its texels; a ray to the middle of a pixel uses a neighbor with a probability of
/// this size.
const ROUNDED: f64 = 2e-5;

/// Direction of the middle of a pixel, as documented: the middle of the picture is toward −Z, its right half toward +X, its top
/// toward +Y; it is rotated about +Y from +Z toward +X.
fn toward([x, y]: [u32; 2], [width, height]: [u32; 2], rotation_deg: f64) -> DVec3 {
    let longitude = TAU * ((f64::from(x) + 0.5) / f64::from(width) - 0.5);
    let latitude = PI * (0.5 - (f64::from(y) + 0.5) / f64::from(height));
    let (up, around) = latitude.sin_cos();
    let before = DVec3::new(longitude.sin() * around, up, -longitude.cos() * around);
    let (sine, cosine) = rotation_deg.to_radians().sin_cos();
    DVec3::new(
        before.x * cosine + before.z * sine,
        before.y,
        before.z * cosine - before.x * sine,
    )
}

/// A scene with nothing but its environment, seen in parallel projection in one direction.
fn looking(direction: DVec3, folder: &Path, environment: &str, bands: u32) -> Scene {
    let up = if direction.y.abs() > 0.9 {
        "[1, 0, 0]"
    } else {
        "[0, 1, 0]"
    };
    let [x, y, z] = direction.to_array();
    let text = format!(
        "[camera]\ntype = \"orthographic\"\nposition = [0, 0, 0]\nlook_at = [{x}, {y}, {z}]\nup = {up}\nheight = 1\n\
         [render]\nsize = [4, 4]\nsamples = 16\nbands = {bands}\n[environment]\n{environment}\n"
    );
    let file = SceneFile::parse("environment.toml", &text, folder);
    let scene = file.and_then(|file| file.validate());
    scene.unwrap_or_else(|e| panic!("{e:#}")).rounded_to_f32()
}

fn on_cpu(scene: &Scene) -> SpectralImage {
    reference::render(scene, &mut |_| ControlFlow::Continue(())).expect("nothing stops the render")
}

/// Mean spectrum of all pixels.
fn mean(image: &SpectralImage) -> Vec<f64> {
    let bands = image.bands().count() as usize;
    let mut sums = vec![0.0; bands];
    let pixels = image.radiance().chunks(bands);
    let count = pixels.len() as f64;
    for pixel in pixels {
        for (sum, &value) in sums.iter_mut().zip(pixel) {
            *sum += f64::from(value) / count;
        }
    }
    sums
}

fn assert_near(what: &str, found: &[f64], expected: &[f64], allowance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().copied().fold(0.0, f64::max);
    for (found, expected) in found.iter().zip(expected) {
        let off = (found - expected).abs();
        assert!(
            off <= allowance * scale,
            "{what}: {found} instead of {expected}"
        );
    }
}

/// A spectrum that differs between all pixels and all bands.
fn spectrum_of(x: u32, y: u32) -> Vec<f32> {
    let start = 1.0 + x as f32 + 16.0 * y as f32;
    (0..BANDS)
        .map(|band| start * (1.0 + 0.25 * band as f32))
        .collect()
}

/// A folder with `a.exr`, a spectral image.
fn folder_of_spectra(size: [u32; 2]) -> TempDir {
    let folder = TempDir::new().unwrap();
    let mut picture = SpectralImage::new(size[0], size[1], BandGrid::visible(BANDS).unwrap());
    for y in 0..size[1] {
        for x in 0..size[0] {
            let spectrum = spectrum_of(x, y);
            picture.set_pixel((x, y), &spectrum, &spectrum, [1.0; 3], 1);
        }
    }
    let (metadata, options) = (Metadata::default(), WriteOptions::default());
    picture_file::spectral_exr::write(&folder.path().join("a.exr"), &picture, &metadata, options)
        .unwrap();
    folder
}

/// A rough metal, a floor and a film, lit by a spectral image: emitter sampling and escaping rays both use it.
#[test]
fn spectral_environments_light_both_renderers_equally() {
    const LIT: &str = "camera = { type = 'perspective', position = [0, 1.5, 5], look_at = [0, 0.4, 0], fov_deg = 35 }\n\
        environment = { type = 'image', image = 'a.exr', rotation_deg = 20 }\n\
        render = { size = [48, 36], samples = 16, bands = 10 }\n\
        [materials]\nfloor = { type = 'diffuse', reflectance = 0.5 }\n\
        gold = { type = 'conductor', index = 'gold', roughness = 0.2 }\n\
        soap = { type = 'film', index = 'water', thickness_nm = 400 }\n\
        [[objects]]\ntype = 'rectangle'\nmaterial = 'floor'\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [8, 8]\n\
        [[objects]]\ntype = 'sphere'\nmaterial = 'gold'\ncenter = [-0.8, 0.6, 0]\nradius = 0.6\n\
        [[objects]]\ntype = 'sphere'\nmaterial = 'soap'\ncenter = [0.8, 0.7, 0]\nradius = 0.6\n";
    let folder = folder_of_spectra([16, 8]);
    let scene = SceneFile::parse("lit.toml", LIT, folder.path())
        .and_then(|file| file.validate())
        .unwrap_or_else(|e| panic!("{e:#}"))
        .rounded_to_f32();
    let on_gpu = gpu::render(&lend(), &scene, &mut |_| ControlFlow::Continue(())).unwrap();
    let report = same_numbers(Values::of(&on_gpu), Values::of(&on_cpu(&scene)), &FRAMES);
    println!("{}", report.unwrap_or_else(|report| panic!("{report}")));
}

#[test]
fn spectra_come_back_unchanged() {
    let size = [16, 8];
    let folder = folder_of_spectra(size);
    let gpu = lend();
    for (pixel, rotation_deg) in [([3, 1], 0.0), ([8, 4], 90.0), ([15, 6], -35.0)] {
        let environment = format!(
            "type = \"image\"\nimage = \"a.exr\"\nscale = 0.5\nrotation_deg = {rotation_deg:?}"
        );
        let direction = toward(pixel, size, rotation_deg);
        let own: Vec<f64> = spectrum_of(pixel[0], pixel[1])
            .iter()
            .map(|&v| f64::from(v))
            .collect();
        let half: Vec<f64> = own.iter().map(|v| 0.5 * v).collect();
        let scene = looking(direction, folder.path(), &environment, BANDS);
        let what = format!("{pixel:?}, turned by {rotation_deg}°");
        assert_near(&what, &mean(&on_cpu(&scene)), &half, ROUNDED);
        if rotation_deg == 90.0 {
            let on_gpu = gpu::render(&gpu, &scene, &mut |_| ControlFlow::Continue(())).unwrap();
            assert_near(&what, &mean(&on_gpu), &half, ROUNDED);
        }
        // Wider bands have the mean of the narrow ones that they contain.
        let scene = looking(direction, folder.path(), &environment, BANDS / 2);
        let pairs: Vec<f64> = half
            .chunks(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .collect();
        assert_near(&what, &mean(&on_cpu(&scene)), &pairs, ROUNDED);
    }
}

/// The four quarters of the horizon, by name.
#[test]
fn directions_are_as_documented() {
    let near = |a: DVec3, b: DVec3| assert!((a - b).length() < 0.02, "{a} {b}");
    let size = [1024, 512];
    near(toward([512, 256], size, 0.0), DVec3::NEG_Z);
    near(toward([768, 256], size, 0.0), DVec3::X);
    near(toward([100, 0], size, 0.0), DVec3::Y);
    // From +Z toward +X: what was at −Z is at −X.
    near(toward([512, 256], size, 90.0), DVec3::NEG_X);
    let folder = TempDir::new().unwrap();
    let lit = |x, y| {
        if (x, y) == (6, 1) {
            Rgb([3.0_f32; 3])
        } else {
            Rgb([0.0_f32; 3])
        }
    };
    ImageBuffer::from_fn(8, 4, lit)
        .save(folder.path().join("spot.exr"))
        .unwrap();
    for rotation_deg in [0.0, 45.0, 200.0] {
        let environment = format!(
            "type = \"image\"\nimage = \"spot.exr\"\nilluminant = \"E\"\nrotation_deg = {rotation_deg:?}"
        );
        let seen = |pixel| {
            let direction = toward(pixel, [8, 4], rotation_deg);
            mean(&on_cpu(&looking(direction, folder.path(), &environment, 4)))
        };
        assert!(
            seen([6, 1]).iter().all(|&value| value > 0.1),
            "{rotation_deg}"
        );
        for dark in [[2, 1], [6, 2], [7, 1], [5, 1]] {
            assert!(
                seen(dark).iter().all(|&value| value < 1e-3),
                "{rotation_deg} {dark:?}"
            );
        }
    }
}

/// Linear (r, g, b) of a file, at the exposure of its own (1, 1, 1): the color of the ray's radiance, as upsampling promises.
#[test]
fn colors_come_back_as_colors() {
    let folder = TempDir::new().unwrap();
    let color = [0.9_f32, 0.35, 0.1];
    ImageBuffer::from_pixel(4, 2, Rgb(color))
        .save(folder.path().join("a.exr"))
        .unwrap();
    let environment = "type = \"image\"\nimage = \"a.exr\"";
    let image = on_cpu(&looking(DVec3::Z, folder.path(), environment, 40));
    let count = image.xyz().len() as f64;
    let scale = exposure_scale(0.0);
    let xyz = image.xyz().iter().fold([0.0; 3], |sum, xyz| {
        std::array::from_fn(|i| sum[i] + scale * f64::from(xyz[i]) / count)
    });
    let found = srgb::linear_from_xyz(xyz);
    assert_near("rgb", &found, &color.map(f64::from), 2e-3);
}

const ROOM: &str = r#"
[materials.red]
type = "emitter"
emission = { nm = [380, 780], values = [0.2, 1.5] }
[[objects]]
type = "rectangle"
material = "red"
center = [3, 0.4, 0]
normal = [-1, 0, 0]
size = [3, 2]
[environment]
type = "gradient"
zenith = { illuminant = "D65" }
horizon = { illuminant = "A", scale = 2 }
"#;

/// A scene seen by the panorama camera, written and read, gives the same panorama again, away from edges, where the picture is
/// bilinear between pixels.
#[test]
fn a_panorama_is_the_environment_that_it_saw() {
    let folder = TempDir::new().unwrap();
    let size = [64, 32];
    let text = format!(
        "camera = {{ type = \"panorama\", position = [0, 0, 0] }}\n\
         render = {{ size = {size:?}, samples = 64, bands = {BANDS}, sampling = \"center\" }}\n{ROOM}"
    );
    let file = SceneFile::parse("room.toml", &text, Path::new(""));
    let scene = file
        .and_then(|file| file.validate())
        .unwrap_or_else(|e| panic!("{e:#}"));
    let seen = on_cpu(&scene);
    let (metadata, options) = (Metadata::default(), WriteOptions::default());
    picture_file::spectral_exr::write(&folder.path().join("room.exr"), &seen, &metadata, options)
        .unwrap();
    let environment = "type = \"image\"\nimage = \"room.exr\"";
    // On the panel toward +X, beside it, straight up and straight down.
    for pixel in [[48, 14], [47, 16], [16, 10], [30, 1], [5, 30]] {
        let direction = toward(pixel, size, 0.0);
        let found = mean(&on_cpu(&looking(
            direction,
            folder.path(),
            environment,
            BANDS,
        )));
        let of_file: Vec<f64> = seen
            .pixel(pixel[0], pixel[1])
            .iter()
            .map(|&v| f64::from(v))
            .collect();
        assert_near(&format!("{pixel:?}"), &found, &of_file, ROUNDED);
        // It also equals the room in that direction: the mean of a pixel over its few degrees is the value at its middle within 3 %.
        let text = text.replace("type = \"panorama\", position = [0, 0, 0]", &format!(
            "type = \"orthographic\", position = [0, 0, 0], look_at = {:?}, up = [0, 0.3, 1], height = 1e-3", direction.to_array()
        ));
        let there =
            SceneFile::parse("room.toml", &text, Path::new("")).and_then(|file| file.validate());
        let there = mean(&on_cpu(&there.unwrap_or_else(|e| panic!("{e:#}"))));
        assert_near(&format!("{pixel:?}, the room"), &found, &there, 0.03);
    }
}
