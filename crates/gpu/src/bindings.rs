//! What a shader's variables are bound to, and the bind group that follows from it.

use naga::StorageAccess;
use tyndall_graph::descriptor::{ParamDescriptor, ParamValue};
use tyndall_graph::{Handle, Slot, Table, Values};
use tyndall_shader::{
    Linked, PARAMS, ParamKind, ParamSource, Resource, ResourceKind, SAMPLERS, SampleClass, UNFINISHED, counted,
};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::program::Setup;
use crate::scene::SceneBuffers;
use crate::slots::Physical;
use crate::view::PlannedView;

/// Where a binding gets its content.
#[derive(Debug, Clone, Copy)]
enum Feed {
    /// A slot of the plan.
    Slot(Handle<Slot>),
    /// Scene data.
    Scene(usize),
    /// The pass's parameters.
    Params,
    /// One of the executor's samplers.
    Sampler(usize),
    /// The count of threads that did not get to the end.
    Unfinished,
}

/// The bindings of one shader within one pass.
pub(crate) struct Bindings {
    layout: wgpu::BindGroupLayout,
    feeds: Vec<(u32, Feed)>,
    params: Option<ParamBlock>,
    unfinished: Option<wgpu::Buffer>,
    group: Option<wgpu::BindGroup>,
    generation: u64,
    label: String,
}

/// What bindings are resolved against.
pub(crate) struct Bound<'a> {
    pub gpu: &'a Gpu,
    pub slots: &'a Table<Slot, Physical>,
    pub scene: &'a SceneBuffers,
    pub samplers: &'a [wgpu::Sampler; 3],
}

impl Bindings {
    /// Resolves every variable that the shader uses.
    pub(crate) fn new(setup: &mut Setup<'_>, linked: &Linked, label: &str) -> Result<Self, GpuError> {
        let (gpu, pass) = (setup.gpu, setup.pass);
        let mut feeds = Vec::new();
        let mut entries = Vec::new();
        let (mut params, mut unfinished) = (None, None);
        for resource in &linked.resources {
            let feed = feed(resource, pass, setup.scene)?;
            if let (Feed::Slot(slot), ResourceKind::StorageTexture { .. }) = (feed, &resource.kind) {
                setup.usages[slot] |= wgpu::TextureUsages::STORAGE_BINDING;
            }
            if let (Feed::Params, ResourceKind::Uniform { size, .. }) = (feed, &resource.kind) {
                params = Some(ParamBlock::new(gpu, pass, *size, linked, label)?);
            }
            if let Feed::Unfinished = feed {
                unfinished = Some(count(gpu, label)?);
            }
            feeds.push((resource.binding, feed));
            entries.push(layout_entry(resource));
        }
        let layout = gpu.create(label, 1, |device| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
        })?;
        Ok(Self { layout, feeds, params, unfinished, group: None, generation: u64::MAX, label: label.to_owned() })
    }

    pub(crate) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// Where the shader counts threads that did not get to the end.
    pub(crate) fn unfinished(&self) -> Option<&wgpu::Buffer> {
        self.unfinished.as_ref()
    }

    /// The bind group, made anew only where a scene buffer was replaced.
    pub(crate) fn group(&mut self, bound: &Bound<'_>) -> Result<&wgpu::BindGroup, GpuError> {
        let stale = self.group.is_none() || self.generation != bound.scene.generation();
        if stale {
            self.group = Some(self.build(bound)?);
            self.generation = bound.scene.generation();
        }
        self.group
            .as_ref()
            .ok_or_else(|| GpuError::Pass { pass: self.label.clone(), reason: "it has no bind group".to_owned() })
    }

    fn build(&self, bound: &Bound<'_>) -> Result<wgpu::BindGroup, GpuError> {
        let mut entries = Vec::with_capacity(self.feeds.len());
        for &(binding, feed) in &self.feeds {
            let resource = match feed {
                Feed::Slot(slot) => match &bound.slots[slot] {
                    Physical::Texture { view, .. } => wgpu::BindingResource::TextureView(view),
                    Physical::Buffer(buffer) => buffer.as_entire_binding(),
                },
                Feed::Scene(index) => match bound.scene.buffer(index) {
                    Some(buffer) => buffer.as_entire_binding(),
                    None => {
                        let reason = format!("the scene gives no `{}`", bound.scene.name(index));
                        return Err(GpuError::Pass { pass: self.label.clone(), reason });
                    }
                },
                Feed::Params => match &self.params {
                    Some(block) => block.buffer.as_entire_binding(),
                    None => {
                        let reason = "its `params` is not a uniform".to_owned();
                        return Err(GpuError::Pass { pass: self.label.clone(), reason });
                    }
                },
                Feed::Unfinished => match &self.unfinished {
                    Some(buffer) => buffer.as_entire_binding(),
                    None => {
                        let reason = format!("its `{UNFINISHED}` is not a count");
                        return Err(GpuError::Pass { pass: self.label.clone(), reason });
                    }
                },
                Feed::Sampler(index) => wgpu::BindingResource::Sampler(&bound.samplers[index]),
            };
            entries.push(wgpu::BindGroupEntry { binding, resource });
        }
        bound.gpu.create(&self.label, 1, |device| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&self.label),
                layout: &self.layout,
                entries: &entries,
            })
        })
    }

    /// Writes the parameters to the GPU where they have changed.
    pub(crate) fn update(&mut self, gpu: &Gpu, values: &Values, descriptors: &Table<ParamDescriptor>) {
        if let Some(block) = &mut self.params {
            block.update(gpu, values, descriptors);
        }
    }
}

