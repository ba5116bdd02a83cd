//! What can go wrong between a plan and its pictures.

/// Why a machine could not run a plan.
#[derive(Debug, Clone, thiserror::Error)]
pub enum GpuError {
    /// No adapter answered at all.
    #[error(
        "no GPU driver answers on this machine: install one, or a software driver (Debian and Ubuntu: \
         `apt-get install mesa-vulkan-drivers libvulkan1`)"
    )]
    NoAdapter,
    /// No adapter's name matches.
    #[error("no adapter's name holds {name:?}; this machine has: {}", list(.present))]
    UnknownAdapter {
        /// What was asked for.
        name: String,
        /// The names of those present.
        present: Vec<String>,
    },
    /// The adapter refused a device.
    #[error("adapter {adapter:?} gave no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// Its words.
        reason: String,
    },
    /// Something is over the adapter's limits.
    #[error("{what} is {size}, and adapter {adapter:?} allows {limit}")]
    OverLimit {
        /// What is too large: `fogged.radiance: its width`.
        what: String,
        /// How large it is.
        size: String,
        /// How large it may be.
        limit: String,
        /// The adapter's name.
        adapter: String,
    },
    /// The plan needs more memory than there is; nothing was allocated.
    #[error("the plan and reading its results back need {}, and only {} are free: choose a smaller --size", bytes(*.needed), bytes(*.available))]
    TooLittleMemory {
        /// Bytes that the plan and what reads it back need.
        needed: u64,
        /// Bytes that are free.
        available: u64,
    },
    /// An allocation failed all the same.
    #[error("out of memory while creating {what}")]
    OutOfMemory {
        /// What was being created.
        what: String,
    },
    /// The driver or wgpu refused something.
    #[error("{what}: {reason}")]
    Refused {
        /// What was being made.
        what: String,
        /// The words of wgpu or the driver.
        reason: String,
    },
    /// The device is gone.
    #[error("the GPU was lost: {reason}; nothing more can be drawn, start again")]
    Lost {
        /// The driver's words.
        reason: String,
    },
    /// A file that a pass reads is wrong: the one error here that is not the machine's.
    #[error("pass `{pass}`: {reason}")]
    Input {
        /// Its name in the graph.
        pass: String,
        /// What is wrong with which file.
        reason: String,
    },
    /// A pass asks for something that the descriptor does not have: a bug of the pass.
    #[error("pass `{pass}`: {reason}")]
    Pass {
        /// `plugin.pass`, or its name in the graph.
        pass: String,
        /// What is wrong.
        reason: String,
    },
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// A byte count as a person reads it: `1.5 GiB`.
pub fn bytes(count: u64) -> String {
    const UNITS: [&str; 5] = ["B", "KiB", "MiB", "GiB", "TiB"];
    let mut value = count as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 { format!("{count} B") } else { format!("{value:.1} {}", UNITS[unit]) }
}
