//! Copies from the GPU to the CPU.

use tyndall_graph::Resource;
use tyndall_graph::descriptor::{Format, Scalar};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::port_data::PortData;
use crate::slots::Physical;

/// Copies a slot to the CPU. Waits for the GPU.
pub(crate) fn read(
    gpu: &Gpu,
    name: &str,
    (resource, scalar): (Resource, Scalar),
    physical: &Physical,
) -> Result<PortData, GpuError> {
    let bytes = match (physical, resource) {
        (Physical::Texture { texture, .. }, Resource::Texture { format, .. }) => {
            read_texture(gpu, name, texture, format)?
        }
        (Physical::Buffer(buffer), Resource::Buffer { bytes, .. }) => {
            let copied = bytes.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
            let mut content = read_bytes(gpu, name, copied, |encoder, staging| {
                encoder.copy_buffer_to_buffer(buffer, 0, staging, 0, copied);
            })?;
            content.truncate(bytes as usize);
            content
        }
        _ => return Err(GpuError::Pass { pass: name.to_owned(), reason: "its slot is of another kind".to_owned() }),
    };
    Ok(PortData { resource, scalar, bytes })
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
