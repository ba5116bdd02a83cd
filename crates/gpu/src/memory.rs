//! What must hold before anything is allocated: the adapter's limits, and the memory that is there.

use tyndall_graph::descriptor::Dimension;
use tyndall_graph::{Plan, Resource};

use crate::device::Gpu;
use crate::error::{GpuError, bytes};
use crate::slots::slot_name;

/// Refuses a plan that this machine cannot hold.
///
/// `readback` is what the caller will want to hold of its results at a time, in bytes of texels.
///
/// # Errors
/// [`GpuError::OverLimit`], [`GpuError::TooLittleMemory`].
pub fn check(gpu: &Gpu, plan: &Plan, readback: u64) -> Result<(), GpuError> {
    for (index, slot) in plan.slots.entries() {
        within_limits(gpu, &slot_name(plan, index), &slot.resource)?;
    }
    let needed = plan.slots.iter().fold(readback, |sum, slot| sum.saturating_add(slot.resource.bytes()));
    match available(gpu) {
        Some(available) if needed > available => Err(GpuError::TooLittleMemory { needed, available }),
        _ => Ok(()),
    }
}

fn within_limits(gpu: &Gpu, name: &str, resource: &Resource) -> Result<(), GpuError> {
    let over = |what: &str, size: String, limit: String| {
        Err(GpuError::OverLimit { what: format!("{what} of `{name}`"), size, limit, adapter: gpu.info.name.clone() })
    };
    match *resource {
        Resource::Texture { dimension, width, height, depth_or_layers, .. } => {
            let (side, deep) = match dimension {
                Dimension::D2 => (gpu.limits.max_texture_dimension_2d, 1),
                Dimension::D2Array => (gpu.limits.max_texture_dimension_2d, gpu.limits.max_texture_array_layers),
                Dimension::D3 => (gpu.limits.max_texture_dimension_3d, gpu.limits.max_texture_dimension_3d),
            };
            for (what, size, limit) in
                [("the width", width, side), ("the height", height, side), ("the depth", depth_or_layers, deep)]
            {
                if size > limit {
                    return over(what, size.to_string(), limit.to_string());
                }
            }
        }
        Resource::Buffer { bytes: size, .. } => {
            let limit = gpu.limits.max_storage_buffer_binding_size.min(gpu.limits.max_buffer_size);
            if size > limit {
                return over("the size", bytes(size), bytes(limit));
            }
        }
    }
    Ok(())
}

/// Bytes that this adapter can still hold, where that is known before trying: a software adapter uses the machine's
/// memory and does not refuse by itself. Other drivers refuse at creation (wgpu's memory budget).
fn available(gpu: &Gpu) -> Option<u64> {
    if !gpu.is_software() {
        return None;
    }
    let machine = meminfo(&std::fs::read_to_string("/proc/meminfo").ok()?)?;
    let group = ["/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"]
        .map(|path| std::fs::read_to_string(path).ok().and_then(|text| text.trim().parse::<u64>().ok()));
    match group {
        [Some(most), Some(used)] => Some(machine.min(most.saturating_sub(used))),
        _ => Some(machine),
    }
}

/// `MemAvailable` of a `/proc/meminfo`, in bytes.
fn meminfo(text: &str) -> Option<u64> {
    let line = text.lines().find(|line| line.starts_with("MemAvailable:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kibibytes| kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::meminfo;

    #[test]
    fn meminfo_reads_the_available_line() {
        let text = "MemTotal:       24000000 kB\nMemFree: 1 kB\nMemAvailable:   23000000 kB\n";
        assert_eq!(meminfo(text), Some(23_000_000 * 1024));
        assert_eq!(meminfo("MemTotal: 5 kB\n"), None);
    }
}
