//! Ports as files.

use std::path::Path;

use tyndall_gpu::Executor;
use tyndall_image::{FileKind, Meaning, supported};
use tyndall_render::{image, meaning, shape};

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
