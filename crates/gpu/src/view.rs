//! One pass of a plan.

use std::sync::Arc;

use tyndall_graph::descriptor::PassDescriptor;
use tyndall_graph::{Plan, Resource};

use crate::error::GpuError;

/// A pass at its position in a plan.
#[derive(Clone, Copy)]
pub struct PlannedView<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) position: u32,
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

    /// What a port is in this plan, by its index in the descriptor.
    pub fn resource(self, port: usize) -> Option<&'a Resource> {
        self.slot(port).map(|slot| &self.plan.slots[slot].resource)
    }

    /// The index of a port in the descriptor.
    ///
    /// # Errors
    /// [`GpuError::Pass`] where the pass declares no such port.
    pub fn port(self, name: &str) -> Result<usize, GpuError> {
        let index = self.descriptor().ports.iter().position(|port| port.name == name);
        index.ok_or_else(|| self.refuse(format!("it declares no port `{name}`")))
    }

    pub(crate) fn slot(self, port: usize) -> Option<usize> {
        self.plan.bindings(self.position)[port].map(|slot| slot as usize)
    }

    pub(crate) fn param(self, name: &str) -> Option<usize> {
        self.descriptor().params.iter().position(|param| param.name == name)
    }

    /// An error of this pass.
    pub fn refuse(self, reason: impl Into<String>) -> GpuError {
        GpuError::Pass { pass: self.name().to_owned(), reason: reason.into() }
    }
}
