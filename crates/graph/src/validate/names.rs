//! Passes by name, and what each one's `use` means.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Validator;
use crate::catalogue::Kind;
use crate::codes;
use crate::descriptor::PassDescriptor;
use crate::file::Text;
use crate::graph::Pass;
use crate::handle::{Handle, Table};
use crate::signature::Signature;
use crate::wiring::{Feed, Flow};

impl<'a> Validator<'a> {
    /// Finds the kind of every pass, and numbers passes and ports.
    pub(super) fn index_passes(&mut self) {
        let mut kinds: FxHashMap<&'a str, Handle<Kind>> = FxHashMap::default();
        let file = self.file;
        for (pass, entry) in file.passes.entries() {
            let kind = self.kind(entry.kind.as_ref(), &mut kinds);
            let name = file.text(&entry.name);
            self.names.insert(name, pass, |pass| file.text(&file.passes[pass].name) == name);
            self.wiring.kind_of.push(kind);
            let kind = self.kinds[kind].clone();
            self.wiring.ports.push(self.wiring.pass_of.push_for(&kind.signature.ports, pass));
            self.passes.push(Pass {
                name: name.to_owned(),
                span: entry.name.span,
                params: Table::new(),
                enabled: true,
                switch: None,
                kind,
            });
        }
        self.wiring.enabled = file.passes.column(true);
        self.wiring.flows = self.wiring.pass_of.column(Flow::UNKNOWN);
        self.wiring.connection_to = self.wiring.pass_of.column(None);
        self.written = self.wiring.pass_of.column(Feed::Nothing);
        self.named = self.wiring.pass_of.column(false);
    }

    /// The kind that `use` names; one without ports where it names none.
    fn kind(&mut self, name: Option<&'a Text>, kinds: &mut FxHashMap<&'a str, Handle<Kind>>) -> Handle<Kind> {
        let key = name.map_or("", |name| self.file.text(name));
        if let Some(kind) = kinds.get(key).filter(|kind| self.is_known(**kind)) {
            return *kind;
        }
        let found = self.catalogue.kind(key);
        if let (None, Some(name)) = (found, name) {
            self.unknown_pass(name);
        }
        let kind = self.kinds.push(found.unwrap_or(self.unknown));
        kinds.insert(key, kind);
        kind
    }

    fn unknown_pass(&mut self, name: &'a Text) {
        let place = self.place(name.span);
        let name = self.file.text(name);
        let message = format!("there is no pass `{name}`");
        let catalogue = self.catalogue;
        self.report_unknown((codes::UNKNOWN_PASS, place), message, name, catalogue.names(), str::to_owned);
    }

    /// Whether this kind is of the catalogue: nothing is demanded of a pass whose kind is not known.
    pub(super) fn is_known(&self, kind: Handle<Kind>) -> bool {
        !self.kinds[kind].descriptor.name.is_empty()
    }

    pub(super) fn is_known_pass(&self, pass: Handle<Pass>) -> bool {
        self.is_known(self.wiring.kind_of[pass])
    }
}

/// A pass without a name, ports and parameters.
pub(super) fn unknown_kind() -> Arc<Kind> {
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
    Arc::new(Kind { descriptor: Arc::new(descriptor), signature: Signature::default() })
}
