//! A shader made ready to run within a pass: by dispatch, or by draw.

use std::sync::Arc;

use tyndall_graph::{Handle, Slot};
use tyndall_shader::Linked;

use crate::bindings::{Bindings, constants};
use crate::error::GpuError;
use crate::program::Setup;
use crate::slots::texture_format;

/// A compute shader with everything that it is bound to.
pub struct Kernel {
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) bindings: Bindings,
    pub(crate) workgroup: [u32; 3],
    pub(crate) label: String,
}

impl Kernel {
    /// Compiles the entry point `entry` of a linked shader. Variables are bound by their names.
    ///
    /// # Errors
    /// [`GpuError::Refused`] with the driver's words; [`GpuError::Pass`] where a variable is nothing that the pass has.
    pub fn new(setup: &mut Setup<'_>, linked: &Arc<Linked>, entry: &str) -> Result<Self, GpuError> {
        let label = setup.pass.descriptor().name.clone();
        let found = linked.entry_points.iter().find(|point| point.name == entry);
        let workgroup = found.map(|point| point.workgroup_size).filter(|size| size.iter().all(|threads| *threads > 0));
        let workgroup =
            workgroup.ok_or_else(|| setup.pass.refuse(format!("its shader has no compute entry point `{entry}`")))?;
        let bindings = Bindings::new(setup, linked, &label)?;
        let constants = constants(linked, setup.pass, setup.values, setup.scene);
        let constants: Vec<(&str, f64)> = constants.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let pipeline = setup.cache.compute(setup.gpu, linked, (&label, entry), bindings.layout(), &constants)?;
        Ok(Self { pipeline, bindings, workgroup, label })
    }

    /// Where the shader counts threads that did not get to the end of their loops, if it does: for
    /// [`crate::Program::unfinished`].
    pub fn unfinished(&self) -> Option<&wgpu::Buffer> {
        self.bindings.unfinished()
    }
}

/// A vertex and a fragment shader with everything that they are bound to. Vertices are pulled from buffers.
pub struct Raster {
    pub(crate) pipeline: wgpu::RenderPipeline,
    pub(crate) bindings: Bindings,
    pub(crate) colors: Vec<Attachment>,
    pub(crate) depth: Option<Attachment>,
    pub(crate) label: String,
}

/// What a [`Raster`] draws into.
pub(crate) struct Attachment {
    pub slot: Handle<Slot>,
    pub clear: Option<[f64; 4]>,
}

/// How a [`Raster`] draws: its targets by port name, in order of `@location`.
#[derive(Debug, Clone)]
pub struct RasterTargets<'a> {
    /// Colour targets: the port, and the value that it is cleared to (`None`: drawn over).
    pub colors: &'a [(&'a str, Option<[f64; 4]>)],
    /// Depth buffer, the value that it is cleared to, and which fragments pass.
    pub depth: Option<(&'a str, f64, wgpu::CompareFunction)>,
}

impl Raster {
    /// Compiles `vertex` and `fragment` of a linked shader for these targets.
    ///
    /// # Errors
    /// As [`Kernel::new`].
    pub fn new(
        setup: &mut Setup<'_>,
        linked: &Arc<Linked>,
        (vertex, fragment): (&str, &str),
        targets: &RasterTargets<'_>,
    ) -> Result<Self, GpuError> {
        let label = setup.pass.descriptor().name.clone();
        let module = setup.cache.module(setup.gpu, linked, &label)?;
        let bindings = Bindings::new(setup, linked, &label)?;
        let constants = constants(linked, setup.pass, setup.values, setup.scene);
        let constants: Vec<(&str, f64)> = constants.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let mut colors = Vec::new();
        let mut states = Vec::new();
        for &(port, clear) in targets.colors {
            let (slot, format) = setup.target(port)?;
            colors.push(Attachment { slot, clear });
            states.push(Some(wgpu::ColorTargetState::from(texture_format(format))));
        }
        let (mut depth, mut depth_stencil) = (None, None);
        if let Some((port, clear, compare)) = targets.depth {
            let (slot, format) = setup.target(port)?;
            depth = Some(Attachment { slot, clear: Some([clear; 4]) });
            depth_stencil = Some(wgpu::DepthStencilState {
                format: texture_format(format),
                depth_write_enabled: Some(true),
                depth_compare: Some(compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            });
        }
        let pipeline = setup.gpu.create(&format!("the pipeline of {label}"), 2, |device| {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(&label),
                bind_group_layouts: &[Some(bindings.layout())],
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(&label),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: options.clone(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options: options,
                    targets: &states,
                }),
                multiview_mask: None,
                cache: None,
            })
        })?;
        Ok(Self { pipeline, bindings, colors, depth, label })
    }
}
