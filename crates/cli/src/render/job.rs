//! One picture: what is rendered, and what is written.

use super::keeper::Keeper;
use super::{Arguments, Endurance, of_image};
use crate::develop::{self, FOV_SETTING};
use crate::memory::{self, Layout, Needs, Pictures};
use crate::output::{Outputs, is_stream, write_rows};
use crate::print;
use miette::miette;
use pellicle::Renderer;
use pellicle::picture_file::spectral_exr::{Frame, Metadata};
use pellicle::progressive::{Goal, Identity, Render};
use pellicle::relight::XyzImage;
use pellicle::scene::Scene;
use pellicle::spectra::{Accumulation, SpectralImage, Window};
use std::path::PathBuf;

/// Bytes of the strips in which an image is written.
const STRIP: usize = 16 << 20;

/// A picture to render.
pub(super) struct Job<'a> {
    pub(super) renderer: &'a Renderer,
    pub(super) scene: &'a Scene,
    pub(super) outputs: &'a Outputs,
    pub(super) developing: &'a develop::Options,
    pub(super) endurance: &'a Endurance,
    /// What precedes the messages about it.
    pub(super) heading: &'a str,
    pub(super) window: Window,
    pub(super) goal: Goal,
    pub(super) identity: Identity,
    /// How the picture fits into memory.
    pub(super) layout: Layout,
}

impl<'a> Job<'a> {
    /// Checks that the picture fits into memory.
    pub(super) fn new(
        renderer: &'a Renderer,
        scene: &'a Scene,
        (arguments, outputs): (&'a Arguments, &'a Outputs),
        heading: &'a str,
    ) -> miette::Result<Self> {
        let (endurance, developing) = (&arguments.endurance, &arguments.developing);
        let window = endurance.window(scene.settings())?;
        let needs = Needs {
            pictures: match (outputs.pictures(), developing.needs_spectra()) {
                ([], _) => Pictures::None,
                (_, false) => Pictures::OfColors,
                (_, true) => Pictures::OfSpectra,
            },
            copies: if endurance.checkpoint.is_some() { 2 } else { 1 },
            rounds: endurance.needs_rounds() || outputs.spectral().len() > 1,
        };
        let available = endurance.max_memory.unwrap_or_else(memory::available);
        let (layout, bytes) = memory::layout(scene, window, needs, available)?;
        print::note(memory::of_render(scene, bytes));
        let mut identity = Identity::new(scene, &renderer.identity());
        if endurance.adaptive {
            identity = identity.adaptive(scene.settings().samples);
        }
        Ok(Self {
            renderer,
            scene,
            outputs,
            developing,
            endurance,
            heading,
            window,
            goal: endurance.goal(scene.settings(), arguments.overrides.samples),
            identity,
            layout,
        })
    }

    /// The pixels of a window, without samples.
    pub(super) fn empty(&self, window: Window) -> Accumulation {
        self.scene.accumulation(window, self.endurance.samples_from)
    }

    /// What writes checkpoints, if they are wanted.
    pub(super) fn keeper(&self) -> Option<Keeper> {
        let path = self.endurance.checkpoint.clone()?;
        let every = self.endurance.checkpoint_every;
        Some(Keeper::new(path, every, self.identity.clone()))
    }

    /// Says how fast the render was, and what it has reached.
    pub(super) fn print_speed(&self, render: &Render, work: u64, seconds: f64) {
        let mut reached = format!("{} samples per pixel", render.level());
        if render.is_adaptive() {
            let mean = render.done() as f64 / self.window.pixels() as f64;
            reached = format!("{mean:.1} samples per pixel in the mean");
        }
        if let Some(noise) = render.noise() {
            reached += &format!(", noise {}", print::percent(noise));
        }
        self.print_pace(&reached, work, seconds);
    }

    pub(super) fn print_pace(&self, reached: &str, work: u64, seconds: f64) {
        let [width, height] = self.window.size;
        print::note(format_args!(
            "{}{width}×{height}, {} bands, {reached}: {seconds:.1} s, {:.3} million samples/s",
            self.heading,
            self.scene.settings().bands.count(),
            work as f64 / seconds.max(1e-9) * 1e-6,
        ));
    }

    /// How to go on with a render that a signal has ended.
    pub(super) fn how_to_resume(&self, render: &Render) -> String {
        let level = render.level();
        match &self.endurance.checkpoint {
            Some(path) => format!(
                "stopped at {level} samples per pixel; the same command with --resume goes on from {}",
                path.display()
            ),
            None if !self.heading.is_empty() => format!("stopped at {level} samples per pixel"),
            None => format!(
                "stopped at {level} samples per pixel; --samples-from {} renders others, to be joined by `pellicle merge`, \
                 and --checkpoint FILE keeps the state of the next render",
                u64::from(self.endurance.samples_from) + u64::from(level)
            ),
        }
    }

