//! A scene at one time as the twins of shaders take it.

use glam::{DAffine3, DVec3};
use tyndall_shaders::scene as twin;

use crate::frame::{Frame, FrameLight, View};
use crate::model::{Filter, Instance, LightKind, Material, Texture, Wrap};
use crate::scene::Scene;

impl Scene {
    /// What [`Scene::encode`] gives shaders, in double precision, for the twins of shaders; of surfaces the
    /// shadows alone.
    pub fn twin(&self, time: f64, aspect: f64) -> twin::Scene {
        let frame = self.at(time);
        let shiny = self.materials.iter().filter(|material| material.is_shiny());
        twin::Scene {
            camera: camera(&frame.camera, aspect),
            medium: self.medium.unwrap_or(twin::Medium {
                extinction: DVec3::ZERO,
                albedo: DVec3::ONE,
                phase: twin::Phase::Isotropic,
            }),
            height_fog: self.height_fog_from_origin(),
            ambient: self.ambient,
            background: self.background,
            lights: frame.lights.iter().map(light).collect(),
            casters: self.casters(&frame),
            shininesses: shiny.map(|material| material.shininess).collect(),
        }
    }

    /// The triangles of all objects that cast shadows, from the scene's origin.
    pub(crate) fn casters(&self, frame: &Frame) -> Vec<twin::Caster> {
        let instances = self.instances.iter().zip(&frame.transforms).filter(|(instance, _)| instance.casts_shadow);
        let triangles = instances.flat_map(|(instance, transform)| {
            let corner = |index: u32| transform.transform_point3(instance.mesh.positions[index as usize].as_dvec3());
            instance.mesh.triangles.iter().map(move |triangle| triangle.map(corner))
        });
        triangles.collect()
    }

    /// The triangles that [`Scene::encode`] gives shaders, and what they look like, in double precision.
    pub fn surfaces(&self, time: f64) -> twin::Surfaces {
        let frame = self.at(time);
        let shininesses = self.shininesses();
        let instances = self.instances.iter().zip(&frame.transforms);
        twin::Surfaces {
            triangles: instances.flat_map(|(instance, transform)| triangles(instance, *transform)).collect(),
            materials: self.materials.iter().map(|of| material(of, of.shininess_rank(&shininesses))).collect(),
            textures: self.textures.iter().map(texture).collect(),
        }
    }
}

/// Triangles of an instance where it stands, turned around where its transform mirrors.
fn triangles(instance: &Instance, transform: DAffine3) -> impl Iterator<Item = twin::Triangle> + '_ {
    let (mesh, mirrored) = (&instance.mesh, transform.matrix3.determinant() < 0.0);
    let normals = transform.matrix3.inverse().transpose();
    let vertex = move |index: u32| {
        let index = index as usize;
        twin::Vertex {
            position: transform.transform_point3(mesh.positions[index].as_dvec3()),
            normal: (normals * mesh.normals[index].as_dvec3()).normalize(),
            uv: mesh.uvs[index].as_dvec2(),
            color: instance.color(index).as_dvec3(),
        }
    };
    mesh.triangles.iter().map(move |&[a, b, c]| {
        let (b, c) = if mirrored { (c, b) } else { (b, c) };
        twin::Triangle { corners: [a, b, c].map(&vertex), material: instance.material }
    })
}

fn material(material: &Material, shininess_rank: u32) -> twin::Material {
    let Material { diffuse, specular, shininess, texture, metallic_roughness, .. } = *material;
    let metallic_roughness = metallic_roughness.map(|metal| [metal.metallic, metal.lobe.peak, metal.lobe.most]);
    twin::Material { diffuse, specular, shininess, shininess_rank, texture, metallic_roughness }
}

fn texture(texture: &Texture) -> twin::Texture {
    let wrap = |wrap: Wrap| match wrap {
        Wrap::Repeat => twin::Wrap::Repeat,
        Wrap::Clamp => twin::Wrap::Clamp,
        Wrap::Mirror => twin::Wrap::Mirror,
    };
    let filter = match texture.filter {
        Filter::Linear => twin::Filter::Linear,
        Filter::Nearest => twin::Filter::Nearest,
    };
    twin::Texture {
        width: texture.width,
        height: texture.height,
        wrap: texture.wrap.map(wrap),
        filter,
        texels: texture.texels.iter().map(|texel| texel.to_le_bytes()).collect(),
    }
}

fn camera(view: &View, aspect: f64) -> twin::Camera {
    let tangent = (view.vertical_fov / 2.0).tan();
    let (right, up) = (view.right * tangent * aspect, view.up * tangent);
    twin::Camera { position: view.position, nearest: view.nearest, right, up, forward: view.forward }
}

fn light(light: &FrameLight) -> twin::Light {
    let FrameLight { kind, position, direction, intensity, radius } = *light;
    match kind {
        LightKind::Point => twin::Light::Point { position, intensity, radius },
        LightKind::Directional => twin::Light::Directional { direction, irradiance: intensity },
        LightKind::Spot { exponent, cutoff } => {
            twin::Light::Spot { position, intensity, radius, direction, exponent, cutoff: cutoff.to_degrees() }
        }
    }
}
