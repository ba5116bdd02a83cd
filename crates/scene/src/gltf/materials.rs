//! Metallic-roughness materials of a glTF file: see [`crate::microfacets`].

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use gltf::json::material::{AlphaMode, Material as JsonMaterial};
use gltf::json::texture::{Info, MagFilter, Sampler, WrappingMode};
use gltf::json::validation::Checked::Valid;
use image::RgbaImage;

use super::accessors::{Data, absent};
use super::fault::{At, Checked, Fault, Report, Unread, element, numbered};
use super::files::Folder;
use super::images::Images;
use super::meshes::UvSource;
use crate::codes::{GLTF_MATERIAL, GLTF_REFERENCE};
use crate::microfacets::Lobe;
use crate::model::{Filter, Material, MetallicRoughness, Texture, Wrap};

/// The materials of a file that are drawn.
#[derive(Default)]
pub(crate) struct Materials {
    /// By index in the file; unused or faulty ones are the default.
    pub materials: Vec<Material>,
    /// The texture coordinates that each needs.
    pub uvs: Vec<Option<UvSource>>,
    /// To which the materials refer.
    pub textures: Vec<Texture>,
}

/// How a texture is read: outside of 0..1 along u and v, and between texels.
type Sampling = ([Wrap; 2], Filter);

/// Where a texture comes from: base colour image, metallic image, and how it is read.
type Key = (Option<usize>, Option<usize>, Sampling);

struct Reader<'a> {
    data: Data<'a>,
    images: Images<'a>,
    textures: Vec<Texture>,
    known: BTreeMap<Key, usize>,
}

/// Reads the materials with the given indices.
pub(crate) fn read(data: Data, folder: &mut Folder, used: &BTreeSet<usize>, report: &mut Report) -> Materials {
    let count = data.root.materials.len();
    let images = Images::new(data, folder);
    let mut reader = Reader { data, images, textures: Vec::new(), known: BTreeMap::new() };
    let mut result =
        Materials { materials: vec![Material::default(); count], uvs: vec![None; count], textures: Vec::new() };
    for &index in used {
        let Some(json) = data.root.materials.get(index) else {
            continue; // The primitive that names it reports it.
        };
        let label = || element("material", index, json.name.as_deref());
        let material = reader.material(index, report).at(label);
        if let Some((material, uv)) = report.take(material) {
            result.materials[index] = material;
            result.uvs[index] = uv;
        }
    }
    result.textures = reader.textures;
    result
}

/// A texture of a material: image, how it is read, texture coordinates.
#[derive(Clone, Copy, PartialEq)]
struct Sampled {
    image: usize,
    sampling: Sampling,
    uv: UvSource,
}

