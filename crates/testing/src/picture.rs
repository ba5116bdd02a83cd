//! What a port holds, as it is compared.

use tyndall_gpu::PortData;
use tyndall_graph::descriptor::Class;
use tyndall_image::Image;

/// The content of a port, and what its channels mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Its numbers. A buffer is an image of one channel: a row for each element.
    pub image: Image,
    /// What the channels mean.
    pub class: Class,
}

impl Picture {
    /// An image whose channels mean this.
    pub fn new(image: Image, class: Class) -> Self {
        Self { image, class }
    }

    /// The content of a port.
    pub fn of(data: &PortData, class: Class) -> Self {
        let image = match data.is_buffer {
            true => Image { width: data.channels, height: data.width, layers: 1, channels: 1, data: data.data.clone() },
            false => tyndall_render::image(data.clone()),
        };
        Self { image, class }
    }

    /// The channels that mean something, but for alpha.
    pub fn compared(&self) -> Image {
        match self.class {
            Class::Color | Class::Display | Class::Vector => self.image.first_channels(3),
            Class::Scalar | Class::RasterDepth => self.image.first_channels(1),
            Class::Data | Class::Any => self.image.clone(),
        }
    }

    /// Alpha of a colour that has one.
    pub fn alpha(&self) -> Option<Image> {
        let colour = matches!(self.class, Class::Color | Class::Display) && self.image.channels == 4;
        let data = || self.image.data.iter().skip(3).step_by(4).copied().collect();
        colour.then(|| Image { channels: 1, data: data(), ..self.image })
    }
}
