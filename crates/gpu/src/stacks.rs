//! Evaluation of many film stacks at many angles and wavelengths on a device, in `f32`.

use crate::layout::bindings::{
    RUN_COSINES, RUN_LAYERS, RUN_MEDIA, RUN_POWERS, RUN_STACKS, RUN_WAVELENGTHS, STACK_GROUP,
    STACK_RUN,
};
use crate::layout::{RunLayer, RunStack, STACK_WORKGROUP, StackRun};
use crate::modules::{RecordLimits, Shader, Specialization};
use crate::{DeviceError, Gpu, compile};
use std::time::{Duration, Instant};
use thiserror::Error;
use wgpu::util::DeviceExt;

/// Stacks to be evaluated at each of `cosines` and each of `wavelengths_nm`.
#[derive(Clone, Copy, Debug)]
pub struct StackBatch<'a> {
    /// Wavelengths in vacuum, nm, > 0.
    pub wavelengths_nm: &'a [f64],
    /// Cosines of the angle of incidence, in the incident medium, in (0, 1].
    pub cosines: &'a [f64],
    /// Index of the incident medium, real, > 0.
    pub incident: f64,
    /// `[n, k]` of the other media: `[medium][wavelength]` if `is_dispersive`, otherwise one pair per medium.
    pub media: &'a [[f64; 2]],
    /// Whether media have an index at each wavelength.
    pub is_dispersive: bool,
    /// The layers of all stacks: medium and thickness in nm.
    pub layers: &'a [(u32, f64)],
    /// The stacks.
    pub stacks: &'a [RunStack],
}

/// Powers of a stack, at one angle and wavelength: R_s, R_p, T_s, T_p.
pub type StackPowers = [f32; 4];

/// The maximum number of layers of one stack: a driver that guards against hanging shaders could stop a longer loop.
pub const MAX_BATCH_LAYERS: u32 = 1024;

/// Why a batch of stacks was not evaluated.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum StackError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A stack has too many layers.
    #[error("stack {stack} has {layers} layers; on a GPU there can be at most {MAX_BATCH_LAYERS}")]
    TooManyLayers {
        /// Index of the stack.
        stack: usize,
        /// Number of its layers.
        layers: u32,
    },
    /// An index is out of range.
    #[error("{what} {index} does not exist; there are {count}")]
    Missing {
        /// The kind of thing that the index refers to.
        what: &'static str,
        /// The index.
        index: u64,
        /// The number of things of this kind.
        count: u64,
    },
    /// A table is larger than the device can bind at once.
    #[error(
        "the batch's {what} take {bytes} bytes, but this adapter binds at most {limit} at once; divide the batch"
    )]
    TooLarge {
        /// The table that is too large.
        what: &'static str,
        /// Its size.
        bytes: u64,
        /// The largest possible size.
        limit: u64,
    },
}

impl StackBatch<'_> {
    fn media_count(&self) -> usize {
        let each = if self.is_dispersive {
            self.wavelengths_nm.len()
        } else {
            1
        };
        self.media.len() / each.max(1)
    }

    fn check(&self) -> Result<(), StackError> {
        let exists = |what, index: u64, count: usize| {
            let count = count as u64;
            if index < count {
                return Ok(());
            }
            Err(StackError::Missing { what, index, count })
        };
        for &(medium, _) in self.layers {
            exists("medium", u64::from(medium), self.media_count())?;
        }
        for (stack, of) in self.stacks.iter().enumerate() {
            exists("medium", u64::from(of.substrate), self.media_count())?;
            if of.layer_count > MAX_BATCH_LAYERS {
                let layers = of.layer_count;
                return Err(StackError::TooManyLayers { stack, layers });
            }
            if of.layer_count > 0 {
                let last = u64::from(of.first_layer) + u64::from(of.layer_count) - 1;
                exists("layer", last, self.layers.len())?;
            }
        }
        Ok(())
    }

    /// Returns the media as the shader reads them: n in groups of four wavelengths, then k.
    fn packed_media(&self) -> Vec<[f32; 4]> {
        let each = if self.is_dispersive {
            self.wavelengths_nm.len()
        } else {
            1
        };
        let rows = self.media.chunks(each.max(1));
        rows.flat_map(|row| {
            [0, 1].into_iter().flat_map(move |part| {
                let values: Vec<f32> = row.iter().map(|index| index[part] as f32).collect();
                in_fours(&values)
            })
        })
        .collect()
    }
}

