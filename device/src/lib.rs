//! Steps on graphics cards, and on whatever else OpenCL and CUDA drive: trajectories by the million.
//!
//! A [`Card`] is a [`Kernel`](coadjoint_program::Kernel) compiled for one [`Device`]. [`Card::advance`] moves rows of states,
//! a thread each, many steps a launch; what a thread refuses is handed back on the way, to be made by other means.
//!
//! Neither toolkit is needed to build this crate, nor a feature: what is missing when a device is opened is an error of
//! one line.

mod card;
#[cfg(feature = "cuda")]
mod cuda;
mod device;
mod error;
mod machine;
#[cfg(feature = "cuda")]
mod nvrtc;
#[cfg(feature = "opencl")]
mod opencl;
mod piece;

pub use card::{Advanced, Card, Redo, Refused, Row, Status};
pub use device::{Api, Device};
pub use error::DeviceError;
#[cfg(feature = "cuda")]
pub use nvrtc::{Compiled, compile};
