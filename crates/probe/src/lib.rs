//! For tests: runs WGSL over a list of cases on the machine's device, so that functions of a shader can be held against
//! their twins in double precision.
//!
//! The shader has two variables and one entry point (and more variables where it imports such, see [`Probe::run_with`]):
//!
//! ```wgsl
//! var<storage, read> cases: array<Case>;                     // any struct
//! var<storage, read_write> results: array<vec4<f32>>;        // one for each case
//!
//! @compute @workgroup_size(64)
//! fn main(@builtin(global_invocation_id) id: vec3<u32>)
//! ```

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

use std::borrow::Cow;

use tyndall_document::{Source, render_text};
use tyndall_plugin::wgpu;
use tyndall_shader::{Library, link};
use tyndall_shaders::MODULES;

/// Threads of a workgroup.
const WORKGROUP: usize = 64;

/// A shader on the machine's device.
pub struct Probe {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    /// Of each variable by name.
    bindings: Vec<(String, u32)>,
}

impl Probe {
    /// The shader, which may import the shared modules and these `files` (name and text); `constants` are the values of
    /// its overrides.
    ///
    /// # Panics
    /// Where no device answers, or the shader is wrong.
    pub fn new(shader: &str, files: &[(&str, &str)], constants: &[(&str, f64)]) -> Self {
        let instance = wgpu::Instance::default();
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("a GPU driver answers: `cargo xtask test` installs one");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).unwrap();

        let mut library = Library::default();
        for (name, text) in MODULES {
            library.insert(name, Source::new(format!("{name}.wgsl"), *text));
        }
        for (name, text) in files {
            library.insert_file(name, Source::new(*name, *text));
        }
        let linked = link(&Source::new("probe.wgsl", shader), &library)
            .unwrap_or_else(|problems| panic!("{}", render_text(&problems, false)));
        let bindings = linked.resources.iter().map(|resource| (resource.name.clone(), resource.binding)).collect();
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("probe"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(linked.module)),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("probe"),
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        Self { device, queue, pipeline, bindings }
    }

    /// The result of each of `count` cases, whose bytes are laid out as WGSL has them.
    ///
    /// # Panics
    /// Where the device fails.
    pub fn run(&self, cases: &[u8], count: usize) -> Vec<[f32; 4]> {
        self.run_with(cases, count, &[])
    }

    /// The same with the bytes of more variables by name. One that is not given is an empty list of the scene.
    ///
    /// # Panics
    /// Where the device fails.
    pub fn run_with(&self, cases: &[u8], count: usize, inputs: &[(&str, &[u8])]) -> Vec<[f32; 4]> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let filled = |bytes: &[u8]| {
            let buffer = self.buffer(bytes.len() as u64, usage);
            self.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let size = 16 * count as u64;
        let output = self.buffer(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let back = self.buffer(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let buffer = |name: &str| match (name, inputs.iter().find(|input| input.0 == name)) {
            ("cases", _) => filled(cases),
            ("results", _) => output.clone(),
            (_, Some((_, bytes))) => filled(bytes),
            _ => filled(&[0; 64]),
        };
        let buffers: Vec<(u32, wgpu::Buffer)> =
            self.bindings.iter().map(|(name, binding)| (*binding, buffer(name))).collect();
        let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
        self.queue.submit([encoder.finish()]);
        back.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
        self.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        let data = back.slice(..).get_mapped_range().unwrap();
        bytemuck::cast_slice::<u8, [f32; 4]>(&data).to_vec()
    }

    fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
        self.device.create_buffer(&descriptor)
    }
}
