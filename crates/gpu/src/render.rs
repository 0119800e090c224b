//! Rendering a scene on a device in rounds of samples.

use crate::bindings::bind_scene;
use crate::error::{MAX_THICKNESSES, RenderError};
use crate::modules::Shader;
use crate::pipelines::{compile, is_kept};
use crate::tile_buffers::{PixelShape, TileBuffers};
use crate::tiles::{Division, Planner};
use crate::{DeviceError, Gpu, PackedScene, Pipeline};
use scene::Scene;
use spectra::{Accumulation, Round, SpectralImage, Window};
use std::borrow::Borrow;
use std::ops::{ControlFlow, Range};
use std::time::Instant;

/// Renders a scene.
///
/// `on_progress` receives the number of samples taken so far (of width × height × samples per pixel) after each batch, and may stop
/// the render. If the shader must be compiled first, it receives 0 before that: a driver may take seconds, some of them in the
/// first batch.
///
/// The same scene on the same adapter and driver gives the same bits, no matter how the work was divided.
///
/// # Errors
/// When the scene is too large for the device, the device fails, or the caller stops the render.
pub fn render(
    gpu: &Gpu,
    scene: &Scene,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, RenderError> {
    render_divided(gpu, scene, None, on_progress)
}

/// Like [`render`], with a given division of the work: for tests.
///
/// # Errors
/// As [`render`].
pub fn render_divided(
    gpu: &Gpu,
    scene: &Scene,
    division: Option<Division>,
    on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Result<SpectralImage, RenderError> {
    let settings = scene.settings();
    let work = Work {
        division,
        caution: 0,
    };
    let mut session = Session::new(gpu, scene, work, on_progress)?;
    let window = scene.window();
    let mut accumulation = scene.accumulation(window, 0);
    let round = Round {
        window,
        samples: 0..settings.samples,
    };
    session.advance(&mut accumulation, &[round], on_progress)?;
    Ok(accumulation.whole_image())
}

/// How work is divided among dispatches. The rendered picture does not depend on it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    /// A given division instead of the one by measured times: for tests.
    pub division: Option<Division>,
    /// 0 for the usual sizes of tiles and batches; each step makes them four times smaller. For devices that have failed.
    pub caution: u32,
}

/// A fault that a test wants to see in the midst of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InjectedFault {
    /// The device is destroyed.
    Lost,
    /// The driver reports that it is out of memory.
    OutOfMemory,
    /// The driver refuses a call.
    Refused,
}

/// A scene that is ready to be rendered in rounds on a device, which it borrows or shares.
pub struct Session<G: Borrow<Gpu>> {
    gpu: G,
    pipeline: Pipeline,
    buffers: TileBuffers,
    planner: Planner,
    fault: Option<InjectedFault>,
}

impl<G: Borrow<Gpu>> Session<G> {
    /// Packs a scene and compiles its shader. `on_progress` receives 0 before a compilation, and may stop it.
    ///
    /// # Errors
    /// When the scene is too large for the device, the device fails, or the caller stops.
    pub fn new(
        gpu: G,
        scene: &Scene,
        work: Work,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, RenderError> {
        let device = gpu.borrow();
        let settings = scene.settings();
        let packed = PackedScene::new(scene);
        let thicknesses = packed.limits.thicknesses;
        if thicknesses > MAX_THICKNESSES {
            return Err(RenderError::RecordTooLong { thicknesses });
        }
        let bindings = bind_scene(device, &packed)?;
        let made_for = packed.specialization(device.is_software());
        let shader = Shader::assemble(&made_for, "");
        if !is_kept(device, &shader, "render") && on_progress(0).is_break() {
            return Err(RenderError::Stopped);
        }
        let pipeline = compile(device, &shader, "render")?;
        let shape = PixelShape {
            groups: u64::from(settings.bands.count().div_ceil(4)),
            light_groups: u64::from(packed.limits.light_groups),
            is_polarized: scene.content().is_polarized,
        };
        let limits = device.limits();
        let largest = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let planner = Planner::new(
            [settings.width, settings.height],
            (shape.bytes(), largest),
            packed.passes_per_sample,
            (work.division, work.caution),
        );
        let pixels = u64::from(planner.max_pixels());
        let buffers = TileBuffers::new(device, (&pipeline, &bindings), pixels, shape)?;
        Ok(Self {
            gpu,
            pipeline,
            buffers,
            planner,
            fault: None,
        })
    }

    /// Makes a fault happen during the next round: for tests.
    pub fn inject(&mut self, fault: InjectedFault) {
        self.fault = Some(fault);
    }

    /// Advances pixels. The rounds must not overlap, and their pixels must have the samples that they say.
    ///
    /// `on_progress` receives the number of samples of these rounds that were taken so far, and may stop them. Pixels are advanced tile by
    /// tile: those of finished tiles keep their samples if another fails or the caller stops.
    ///
    /// # Errors
    /// When the device fails, or the caller stops.
    ///
    /// # Panics
    /// When a round lies outside the accumulation's window.
    pub fn advance(
        &mut self,
        accumulation: &mut Accumulation,
        rounds: &[Round],
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), RenderError> {
        let mut done = 0;
        for round in rounds {
            self.planner.begin(round.window);
            while let Some(tile) = self.planner.next_tile() {
                self.take(
                    accumulation,
                    (tile, round.samples.clone()),
                    &mut |samples| {
                        done += samples;
                        on_progress(done)
                    },
                )?;
            }
        }
        Ok(())
    }

    /// Takes the samples of a tile, batch by batch. `on_batch` receives the samples of a batch.
    fn take(
        &mut self,
        accumulation: &mut Accumulation,
        (tile, samples): (Window, Range<u32>),
        on_batch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), RenderError> {
        let gpu = self.gpu.borrow();
        let mut taken = samples.start;
        self.planner.goes_on(taken);
        self.buffers.upload(gpu, accumulation, tile, taken);
        while taken < samples.end {
            let count = self.planner.batch(tile, samples.end - taken);
            let first = accumulation.first_sample() + taken;
            let started = Instant::now();
            self.buffers
                .dispatch(gpu, &self.pipeline, tile, (first, count, taken));
            fail(gpu, self.fault.take())?;
            gpu.wait()?;
            self.planner.learn(tile, count, started.elapsed());
            taken += count;
            if on_batch(u64::from(count) * tile.pixels() as u64).is_break() {
                return Err(RenderError::Stopped);
            }
        }
        self.buffers.read_back(gpu, tile, samples.end, accumulation)
    }
}

/// Lets the fault happen that a test has asked for.
fn fail(gpu: &Gpu, fault: Option<InjectedFault>) -> Result<(), DeviceError> {
    let by_test = || "injected by a test".to_owned();
    match fault {
        None => Ok(()),
        Some(InjectedFault::Lost) => {
            gpu.device.destroy();
            Ok(())
        }
        Some(InjectedFault::OutOfMemory) => Err(DeviceError::OutOfMemory(by_test())),
        Some(InjectedFault::Refused) => Err(DeviceError::Refused(by_test())),
    }
}
