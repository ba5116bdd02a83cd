//! The chain as somebody would write it for wgpu alone: two textures, bind groups made once, one pass per dispatch.

use tyndall_gpu::wgpu;

use super::SIDE;

const SHADER: &str = "
struct Params { factor: f32 }
@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var scaled: texture_storage_2d<rgba32float, write>;
@group(0) @binding(2) var input: texture_2d<f32>;
@compute @workgroup_size(8, 8) fn source(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(scaled, id.xy, vec4(params.factor));
}
@compute @workgroup_size(8, 8) fn step(@builtin(global_invocation_id) id: vec3<u32>) {
    textureStore(scaled, id.xy, params.factor * textureLoad(input, id.xy, 0));
}";

pub struct ByHand {
    pub device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: [wgpu::ComputePipeline; 2],
    groups: Vec<wgpu::BindGroup>,
}

impl ByHand {
    /// On a device of its own.
    pub fn new(device: wgpu::Device, queue: wgpu::Queue, passes: usize) -> Self {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("by hand"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let pipelines = ["source", "step"].map(|entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout: None,
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        let views = [(); 2].map(|()| view(&device));
        let mut groups = vec![group(&device, &pipelines[0], None, &views[0])];
        for pass in 1..passes {
            groups.push(group(&device, &pipelines[1], Some(&views[(pass + 1) % 2]), &views[pass % 2]));
        }
        Self { device, queue, pipelines, groups }
    }

    pub fn noop(passes: usize) -> Self {
        let (device, queue) = wgpu::Device::noop(&wgpu::DeviceDescriptor::default());
        Self::new(device, queue, passes)
    }

    pub fn frame(&self) {
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("frame") };
        let mut encoder = self.device.create_command_encoder(&descriptor);
        for (index, group) in self.groups.iter().enumerate() {
            let label = if index == 0 { "test.source" } else { "test.step" };
            let descriptor = wgpu::ComputePassDescriptor { label: Some(label), timestamp_writes: None };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            pass.set_pipeline(&self.pipelines[index.min(1)]);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(1, 1, 1);
        }
        self.queue.submit([encoder.finish()]);
    }

    pub fn wait(&self) {
        self.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    }
}

fn view(device: &wgpu::Device) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("ping or pong"),
        size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn group(
    device: &wgpu::Device,
    pipeline: &wgpu::ComputePipeline,
    from: Option<&wgpu::TextureView>,
    to: &wgpu::TextureView,
) -> wgpu::BindGroup {
    let params = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("params"),
        size: 16,
        usage: wgpu::BufferUsages::UNIFORM,
        mapped_at_creation: false,
    });
    let mut entries = vec![
        wgpu::BindGroupEntry { binding: 0, resource: params.as_entire_binding() },
        wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(to) },
    ];
    entries.extend(
        from.map(|view| wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(view) }),
    );
    let layout = pipeline.get_bind_group_layout(0);
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("by hand"), layout: &layout, entries: &entries })
}
