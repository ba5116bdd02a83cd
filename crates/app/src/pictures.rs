//! Ports as files.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use tyndall_gpu::{Executor, Numbers, PortData};
use tyndall_graph::{Handle, PlannedPort};
use tyndall_image::{FileKind, Meaning, Sample, resolved, supported};
use tyndall_render::{image, meaning, shape};

use crate::failure::Failure;

/// Reads a port of the last frame and writes it to a file, in the format of the file's suffix.
pub(crate) fn write_port(executor: &Executor, port: Handle<PlannedPort>, path: &Path) -> Result<(), Failure> {
    let data = executor.read(port)?;
    let meaning = meaning(executor.plan().ports[port].class);
    if supported(path)? != FileKind::Npy && !data.is_image() {
        return Err(no_picture(executor.plan().port_name(port), path));
    }
    match data.numbers() {
        Numbers::Floats(numbers) => write_numbers(path, &data, numbers, meaning),
        Numbers::Whole(numbers) => write_numbers(path, &data, numbers, meaning),
        // No texture holds numbers with a sign, and only `.npy` takes what is not a texture.
        Numbers::Signed(numbers) => Ok(tyndall_image::write_array(path, &shape(&data), &numbers)?),
    }
}

fn write_numbers<T: Sample>(path: &Path, data: &PortData, numbers: Vec<T>, meaning: Meaning) -> Result<(), Failure> {
    if supported(path)? != FileKind::Npy {
        return Ok(tyndall_image::write(path, &image(data, numbers), meaning)?);
    }
    let shape = shape(data);
    match meaning {
        Meaning::Color | Meaning::Vector | Meaning::Display if data.is_image() => {
            let image = image(data, numbers).first_channels(3);
            tyndall_image::write_array(path, &[shape[0], shape[1], 3], &image.data)?;
        }
        _ => tyndall_image::write_array(path, &shape, &numbers)?,
    }
    Ok(())
}

/// Only `.npy` can hold anything but two-dimensional textures.
pub(crate) fn no_picture(name: impl std::fmt::Display, path: &Path) -> Failure {
    Failure::Usage(format!(
        "`{name}` is not a two-dimensional picture, so {} cannot hold it: write .npy",
        path.display()
    ))
}

/// Refuses two paths to one file.
pub(crate) fn distinct(paths: &[PathBuf]) -> Result<(), Failure> {
    let mut known: HashMap<PathBuf, &PathBuf> = HashMap::new();
    for path in paths {
        let Some(other) = known.insert(resolved(path), path) else { continue };
        let also = if other.as_os_str() == path.as_os_str() { "" } else { &format!(" (also as {})", other.display()) };
        let path = path.display();
        return Err(Failure::Usage(format!("two outputs go to {path}{also}: one would overwrite the other")));
    }
    Ok(())
}
