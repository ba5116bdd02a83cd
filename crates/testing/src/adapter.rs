//! Classes of adapters: what a golden was made on, and what a tolerance may be stated for.

use tyndall_gpu::Gpu;
use tyndall_gpu::wgpu::DeviceType;

/// A class of adapters that may round alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AdapterClass {
    /// A graphics card.
    Discrete,
    /// In the processor.
    Integrated,
    /// Of a virtual machine.
    Virtual,
    /// On the CPU: lavapipe, WARP.
    Software,
    /// Any other.
    Other,
}

impl AdapterClass {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Discrete, Self::Integrated, Self::Virtual, Self::Software, Self::Other];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Software => "software",
            Self::Other => "other",
        }
    }

    /// The class of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|class| class.name() == name)
    }

    /// That of a device.
    pub fn of(gpu: &Gpu) -> Self {
        match gpu.info.device_type {
            DeviceType::DiscreteGpu => Self::Discrete,
            DeviceType::IntegratedGpu => Self::Integrated,
            DeviceType::VirtualGpu => Self::Virtual,
            DeviceType::Cpu => Self::Software,
            DeviceType::Other => Self::Other,
        }
    }
}
