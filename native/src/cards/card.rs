//! A kernel on a device.

use std::time::Duration;

use coadjoint_program::{Kernel, Precision};

use super::device::{Api, Device};
use super::error::DeviceError;
use super::machine::Machine;
use super::piece;

/// The least number of rows that must fit: with fewer, a device does not pay.
pub(crate) const FEWEST: usize = 1024;

/// The state of a trajectory, and how far it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// The group element, m numbers.
    pub g: Vec<f64>,
    /// μ, n numbers.
    pub mu: Vec<f64>,
    /// Steps made.
    pub made: u64,
    /// Whether it stays where it is.
    pub ended: bool,
}

/// The reason for which a trajectory stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The equation of the next step was not solved.
    Unsolved,
    /// Its solution is far from the first guess.
    Far,
    /// The next step is outside the domain where it is accepted at once.
    Outside,
    /// The state at the end of a block was not finite, or not on the group: it is that before the block.
    Unsound,
}

impl Status {
    pub(crate) fn of(number: u32) -> Option<Self> {
        match number {
            1 => Some(Self::Unsolved),
            2 => Some(Self::Far),
            3 => Some(Self::Outside),
            4 => Some(Self::Unsound),
            _ => None,
        }
    }
}

/// A row of which a thread has refused a step.
#[derive(Debug)]
pub struct Refused<'a> {
    /// Its place among all rows.
    pub place: usize,
    /// Its state before that step.
    pub row: &'a mut Row,
    /// Why.
    pub why: Status,
}

/// Makes the steps that threads have refused: it is given the rows, and the step that it has to move them to, or end
/// them.
pub type Redo<'a> = dyn FnMut(&mut [Refused<'_>], u64) + 'a;

/// The outcome of [`Card::advance`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Advanced {
    /// How often a thread refused a step that the caller was then given to make.
    pub refused: u64,
    /// In how many pieces the rows were moved.
    pub pieces: u64,
    /// How often the kernel was started.
    pub launches: u64,
    /// The time the kernel ran.
    pub running: Duration,
}

/// A step compiled for a device, its folded coefficients included.
pub struct Card {
    pub(crate) machine: Box<dyn Machine>,
    pub(crate) device: Device,
    pub(crate) name: String,
    pub(crate) precision: Precision,
    pub(crate) element: usize,
    pub(crate) dim: usize,
    /// Rows that are tried at once.
    pub(crate) fits: usize,
    processor: bool,
}

impl std::fmt::Debug for Card {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Card").field("device", &self.device).finish_non_exhaustive()
    }
}

/// A device that was opened.
pub(crate) struct Opened {
    pub machine: Box<dyn Machine>,
    pub name: String,
    /// Whether the device is this machine's processor.
    pub processor: bool,
    /// Bytes of all arrays together, and of one, that may be asked for.
    pub memory: (u64, u64),
}

/// By the device's library, where the crate was built for it.
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
        let Opened { machine, name, processor, memory: (all, one) } = opened;
        let (precision, element, dim) = (kernel.precision(), kernel.element(), kernel.dim());
        let bytes = precision.bytes() as u64;
        let longest = bytes * element.max(dim).max(1) as u64;
        let row = bytes * (element + dim) as u64 + 12;
        let fits = (all / row).min(one / longest.max(8)).max(1);
        let fits = usize::try_from(fits).unwrap_or(usize::MAX);
        Self { machine, device, name, precision, element, dim, fits, processor }
    }

    /// The device.
    #[must_use]
    pub fn device(&self) -> Device {
        self.device
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether the device is this machine's processor.
    #[must_use]
    pub fn is_processor(&self) -> bool {
        self.processor
    }

    /// The numbers it computes with.
    #[must_use]
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Limits the rows taken at once.
    pub fn limit(&mut self, rows: usize) {
        self.fits = self.fits.min(rows.max(1));
    }

    /// Moves all rows to step `steps`, but those that have ended, in pieces that fit into the device's memory. Rows
    /// stand at the same step in the beginning.
    ///
    /// From time to time threads refuse a step. `redo` is then given these rows, why, and the step that all others have
    /// reached. It has to move them there by other means, or to end them.
    /// `told` receives the average number of steps made.
    ///
    /// # Errors
    /// [`DeviceError`] where there is no room for a thousand rows, or the device fails. The rows are then invalid.
    pub fn advance(
        &mut self,
        rows: &mut [Row],
        steps: u64,
        redo: &mut Redo<'_>,
        told: &dyn Fn(u64),
    ) -> Result<Advanced, DeviceError> {
        let shape = |row: &Row| row.g.len() == self.element && row.mu.len() == self.dim;
        if let Some(row) = rows.iter().position(|row| !shape(row)) {
            let (element, dim) = (self.element, self.dim);
            return Err(DeviceError::Shape { row, element, dim });
        }
        let mut advanced = Advanced::default();
        let total = rows.len().max(1) as u128;
        let mut first = 0;
        while first < rows.len() {
            let count = self.fits.min(rows.len() - first);
            let before = first as u128 * u128::from(steps);
            let told = |made: u64| {
                let all = before + count as u128 * u128::from(made);
                told(u64::try_from(all / total).unwrap_or(steps));
            };
            let own = &mut rows[first..first + count];
            match piece::advance(self, (first, own), steps, redo, &told, &mut advanced) {
                Ok(()) => {
                    advanced.pieces += 1;
                    first += count;
                }
                Err(piece::Stopped::Short) if count > FEWEST => {
                    self.fits = (count / 2).max(FEWEST);
                }
                Err(piece::Stopped::Short) => {
                    let (device, name) = (self.device, self.name.clone());
                    return Err(DeviceError::Memory { device, name, rows: count });
                }
                Err(piece::Stopped::Failed(error)) => return Err(error),
            }
        }
        Ok(advanced)
    }
}
