//! What scenes consist of: what this crate reads and encodes by itself, and what plugins add.

use std::fmt;

use crate::core_data::core_data;
use crate::decode::core_fields;
use crate::feature::{CORE_FEATURES, Feature, HEIGHT_FOG, Refusal};
use crate::field::{AnyField, FieldValue, Holder, HoldsFields, SceneField};
use crate::layout::Shape;
use crate::scene_data::SceneData;

/// What one plugin adds to scenes.
#[derive(Clone, Default)]
pub struct Extension {
    data: Vec<SceneData>,
    fields: Vec<AnyField>,
    features: Vec<Feature>,
    refusals: Vec<Refusal>,
}

impl Extension {
    /// Adds scene data.
    pub fn add_data(&mut self, data: SceneData) {
        self.data.push(data);
    }

    /// Adds a field of the scene file.
    pub fn add_field<H: HoldsFields, T: FieldValue>(&mut self, field: &SceneField<H, T>) {
        self.fields.push(field.erased());
    }

    /// Adds something that limits in manifests can name.
    pub fn add_feature(&mut self, feature: Feature) {
        self.features.push(feature);
    }

    /// Adds scene data that others are wrong without.
    pub fn add_refusal(&mut self, refusal: Refusal) {
        self.refusals.push(refusal);
    }
}

/// What scenes consist of. The default is what this crate knows by itself.
#[derive(Clone)]
pub struct Extensions {
    /// The first is this crate's own, the others are plugins', by name.
    parts: Vec<(String, Extension)>,
}

/// The owner of what this crate knows by itself, for messages.
const CORE: &str = "the scene";

impl Default for Extensions {
    fn default() -> Self {
        let own = Extension {
            data: core_data(),
            fields: Vec::new(),
            features: CORE_FEATURES.to_vec(),
            refusals: vec![HEIGHT_FOG],
        };
        Self { parts: vec![(CORE.to_owned(), own)] }
    }
}

impl Extensions {
    /// Adds what a plugin brings.
    ///
    /// # Errors
    /// Names that are taken, one sentence each; then nothing is added.
    pub fn add(&mut self, plugin: &str, extension: Extension) -> Result<(), Vec<String>> {
        let data = extension.data.iter().flat_map(SceneData::names).filter_map(|name| self.taken_data(name));
        let fields = extension.fields.iter().filter_map(|field| self.taken_field(field));
        let features = extension.features.iter().filter_map(|feature| self.taken_feature(feature));
        let mistakes: Vec<String> = data.chain(fields).chain(features).collect();
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        self.parts.push((plugin.to_owned(), extension));
        Ok(())
    }

    fn taken_data(&self, name: &str) -> Option<String> {
        let owner = |(_, part): &&(String, Extension)| part.data.iter().any(|data| data.names().any(|own| own == name));
        self.parts.iter().find(owner).map(|(owner, _)| format!("the scene data `{name}` belongs to {owner} already"))
    }

    fn taken_field(&self, field: &AnyField) -> Option<String> {
        let AnyField { holder, name, .. } = field;
        let same = |other: &AnyField| other.holder == *holder && other.name == *name;
        let plugin = self.parts.iter().find(|(_, part)| part.fields.iter().any(same)).map(|(owner, _)| owner.as_str());
        let owner = if core_fields(*holder).any(|known| known == *name) { Some(CORE) } else { plugin };
        owner.map(|owner| format!("the scene field `{name}` belongs to {owner} already"))
    }

    fn taken_feature(&self, feature: &Feature) -> Option<String> {
        let core = &self.parts[0].1.features;
        let is_core = core.iter().any(|known| known.name == feature.name);
        is_core.then(|| format!("the scene feature `{}` belongs to {CORE} already", feature.name))
    }

    fn extensions(&self) -> impl Iterator<Item = &Extension> {
        self.parts.iter().map(|part| &part.1)
    }

    /// All scene data, this crate's own first.
    pub fn data(&self) -> impl Iterator<Item = &SceneData> {
        self.extensions().flat_map(|extension| &extension.data)
    }

    /// Those that plugins bring.
    pub fn plugin_data(&self) -> impl Iterator<Item = &SceneData> {
        self.parts[1..].iter().flat_map(|part| &part.1.data)
    }

    /// The names of all scene data.
    pub fn data_names(&self) -> Vec<&'static str> {
        self.data().flat_map(SceneData::names).collect()
    }

    /// How the scene data of a name are laid out; `None` where there are none of that name.
    pub fn shape(&self, name: &str) -> Option<Shape> {
        self.data().flat_map(|data| &data.items).find(|item| item.0 == name).map(|item| item.1)
    }

    /// The fields that plugins bring for a holder.
    pub(crate) fn fields(&self, holder: Holder) -> impl Iterator<Item = &AnyField> {
        self.extensions().flat_map(|extension| &extension.fields).filter(move |field| field.holder == holder)
    }

    /// The features that a plugin's manifest can name: the scene's, its own, and those of other plugins. Where two
    /// plugins have one of the same name, each means its own.
    pub fn features(&self, plugin: &str) -> Vec<Feature> {
        let own = self.parts.iter().filter(|part| part.0 == CORE || part.0 == plugin);
        let others = self.parts.iter().filter(|part| part.0 != CORE && part.0 != plugin);
        let mut found: Vec<Feature> = Vec::new();
        for feature in own.chain(others).flat_map(|part| &part.1.features) {
            if !found.iter().any(|known| known.name == feature.name) {
                found.push(*feature);
            }
        }
        found
    }

    /// Which scene data others are wrong without.
    pub fn refusals(&self) -> impl Iterator<Item = &Refusal> {
        self.extensions().flat_map(|extension| &extension.refusals)
    }
}

impl fmt::Debug for Extensions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.parts.iter().map(|part| &part.0)).finish()
    }
}
