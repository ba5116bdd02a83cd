//! What a scene can have that a pass does not do justice to, or is wrong with: told before anything is rendered.

use tyndall_document::{Decoder, Node};
use tyndall_scene::Feature;

use crate::ports::arguments;

/// Something that a scene can have, and what is told where it has.
#[derive(Debug, Clone)]
pub struct Limit {
    /// What it is about.
    pub feature: Feature,
    /// What is told.
    pub text: String,
}

/// Reads `[Feature("text"), …]`.
pub(crate) fn limits(decoder: &mut Decoder<'_>, node: &Node, features: &[Feature]) -> Vec<Limit> {
    let items = decoder.list(node).unwrap_or_default();
    items.iter().filter_map(|item| limit(decoder, item, features)).collect()
}

fn limit(decoder: &mut Decoder<'_>, node: &Node, features: &[Feature]) -> Option<Limit> {
    let names: Vec<&str> = features.iter().map(|feature| feature.name).collect();
    let (name, content) = decoder.variant(node, "something that a scene can have", &names)?;
    let feature = *features.iter().find(|feature| feature.name == name)?;
    let content = content.map(arguments).unwrap_or_default();
    let [text] = content.as_slice() else {
        decoder.wrong_type(node, &format!("`{name}(\"the message\")`"));
        return None;
    };
    Some(Limit { feature, text: decoder.text(text)?.to_owned() })
}
