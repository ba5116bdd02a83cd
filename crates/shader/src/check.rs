//! Checks that a shader and its pass agree.
//!
//! In both directions: everything that is declared has its variable, of the declared kind, and every variable is declared.
//! Descriptors come from manifests or Rust, so what is missing in a shader is reported at its file, and what disagrees at
//! the variable.

mod params;
mod ports;

use tyndall_document::{Diagnostic, Diagnostics, Place, did_you_mean, near};
use tyndall_graph::descriptor::PassDescriptor;

use crate::codes;
use crate::link::Linked;
use crate::naming::{PARAMS, SAMPLERS, UNFINISHED, sampler};
use crate::reflect::{Resource, ResourceKind};

/// Checks a pass of one shader. `scene_names` are all scene data that there are.
pub fn check(linked: &Linked, descriptor: &PassDescriptor, scene_names: &[&str]) -> Vec<Diagnostic> {
    check_all(&[linked], descriptor, scene_names, &[])
}

/// Checks a pass of several shaders: each may use a part of what is declared, together they use all of it.
///
/// `private` are variables that the pass binds by itself (a table that it computed, a texture between two of its
/// dispatches).
pub fn check_all(
    shaders: &[&Linked],
    descriptor: &PassDescriptor,
    scene_names: &[&str],
    private: &[&str],
) -> Vec<Diagnostic> {
    let mut out = Vec::new();
    let pass = Pass { shaders, descriptor, scene_names, private };
    for linked in shaders.iter().filter(|linked| linked.entry_points.is_empty()) {
        let name = linked.sources().next().map(|root| root.name().to_owned()).unwrap_or_default();
        let problem = Diagnostic::error(codes::ENTRY, Place::File(name), "the shader has no entry point");
        out.push(problem.suggest("a pass starts at `@compute @workgroup_size(8, 8) fn main(…)`"));
    }
    if !out.is_empty() {
        return out;
    }
    for linked in shaders {
        for resource in &linked.resources {
            pass.resource(resource, &mut out);
        }
        out.extend(linked.unused.iter().map(|unused| {
            let message = format!("`{}` is declared, but no entry point uses it", unused.name);
            Diagnostic::error(codes::UNUSED, unused.place.clone(), message).suggest("use it or remove it")
        }));
    }
    ports::missing(&pass, &mut out);
    params::check(&pass, &mut out);
    pass.scene(&mut out);
    in_file_order(out)
}

/// Problems at a place in a file first, then what is missing from it.
fn in_file_order(problems: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let (placed, missing): (Diagnostics, Diagnostics) =
        problems.into_iter().partition(|problem| matches!(problem.place, Place::Text { .. }));
    let mut out = placed;
    out.sort();
    out.extend(missing);
    out.into_iter().collect()
}

/// A pass and its shaders.
struct Pass<'a> {
    shaders: &'a [&'a Linked],
    descriptor: &'a PassDescriptor,
    scene_names: &'a [&'a str],
    private: &'a [&'a str],
}

