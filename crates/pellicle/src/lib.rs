//! A spectral renderer for the color of thin films and metals, on the GPU and verified against `f64`.
//!
//! # Data flow of a render
//!
//! ```text
//! scenes/soap_bubble.toml
//!   -> scene_file::SceneFile  TOML as written             all errors at once, each with line and column
//!   -> scene::Scene           validated: spectra as tables over the bands, nothing left to look up
//!   -> Renderer::render       paths traced on a GPU (or on the CPU in f64), spectra evaluated along them
//!   -> spectra::SpectralImage radiance per pixel and band, its variance, its XYZ
//!   -> color::develop         codes of a display -> picture_file::png   |   picture_file::spectral_exr
//! ```
//!
//! A [`scene::Scene`] comes from a file ([`scene_file::SceneFile`]) or from a [`scene_file::description::Description`] that a
//! program fills in. [`Renderer::open`] finds an adapter, [`Renderer::render`] returns a
//! [`spectra::SpectralImage`]: radiance per pixel and band, in W m⁻² sr⁻¹ nm⁻¹ up to the scene's scale. Color is computed last
//! and only in [`color`], so that a picture can be developed again without rendering again.
//!
//! ```no_run
//! use pellicle::{Backend, Renderer, color, picture_file, scene_file};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let scene = scene_file::SceneFile::read("scenes/soap_bubble.toml")?.validate()?;
//! let renderer = Renderer::open(&Backend::Auto)?;
//! let image = renderer.render(&scene, &mut |_samples_done| std::ops::ControlFlow::Continue(()))?;
//! let spectrum: &[f32] = image.pixel(320, 240); // one value per band
//! # let _ = spectrum;
//! let picture = color::develop(&image, &color::DevelopSettings::srgb(scene.settings().exposure_ev))?;
//! picture_file::png::write("soap_bubble.png".as_ref(), &picture)?;
//! # Ok(())
//! # }
//! ```
//!
//! The crates behind the modules can be used alone: [`coating`] and [`optics`] for the design of coatings, [`spectra`] for data over
//! wavelength, [`gpu`] and [`mod@reference`] for the two renderers themselves.

pub mod convergence;
pub mod pick;
mod renderer;
mod session;
pub mod stacks;
pub mod variance;

pub use coating;
pub use color;
pub use colorimetry;
pub use document;
pub use gpu;
pub use media;
pub use optics;
pub use picture_file;
pub use plot;
pub use progressive;
pub use reference;
pub use relight;
pub use renderer::{Backend, OpenError, RenderError, Renderer};
pub use scene;
pub use scene_file;
pub use session::Session;
pub use spectra;
