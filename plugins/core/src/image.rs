//! `core.image`: a picture from a file.

use std::path::Path;

use tyndall_image::Image;
use tyndall_plugin::descriptor::{
    Class, Dimension, Disabled, Format, ParamDescriptor, ParamType, ParamValue, PassDescriptor, PortDescriptor,
    PortKind, Role, SizeRule,
};
use tyndall_plugin::{GpuError, Program, Recorder, Resource, RustPass, Setup, Table};

/// The pass.
pub(crate) fn pass() -> RustPass {
    RustPass {
        descriptor: descriptor(),
        shaders: Vec::new(),
        make: Box::new(|setup, _| Ok(Box::new(Picture::new(setup)?))),
    }
}

fn descriptor() -> PassDescriptor {
    PassDescriptor {
        name: "core.image".to_owned(),
        about: "A picture from a file: EXR, HDR, PNG (decoded to linear) or NPY, in its own size.".to_owned(),
        source: String::new(),
        ports: Table::from([PortDescriptor {
            name: "color".to_owned(),
            about: "The picture, linear, alpha 1 where the file has none".to_owned(),
            unit: String::new(),
            role: Role::Output { disabled: Disabled::Constant([0.0, 0.0, 0.0, 1.0]) },
            kind: PortKind::Texture {
                dimension: Dimension::D2,
                class: Class::Color,
                format: Some(Format::Rgba32Float),
                filtered: false,
            },
            size: Some(SizeRule::picture("file")),
            unordered: false,
        }]),
        params: Table::from([ParamDescriptor {
            name: "file".to_owned(),
            about: "Path of the picture, from the graph file".to_owned(),
            unit: String::new(),
            accepts: ParamType::File,
            default: ParamValue::File(String::new()),
            fixed: true,
        }]),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 1,
    }
}

struct Picture {
    texels: Vec<u8>,
}

impl Picture {
    fn new(setup: &Setup<'_>) -> Result<Self, GpuError> {
        let Some(ParamValue::File(path)) = setup.param("file") else {
            return Err(setup.pass.refuse("its `file` is not a path"));
        };
        let input = |reason: String| GpuError::Input { pass: setup.pass.name().to_owned(), reason };
        let image = tyndall_image::read(Path::new(path)).map_err(|error| input(error.to_string()))?;
        match setup.pass.resource(setup.pass.port("color")?) {
            Some(Resource::Texture { width, height, .. }) if (*width, *height) == (image.width, image.height) => {}
            _ => return Err(input(format!("{path} has changed its size since the graph was read: start again"))),
        }
        Ok(Self { texels: rgba(&image) })
    }
}

/// Four channels a texel: one is spread over the colours, a missing alpha is 1.
fn rgba(image: &Image) -> Vec<u8> {
    let channels = image.channels as usize;
    let texel = |texel: &[f32]| match *texel {
        [y] => [y, y, y, 1.0],
        [x, y] => [x, y, 0.0, 1.0],
        [r, g, b] => [r, g, b, 1.0],
        [r, g, b, a, ..] => [r, g, b, a],
        [] => [0.0, 0.0, 0.0, 1.0],
    };
    image.data.chunks_exact(channels.max(1)).flat_map(texel).flat_map(f32::to_le_bytes).collect()
}

impl Program for Picture {
    fn record(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        let port = recorder.pass.port("color")?;
        recorder.write_texture(port, &self.texels)
    }
}
