//! Finding an adapter and opening it.

use crate::device_error::DeviceError;
use crate::driver_cache::DriverCache;
use crate::recent_pipelines::RecentPipelines;
use std::sync::{Arc, Mutex};
use thiserror::Error;

/// Advice for when no driver is found.
pub const INSTALL_HINT: &str = "install a driver; Mesa's software driver will do: \
    `apt-get install mesa-vulkan-drivers` on Debian and Ubuntu, `dnf install mesa-vulkan-drivers` on Fedora";

/// The backends that are queried.
const BACKENDS: wgpu::Backends = wgpu::Backends::VULKAN
    .union(wgpu::Backends::METAL)
    .union(wgpu::Backends::DX12);

/// An adapter that could be opened.
#[derive(Clone, Debug)]
pub struct AdapterDescription {
    /// Name, driver, type.
    pub info: wgpu::AdapterInfo,
    /// The highest limits of the adapter.
    pub limits: wgpu::Limits,
}

impl std::fmt::Display for AdapterDescription {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&describe(&self.info))
    }
}

/// Which adapter to open.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The best adapter: discrete before integrated before virtual before software.
    #[default]
    Best,
    /// The best hardware adapter, never a software driver.
    Hardware,
    /// The best adapter whose name contains this, ignoring case.
    Named(String),
}

/// Why no device could be opened.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// There is no adapter at all.
    #[error("no Vulkan, Metal or DX12 driver found; {INSTALL_HINT}")]
    NoAdapter,
    /// All adapters are software drivers.
    #[error("there is no GPU, only the software driver {}", found.join(", "))]
    NoHardware {
        /// The adapters that were found.
        found: Vec<String>,
    },
    /// No adapter has the requested name.
    #[error("no adapter name contains {wanted:?}; there {}", found_names(found))]
    NoSuchName {
        /// The requested name.
        wanted: String,
        /// The adapters that were found.
        found: Vec<String>,
    },
    /// The adapter did not provide a device.
    #[error("the adapter {adapter} cannot be opened")]
    Refused {
        /// The adapter.
        adapter: String,
        /// The driver's error.
        source: wgpu::RequestDeviceError,
    },
}

fn found_names(found: &[String]) -> String {
    match found {
        [one] => format!("is only {one}"),
        many => format!("are {}", many.join(", ")),
    }
}

/// An open device.
#[derive(Debug)]
pub struct Gpu {
    description: AdapterDescription,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    trouble: Arc<Mutex<Option<DeviceError>>>,
    pub(crate) pipelines: Mutex<RecentPipelines>,
    pub(crate) driver_cache: Option<DriverCache>,
    is_software: bool,
}

/// Returns all adapters, the best first.
pub fn adapters() -> Vec<AdapterDescription> {
    ranked_adapters().iter().map(describe_adapter).collect()
}

/// Describes an adapter in one line: name, kind, backend and driver.
fn describe(info: &wgpu::AdapterInfo) -> String {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software",
        wgpu::DeviceType::Other => "unknown kind",
    };
    let driver = format!("{} {}", info.driver, info.driver_info);
    format!(
        "{} ({kind}, {}, {})",
        info.name,
        info.backend,
        driver.trim()
    )
}

fn describe_adapter(adapter: &wgpu::Adapter) -> AdapterDescription {
    AdapterDescription {
        info: adapter.get_info(),
        limits: adapter.limits(),
    }
}

fn ranked_adapters() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = BACKENDS;
    let instance = wgpu::Instance::new(descriptor);
    let mut found = pollster::block_on(instance.enumerate_adapters(BACKENDS));
    found.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    found
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

impl Gpu {
    /// Opens an adapter.
    ///
    /// Where the driver exposes what it compiled (Vulkan), that is kept in the user's cache folder, or in the folder that the
    /// environment variable `PELLICLE_CACHE_DIR` names; an empty value disables the cache.
    ///
    /// # Errors
    /// When there is no adapter, none with the requested name, or the driver refuses to open it.
    pub fn open(choice: &AdapterChoice) -> Result<Self, OpenError> {
        let mut found = ranked_adapters();
        if found.is_empty() {
            return Err(OpenError::NoAdapter);
        }
        let names = || found.iter().map(|a| a.get_info().name).collect();
        let position = match choice {
            AdapterChoice::Hardware if found[0].get_info().device_type == wgpu::DeviceType::Cpu => {
                return Err(OpenError::NoHardware { found: names() });
            }
            AdapterChoice::Best | AdapterChoice::Hardware => Some(0),
            AdapterChoice::Named(wanted) => {
                let wanted = wanted.to_lowercase();
                found
                    .iter()
                    .position(|a| a.get_info().name.to_lowercase().contains(&wanted))
            }
        };
        match (position, choice) {
            (None, AdapterChoice::Named(wanted)) => Err(OpenError::NoSuchName {
                wanted: wanted.clone(),
                found: names(),
            }),
            (position, _) => Self::open_adapter(&found.swap_remove(position.unwrap_or(0))),
        }
    }

