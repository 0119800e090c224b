//! Rendering a scene on a device and reading the picture back.

use crate::bindings::bind_scene;
use crate::error::{MAX_THICKNESSES, RenderError};
use crate::modules::Shader;
use crate::pipelines::{compile, is_kept};
use crate::tile_buffers::{PixelShape, TileBuffers};
use crate::tiles::{Division, Planner};
use crate::{Gpu, PackedScene};
use scene::Scene;
use spectra::SpectralImage;
use std::ops::ControlFlow;
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
    let packed = PackedScene::new(scene);
    let thicknesses = packed.limits.thicknesses;
    if thicknesses > MAX_THICKNESSES {
        return Err(RenderError::RecordTooLong { thicknesses });
    }
    let bindings = bind_scene(gpu, &packed)?;
    let made_for = packed.specialization(gpu.is_software());
    let shader = Shader::assemble(&made_for, "");
    if !is_kept(gpu, &shader, "render") && on_progress(0).is_break() {
        return Err(RenderError::Stopped);
    }
    let pipeline = compile(gpu, &shader, "render")?;

    let shape = PixelShape {
        groups: u64::from(settings.bands.count().div_ceil(4)),
        light_groups: u64::from(packed.limits.light_groups),
    };
    let limits = gpu.limits();
    let largest = limits
        .max_storage_buffer_binding_size
        .min(limits.max_buffer_size);
    let size = [settings.width, settings.height];
    let mut planner = Planner::new(
        size,
        (shape.bytes(), largest),
        packed.passes_per_sample,
        division,
    );
    let tile_buffers = TileBuffers::new(
        gpu,
        (&pipeline, &bindings),
        u64::from(planner.max_pixels()),
        shape,
    )?;

    let light_groups = scene.light_groups().to_vec();
    let mut image = SpectralImage::with_light_groups(
        settings.width,
        settings.height,
        settings.bands,
        light_groups,
    );
    let mut done = 0;
    while let Some(tile) = planner.next_tile() {
        tile_buffers.clear(gpu, tile);
        let mut taken = 0;
        while taken < settings.samples {
            let samples = planner.batch(tile, settings.samples - taken);
            let started = Instant::now();
            tile_buffers.dispatch(gpu, &pipeline, tile, (taken, samples));
            gpu.wait()?;
            planner.learn(tile, samples, started.elapsed());
            taken += samples;
            done += u64::from(samples) * u64::from(tile.pixels());
            if on_progress(done).is_break() {
                return Err(RenderError::Stopped);
            }
        }
        tile_buffers.read_back(gpu, tile, settings.samples, &mut image)?;
    }
    Ok(image)
}
