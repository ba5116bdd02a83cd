//! What the passes of a plan were made from in a frame.

use tyndall_gpu::FRAMES_PER_SECOND;
use tyndall_graph::{Digest, Origin, Plan, PlannedPass, Provenance, Table};
use tyndall_plugin::Registry;
use tyndall_scene::Encoded;

/// What the results of every pass of a plan were made from.
pub(crate) type Origins = Table<PlannedPass, Origin>;

/// With the shaders of a registry, and the bytes of a scene.
pub(crate) fn origins(plan: &Plan, registry: &Registry, scene: Option<&Encoded>, frame: u32) -> Origins {
    let shaders = |pass: &str| registry.pass(pass).map_or(0, |pass| pass.fingerprint);
    // A file that cannot be read has no content; the pass that reads it says so.
    let file = |path: &str| Digest::of(&std::fs::read(path).unwrap_or_default());
    let mut provenance = Provenance::new(plan, &shaders, &file);
    let bytes = |name: &String| scene.map_or(&[][..], |scene| scene.bytes(name));
    let versions: Vec<u64> = provenance.scene().iter().map(|name| Digest::of(bytes(name))).collect();
    provenance.update(plan, &plan.values(frame, f64::from(frame) / FRAMES_PER_SECOND), |index| versions[index]);
    provenance.origins().clone()
}
