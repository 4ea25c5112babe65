//! Matrix groups given by tables: structure constants, and a matrix basis where one is known.

pub(crate) mod algebra;
pub(crate) mod catalogue;
mod domain;
#[cfg(feature = "alloc")]
pub(crate) mod dynamic;
pub(crate) mod fixed;
pub(crate) mod group;
mod tables;
