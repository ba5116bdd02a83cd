//! Every pass that a graph file may use, by name.

use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::descriptor::PassDescriptor;
use crate::signature::{DescriptorError, Signature};

/// Width and height in texels of the picture in a file; `None` where it holds none that can be read.
pub type PictureSize = fn(&Path) -> Option<(u32, u32)>;

/// Descriptors of every pass, by name.
#[derive(Debug, Clone, Default)]
pub struct Catalogue {
    /// How large the pictures in files are, for passes whose ports have their size.
    pub picture_size: Option<PictureSize>,
    kinds: FxHashMap<String, Arc<Kind>>,
}

/// A descriptor, and what validation and planning read instead of its names.
#[derive(Debug)]
pub(crate) struct Kind {
    pub descriptor: Arc<PassDescriptor>,
    pub signature: Signature,
}

impl Catalogue {
    /// One without passes.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a pass.
    ///
    /// # Errors
    /// Everything that contradicts itself in the descriptor, or that a pass of this name is there already. The
    /// catalogue is unchanged then.
    pub fn insert(&mut self, descriptor: Arc<PassDescriptor>) -> Result<(), Vec<DescriptorError>> {
        if self.kinds.contains_key(&descriptor.name) {
            return Err(vec![DescriptorError::DuplicatePass(descriptor.name.clone())]);
        }
        let signature = Signature::of(&descriptor)?;
        self.kinds.insert(descriptor.name.clone(), Arc::new(Kind { descriptor, signature }));
        Ok(())
    }

    /// The pass of this name.
    pub fn get(&self, name: &str) -> Option<&Arc<PassDescriptor>> {
        self.kinds.get(name).map(|kind| &kind.descriptor)
    }

    /// All names, sorted.
    pub fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.kinds.keys().map(String::as_str).collect();
        names.sort_unstable();
        names
    }

    pub(crate) fn kind(&self, name: &str) -> Option<&Arc<Kind>> {
        self.kinds.get(name)
    }
}
