//! Linear algebra of few dimensions, over scalars and lanes.

mod block_elimination;
pub(crate) mod coordinates;
pub(crate) mod normal_equations;
pub(crate) mod response;
