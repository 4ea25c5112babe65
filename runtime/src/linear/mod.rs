//! Linear algebra of few dimensions, over scalars and lanes.

pub(crate) mod coordinates;
pub(crate) mod differences;
pub(crate) mod square;
