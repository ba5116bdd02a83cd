//! Scene data on the GPU: buffers by opaque names, each with the version of its content.

use tyndall_graph::Digest;

use crate::device::Gpu;
use crate::error::{GpuError, bytes};

/// The buffers of a scene. A name is interned once; passes hold the number.
#[derive(Default)]
pub struct SceneBuffers {
    items: Vec<Item>,
    generation: u64,
}

struct Item {
    name: String,
    buffer: Option<wgpu::Buffer>,
    bytes: u64,
    count: u32,
    version: u64,
    /// Pipelines were made for this element count.
    fixed: bool,
}

impl SceneBuffers {
    /// The number of this name; it need not have content yet.
    pub(crate) fn intern(&mut self, name: &str) -> usize {
        if let Some(index) = self.items.iter().position(|item| item.name == name) {
            return index;
        }
        self.items.push(Item { name: name.to_owned(), buffer: None, bytes: 0, count: 0, version: 0, fixed: false });
        self.items.len() - 1
    }

    /// Sets the content of a name; the same content again costs a hash and no more.
    ///
    /// The first four bytes are the element count that [`SceneBuffers::count`] gives (where the data have one).
    ///
    /// # Errors
    /// [`GpuError::OverLimit`] where the adapter cannot bind so much at once; [`GpuError::Pass`] where the element count
    /// changes and a pipeline was made for it; what wgpu reports.
    pub fn set(&mut self, gpu: &Gpu, name: &str, content: &[u8]) -> Result<(), GpuError> {
        let index = self.intern(name);
        let version = Digest::of(content);
        let item = &mut self.items[index];
        if item.buffer.is_some() && item.version == version && item.bytes == content.len() as u64 {
            return Ok(());
        }
        let count = content.first_chunk().map_or(0, |head| u32::from_le_bytes(*head));
        if item.fixed && item.count != count {
            let reason = "its element count is a part of pipelines: plan anew to change it".to_owned();
            return Err(GpuError::Pass { pass: format!("the scene's `{name}`"), reason });
        }
        let bytes = (content.len() as u64).next_multiple_of(16).max(16);
        if item.buffer.as_ref().is_none_or(|buffer| buffer.size() != bytes) {
            item.buffer = Some(create(gpu, name, bytes)?);
            self.generation += 1;
        }
        if let Some(buffer) = &item.buffer {
            let whole = content.len() & !3;
            gpu.queue.write_buffer(buffer, 0, &content[..whole]);
            if whole < content.len() {
                let mut last = [0; 4];
                last[..content.len() - whole].copy_from_slice(&content[whole..]);
                gpu.queue.write_buffer(buffer, whole as u64, &last);
            }
        }
        item.version = version;
        item.bytes = content.len() as u64;
        item.count = count;
        Ok(())
    }

    /// Rises whenever a buffer was replaced, so that bind groups are made anew.
    pub(crate) fn generation(&self) -> u64 {
        self.generation
    }

    pub(crate) fn buffer(&self, index: usize) -> Option<&wgpu::Buffer> {
        self.items[index].buffer.as_ref()
    }

    pub(crate) fn name(&self, index: usize) -> &str {
        &self.items[index].name
    }

    pub(crate) fn version(&self, index: usize) -> u64 {
        self.items[index].version
    }

    /// The element count that stands at the front of this name's content; 0 where it has none.
    pub fn count(&self, name: &str) -> u32 {
        self.items.iter().find(|item| item.name == name).map_or(0, |item| item.count)
    }

    /// The same, for a pipeline that is made for it: from now on it may not change.
    pub(crate) fn fixed_count(&mut self, name: &str) -> u32 {
        let index = self.intern(name);
        self.items[index].fixed = true;
        self.items[index].count
    }

    /// No pipeline of a former plan counts any more.
    pub(crate) fn release_counts(&mut self) {
        self.items.iter_mut().for_each(|item| item.fixed = false);
    }

    /// Bytes of all buffers together.
    pub fn bytes(&self) -> u64 {
        self.items.iter().map(|item| item.bytes).sum()
    }
}

fn create(gpu: &Gpu, name: &str, size: u64) -> Result<wgpu::Buffer, GpuError> {
    let limit = gpu.limits.max_storage_buffer_binding_size.min(gpu.limits.max_buffer_size);
    if size > limit {
        return Err(GpuError::OverLimit {
            what: format!("the scene's `{name}`"),
            size: bytes(size),
            limit: bytes(limit),
            adapter: gpu.info.name.clone(),
        });
    }
    gpu.create(&format!("the scene's `{name}`"), 1, |device| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(name),
            size,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    })
}
