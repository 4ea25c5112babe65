//! Data: pairs of states before and after a step, from memory or from files, and their reduction.

mod columns;
mod csv;
mod fold;
mod npy;
#[cfg(feature = "parquet")]
mod parquet;
mod read;
mod recording;
mod reduce;
mod write;

pub use columns::Columns;
pub use read::read_columns;
pub use recording::{Attitudes, Recording};
pub use reduce::{
    MomentumPairs, PairRows, PhasePair, ReducedData, Reduction, RowPolicy, Tolerances, reduce,
};
pub use write::{write_columns, write_pairs};
