//! `pellicle render`.

mod endurance;
mod job;
mod keeper;
mod rounds;
mod strips;

use crate::develop::{self, ImageProperties};
use crate::memory::Layout;
use crate::output::Outputs;
use crate::{interrupt, print};
use clap::ValueEnum;
use endurance::Endurance;
use job::Job;
use miette::{IntoDiagnostic, WrapErr, miette};
use pellicle::document::text_file::STANDARD_INPUT;
use pellicle::gpu::AdapterChoice;
use pellicle::scene::Scene;
use pellicle::scene_file::SceneFile;
use pellicle::spectra::{Accumulation, Round, SpectralImage, Window};
use pellicle::{Backend, OpenError, RenderError, Renderer, Session};
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};

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
    endurance: Endurance,
    #[command(flatten)]
    developing: develop::Options,
}

/// How a render went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// To its end.
    Finished,
    /// Until this signal came.
    Interrupted(i32),
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
    /// The scene's time in seconds, instead of its own; with --frames, the time of frame 0
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    scene_time: Option<f64>,
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
        render.time_s = self.scene_time.unwrap_or(render.time_s);
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
pub(crate) fn run(arguments: &Arguments) -> miette::Result<Outcome> {
    let mut file = SceneFile::read(&arguments.scene)?.allow_outside(arguments.allow_outside);
    arguments.overrides.apply(&mut file);
    // Report errors in the scene before opening anything.
    let scene = file.validate()?;
    print::notes(scene.notes());
    let outputs = arguments.outputs()?;
    let (developing, endurance) = (&arguments.developing, &arguments.endurance);
    developing.check(outputs.pictures(), of_image(&scene))?;
    let mut pixel = one_pixel(&scene);
    developing.relight(&mut pixel, &mut of_image(&scene))?;
    developing.check_lamps(pixel.light_groups())?;
    if arguments.frames.is_some() && outputs.has_stream() {
        return Err(miette!(
            help = "name files, or a folder",
            "--frames: a pipe, a device or standard output cannot have one name for each frame"
        ));
    }
    endurance.check(scene.settings(), arguments.overrides.samples)?;
    if let Some(checkpoint) = &endurance.checkpoint {
        outputs.check_also("--checkpoint", checkpoint, &arguments.scene)?;
    }
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
    let sequence = Sequence {
        renderer: &renderer,
        arguments,
        outputs: &outputs,
    };
    match &arguments.frames {
        None => sequence.picture(&scene, &outputs, ""),
        Some(frames) => sequence.frames(file, frames.clone()),
    }
}

impl Arguments {
    fn outputs(&self) -> miette::Result<Outputs> {
        // Standard input has no name.
        let scene = if self.scene.as_os_str() == STANDARD_INPUT {
            Path::new("render")
        } else {
            &self.scene
        };
        let Some(part) = self.endurance.part else {
            return Outputs::new(scene, &self.output);
        };
        let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
        let own = PathBuf::from(format!("{stem}_part_{}.exr", part.file_name()));
        let asked = if self.output.is_empty() {
            std::slice::from_ref(&own)
        } else {
            &self.output
        };
        Outputs::new(scene, asked)
    }
}

/// What the pictures of a sequence share.
struct Sequence<'a> {
    renderer: &'a Renderer,
    arguments: &'a Arguments,
    outputs: &'a Outputs,
}

impl Sequence<'_> {
    fn picture(&self, scene: &Scene, outputs: &Outputs, heading: &str) -> miette::Result<Outcome> {
        let job = Job::new(self.renderer, scene, (self.arguments, outputs), heading)?;
        match job.layout {
            Layout::Whole => rounds::run(&job),
            Layout::Strips(rows) => strips::run(&job, rows),
        }
    }

    /// Renders a sequence. An error names its frame, and the frames before it are kept.
    fn frames(&self, mut file: SceneFile, frames: Range<u32>) -> miette::Result<Outcome> {
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
            let outcome = self
                .picture(&scene, &self.outputs.of_frame(frame, last), &heading)
                .wrap_err_with(|| format!("frame {frame} failed"))?;
            // A signal while a finished frame is written ends the sequence too.
            let next = match (outcome, interrupt::signal()) {
                (Outcome::Interrupted(_), _) => Some(frame),
                (Outcome::Finished, Some(_)) if frame < last => Some(frame + 1),
                _ => None,
            };
            if let (Some(frame), Some(signal)) = (next, interrupt::signal()) {
                let outcome = Outcome::Interrupted(signal);
                print::note(format_args!(
                    "render the other frames with --frames {frame}:{}",
                    last + 1
                ));
                return Ok(outcome);
            }
        }
        Ok(Outcome::Finished)
    }
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

/// Advances pixels, and prints what happens to the device.
fn advance(
    session: &mut Session<'_>,
    all: &mut Accumulation,
    rounds: &[Round],
    on_progress: &mut dyn FnMut(u64),
) -> Result<(), RenderError> {
    let advanced = session.advance(all, rounds, &mut |done| {
        on_progress(done);
        ControlFlow::Continue(())
    });
    for note in session.take_notes() {
        print::note(format_args!("warning: {note}"));
    }
    advanced
}

/// An image of one pixel with the scene's light groups, to try what will be done to the whole image.
fn one_pixel(scene: &Scene) -> SpectralImage {
    scene.accumulation(Window::whole([1, 1]), 0).whole_image()
}

/// The properties of an image that developing needs.
fn of_image(scene: &Scene) -> ImageProperties {
    ImageProperties {
        exposure_ev: scene.settings().exposure_ev,
        fov_deg: scene.camera().fov_deg(),
        lamp: None,
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
