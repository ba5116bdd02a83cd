//! Ports as images.

use tyndall_gpu::PortData;
use tyndall_graph::descriptor::Class;
use tyndall_image::{Image, Meaning};

/// What the channels of a port of this class mean in a file.
pub fn meaning(class: Class) -> Meaning {
    match class {
        Class::Color => Meaning::Color,
        Class::Scalar | Class::RasterDepth => Meaning::Scalar,
        Class::Vector => Meaning::Vector,
        Class::Display => Meaning::Display,
        Class::Data | Class::Any => Meaning::Data,
    }
}

/// The numbers of a texture port as an image; of a buffer, an image of one row.
pub fn image<T>(data: &PortData, numbers: Vec<T>) -> Image<T> {
    let (width, height, layers, channels) = (data.width(), data.height(), data.layers(), data.channels());
    Image { width, height, layers, channels, data: numbers }
}

/// The shape of an `.npy` array that holds a port: (height, width, channels) of pictures, colours and vectors with
/// three, (layers, height, width, channels) of other textures, (elements, numbers) of buffers; one channel makes no axis.
pub fn shape(data: &PortData) -> Vec<usize> {
    let (width, height, layers) = (data.width() as usize, data.height() as usize, data.layers() as usize);
    let mut shape = match (data.is_buffer(), data.is_image()) {
        (true, _) => vec![width],
        (false, true) => vec![height, width],
        (false, false) => vec![layers, height, width],
    };
    if data.channels() > 1 {
        shape.push(data.channels() as usize);
    }
    shape
}
