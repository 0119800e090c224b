//! Runs single WGSL functions on tables of inputs.

use gpu::modules::{RecordLimits, Shader, Specialization};
use gpu::{Gpu, PackedScene};
use std::collections::BTreeSet;
use wgpu::util::DeviceExt;

/// Marks results that the shader did not write: no function returns this value.
const UNWRITTEN: f32 = -1.234_567_9e33;

/// A shader that calls functions under test for each row of a table.
pub struct Probe<'a> {
    /// WGSL statements: `a(0)`, `a4(1)` … read the row and `put(0, x)`, `put4(1, v)` … write results; `direction_at(0)` is the unit
    /// vector with a cosine and an azimuth in turns. An integer travels as two halves of 16 bits (`integer`, `put_integer`), since
    /// the bits of a float may be flushed on the way.
    pub body: &'a str,
    /// Count of numbers in a row, and of results in a row.
    pub shape: (usize, usize),
    /// The scene behind the bindings, for functions that read one.
    pub scene: Option<&'a PackedScene>,
}

const SMALL: RecordLimits = RecordLimits {
    vertices: 2,
    crossings: 1,
    thicknesses: 1,
    light_groups: 2,
    splits: 1,
};

impl Probe<'_> {
    fn shader(&self, gpu: Option<&Gpu>) -> Shader {
        let (arity, results) = self.shape;
        let direction = if self.body.contains("direction_at(") {
            "fn direction_at(i: u32) -> vec3f {
                 return vec3f(sqrt(1.0 - a(i) * a(i)) * direction_of_turn(a(i + 1u)), a(i));
             }\n"
        } else {
            ""
        };
        let extra = format!(
            "@group(2) @binding(0) var<storage, read> probe_in: array<f32>;\n\
             @group(2) @binding(1) var<storage, read_write> probe_out: array<f32>;\n\
             var<private> row: u32;\n\
             fn a(i: u32) -> f32 {{ return probe_in[row * {arity}u + i]; }}\n\
             fn integer(i: u32) -> u32 {{ return u32(a(i)) | (u32(a(i + 1u)) << 16u); }}\n\
             fn a3(i: u32) -> vec3f {{ return vec3f(a(i), a(i + 1u), a(i + 2u)); }}\n\
             fn a4(i: u32) -> vec4f {{ return vec4f(a3(i), a(i + 3u)); }}\n\
             fn put(i: u32, x: f32) {{ probe_out[row * {results}u + i] = x; }}\n\
             fn put_integer(i: u32, x: u32) {{ put(i, f32(x & 0xffffu)); put(i + 1u, f32(x >> 16u)); }}\n\
             fn put3(i: u32, v: vec3f) {{ put(i, v.x); put(i + 1u, v.y); put(i + 2u, v.z); }}\n\
             fn put4(i: u32, v: vec4f) {{ put3(i, v.xyz); put(i + 3u, v.w); }}\n\
             {direction}\
             @compute @workgroup_size(64) fn probe(@builtin(global_invocation_id) id: vec3u) {{\n\
                 row = id.x + id.y * 65535u * 64u;\n\
                 if (row * {arity}u >= arrayLength(&probe_in)) {{ return; }}\n{}\n}}\n",
            self.body
        );
        let made_for = match (self.scene, gpu) {
            (None, _) => Specialization::general(SMALL),
            (Some(scene), Some(gpu)) => scene.specialization(gpu.is_software()),
            (Some(scene), None) => Specialization::general(scene.limits),
        };
        Shader::assemble(&made_for, &extra)
    }

    /// The functions that the probe can call, directly or through others, whatever the scene contains.
    ///
    /// # Panics
    /// When the probe is not valid WGSL.
    pub fn reach(&self) -> BTreeSet<String> {
        let module = self.shader(None).parse();
        let module = module.unwrap_or_else(|error| panic!("{error}"));
        let probe = module.entry_points.iter().find(|e| e.name == "probe");
        let mut called = BTreeSet::new();
        let mut open = calls_of(&probe.expect("declared above").function.body);
        while let Some(handle) = open.pop() {
            let function = &module.functions[handle];
            if called.insert(function.name.clone().unwrap_or_default()) {
                open.extend(calls_of(&function.body));
            }
        }
        called
    }

    /// Runs the probe over a table of rows and returns the rows of results.
    ///
    /// # Panics
    /// When the device fails or a result was not written.
    pub fn run(&self, gpu: &Gpu, table: &[f32]) -> Vec<f32> {
        let (arity, results) = self.shape;
        assert!(
            !table.is_empty() && table.len().is_multiple_of(arity),
            "the table does not consist of whole rows"
        );
        let rows = table.len() / arity;
        let shader = self.shader(Some(gpu));
        let pipeline =
            gpu::compile(gpu, &shader, "probe").unwrap_or_else(|error| panic!("{error}"));
        let (device, queue) = gpu.device();
        let storage = |contents: &[f32], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(contents),
                usage: wgpu::BufferUsages::STORAGE | usage,
            })
        };
        let input = storage(table, wgpu::BufferUsages::empty());
        let output = storage(
            &vec![UNWRITTEN; rows * results],
            wgpu::BufferUsages::COPY_SRC,
        );
        let staging = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: output.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let tables = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.compute().get_bind_group_layout(2),
            entries: &[&input, &output]
                .map(|b: &wgpu::Buffer| b.as_entire_binding())
                .into_iter()
                .zip(0..)
                .map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource })
                .collect::<Vec<_>>(),
        });
        let scene = self.scene.map(|packed| {
            let bindings = gpu::bind_scene(gpu, packed).unwrap_or_else(|error| panic!("{error}"));
            bindings.group(gpu, &pipeline)
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline.compute());
            if let Some(scene) = &scene {
                pass.set_bind_group(0, scene, &[]);
            }
            pass.set_bind_group(2, &tables, &[]);
            let groups = rows.div_ceil(64) as u32;
            pass.dispatch_workgroups(groups.min(65535), groups.div_ceil(65535), 1);
        }
        encoder.copy_buffer_to_buffer(&output, 0, &staging, 0, output.size());
        queue.submit([encoder.finish()]);
        staging.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        gpu.wait().unwrap_or_else(|error| panic!("{error}"));
        let mapped = staging
            .slice(..)
            .get_mapped_range()
            .expect("the results can be read");
        let found: Vec<f32> = bytemuck::cast_slice(&mapped).to_vec();
        let unwritten = found
            .iter()
            .filter(|x| x.to_bits() == UNWRITTEN.to_bits())
            .count();
        assert_eq!(unwritten, 0, "the shader did not write all results");
        found
    }
}

/// The functions that a block calls.
fn calls_of(block: &naga::Block) -> Vec<naga::Handle<naga::Function>> {
    let mut found = Vec::new();
    for statement in block {
        match statement {
            naga::Statement::Call { function, .. } => found.push(*function),
            naga::Statement::Block(inner) => found.extend(calls_of(inner)),
            naga::Statement::If { accept, reject, .. } => {
                found.extend(calls_of(accept));
                found.extend(calls_of(reject));
            }
            naga::Statement::Switch { cases, .. } => {
                for case in cases {
                    found.extend(calls_of(&case.body));
                }
            }
            naga::Statement::Loop {
                body, continuing, ..
            } => {
                found.extend(calls_of(body));
                found.extend(calls_of(continuing));
            }
            _ => {}
        }
    }
    found
}
