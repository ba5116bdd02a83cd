//! Sessions for tests that run side by side.

use std::sync::{Arc, Mutex};

use tyndall_plugin::SearchPath;
use tyndall_render::Error;

use crate::cached_references::locked;
use crate::session::{Plugins, Session};
use crate::shared::Shared;

/// Sessions for tests that run side by side: each test takes one that no other has, or opens another. All of them share
/// results that are the same.
pub struct Sessions {
    plugins: Plugins,
    search: Vec<SearchPath>,
    shared: Arc<Shared>,
    idle: Mutex<Vec<Session>>,
}

impl Sessions {
    /// With these plugins, and folders of plugins that win over those of crates. No device is opened yet.
    pub fn new(plugins: Plugins, search: Vec<SearchPath>) -> Self {
        Self { plugins, search, shared: Arc::default(), idle: Mutex::default() }
    }

    /// Does something with a session.
    ///
    /// # Errors
    /// Where no adapter answers.
    pub fn with<T>(&self, work: impl FnOnce(&mut Session) -> T) -> Result<T, Error> {
        let waiting = locked(&self.idle).pop();
        let another = || Session::sharing(&self.shared, self.plugins.clone(), self.search.clone(), None);
        let mut session = waiting.map_or_else(another, Ok)?;
        let done = work(&mut session);
        locked(&self.idle).push(session);
        Ok(done)
    }
}
