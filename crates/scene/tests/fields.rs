//! What a plugin adds to scenes: fields of everything that can hold some, data made from them, and names that clash.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_document::{Diagnostics, Node, Source, render_text};
use tyndall_scene::animate::Animated;
use tyndall_scene::layout::Shape;
use tyndall_scene::model::{Light, Material, Object};
use tyndall_scene::read::{Range, SceneReader, animated_number, number};
use tyndall_scene::{
    Buffers, Encoder, Extension, Extensions, Feature, MediumFields, Moment, Override, Overrides, Part, Scene,
    SceneData, SceneField,
};

const GLOW: SceneField<Scene, Animated<f64>> = SceneField::new("glow", level);
const MURK: SceneField<MediumFields, Animated<f64>> = SceneField::new("murk", level);
const FLICKER: SceneField<Light, Animated<f64>> = SceneField::new("flicker", level);
const WEIGHT: SceneField<Object, f64> = SceneField::new("weight", weight);
const RELIEF: SceneField<Material, PathBuf> = SceneField::new("relief", |reader, node| reader.file(node));

fn level(reader: &mut SceneReader<'_>, node: &Node) -> Option<Animated<f64>> {
    animated_number(reader, node, "level", Range::Unit)
}

fn weight(reader: &mut SceneReader<'_>, node: &Node) -> Option<f64> {
    number(reader, node, "weight", Range::Positive)
}

/// Counts the moments that it was asked for.
struct Counting(u32);

impl Encoder for Counting {
    fn encode(&mut self, _: &Moment<'_>, data: &mut Buffers<'_>) {
        self.0 += 1;
        data.set_list("counts", [self.0]);
        data.set_list("doubles", [2 * self.0]);
    }
}

fn plugin() -> Extension {
    let mut plugin = Extension::default();
    plugin.add_field(&GLOW);
    plugin.add_field(&MURK);
    plugin.add_field(&FLICKER);
    plugin.add_field(&WEIGHT);
    plugin.add_field(&RELIEF);
    let glow = |moment: &Moment<'_>| vec![GLOW.of(moment.scene).map_or(0.0, |glow| glow.at(moment.time)) as f32];
    plugin.add_data(SceneData::list("glow_level", &[GLOW.part()], glow));
    let flicker = |moment: &Moment<'_>| {
        let level = |light: &Light| FLICKER.of(light).map_or(1.0, |level| level.at(moment.time) as f32);
        moment.scene.lights.iter().map(level).collect()
    };
    plugin.add_data(SceneData::list("flicker_levels", &[FLICKER.part()], flicker));
    let items = vec![("counts", Shape::list::<u32>()), ("doubles", Shape::list::<u32>())];
    plugin.add_data(SceneData::kept(items, &[Part::Lights], |_| Box::new(Counting(0))));
    plugin.add_feature(Feature { name: "Glow", is_in: |scene| GLOW.of(scene).is_some() });
    plugin
}

fn extensions() -> Arc<Extensions> {
    let mut extensions = Extensions::default();
    extensions.add("glow", plugin()).expect("nothing clashes");
    Arc::new(extensions)
}

fn read_with(rest: &str, overrides: &Overrides) -> Result<Scene, Diagnostics> {
    let text = format!("(camera: (position: (0, 1, 5), look_at: (0, 1, 0)), {rest})");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    Scene::from_source(&Source::new("test.scene.ron", text), &folder, overrides, &extensions()).map(|read| read.0)
}

fn read(rest: &str) -> Scene {
    read_with(rest, &Overrides::new()).unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)))
}

