//! One pass of a plan.

use std::sync::Arc;

use tyndall_graph::descriptor::{ParamDescriptor, PassDescriptor, PortDescriptor};
use tyndall_graph::{Handle, Plan, PlannedPass, Resource, Slot};

use crate::error::GpuError;

/// A pass at its position in a plan.
#[derive(Clone, Copy)]
pub struct PlannedView<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) position: Handle<PlannedPass>,
}

impl<'a> PlannedView<'a> {
    /// Its name in the graph.
    pub fn name(self) -> &'a str {
        self.plan.pass_name(self.position)
    }

    /// What it declares.
    pub fn descriptor(self) -> &'a Arc<PassDescriptor> {
        self.plan.descriptor(self.position)
    }

    /// What a port is in this plan.
    pub fn resource(self, port: Handle<PortDescriptor>) -> Option<&'a Resource> {
        self.slot(port).map(|slot| &self.plan.slots[slot].resource)
    }

    /// The port of this name.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where the pass declares no such port.
    pub fn port(self, name: &str) -> Result<Handle<PortDescriptor>, GpuError> {
        self.descriptor().port_named(name).ok_or_else(|| self.refuse(format!("it declares no port `{name}`")))
    }

    pub(crate) fn slot(self, port: Handle<PortDescriptor>) -> Option<Handle<Slot>> {
        self.plan.bindings(self.position)[port]
    }

    pub(crate) fn param(self, name: &str) -> Option<Handle<ParamDescriptor>> {
        self.descriptor().param_named(name)
    }

    /// An error of this pass.
    pub fn refuse(self, reason: impl Into<String>) -> GpuError {
        GpuError::Pass { pass: self.name().to_owned(), reason: reason.into() }
    }
}
