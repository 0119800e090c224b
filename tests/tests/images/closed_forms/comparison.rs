//! Scenes of a few lines, and the comparison of their pictures with expected values.

use gpu::Gpu;
use pellicle_tests::tolerances::{PROVING_ERROR, Z_MEAN};
use scene::Scene;
use scene_file::SceneFile;
use spectra::SpectralImage;
use std::ops::ControlFlow;
use std::path::Path;

pub(crate) const BANDS: u32 = 4;
pub(crate) const ALBEDO: f64 = 0.7;

/// A camera that looks straight down at a square of 0.01 around the foot point.
pub(crate) const DOWN: &str = r#"
[camera]
type = "orthographic"
position = [0, 1, 0]
look_at = [0, 0, 0]
up = [0, 0, -1]
height = 0.01
"#;

pub(crate) const LAMBERT: &str = r#"
[materials.lambert]
type = "diffuse"
reflectance = 0.7

[materials.lamp]
type = "emitter"
emission = { constant = 1 }
"#;

pub(crate) const FLOOR: &str = r#"
[[objects]]
type = "plane"
material = "lambert"
point = [0, 0, 0]
normal = [0, 1, 0]
"#;

pub(crate) const WHITE: &str = r#"
[environment]
type = "constant"
emission = { constant = 1 }
"#;

pub(crate) fn render(samples: u32, segments: u32, sampling: &str) -> String {
    format!(
        "[render]\nsize = [32, 32]\nsamples = {samples}\nbands = {BANDS}\nsampling = \"{sampling}\"\nsampler = \"independent\"\nseed = 7\n\
         max_path_segments = {segments}\n"
    )
}

pub(crate) fn lamp(height: f64, radius: f64) -> String {
    format!(
        "[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0, {height:?}, 0]\nradius = {radius:?}\n"
    )
}

pub(crate) fn film(index: &str, thickness_nm: f64, object: &str) -> String {
    format!(
        "[materials.film]\ntype = \"film\"\nindex = {index}\nthickness_nm = {thickness_nm:?}\n\
         [[objects]]\nmaterial = \"film\"\n{object}\n"
    )
}

pub(crate) fn scene(parts: &[&str]) -> Scene {
    SceneFile::parse("closed form", &parts.join("\n"), Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"))
        .rounded_to_f32()
}

/// Pictures of both renderers.
pub(crate) fn pictures(gpu: &Gpu, scene: &Scene) -> [(&'static str, SpectralImage); 2] {
    let on = &mut |_| ControlFlow::Continue(());
    let on_gpu = gpu::render(gpu, scene, on).unwrap_or_else(|error| panic!("{error}"));
    let on_cpu = reference::render(scene, on).expect("nothing stops the render");
    [("gpu", on_gpu), ("cpu", on_cpu)]
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate {
    pub(crate) mean: f64,
    pub(crate) error: f64,
}

impl Estimate {
    /// The estimate for one band of a picture, with the picture's own variance.
    pub(crate) fn of(image: &SpectralImage, band: u32) -> Self {
        let bands = image.bands().count() as usize;
        let sum = |values: &[f32]| -> f64 {
            let of_band = values.iter().skip(band as usize).step_by(bands);
            of_band.map(|&x| f64::from(x)).sum()
        };
        let pixels = image.samples().len() as f64;
        Self {
            mean: sum(image.radiance()) / pixels,
            error: sum(image.variance()).sqrt() / pixels,
        }
    }

    /// Whether the mean is `expected` to within its noise and a relative allowance, and the noise is small enough to prove it.
    pub(crate) fn agrees(self, expected: f64, allowance: f64) -> Result<String, String> {
        let off = (self.mean - expected).abs();
        let report = format!(
            "{:.7} ± {:.1e}, expected {expected:.7}, relative difference {:+.1e}",
            self.mean,
            self.error,
            self.mean / expected - 1.0
        );
        let proves = self.error <= PROVING_ERROR * expected.abs();
        if proves && off <= Z_MEAN * self.error + allowance * expected.abs() {
            Ok(report)
        } else {
            Err(report)
        }
    }
}

/// Renders with both renderers and compares every band.
pub(crate) fn check(
    gpu: &Gpu,
    what: &str,
    scene: &Scene,
    allowance: f64,
    expected: impl Fn(u32) -> f64,
) {
    let mut wrong = Vec::new();
    for (who, image) in pictures(gpu, scene) {
        for band in 0..BANDS {
            match Estimate::of(&image, band).agrees(expected(band), allowance) {
                Ok(report) => println!("{what}, {who}, band {band}: {report}"),
                Err(report) => wrong.push(format!("{what}, {who}, band {band}: {report}")),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Mean of a function of the wavelength over a band.
pub(crate) fn band_mean(scene: &Scene, band: u32, f: impl Fn(f64) -> f64) -> f64 {
    let grid = scene.settings().bands;
    let steps = 400;
    let at = |i| f(grid.wavelength_nm(band, (f64::from(i) + 0.5) / f64::from(steps)));
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}
