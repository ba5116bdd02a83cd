//! The plan's slots as textures and buffers.

use tyndall_graph::descriptor::{Dimension, Format, Scalar};
use tyndall_graph::{Handle, Plan, Resource, Slot, SlotKind, Table};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::port_data::encode;

/// One physical resource of a plan.
pub(crate) enum Physical {
    Texture { texture: wgpu::Texture, view: wgpu::TextureView },
    Buffer(wgpu::Buffer),
}

impl Physical {
    pub(crate) fn texture(&self) -> Option<&wgpu::Texture> {
        match self {
            Physical::Texture { texture, .. } => Some(texture),
            Physical::Buffer(_) => None,
        }
    }

    /// Copies the whole content to another of an equal resource: the planner copies between no others.
    pub(crate) fn copy(&self, to: &Self, encoder: &mut wgpu::CommandEncoder) {
        match (self, to) {
            (Physical::Texture { texture: from, .. }, Physical::Texture { texture: to, .. }) => {
                encoder.copy_texture_to_texture(from.as_image_copy(), to.as_image_copy(), from.size());
            }
            (Physical::Buffer(from), Physical::Buffer(to)) => {
                encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size())
            }
            (Physical::Texture { .. }, Physical::Buffer(_)) | (Physical::Buffer(_), Physical::Texture { .. }) => {}
        }
    }
}

/// wgpu's name of a format.
pub(crate) fn texture_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::R32Float => wgpu::TextureFormat::R32Float,
        Format::Rg32Float => wgpu::TextureFormat::Rg32Float,
        Format::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        Format::R16Float => wgpu::TextureFormat::R16Float,
        Format::Rg16Float => wgpu::TextureFormat::Rg16Float,
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        Format::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
        Format::R32Uint => wgpu::TextureFormat::R32Uint,
        Format::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
        Format::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
        Format::Depth32Float => wgpu::TextureFormat::Depth32Float,
    }
}

/// wgpu's name of the dimension of a view.
pub(crate) fn view_dimension(dimension: Dimension) -> wgpu::TextureViewDimension {
    match dimension {
        Dimension::D2 => wgpu::TextureViewDimension::D2,
        Dimension::D2Array => wgpu::TextureViewDimension::D2Array,
        Dimension::D3 => wgpu::TextureViewDimension::D3,
    }
}

/// What the textures of a plan's slots allow whatever passes do with them, because it costs nothing: to be read and copied.
/// Storing and drawing keep drivers from compressing a texture, so they are added where a pass does so. A rasteriser's depth
/// buffer can be filled by drawing alone.
pub(crate) fn least_usages(plan: &Plan) -> Table<Slot, wgpu::TextureUsages> {
    let usages = wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::TEXTURE_BINDING;
    let of_slot = |slot: &Slot| match slot.resource {
        Resource::Texture { format: Format::Depth32Float, .. } => usages | wgpu::TextureUsages::RENDER_ATTACHMENT,
        _ => usages,
    };
    plan.slots.iter().map(of_slot).collect()
}

/// Creates every slot of a plan, labelled with the ports that live in it.
pub(crate) fn create_all(
    gpu: &Gpu,
    plan: &Plan,
    usages: &Table<Slot, wgpu::TextureUsages>,
) -> Result<Table<Slot, Physical>, GpuError> {
    let slots = plan.slots.entries();
    slots.map(|(slot, planned)| create(gpu, &slot_name(plan, slot), &planned.resource, usages[slot])).collect()
}

/// The ports that live in a slot, `a.x | b.y`; what else it is where none does.
pub(crate) fn slot_name(plan: &Plan, index: Handle<Slot>) -> String {
    let names: Vec<String> = plan.ports_in(index).map(|port| plan.port_name(port)).collect();
    match plan.slots[index].kind {
        SlotKind::History { of, .. } => format!("{} (previous)", plan.port_name(of)),
        _ if names.is_empty() => "constant".to_owned(),
        _ => names.join(" | "),
    }
}

fn create(gpu: &Gpu, label: &str, resource: &Resource, usage: wgpu::TextureUsages) -> Result<Physical, GpuError> {
    match *resource {
        Resource::Texture { dimension, format, width, height, depth_or_layers } => {
            let descriptor = wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: depth_or_layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: match dimension {
                    Dimension::D3 => wgpu::TextureDimension::D3,
                    Dimension::D2 | Dimension::D2Array => wgpu::TextureDimension::D2,
                },
                format: texture_format(format),
                usage,
                view_formats: &[],
            };
            let view = wgpu::TextureViewDescriptor {
                label: Some(label),
                dimension: Some(view_dimension(dimension)),
                ..Default::default()
            };
            gpu.create(label, 2, |device| {
                let texture = device.create_texture(&descriptor);
                let view = texture.create_view(&view);
                Physical::Texture { texture, view }
            })
        }
        Resource::Buffer { bytes, .. } => gpu.create(label, 1, |device| {
            Physical::Buffer(device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.next_multiple_of(16),
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::UNIFORM
                    | wgpu::BufferUsages::INDIRECT
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }))
        }),
    }
}