const ALL: &str = "
    glow: Keys([(0, 0), (2, 1)]),
    medium: (extinction: (1, 1, 1), murk: 0.5),
    lights: [
        Point(position: (0, 0, 0), intensity: (1, 1, 1), flicker: Keys([(0, 1), (4, 0)])),
        Spot(position: (0, 0, 0), direction: (0, 1, 0), intensity: (1, 1, 1), flicker: 0.25),
        Directional(direction: (0, 1, 0), irradiance: (1, 1, 1)),
    ],
    objects: [(mesh: Sphere(radius: 1), weight: 3.0, material: (relief: \"fields.rs\"))],";

#[test]
fn everything_holds_fields() {
    let scene = read(ALL);
    assert_eq!(GLOW.of(&scene).map(|glow| glow.at(0.5)), Some(0.25));
    assert_eq!(MURK.of(&scene.medium_fields), Some(&Animated::Constant(0.5)));
    let flicker: Vec<Option<f64>> = scene.lights.iter().map(|light| FLICKER.of(light).map(|at| at.at(1.0))).collect();
    assert_eq!(flicker, [Some(0.75), Some(0.25), None]);
    assert_eq!(WEIGHT.of(&scene.objects[0]), Some(&3.0));
    let relief = RELIEF.of(&scene.materials[0]).expect("a file");
    assert!(relief.ends_with("tests/fields.rs") && scene.files().contains(relief), "{:?}", scene.files());
    let bare = read("objects: [(mesh: Sphere(radius: 1))]");
    assert!(GLOW.of(&bare).is_none() && WEIGHT.of(&bare.objects[0]).is_none());
    assert_ne!(scene.fields, bare.fields);
    assert_eq!(scene.fields, read(ALL).fields);
    assert_ne!(scene.fields, read(&ALL.replace("(2, 1)", "(2, 0.5)")).fields);
    assert!(format!("{:?}", scene.materials[0]).contains("fields.rs"));
}

#[test]
fn data_follow_the_fields_that_they_are_made_from() {
    let scene = read(ALL);
    assert_eq!(scene.animated(), ["glow_level", "flicker_levels"]);
    assert_eq!(read(&ALL.replace("Keys([(0, 0), (2, 1)])", "0.5")).animated(), ["flicker_levels"]);
    let numbers = |bytes: &[u8]| bytemuck::pod_collect_to_vec::<u8, f32>(&bytes[16..]);
    let mut encoded = scene.encode_for(0.0, 1.0, &|name| name.ends_with("level") || name == "flicker_levels");
    assert_eq!(numbers(encoded.bytes("glow_level")), [0.0]);
    assert_eq!(encoded.update(&scene, 1.0, 1.0), ["glow_level", "flicker_levels"]);
    assert_eq!(numbers(encoded.bytes("glow_level")), [0.5]);
    assert_eq!(numbers(encoded.bytes("flicker_levels")), [0.75, 0.25, 1.0]);
    assert!(encoded.update(&scene, 1.0, 2.0).is_empty());
}

/// What is kept from frame to frame is kept, and nothing is made where nothing that it is made from has changed.
#[test]
fn encoders_remember() {
    let scene = read("lights: [Point(position: Keys([(0, (0, 0, 0)), (1, (1, 0, 0))]), intensity: (1, 1, 1))]");
    let count = |bytes: &[u8]| u32::from_le_bytes(*bytes[16..].first_chunk().expect("an element"));
    let mut encoded = scene.encode_for(0.0, 1.0, &|name| name == "doubles");
    for (time, changed, expected) in [(0.0, 0, 1), (0.25, 2, 2), (0.25, 0, 2), (0.5, 2, 3)] {
        assert_eq!(encoded.update(&scene, time, 1.0).len(), changed, "{time}");
        assert_eq!((count(encoded.bytes("counts")), count(encoded.bytes("doubles"))), (expected, 2 * expected));
    }
}

#[test]
fn mistakes_have_their_place() {
    for (rest, expected) in [
        ("glow: 2", "error[out-of-range]: `level` is 2; it must lie in 0..1\n --> test.scene.ron:1:59"),
        ("glow: Keys([])", "error[empty-keys]"),
        ("glou: 1", "did you mean `glow`?"),
        ("murk: 1", "available: `camera`, `medium`, `background`, `lights`, `objects`, `glow`"),
        ("medium: (murky: 1)", "did you mean `murk`?"),
        ("objects: [(mesh: Sphere(radius: 1), material: (relief: \"none.png\"))]", "error[missing-file]"),
        ("objects: [(mesh: Sphere(radius: 1), weight: 0, scale: 0)]", "`scale` is 0"),
    ] {
        let messages = read_with(rest, &Overrides::new()).map(|_| ()).expect_err(rest);
        let messages = render_text(&messages, false);
        assert!(messages.contains(expected), "{rest}: {messages}");
    }
}

/// The path of a field on the command line starts at the working directory.
#[test]
fn arguments_change_fields() {
    let mut out = Diagnostics::default();
    let mut set = |path: &str, value: &str| Override::read(path, value, "--set scene.…", &mut out).expect("it is RON");
    let overrides = vec![set("glow", "0.5"), set("objects.0.material.relief", "\"Cargo.toml\"")];
    let scene = read_with(ALL, &overrides).unwrap_or_else(|mistakes| panic!("{}", render_text(&mistakes, false)));
    assert_eq!(GLOW.of(&scene), Some(&Animated::Constant(0.5)));
    assert_eq!(RELIEF.of(&scene.materials[0]), Some(&PathBuf::from("Cargo.toml")));
}

#[test]
fn features_are_of_the_scene_and_of_plugins() {
    let extensions = extensions();
    let names = |plugin| extensions.features(plugin).iter().map(|feature| feature.name).collect::<Vec<_>>();
    assert_eq!(names("glow"), ["Point", "Spot", "Directional", "Medium", "Glow"]);
    let glow = *extensions.features("glow").last().expect("a feature");
    assert!((glow.is_in)(&read("glow: 1")) && !(glow.is_in)(&read("")));
}

#[test]
fn names_that_are_taken_are_refused() {
    let mut extensions = Extensions::default();
    extensions.add("glow", plugin()).expect("nothing clashes");
    let messages = extensions.add("ember", plugin()).expect_err("everything clashes");
    assert_eq!(messages.len(), 9, "{messages:?}");
    assert_eq!(messages[0], "the scene data `glow_level` belongs to glow already");
    assert_eq!(messages[4], "the scene field `glow` belongs to glow already");
    let mut core = Extension::default();
    core.add_data(SceneData::list("lights", &[], |_| vec![0u32]));
    core.add_field(&SceneField::<Object, f64>::new("mesh", weight));
    core.add_feature(Feature { name: "Spot", is_in: |_| true });
    let messages = extensions.add("core", core).expect_err("everything clashes");
    let expected = ["scene data `lights`", "scene field `mesh`", "scene feature `Spot`"];
    assert_eq!(messages, expected.map(|what| format!("the {what} belongs to the scene already")));
}
