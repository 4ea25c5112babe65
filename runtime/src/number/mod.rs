//! Numbers: scalars, and packs of them in the lanes of a register.

pub(crate) mod lift;
pub(crate) mod scalar;
