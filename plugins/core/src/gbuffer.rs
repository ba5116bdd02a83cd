//! `core.gbuffer`: what each pixel's ray meets first.
//!
//! Two steps: a rasteriser finds the visible triangle, and a compute shader meets the pixel's ray with that triangle,
//! so that distances do not carry a rasteriser's interpolation.

use tyndall_plugin::descriptor::{
    Class, Dimension, Disabled, Format, PassDescriptor, PortDescriptor, PortKind, Role, SizeRule,
};
use tyndall_plugin::{
    GpuError, Kernel, Program, Raster, RasterTargets, Recorder, Resource, RustPass, Setup, Shaders, Table, wgpu,
};

/// The pass.
pub(crate) fn pass() -> RustPass {
    RustPass {
        descriptor: descriptor(),
        shaders: vec!["visibility.wgsl", "gbuffer.wgsl"],
        make: Box::new(|setup, shaders| Ok(Box::new(Gbuffer::new(setup, shaders)?))),
    }
}

fn descriptor() -> PassDescriptor {
    PassDescriptor {
        name: "core.gbuffer".to_owned(),
        about:
            "What each pixel's ray meets first: distance, normal and material. One ray through each pixel's centre, \
                nothing anti-aliased, no near or far plane."
                .to_owned(),
        source: "Burns and Hunt 2013 (visibility buffer); Möller and Trumbore 1997 (ray and triangle)".to_owned(),
        ports: Table::from([
            output(
                "depth",
                "Distance along the pixel's ray to the nearest surface, infinite where there is none",
                "m",
                (Dimension::D2, Class::Scalar, Format::R32Float),
                [f32::INFINITY; 4],
            ),
            output(
                "normal",
                "Unit normal of the surface, world space, turned to the eye; zero where there is no surface",
                "",
                (Dimension::D2, Class::Vector, Format::Rgba32Float),
                [0.0, 0.0, 0.0, 1.0],
            ),
            output(
                "material",
                "Layer 0: Lambert reflectance (RGB), and the Phong lobe's number among the cosine lobes of the scene, or 0 \
                    without one (A). Layer 1: Phong reflectance k_s (RGB) and shininess n (A)",
                "",
                (Dimension::D2Array, Class::Data, Format::Rgba32Float),
                [0.0, 0.0, 0.0, 1.0],
            ),
            output(
                "triangle",
                "Index of the visible triangle in the scene, plus 1; 0 where there is none",
                "",
                (Dimension::D2, Class::Data, Format::R32Uint),
                [0.0; 4],
            ),
            output(
                "raster_depth",
                "The rasteriser's depth buffer: 1e-6 m, less in scenes smaller than 1 cm, over the distance along the view axis, 0 at infinity",
                "",
                (Dimension::D2, Class::RasterDepth, Format::Depth32Float),
                [0.0; 4],
            ),
        ]),
        params: Table::new(),
        presets: Vec::new(),
        scene: ["camera", "materials", "objects", "texels", "textures", "triangles", "vertex_colors", "vertices"]
            .map(str::to_owned)
            .into(),
        side_effect: false,
        revision: 1,
    }
}

fn output(
    name: &str,
    about: &str,
    unit: &str,
    (dimension, class, format): (Dimension, Class, Format),
    constant: [f32; 4],
) -> PortDescriptor {
    let mut size = SizeRule::frame(1.0);
    if dimension == Dimension::D2Array {
        size.depth = tyndall_plugin::descriptor::Extent::Fixed(2);
    }
    PortDescriptor {
        name: name.to_owned(),
        about: about.to_owned(),
        unit: unit.to_owned(),
        role: Role::Output { disabled: Disabled::Constant(constant) },
        kind: PortKind::Texture { dimension, class, format: Some(format), filtered: false },
        size: Some(size),
        unordered: false,
    }
}

struct Gbuffer {
    visibility: Raster,
    resolve: Kernel,
    size: [u32; 3],
}

impl Gbuffer {
    fn new(setup: &mut Setup<'_>, shaders: &Shaders) -> Result<Self, GpuError> {
        let targets = RasterTargets {
            colors: &[("triangle", Some([0.0; 4]))],
            depth: Some(("raster_depth", 0.0, wgpu::CompareFunction::Greater)),
        };
        let visibility = Raster::new(setup, shaders.get("visibility.wgsl")?, ("project", "shade"), &targets)?;
        let resolve = Kernel::new(setup, shaders.get("gbuffer.wgsl")?, "main")?;
        let size = match setup.pass.resource(setup.pass.port("depth")?) {
            Some(Resource::Texture { width, height, .. }) => [*width, *height, 1],
            _ => return Err(setup.pass.refuse("its depth is not a texture")),
        };
        Ok(Self { visibility, resolve, size })
    }
}

impl Program for Gbuffer {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        let vertices = 3 * recorder.scene_count("triangles");
        recorder.draw(&mut self.visibility, vertices)?;
        recorder.dispatch(&mut self.resolve, self.size)
    }
}
