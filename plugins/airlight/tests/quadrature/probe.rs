//! Runs shared WGSL over a list of cases.

use std::borrow::Cow;

use tyndall_document::Source;
use tyndall_plugin::wgpu;
use tyndall_shader::{Library, link};
use tyndall_shaders::MODULES;

/// A compute shader on a device: it reads `cases`, and whatever else is given, and writes a `vec4<f32>` of `results` for
/// each. Its workgroups have 64 threads.
pub struct Probe {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    bindings: Vec<(String, u32)>,
}

impl Probe {
    /// `constants` are the values of its overrides.
    pub fn new(shader: &str, constants: &[(&str, f64)]) -> Self {
        let instance = wgpu::Instance::default();
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("a GPU driver answers: `cargo xtask test` installs one");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).unwrap();

        let mut library = Library::default();
        for (name, text) in MODULES {
            library.insert(name, Source::new(format!("{name}.wgsl"), *text));
        }
        let linked = link(&Source::new("probe.wgsl", shader), &library)
            .unwrap_or_else(|problems| panic!("{}", tyndall_document::render_text(&problems, false)));
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

    /// The results of `count` cases; `inputs` are the shader's other variables by name.
    pub fn run(&self, inputs: &[(&str, Vec<u8>)], count: usize) -> Vec<[f32; 4]> {
        let size = 16 * count as u64;
        let output = self.buffer(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let back = self.buffer(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = |name: &str| {
            let Some((_, bytes)) = inputs.iter().find(|input| input.0 == name) else { return output.clone() };
            let buffer = self.buffer((bytes.len() as u64).next_multiple_of(16), usage);
            self.queue.write_buffer(&buffer, 0, bytes);
            buffer
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
            pass.dispatch_workgroups((count as u32).div_ceil(64), 1, 1);
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
