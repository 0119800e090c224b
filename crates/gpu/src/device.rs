//! Finding an adapter and opening it.

use crate::pipelines::{DriverCache, RecentPipelines};
use std::sync::{Arc, Mutex};
use thiserror::Error;

/// What to type where no driver is found.
pub const INSTALL_HINT: &str = "install a driver; Mesa's software driver will do: \
    `apt-get install mesa-vulkan-drivers` on Debian and Ubuntu, `dnf install mesa-vulkan-drivers` on Fedora";

/// The drivers that are asked.
const BACKENDS: wgpu::Backends = wgpu::Backends::VULKAN
    .union(wgpu::Backends::METAL)
    .union(wgpu::Backends::DX12);

/// An adapter that could be opened.
#[derive(Clone, Debug)]
pub struct AdapterDescription {
    /// Name, driver, type.
    pub info: wgpu::AdapterInfo,
    /// What it can do at most.
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
    /// The best: discrete before integrated before virtual before software.
    #[default]
    Best,
    /// The best that is hardware, no software driver.
    Hardware,
    /// The best of those whose name contains this, whatever the case of its letters.
    Named(String),
}

/// Why no device could be opened.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// There is no adapter at all.
    #[error("no Vulkan, Metal or DX12 driver found; {INSTALL_HINT}")]
    NoAdapter,
    /// There are only software drivers.
    #[error("there is no GPU, only the software driver {}", found.join(", "))]
    NoHardware {
        /// What there is.
        found: Vec<String>,
    },
    /// No adapter has the wanted name.
    #[error("no adapter is named like {wanted:?}; there {}", found_names(found))]
    NoSuchName {
        /// What was asked for.
        wanted: String,
        /// What there is.
        found: Vec<String>,
    },
    /// The adapter does not give a device.
    #[error("the adapter {adapter} cannot be opened")]
    Refused {
        /// Which one.
        adapter: String,
        /// What the driver says.
        source: wgpu::RequestDeviceError,
    },
}

fn found_names(found: &[String]) -> String {
    match found {
        [one] => format!("is only {one}"),
        many => format!("are {}", many.join(", ")),
    }
}

/// Something went wrong on the device.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// No memory is left.
    #[error("the adapter is out of memory: {0}")]
    OutOfMemory(String),
    /// The device was lost: unplugged, reset, or stopped by the system because a dispatch took too long.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// A call or a shader that the driver does not accept.
    #[error("the driver refused a call: {0}")]
    Refused(String),
    /// Work did not end in a time that no batch should need.
    #[error("the device has not answered for {seconds} s")]
    NoAnswer {
        /// How long was waited.
        seconds: u64,
    },
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

/// All adapters, the best first.
pub fn adapters() -> Vec<AdapterDescription> {
    ranked_adapters().iter().map(describe_adapter).collect()
}

/// Name, kind, backend and driver in one line.
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
    /// Where the driver gives out what it compiled (Vulkan), that is kept in the user's folder for caches, or in the one that the
    /// environment variable `PELLICLE_CACHE_DIR` names; an empty one keeps nothing.
    ///
    /// # Errors
    /// When there is none, none of the wanted name, or it refuses.
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
            // It is no more than a way to keep what was compiled; no shader needs it.
            required_features: adapter.features() & wgpu::Features::PIPELINE_CACHE,
            // The limits that every WebGPU device has, so that what runs here runs elsewhere.
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
        // A cache that the driver refuses is done without.
        if gpu.check().is_ok() {
            gpu.driver_cache = cache;
        }
        Ok(gpu)
    }

    /// Whether it is a software driver, which takes the lists of a scene in other forms than hardware does.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// The device with this said otherwise, so that tests see the lists in the other forms.
    #[must_use]
    pub fn taken_for_software(mut self, is_software: bool) -> Self {
        self.is_software = is_software;
        self
    }

    /// What this adapter is.
    pub fn description(&self) -> &AdapterDescription {
        &self.description
    }

    /// The limits that the device was opened with.
    pub fn limits(&self) -> wgpu::Limits {
        self.device.limits()
    }

    /// The device itself, for tests that run shaders of their own.
    pub fn device(&self) -> (&wgpu::Device, &wgpu::Queue) {
        (&self.device, &self.queue)
    }

    /// The first error that was reported since the last call.
    ///
    /// # Errors
    /// That error.
    pub fn check(&self) -> Result<(), DeviceError> {
        let mut trouble = self
            .trouble
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        trouble.take().map_or(Ok(()), Err)
    }

    /// Waits for all submitted work. A software driver may compile the pipeline within its first dispatch, on a busy machine for minutes.
    ///
    /// # Errors
    /// When the work failed, or does not end.
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
        // Dropping the device reports a loss as well; nobody asks for it any more.
        keep(&losses, DeviceError::Lost(format!("{reason:?}: {message}")));
    });
}
