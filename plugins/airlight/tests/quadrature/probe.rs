//! Runs the shared WGSL over a list of cases.

use std::borrow::Cow;

use tyndall_document::Source;
use tyndall_plugin::wgpu;
use tyndall_scene::layout;
use tyndall_shader::{Library, link};
use tyndall_shaders::MODULES;
use tyndall_shaders::scene::Light;

use crate::cases::Case;

const SHADER: &str = "
#import scene
#import ray
#import airlight

override nodes: u32 = 8;

struct Case {
    light: Light,
    medium: Medium,
    phase: Phase,
    origin: vec3<f32>,
    way: f32,
    direction: vec3<f32>,
}

var<storage, read> cases: array<Case>;
var<storage, read_write> results: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&cases) {
        return;
    }
    let case_ = cases[id.x];
    let ray = Ray(case_.origin, case_.direction);
    var sum = vec3<f32>(0.0);
    var cursor = Cursor(0u, 0u, 0.0);
    loop {
        let piece = airlight(cursor, case_.light, case_.medium, case_.phase, ray, case_.way, nodes);
        sum += piece.radiance;
        cursor = piece.next;
        if cursor.light >= 1u { break; }
    }
    results[id.x] = vec4<f32>(sum, 1.0);
}
";

/// The shader on a device.
pub struct Probe {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    cases: u32,
    results: u32,
}

impl Probe {
    pub fn new(nodes: u32) -> Self {
        let instance = wgpu::Instance::default();
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("a GPU driver answers: `cargo xtask test` installs one");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).unwrap();

        let mut library = Library::default();
        for (name, text) in MODULES {
            library.insert(name, Source::new(format!("{name}.wgsl"), *text));
        }
        let linked = link(&Source::new("probe.wgsl", SHADER), &library)
            .unwrap_or_else(|problems| panic!("{}", tyndall_document::render_text(&problems, false)));
        let binding = |name: &str| linked.resource(name).unwrap().binding;
        let (cases, results) = (binding("cases"), binding("results"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("probe"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(linked.module)),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("probe"),
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("nodes", f64::from(nodes))],
                ..Default::default()
            },
            cache: None,
        });
        Self { device, queue, pipeline, cases, results }
    }

    /// Airlight of each case, W/(sr m²).
    pub fn run(&self, cases: &[Case]) -> Vec<[f32; 3]> {
        let bytes: Vec<u8> = cases.iter().flat_map(bytes).collect();
        let input = self.buffer(bytes.len() as u64, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST);
        self.queue.write_buffer(&input, 0, &bytes);
        let size = 16 * cases.len() as u64;
        let output = self.buffer(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let back = self.buffer(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: self.cases, resource: input.as_entire_binding() },
                wgpu::BindGroupEntry { binding: self.results, resource: output.as_entire_binding() },
            ],
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups((cases.len() as u32).div_ceil(64), 1, 1);
        }
        encoder.copy_buffer_to_buffer(&output, 0, &back, 0, size);
        self.queue.submit([encoder.finish()]);
        back.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
        self.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        let data = back.slice(..).get_mapped_range().unwrap();
        bytemuck::cast_slice::<u8, [f32; 4]>(&data).iter().map(|&[r, g, b, _]| [r, g, b]).collect()
    }

    fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let descriptor = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
        self.device.create_buffer(&descriptor)
    }
}

fn bytes(case: &Case) -> Vec<u8> {
    let ray = [case.ray.origin.as_vec3().extend(case.way as f32), case.ray.direction.as_vec3().extend(0.0)];
    let mut bytes = bytemuck::bytes_of(&light(&case.light)).to_vec();
    bytes.extend_from_slice(bytemuck::bytes_of(&layout::Medium::from(&case.medium)));
    bytes.extend_from_slice(bytemuck::bytes_of(&layout::Phase::from(&case.medium.phase)));
    bytes.extend_from_slice(bytemuck::cast_slice(&ray.map(|vector| vector.to_array())));
    bytes
}

fn light(light: &Light) -> layout::Light {
    let floats = |vector: glam::DVec3| vector.as_vec3().to_array();
    match *light {
        Light::Point { position, intensity, radius } => layout::Light {
            position: floats(position),
            intensity: floats(intensity),
            radius: radius as f32,
            ..Default::default()
        },
        Light::Spot { position, intensity, radius, direction, exponent, cutoff } => layout::Light {
            position: floats(position),
            kind: 1,
            intensity: floats(intensity),
            radius: radius as f32,
            direction: floats(direction),
            exponent: exponent as f32,
            cos_cutoff: cutoff.to_radians().cos() as f32,
            ..Default::default()
        },
        Light::Directional { direction, irradiance } => {
            layout::Light { kind: 2, intensity: floats(irradiance), direction: floats(direction), ..Default::default() }
        }
    }
}
