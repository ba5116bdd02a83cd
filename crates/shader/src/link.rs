//! Linking: from a shader and the modules that it imports to a naga module that is bound, valid and reflected.
//!
//! # Why a linker of our own
//! Measured before it was written: cold release builds on two shared cores, naga alone taking 33 s and 30 crates.
//!
//! | | adds | variables without `@binding` | places of errors |
//! | --- | --- | --- | --- |
//! | naga_oil 0.23 | 20 s, 13 crates | refused: it validates before we could assign them | right file and line; columns shift behind names that it mangles |
//! | wesl 0.4 | 120 s, 62 crates | pass | naga's are in the generated text, with mangled names and no way back |
//! | this | nothing | pass | exact, all labels, also across files |
//!
//! So files are joined whole, once each, import lines blanked to their own length: an offset in the text is an offset
//! in a file plus a constant. There is one flat namespace, and no macros; naga reports a name that two files declare,
//! at both places. So a module may call what the shader that imports it declares: that is how loops are shared, whose
//! bodies differ. It says so in a `#require` line, and an import that does not get it is a mistake at the import.
//!
//! # What becomes of a module
//! It is validated whole, so that a mistake in a function that nobody calls is found too. Then naga's `compact` drops
//! what no entry point uses, and the rest is numbered and validated once more: wgpu gets the smallest module, and an
//! unused variable of an imported file needs no binding.

use std::sync::Arc;

use naga::compact::{KeepUnused, compact};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ResourceBinding};
use tyndall_document::{Diagnostic, Place, Source};

use crate::assemble::{Assembly, assemble};
use crate::guard::guarded;
use crate::library::Library;
use crate::map::Map;
use crate::meaning::fingerprint;
use crate::params::{Param, params};
use crate::reflect::{EntryPoint, Resource, entry_points, is_resource, resources};
use crate::require::blame;
use crate::{codes, errors, usage};

/// What a shader may ask of a device: what every one has that is up to WebGPU.
pub const CAPABILITIES: Capabilities = Capabilities::MULTISAMPLED_SHADING
    .union(Capabilities::CUBE_ARRAY_TEXTURES)
    .union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// A shader, linked.
#[derive(Debug)]
pub struct Linked {
    /// Bound, valid, and without what no entry point uses (but whole where there is no entry point): ready for wgpu's
    /// `ShaderSource::Naga`.
    pub module: Module,
    /// naga's analysis of it.
    pub info: ModuleInfo,
    /// What must be bound, in the order of the numbers.
    pub resources: Vec<Resource>,
    /// Where a pipeline may start.
    pub entry_points: Vec<EntryPoint>,
    /// Its parameters: members of `params` first.
    pub params: Vec<Param>,
    /// Variables and overrides of the root that no entry point uses.
    pub unused: Vec<Unused>,
    /// Of what its entry points do: comments and what nobody uses do not count. The same in every process, with every
    /// toolchain.
    pub fingerprint: u64,
    pub(crate) map: Map,
}

/// Something that the root declares and no entry point uses.
#[derive(Debug, Clone, PartialEq)]
pub struct Unused {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub place: Place,
}

impl Linked {
    /// The place in an author's file of a span of the module; the root as a whole where the span says nothing.
    pub fn place(&self, span: naga::Span) -> Place {
        self.map.place(span)
    }

    /// The files that it was made of: the root first.
    pub fn sources(&self) -> impl Iterator<Item = &Arc<Source>> {
        self.map.sources()
    }

    /// The resource of this name.
    pub fn resource(&self, name: &str) -> Option<&Resource> {
        self.resources.iter().find(|resource| resource.name == name)
    }

    /// The parameter of this name.
    pub fn param(&self, name: &str) -> Option<&Param> {
        self.params.iter().find(|param| param.name == name)
    }
}