/// Returns numbers in groups of four, the last group padded with the last number.
fn in_fours(values: &[f32]) -> Vec<[f32; 4]> {
    let groups = values.chunks(4);
    groups
        .map(|group| std::array::from_fn(|lane| group[lane.min(group.len() - 1)]))
        .collect()
}

/// Returns R and T for s and p of every stack, at every angle and wavelength: `[stack][angle][wavelength]`.
///
/// In `f32`: relative to `f64`, R and T of ordinary stacks up to 2 µm seen from air are within 5e-5 up to 88° and 3e-4 beyond.
/// Sharp resonances lose more: films beyond 10 µm (3e-4), stacks of 64 layers (1e-3), a substrate at its critical angle. The work
/// is divided into runs short enough for any driver.
///
/// # Errors
/// When an index refers to no medium or layer, a stack has more than [`MAX_BATCH_LAYERS`] layers, a table is too large for the
/// device, or the device fails.
pub fn evaluate_stacks(gpu: &Gpu, batch: &StackBatch<'_>) -> Result<Vec<StackPowers>, StackError> {
    batch.check()?;
    let per_stack = batch.wavelengths_nm.len() * batch.cosines.len();
    let mut powers = Vec::new();
    if per_stack == 0 || batch.stacks.is_empty() {
        return Ok(powers);
    }
    let limit = gpu.limits().max_storage_buffer_binding_size;
    let most = (limit / (16 * per_stack as u64)).min(batch.stacks.len() as u64) as usize;
    if most == 0 {
        let bytes = 16 * per_stack as u64;
        let what = "powers of one stack";
        return Err(StackError::TooLarge { what, bytes, limit });
    }
    let evaluator = Evaluator::new(gpu, batch, most)?;
    powers.reserve_exact(per_stack * batch.stacks.len());
    // A first guess of about ten thousand evaluations; then as many as take about a tenth of a second.
    let mut count = (20_000 / per_stack).clamp(1, most);
    let mut first = 0;
    while first < batch.stacks.len() {
        count = count.min(batch.stacks.len() - first);
        let started = Instant::now();
        evaluator.run(gpu, batch, (first, count), &mut powers)?;
        first += count;
        count = next_count(count, started.elapsed()).clamp(1, most);
    }
    Ok(powers)
}

/// Returns the number of stacks of the next run, after a run of `count` took `elapsed`.
fn next_count(count: usize, elapsed: Duration) -> usize {
    const AIM_S: f64 = 0.1;
    let factor = (AIM_S / elapsed.as_secs_f64().max(1e-4)).clamp(0.25, 8.0);
    (count as f64 * factor) as usize
}

/// The pipeline with the batch's tables on the device.
struct Evaluator {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    run: wgpu::Buffer,
    powers: wgpu::Buffer,
    staging: wgpu::Buffer,
}

