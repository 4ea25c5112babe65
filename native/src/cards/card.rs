//! A kernel on a device.

use coadjoint_program::{Kernel, Precision, WIDTH};

use super::machine::{Machine, Opened};
use crate::cards::{Api, Device, DeviceError};

/// A step compiled for a device, its folded coefficients included.
pub struct Card {
    pub(crate) machine: Box<dyn Machine>,
    /// The device.
    pub device: Device,
    /// Its name.
    pub name: String,
    /// True if the device is this machine's processor.
    pub is_processor: bool,
    /// The numbers it computes with.
    pub precision: Precision,
    pub(crate) element: usize,
    pub(crate) dim: usize,
    /// Rows that are tried at once: whole blocks.
    pub(crate) fits: usize,
    /// Numbers of single precision on their way.
    pub(crate) short: Vec<f32>,
}

impl std::fmt::Debug for Card {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Card").field("device", &self.device).finish_non_exhaustive()
    }
}

/// Opens a device by its library, if the crate was built for it.
fn open(device: Device, kernel: &Kernel, slots: &[f64]) -> Result<Opened, DeviceError> {
    match device.api {
        #[cfg(feature = "opencl")]
        Api::OpenCl => super::opencl::open(device, kernel, slots),
        #[cfg(not(feature = "opencl"))]
        Api::OpenCl => not_built(device, kernel, slots),
        #[cfg(feature = "cuda")]
        Api::Cuda => super::cuda::open(device, kernel, slots),
        #[cfg(not(feature = "cuda"))]
        Api::Cuda => not_built(device, kernel, slots),
    }
}

#[cfg(not(all(feature = "opencl", feature = "cuda")))]
fn not_built(device: Device, _: &Kernel, _: &[f64]) -> Result<Opened, DeviceError> {
    Err(DeviceError::NotBuilt { api: device.api })
}

impl Card {
    /// Opens the device and compiles the kernel with these folded coefficients, in the kernel's precision.
    ///
    /// # Errors
    /// [`DeviceError`] where the feature, the library, the device or its numbers of 64 bits are missing, or it does not
    /// build the kernel.
    pub fn new(device: Device, kernel: &Kernel, slots: &[f64]) -> Result<Self, DeviceError> {
        Ok(Self::of(open(device, kernel, slots)?, device, kernel))
    }

    pub(crate) fn of(opened: Opened, device: Device, kernel: &Kernel) -> Self {
        let Opened { machine, name, processor: is_processor, memory: (all, one) } = opened;
        let (precision, element, dim) = (kernel.precision(), kernel.element, kernel.dim);
        let state = (precision.bytes() * (element + dim)) as u64;
        let fits = (all / (state + 12)).min(one / state.max(8));
        let fits = usize::try_from(fits).unwrap_or(usize::MAX);
        let short = Vec::new();
        let mut card =
            Self { machine, device, name, is_processor, precision, element, dim, fits, short };
        card.limit(fits);
        card
    }

    /// Limits the rows taken at once.
    pub fn limit(&mut self, rows: usize) {
        self.fits = (self.fits.min(rows) / WIDTH).max(1) * WIDTH;
    }
}
