//! What a scene can have that a pass does not do justice to: told before anything is rendered.

use tyndall_document::{Decoder, Node};

use crate::ports::arguments;

/// Something that a scene can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneFeature {
    /// A point light.
    Point,
    /// A spot light.
    Spot,
    /// A directional light.
    Directional,
    /// Phong lobes of more than one shininess.
    SeveralShininesses,
    /// More shininesses than there are tables for.
    TooManyShininesses,
    /// More shapes of spots than there are tables for.
    TooManySpots,
    /// A medium that takes light.
    Medium,
    /// More lights than a texture of those that reach a point has bits for.
    ManyLights,
}

impl SceneFeature {
    const ALL: [Self; 8] = [
        Self::Point,
        Self::Spot,
        Self::Directional,
        Self::SeveralShininesses,
        Self::TooManyShininesses,
        Self::TooManySpots,
        Self::Medium,
        Self::ManyLights,
    ];

    /// As a manifest names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "Point",
            Self::Spot => "Spot",
            Self::Directional => "Directional",
            Self::SeveralShininesses => "SeveralShininesses",
            Self::TooManyShininesses => "TooManyShininesses",
            Self::TooManySpots => "TooManySpots",
            Self::Medium => "Medium",
            Self::ManyLights => "ManyLights",
        }
    }
}

/// What a pass does instead, where the scene has such a thing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Limit {
    /// What it is about.
    pub feature: SceneFeature,
    /// What is told.
    pub text: String,
}

/// Reads `[Feature("text"), …]`.
pub(crate) fn limits(decoder: &mut Decoder<'_>, node: &Node) -> Vec<Limit> {
    let items = decoder.list(node).unwrap_or_default();
    items.iter().filter_map(|item| limit(decoder, item)).collect()
}

fn limit(decoder: &mut Decoder<'_>, node: &Node) -> Option<Limit> {
    let names = SceneFeature::ALL.map(SceneFeature::name);
    let (name, content) = decoder.variant(node, "something that a scene can have", &names)?;
    let feature = SceneFeature::ALL.into_iter().find(|feature| feature.name() == name)?;
    let content = content.map(arguments).unwrap_or_default();
    let [text] = content.as_slice() else {
        decoder.wrong_type(node, &format!("`{name}(\"what the pass does instead\")`"));
        return None;
    };
    Some(Limit { feature, text: decoder.text(text)?.to_owned() })
}
