//! Ports as files.

use std::path::Path;

use tyndall_gpu::{Executor, PortData};
use tyndall_graph::descriptor::Class;
use tyndall_image::{FileKind, Image, Meaning, supported};

use crate::failure::Failure;

/// Reads a port of the last frame and writes it to a file, in the format of the file's suffix.
pub(crate) fn write_port(executor: &Executor, port: u32, path: &Path) -> Result<(), Failure> {
    let data = executor.read(port)?;
    let meaning = meaning(executor.plan().ports[port as usize].class);
    if supported(path)? == FileKind::Npy {
        let shape = shape(&data);
        match meaning {
            Meaning::Color | Meaning::Vector | Meaning::Display if data.is_image => {
                let image = image(data).first_channels(3);
                tyndall_image::write_array(path, &[shape[0], shape[1], 3], &image.data)?;
            }
            _ => tyndall_image::write_array(path, &shape, &data.data)?,
        }
        return Ok(());
    }
    if data.is_image {
        return Ok(tyndall_image::write(path, &image(data), meaning)?);
    }
    Err(no_picture(executor.plan().port_name(port), path))
}

/// Only `.npy` holds what is no two-dimensional texture.
pub(crate) fn no_picture(name: impl std::fmt::Display, path: &Path) -> Failure {
    Failure::Usage(format!("`{name}` is no two-dimensional picture, so {} cannot hold it: write .npy", path.display()))
}

fn meaning(class: Class) -> Meaning {
    match class {
        Class::Color => Meaning::Color,
        Class::Scalar | Class::RasterDepth => Meaning::Scalar,
        Class::Vector => Meaning::Vector,
        Class::Display => Meaning::Display,
        Class::Data | Class::Any => Meaning::Data,
    }
}

fn image(data: PortData) -> Image {
    Image { width: data.width, height: data.height, layers: data.layers, channels: data.channels, data: data.data }
}

/// (height, width, channels) of pictures, colours and vectors with three, (layers, height, width, channels) of other textures, (elements, numbers) of
/// buffers; one channel makes no axis.
fn shape(data: &PortData) -> Vec<usize> {
    let (width, height, layers) = (data.width as usize, data.height as usize, data.layers as usize);
    let mut shape = match (data.is_buffer, data.is_image) {
        (true, _) => vec![width],
        (false, true) => vec![height, width],
        (false, false) => vec![layers, height, width],
    };
    if data.channels > 1 {
        shape.push(data.channels as usize);
    }
    shape
}
