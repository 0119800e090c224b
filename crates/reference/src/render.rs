//! Rendering a picture in rounds of samples.

use crate::path::PathTracer;
use crate::spectral::{Found, Pixel, SpectralPath, SpectralTransport, StokesPath};
use crate::tiles::Tiles;
use crate::{PreparedScene, SimdLevel};
use scene::Scene;
use spectra::{Accumulation, Round, SpectralImage, Window};
use std::ops::{ControlFlow, Range};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use thiserror::Error;

/// The caller asked to stop.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("stopped before the picture was finished")]
pub struct Stopped;

/// Renders a scene on all cores, tile by tile.
///
/// `on_progress` receives the number of samples taken so far (of width × height × samples per pixel), and may stop the render.
///
/// # Errors
/// [`Stopped`] when the caller stops it.
pub fn render(
    scene: &Scene,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, Stopped> {
    render_at(SimdLevel::best(), scene, on_progress)
}

/// Like [`render`], at a given level of the machine's instructions.
///
/// # Errors
/// [`Stopped`] when the caller stops it.
pub fn render_at(
    level: SimdLevel,
    scene: &Scene,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, Stopped> {
    let settings = scene.settings();
    let window = scene.window();
    let mut accumulation = scene.accumulation(window, 0);
    let round = Round {
        window,
        samples: 0..settings.samples,
    };
    Session::new(level, scene).advance(&mut accumulation, &[round], on_progress)?;
    Ok(accumulation.whole_image())
}

/// A scene that is ready to be rendered in rounds.
pub struct Session<'a> {
    level: SimdLevel,
    prepared: PreparedScene<'a>,
}

/// A tile that a thread advances.
struct Task<'a> {
    window: Window,
    /// The number of its samples before, and after.
    samples: Range<u32>,
    first_sample: u32,
    /// The values of its pixels, row by row.
    rows: Vec<&'a mut [f64]>,
}

impl<'a> Session<'a> {
    /// Prepares a scene.
    pub fn new(level: SimdLevel, scene: &'a Scene) -> Self {
        Self {
            level,
            prepared: PreparedScene::new(scene),
        }
    }

