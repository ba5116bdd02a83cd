//! What a pass records its work into.

use tyndall_graph::descriptor::PortDescriptor;
use tyndall_graph::{Handle, Resource, Slot, Values};

use crate::bindings::Bound;
use crate::error::GpuError;
use crate::kernel::{Kernel, Raster};
use crate::slots::Physical;
use crate::timing::Stamps;
use crate::view::PlannedView;

/// The frame that a pass adds its work to.
pub struct Recorder<'a> {
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
    pub(crate) bound: Bound<'a>,
    /// The pass within its plan.
    pub pass: PlannedView<'a>,
    pub(crate) values: &'a Values,
    pub(crate) stamps: Option<&'a mut Stamps>,
}

impl Recorder<'_> {
    /// The element count at the front of this scene data.
    pub fn scene_count(&self, name: &str) -> u32 {
        self.bound.scene.count(name)
    }

    /// Values of the parameters.
    pub fn values(&self) -> &Values {
        self.values
    }

    /// Runs a kernel with at least this many threads in x, y and z.
    ///
    /// # Errors
    /// [`GpuError::OverLimit`] where the adapter does not dispatch so many; what making the bind group reports.
    pub fn dispatch(&mut self, kernel: &mut Kernel, threads: [u32; 3]) -> Result<(), GpuError> {
        let groups: [u32; 3] = std::array::from_fn(|axis| threads[axis].div_ceil(kernel.workgroup[axis]));
        let limit = self.bound.gpu.limits.max_compute_workgroups_per_dimension;
        if let Some(most) = groups.iter().copied().max().filter(|most| *most > limit) {
            return Err(GpuError::OverLimit {
                what: format!("the dispatch of {}", kernel.label),
                size: format!("{most} workgroups"),
                limit: limit.to_string(),
                adapter: self.bound.gpu.info.name.clone(),
            });
        }
        kernel.bindings.update(self.bound.gpu, self.values, &self.pass.descriptor().params);
        let group = kernel.bindings.group(&self.bound)?;
        let stamps = self.stamps.as_deref_mut().and_then(Stamps::next);
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(&kernel.label),
            timestamp_writes: stamps.as_ref().map(|(set, at)| wgpu::ComputePassTimestampWrites {
                query_set: set,
                beginning_of_pass_write_index: Some(*at),
                end_of_pass_write_index: Some(*at + 1),
            }),
        });
        pass.set_pipeline(&kernel.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
        Ok(())
    }

    /// Draws this many vertices.
    ///
    /// # Errors
    /// What making the bind group reports.
    pub fn draw(&mut self, raster: &mut Raster, vertices: u32) -> Result<(), GpuError> {
        raster.bindings.update(self.bound.gpu, self.values, &self.pass.descriptor().params);
        let group = raster.bindings.group(&self.bound)?;
        let stamps = self.stamps.as_deref_mut().and_then(Stamps::next);
        let view = |slot: Handle<Slot>| match &self.bound.slots[slot] {
            Physical::Texture { view, .. } => Some(view),
            Physical::Buffer(_) => None,
        };
        let mut colors: [Option<wgpu::RenderPassColorAttachment<'_>>; 8] = [const { None }; 8];
        for (place, target) in colors.iter_mut().zip(&raster.colors) {
            *place = view(target.slot).map(|view| wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: load(target.clear), store: wgpu::StoreOp::Store },
            });
        }
        let depth = raster.depth.as_ref().and_then(|target| {
            view(target.slot).map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(target.clear.map_or(0.0, |value| value[0] as f32)),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            })
        });
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&raster.label),
            color_attachments: &colors[..raster.colors.len()],
            depth_stencil_attachment: depth,
            timestamp_writes: stamps.as_ref().map(|(set, at)| wgpu::RenderPassTimestampWrites {
                query_set: set,
                beginning_of_pass_write_index: Some(*at),
                end_of_pass_write_index: Some(*at + 1),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&raster.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..vertices, 0..1);
        Ok(())
    }

    /// Writes texels into a texture port: `data` in its own format, rows from the top, without padding.
    ///
    /// # Errors
    /// [`GpuError::Pass`] if the port is not a texture, or the data have another size.
    pub fn write_texture(&mut self, port: Handle<PortDescriptor>, data: &[u8]) -> Result<(), GpuError> {
        let texture = self.pass.slot(port).and_then(|slot| self.bound.slots[slot].texture());
        let (Some(texture), Some(resource @ Resource::Texture { format, width, height, .. })) =
            (texture, self.pass.resource(port))
        else {
            return Err(self.pass.refuse("it writes texels into a port that is not a texture"));
        };
        if data.len() as u64 != resource.bytes() {
            return Err(self.pass.refuse("it writes texels of another size than its port"));
        }
        // `write_texture` would run before the whole frame; through a buffer the copy keeps its place in the order.
        let row = width * format.bytes() as u32;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let mut padded_data = Vec::with_capacity(data.len() / row as usize * padded as usize);
        for line in data.chunks_exact(row as usize) {
            padded_data.extend_from_slice(line);
            padded_data.resize(padded_data.len().next_multiple_of(padded as usize), 0);
        }
        let staging = self.bound.gpu.create("an upload", 1, |device| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("upload"),
                size: padded_data.len() as u64,
                usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        self.bound.gpu.queue.write_buffer(&staging, 0, &padded_data);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: Some(*height) };
        self.encoder.copy_buffer_to_texture(
            wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
            texture.as_image_copy(),
            texture.size(),
        );
        Ok(())
    }
}

fn load(clear: Option<[f64; 4]>) -> wgpu::LoadOp<wgpu::Color> {
    match clear {
        Some([r, g, b, a]) => wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
        None => wgpu::LoadOp::Load,
    }
}
