//! The interface of a device.

use crate::cards::DeviceError;
#[cfg(any(feature = "opencl", feature = "cuda"))]
pub(crate) use calls::{Arrays, Call, Fault};

/// The arrays of a piece of rows on a device, in the order of the kernel's arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Array {
    /// The numbers of g and μ, in blocks as [`States`](coadjoint_program::states::States) has them.
    States,
    /// Steps made, 64 bits each.
    Done,
    /// Status, 32 bits each.
    Status,
}

/// Reasons for not moving a piece of rows; the rows are unchanged.
#[cfg_attr(not(any(feature = "opencl", feature = "cuda")), allow(dead_code))]
pub(crate) enum Room {
    /// Memory is short: fewer rows may fit.
    Short,
    /// Something else.
    Failed(DeviceError),
}

impl From<DeviceError> for Room {
    fn from(error: DeviceError) -> Self {
        Self::Failed(error)
    }
}

/// The errors of a toolkit's calls as those of a device.
#[cfg(any(feature = "opencl", feature = "cuda"))]
mod calls {
    use super::{Array, DeviceError, Room};
    use crate::cards::Device;

    /// An error of a toolkit.
    pub(crate) trait Fault: std::fmt::Display {
        /// True if memory was short.
        fn is_short(&self) -> bool;
    }

    /// The arrays in a device's memory, and their lengths in bytes.
    pub(crate) struct Arrays<B>(Option<([B; 3], [usize; 3])>);

    impl<B> Default for Arrays<B> {
        fn default() -> Self {
            Self(None)
        }
    }

    impl<B> Arrays<B> {
        /// Replaces the arrays, unless they have these lengths already.
        pub(crate) fn reserve(
            &mut self,
            bytes: [usize; 3],
            make: impl Fn(usize) -> Result<B, Room>,
        ) -> Result<(), Room> {
            if self.0.as_ref().is_none_or(|(_, now)| *now != bytes) {
                self.0 = None;
                let [a, b, c] = bytes;
                self.0 = Some(([make(a)?, make(b)?, make(c)?], bytes));
            }
            Ok(())
        }

        /// An array, where it has bytes `first` to `first + count`.
        pub(crate) fn get(&mut self, array: Array, first: usize, count: usize) -> Option<&mut B> {
            let (arrays, lengths) = self.0.as_mut()?;
            let inside = first.checked_add(count)? <= lengths[array as usize];
            inside.then_some(&mut arrays[array as usize])
        }

        /// All of them, in the order of the kernel's arguments.
        pub(crate) fn all(&mut self) -> Result<&mut [B; 3], Room> {
            self.0.as_mut().map(|(arrays, _)| arrays).ok_or(Room::Short)
        }
    }

    /// Calls to this device.
    #[derive(Clone, Copy)]
    pub(crate) struct Call {
        pub device: Device,
    }

    impl Call {
        pub(crate) fn done<T, E: Fault>(
            self,
            doing: &'static str,
            result: Result<T, E>,
        ) -> Result<T, DeviceError> {
            result.map_err(|error| self.failed(doing, &error))
        }

        pub(crate) fn failed(self, doing: &'static str, error: &impl Fault) -> DeviceError {
            DeviceError::Failed { device: self.device, doing, message: error.to_string() }
        }

        /// Converts the error of a call that may run out of memory.
        pub(crate) fn room<T, E: Fault>(
            self,
            doing: &'static str,
            result: Result<T, E>,
        ) -> Result<T, Room> {
            result.map_err(|error| match error.is_short() {
                true => Room::Short,
                false => Room::Failed(self.failed(doing, &error)),
            })
        }
    }
}

/// A device with a compiled kernel, and arrays in its memory. Bytes are in the order of this machine.
pub(crate) trait Machine: Send {
    /// Replaces the arrays by new ones of these sizes in bytes, none of them zero.
    fn reserve(&mut self, bytes: [usize; 3]) -> Result<(), Room>;

    /// Writes bytes of an array, the first of which has number `first`.
    fn write(&mut self, array: Array, first: usize, bytes: &[u8]) -> Result<(), Room>;

    /// Reads bytes of an array, the first of which has number `first`.
    fn read(&mut self, array: Array, first: usize, bytes: &mut [u8]) -> Result<(), Room>;

    /// Moves all rows that the arrays were made for to step `target`, and waits until they are there.
    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room>;
}

/// A device that was opened.
pub(crate) struct Opened {
    pub machine: Box<dyn Machine>,
    pub name: String,
    /// True if the device is this machine's processor.
    pub processor: bool,
    /// Bytes of all arrays together, and of one, that may be asked for.
    pub memory: (u64, u64),
}