impl Reader<'_> {
    fn material(&mut self, index: usize, report: &mut Report) -> Checked<(Material, Option<UvSource>)> {
        let json = &self.data.root.materials[index];
        let pbr = &json.pbr_metallic_roughness;
        let [red, green, blue, _] = pbr.base_color_factor.0;
        let mut factor = [0.0; 3];
        for (slot, value) in factor.iter_mut().zip([red, green, blue]) {
            *slot = unit_interval("baseColorFactor", value)?;
        }
        let metallic = unit_interval("metallicFactor", pbr.metallic_factor.0)?;
        let roughness = unit_interval("roughnessFactor", pbr.roughness_factor.0)?;
        let mut unread = |what| report.unread(what, numbered(index, json.name.as_deref()));
        unread_of(json).for_each(&mut unread);
        let base = self.sampled(pbr.base_color_texture.as_ref(), "baseColorTexture")?;
        let surface = self.sampled(pbr.metallic_roughness_texture.as_ref(), "metallicRoughnessTexture")?;
        let means = surface.map(|surface| Ok(Means::of(self.images.get(surface.image)?.as_ref()))).transpose()?;
        if means.is_some_and(|means| means.rough_varies) && roughness > 0.0 {
            unread(Unread::VARIED_ROUGHNESS);
        }
        let lobe = Lobe::of_roughness(roughness * means.map_or(1.0, |means| means.roughness));
        let of_one_texel = |factor: f64| factor * means.map_or(1.0, |means| means.metallic);
        let (metallic, metal, sampled) = match (base, surface) {
            (Some(base), Some(surface)) if base.uv != surface.uv && metallic > 0.0 => {
                unread(Unread::METALLIC_COORDINATES);
                (of_one_texel(metallic), None, Some(base))
            }
            (base, Some(surface)) if means.is_some_and(|means| means.metal_varies) && metallic > 0.0 => {
                (metallic, Some(surface.image), Some(base.unwrap_or(surface)))
            }
            _ => (of_one_texel(metallic), None, base),
        };
        let key = |sampled: Sampled| (base.map(|base| base.image), metal, sampled.sampling);
        let material = Material {
            diffuse: DVec3::from_array(factor),
            shininess: lobe.shininess,
            texture: sampled.map(|sampled| self.texture(key(sampled))).transpose()?,
            metallic_roughness: Some(MetallicRoughness { metallic, lobe }),
            ..Material::default()
        };
        Ok((material, sampled.map(|sampled| sampled.uv)))
    }

    fn sampled(&self, info: Option<&Info>, name: &str) -> Checked<Option<Sampled>> {
        let Some(info) = info else { return Ok(None) };
        self.resolve(info).map(Some).at(|| name.to_owned())
    }

    fn resolve(&self, info: &Info) -> Checked<Sampled> {
        let root = self.data.root;
        let index = info.index.value();
        let texture = root.textures.get(index).ok_or_else(|| absent("texture", index))?;
        let label = || element("texture", index, texture.name.as_deref());
        if let Some(extensions) = self.data.left_out.sources.get(&index) {
            return Err(no_source(extensions)).at(label);
        }
        let image = texture.source.value();
        if image >= root.images.len() {
            return Err(absent("image", image)).at(label);
        }
        let sampling = match texture.sampler.map(|s| s.value()) {
            None => Sampling::default(),
            Some(index) => sampling(root.samplers.get(index).ok_or_else(|| absent("sampler", index))?),
        };
        let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
        let uv = match transform {
            None => UvSource::new(info.tex_coord, [0.0; 2], 0.0, [1.0; 2]),
            Some(t) => UvSource::new(t.tex_coord.unwrap_or(info.tex_coord), t.offset.0, t.rotation.0, t.scale.0),
        };
        if !uv.transform.is_finite() {
            return Err(Fault::new(GLTF_MATERIAL, "KHR_texture_transform is not finite"));
        }
        Ok(Sampled { image, sampling, uv })
    }

    /// The texture of a base colour image and of a metallic one, either of which may be absent.
    fn texture(&mut self, key: Key) -> Checked<usize> {
        let (base, metal, sampling) = key;
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        let mut image = |index: Option<usize>| index.map(|index| self.images.get(index)).transpose();
        let (base, metal) = (image(base)?, image(metal)?);
        self.textures.push(packed(base.as_deref(), metal.as_deref(), sampling));
        self.known.insert(key, self.textures.len() - 1);
        Ok(self.textures.len() - 1)
    }
}

/// What of a material is not read, whatever its textures are.
fn unread_of(material: &JsonMaterial) -> impl Iterator<Item = Unread> {
    let emits = material.emissive_factor.0 != [0.0; 3];
    [
        (material.alpha_mode != Valid(AlphaMode::Opaque), Unread::ALPHA),
        (emits, Unread::EMISSION),
        (material.normal_texture.is_some(), Unread::NORMAL_MAP),
        (material.occlusion_texture.is_some(), Unread::OCCLUSION),
    ]
    .into_iter()
    .filter_map(|(is, what)| is.then_some(what))
}

