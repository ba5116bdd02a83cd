//! Texts that must say something: why a tolerance is loose, where a picture comes from.

use tyndall_document::{Decoder, Diagnostic, Fields, Node};

use crate::codes;

/// Whether there is a `reason`.
pub(super) fn reason(decoder: &mut Decoder<'_>, fields: &Fields<'_>) -> bool {
    fields.get("reason").map(|node| said(decoder, node, "reason")).is_some()
}

/// A text that says something; a blank one is a mistake.
pub(super) fn said<'n>(decoder: &mut Decoder<'_>, node: &'n Node, what: &str) -> Option<&'n str> {
    let text = decoder.text(node)?;
    if text.trim().is_empty() {
        let problem =
            Diagnostic::error(codes::MISSING_REASON, decoder.place(node.span), format!("the {what} is blank"));
        decoder.report(problem.suggest("write what is the case, in a sentence"));
    }
    Some(text)
}

/// A loose tolerance stands beside its reason.
pub(super) fn demand_reason(decoder: &mut Decoder<'_>, node: &Node, strict: bool, reason: bool) {
    if !strict && !reason {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(codes::MISSING_REASON, place, "this tolerance is loose, and nothing says why");
        decoder.report(problem.suggest("add `reason: \"…\"` to the tap or the relation, or make it stricter"));
    }
}