    fn open_adapter(adapter: &wgpu::Adapter) -> Result<Self, OpenError> {
        let description = describe_adapter(adapter);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("pellicle"),
            // This feature only keeps compiled code; no shader needs it.
            required_features: adapter.features() & wgpu::Features::PIPELINE_CACHE,
            // The limits that every WebGPU device has, so that whatever runs here runs elsewhere.
            required_limits: wgpu::Limits::default().or_worse_values_from(&description.limits),
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|source| {
                OpenError::Refused {
                    adapter: description.to_string(),
                    source,
                }
            })?;
        let is_software = description.info.device_type == wgpu::DeviceType::Cpu;
        let trouble = Arc::new(Mutex::new(None));
        listen(&device, &trouble);
        let mut gpu = Self {
            description,
            device,
            queue,
            trouble,
            pipelines: Mutex::default(),
            driver_cache: None,
            is_software,
        };
        let cache = DriverCache::open(&gpu.device, &gpu.description.info);
        // A cache that the driver rejects is not used.
        if gpu.check().is_ok() {
            gpu.driver_cache = cache;
        }
        Ok(gpu)
    }

    /// Whether this is a software driver, for which the lists of a scene have other forms than for hardware.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// Returns the device with this flag overridden, so that tests see the lists in the other forms.
    #[must_use]
    pub fn taken_for_software(mut self, is_software: bool) -> Self {
        self.is_software = is_software;
        self
    }

    /// Returns the description of the adapter.
    pub fn description(&self) -> &AdapterDescription {
        &self.description
    }

    /// Returns the limits with which the device was opened.
    pub fn limits(&self) -> wgpu::Limits {
        self.device.limits()
    }

    /// Returns the device itself, for tests with their own shaders.
    pub fn device(&self) -> (&wgpu::Device, &wgpu::Queue) {
        (&self.device, &self.queue)
    }

    /// Returns the first error that was reported since the last call.
    ///
    /// # Errors
    /// The reported error.
    pub fn check(&self) -> Result<(), DeviceError> {
        let mut trouble = self
            .trouble
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        trouble.take().map_or(Ok(()), Err)
    }

    /// Waits for all submitted work. A software driver may compile the pipeline during its first dispatch, on a busy machine for minutes.
    ///
    /// # Errors
    /// When the work failed or does not finish.
    pub fn wait(&self) -> Result<(), DeviceError> {
        const SECONDS: u64 = 600;
        let poll = wgpu::PollType::Wait {
            submission_index: None,
            timeout: Some(std::time::Duration::from_secs(SECONDS)),
        };
        let polled = self.device.poll(poll);
        self.check()?;
        match polled {
            Ok(_) => Ok(()),
            Err(wgpu::PollError::Timeout) => Err(DeviceError::NoAnswer { seconds: SECONDS }),
            Err(error) => Err(DeviceError::Refused(error.to_string())),
        }
    }
}

/// Keeps the first error that the device reports outside a call.
fn listen(device: &wgpu::Device, trouble: &Arc<Mutex<Option<DeviceError>>>) {
    let keep = |slot: &Mutex<Option<DeviceError>>, error| {
        let mut slot = slot
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        slot.get_or_insert(error);
    };
    let errors = Arc::clone(trouble);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        let kept = match error {
            wgpu::Error::OutOfMemory { source } => DeviceError::OutOfMemory(source.to_string()),
            other => DeviceError::Refused(other.to_string()),
        };
        keep(&errors, kept);
    }));
    let losses = Arc::clone(trouble);
    device.set_device_lost_callback(move |reason, message| {
        // Dropping the device also reports a loss, which nobody checks any more.
        keep(&losses, DeviceError::Lost(format!("{reason:?}: {message}")));
    });
}