    /// Returns what advances tiles on a core: with or without polarization.
    fn worker(&self) -> Box<dyn FnMut(&mut Task<'_>) + '_> {
        if self.prepared.scene.settings().polarization {
            let mut worker = Worker::<StokesPath<'_>>::new(self.level, &self.prepared);
            Box::new(move |task| worker.advance(task))
        } else {
            let mut worker = Worker::<SpectralPath<'_>>::new(self.level, &self.prepared);
            Box::new(move |task| worker.advance(task))
        }
    }

    /// Advances pixels on all cores. The rounds must not overlap, and their pixels must have the samples that they say.
    ///
    /// `on_progress` receives the number of samples of these rounds that were taken so far, and may stop them. The pixels of finished tiles
    /// are then advanced, the others not.
    ///
    /// # Errors
    /// [`Stopped`] when the caller stops it.
    ///
    /// # Panics
    /// When a round lies outside the accumulation's window, or that has other bands or light groups than the scene.
    pub fn advance(
        &self,
        accumulation: &mut Accumulation,
        rounds: &[Round],
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), Stopped> {
        let threads = rayon::current_num_threads();
        let tiles: Vec<_> = Tiles::new(rounds, threads as u32).iter().collect();
        let windows: Vec<Window> = tiles.iter().map(|(window, _)| *window).collect();
        let first_sample = accumulation.first_sample();
        let rows = accumulation.lend(&windows);
        let tasks = tiles
            .into_iter()
            .zip(rows)
            .map(|((window, samples), rows)| Task {
                window,
                samples,
                first_sample,
                rows,
            });
        let (waiting, is_stopped) = (Mutex::new(tasks), AtomicBool::new(false));
        // Our own threads: those of a pool that calls this function may all be waiting for it.
        let finished = std::thread::scope(|scope| {
            let (sender, finished) = mpsc::channel();
            for _ in 0..threads {
                let (sender, waiting, is_stopped) = (sender.clone(), &waiting, &is_stopped);
                scope.spawn(move || {
                    let mut worker = self.worker();
                    while !is_stopped.load(Ordering::Relaxed) {
                        let next = waiting
                            .lock()
                            .unwrap_or_else(PoisonError::into_inner)
                            .next();
                        let Some(mut task) = next else { return };
                        worker(&mut task);
                        // The receiver is gone if the caller has panicked.
                        if sender.send((task.window, task.samples)).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            let (mut done, mut all) = (0, Vec::with_capacity(windows.len()));
            for (window, samples) in finished {
                done += window.pixels() as u64 * samples.len() as u64;
                all.push((window, samples.end));
                if on_progress(done).is_break() {
                    is_stopped.store(true, Ordering::Relaxed);
                }
            }
            all
        });
        drop(waiting);
        for (window, samples) in finished {
            accumulation.set_counts(window, samples);
        }
        if is_stopped.into_inner() {
            return Err(Stopped);
        }
        Ok(())
    }
}

/// The result of one sample of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSample {
    /// Position of the wavelengths in their bands, in [0, 1).
    pub offset: f64,
    /// Radiance of each light group at each band's wavelength: `[light group][band]`.
    pub radiance: Vec<Vec<f64>>,
}

impl PreparedScene<'_> {
    /// Traces one sample of a pixel.
    pub fn sample(&self, pixel: [u32; 2], sample: u32) -> PathSample {
        if self.scene.settings().polarization {
            self.sample_by::<StokesPath<'_>>(pixel, sample)
        } else {
            self.sample_by::<SpectralPath<'_>>(pixel, sample)
        }
    }

    fn sample_by<'a, T: SpectralTransport<'a>>(
        &'a self,
        pixel: [u32; 2],
        sample: u32,
    ) -> PathSample {
        let mut worker = Worker::<T>::new(SimdLevel::best(), self);
        let found = worker.tracer.find(pixel, sample, worker.clamp);
        PathSample {
            offset: found.offset(),
            radiance: found.radiance().map(<[f64]>::to_vec).collect(),
        }
    }
}

impl<'a, T: SpectralTransport<'a>> PathTracer<'a, T> {
    /// Traces one sample of a pixel and returns the light that it found, scaled down to `clamp` in its brightest band.
    fn find(&mut self, pixel: [u32; 2], sample: u32, clamp: Option<f64>) -> Found<'_, 'a> {
        self.trace_path(pixel, sample);
        let mut found = self.transport.found();
        if let Some(most) = clamp {
            found.dim(most);
        }
        found
    }
}

/// The state with which a core renders.
struct Worker<'a, T> {
    tracer: PathTracer<'a, T>,
    pixel: Pixel<'a>,
    clamp: Option<f64>,
}

impl<'a, T: SpectralTransport<'a>> Worker<'a, T> {
    fn new(level: SimdLevel, prepared: &'a PreparedScene<'a>) -> Self {
        let content = prepared.scene.content();
        let path = T::of_scene(level.0, prepared);
        Self {
            tracer: PathTracer::new(prepared, path),
            pixel: Pixel::new(level.0, &prepared.tables, content),
            clamp: prepared.scene.settings().clamp,
        }
    }

    fn advance(&mut self, task: &mut Task<'_>) {
        let [left, top] = task.window.origin;
        for (y, row) in (top..).zip(&mut task.rows) {
            let pixels = row.chunks_exact_mut(self.pixel.len());
            for (x, values) in (left..).zip(pixels) {
                self.pixel.load(values, task.samples.start);
                for sample in task.samples.clone() {
                    let found = self
                        .tracer
                        .find([x, y], task.first_sample + sample, self.clamp);
                    self.pixel.add(&found);
                }
                self.pixel.save(values);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All threads of a pool may render at once.
    #[test]
    fn renders_do_not_wait_for_the_pool_that_they_are_called_from() {
        use rayon::prelude::*;
        let text = "camera = { type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }\n\
             environment = { type = 'constant', emission = { constant = 1 } }\n\
             render = { bands = 1, size = [8, 8], samples = 1 }\n";
        let file = scene_file::SceneFile::parse("empty.toml", text, std::path::Path::new(""));
        let scene = file
            .and_then(|file| file.validate())
            .unwrap_or_else(|e| panic!("{e}"));
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(2)
            .build()
            .unwrap();
        let sums: Vec<f32> = pool.install(|| {
            let render = |_| render(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
            let images = (0..6).into_par_iter().map(render);
            images.map(|image| image.radiance().iter().sum()).collect()
        });
        assert_eq!(sums, [64.0; 6]);
    }
}
