//! `pellicle render`.

use crate::develop::{self, FOV_SETTING, ImageProperties};
use crate::output::Outputs;
use crate::progress::Progress;
use crate::{memory, print};
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::gpu::AdapterChoice;
use pellicle::picture_file::spectral_exr::Metadata;
use pellicle::scene::{RenderSettings, Scene};
use pellicle::scene_file::SceneFile;
use pellicle::spectra::SpectralImage;
use pellicle::{Backend, OpenError, Renderer};
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The scene file, or - for standard input
    scene: PathBuf,
    /// Output file: .png for a picture, .exr for a spectral image, no ending or a folder for both; can be repeated
    /// [default: both, named after the scene, in the current folder]
    #[arg(short, long, value_name = "PATH")]
    output: Vec<PathBuf>,
    /// Allow the scene to refer to files outside its folder; use this only for scenes that you trust
    #[arg(long)]
    allow_outside: bool,
    /// Device that renders: auto uses the best GPU, or the CPU if there is none
    #[arg(long, value_enum, default_value_t = BackendName::Auto)]
    backend: BackendName,
    /// Render on the adapter whose name contains this
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Render a sequence: frames FIRST up to but not including END, each `time_step_s` after the one before, with frame 0 at the
    /// scene's time. Files are numbered name_0000.png and so on, with more digits if the last frame needs them
    #[arg(long, value_name = "FIRST:END", value_parser = frames, allow_hyphen_values = true)]
    frames: Option<Range<u32>>,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    developing: develop::Options,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum BackendName {
    Auto,
    Gpu,
    Cpu,
}

/// Settings that replace the scene's own.
#[derive(clap::Args)]
struct Overrides {
    /// Samples per pixel, instead of the scene's
    #[arg(long)]
    samples: Option<u32>,
    /// Size of the picture, instead of the scene's
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Number of bands, instead of the scene's
    #[arg(long)]
    bands: Option<u32>,
    /// Seed of the random numbers, instead of the scene's
    #[arg(long)]
    seed: Option<u32>,
    /// Time in seconds, instead of the scene's; with --frames, the time of frame 0
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    time: Option<f64>,
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once(['x', '×']);
    let parsed = parts.and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    parsed.ok_or_else(|| "write a size as in 640x480".to_owned())
}

fn frames(text: &str) -> Result<Range<u32>, String> {
    let parts = text.split_once(':');
    let parsed = parts.and_then(|(first, end)| Some(first.parse().ok()?..end.parse().ok()?));
    let range: Range<u32> = parsed.ok_or("write frames as in 0:48, which is 0 to 47")?;
    if range.is_empty() {
        return Err("the second number must be larger than the first".to_owned());
    }
    Ok(range)
}

impl Overrides {
    fn apply(&self, file: &mut SceneFile) {
        let render = &mut file.description.render;
        render.samples = self.samples.unwrap_or(render.samples);
        render.size = self.size.unwrap_or(render.size);
        render.bands = self.bands.unwrap_or(render.bands);
        render.seed = self.seed.unwrap_or(render.seed);
        render.time_s = self.time.unwrap_or(render.time_s);
    }
}

impl Arguments {
    fn backend(&self) -> miette::Result<Backend> {
        match (self.backend, &self.adapter) {
            (BackendName::Cpu, Some(_)) => Err(miette!(
                help = "leave one of them out",
                "--adapter chooses a GPU, but --backend cpu uses none"
            )),
            (BackendName::Cpu, None) => Ok(Backend::Cpu),
            (_, Some(name)) => Ok(Backend::Gpu(AdapterChoice::Named(name.clone()))),
            (BackendName::Gpu, None) => Ok(Backend::Gpu(AdapterChoice::Best)),
            (BackendName::Auto, None) => Ok(Backend::Auto),
        }
    }
}

/// Renders, develops and writes.
pub(crate) fn run(arguments: &Arguments) -> miette::Result<()> {
    let mut file = SceneFile::read(&arguments.scene)?.allow_outside(arguments.allow_outside);
    arguments.overrides.apply(&mut file);
    // Report errors in the scene before opening anything.
    let scene = file.validate()?;
    print::notes(scene.notes());
    // Standard input has no name.
    let named = if arguments.scene.as_os_str() == STANDARD_INPUT {
        Path::new("render")
    } else {
        &arguments.scene
    };
    let outputs = Outputs::new(named, &arguments.output)?;
    let developing = &arguments.developing;
    developing.check(outputs.pictures(), of_image(&scene))?;
    let mut pixel = one_pixel(&scene);
    developing.relight(&mut pixel, &mut of_image(&scene))?;
    developing.check_lamps(pixel.light_groups())?;
    let renderer = Renderer::open(&arguments.backend()?).into_diagnostic()?;
    if let Renderer::Cpu {
        instead_of_gpu: Some(reason),
    } = &renderer
    {
        let reason = match reason {
            OpenError::NoAdapter => "there is no GPU".to_owned(),
            other => other.to_string(),
        };
        print::note(format_args!("rendering on the CPU: {reason}"));
    }
    print::note(format_args!("{}", renderer.description()));
    print::note(format_args!("{}", memory::of_picture(&scene)));
    match &arguments.frames {
        None => render_one(&renderer, &scene, &outputs, developing, ""),
        Some(frames) => render_frames(&renderer, file, &outputs, developing, frames.clone()),
    }
}

