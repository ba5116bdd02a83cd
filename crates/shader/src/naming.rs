//! Reserved names: of variables that are not ports.

/// The uniform variable whose members are parameters.
pub const PARAMS: &str = "params";

/// The name of the count of threads that did not get to the end of their loops (`shaders/unfinished.wgsl`).
pub const UNFINISHED: &str = "unfinished";

/// The scene data whose element count an `override` of this name is: `phase_table` of `phase_table_count`. It is given
/// when the pipeline is made, so that what a scene does not need costs nothing; it is not a parameter.
pub fn counted(name: &str) -> Option<&str> {
    name.strip_suffix("_count")
}

/// A sampler that every shader may declare by name: `var linear_clamp: sampler;`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampler {
    /// Name of the variable.
    pub name: &'static str,
    /// Interpolates: its binding is a filtering one, and what it samples must be filterable.
    pub filtering: bool,
    /// Repeats outside 0..1; otherwise the edge continues.
    pub repeats: bool,
}

/// All samplers. `nearest_clamp` must be bound as a non-filtering sampler.
pub const SAMPLERS: [Sampler; 3] = [
    Sampler { name: "linear_clamp", filtering: true, repeats: false },
    Sampler { name: "nearest_clamp", filtering: false, repeats: false },
    Sampler { name: "linear_repeat", filtering: true, repeats: true },
];

/// The sampler of this name.
pub fn sampler(name: &str) -> Option<&'static Sampler> {
    SAMPLERS.iter().find(|sampler| sampler.name == name)
}
