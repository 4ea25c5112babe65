//! Linear algebra of few dimensions, over scalars and lanes.

mod block_elimination;
pub(crate) mod coordinates;
