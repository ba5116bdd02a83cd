//! Passes by name, and their kinds.

use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use tyndall_document::{Diagnostic, Diagnostics, MISSING_FILE, Place, Span};

use super::Request;
use super::mistakes::Mistakes;
use crate::catalogue::Kind;
use crate::codes;
use crate::descriptor::PassDescriptor;
use crate::file::{GraphFile, Text};
use crate::graph::Pass;
use crate::handle::{Handle, Table};
use crate::names::Names;
use crate::signature::Signature;
use crate::wiring::Passes;

/// The passes of a file by name, and their kinds.
pub(super) struct Scope<'a> {
    pub request: &'a Request<'a>,
    pub file: &'a GraphFile,
    pub passes: Passes,
    pub names: Names<Pass>,
}

impl<'a> Scope<'a> {
    /// Finds the kind of every pass.
    pub fn of(request: &'a Request<'a>, out: &mut Mistakes) -> Self {
        let file = request.file;
        let (passes, names) = (Passes::default(), Names::with_capacity(file.passes.len()));
        let mut scope = Self { request, file, passes, names };
        let mut kinds: FxHashMap<&'a str, Handle<Kind>> = FxHashMap::default();
        for entry in &file.passes {
            let name = entry.kind.as_ref().map_or("", |name| file.text(name));
            let kind = match kinds.get(name) {
                Some(kind) => *kind,
                None => scope.kind(entry.kind.as_ref(), &mut kinds, out),
            };
            let pass = scope.passes.push(kind);
            let name = scope.name(pass);
            scope.names.insert(name, pass, |pass| file.text(&file.passes[pass].name) == name);
        }
        scope
    }

    /// The kind that `use` names; if there is none of this name, a kind without ports.
    fn kind(
        &mut self,
        name: Option<&'a Text>,
        kinds: &mut FxHashMap<&'a str, Handle<Kind>>,
        out: &mut Mistakes,
    ) -> Handle<Kind> {
        let text = name.map_or("", |name| self.file.text(name));
        match (self.request.catalogue.kind(text), name) {
            (Some(Ok(found)), _) => {
                let kind = self.passes.kinds.push(found.clone());
                kinds.insert(text, kind);
                return kind;
            }
            (Some(Err(mistakes)), Some(name)) => self.broken_pass(name, mistakes, out),
            (None, Some(name)) => self.unknown_pass(name, out),
            (_, None) => {}
        }
        self.passes.kinds.push(Arc::new(unknown_kind()))
    }

    fn unknown_pass(&self, name: &Text, out: &mut Mistakes) {
        let (catalogue, code) = (self.request.catalogue, (codes::UNKNOWN_PASS, self.place(name.span)));
        let name = self.file.text(name);
        let within = catalogue.manifest_of(name).map(|file| format!(" in {file}")).unwrap_or_default();
        let message = format!("there is no pass `{name}`{within}");
        out.report_unknown(code, message, name, catalogue.names(), str::to_owned);
        out.extend(catalogue.unread().iter().cloned());
    }

    /// Reports what is wrong with a pass, and that this graph uses it.
    fn broken_pass(&self, name: &Text, mistakes: &Diagnostics, out: &mut Mistakes) {
        let message = format!("`{}` is used here", self.file.text(name));
        for mistake in mistakes {
            out.report(mistake.clone().relate(self.place(name.span), message.clone()));
        }
    }

    /// Whether the kind of a pass is in the catalogue: nothing is demanded of a pass whose kind is unknown.
    pub fn is_known(&self, pass: Handle<Pass>) -> bool {
        !self.passes.kind(pass).descriptor.name.is_empty()
    }

    pub fn name(&self, pass: Handle<Pass>) -> &'a str {
        self.file.text(&self.file.passes[pass].name)
    }

    /// The place of the name of a pass.
    pub fn place_of(&self, pass: Handle<Pass>) -> Place {
        self.place(self.file.passes[pass].name.span)
    }

    pub fn pass_named(&self, name: &str) -> Option<Handle<Pass>> {
        self.names.find(name, |pass| self.name(pass) == name)
    }

    pub fn pass_names(&self) -> impl Iterator<Item = &'a str> + Clone + use<'a> {
        let file = self.file;
        file.passes.iter().map(|pass| file.text(&pass.name))
    }

    pub fn place(&self, span: Span) -> Place {
        self.file.source.place(span)
    }

    /// A path from the file, made relative to the working directory.
    pub fn beside_file(&self, path: &str) -> String {
        let folder = Path::new(self.file.source.name()).parent().unwrap_or(Path::new(""));
        folder.join(path).to_string_lossy().into_owned()
    }

    pub fn exists(&self, path: &str) -> bool {
        (self.request.exists)(Path::new(path))
    }
}

pub(super) fn missing_file(path: &str, place: Place) -> Diagnostic {
    Diagnostic::error(MISSING_FILE, place, format!("there is no file `{path}`"))
}

/// A kind without a name, ports and parameters.
fn unknown_kind() -> Kind {
    let descriptor = PassDescriptor {
        name: String::new(),
        about: String::new(),
        source: String::new(),
        ports: Table::new(),
        params: Table::new(),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 0,
    };
    Kind { descriptor: Arc::new(descriptor), signature: Signature::default() }
}
