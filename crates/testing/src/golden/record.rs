//! What each golden was made from.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use tyndall_document::{Decoder, Diagnostics, Node, Source, parse};
use tyndall_graph::{Digest, MadeFrom};

use super::{NotWritten, RECORDS};
use crate::adapter::AdapterClass;

/// What one golden was made from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// Hash of the image file.
    pub content: String,
    /// Class of the adapter.
    pub adapter: AdapterClass,
    /// Version of the program.
    pub program: String,
    /// Graph, shaders, parameters and scene; `None` where the port depends on frames before.
    pub made_from: Option<MadeFrom>,
}

/// The records of a folder of goldens, by the name of the golden.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Records(BTreeMap<String, Record>);

/// A hash of a file's bytes, as the records hold it.
pub(crate) fn content_hash(bytes: &[u8]) -> String {
    hex(Digest::of(bytes))
}

fn hex(number: u64) -> String {
    format!("{number:016x}")
}

impl Record {
    /// The record of the image file at `path`.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn new(path: &Path, adapter: AdapterClass, made_from: Option<MadeFrom>) -> Result<Self, NotWritten> {
        let bytes = std::fs::read(path)
            .map_err(|error| NotWritten { what: format!("{}: {error}", path.display()), is_of_machine: true })?;
        Ok(Self { content: content_hash(&bytes), adapter, program: env!("CARGO_PKG_VERSION").to_owned(), made_from })
    }

    /// What has changed since the golden was made: it is stale where that is anything.
    pub fn stale(&self, now: Option<&MadeFrom>) -> Vec<&'static str> {
        let mut changed = match (&self.made_from, now) {
            (Some(then), Some(now)) => then.changed(now),
            (None, None) => Vec::new(),
            _ => vec!["graph"],
        };
        if self.program != env!("CARGO_PKG_VERSION") {
            changed.push("program");
        }
        changed
    }
}

impl Records {
    /// The record of a golden.
    pub fn get(&self, key: &str) -> Option<&Record> {
        self.0.get(key)
    }

    /// Sets the record of a golden.
    pub fn set(&mut self, key: &str, record: Record) {
        self.0.insert(key.to_owned(), record);
    }

    /// Drops the records of goldens that are not among these.
    pub fn retain(&mut self, keys: &dyn Fn(&str) -> bool) {
        self.0.retain(|key, _| keys(key));
    }

    /// Names of the goldens.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Reads the records of a folder; none where the folder has none.
    ///
    /// # Errors
    /// Every mistake of the file.
    pub fn read(folder: &Path) -> Result<Self, Diagnostics> {
        let path = folder.join(RECORDS);
        if !path.exists() {
            return Ok(Self::default());
        }
        let source = Source::read(&path)?;
        let mut out = Diagnostics::default();
        let records = parse(&source, &mut out).map(|root| {
            let mut decoder = Decoder::new(&source, &mut out);
            let entries = decoder.map(&root).unwrap_or_default();
            let records =
                entries.into_iter().filter_map(|(key, _, node)| Some((key.to_owned(), record(&mut decoder, node)?)));
            Self(records.collect())
        });
        if out.has_errors() {
            let how = "`tyndall test --bless` writes this file: restore it, or delete it and bless again";
            return Err(out.into_iter().map(|mistake| mistake.suggest(how)).collect());
        }
        Ok(records.unwrap_or_default())
    }

    /// Writes the records of a folder.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), NotWritten> {
        let mut text = "// What each golden was made from. Written by `tyndall test --bless`.\n{\n".to_owned();
        for (key, record) in &self.0 {
            let Record { content, adapter, program, made_from } = record;
            let _ =
                write!(text, "    {key:?}: (content: {content:?}, adapter: {:?}, program: {program:?}", adapter.name());
            for (name, value) in made_from.iter().flat_map(MadeFrom::parts) {
                let _ = write!(text, ", {name}: {:?}", hex(value));
            }
            text += "),\n";
        }
        text += "}\n";
        Ok(tyndall_image::write_bytes(&folder.join(RECORDS), text.as_bytes())?)
    }
}

fn record(decoder: &mut Decoder<'_>, node: &Node) -> Option<Record> {
    let known = ["content", "adapter", "program", "graph", "shaders", "parameters", "scene"];
    let fields = decoder.fields(node, "a record of a golden", &known)?;
    let mut text = |name: &str| fields.required(decoder, name).and_then(|node| decoder.text(node)).map(str::to_owned);
    let (content, adapter, program) = (text("content")?, text("adapter")?, text("program")?);
    let part = |decoder: &mut Decoder<'_>, name: &str| {
        let text = fields.get(name).and_then(|node| decoder.text(node))?;
        u64::from_str_radix(text, 16).ok()
    };
    let parts = ["graph", "shaders", "parameters", "scene"].map(|name| part(decoder, name));
    let made_from = match parts {
        [Some(graph), Some(shaders), Some(parameters), Some(scene)] => {
            Some(MadeFrom { graph, shaders, parameters, scene })
        }
        _ => None,
    };
    // A class that this program does not know cannot be the one that it runs on.
    let adapter = AdapterClass::named(&adapter).unwrap_or(AdapterClass::Other);
    Some(Record { content, adapter, program, made_from })
}