/// Fills the slots whose content is stated by the plan: constants, and histories before the first frame.
pub(crate) fn fill_stated(gpu: &Gpu, plan: &Plan, slots: &Table<Slot, Physical>) -> Result<(), GpuError> {
    for (slot, physical) in plan.slots.iter().zip(slots) {
        if let Some(value) = slot.initial() {
            fill(gpu, &slot.resource, physical, value)?;
        }
    }
    Ok(())
}

/// Writes one value into every texel, or every four bytes of a buffer.
pub(crate) fn fill(gpu: &Gpu, resource: &Resource, physical: &Physical, value: [f32; 4]) -> Result<(), GpuError> {
    gpu.create("what a slot is filled with", 0, |device| match (physical, resource) {
        (Physical::Texture { view, .. }, Resource::Texture { format: Format::Depth32Float, .. }) => {
            clear_depth(gpu, device, view, value[0]);
        }
        (Physical::Texture { texture, .. }, Resource::Texture { format, width, height, depth_or_layers, .. }) => {
            let texel = texel(*format, value);
            let count = *width as usize * *height as usize * *depth_or_layers as usize;
            let data = texel.repeat(count);
            gpu.queue.write_texture(
                texture.as_image_copy(),
                &data,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(width * format.bytes() as u32),
                    rows_per_image: Some(*height),
                },
                texture.size(),
            );
        }
        (Physical::Buffer(buffer), _) => {
            let data = value[0].to_le_bytes().repeat((buffer.size() / 4) as usize);
            gpu.queue.write_buffer(buffer, 0, &data);
        }
        (Physical::Texture { .. }, Resource::Buffer { .. }) => {}
    })
}

/// Writes the whole content of a slot: `texels` in its own format, rows from the top, without padding.
pub(crate) fn upload(
    gpu: &Gpu,
    name: &str,
    resource: &Resource,
    physical: &Physical,
    texels: &[u8],
) -> Result<(), GpuError> {
    let refuse = |reason: String| Err(GpuError::Pass { pass: name.to_owned(), reason });
    if texels.len() as u64 != resource.bytes() {
        return refuse(format!("it is {resource}, and was given {} bytes", texels.len()));
    }
    match (physical, resource) {
        (_, Resource::Texture { format: Format::Depth32Float, .. }) => {
            refuse("nothing can be copied into a depth buffer".to_owned())
        }
        (Physical::Texture { texture, .. }, Resource::Texture { format, width, height, .. }) => {
            gpu.create(name, 0, |_| {
                let layout = wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(width * format.bytes() as u32),
                    rows_per_image: Some(*height),
                };
                gpu.queue.write_texture(texture.as_image_copy(), texels, layout, texture.size());
            })
        }
        (Physical::Buffer(buffer), _) => gpu.create(name, 0, |_| {
            let mut padded = texels.to_vec();
            padded.resize(texels.len().next_multiple_of(4), 0);
            gpu.queue.write_buffer(buffer, 0, &padded);
        }),
        (Physical::Texture { .. }, Resource::Buffer { .. }) => refuse("its slot is of another kind".to_owned()),
    }
}

/// A depth buffer cannot be copied into, only cleared; to a value within 0 and 1.
fn clear_depth(gpu: &Gpu, device: &wgpu::Device, view: &wgpu::TextureView, value: f32) {
    let depth = if value.is_nan() { 0.5 } else { value.clamp(0.0, 1.0) };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("fill") });
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("fill"),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(depth), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    gpu.queue.submit([encoder.finish()]);
}

/// A value as the bytes of one texel. Formats without NaN get a marker instead that no pass writes by itself.
fn texel(format: Format, value: [f32; 4]) -> Vec<u8> {
    let marker = match format.scalar() {
        Scalar::F32 | Scalar::F16 => f32::NAN,
        Scalar::Unorm8 => f32::from(MARKER) / 255.0,
        Scalar::U32 | Scalar::I32 => f32::from(MARKER) * 65536.0,
    };
    let value = value.map(|number| if number.is_nan() { marker } else { number });
    let mut bytes = Vec::with_capacity(format.bytes() as usize);
    value[..format.channels() as usize]
        .iter()
        .for_each(|number| encode(format.scalar(), f64::from(*number), &mut bytes));
    bytes
}

/// What stands for NaN in a format that has none.
const MARKER: u8 = 0xa7;
