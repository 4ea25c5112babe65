//! Steps on graphics cards, and on whatever else OpenCL and CUDA drive: trajectories by the million.
//!
//! A [`Card`] is a [`Kernel`](coadjoint_program::Kernel) compiled for one [`Device`]. [`Card::advance`] moves rows of states,
//! a thread each, many steps a launch. Rows that a thread refuses are returned to the caller, who makes these steps.
//!
//! Neither toolkit is needed to build this module, nor a feature: a missing library is reported when a device is opened, in
//! one line.

mod card;
#[cfg(feature = "cuda")]
mod cuda;
mod machine;
#[cfg(feature = "cuda")]
mod nvrtc;
#[cfg(feature = "opencl")]
mod opencl;
mod piece;

use std::fmt;
use std::str::FromStr;

pub use card::Card;
#[cfg(feature = "cuda")]
pub use nvrtc::{Compiled, compile};
pub use piece::{Advanced, ENDED, Refused, Status};

/// The interface through which a device is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Api {
    /// OpenCL: cards of all makers, and processors.
    OpenCl,
    /// CUDA: NVIDIA's cards.
    Cuda,
}

impl fmt::Display for Api {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OpenCl => "opencl",
            Self::Cuda => "cuda",
        })
    }
}

/// A device by its number: `opencl`, `opencl:1`, `cuda:0`.
///
/// OpenCL's are counted over all platforms, cards before processors; CUDA's as CUDA counts them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Device {
    /// Its interface.
    pub api: Api,
    /// Its number, from 0.
    pub number: usize,
}

impl FromStr for Device {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, number) = match text.split_once(':') {
            Some((name, number)) => (name, Some(number)),
            None => (text, None),
        };
        let api = match name {
            "opencl" => Api::OpenCl,
            "cuda" => Api::Cuda,
            _ => return Err("write opencl or cuda, with a number if you like: opencl:1".into()),
        };
        let number = number.map_or(Ok(0), str::parse).map_err(|_| {
            format!("after {name}: stands the number of a device, from 0, as in {name}:1")
        })?;
        Ok(Self { api, number })
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.api, self.number)
    }
}

/// Errors of opening and using a device. Each is one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// The crate was built without the feature.
    #[error("this program was built without {api}; build it with the feature `{api}`")]
    NotBuilt {
        /// The interface asked for.
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
    /// The device has no memory even for a small piece of the rows.
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
    /// States have not as many numbers as the kernel's, or there is not one for each count.
    #[error("a trajectory has not the {element} + {dim} numbers of a state")]
    Shape {
        /// m, the numbers of a group element.
        element: usize,
        /// n, the coordinates of μ.
        dim: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_named_by_their_number() {
        let device = |text: &str| text.parse::<Device>();
        assert_eq!(device("opencl"), Ok(Device { api: Api::OpenCl, number: 0 }));
        assert_eq!(device("cuda:3"), Ok(Device { api: Api::Cuda, number: 3 }));
        assert_eq!(device("cuda:3").map(|one| one.to_string()), Ok("cuda:3".to_owned()));
        for wrong in ["", "vulkan", "cuda:", "cuda:-1", "opencl:1:2", "OpenCL"] {
            assert!(device(wrong).is_err(), "{wrong}");
        }
    }
}