/// Renders a sequence. An error names its frame, and the frames before it are kept.
fn render_frames(
    renderer: &Renderer,
    mut file: SceneFile,
    outputs: &Outputs,
    developing: &develop::Options,
    frames: Range<u32>,
) -> miette::Result<()> {
    let (start_s, step_s) = {
        let render = &file.description.render;
        (render.time_s, render.time_step_s)
    };
    let (first, last) = (frames.start, frames.end - 1);
    let mut scene_of = |frame: u32| {
        file.description.render.time_s = start_s + f64::from(frame) * step_s;
        let of_frame = file.validate().map_err(miette::Report::from);
        of_frame.wrap_err_with(|| format!("frame {frame} cannot be rendered"))
    };
    // The last frame has the latest time: report an impossible one before rendering the first.
    let end = scene_of(last)?;
    if first < last && scene_of(first)?.materials() == end.materials() {
        print::note(format_args!(
            "frames {first} to {last} are the same picture: nothing in the scene changes between their times"
        ));
    }
    for frame in frames {
        let scene = scene_of(frame)?;
        let time = shown_time(scene.settings().time_s, step_s);
        let heading = format!("frame {frame} of {first} to {last} at {time} s, ");
        let outputs = outputs.of_frame(frame, last);
        render_one(renderer, &scene, &outputs, developing, &heading)
            .wrap_err_with(|| format!("frame {frame} failed"))?;
    }
    Ok(())
}

/// A time with enough digits to distinguish it from those a step before and after.
fn shown_time(time_s: f64, step_s: f64) -> String {
    let decimals = 2.0 - step_s.log10().floor();
    if !(0.0..=12.0).contains(&decimals) {
        return time_s.to_string();
    }
    let text = format!("{time_s:.*}", decimals as usize);
    match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text,
    }
}

/// Renders a picture and writes it; `heading` precedes the messages about it.
fn render_one(
    renderer: &Renderer,
    scene: &Scene,
    outputs: &Outputs,
    developing: &develop::Options,
    heading: &str,
) -> miette::Result<()> {
    let settings = scene.settings();
    let total = samples_of(settings);
    let mut progress = Progress::new(total, heading);
    let started = Instant::now();
    let mut image = renderer
        .render(scene, &mut |done| {
            progress.update(done);
            ControlFlow::Continue(())
        })
        .into_diagnostic()?;
    progress.clear();
    let seconds = started.elapsed().as_secs_f64();
    print::note(format_args!(
        "{heading}{}×{}, {} bands, {} samples per pixel: {seconds:.1} s, {:.3} million samples/s",
        settings.width,
        settings.height,
        settings.bands.count(),
        settings.samples,
        total as f64 / seconds * 1e-6,
    ));
    outputs.write_spectral(&image, &metadata(scene, renderer))?;
    // Other lamps apply only to the pictures: the spectral image keeps the scene's.
    let mut of_image = of_image(scene);
    developing.relight(&mut image, &mut of_image)?;
    developing.write(&image, of_image, image.height(), outputs.pictures())
}

/// An image of one pixel with the scene's light groups, to try what will be done to the whole image.
fn one_pixel(scene: &Scene) -> SpectralImage {
    let groups = scene.light_groups().to_vec();
    SpectralImage::with_light_groups(1, 1, scene.settings().bands, groups)
}

/// The properties of an image that developing needs.
fn of_image(scene: &Scene) -> ImageProperties {
    ImageProperties {
        exposure_ev: scene.settings().exposure_ev,
        fov_deg: scene.camera().fov_deg(),
        lamp: None,
    }
}

fn samples_of(settings: &RenderSettings) -> u64 {
    u64::from(settings.width) * u64::from(settings.height) * u64::from(settings.samples)
}

/// What the spectral image records about how it was made.
fn metadata(scene: &Scene, renderer: &Renderer) -> Metadata {
    let settings = scene.settings();
    let said = [
        ("renderer", renderer.description()),
        ("samples", settings.samples.to_string()),
        ("seed", settings.seed.to_string()),
        ("time_s", settings.time_s.to_string()),
        ("max_path_segments", settings.max_path_segments.to_string()),
        (
            "sampling",
            format!("{:?}", settings.sampling).to_lowercase(),
        ),
    ];
    let fov = scene.camera().fov_deg();
    let fov = fov.map(|fov| (FOV_SETTING, format!("{fov:.6}")));
    // Record that radiance was clamped.
    let clamp = settings.clamp.map(|clamp| ("clamp", clamp.to_string()));
    Metadata {
        exposure_ev: settings.exposure_ev,
        settings: said
            .into_iter()
            .chain(fov)
            .chain(clamp)
            .map(|(key, value)| (key.to_owned(), value))
            .collect(),
        ..Metadata::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_shown_as_finely_as_they_step() {
        for (time_s, step_s, shown) in [
            (1.0 / 24.0, 1.0 / 24.0, "0.0417"),
            (1000.0 + 5.0 / 24.0, 1.0 / 24.0, "1000.2083"),
            (2.0 / 24.0 + 1.0 / 6.0, 1.0 / 24.0, "0.25"),
            (20.0, 5.0, "20"),
            (300.0, 100.0, "300"),
            (0.0, 1e-6, "0"),
            (3e-6, 1e-6, "0.000003"),
            (12.5, 0.0, "12.5"),
            (1e6, 1e5, "1000000"),
        ] {
            assert_eq!(shown_time(time_s, step_s), shown, "{time_s} {step_s}");
        }
    }
}
