//! What sessions that run side by side share, so that nothing is worked out twice.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use tyndall_gpu::PortData;

use crate::cached_references::{Known, locked};
use crate::session::ResultKey;

/// What sessions share that run side by side, each in a thread of its own: results of passes by what they were made from,
/// and what references on the CPU have said.
#[derive(Default)]
pub struct Shared {
    results: Mutex<Results>,
    pub(crate) references: Arc<Mutex<Known>>,
}

#[derive(Default, Clone)]
struct Results {
    ports: HashMap<ResultKey, Arc<PortData>>,
    /// How many bytes these are.
    held: usize,
}

/// Results that are held at most, bytes: 1 GiB. Beyond it all are let go, and sharing begins anew.
const MOST_HELD: usize = 1 << 30;

impl Shared {
    /// What was kept under this key.
    pub(crate) fn result(&self, key: &ResultKey) -> Option<Arc<PortData>> {
        locked(&self.results).ports.get(key).cloned()
    }

    /// The same results, and from then on others; what references have said remains common.
    pub(crate) fn fork(&self) -> Self {
        Self { results: Mutex::new(locked(&self.results).clone()), references: self.references.clone() }
    }

    /// Keeps a result.
    pub(crate) fn keep(&self, key: ResultKey, data: &Arc<PortData>) {
        let mut results = locked(&self.results);
        if results.held + data.bytes.len() > MOST_HELD {
            *results = Results::default();
        }
        results.held += data.bytes.len();
        results.ports.insert(key, data.clone());
    }
}
