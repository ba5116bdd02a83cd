//! What a scene can have that a pass does not do justice to.

use std::fmt;

use crate::model::LightKind;
use crate::scene::Scene;

/// Something that a scene can have, by a name that manifests use.
#[derive(Clone, Copy)]
pub struct Feature {
    /// In capitals, as a variant: `Spot`.
    pub name: &'static str,
    /// Whether a scene has it.
    pub is_in: fn(&Scene) -> bool,
}

impl fmt::Debug for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Those that every manifest can name.
pub(crate) const CORE_FEATURES: [Feature; 4] = [
    Feature { name: "Point", is_in: |scene| scene.lights.iter().any(|light| light.kind == LightKind::Point) },
    Feature { name: "Spot", is_in: |scene| scene.lights.iter().any(|l| matches!(l.kind, LightKind::Spot { .. })) },
    Feature { name: "Directional", is_in: |scene| scene.lights.iter().any(|l| l.kind == LightKind::Directional) },
    Feature { name: "Medium", is_in: |scene| scene.medium.as_ref().is_some_and(|m| m.extinction.max_element() > 0.0) },
];

/// Scene data that others are wrong without: a pass that reads the one and not the other is refused scenes that have
/// something which only the other tells of.
#[derive(Clone, Copy, Debug)]
pub struct Refusal {
    /// The scene data that may be read by themselves in other scenes.
    pub reads: &'static str,
    /// The scene data that must be read as well.
    pub without: &'static str,
    /// Which scenes are refused.
    pub feature: Feature,
    /// What is told behind "pass `name`": `is right in … only, and the scene …`.
    pub because: &'static str,
    /// A change to the scene with which the pass would be right, as a hint: `leave … out of the scene`.
    pub remedy: &'static str,
}

/// The medium is not the same everywhere.
pub(crate) const HEIGHT_FOG: Refusal = Refusal {
    reads: "medium",
    without: "height_fog",
    feature: Feature { name: "HeightFog", is_in: Scene::has_height_fog },
    because: "is right in a homogeneous medium only, and the scene's medium has a `scale_height`",
    remedy: "leave `scale_height` out of the scene",
};
