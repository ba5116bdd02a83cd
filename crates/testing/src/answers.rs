//! What references on the CPU have said, so that none is asked the same thing twice.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use tyndall_plugin::{Outputs, Reference, ReferenceInput};

/// What references on the CPU have said, by what they were asked.
#[derive(Default)]
pub(crate) struct Answers {
    known: Mutex<HashMap<u64, Arc<Outputs>>>,
    took: Mutex<Duration>,
}

impl Answers {
    /// What the reference of a pass says of these inputs.
    pub fn of(&self, pass: &str, reference: Reference, input: &ReferenceInput<'_>) -> Arc<Outputs> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(question(pass, input)).or_insert_with(|| Arc::new(reference(input))).clone()
    }

    /// Does what belongs to asking a reference, and counts the time that it takes.
    pub fn timed<T>(&self, ask: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let answer = ask();
        *self.took.lock().unwrap_or_else(PoisonError::into_inner) += start.elapsed();
        answer
    }

    /// The time that asking took so far.
    pub fn took(&self) -> Duration {
        *self.took.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn question(pass: &str, input: &ReferenceInput<'_>) -> u64 {
    let mut hasher = DefaultHasher::new();
    pass.hash(&mut hasher);
    for (name, data) in &input.inputs {
        (name, data.resource, data.scalar, &data.bytes).hash(&mut hasher);
    }
    for (name, resource) in &input.resources {
        (name, resource).hash(&mut hasher);
    }
    for (name, value) in &input.params {
        (name, value.to_string()).hash(&mut hasher);
    }
    format!("{:?}", input.scene).hash(&mut hasher);
    if let Some(surfaces) = input.surfaces {
        for triangle in &surfaces.triangles {
            triangle.material.hash(&mut hasher);
            for corner in &triangle.corners {
                let [position, normal] =
                    [corner.position, corner.normal].map(|vector| vector.to_array().map(f64::to_bits));
                (position, normal, corner.uv.to_array().map(f64::to_bits)).hash(&mut hasher);
            }
        }
        format!("{:?}", (&surfaces.materials, &surfaces.textures)).hash(&mut hasher);
    }
    hasher.finish()
}
