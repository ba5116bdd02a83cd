//! What a port holds, as numbers on the CPU.

use half::f16;
use tyndall_graph::Resource;
use tyndall_graph::descriptor::{Dimension, Format};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::slots::{Physical, encode};

/// The content of a port, every number as `f32`, row 0 the top, layers one after another.
#[derive(Debug, Clone, PartialEq)]
pub struct PortData {
    /// Texels in x, or elements of a buffer.
    pub width: u32,
    /// Texels in y, 1 of a buffer.
    pub height: u32,
    /// Layers or texels in z, 1 otherwise.
    pub layers: u32,
    /// Numbers of a texel or an element.
    pub channels: u32,
    /// It is a buffer.
    pub is_buffer: bool,
    /// It is one plain two-dimensional image.
    pub is_image: bool,
    /// `width * height * layers * channels` numbers.
    pub data: Vec<f32>,
}

impl PortData {
    /// The content as the bytes of a port of this resource. Numbers of up to 24 bits, and all of float formats, come
    /// out as they were read.
    pub fn texels(&self, resource: &Resource) -> Vec<u8> {
        match resource {
            Resource::Texture { format, .. } => encode(*format, &self.data),
            Resource::Buffer { bytes, .. } => {
                let mut content = encode(Format::R32Float, &self.data);
                content.resize(*bytes as usize, 0);
                content
            }
        }
    }
}

/// Copies a slot to the CPU. Waits for the GPU.
pub(crate) fn read(gpu: &Gpu, name: &str, resource: &Resource, physical: &Physical) -> Result<PortData, GpuError> {
    match (physical, resource) {
        (
            Physical::Texture { texture, .. },
            Resource::Texture { dimension, format, width, height, depth_or_layers },
        ) => {
            let bytes = read_texture(gpu, name, texture, *format)?;
            let data = numbers(*format, &bytes);
            Ok(PortData {
                width: *width,
                height: *height,
                layers: *depth_or_layers,
                channels: format.channels(),
                is_buffer: false,
                is_image: *dimension == Dimension::D2,
                data,
            })
        }
        (Physical::Buffer(buffer), Resource::Buffer { bytes, stride }) => {
            let content = read_bytes(gpu, name, bytes.next_multiple_of(4), |encoder, staging| {
                encoder.copy_buffer_to_buffer(buffer, 0, staging, 0, bytes.next_multiple_of(4));
            })?;
            let channels = (stride / 4).max(1);
            let data = numbers(Format::R32Float, &content[..*bytes as usize & !3]);
            let width = (data.len() as u32) / channels;
            Ok(PortData { width, height: 1, layers: 1, channels, is_buffer: true, is_image: false, data })
        }
        _ => Err(GpuError::Pass { pass: name.to_owned(), reason: "its slot is of another kind".to_owned() }),
    }
}

fn read_texture(gpu: &Gpu, name: &str, texture: &wgpu::Texture, format: Format) -> Result<Vec<u8>, GpuError> {
    let row = texture.width() * format.bytes() as u32;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let rows = texture.height() * texture.depth_or_array_layers();
    let content = read_bytes(gpu, name, u64::from(padded) * u64::from(rows), |encoder, staging| {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: Some(texture.height()),
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: staging, layout },
            texture.size(),
        );
    })?;
    if row == padded {
        return Ok(content);
    }
    Ok(content.chunks_exact(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect())
}

/// Runs a copy into a staging buffer of `size` bytes, waits, and gives its content.
pub(crate) fn read_bytes(
    gpu: &Gpu,
    name: &str,
    size: u64,
    copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
) -> Result<Vec<u8>, GpuError> {
    let what = format!("the read-back of `{name}`");
    let staging = gpu.create(&what, 1, |device| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: size.max(4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        })
    })?;
    gpu.create(&what, 0, |device| {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("read-back") });
        copy(&mut encoder, &staging);
        gpu.queue.submit([encoder.finish()]);
    })?;
    let (sender, receiver) = std::sync::mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver is gone only where this function has returned with an error already.
        let _ = sender.send(result);
    });
    gpu.wait()?;
    match receiver.recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(GpuError::Refused { what, reason: error.to_string() }),
        Err(_) => return Err(GpuError::Lost { reason: "the read-back never answered".to_owned() }),
    }
    match staging.get_mapped_range(..) {
        Ok(view) => Ok(view.to_vec()),
        Err(error) => Err(GpuError::Refused { what, reason: error.to_string() }),
    }
}

fn numbers(format: Format, bytes: &[u8]) -> Vec<f32> {
    match format {
        Format::R32Float | Format::Rg32Float | Format::Rgba32Float | Format::Depth32Float => {
            bytes.as_chunks().0.iter().map(|four| f32::from_le_bytes(*four)).collect()
        }
        Format::R16Float | Format::Rg16Float | Format::Rgba16Float => {
            bytes.as_chunks().0.iter().map(|two| f16::from_le_bytes(*two).to_f32()).collect()
        }
        Format::Rgba8Unorm => bytes.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
        Format::R32Uint | Format::Rg32Uint | Format::Rgba32Uint => {
            bytes.as_chunks().0.iter().map(|four| u32::from_le_bytes(*four) as f32).collect()
        }
    }
}
