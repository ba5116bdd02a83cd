//! What a pass computes, in double precision on the CPU: what tests hold the pass against.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;
use tyndall_gpu::{Numbers, PortData};
use tyndall_graph::Resource;
use tyndall_graph::descriptor::ParamValue;
use tyndall_scene::Moment;
use tyndall_shaders::ray::{Ray, ray_of_pixel};
use tyndall_shaders::scene::{Scene, Surfaces};

/// What a pass computes, in double precision on the CPU.
///
/// # Errors
/// Why it cannot say.
pub type Reference = fn(&ReferenceInput<'_>) -> Outputs;

/// The numbers of each output that a reference knows, by port, as a read-back gives them; or why it cannot say.
pub type Outputs = Result<BTreeMap<&'static str, Numbers>, String>;

/// What a pass was given in a frame.
pub struct ReferenceInput<'a> {
    /// What was fed, by port.
    pub inputs: BTreeMap<&'a str, &'a PortData>,
    /// What each port is, inputs and outputs.
    pub resources: BTreeMap<&'a str, Resource>,
    /// Values of the parameters, by name.
    pub params: BTreeMap<&'a str, ParamValue>,
    /// The scene in this frame; `None` where the graph has none.
    pub scene: Option<&'a Scene>,
    /// The same as scene data are made from it, with the fields that plugins bring.
    pub moment: Option<&'a Moment<'a>>,
    /// The triangles of the scene in this frame; `None` where the pass reads none.
    pub surfaces: Option<&'a Surfaces>,
}

/// A pixel of a picture, and what its ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// Column and row; row 0 is the top.
    pub at: [u32; 2],
    /// Through the centre of the pixel.
    pub ray: Ray,
    /// Along the ray to the nearest surface, m: infinite where there is none, or where nothing is fed into `depth`.
    pub distance: f64,
}

