//! What was compiled once and need not be again.

use std::collections::HashMap;
use std::sync::Arc;

use tyndall_shader::Linked;

use crate::device::Gpu;
use crate::error::GpuError;

/// Shader modules and compute pipelines that outlive a plan, of one device: the same shader with the same constants is
/// compiled once. A copy shares what is compiled so far, and nothing after that.
#[derive(Clone, Default)]
pub struct PipelineCache {
    modules: HashMap<u64, wgpu::ShaderModule>,
    pipelines: HashMap<PipelineKey, wgpu::ComputePipeline>,
}

/// What tells one compute pipeline from another; the layout follows from the shader.
#[derive(Clone, PartialEq, Eq, Hash)]
struct PipelineKey {
    shader: u64,
    label: String,
    entry: String,
    constants: Vec<(String, u64)>,
}

impl PipelineCache {
    /// The shader as a module of the device.
    pub(crate) fn module(
        &mut self,
        gpu: &Gpu,
        linked: &Arc<Linked>,
        label: &str,
    ) -> Result<wgpu::ShaderModule, GpuError> {
        if let Some(module) = self.modules.get(&linked.fingerprint) {
            return Ok(module.clone());
        }
        let module = gpu.create(&format!("the shader of {label}"), 1, |device| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(linked.module.clone())),
            })
        })?;
        self.modules.insert(linked.fingerprint, module.clone());
        Ok(module)
    }

    /// The pipeline of an entry point with these constants.
    pub(crate) fn compute(
        &mut self,
        gpu: &Gpu,
        linked: &Arc<Linked>,
        (label, entry): (&str, &str),
        layout: &wgpu::BindGroupLayout,
        constants: &[(&str, f64)],
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let key = PipelineKey {
            shader: linked.fingerprint,
            label: label.to_owned(),
            entry: entry.to_owned(),
            constants: constants.iter().map(|(name, value)| ((*name).to_owned(), value.to_bits())).collect(),
        };
        if let Some(pipeline) = self.pipelines.get(&key) {
            return Ok(pipeline.clone());
        }
        let module = self.module(gpu, linked, label)?;
        let pipeline = gpu.create(&format!("the pipeline of {label}"), 2, |device| {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(label),
                bind_group_layouts: &[Some(layout)],
                immediate_size: 0,
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: Some(&layout),
                module: &module,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                cache: None,
            })
        })?;
        self.pipelines.insert(key, pipeline.clone());
        Ok(pipeline)
    }
}