impl Evaluator {
    fn new(gpu: &Gpu, batch: &StackBatch<'_>, most_stacks: usize) -> Result<Self, StackError> {
        let made_for = Specialization::general(RecordLimits::MIN);
        let shader = Shader::assemble(&made_for, "");
        let pipeline = compile(gpu, &shader, "evaluate_stacks")?.compute;
        let wavelengths: Vec<f32> = batch.wavelengths_nm.iter().map(|&nm| nm as f32).collect();
        let cosines: Vec<f32> = batch.cosines.iter().map(|&c| c as f32).collect();
        let layers: Vec<RunLayer> = batch
            .layers
            .iter()
            .map(|&(medium, nm)| RunLayer {
                medium,
                thickness_nm: nm as f32,
            })
            .collect();
        let limit = gpu.limits().max_storage_buffer_binding_size;
        let table = |what, bytes: &[u8]| {
            if bytes.len() as u64 > limit {
                let bytes = bytes.len() as u64;
                return Err(StackError::TooLarge { what, bytes, limit });
            }
            Ok(gpu
                .device()
                .0
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(what),
                    // A binding may not be empty: a list without elements gets one that nothing reads.
                    contents: if bytes.is_empty() { &[0; 16] } else { bytes },
                    usage: wgpu::BufferUsages::STORAGE,
                }))
        };
        let wavelengths = in_fours(&wavelengths);
        let media = batch.packed_media();
        let tables = [
            (
                RUN_WAVELENGTHS,
                table("wavelengths", bytemuck::cast_slice(&wavelengths))?,
            ),
            (
                RUN_COSINES,
                table("angles", bytemuck::cast_slice(&cosines))?,
            ),
            (RUN_MEDIA, table("media", bytemuck::cast_slice(&media))?),
            (RUN_LAYERS, table("layers", bytemuck::cast_slice(&layers))?),
            (
                RUN_STACKS,
                table("stacks", bytemuck::cast_slice(batch.stacks))?,
            ),
        ];
        let buffer = |label, size, usage| {
            gpu.device().0.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let per_stack = (batch.wavelengths_nm.len() * batch.cosines.len()) as u64;
        let size = 16 * per_stack * most_stacks as u64;
        let run = buffer(
            "stack run",
            size_of::<StackRun>() as u64,
            wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        );
        let powers = buffer(
            "powers",
            size,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let staging = buffer(
            "staging",
            size,
            wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        );
        let tables = tables.iter().map(|(binding, table)| (*binding, table));
        let entries: Vec<_> = [(STACK_RUN, &run), (RUN_POWERS, &powers)]
            .into_iter()
            .chain(tables)
            .map(|(binding, buffer)| binding.entry(buffer.as_entire_binding()))
            .collect();
        let group = gpu
            .device()
            .0
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("stacks"),
                layout: &pipeline.get_bind_group_layout(STACK_GROUP),
                entries: &entries,
            });
        gpu.check()?;
        Ok(Self {
            pipeline,
            group,
            run,
            powers,
            staging,
        })
    }

    /// Evaluates `count` stacks from `first` on and appends their powers.
    fn run(
        &self,
        gpu: &Gpu,
        batch: &StackBatch<'_>,
        (first, count): (usize, usize),
        found: &mut Vec<StackPowers>,
    ) -> Result<(), StackError> {
        let (device, queue) = gpu.device();
        let groups = batch.wavelengths_nm.len().div_ceil(4);
        let run = StackRun {
            wavelength_count: batch.wavelengths_nm.len() as u32,
            media_groups: if batch.is_dispersive {
                groups as u32
            } else {
                1
            },
            first_stack: first as u32,
            stack_count: count as u32,
            incident: batch.incident as f32,
            ..Default::default()
        };
        queue.write_buffer(&self.run, 0, bytemuck::bytes_of(&run));
        let items = (count * batch.cosines.len() * groups) as u64;
        let bytes = 16 * (count * batch.cosines.len() * batch.wavelengths_nm.len()) as u64;
        let mut encoder = device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(STACK_GROUP, &self.group, &[]);
            let workgroups = items.div_ceil(u64::from(STACK_WORKGROUP)) as u32;
            let wide = workgroups.min(65_535);
            pass.dispatch_workgroups(wide, workgroups.div_ceil(wide), 1);
        }
        encoder.copy_buffer_to_buffer(&self.powers, 0, &self.staging, 0, bytes);
        queue.submit([encoder.finish()]);
        self.staging
            .slice(..bytes)
            .map_async(wgpu::MapMode::Read, |_| {});
        gpu.wait()?;
        let mapped = self
            .staging
            .slice(..bytes)
            .get_mapped_range()
            .map_err(|error| DeviceError::Refused(error.to_string()))?;
        found.extend_from_slice(bytemuck::cast_slice(&mapped));
        drop(mapped);
        self.staging.unmap();
        Ok(())
    }
}
