//! 3. What a spectral image holds about a pixel: its spectrum, the error of that, and its color.
//!
//! `cargo run --release --example read_a_pixel [FILE.exr [X Y]]`; without a file a small picture is rendered.

use pellicle::picture_file::spectral_exr;
use pellicle::relight::xyz;
use pellicle::scene_file::SceneFile;
use pellicle::spectra::SpectralImage;
use pellicle::{Backend, Renderer};
use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let image = match arguments.first() {
        Some(path) => spectral_exr::read(Path::new(path))?.0,
        None => render()?,
    };
    let (x, y) = match &arguments[..] {
        [_, x, y, ..] => (x.parse()?, y.parse()?),
        _ => (image.width() / 2, image.height() / 2),
    };
    if x >= image.width() || y >= image.height() {
        let size = (image.width(), image.height());
        return Err(format!("there is no pixel ({x}, {y}) in an image of {size:?}").into());
    }

    // Per-band data is pixel-major: the bands of a pixel are neighbors.
    let bands = image.bands();
    let pixel = (y * image.width() + x) as usize;
    let first = pixel * bands.count() as usize;
    println!("pixel ({x}, {y}), {} samples", image.samples()[pixel]);
    println!("{:>8}  {:>12}  {:>12}", "nm", "radiance", "std. error");
    for (band, &radiance) in (0..).zip(image.pixel(x, y)) {
        // The variance is that of the mean, so its root is the standard error of the value.
        let error = image.variance()[first + band as usize].sqrt();
        let nm = bands.center_nm(band);
        println!("{nm:>8.2}  {radiance:>12.5e}  {error:>12.2e}");
    }
    let [cx, cy, cz] = image.xyz()[pixel];
    let relative = f64::from(cy) * xyz::exposure_scale(0.0);
    println!("XYZ {cx:.3} {cy:.3} {cz:.3} cd/m²; Y is {relative:.4} of the white");
    Ok(())
}

fn render() -> Result<SpectralImage, Box<dyn Error>> {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/film_wedge.toml");
    let mut file = SceneFile::read(scene)?;
    (file.description.render.size, file.description.render.bands) = ([32, 8], 20);
    let renderer = Renderer::open(&Backend::Auto)?;
    Ok(renderer.render(&file.validate()?, &mut |_| ControlFlow::Continue(()))?)
}
