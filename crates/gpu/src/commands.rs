//! The commands of a frame.

use crate::device::Gpu;

/// The commands of a frame that are not submitted yet.
pub(crate) struct Commands<'a> {
    pub gpu: &'a Gpu,
    pub encoder: wgpu::CommandEncoder,
}

impl<'a> Commands<'a> {
    pub fn new(gpu: &'a Gpu) -> Self {
        Self { gpu, encoder: encoder(gpu) }
    }

    /// Submits what was recorded so far, and starts anew.
    pub fn submit(&mut self) {
        let recorded = std::mem::replace(&mut self.encoder, encoder(self.gpu));
        self.gpu.queue.submit([recorded.finish()]);
    }

    /// Submits the last of them.
    pub fn finish(self) {
        self.gpu.queue.submit([self.encoder.finish()]);
    }
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
}
