//! What a port holds, as it is compared.

use tyndall_gpu::PortData;
use tyndall_graph::descriptor::Class;
use tyndall_image::Image;

/// The longest side of a golden, in texels; in all its layers it has no more than a square of this side.
pub const MOST_SIDE: u32 = 96;

/// The content of a port, and what its channels mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Its numbers, each exactly as the port holds it. A buffer is an image of one channel: a row for each element.
    pub image: Image<f64>,
    /// What the channels mean.
    pub class: Class,
    /// It is a buffer: each number of an element means something else.
    pub is_buffer: bool,
}

impl Picture {
    /// An image whose channels mean this.
    pub fn new<T: Copy + Into<f64>>(image: Image<T>, class: Class) -> Self {
        Self { image: image.exact(), class, is_buffer: false }
    }

    /// The same with other numbers.
    #[must_use]
    pub fn with(&self, image: Image<f64>) -> Self {
        Self { image, ..*self }
    }

    /// The content of a port.
    pub fn of(data: &PortData, class: Class) -> Self {
        let image = tyndall_render::image(data, data.exact().collect());
        let image = match data.is_buffer() {
            true => Image { width: image.channels, height: image.width, channels: 1, ..image },
            false => image,
        };
        Self { image, class, is_buffer: data.is_buffer() }
    }

    /// The channels that mean something, but for alpha.
    pub fn compared(&self) -> Image<f64> {
        match self.class {
            Class::Color | Class::Display | Class::Vector => self.image.first_channels(3),
            Class::Scalar | Class::RasterDepth => self.image.first_channels(1),
            Class::Data | Class::Any => self.image.clone(),
        }
    }

    /// No larger than a golden may be: every k-th texel along each axis, with the least k that leaves no more than a square
    /// of 96; along a side that is longer still, fewer. Of a buffer every k-th element, whole.
    #[must_use]
    pub fn thinned(&self) -> Self {
        self.thinned_to(MOST_SIDE)
    }

    fn thinned_to(&self, side: u32) -> Self {
        let Image { width, height, layers, channels, .. } = self.image;
        let most = u64::from(side) * u64::from(side);
        let steps = |step: u32| match self.is_buffer {
            true => [1, step, 1],
            false => [step.max(width.div_ceil(side)), step.max(height.div_ceil(side)), step],
        };
        let left = |steps: [u32; 3]| [0, 1, 2].map(|axis| [width, height, layers][axis].div_ceil(steps[axis].max(1)));
        let fits = |step: &u32| left(steps(*step)).into_iter().map(u64::from).product::<u64>() <= most;
        let longest = width.max(height).max(layers);
        let steps = steps((1..=longest).find(fits).unwrap_or(longest)).map(|step| step.max(1));
        if steps == [1; 3] {
            return self.clone();
        }
        let axis = |extent: u32, step: u32| (0..extent).step_by(step as usize);
        let texels = axis(layers, steps[2]).flat_map(|layer| {
            axis(height, steps[1]).flat_map(move |y| axis(width, steps[0]).map(move |x| (layer, x, y)))
        });
        let data =
            texels.filter_map(|(layer, x, y)| self.image.pixel_in_layer(layer, x, y)).flatten().copied().collect();
        let [width, height, layers] = left(steps);
        self.with(Image { width, height, layers, channels, data })
    }

    /// Whether a golden may be as large.
    pub(crate) fn fits_golden(&self) -> bool {
        self.thinned().image.data.len() == self.image.data.len()
    }

    /// What is compared as a whole: of data ports each channel of each layer, and each number of a buffer's elements, for
    /// they mean different things; everything of others.
    pub(crate) fn planes(&self) -> Vec<Image<f64>> {
        let image = self.compared();
        let (width, texels) = (image.width as usize, (image.width * image.height) as usize);
        let every = |first: usize, step: usize, count: usize| -> Vec<f64> {
            image.data[first..].iter().step_by(step).take(count).copied().collect()
        };
        if self.is_buffer {
            let elements = image.height as usize;
            return (0..width).map(|at| Image::new(image.height, 1, 1, every(at, width, elements))).collect();
        }
        if self.class != Class::Data || image.channels * image.layers == 1 {
            return vec![image];
        }
        let channels = image.channels as usize;
        let places = (0..image.layers as usize).flat_map(|layer| (0..channels).map(move |channel| (layer, channel)));
        let plane = |(layer, channel)| every(layer * texels * channels + channel, channels, texels);
        places.map(|place| Image::new(image.width, image.height, 1, plane(place))).collect()
    }

    /// A summary: mean, least and largest number, and how many are NaN or infinite.
    pub(crate) fn figures(&self) -> String {
        let image = self.compared();
        let numbers = image.data.iter().copied().filter(|number| number.is_finite());
        let (least, largest) = numbers.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, largest), number| {
            (least.min(number), largest.max(number))
        });
        let count = numbers.clone().count();
        let others = image.data.len() - count;
        let finite = match count {
            0 => "no number".to_owned(),
            _ => {
                let mean = numbers.sum::<f64>() / count as f64;
                format!("mean {mean:.4e}, {least:.4e} to {largest:.4e}")
            }
        };
        if others > 0 { format!("{finite}, {others} NaN or infinite") } else { finite }
    }

    /// Alpha of a colour that has one.
    pub fn alpha(&self) -> Option<Image<f64>> {
        let colour = matches!(self.class, Class::Color | Class::Display) && self.image.channels == 4;
        let data = || self.image.data.iter().skip(3).step_by(4).copied().collect();
        colour.then(|| Image { channels: 1, data: data(), ..self.image })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_is_thinned_along_every_axis() {
        let data = (0..6 * 4 * 2).map(f64::from).collect();
        let picture = Picture::new(Image { width: 6, height: 4, layers: 2, channels: 1, data }, Class::Data);
        assert_eq!(picture.thinned_to(7), picture);
        let thinned = picture.thinned_to(6);
        assert_eq!((thinned.image.width, thinned.image.height, thinned.image.layers), (3, 2, 1));
        assert_eq!(thinned.image.data, [0.0, 2.0, 4.0, 12.0, 14.0, 16.0]);
    }

    /// A side that is too long is thinned though there are few texels in all, and the other is not.
    #[test]
    fn no_side_is_too_long() {
        let data = (0..8 * 2).map(f64::from).collect();
        let picture = Picture::new(Image { width: 8, height: 2, layers: 1, channels: 1, data }, Class::Data);
        let thinned = picture.thinned_to(4);
        assert_eq!((thinned.image.width, thinned.image.height), (4, 2));
        assert_eq!(thinned.image.data, [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]);
        assert!(Picture::new(Image::filled(128, 72, &[1.0]), Class::Scalar).thinned().image.width <= MOST_SIDE);
    }

    /// The numbers of an element mean different things: none is left out for good.
    #[test]
    fn a_buffer_keeps_whole_elements() {
        let data = (0..12).map(f64::from).collect();
        let image = Image { width: 3, height: 4, layers: 1, channels: 1, data };
        let buffer = Picture { image, class: Class::Data, is_buffer: true };
        assert_eq!(buffer.thinned_to(3).image.data, [0.0, 1.0, 2.0, 6.0, 7.0, 8.0]);
        assert_eq!(buffer.thinned_to(4), buffer);
    }
}
