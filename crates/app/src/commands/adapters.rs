//! `adapters`: the adapters of this machine.

use tyndall_gpu::{AdapterSummary, GpuError};

use crate::failure::Failure;
use crate::terminal;

pub(crate) fn run() -> Result<(), Failure> {
    let adapters = tyndall_gpu::adapters();
    if adapters.is_empty() {
        return Err(GpuError::NoAdapter.into());
    }
    for (index, adapter) in adapters.iter().enumerate() {
        terminal::line(&describe(adapter, index == 0));
    }
    Ok(())
}

fn describe(adapter: &AdapterSummary, is_default: bool) -> String {
    format!(
        "{}{}\n    {} through {}, driver {}\n    textures up to {} texels wide, GPU times {}",
        adapter.name,
        if is_default { "  (default)" } else { "" },
        adapter.kind,
        adapter.backend,
        adapter.driver,
        adapter.max_texture_size,
        if adapter.timestamps { "measured" } else { "not measured" },
    )
}
