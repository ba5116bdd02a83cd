//! `tyndall` with the plugin `flare`: a section of the scene file, a table that is made from it on the CPU, and a pass that
//! reads the table.

use std::process::ExitCode;

use tyndall_document::{Node, UNREADABLE_FILE};
use tyndall_plugin::scene::animate::Animated;
use tyndall_plugin::scene::layout::floats;
use tyndall_plugin::scene::read::{Range, SceneReader, animated_power, number};
use tyndall_plugin::scene::{FieldValue, Moment, Scene, SceneData, SceneField, wgsl_struct};
use tyndall_plugin::{Plugin, folder};

/// `flare: (color: …, strength: 1.0, profile: "…")`.
const FLARE: SceneField<Scene, Flare> = SceneField::new("flare", read);

#[derive(Debug, PartialEq)]
struct Flare {
    /// W/(sr m²).
    color: Animated,
    strength: f64,
    /// Of each step.
    shares: Vec<f32>,
}

impl FieldValue for Flare {
    fn varies(&self) -> bool {
        self.color.varies()
    }
}

fn read(reader: &mut SceneReader<'_>, node: &Node) -> Option<Flare> {
    let fields = reader.fields(node, "a flare", &["color", "strength", "profile"])?;
    let color = fields.required(reader, "color").and_then(|node| animated_power(reader, node, "color"));
    let strength = match fields.get("strength") {
        Some(node) => number(reader, node, "strength", Range::Positive),
        None => Some(1.0),
    };
    let shares = fields.required(reader, "profile").and_then(|node| profile(reader, node));
    Some(Flare { color: color?, strength: strength?, shares: shares? })
}

/// Numbers in a text file.
fn profile(reader: &mut SceneReader<'_>, node: &Node) -> Option<Vec<f32>> {
    let path = reader.file(node)?;
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let shares: Option<Vec<f32>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    if shares.is_none() {
        let place = reader.place(node.span);
        reader.report(tyndall_document::Diagnostic::error(UNREADABLE_FILE, place, "a profile holds numbers"));
    }
    shares
}

wgsl_struct! {
    /// `Step` of `row.wgsl`.
    struct Step {
        /// W/(sr m²).
        color: [f32; 3],
        /// What it counts.
        share: f32,
    }
}

fn steps(moment: &Moment<'_>) -> Vec<Step> {
    let Some(flare) = FLARE.of(moment.scene) else { return Vec::new() };
    let color = floats(flare.color.at(moment.time) * flare.strength);
    flare.shares.iter().map(|share| Step { color, share: *share }).collect()
}

fn brightest(scene: &Scene) -> f64 {
    FLARE.of(scene).map_or(0.0, |flare| (flare.color.at(0.0) * flare.strength).max_element())
}

fn plugin() -> Plugin {
    Plugin::new("flare", folder!("flare": "plugin.ron", "row.wgsl"))
        .scene_field(&FLARE)
        .scene_data(SceneData::list("flare_steps", &[FLARE.part()], steps))
        .scene_feature("Dazzling", |scene| brightest(scene) > 1e6)
        .scene_feature("Starless", |scene| scene.lights.is_empty())
}

fn main() -> ExitCode {
    tyndall::App::new().plugin(plugin).run()
}
