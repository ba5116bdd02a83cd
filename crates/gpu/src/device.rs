//! The adapter, the device, and the one door through which GPU objects are created (and counted).

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::GpuError;

/// A device with its queue. Everything on the GPU is created through it, so it can count.
pub struct Gpu {
    /// Name, kind and driver of the adapter.
    pub info: wgpu::AdapterInfo,
    /// What the device may do; all that the adapter offers.
    pub limits: wgpu::Limits,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    created: AtomicU64,
    failure: Arc<Mutex<Option<GpuError>>>,
}

/// One adapter of this machine, as `tyndall adapters` lists it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AdapterSummary {
    /// Its name, what `--adapter` matches a part of.
    pub name: String,
    /// `Vulkan`, `Metal`, `Dx12`.
    pub backend: String,
    /// `discrete`, `integrated`, `virtual`, `software`, `other`.
    pub kind: &'static str,
    /// The driver's name and version.
    pub driver: String,
    /// Longest side of a 2D texture, in texels.
    pub max_texture_size: u32,
    /// GPU times can be measured.
    pub timestamps: bool,
}

impl Gpu {
    /// Opens the adapter whose name holds `name` (in any case), or the best one.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::UnknownAdapter`], [`GpuError::NoDevice`].
    pub fn open(name: Option<&str>) -> Result<Arc<Self>, GpuError> {
        let mut adapters = enumerate();
        adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type));
        let adapter = match name {
            None => adapters.into_iter().next().ok_or(GpuError::NoAdapter)?,
            Some(name) => {
                let present: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
                let wanted = name.to_lowercase();
                adapters
                    .into_iter()
                    .find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted))
                    .ok_or_else(|| GpuError::UnknownAdapter { name: name.to_owned(), present })?
            }
        };
        Self::from_adapter(&adapter)
    }

    fn from_adapter(adapter: &wgpu::Adapter) -> Result<Arc<Self>, GpuError> {
        let features = adapter.features() & Self::features();
        let limits = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("tyndall"),
            required_features: features,
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, reason: error.to_string() })?;
        Ok(Self::watched(adapter.get_info(), limits, device, queue))
    }

    /// A device that does nothing, for tests and for measuring what recording costs.
    pub fn noop() -> Arc<Self> {
        let (device, queue) = wgpu::Device::noop(&wgpu::DeviceDescriptor::default());
        Self::watched(device.adapter_info(), device.limits(), device, queue)
    }

    /// What is used where an adapter has it.
    fn features() -> wgpu::Features {
        wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
            | wgpu::Features::FLOAT32_FILTERABLE
            | wgpu::Features::FLOAT32_BLENDABLE
            | wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES
    }

    fn watched(info: wgpu::AdapterInfo, limits: wgpu::Limits, device: wgpu::Device, queue: wgpu::Queue) -> Arc<Self> {
        let failure = Arc::new(Mutex::new(None));
        let first = |slot: &Mutex<Option<GpuError>>, error: GpuError| {
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        };
        let seen = failure.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| first(&seen, refused("the GPU", error))));
        let seen = failure.clone();
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed || !message.is_empty() {
                first(&seen, GpuError::Lost { reason: format!("{reason:?} {message}").trim().to_owned() });
            }
        });
        Arc::new(Self { info, limits, device, queue, created: AtomicU64::new(0), failure })
    }

    /// Whether GPU times can be measured.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// The adapter computes on the CPU, so its memory is the machine's.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// GPU objects created so far: buffers, textures, views, samplers, layouts, pipelines, bind groups, query sets.
    /// Command encoders are not counted.
    pub fn objects_created(&self) -> u64 {
        self.created.load(Ordering::Relaxed)
    }

    /// The first failure that no caller caught: a lost device, or something the driver refused while it ran.
    ///
    /// # Errors
    /// That failure.
    pub fn check(&self) -> Result<(), GpuError> {
        match &*self.failure.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error.clone()),
            None => Ok(()),
        }
    }

    /// Destroys the device, as a driver's reset would: all later work ends in [`GpuError::Lost`].
    pub fn lose(&self) {
        let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        failure.get_or_insert(GpuError::Lost { reason: "it was destroyed".to_owned() });
        drop(failure);
        self.device.destroy();
    }

    /// Waits for everything that was submitted.
    ///
    /// # Errors
    /// What [`Gpu::check`] finds.
    pub fn wait(&self) -> Result<(), GpuError> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        polled.map(|_| ()).map_err(|error| GpuError::Lost { reason: error.to_string() })
    }

    /// Runs `make`, which creates `objects` GPU objects, and turns what wgpu reports into an error that names `what`.
    pub(crate) fn create<T>(
        &self,
        what: &str,
        objects: u64,
        make: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T, GpuError> {
        self.check()?;
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let made = make(&self.device);
        self.created.fetch_add(objects, Ordering::Relaxed);
        let errors = [validation, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        // What follows from a failed allocation is invalid too: the allocation is the cause.
        match errors.into_iter().rev().flatten().next() {
            Some(error) => Err(refused(what, error)),
            None => Ok(made),
        }
    }
}

/// The adapters of this machine, best first.
pub fn adapters() -> Vec<AdapterSummary> {
    let mut found = enumerate();
    found.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    found.iter().map(summary).collect()
}

fn enumerate() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        memory_budget_thresholds: wgpu::MemoryBudgetThresholds {
            for_resource_creation: Some(95),
            for_device_loss: None,
        },
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn summary(adapter: &wgpu::Adapter) -> AdapterSummary {
    let info = adapter.get_info();
    AdapterSummary {
        name: info.name,
        backend: format!("{:?}", info.backend),
        kind: ["discrete", "integrated", "virtual", "other", "software"][usize::from(rank(info.device_type))],
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        max_texture_size: adapter.limits().max_texture_dimension_2d,
        timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
    }
}

fn refused(what: &str, error: wgpu::Error) -> GpuError {
    match error {
        wgpu::Error::OutOfMemory { .. } => GpuError::OutOfMemory { what: what.to_owned() },
        wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
            if description.to_lowercase().contains("device is lost") || description.contains("Device lost") {
                GpuError::Lost { reason: description }
            } else {
                GpuError::Refused { what: what.to_owned(), reason: description }
            }
        }
    }
}
