//! Why some mutants survive, as the author of a plugin has written it down.

use std::path::Path;

use tyndall_document::{Decoder, Diagnostic, Diagnostics, Node, Place, Source, parse};

use crate::codes::STALE_REASON;

/// The file beside a plugin's manifest.
pub const REASONS: &str = "mutants.ron";

/// Reasons of all plugins.
#[derive(Default)]
pub(crate) struct Reasons(Vec<Reason>);

struct Reason {
    pass: String,
    function: String,
    change: String,
    text: String,
    place: Place,
    /// The mutant was made, and killed.
    killed: bool,
}

impl Reasons {
    /// Adds those of a plugin's folder, where it has any.
    ///
    /// # Errors
    /// Every mistake of the file.
    pub fn read(&mut self, folder: &Path) -> Result<(), Diagnostics> {
        let path = folder.join(REASONS);
        if !path.exists() {
            return Ok(());
        }
        let source = Source::read(&path)?;
        let mut out = Diagnostics::default();
        if let Some(root) = parse(&source, &mut out) {
            let mut decoder = Decoder::new(&source, &mut out);
            for (pass, _, list) in decoder.map(&root).unwrap_or_default() {
                let items = decoder.list(list).unwrap_or_default();
                self.0.extend(items.iter().filter_map(|item| reason(&mut decoder, pass, item)));
            }
        }
        if out.has_errors() { Err(out) } else { Ok(()) }
    }

    /// The reason for a mutant that was made.
    pub fn of(&mut self, pass: &str, function: &str, change: &str, killed: bool) -> Option<String> {
        let is = |reason: &&mut Reason| reason.pass == pass && reason.function == function && reason.change == change;
        let reason = self.0.iter_mut().find(is)?;
        reason.killed |= killed;
        Some(reason.text.clone())
    }

    /// Refuses reasons for what cannot be made.
    ///
    /// # Errors
    /// One for each of them.
    pub fn refuse_unknown(&self, can_be_made: &dyn Fn(&str, &str, &str) -> bool) -> Result<(), Diagnostics> {
        let unknown = self.0.iter().filter(|reason| !can_be_made(&reason.pass, &reason.function, &reason.change));
        refuse(
            unknown,
            "no such mutant can be made",
            "delete it, or copy `function` and `change` from the report again",
        )
    }

    /// Refuses reasons for what is killed.
    ///
    /// # Errors
    /// One for each of them.
    pub fn refuse_needless(&self) -> Result<(), Diagnostics> {
        refuse(self.0.iter().filter(|reason| reason.killed), "this mutant does not survive", "delete it")
    }
}

fn refuse<'a>(reasons: impl Iterator<Item = &'a Reason>, what: &str, suggestion: &str) -> Result<(), Diagnostics> {
    let mistake = |reason: &Reason| {
        let message = format!("{what}: `{}` in `{}` of `{}`", reason.change, reason.function, reason.pass);
        Diagnostic::error(STALE_REASON, reason.place.clone(), message).suggest(suggestion)
    };
    let mistakes: Diagnostics = reasons.map(mistake).collect();
    if mistakes.is_empty() { Ok(()) } else { Err(mistakes) }
}

fn reason(decoder: &mut Decoder<'_>, pass: &str, node: &Node) -> Option<Reason> {
    let fields = decoder.fields(node, "a reason", &["function", "change", "reason"])?;
    let mut text = |name: &str| fields.required(decoder, name).and_then(|node| decoder.text(node)).map(str::to_owned);
    let (function, change, text) = (text("function"), text("change"), text("reason"));
    let place = decoder.place(node.span);
    if text.as_ref().is_some_and(|text| text.trim().is_empty()) {
        let blank = Diagnostic::error(STALE_REASON, place.clone(), "a reason that says nothing");
        decoder.report(blank.suggest("say why no test can notice it"));
    }
    Some(Reason { pass: pass.to_owned(), function: function?, change: change?, text: text?, place, killed: false })
}
