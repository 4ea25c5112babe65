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
mod device;
mod error;
mod machine;
#[cfg(feature = "cuda")]
mod nvrtc;
#[cfg(feature = "opencl")]
mod opencl;
mod piece;
mod row;

pub use card::Card;
pub use device::{Api, Device};
pub use error::DeviceError;
#[cfg(feature = "cuda")]
pub use nvrtc::{Compiled, compile};
pub use row::{Advanced, Redo, Refused, Row, Status};