/// A texture may have its picture in a form that only an extension can name.
fn no_source(extensions: &[String]) -> Fault {
    let unread = match extensions {
        [] => String::new(),
        [one] => format!(" ({one} is not read)"),
        _ => format!(" ({} are not read)", extensions.join(" and ")),
    };
    Fault::new(GLTF_REFERENCE, format!("has no source{unread}"))
}

/// Where nothing is drawn smaller than it is, the filter for what is drawn larger is the only one.
fn sampling(sampler: &Sampler) -> Sampling {
    let wrap = [sampler.wrap_s, sampler.wrap_t].map(|mode| match mode {
        Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        _ => Wrap::Repeat,
    });
    let nearest = matches!(sampler.mag_filter, Some(Valid(MagFilter::Nearest)));
    (wrap, if nearest { Filter::Nearest } else { Filter::Linear })
}

/// `Texture.sampling` of `scene.wgsl`.
pub(crate) fn encoded_sampling(texture: &Texture) -> u32 {
    let nearest = u32::from(texture.filter == Filter::Nearest);
    texture.wrap[0] as u32 | (texture.wrap[1] as u32) << 2 | nearest << 4
}

fn unit_interval(name: &str, value: f32) -> Checked<f64> {
    // Exporters round; what is further out was not meant.
    if (-1e-3..=1.001).contains(&value) {
        Ok(f64::from(value).clamp(0.0, 1.0))
    } else {
        Err(Fault::new(GLTF_MATERIAL, format!("{name} {value} does not lie in 0..1")))
    }
}

/// What the texels of a metallic-roughness image have in common, 0 to 1.
#[derive(Clone, Copy)]
struct Means {
    roughness: f64,
    rough_varies: bool,
    metallic: f64,
    metal_varies: bool,
}

impl Means {
    /// Roughness is green, metallic blue (glTF 2.0, 3.9.2).
    fn of(image: &RgbaImage) -> Means {
        let channel = |channel: usize| {
            let values = || image.pixels().map(|texel| texel.0[channel]);
            let mean = values().map(u64::from).sum::<u64>() as f64 / 255.0 / f64::from(image.width() * image.height());
            (mean, values().min() != values().max())
        };
        let ((roughness, rough_varies), (metallic, metal_varies)) = (channel(1), channel(2));
        Means { roughness, rough_varies, metallic, metal_varies }
    }
}

/// A base colour with the metallic factor of each texel as its alpha, in the size of the former.
fn packed(base: Option<&RgbaImage>, metal: Option<&RgbaImage>, (wrap, filter): Sampling) -> Texture {
    let (width, height) = base.or(metal).map_or((1, 1), RgbaImage::dimensions);
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let [red, green, blue, _] = base.map_or([255; 4], |image| image.get_pixel(x, y).0);
            let at = |i: u32, size: u32, other: u32| (u64::from(i) * u64::from(other) / u64::from(size)) as u32;
            let metallic = metal
                .map_or(255, |image| image.get_pixel(at(x, width, image.width()), at(y, height, image.height())).0[2]);
            texels.push(u32::from_le_bytes([red, green, blue, metallic]));
        }
    }
    Texture { width, height, wrap, filter, texels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn a_texel_has_base_colour_and_metallic_factor() {
        let base = RgbaImage::from_pixel(4, 2, Rgba([200, 100, 0, 7]));
        let metal = RgbaImage::from_fn(2, 1, |x, _| Rgba([9, 9, x as u8 * 255, 9]));
        let texel = |texture: &Texture, x: usize| texture.texels[x].to_le_bytes();
        let texture = packed(Some(&base), Some(&metal), Sampling::default());
        assert_eq!([1, 2].map(|x| texel(&texture, x)), [[200, 100, 0, 0], [200, 100, 0, 255]]);
        assert_eq!(texel(&packed(Some(&base), None, Sampling::default()), 0), [200, 100, 0, 255]);
        assert_eq!(texel(&packed(None, Some(&metal), Sampling::default()), 0), [255, 255, 255, 0]);
    }
}