impl Pass<'_> {
    fn resources(&self) -> impl Iterator<Item = &Resource> {
        self.shaders.iter().flat_map(|linked| &linked.resources)
    }

    /// Where something that a shader lacks is reported: at its file.
    fn file(&self) -> Place {
        let root = self.shaders.first().and_then(|linked| linked.sources().next());
        Place::File(root.map_or_else(|| self.descriptor.name.clone(), |root| root.name().to_owned()))
    }

    fn resource(&self, resource: &Resource, out: &mut Vec<Diagnostic>) {
        let name = resource.name.as_str();
        if let Some(port) = self.descriptor.port(name) {
            ports::agree(port, resource, out);
        } else if self.private.contains(&name) || name == PARAMS {
            if name == PARAMS && !matches!(resource.kind, ResourceKind::Uniform { .. }) {
                let message = format!("`{PARAMS}` holds the parameters, so it must be a uniform");
                let problem = Diagnostic::error(codes::PARAM, resource.place.clone(), message);
                out.push(problem.suggest(format!("declare `var<uniform> {PARAMS}: Params;`")));
            }
        } else if name == UNFINISHED {
            if !matches!(resource.kind, ResourceKind::StorageBuffer { read_only: false, .. }) {
                let message =
                    format!("`{UNFINISHED}` is reserved for the count of threads whose loops were ended early");
                let problem = Diagnostic::error(codes::VARIABLE, resource.place.clone(), message);
                out.push(problem.suggest(format!("write `#import {UNFINISHED}`, or choose another name")));
            }
        } else if self.scene_names.contains(&name) {
            self.scene_variable(resource, out);
        } else if sampler(name).is_some() {
            if !matches!(resource.kind, ResourceKind::Sampler { comparison: false, .. }) {
                let message = format!("`{name}` is the name of a sampler");
                let problem = Diagnostic::error(codes::VARIABLE, resource.place.clone(), message);
                out.push(problem.suggest(format!("declare `var {name}: sampler;`, or choose another name")));
            }
        } else {
            out.push(self.unknown(resource));
        }
    }

    /// Whether the variable is neither declared nor known.
    fn is_unknown(&self, name: &str) -> bool {
        let known = [self.private, self.scene_names, &[PARAMS, UNFINISHED]].iter().any(|names| names.contains(&name));
        !known && self.descriptor.port(name).is_none() && sampler(name).is_none()
    }

    /// What was probably meant by the name of an unknown variable.
    fn meant(&self, name: &str) -> Option<&str> {
        let ports = self.descriptor.ports.iter().map(|port| port.name.as_str());
        near(name, ports.chain(self.scene_names.iter().copied()).chain([PARAMS]))
    }

    fn unknown(&self, resource: &Resource) -> Diagnostic {
        let name = resource.name.as_str();
        if matches!(resource.kind, ResourceKind::Sampler { .. }) {
            let known: Vec<String> = SAMPLERS.iter().map(|sampler| format!("`{}`", sampler.name)).collect();
            return Diagnostic::error(codes::VARIABLE, resource.place.clone(), format!("there is no sampler `{name}`"))
                .suggest(format!("the samplers are {}", known.join(", ")));
        }
        let message =
            format!("`{name}` is neither a port of `{}`, nor scene data, nor `{PARAMS}`", self.descriptor.name);
        let problem = Diagnostic::error(codes::VARIABLE, resource.place.clone(), message);
        let otherwise = || "declare it as a port of the pass".to_owned();
        problem.suggest(self.meant(name).map_or_else(otherwise, did_you_mean))
    }

    fn scene_variable(&self, resource: &Resource, out: &mut Vec<Diagnostic>) {
        let name = resource.name.as_str();
        let wrong = |message: String| Diagnostic::error(codes::SCENE, resource.place.clone(), message);
        match resource.kind {
            ResourceKind::Uniform { .. } | ResourceKind::StorageBuffer { read_only: true, .. } => {}
            ResourceKind::StorageBuffer { .. } => {
                out.push(
                    wrong(format!("`{name}` is scene data, which a pass cannot write"))
                        .suggest(format!("declare `var<storage, read> {name}: …`")),
                );
            }
            _ => out.push(wrong(format!("`{name}` is scene data, so it must be a buffer"))),
        }
        if !self.descriptor.scene.iter().any(|declared| declared == name) {
            let pass = &self.descriptor.name;
            let message = format!("the shader reads `{name}` of the scene, but `{pass}` does not declare it");
            out.push(wrong(message).suggest(format!("add \"{name}\" to the scene data of the pass")));
        }
    }

    /// Scene data that are declared but not read.
    fn scene(&self, out: &mut Vec<Diagnostic>) {
        for name in &self.descriptor.scene {
            if !self.resources().any(|resource| &resource.name == name) {
                let pass = &self.descriptor.name;
                let message =
                    format!("`{pass}` declares that it reads `{name}` of the scene, but none of its shaders does");
                let problem = Diagnostic::error(codes::SCENE, self.file(), message);
                let otherwise = "remove it from the scene data of the pass";
                out.push(if self.scene_names.contains(&name.as_str()) {
                    problem.suggest(otherwise)
                } else {
                    problem.suggest_near_or(name, self.scene_names.iter().copied(), otherwise)
                });
            }
        }
    }
}
