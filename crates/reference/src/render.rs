//! Rendering a whole picture.

use crate::path::PathTracer;
use crate::spectral::{Pixel, PixelValues, SpectralPath};
use crate::{PreparedScene, SimdLevel};
use scene::Scene;
use spectra::SpectralImage;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc;
use thiserror::Error;

/// The caller asked to stop.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("stopped before the picture was finished")]
pub struct Stopped;

/// Side of a tile in pixels, a power of two. Tiles keep neighboring pixels together, because they see neighboring parts of the scene.
const TILE: u32 = 16;
/// The least number of tiles per thread; tiles of small pictures are made smaller for it.
const TILES_OF_A_THREAD: u32 = 4;

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
    let prepared = PreparedScene::new(scene);
    let light_groups = scene.light_groups().to_vec();
    let (width, height) = (settings.width, settings.height);
    let mut image = SpectralImage::with_light_groups(width, height, settings.bands, light_groups);
    let (next, is_stopped) = (AtomicU32::new(0), AtomicBool::new(false));
    let threads = rayon::current_num_threads();
    let tiles = Tiles::new(width, height, threads as u32);
    // Our own threads: those of a pool that calls this function may all be waiting for it.
    std::thread::scope(|scope| {
        let (sender, finished) = mpsc::channel();
        for _ in 0..threads {
            let (sender, prepared, next, is_stopped) =
                (sender.clone(), &prepared, &next, &is_stopped);
            scope.spawn(move || {
                let mut worker = Worker::new(level, prepared);
                while !is_stopped.load(Ordering::Relaxed) {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= tiles.count() {
                        break;
                    }
                    let tile = tiles.tile(index);
                    // The receiver is gone if the caller has panicked.
                    if sender.send(worker.rendered(tile)).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        let mut done = 0;
        for (tile, values) in finished {
            tile.store(&values, &mut image, settings.samples);
            done += tile.pixels().count() as u64 * u64::from(settings.samples);
            if on_progress(done).is_break() {
                is_stopped.store(true, Ordering::Relaxed);
                return Err(Stopped);
            }
        }
        Ok(())
    })?;
    Ok(image)
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
        let mut worker = Worker::new(SimdLevel::best(), self);
        worker.trace_path(pixel, sample);
        let path = &worker.tracer.transport;
        PathSample {
            offset: path.offset(),
            radiance: path.radiance().map(<[f64]>::to_vec).collect(),
        }
    }
}

/// The state with which a core renders.
struct Worker<'a> {
    tracer: PathTracer<'a, SpectralPath<'a>>,
    pixel: Pixel<'a>,
    samples: u32,
    clamp: Option<f64>,
}

impl<'a> Worker<'a> {
    fn new(level: SimdLevel, prepared: &'a PreparedScene<'a>) -> Self {
        let settings = prepared.scene.settings();
        let light_groups = prepared.scene.light_groups().len();
        let path = SpectralPath::new(level.0, &prepared.tables, light_groups);
        Self {
            tracer: PathTracer::new(prepared, path),
            pixel: Pixel::new(level.0, &prepared.tables, light_groups),
            samples: settings.samples,
            clamp: settings.clamp,
        }
    }

    fn trace_path(&mut self, pixel: [u32; 2], sample: u32) {
        self.tracer.trace_path(pixel, sample);
        if let Some(most) = self.clamp {
            self.tracer.transport.dim(most);
        }
    }

    fn rendered(&mut self, tile: Tile) -> (Tile, PixelValues) {
        let mut values = PixelValues::default();
        for pixel in tile.pixels() {
            self.pixel.clear();
            for sample in 0..self.samples {
                self.trace_path(pixel, sample);
                self.pixel.add(&self.tracer.transport);
            }
            self.pixel.write(&mut values);
        }
        (tile, values)
    }
}

/// The tiles of a picture, counted row by row.
#[derive(Clone, Copy)]
struct Tiles {
    size: [u32; 2],
    side: u32,
}

impl Tiles {
    fn new(width: u32, height: u32, threads: u32) -> Self {
        let size = [width, height];
        let mut tiles = Self { size, side: TILE };
        while tiles.side > 1 && tiles.count() < TILES_OF_A_THREAD * threads {
            tiles.side /= 2;
        }
        tiles
    }

    fn count(&self) -> u32 {
        let [columns, rows] = self.size.map(|pixels| pixels.div_ceil(self.side));
        columns * rows
    }

    fn tile(&self, index: u32) -> Tile {
        let columns = self.size[0].div_ceil(self.side);
        let corner = [index % columns, index / columns].map(|place| place * self.side);
        let end = std::array::from_fn(|i| (corner[i] + self.side).min(self.size[i]));
        Tile { corner, end }
    }
}

/// A tile of the picture.
#[derive(Clone, Copy)]
struct Tile {
    corner: [u32; 2],
    end: [u32; 2],
}

impl Tile {
    fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        let rows = self.corner[1]..self.end[1];
        rows.flat_map(move |y| (self.corner[0]..self.end[0]).map(move |x| [x, y]))
    }

    fn store(self, values: &PixelValues, image: &mut SpectralImage, samples: u32) {
        let bands = image.bands().count() as usize;
        let groups = image.light_groups().len();
        let radiance = values.radiance.chunks_exact(groups * bands);
        let variance = values.variance.chunks_exact(bands);
        let xyz = values.xyz.chunks_exact(groups);
        for ([x, y], ((radiance, variance), xyz)) in
            self.pixels().zip(radiance.zip(variance).zip(xyz))
        {
            image.set_pixel_by_light((x, y), radiance, variance, xyz, samples);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_hold_every_pixel_once() {
        for (width, height, threads) in [(1, 1, 8), (33, 17, 2), (640, 480, 2), (5, 300, 64)] {
            let tiles = Tiles::new(width, height, threads);
            let mut pixels: Vec<_> = (0..tiles.count())
                .flat_map(|index| tiles.tile(index).pixels())
                .collect();
            pixels.sort_unstable();
            let all: Vec<_> = (0..width)
                .flat_map(|x| (0..height).map(move |y| [x, y]))
                .collect();
            assert_eq!(pixels, all);
            assert!(tiles.side == 1 || tiles.count() >= 4 * threads);
        }
        assert_eq!(Tiles::new(640, 480, 2).side, TILE);
    }

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
