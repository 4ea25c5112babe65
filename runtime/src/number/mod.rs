//! Numbers: scalars, and packs of them in the lanes of a register.

pub(crate) mod program;
pub(crate) mod scalar;