    /// Writes everything; `stopped_by` is what ended the render. All files are tried, and all errors printed but the last.
    pub(super) fn write(&self, render: &Render, stopped_by: String) -> miette::Result<()> {
        let all = render.accumulation();
        let mut metadata = self.metadata(render.is_mixed());
        let mut put = |name: &str, value: String| metadata.settings.insert(name.to_owned(), value);
        put("samples", render.level().to_string());
        put("stopped_by", stopped_by);
        if let Some(noise) = render.noise() {
            put("noise", format!("{noise:.6}"));
        }
        if render.is_adaptive() {
            put("adaptive", "by tiles of 16 × 16 pixels".to_owned());
        }
        // A file that cannot be written does not prevent the others.
        let spectral = self.outputs.spectral().iter().map(|path| {
            let mut strips = strips_of(all);
            let mut next = || Ok(strips.next());
            write_rows(path, self.frame(), &metadata, &mut next)
        });
        let spectral: Vec<miette::Result<()>> = spectral.collect();
        let pictures = self.write_pictures(all, false);
        print::all_but_last(spectral.into_iter().chain([pictures]))
    }

    /// Develops and writes the pictures; a preview is not reported.
    pub(super) fn write_pictures(
        &self,
        all: &Accumulation,
        is_preview: bool,
    ) -> miette::Result<()> {
        if self.outputs.pictures().is_empty() {
            return Ok(());
        }
        if self.developing.needs_spectra() {
            let mut image = all.whole_image();
            // Other lamps apply only to the pictures: the spectral image keeps the scene's.
            let mut of_image = of_image(self.scene);
            self.developing.relight(&mut image, &mut of_image)?;
            let pictures = self.pictures(is_preview);
            return self
                .developing
                .write(&image, of_image, image.height(), &pictures, is_preview);
        }
        let [width, height] = all.window().size;
        let colors = XyzImage::new(width, height, all.colors());
        let colors = colors.ok_or_else(|| miette!("the window has no colors"))?;
        self.write_colors(&colors, is_preview)
    }

    /// Develops and writes the pictures from colors alone.
    pub(super) fn write_colors(&self, colors: &XyzImage, is_preview: bool) -> miette::Result<()> {
        let (of_image, pictures) = (of_image(self.scene), self.pictures(is_preview));
        self.developing
            .write(colors, of_image, colors.height(), &pictures, is_preview)
    }

    /// The pictures to write. A pipe gets a single one.
    fn pictures(&self, is_preview: bool) -> Vec<PathBuf> {
        let all = self.outputs.pictures().iter();
        all.filter(|path| !is_preview || !is_stream(path))
            .cloned()
            .collect()
    }

    /// The place of the pixels in the picture.
    pub(super) fn frame(&self) -> Frame {
        let settings = self.scene.settings();
        Frame {
            picture: [settings.width, settings.height],
            window: self.window,
        }
    }

    /// What the spectral image records about how it was made, by the renderer alone or with the CPU's help.
    pub(super) fn metadata(&self, is_mixed: bool) -> Metadata {
        let settings = self.scene.settings();
        let (mut renderer, mut identity) = (self.renderer.description(), self.identity.clone());
        if is_mixed {
            renderer += ", then the CPU";
            identity = identity.mixed();
        }
        let said = [
            ("renderer", renderer),
            ("samples_from", self.endurance.samples_from.to_string()),
            ("seed", settings.seed.to_string()),
            ("time_s", settings.time_s.to_string()),
            ("max_path_segments", settings.max_path_segments.to_string()),
            (
                "sampling",
                format!("{:?}", settings.sampling).to_lowercase(),
            ),
        ];
        let fov = self.scene.camera().fov_deg();
        let fov = fov.map(|fov| (FOV_SETTING, format!("{fov:.6}")));
        // Record that radiance was clamped.
        let clamp = settings.clamp.map(|clamp| ("clamp", clamp.to_string()));
        let said = said.into_iter().chain(fov).chain(clamp);
        let said = said.map(|(key, value)| (key.to_owned(), value));
        Metadata {
            exposure_ev: settings.exposure_ev,
            settings: said.chain(identity.settings()).collect(),
            ..Metadata::default()
        }
    }
}

/// The images of an accumulation's rows, some at a time.
fn strips_of(all: &Accumulation) -> impl Iterator<Item = SpectralImage> + '_ {
    let [width, height] = all.window().size;
    let of_row = width as usize * 8 * all.layout().len();
    let rows = (STRIP / of_row).clamp(1, height as usize);
    (0..height)
        .step_by(rows)
        .map(move |row| all.image(row..(row + rows as u32).min(height)))
}
