//! Scene fields that plugins bring: sections of a scene file, and fields of what it holds.
//!
//! ```
//! use tyndall_document::Node;
//! use tyndall_scene::read::{Range, SceneReader, number};
//! use tyndall_scene::{FieldValue, Scene, SceneField};
//!
//! #[derive(Debug, PartialEq)]
//! struct Haze {
//!     height: f64,
//! }
//!
//! impl FieldValue for Haze {
//!     fn varies(&self) -> bool {
//!         false
//!     }
//! }
//!
//! /// `haze: (height: 3.0)` in a scene file.
//! const HAZE: SceneField<Scene, Haze> = SceneField::new("haze", read);
//!
//! fn read(reader: &mut SceneReader<'_>, node: &Node) -> Option<Haze> {
//!     let fields = reader.fields(node, "a haze", &["height"])?;
//!     let height = fields.required(reader, "height")?;
//!     Some(Haze { height: number(reader, height, "height", Range::Positive)? })
//! }
//!
//! fn height(scene: &Scene) -> f64 {
//!     HAZE.of(scene).map_or(0.0, |haze| haze.height)
//! }
//! ```

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::marker::PhantomData;
use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use tyndall_document::Node;

use crate::animate::{Animated, Blend};
use crate::model::{Light, Material, Object};
use crate::part::Part;
use crate::read::SceneReader;
use crate::scene::Scene;

/// What a field that a plugin brings holds.
pub trait FieldValue: Any + Debug + PartialEq + Send + Sync {
    /// Whether it differs between some two times.
    fn varies(&self) -> bool;
}

/// What a field can stand in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    /// The scene file itself: a section.
    Scene,
    /// `medium: (…)`.
    Medium,
    /// Each kind of light.
    Light,
    /// An object.
    Object,
    /// `material: (…)` of an object.
    Material,
}

/// What holds fields that plugins bring.
pub trait HoldsFields {
    /// What it is.
    const HOLDER: Holder;
    /// Those that the scene file gives.
    fn fields(&self) -> &Fields;
}

/// The medium's fields; the medium itself is known to every shader's twin, and so is a plain value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MediumFields(pub Fields);

macro_rules! holders {
    ($($ty:ident . $field:tt = $holder:ident),*) => {
        $(impl HoldsFields for $ty {
            const HOLDER: Holder = Holder::$holder;
            fn fields(&self) -> &Fields {
                &self.$field
            }
        })*
    };
}

holders! { Scene.fields = Scene, MediumFields.0 = Medium, Light.fields = Light, Object.fields = Object, Material.fields = Material }

/// A field `name` of every `H` in a scene file, which holds a `T`: how it is read, and the way to its value.
pub struct SceneField<H, T> {
    /// Its name.
    pub name: &'static str,
    read: fn(&mut SceneReader<'_>, &Node) -> Option<T>,
    holder: PhantomData<fn() -> H>,
}

impl<H: HoldsFields, T: FieldValue> SceneField<H, T> {
    /// A field of this name. `read` reads its value, or reports what is wrong with it and gives `None`.
    pub const fn new(name: &'static str, read: fn(&mut SceneReader<'_>, &Node) -> Option<T>) -> Self {
        Self { name, read, holder: PhantomData }
    }

    /// Its value, where the scene file gives one.
    pub fn of<'a>(&self, holder: &'a H) -> Option<&'a T> {
        holder.fields().0.get(self.name).and_then(|value| value.as_any().downcast_ref())
    }

    /// What a scene is made from where this field counts.
    pub const fn part(&self) -> Part {
        Part::Field(H::HOLDER, self.name)
    }

    pub(crate) fn erased(&self) -> AnyField {
        let read = self.read;
        let erase = move |reader: &mut SceneReader<'_>, node: &Node| -> Option<Arc<dyn AnyValue>> {
            read(reader, node).map(|value| Arc::new(value) as Arc<dyn AnyValue>)
        };
        AnyField { holder: H::HOLDER, name: self.name, read: Arc::new(erase) }
    }
}

type ReadAny = dyn Fn(&mut SceneReader<'_>, &Node) -> Option<Arc<dyn AnyValue>> + Send + Sync;

/// A field whatever it holds.
#[derive(Clone)]
pub(crate) struct AnyField {
    pub holder: Holder,
    pub name: &'static str,
    pub read: Arc<ReadAny>,
}

/// A value whatever it is.
pub(crate) trait AnyValue: Debug + Send + Sync {
    fn as_any(&self) -> &dyn Any;
    fn varies(&self) -> bool;
    fn equals(&self, other: &dyn AnyValue) -> bool;
}

impl<T: FieldValue> AnyValue for T {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn varies(&self) -> bool {
        FieldValue::varies(self)
    }

    fn equals(&self, other: &dyn AnyValue) -> bool {
        other.as_any().downcast_ref::<T>() == Some(self)
    }
}

/// Values of fields that plugins bring, by name.
#[derive(Clone, Debug, Default)]
pub struct Fields(pub(crate) BTreeMap<&'static str, Arc<dyn AnyValue>>);

impl Fields {
    /// Whether none is given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether one of them differs between some two times.
    pub fn any_varies(&self) -> bool {
        self.0.values().any(|value| value.varies())
    }

    /// Whether the field of this name is given and differs between some two times.
    pub(crate) fn vary(&self, name: &str) -> bool {
        self.0.get(name).is_some_and(|value| value.varies())
    }
}

impl PartialEq for Fields {
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = self.0.iter().zip(&other.0);
        self.0.len() == other.0.len() && pairs.all(|((a, x), (b, y))| a == b && x.equals(y.as_ref()))
    }
}

impl Scene {
    /// The fields of plugins that the scene and all that it holds have, in the order of the scene.
    pub fn plugin_fields(&self) -> impl Iterator<Item = &Fields> {
        let lights = self.lights.iter().map(|light| &light.fields);
        let objects = self.objects.iter().map(|object| &object.fields);
        let materials = self.materials.iter().map(|material| &material.fields);
        [&self.fields, &self.medium_fields.0].into_iter().chain(lights).chain(objects).chain(materials)
    }

    /// Whether a field differs between some two times in anything that holds it.
    pub(crate) fn field_varies(&self, holder: Holder, name: &str) -> bool {
        match holder {
            Holder::Scene => self.fields.vary(name),
            Holder::Medium => self.medium_fields.0.vary(name),
            Holder::Light => self.lights.iter().any(|light| light.fields.vary(name)),
            Holder::Object => self.objects.iter().any(|object| object.fields.vary(name)),
            Holder::Material => self.materials.iter().any(|material| material.fields.vary(name)),
        }
    }
}

impl<T: Blend + Debug + Send + Sync + 'static> FieldValue for Animated<T> {
    fn varies(&self) -> bool {
        Animated::varies(self)
    }
}

macro_rules! constant {
    ($($ty:ty),*) => {
        $(impl FieldValue for $ty {
            fn varies(&self) -> bool {
                false
            }
        })*
    };
}

constant! { bool, f64, DVec3, String, PathBuf }
