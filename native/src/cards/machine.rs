//! The interface of a device.

use super::error::DeviceError;

/// The arrays of a piece of rows on a device, in the order of the kernel's arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Array {
    /// g, numbers.
    Element,
    /// μ, numbers.
    Momentum,
    /// Steps made, 64 bits each.
    Done,
    /// Status, 32 bits each.
    Status,
}

impl Array {
    pub(crate) const ALL: [Self; 4] = [Self::Element, Self::Momentum, Self::Done, Self::Status];
}

/// Why there is no room.
#[cfg_attr(not(any(feature = "opencl", feature = "cuda")), allow(dead_code))]
pub(crate) enum Room {
    /// Memory is short: fewer rows may fit.
    Short,
    /// Something else.
    Failed(DeviceError),
}

/// A device with a compiled kernel, and arrays in its memory. Bytes are in the order of this machine.
pub(crate) trait Machine: Send {
    /// Replaces the arrays by new ones of these sizes in bytes, none of them zero.
    fn reserve(&mut self, bytes: [usize; 4]) -> Result<(), Room>;

    /// Writes an array from its beginning.
    fn write(&mut self, array: Array, bytes: &[u8]) -> Result<(), Room>;

    /// Reads an array from its beginning.
    fn read(&mut self, array: Array, bytes: &mut [u8]) -> Result<(), DeviceError>;

    /// Moves all rows that the arrays were made for to step `target`, and waits until they are there.
    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room>;
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
