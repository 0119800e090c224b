//! A render in rounds, on either backend, that survives the faults of a device.

use crate::{RenderError, Renderer};
use gpu::{AdapterChoice, Gpu, InjectedFault, Work};
use reference::SimdLevel;
use scene::Scene;
use spectra::{Accumulation, Round, SpectralImage};
use std::ops::ControlFlow;
use std::sync::Arc;

/// How often a device is opened again before it is given up; each time its work is cut four times finer.
const MAX_REOPENED: u32 = 3;

/// A scene that a renderer advances in rounds.
///
/// A device that fails in the midst of a round is opened again and gets smaller tiles and batches; the pixels of finished tiles are kept.
pub struct Session<'a> {
    scene: &'a Scene,
    backend: Backend<'a>,
    allow_cpu: bool,
    reopened: u32,
    has_left_gpu: bool,
    notes: Vec<String>,
    /// The number of calls of [`Session::advance`], and the faults to come in some of them.
    rounds: u32,
    faults: Vec<(InjectedFault, u32)>,
}

enum Backend<'a> {
    Gpu(Box<gpu::Session<Arc<Gpu>>>, AdapterChoice),
    Cpu(Box<reference::Session<'a>>),
}

impl<'a> Backend<'a> {
    fn gpu(
        gpu: Arc<Gpu>,
        scene: &Scene,
        caution: u32,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, gpu::RenderError> {
        let choice = AdapterChoice::Named(gpu.description().info.name.clone());
        let work = Work {
            division: None,
            caution,
        };
        let session = gpu::Session::new(gpu, scene, work, on_progress)?;
        Ok(Self::Gpu(Box::new(session), choice))
    }

    fn cpu(scene: &'a Scene) -> Self {
        let session = reference::Session::new(SimdLevel::best(), scene);
        Self::Cpu(Box::new(session))
    }
}

impl Renderer {
    /// Renders a scene. `on_progress` receives the samples taken so far, out of width × height × samples per pixel, and can
    /// stop the render. It receives 0 before a driver compiles the scene's shader, which can take seconds and last into the first
    /// batch of samples: from 0 to the next number the render is compiling. It receives no 0 on the CPU, or if the shader was
    /// compiled for an earlier picture.
    ///
    /// # Errors
    /// When the device fails, the scene is too large for it, or the caller stops the render.
    pub fn render(
        &self,
        scene: &Scene,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<SpectralImage, RenderError> {
        let settings = scene.settings();
        let window = scene.window();
        let mut accumulation = scene.accumulation(window, 0);
        let round = Round {
            window,
            samples: 0..settings.samples,
        };
        let mut session = Session::new(self, scene, on_progress)?;
        session.advance(&mut accumulation, &[round], on_progress)?;
        Ok(accumulation.whole_image())
    }
}

impl<'a> Session<'a> {
    /// Prepares a scene. `on_progress` receives 0 before a driver compiles the scene's shader, and can stop it.
    ///
    /// # Errors
    /// When the scene is too large for the device, the device fails, or the caller stops.
    pub fn new(
        renderer: &Renderer,
        scene: &'a Scene,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Self, RenderError> {
        let backend = match renderer {
            Renderer::Gpu(gpu) => Backend::gpu(Arc::clone(gpu), scene, 0, on_progress)?,
            Renderer::Cpu { .. } => Backend::cpu(scene),
        };
        Ok(Self {
            scene,
            backend,
            allow_cpu: false,
            reopened: 0,
            has_left_gpu: false,
            notes: Vec::new(),
            rounds: 0,
            faults: Vec::new(),
        })
    }

    /// Lets the CPU go on when a device has failed for good.
    #[must_use]
    pub fn allow_cpu(mut self, allow: bool) -> Self {
        self.allow_cpu = allow;
        self
    }

    /// Advances pixels. The rounds must not overlap, and their pixels must have the samples that they say. `on_progress` receives the
    /// number of samples of these rounds that were taken so far, and may stop them: finished tiles are kept.
    ///
    /// # Errors
    /// When the device fails for good, or the caller stops.
    ///
    /// # Panics
    /// When a round lies outside the accumulation's window, or that has other bands or light groups than the scene.
    pub fn advance(
        &mut self,
        accumulation: &mut Accumulation,
        rounds: &[Round],
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), RenderError> {
        self.rounds += 1;
        let mut rounds = rounds.to_vec();
        let all: u64 = rounds.iter().map(Round::work).sum();
        loop {
            let before = all - rounds.iter().map(Round::work).sum::<u64>();
            let mut progress = |done| on_progress(before + done);
            match self.try_advance(accumulation, &rounds, &mut progress) {
                Err(RenderError::Gpu(error)) => self.recover(error, on_progress)?,
                Err(stopped) => return Err(stopped),
                Ok(()) => {
                    // A device that works again may fail again, some day.
                    self.reopened = 0;
                    return Ok(());
                }
            }
            let left = |round: &Round| accumulation.rounds_to(round.window, round.samples.end);
            rounds = rounds.iter().flat_map(left).collect();
        }
    }

    fn try_advance(
        &mut self,
        accumulation: &mut Accumulation,
        rounds: &[Round],
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), RenderError> {
        self.inject_next();
        match &mut self.backend {
            Backend::Gpu(gpu, _) => Ok(gpu.advance(accumulation, rounds, on_progress)?),
            Backend::Cpu(cpu) => cpu
                .advance(accumulation, rounds, on_progress)
                .map_err(|reference::Stopped| RenderError::Stopped),
        }
    }

    /// Opens the device again, or changes to the CPU if that is allowed.
    fn recover(
        &mut self,
        error: gpu::RenderError,
        on_progress: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Result<(), RenderError> {
        let is_fault = matches!(error, gpu::RenderError::Device(_));
        if let (Backend::Gpu(_, choice), true) = (&self.backend, is_fault) {
            let choice = choice.clone();
            while self.reopened < MAX_REOPENED {
                self.reopened += 1;
                let opened = Gpu::open(&choice).ok().map(Arc::new);
                let session =
                    opened.map(|gpu| Backend::gpu(gpu, self.scene, self.reopened, on_progress));
                match session {
                    Some(Ok(backend)) => {
                        self.notes.push(format!(
                            "{error}; the device was opened again and gets less work at a time"
                        ));
                        self.backend = backend;
                        return Ok(());
                    }
                    Some(Err(gpu::RenderError::Stopped)) => return Err(RenderError::Stopped),
                    _ => {}
                }
            }
        }
        if self.allow_cpu {
            self.notes.push(format!("{error}; the CPU goes on"));
            self.backend = Backend::cpu(self.scene);
            self.has_left_gpu = true;
            return Ok(());
        }
        Err(RenderError::Gpu(error))
    }

    /// What happened since the last call, one line each.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Whether the CPU renders because a device has failed.
    pub fn has_left_gpu(&self) -> bool {
        self.has_left_gpu
    }

    /// Makes a fault happen on the device during a call of [`Session::advance`], the first of which is 1: for tests.
    pub fn inject(&mut self, fault: InjectedFault, round: u32) {
        self.faults.push((fault, round));
    }

    fn inject_next(&mut self) {
        let next = self
            .faults
            .iter()
            .position(|(_, round)| *round == self.rounds);
        if let (Some(next), Backend::Gpu(gpu, _)) = (next, &mut self.backend) {
            gpu.inject(self.faults.remove(next).0);
        }
    }
}