/// Links a shader with the modules that it imports.
///
/// # Errors
/// Every mistake of the imports and of reserved attributes, the first that naga finds in the text (naga stops there),
/// and every variable or parameter of a kind that cannot be bound; each in the file of its author.
pub fn link(root: &Arc<Source>, library: &Library) -> Result<Linked, Vec<Diagnostic>> {
    let mut assembly = assemble(root, library)?;
    let mut problems = std::mem::take(&mut assembly.problems);
    match module(&assembly, library) {
        Ok((module, info, unused)) if problems.is_empty() => finish(assembly, module, info, unused),
        Ok(_) => Err(problems),
        Err(problem) => {
            problems.push(blame(&assembly, *problem));
            Err(problems)
        }
    }
}

type Valid = (Module, ModuleInfo, Vec<Unused>);

/// Parses, binds and validates a module, and removes what is not used.
fn module(assembly: &Assembly, library: &Library) -> Result<Valid, Box<Diagnostic>> {
    let internal = |step: &'static str| move |said: String| Box::new(errors::internal(assembly, step, &said));
    let parsed = guarded(|| naga::front::wgsl::parse_str(&assembly.text)).map_err(internal("reads"))?;
    let mut module = parsed.map_err(|error| Box::new(errors::syntax(assembly, library, &error)))?;
    bind(&mut module);
    let info = validate(assembly, &module)?;
    if module.entry_points.is_empty() {
        return Ok((module, info, Vec::new()));
    }
    let before = names(&module);
    guarded(|| compact(&mut module, KeepUnused::No)).map_err(internal("compacts"))?;
    bind(&mut module);
    let info = validate(assembly, &module)?;
    let kept = names(&module);
    let gone = before.into_iter().filter(|name| !kept.contains(name));
    let unused = gone.filter_map(|name| Some(Unused { place: assembly.root_place(&name)?, name })).collect();
    Ok((module, info, unused))
}

/// Numbers the resources, in the order of their names: that of the arena depends on what else stands in the text.
fn bind(module: &mut Module) {
    let mut resources: Vec<_> = module
        .global_variables
        .iter_mut()
        .map(|(_, variable)| variable)
        .filter(|variable| is_resource(variable))
        .collect();
    resources.sort_by(|a, b| a.name.cmp(&b.name));
    for (binding, variable) in (0..).zip(resources) {
        variable.binding = Some(ResourceBinding { group: 0, binding });
    }
}

fn validate(assembly: &Assembly, module: &Module) -> Result<ModuleInfo, Box<Diagnostic>> {
    let mut validator = Validator::new(ValidationFlags::all(), CAPABILITIES);
    guarded(|| validator.validate(module))
        .map_err(|said| Box::new(errors::internal(assembly, "validates", &said)))?
        .map_err(|error| Box::new(errors::invalid(assembly, module, &error)))
}

/// Names of resources and overrides.
fn names(module: &Module) -> Vec<String> {
    let resources = module.global_variables.iter().filter(|(_, v)| is_resource(v)).map(|(_, v)| &v.name);
    resources.chain(module.overrides.iter().map(|(_, constant)| &constant.name)).flatten().cloned().collect()
}

/// Reflects a valid module.
fn finish(
    assembly: Assembly,
    module: Module,
    info: ModuleInfo,
    unused: Vec<Unused>,
) -> Result<Linked, Vec<Diagnostic>> {
    let mut problems = Vec::new();
    let resources = resources(&module, &info, &assembly.map, &mut problems);
    let params = params(&module, &assembly.map, &usage::members_read(&module, &info), &mut problems);
    for entry in module.entry_points.iter().filter(|entry| entry.workgroup_size_overrides.is_some()) {
        let place = assembly.root_place(&entry.name).unwrap_or_else(|| assembly.map.place(naga::Span::UNDEFINED));
        let message = format!("the workgroup size of `{}` depends on an override", entry.name);
        problems.push(Diagnostic::error(codes::ENTRY, place, message).suggest("write numbers or constants"));
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    Ok(Linked {
        entry_points: entry_points(&module, &info, &resources),
        module,
        info,
        resources,
        params,
        unused,
        fingerprint: fingerprint(&assembly.text),
        map: assembly.map,
    })
}
