//! Why a device does not make steps.

use super::device::{Api, Device};

/// Why a device cannot be had, or failed. Each is one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// The crate was built without the feature.
    #[error("this program was built without {api}; build it with the feature `{api}`")]
    NotBuilt {
        /// How the device was to be reached.
        api: Api,
    },
    /// The system has no library for it.
    #[error("there is no {library} on this machine; install {install}")]
    NoLibrary {
        /// Which library.
        library: &'static str,
        /// The package that installs it.
        install: &'static str,
    },
    /// There is no device of this number.
    #[error("there is no device {device}; {found}")]
    NoDevice {
        /// The device that was asked for.
        device: Device,
        /// The version found.
        found: String,
    },
    /// The device has no numbers of 64 bits.
    #[error("{device} ({name}) has no numbers of 64 bits; ask for single precision")]
    NoDouble {
        /// The device.
        device: Device,
        /// Its name.
        name: String,
    },
    /// Not even a small piece of the rows fits.
    #[error("{device} ({name}) is out of memory: it has no room for {rows} trajectories")]
    Memory {
        /// The device.
        device: Device,
        /// Its name.
        name: String,
        /// The smallest number of rows that was tried.
        rows: usize,
    },
    /// The device's compiler refuses the kernel.
    #[error("{device} ({name}) does not build the kernel: {log}")]
    Build {
        /// The device.
        device: Device,
        /// Its name.
        name: String,
        /// The beginning of what its compiler said.
        log: String,
    },
    /// A call failed.
    #[error("{device} failed while it {doing}: {message}")]
    Failed {
        /// The device.
        device: Device,
        /// The operation.
        doing: &'static str,
        /// Its message.
        message: String,
    },
    /// The kernel came back with counts that no step makes.
    #[error(
        "{device} ({name}) gave back what the kernel cannot have written, for trajectory {row}"
    )]
    Wrong {
        /// The device.
        device: Device,
        /// Its name.
        name: String,
        /// The row, from 0.
        row: usize,
    },
    /// A state has not as many numbers as the kernel's.
    #[error("trajectory {row} has not the {element} + {dim} numbers of a state")]
    Shape {
        /// The row, from 0.
        row: usize,
        /// m, the numbers of a group element.
        element: usize,
        /// n, the coordinates of μ.
        dim: usize,
    },
}
