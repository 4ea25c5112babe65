//! Data: pairs of states before and after a step, from memory or from files, and their reduction.

mod columns;
mod fold;
mod npy;
mod read;
mod recording;
mod reduce;
mod samples;
mod write;

pub use columns::Columns;
pub use read::read_columns;
pub use recording::{Attitudes, Recording};
pub use reduce::{PairRows, PhasePair, Reduction, RowPolicy, Tolerances, reduce};
pub use samples::{MomentumPairs, ReducedData};
pub use write::write_pairs;