fn feed(resource: &Resource, pass: PlannedView<'_>, scene: &mut SceneBuffers) -> Result<Feed, GpuError> {
    let name = resource.name.as_str();
    if let Ok(index) = pass.port(name) {
        let slot = pass.slot(index).ok_or_else(|| pass.refuse(format!("nothing is bound to port `{name}`")));
        return slot.map(Feed::Slot);
    }
    if name == PARAMS {
        return Ok(Feed::Params);
    }
    if name == UNFINISHED {
        return Ok(Feed::Unfinished);
    }
    if let Some(index) = SAMPLERS.iter().position(|sampler| sampler.name == name) {
        return Ok(Feed::Sampler(index));
    }
    Ok(Feed::Scene(scene.intern(name)))
}

/// A count that starts at 0.
fn count(gpu: &Gpu, label: &str) -> Result<wgpu::Buffer, GpuError> {
    gpu.create(label, 1, |device| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: 16,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    })
}

fn layout_entry(resource: &Resource) -> wgpu::BindGroupLayoutEntry {
    let ty = match &resource.kind {
        ResourceKind::Texture { dimension, arrayed, class, filtered } => wgpu::BindingType::Texture {
            sample_type: match class {
                SampleClass::Uint => wgpu::TextureSampleType::Uint,
                SampleClass::Sint => wgpu::TextureSampleType::Sint,
                SampleClass::Depth => wgpu::TextureSampleType::Depth,
                SampleClass::Float => wgpu::TextureSampleType::Float { filterable: *filtered },
            },
            view_dimension: view_dimension(*dimension, *arrayed),
            multisampled: false,
        },
        ResourceKind::StorageTexture { dimension, arrayed, format, access } => wgpu::BindingType::StorageTexture {
            access: if *access == StorageAccess::STORE {
                wgpu::StorageTextureAccess::WriteOnly
            } else if access.contains(StorageAccess::STORE) {
                wgpu::StorageTextureAccess::ReadWrite
            } else {
                wgpu::StorageTextureAccess::ReadOnly
            },
            format: crate::slots::texture_format(*format),
            view_dimension: view_dimension(*dimension, *arrayed),
        },
        ResourceKind::Uniform { size, .. } => buffer(wgpu::BufferBindingType::Uniform, *size),
        ResourceKind::StorageBuffer { read_only, size, .. } => {
            buffer(wgpu::BufferBindingType::Storage { read_only: *read_only }, *size)
        }
        ResourceKind::Sampler { comparison, filtering } => wgpu::BindingType::Sampler(match (comparison, filtering) {
            (true, _) => wgpu::SamplerBindingType::Comparison,
            (false, false) => wgpu::SamplerBindingType::NonFiltering,
            (false, true) => wgpu::SamplerBindingType::Filtering,
        }),
    };
    // naga's and wgpu's bits of the three stages are the same, WebGPU's.
    let visibility = wgpu::ShaderStages::from_bits_truncate(u32::from(resource.stages.bits()));
    wgpu::BindGroupLayoutEntry { binding: resource.binding, visibility, ty, count: None }
}

