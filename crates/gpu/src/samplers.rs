//! The samplers that shaders may name.

use crate::device::Gpu;
use crate::error::GpuError;

/// In the order of `tyndall_shader::SAMPLERS`.
pub(crate) fn samplers(gpu: &Gpu) -> Result<[wgpu::Sampler; 3], GpuError> {
    let sampler = |device: &wgpu::Device, label, address, filter| {
        device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(label),
            address_mode_u: address,
            address_mode_v: address,
            address_mode_w: address,
            mag_filter: filter,
            min_filter: filter,
            ..Default::default()
        })
    };
    let (clamp, repeat) = (wgpu::AddressMode::ClampToEdge, wgpu::AddressMode::Repeat);
    gpu.create("samplers", 3, |device| {
        [
            sampler(device, "linear_clamp", clamp, wgpu::FilterMode::Linear),
            sampler(device, "nearest_clamp", clamp, wgpu::FilterMode::Nearest),
            sampler(device, "linear_repeat", repeat, wgpu::FilterMode::Linear),
        ]
    })
}
