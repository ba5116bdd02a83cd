//! Passes by name, and what each one's `use` means.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Validator;
use crate::catalogue::Kind;
use crate::codes;
use crate::descriptor::PassDescriptor;
use crate::file::Text;
use crate::graph::Pass;
use crate::signature::Signature;
use crate::table::{Feed, Flow};

impl<'a> Validator<'a> {
    /// Finds the kind of every pass, and numbers passes and ports.
    pub(super) fn index_passes(&mut self) {
        let passes = self.file.passes.len();
        self.table.kind_of.reserve(passes);
        self.table.first_port.reserve(passes + 1);
        let mut kinds: FxHashMap<&'a str, u32> = FxHashMap::default();
        let mut ports = 0;
        let file = self.file;
        for (index, entry) in file.passes.iter().enumerate() {
            let kind = self.kind(entry.kind.as_ref(), &mut kinds);
            let name = file.text(&entry.name);
            self.names.insert(name, index as u32, |pass| file.text(&file.passes[pass as usize].name) == name);
            self.table.kind_of.push(kind);
            self.table.first_port.push(ports);
            let kind = self.kinds[kind as usize].clone();
            ports += kind.signature.ports.len() as u32;
            self.table.pass_of.resize(ports as usize, index as u32);
            self.passes.add_node(Pass {
                name: name.to_owned(),
                span: entry.name.span,
                params: Vec::new(),
                enabled: true,
                switch: None,
                kind,
            });
        }
        self.table.first_port.push(ports);
        self.table.enabled = vec![true; passes];
        self.table.flows = vec![Flow::UNKNOWN; ports as usize];
        self.written = vec![Feed::NOTHING; ports as usize];
    }

    /// Number of the kind that `use` names; of one without ports where it names none.
    fn kind(&mut self, name: Option<&'a Text>, kinds: &mut FxHashMap<&'a str, u32>) -> u32 {
        let key = name.map_or("", |name| self.file.text(name));
        if let Some(kind) = kinds.get(key).filter(|kind| self.is_known(**kind)) {
            return *kind;
        }
        let found = self.catalogue.kind(key);
        if let (None, Some(name)) = (found, name) {
            self.unknown_pass(name);
        }
        let kind = self.kinds.len() as u32;
        self.kinds.push(found.unwrap_or(self.unknown));
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
    pub(super) fn is_known(&self, kind: u32) -> bool {
        !self.kinds[kind as usize].descriptor.name.is_empty()
    }

    pub(super) fn is_known_pass(&self, pass: u32) -> bool {
        self.is_known(self.table.kind_of[pass as usize])
    }
}

/// A pass without a name, ports and parameters.
pub(super) fn unknown_kind() -> Arc<Kind> {
    let descriptor = PassDescriptor {
        name: String::new(),
        about: String::new(),
        source: String::new(),
        ports: Vec::new(),
        params: Vec::new(),
        presets: Vec::new(),
        scene: Vec::new(),
        side_effect: false,
        revision: 0,
    };
    Arc::new(Kind { descriptor: Arc::new(descriptor), signature: Signature::default() })
}
