//! A shader that stands in for one of a pass's own.

use std::collections::HashMap;
use std::sync::Arc;

use tyndall_gpu::PortData;
use tyndall_plugin::Registry;
use tyndall_shader::Linked;

use crate::session::ResultKey;

/// A shader that stands in for one of a pass's own, and what came of it.
pub(crate) struct Substitute {
    pub pass: String,
    file: String,
    /// That of the pass's own shaders: another pass of the same name, beside another graph, keeps its own.
    fingerprint: u64,
    pub shader: Arc<Linked>,
    /// The registry with the pass's own shader.
    pub original: Option<Arc<Registry>>,
    pub results: HashMap<ResultKey, Arc<PortData>>,
    /// A port came out with other bits.
    pub changed: bool,
}

impl Substitute {
    /// In the place of the shader `file` of a pass (`plugin.pass`) whose shaders have this fingerprint.
    pub fn new(pass: &str, file: &str, fingerprint: u64, shader: Linked) -> Self {
        Self {
            pass: pass.to_owned(),
            file: file.to_owned(),
            fingerprint,
            shader: Arc::new(shader),
            original: None,
            results: HashMap::new(),
            changed: false,
        }
    }

    /// A registry with it in place.
    pub fn registry(&mut self, registry: &Arc<Registry>) -> Arc<Registry> {
        if registry.pass(&self.pass).is_none_or(|pass| pass.fingerprint != self.fingerprint) {
            return registry.clone();
        }
        self.original = Some(registry.clone());
        Arc::new(registry.with_shader(&self.pass, &self.file, &self.shader))
    }
}