fn view_dimension(dimension: naga::ImageDimension, arrayed: bool) -> wgpu::TextureViewDimension {
    match (dimension, arrayed) {
        (naga::ImageDimension::D1, _) => wgpu::TextureViewDimension::D1,
        (naga::ImageDimension::D2, false) => wgpu::TextureViewDimension::D2,
        (naga::ImageDimension::D2, true) => wgpu::TextureViewDimension::D2Array,
        (naga::ImageDimension::D3, _) => wgpu::TextureViewDimension::D3,
        (naga::ImageDimension::Cube, false) => wgpu::TextureViewDimension::Cube,
        (naga::ImageDimension::Cube, true) => wgpu::TextureViewDimension::CubeArray,
    }
}

/// A buffer of at least `bytes`. That this is said here and not left open saves wgpu a check (and an allocation) in every
/// dispatch. A struct's size is rounded up to its alignment, which is 16 at most; so are all our buffers.
fn buffer(ty: wgpu::BufferBindingType, bytes: u32) -> wgpu::BindingType {
    let min_binding_size = wgpu::BufferSize::new(u64::from(bytes).next_multiple_of(16));
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size }
}

/// The uniform that holds a pass's parameters, member by member.
struct ParamBlock {
    buffer: wgpu::Buffer,
    content: Vec<u8>,
    fields: Vec<(usize, Handle<ParamDescriptor>, ParamKind)>,
    written: bool,
}

impl ParamBlock {
    fn new(gpu: &Gpu, pass: PlannedView<'_>, size: u32, linked: &Linked, label: &str) -> Result<Self, GpuError> {
        let mut fields = Vec::new();
        for param in &linked.params {
            let ParamSource::Uniform { offset } = param.source else { continue };
            let index = pass.param(&param.name);
            let index =
                index.ok_or_else(|| pass.refuse(format!("`Params.{}` is not a declared parameter", param.name)))?;
            fields.push((offset as usize, index, param.kind));
        }
        let buffer = gpu.create(label, 1, |device| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(size).next_multiple_of(16),
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        Ok(Self { buffer, content: vec![0; (size as usize).next_multiple_of(16)], fields, written: false })
    }

    fn update(&mut self, gpu: &Gpu, values: &Values, descriptors: &Table<ParamDescriptor>) {
        let mut changed = !self.written;
        for &(offset, index, kind) in &self.fields {
            let mut at = offset;
            each_number(&values[index], &descriptors[index], |number| {
                let bytes = match kind {
                    ParamKind::Uint | ParamKind::Bool => (number as u32).to_le_bytes(),
                    ParamKind::Int => (number as i32).to_le_bytes(),
                    ParamKind::Float | ParamKind::Vector(_) => (number as f32).to_le_bytes(),
                };
                let place = &mut self.content[at..at + 4];
                changed |= place != bytes;
                place.copy_from_slice(&bytes);
                at += 4;
            });
        }
        if changed {
            gpu.queue.write_buffer(&self.buffer, 0, &self.content);
            self.written = true;
        }
    }
}

/// The numbers that a shader sees of a parameter.
pub(crate) fn each_number(value: &ParamValue, descriptor: &ParamDescriptor, mut give: impl FnMut(f64)) {
    match value {
        ParamValue::Bool(on) => give(f64::from(u8::from(*on))),
        ParamValue::Integer(number) => give(*number as f64),
        ParamValue::Float(number) => give(*number),
        ParamValue::Vector(numbers) => numbers.iter().for_each(|number| give(*number)),
        ParamValue::Choice(word) => {
            give(descriptor.accepts.choices().iter().position(|choice| choice == word).unwrap_or_default() as f64);
        }
        ParamValue::File(_) => {}
    }
}

/// The values of a shader's `override` declarations: parameters, and element counts of scene data.
pub(crate) fn constants(
    linked: &Linked,
    pass: PlannedView<'_>,
    values: &Values,
    scene: &mut SceneBuffers,
) -> Vec<(String, f64)> {
    let mut constants = Vec::new();
    for param in linked.params.iter().filter(|param| param.is_override()) {
        if let Some(index) = pass.param(&param.name) {
            let descriptor = &pass.descriptor().params[index];
            each_number(&values[index], descriptor, |number| constants.push((param.name.clone(), number)));
        } else if let Some(name) = counted(&param.name) {
            constants.push((param.name.clone(), f64::from(scene.fixed_count(name))));
        }
    }
    constants
}