impl ReferenceInput<'_> {
    /// What was fed into a port.
    ///
    /// # Errors
    /// Where nothing was.
    pub fn input(&self, port: &str) -> Result<&PortData, String> {
        self.inputs.get(port).copied().ok_or_else(|| format!("nothing is fed into `{port}`"))
    }

    /// Texels of a port in x, y and z (or layers).
    ///
    /// # Errors
    /// Where the port is a buffer, or is not there.
    pub fn extent(&self, port: &str) -> Result<[u32; 3], String> {
        match self.resources.get(port) {
            Some(Resource::Texture { width, height, depth_or_layers, .. }) => Ok([*width, *height, *depth_or_layers]),
            _ => Err(format!("`{port}` is not a texture")),
        }
    }

    /// Texels of a port in x and y.
    ///
    /// # Errors
    /// Those of [`extent`](Self::extent).
    pub fn size(&self, port: &str) -> Result<[u32; 2], String> {
        self.extent(port).map(|[width, height, _]| [width, height])
    }

    /// The value of a parameter that is one number.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn number(&self, param: &str) -> Result<f64, String> {
        match self.params.get(param) {
            Some(ParamValue::Float(value)) => Ok(*value),
            Some(ParamValue::Integer(value)) => Ok(*value as f64),
            _ => Err(format!("`{param}` is not a number")),
        }
    }

    /// The value of a parameter that is a colour.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn color(&self, param: &str) -> Result<DVec3, String> {
        match self.params.get(param) {
            Some(ParamValue::Vector(values)) if values.len() == 3 => Ok(DVec3::from_slice(values)),
            _ => Err(format!("`{param}` is not a colour")),
        }
    }

    /// The value of a parameter that is one of several words.
    ///
    /// # Errors
    /// Where it is something else.
    pub fn choice(&self, param: &str) -> Result<&str, String> {
        match self.params.get(param) {
            Some(ParamValue::Choice(word)) => Ok(word),
            _ => Err(format!("`{param}` is not one of several words")),
        }
    }

    /// Whether a switch is on.
    pub fn is_on(&self, param: &str) -> bool {
        self.params.get(param) == Some(&ParamValue::Bool(true))
    }

    /// The scene.
    ///
    /// # Errors
    /// Where there is none.
    pub fn scene(&self) -> Result<&Scene, String> {
        self.scene.ok_or_else(|| "the graph has no scene".to_owned())
    }

    /// The scene as scene data are made from it.
    ///
    /// # Errors
    /// Where there is none.
    pub fn moment(&self) -> Result<&Moment<'_>, String> {
        self.moment.ok_or_else(|| "the graph has no scene".to_owned())
    }

    /// The triangles of the scene.
    ///
    /// # Errors
    /// Where there is no scene, or the pass reads no triangles.
    pub fn surfaces(&self) -> Result<&Surfaces, String> {
        self.surfaces.ok_or_else(|| "the pass reads no triangles".to_owned())
    }

    /// What `value` makes of every texel (x, y, layer) of a port, in the order of [`each_texel`].
    ///
    /// # Errors
    /// Those of [`extent`](Self::extent).
    pub fn texels<T: Send>(&self, port: &str, value: impl Fn([u32; 3]) -> T + Sync) -> Result<Vec<T>, String> {
        Ok(each_texel(self.extent(port)?, value))
    }

    /// What `value` makes of every pixel of a port that is a picture taken by the scene's camera.
    ///
    /// # Errors
    /// Those of [`extent`](Self::extent), and where there is no scene.
    pub fn pixels<T: Send>(&self, port: &str, value: impl Fn(&Pixel) -> T + Sync) -> Result<Vec<T>, String> {
        let (camera, size, depth) = (&self.scene()?.camera, self.size(port)?, self.inputs.get("depth"));
        self.texels(port, |[x, y, _]| {
            let distance = depth.map_or(f64::INFINITY, |depth| depth.texel([x, y, 0])[0]);
            value(&Pixel { at: [x, y], ray: ray_of_pixel(camera, [x, y], size), distance })
        })
    }

    /// A port of colours: `color` of every texel (x, y), and alpha 1.
    ///
    /// # Errors
    /// Those of [`extent`](Self::extent).
    pub fn picture(&self, port: &'static str, color: impl Fn([u32; 2]) -> DVec3 + Sync) -> Outputs {
        let colors = self.texels(port, |[x, y, _]| color([x, y]))?;
        Ok(BTreeMap::from([(port, rgba(colors))]))
    }

    /// A port of colours that the scene's camera sees: `color` of every pixel, and alpha 1.
    ///
    /// # Errors
    /// Those of [`pixels`](Self::pixels).
    pub fn view(&self, port: &'static str, color: impl Fn(&Pixel) -> DVec3 + Sync) -> Outputs {
        Ok(BTreeMap::from([(port, rgba(self.pixels(port, color)?))]))
    }
}

/// What `value` makes of every texel (x, y, layer) of a grid: row by row from the top, one layer after another.
///
/// The texels are spread over the cores. What comes out does not depend on how many there are.
pub fn each_texel<T: Send>(extent: [u32; 3], value: impl Fn([u32; 3]) -> T + Sync) -> Vec<T> {
    let [width, height, layers] = extent.map(|size| size as usize);
    let at = |index: usize| [index % width, index / width % height, index / width / height].map(|place| place as u32);
    (0..width * height * layers).into_par_iter().map(|index| value(at(index))).collect()
}

/// The colour of a texel.
pub fn rgb(data: &PortData, [x, y]: [u32; 2]) -> DVec3 {
    let [r, g, b, _] = data.texel([x, y, 0]);
    DVec3::new(r, g, b)
}

/// The numbers of colours, alpha 1.
pub fn rgba(colors: impl IntoIterator<Item = DVec3>) -> Numbers {
    colors.into_iter().flat_map(|color| color.extend(1.0).as_vec4().to_array()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_come_in_the_order_of_a_read_back() {
        let all = each_texel([3, 2, 2], |at| at);
        let expected = (0..2).flat_map(|z| (0..2).flat_map(move |y| (0..3).map(move |x| [x, y, z])));
        assert_eq!(all, expected.collect::<Vec<_>>());
        assert_eq!(each_texel([0, 4, 1], |at| at), Vec::<[u32; 3]>::new());
    }

    #[test]
    fn any_number_of_threads_makes_the_same() {
        let sum = |[x, y, _]: [u32; 3]| (1..=100).map(|k| (f64::from(x * k) + 0.1).sin() / f64::from(y + k)).sum();
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
            let all: Vec<f64> = pool.install(|| each_texel([17, 5, 1], sum));
            all.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(on(1), on(3));
    }
}
